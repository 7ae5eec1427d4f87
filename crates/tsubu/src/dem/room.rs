//! Room for grains: a box of space, the walls in it, and the ends where the world repeats.

use crate::find::grid::Ends;
use crate::random::{Purpose, unit, words};
use crate::wall::{Touch, Wall};
use glam::DVec3;
use tsubu_scene::plan::{Plan, Region};

/// Points along an edge of the room where it is asked on which side of a bent wall they lie.
const PROBES: usize = 8;

/// A box of space: centre of the floor and size [m].
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub centre: DVec3,
    pub size: DVec3,
}

impl Room {
    pub fn of(region: &Region) -> Self {
        let (low, high) = (DVec3::from_array(region.low), DVec3::from_array(region.high));
        let middle = 0.5 * (low + high);
        Self { centre: DVec3::new(middle.x, middle.y, low.z), size: high - low }
    }

    /// A random place for a sphere of some radius; across periodic ends the sphere may reach.
    pub fn anywhere(&self, plan: &Plan, radius: f64, purpose: Purpose, id: u32, step: u64) -> DVec3 {
        let w = words(plan.seed, purpose, id, 2 * step);
        let v = words(plan.seed, purpose, id, 2 * step + 1);
        let draw = [unit(w[0], w[1]), unit(w[2], w[3]), unit(v[0], v[1])];
        let ends = ends(plan);
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
pub(super) fn ends(plan: &Plan) -> Ends {
    [plan.periodic.x, plan.periodic.y, plan.periodic.z]
}

/// A point and its images within `margin` outside the periodic ends.
pub(super) fn images(ends: &Ends, p: DVec3, margin: f64) -> impl Iterator<Item = DVec3> {
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
    /// Per wall: whether grains belong inside it, outside, or where they like.
    inside: Vec<Option<bool>>,
    near: Vec<u32>,
    touches: Vec<Touch>,
}

impl<'a> Clearance<'a> {
    /// Grains of a room belong on that side of a drum, cone or shell on which most of the room lies: a room may reach
    /// over the corners of a drum, or hold an obstacle.
    pub fn new(walls: &'a [Wall], room: &Room, dimension: u8) -> Self {
        let side = |wall: &Wall| {
            let told: Vec<bool> = room.probes(dimension).filter_map(|p| wall.encloses(p)).collect();
            let inside = told.iter().filter(|inside| **inside).count();
            (!told.is_empty()).then_some(2 * inside >= told.len())
        };
        Self { walls, inside: walls.iter().map(side).collect(), near: Vec::new(), touches: Vec::new() }
    }

    /// Whether a sphere would touch no wall and lie on the right side of all.
    pub fn free(&mut self, centre: DVec3, radius: f64) -> bool {
        self.walls.iter().zip(&self.inside).all(|(wall, inside)| {
            wall.near(centre, radius, &mut self.near);
            self.near.is_empty() && wall.encloses(centre).zip(*inside).is_none_or(|(there, wanted)| there == wanted)
        })
    }

    /// The same for a place in rows, which may touch the walls that they lie between.
    pub fn fits(&mut self, centre: DVec3, radius: f64) -> bool {
        let reach = 0.999 * radius;
        self.walls.iter().zip(&self.inside).all(|(wall, inside)| {
            wall.near(centre, reach, &mut self.near);
            wall.touching(&self.near, centre, reach, &mut self.touches);
            self.touches.is_empty() && wall.encloses(centre).zip(*inside).is_none_or(|(there, wanted)| there == wanted)
        })
    }
}
