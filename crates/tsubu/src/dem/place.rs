//! Where grains begin.

use crate::partner::Hosts;
use crate::random::{Purpose, unit, words};
use crate::state::{Grain, Grains};
use crate::wall::Carrier;
use glam::DVec3;
use tsubu_scene::plan::{Particles, Plan, Shape, Start};

/// The box that grains are placed in: floor centre and inner size [m].
type Room = (DVec3, DVec3);

/// All grains of a plan, in the order of groups and numbers, and whether some of them must settle first.
/// Fails with the group's name and what is missing.
pub(super) fn grains(plan: &Plan, hosts: &Hosts) -> Result<(Grains, f64), (String, String)> {
    let mut grains = Grains::default();
    let mut settle: f64 = 0.0;
    let room = plan.walls.values().find_map(|wall| match &wall.shape {
        Shape::Box { width, height, depth, floor_centre } => {
            let displacement = Carrier::new(wall, hosts).place(0.0, hosts).0;
            Some((DVec3::from_array(*floor_centre) + displacement, DVec3::new(*width, *depth, *height)))
        }
        Shape::Plane { .. } => None,
    });
    let mut floor = 0.0;
    for (species, (name, group)) in plan.particles.iter().enumerate() {
        let needs_box = || {
            let text =
                "needs a wall with `shape.box` to be placed in; give positions with `start.at` instead".to_owned();
            (format!("particles.{name}.start"), text)
        };
        match &group.start {
            Start::At { position, velocity, spin } => {
                for (i, p) in position.iter().enumerate() {
                    let mut grain = still(group, species, DVec3::from_array(*p), grains.len());
                    grain.velocity = velocity.get(i).map_or(DVec3::ZERO, |v| DVec3::from_array(*v));
                    grain.spin = spin.get(i).map_or(DVec3::ZERO, |v| DVec3::from_array(*v));
                    grains.push(grain);
                }
            }
            Start::Rows { spacing, jitter, speed } => {
                let room = room.ok_or_else(needs_box)?;
                floor = rows(&mut grains, plan, group, species, room, floor, *spacing, *jitter);
                let first = grains.len() - group.count;
                for i in first..grains.len() {
                    let w = words(plan.seed, Purpose::Placement, grains.id[i], 1);
                    grains.velocity[i] = direction(plan.dimension, w) * *speed;
                }
            }
            Start::Settled { time } => {
                let room = room.ok_or_else(needs_box)?;
                floor = rows(&mut grains, plan, group, species, room, floor, 1.1, 0.9);
                if group.count > 0 {
                    settle = settle.max(*time);
                }
            }
        }
    }
    Ok((grains, settle))
}

fn still(group: &Particles, species: usize, position: DVec3, id: usize) -> Grain {
    let radius = 0.5 * group.diameter;
    Grain {
        position,
        velocity: DVec3::ZERO,
        acceleration: DVec3::ZERO,
        spin: DVec3::ZERO,
        spin_rate: DVec3::ZERO,
        radius,
        mass: group.mass,
        inertia: 0.4 * group.mass * radius * radius,
        species: species as u32,
        id: id as u32,
    }
}

/// Fills rows from `floor` up; returns the height reached. Narrows the spacing if the group would not fit otherwise.
#[expect(clippy::too_many_arguments, reason = "called from one place with the group taken apart")]
fn rows(
    grains: &mut Grains,
    plan: &Plan,
    group: &Particles,
    species: usize,
    (centre, size): Room,
    floor: f64,
    spacing: f64,
    jitter: f64,
) -> f64 {
    let d = group.diameter;
    // How far a grain may be shaken from its place, and how many places fit when the outermost are shaken towards a wall.
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
        ny = if plan.dimension == 3 { across(size.y, pitch).max(1) } else { 1 };
        if group.count <= nx * ny * up(size.z - floor, pitch) || pitch <= d {
            break;
        }
        pitch = (0.98 * pitch).max(d);
    }
    let free = free(pitch);
    let offset = |n: usize, i: usize| (i as f64 - 0.5 * (n - 1) as f64) * pitch;
    let mut top = floor;
    for k in 0..group.count {
        let (x, y, z) = (k % nx, k / nx % ny, k / (nx * ny));
        let id = grains.len();
        let w = words(plan.seed, Purpose::Placement, id as u32, 0);
        let v = words(plan.seed, Purpose::Placement, id as u32, 2);
        let shake = |word: u32, other: u32| (2.0 * unit(word, other) - 1.0) * free;
        let mut p = centre + DVec3::new(offset(nx, x), offset(ny, y), floor + 0.5 * pitch + z as f64 * pitch);
        p += DVec3::new(shake(w[0], w[1]), 0.0, shake(w[2], w[3]));
        if plan.dimension == 3 {
            p.y += shake(v[0], v[1]);
        }
        top = floor + (z + 1) as f64 * pitch;
        grains.push(still(group, species, p, id));
    }
    top
}

/// A random unit vector, in the plane or in space.
fn direction(dimension: u8, w: [u32; 4]) -> DVec3 {
    let angle = std::f64::consts::TAU * unit(w[0], w[1]);
    if dimension == 2 {
        return DVec3::new(angle.cos(), 0.0, angle.sin());
    }
    let z = 2.0 * unit(w[2], w[3]) - 1.0;
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * angle.cos(), r * angle.sin(), z)
}
