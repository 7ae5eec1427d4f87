//! Room for grains: a box of space, the walls in it, and the ends where the world repeats.

use crate::neighbours::grid::PeriodicBounds;
use crate::random::{Purpose, unit, words};
use crate::wall::{Touch, Wall};
use glam::DVec3;
use tsubu_scene::plan::{Plan, Region};

/// Points along an edge of the room where it is asked on which side of a bent wall they lie.
const PROBES: usize = 8;

/// A box of space: centre of the floor and size [m].
#[derive(Clone, Debug)]
pub(super) struct Room {
    pub centre: DVec3,
    pub size: DVec3,
    /// Less than the box, where the region is round.
    round: Option<Region>,
}

impl Room {
    pub fn of(region: &Region) -> Self {
        let (low, high) = (DVec3::from_array(region.low), DVec3::from_array(region.high));
        let middle = 0.5 * (low + high);
        let round = region.is_round().then(|| region.clone());
        Self { centre: DVec3::new(middle.x, middle.y, low.z), size: high - low, round }
    }

    /// The inside of a box of walls: centre of its floor and size [m].
    pub const fn of_box(centre: DVec3, size: DVec3) -> Self {
        Self { centre, size, round: None }
    }

    /// Whether a ball that lies in the box lies in the region wholly.
    pub fn holds(&self, centre: DVec3, radius: f64) -> bool {
        self.round.as_ref().is_none_or(|round| round.rounds(centre.to_array(), radius))
    }

    /// A random place for a sphere of some radius; across periodic ends the sphere may reach.
    pub fn anywhere(&self, plan: &Plan, radius: f64, purpose: Purpose, id: u32, step: u64) -> DVec3 {
        let w = words(plan.seed, purpose, id, 2 * step);
        let v = words(plan.seed, purpose, id, 2 * step + 1);
        let draw = [unit(w[0], w[1]), unit(w[2], w[3]), unit(v[0], v[1])];
        let ends = periodic_bounds(plan);
        let mut p = self.centre + DVec3::new(0.0, 0.0, 0.5 * self.size.z);
        for axis in 0..3 {
            if axis == 1 && plan.dimension == 2 {
                continue;
            }
            let margin = if ends[axis].is_some() { 0.0 } else { 2.0 * radius };
            p[axis] += (draw[axis] - 0.5) * (self.size[axis] - margin).max(0.0);
        }
        p
    }

    /// Points spread evenly through the room.
    fn probes(&self, dimension: u8) -> impl Iterator<Item = DVec3> {
        let at = |k: usize| (k as f64 + 0.5) / PROBES as f64;
        let across = if dimension == 3 { PROBES } else { 1 };
        let (low, size) = (self.centre - DVec3::new(0.5 * self.size.x, 0.5 * self.size.y, 0.0), self.size);
        let wide = move |k: usize| if dimension == 3 { at(k) } else { 0.5 };
        (0..PROBES * across * PROBES)
            .map(move |k| low + size * DVec3::new(at(k % PROBES), wide(k / PROBES % across), at(k / PROBES / across)))
    }
}

/// Periodic axes of a plan.
pub(super) fn periodic_bounds(plan: &Plan) -> PeriodicBounds {
    [plan.periodic.x, plan.periodic.y, plan.periodic.z]
}

/// A point and its images within `margin` outside the periodic ends.
pub(super) fn images(ends: &PeriodicBounds, p: DVec3, margin: f64) -> impl Iterator<Item = DVec3> {
    let mut images = vec![p];
    for (axis, end) in ends.iter().enumerate() {
        let Some([low, high]) = *end else { continue };
        for k in 0..images.len() {
            let image = images[k];
            for shift in [low - high, high - low] {
                let mut moved = image;
                moved[axis] += shift;
                if moved[axis] > low - margin && moved[axis] < high + margin {
                    images.push(moved);
                }
            }
        }
    }
    images.into_iter()
}

/// The walls as one sees them who looks for room.
pub(super) struct Clearance<'a> {
    walls: &'a [Wall],
    /// Per wall: where grains belong.
    sides: Vec<Side>,
    /// The way of gravity: a unit vector, or zero.
    down: DVec3,
    near: Vec<u32>,
    touches: Vec<Touch>,
}

/// On which side of a wall grains belong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Where they like: the wall has no inside, or is not met.
    Any,
    /// Inside, or where they fall into it.
    Inside,
    /// Not inside.
    Outside,
}

/// On which side of every wall the grains of a room belong.
pub(super) fn sides(walls: &[Wall], room: &Room, dimension: u8, gravity: DVec3) -> Vec<Side> {
    let down = gravity.normalize_or_zero();
    walls.iter().map(|wall| Side::of_most(wall, room.probes(dimension), down)).collect()
}

impl<'a> Clearance<'a> {
    /// Grains of a room belong on that side of a drum, cone, shell or mesh on which most of the room lies: a room may reach
    /// over the corners of a drum, or hold an obstacle.
    pub fn new(walls: &'a [Wall], room: &Room, dimension: u8, gravity: DVec3) -> Self {
        Self::on(sides(walls, room, dimension, gravity), walls, gravity)
    }

    /// The same where the sides are known.
    pub fn on(sides: Vec<Side>, walls: &'a [Wall], gravity: DVec3) -> Self {
        Self { walls, sides, down: gravity.normalize_or_zero(), near: Vec::new(), touches: Vec::new() }
    }

    /// Grains that are told their places belong where most of them are.
    pub fn of_places(walls: &'a [Wall], places: &[DVec3], gravity: DVec3) -> Self {
        let down = gravity.normalize_or_zero();
        Self::on(walls.iter().map(|wall| Side::of_most(wall, places.iter().copied(), down)).collect(), walls, gravity)
    }

    /// Whether a sphere would touch no wall and lie on the right side of all.
    pub fn free(&mut self, centre: DVec3, radius: f64) -> bool {
        let clear = self.walls.iter().all(|wall| {
            wall.near(centre, radius, &mut self.near);
            self.near.is_empty()
        });
        clear && self.strays(centre).is_none()
    }

    /// The same for a place in rows, which may touch the walls that they lie between.
    pub fn fits(&mut self, centre: DVec3, radius: f64) -> bool {
        let reach = 0.999 * radius;
        let clear = self.walls.iter().all(|wall| {
            wall.near(centre, reach, &mut self.near);
            wall.touching(&self.near, centre, reach, &mut self.touches);
            self.touches.is_empty()
        });
        clear && self.strays(centre).is_none()
    }

    /// The wall on whose wrong side a place is.
    ///
    /// A place before the mouth of a vessel is wrong if what falls from there passes the vessel, and meets no other curved wall
    /// or mesh either.
    pub fn strays(&self, centre: DVec3) -> Option<&'a Wall> {
        let wrong = |(wall, side): &(&Wall, &Side)| match (side, wall.encloses(centre, self.down)) {
            (Side::Any, _) => false,
            (Side::Inside, Some(inside)) => !inside,
            (Side::Outside, inside) => inside == Some(true),
            (Side::Inside, None) => {
                wall.catches(centre, self.down) == Some(false)
                    && !self.walls.iter().any(|wall| wall.lies_below(centre, self.down))
            }
        };
        self.walls.iter().zip(&self.sides).find(wrong).map(|(wall, _)| wall)
    }
}

impl Side {
    fn of_most(wall: &Wall, places: impl Iterator<Item = DVec3>, down: DVec3) -> Self {
        // How many are inside and outside, and would fall to the inside and past it.
        let (mut is, mut falls) = ([0_usize; 2], [0_usize; 2]);
        for place in places {
            match wall.encloses(place, down) {
                Some(inside) => is[usize::from(inside)] += 1,
                None => {
                    if let Some(inside) = wall.catches(place, down) {
                        falls[usize::from(inside)] += 1;
                    }
                }
            }
        }
        let [outside, inside] = is;
        match () {
            () if is == [0; 2] && falls == [0; 2] => Self::Any,
            () if inside + falls[1] >= outside + falls[0] => Self::Inside,
            // What lies below, as a pipe in a bin, is no vessel for what falls past.
            () if is == [0; 2] => Self::Any,
            () if inside >= outside => Self::Inside,
            () => Self::Outside,
        }
    }
}
