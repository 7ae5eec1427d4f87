//! Where grains begin.

use super::fill::Occupied;
use super::room::{Clearance, Room, images, periodic_bounds};
use crate::contact::Table;
use crate::motion::value_and_rate;
use crate::mutation::{Mutation, mutated};
use crate::random::{Purpose, unit, words};
use crate::sizes;
use crate::state::{Grain, Grains};
use crate::wall::Wall;
use glam::DVec3;
use tsubu_scene::plan::{GrainMotion, GrainShape, Particles, Plan, Region, Shape, Start};

/// Attempts to find a free place for one grain before giving up.
const ATTEMPTS: u64 = 2000;

/// What is wrong with a group: key and text.
type Wrong = (String, String);

/// All grains of a plan that are there at time 0, in the order of groups and numbers, and how long some of them may
/// settle first [s]. Those at random places come last: they look for room among all others.
pub(super) fn grains(plan: &Plan, table: &Table, walls: &[Wall]) -> Result<(Grains, f64), Wrong> {
    let placed = plan.particles.values().filter(|group| !matches!(group.start, Start::Stream { .. }));
    let grains = Grains::with_room(placed.map(|group| group.count).sum());
    let mut placing = Placing { plan, table, walls, grains, room: room(plan, walls), floor: 0.0 };
    let mut settle: f64 = 0.0;
    let random = |group: &Particles| matches!(group.start, Start::Random { .. });
    let groups = || plan.particles.iter().enumerate();
    let ordered = groups().filter(|(_, g)| !random(g.1)).chain(groups().filter(|(_, g)| random(g.1)));
    for (number, (name, group)) in ordered {
        let key = |part: &str| format!("particles.{name}.start.{part}");
        match &group.start {
            Start::At { position, velocity, spin } => placing.at(group, number, position, &[], velocity, spin),
            Start::File { grains, .. } => {
                placing.at(group, number, &grains.position, &grains.diameter, &grains.velocity, &grains.spin);
            }
            Start::Rows { spacing, jitter, speed, region } => {
                let room = placing.inside(region.as_ref()).ok_or_else(|| no_room(key("rows")))?;
                let first = placing.grains.len();
                placing
                    .rows(group, number, &room, *spacing, *jitter, region.is_none())
                    .map_err(|text| (key("rows"), text))?;
                placing.stir(first, DVec3::ZERO, *speed);
            }
            Start::Settled { time } => {
                let room = placing.inside(None).ok_or_else(|| no_room(key("settled")))?;
                let first = placing.grains.len();
                let free = placing.rows(group, number, &room, 1.1, 0.9, true).map_err(|text| (key("settled"), text))?;
                // In a box so full that rows touch all seeds would give one bed: there grains begin with some speed.
                if free <= 0.0 {
                    let fall = DVec3::from_array(plan.gravity).length() * group.largest_diameter();
                    placing.stir(first, DVec3::ZERO, fall.sqrt());
                }
                if group.count > 0 {
                    settle = settle.max(*time);
                }
            }
            Start::Random { region, velocity, speed } => {
                let room = placing.inside(region.as_ref()).ok_or_else(|| no_room(key("random")))?;
                let first = placing.grains.len();
                placing.random(group, number, &room).map_err(|text| (key("random"), text))?;
                placing.stir(first, DVec3::from_array(*velocity), *speed);
            }
            Start::Stream { .. } => {}
        }
    }
    Ok((placing.grains, settle))
}

fn no_room(key: String) -> Wrong {
    (key, "needs a wall with `shape.box` to be placed in, or a `region`; or give positions with `start.at`".to_owned())
}

/// The box that grains are placed in.
fn room(plan: &Plan, walls: &[Wall]) -> Option<Room> {
    plan.walls.values().zip(walls).find_map(|(wall, built)| match &wall.shape {
        Shape::Box { width, height, depth, floor_centre } => {
            let centre = DVec3::from_array(*floor_centre) + built.pose.offset;
            Some(Room::of_box(centre, DVec3::new(*width, *depth, *height)))
        }
        _ => None,
    })
}

/// A grain of a group at rest.
pub(super) fn still(
    group: &Particles,
    number: usize,
    material: u32,
    position: DVec3,
    diameter: f64,
    id: usize,
) -> Grain {
    let radius = 0.5 * diameter;
    let mass = sizes::mass(group, diameter);
    let share = if matches!(group.shape, GrainShape::Disc { .. }) { 0.5 } else { 0.4 };
    let free = matches!(group.motion, GrainMotion::Free {});
    Grain {
        position,
        velocity: DVec3::ZERO,
        acceleration: DVec3::ZERO,
        spin: DVec3::ZERO,
        angular_acceleration: DVec3::ZERO,
        unwrap_offset: DVec3::ZERO,
        radius,
        mass,
        inverse_mass: if free { 1.0 / mass } else { 0.0 },
        inertia: mutated(Mutation::Inertia, share * mass * radius * radius),
        material,
        group: number as u32,
        id: id as u32,
    }
}

struct Placing<'a> {
    plan: &'a Plan,
    table: &'a Table,
    walls: &'a [Wall],
    grains: Grains,
    room: Option<Room>,
    /// Height above the floor up to which rows have filled the box [m].
    floor: f64,
}

impl Placing<'_> {
    /// A region, or else the box.
    fn inside(&self, region: Option<&Region>) -> Option<Room> {
        region.map(Room::of).or_else(|| self.room.clone())
    }

    fn push(&mut self, group: &Particles, number: usize, position: DVec3, diameter: f64) {
        let material = self.table.material(&group.material);
        // As walls do, driven grains stand at time 0 where their motion has brought them by then.
        let position = match &group.motion {
            GrainMotion::Driven { direction, signal } => {
                position + DVec3::from_array(*direction) * value_and_rate(signal, 0.0).0
            }
            _ => position,
        };
        self.grains.push(still(group, number, material, position, diameter, self.grains.len()));
    }

    fn at(
        &mut self,
        group: &Particles,
        number: usize,
        position: &[[f64; 3]],
        diameter: &[f64],
        velocity: &[[f64; 3]],
        spin: &[[f64; 3]],
    ) {
        let free = matches!(group.motion, GrainMotion::Free {});
        for (k, p) in position.iter().enumerate() {
            let id = self.grains.len();
            let d = diameter.get(k).copied().unwrap_or_else(|| sizes::diameter(group, self.plan.seed, id as u32));
            self.push(group, number, DVec3::from_array(*p), d);
            // A file may be the snapshot of a run; what is held or driven moves as its scene says.
            if !free {
                continue;
            }
            self.grains.velocity[id] = velocity.get(k).map_or(DVec3::ZERO, |v| DVec3::from_array(*v));
            self.grains.spin[id] = spin.get(k).map_or(DVec3::ZERO, |v| DVec3::from_array(*v));
        }
    }

    /// Gives the grains from `first` on a common velocity, and each a speed in a random direction.
    fn stir(&mut self, first: usize, velocity: DVec3, speed: f64) {
        for i in first..self.grains.len() {
            let w = words(self.plan.seed, Purpose::Placement, self.grains.id[i], 1);
            self.grains.velocity[i] = velocity + direction(self.plan.dimension, w) * speed;
        }
    }

    /// Fills rows from the floor up (in the box: from where the last group ended), round whatever other walls are there.
    /// Narrows the spacing if the group would not fit otherwise. Returns how far grains are shaken from their places at most [m].
    fn rows(
        &mut self,
        group: &Particles,
        number: usize,
        room: &Room,
        spacing: f64,
        jitter: f64,
        stack: bool,
    ) -> Result<f64, String> {
        let (centre, size) = (room.centre, room.size);
        let space = self.plan.dimension == 3;
        let floor = if stack { self.floor } else { 0.0 };
        // Places are as wide as the widest grain.
        let d = group.largest_diameter();
        // How far a grain may be shaken from its place, and how many places fit when the outermost are shaken towards a
        // wall.
        let free = |pitch: f64| 0.5 * (pitch - d) * jitter * 0.999;
        let across =
            |length: f64, pitch: f64| ((length - d - 2.0 * free(pitch)) / pitch + 1.0 + 1e-9).floor().max(0.0) as usize;
        let up = |length: f64, pitch: f64| {
            ((length - 0.5 * (pitch + d) - free(pitch)) / pitch + 1.0 + 1e-9).floor().max(0.0) as usize
        };
        let mut pitch = spacing * d;
        let (mut nx, mut ny);
        loop {
            nx = across(size.x, pitch).max(1);
            ny = if space { across(size.y, pitch).max(1) } else { 1 };
            if group.count <= nx * ny * up(size.z - floor, pitch) || pitch <= d {
                break;
            }
            pitch = (0.98 * pitch).max(d);
        }
        let free = free(pitch);
        let offset = |n: usize, i: usize| (i as f64 - 0.5 * (n - 1) as f64) * pitch;
        let layers = up(size.z - floor, pitch);
        // What nothing moves may lie in a wall, as a rough floor does.
        let free_to_move = matches!(group.motion, GrainMotion::Free {});
        let mut clearance = Clearance::new(self.walls, room, self.plan.dimension, DVec3::from_array(self.plan.gravity));
        let mut top = floor;
        let mut place = 0;
        for count in 0..group.count {
            let id = self.grains.len() as u32;
            let w = words(self.plan.seed, Purpose::Placement, id, 0);
            let v = words(self.plan.seed, Purpose::Placement, id, 2);
            let shake = |word: u32, other: u32| (2.0 * unit(word, other) - 1.0) * free;
            let diameter = sizes::diameter(group, self.plan.seed, id);
            let p = loop {
                let (x, y, z) = (place % nx, place / nx % ny, place / (nx * ny));
                if place > count && z >= layers {
                    return Err(format!(
                        "there is room for {count} of {} grains only, for walls or the ends of the region lie in their places; take a smaller `spacing`, \
                         fewer grains, or `start.random`",
                        group.count
                    ));
                }
                place += 1;
                top = floor + (z + 1) as f64 * pitch;
                let mut p = centre + DVec3::new(offset(nx, x), offset(ny, y), floor + 0.5 * pitch + z as f64 * pitch);
                p += DVec3::new(shake(w[0], w[1]), 0.0, shake(w[2], w[3]));
                if space {
                    p.y += shake(v[0], v[1]);
                }
                if room.holds(p, 0.5 * diameter) && (!free_to_move || clearance.fits(p, 0.5 * diameter)) {
                    break p;
                }
            };
            self.push(group, number, p, diameter);
        }
        if stack {
            self.floor = top;
        }
        Ok(free)
    }

    /// Anywhere in the room without overlap, the largest first: they find room while there is most.
    fn random(&mut self, group: &Particles, number: usize, room: &Room) -> Result<(), String> {
        let first = self.grains.len();
        let mut ids: Vec<(u32, f64)> = (first..first + group.count)
            .map(|id| (id as u32, sizes::diameter(group, self.plan.seed, id as u32)))
            .collect();
        let largest = ids.iter().map(|x| 0.5 * x.1).chain(self.grains.radius.iter().copied()).fold(0.0, f64::max);
        let mut occupied = Occupied::new(largest);
        for i in 0..first {
            occupied.put(self.grains.position[i], self.grains.radius[i]);
        }
        let ends = periodic_bounds(self.plan);
        let mut clearance = Clearance::new(self.walls, room, self.plan.dimension, DVec3::from_array(self.plan.gravity));
        ids.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut places = vec![(DVec3::ZERO, 0.0); group.count];
        for (count, (id, diameter)) in ids.into_iter().enumerate() {
            let radius = 0.5 * diameter;
            let free = (0..ATTEMPTS).find_map(|attempt| {
                let p = room.anywhere(self.plan, radius, Purpose::Placement, id, 3 + attempt);
                let free = room.holds(p, radius)
                    && clearance.free(p, radius)
                    && images(&ends, p, 2.0 * radius).all(|image| occupied.free(image, radius));
                free.then_some(p)
            });
            let Some(p) = free else {
                return Err(format!(
                    "{count} of {} grains found room, the next not at {ATTEMPTS} random places; take a larger `region`, fewer grains, or `start.rows`",
                    group.count
                ));
            };
            for image in images(&ends, p, 2.0 * largest) {
                occupied.put(image, radius);
            }
            places[id as usize - first] = (p, diameter);
        }
        for (p, diameter) in places {
            self.push(group, number, p, diameter);
        }
        Ok(())
    }
}

/// A random unit vector, in the plane or in space.
pub(super) fn direction(dimension: u8, w: [u32; 4]) -> DVec3 {
    let angle = std::f64::consts::TAU * unit(w[0], w[1]);
    if dimension == 2 {
        return DVec3::new(angle.cos(), 0.0, angle.sin());
    }
    let z = 2.0 * unit(w[2], w[3]) - 1.0;
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * angle.cos(), r * angle.sin(), z)
}
