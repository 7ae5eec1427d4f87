//! The verdict on a scene before it runs.

mod bonds;
mod clump;
mod drive;
mod fall;
mod idle;
mod length;
mod mesh;
mod opening;
mod rest;
mod verdict;
mod water;

pub(crate) use drive::{fastest, peak};
pub(crate) use length::length;
pub use verdict::{Line, Verdict, human_time, verdict};
pub use water::blows_up;

use crate::contact::Table;
use crate::partner::Hosts;
use crate::sizes;
use tsubu_scene::plan::{self, GrainMotion, Particles, Plan, Shape, Start, Water};

/// Time step of DEM [s]: told, or the shortest contact time at the scene's speed scale, and under the weight of the bed, over
/// the wanted steps per contact; shorter where a bed's dashpots or the drag of water ask for it.
pub fn time_step(plan: &Plan, table: &Table, hosts: &Hosts) -> f64 {
    plan.dem.time_step.unwrap_or_else(|| {
        let speed = speed_scale(plan, hosts);
        let bodies = bodies(plan, table, hosts);
        let steps = bodies.pairs().map(|(a, b)| {
            let pair = table.pair(a.body(), b.body());
            let depth = rest::overlap(plan, &pair, a);
            let time = pair.contact_time(speed.max(pair.speed_of(depth)));
            (time / plan.dem.steps_per_contact).min(rest::longest_step(&pair, speed, depth))
        });
        let dt = steps.fold(water::longest_step(plan, hosts), f64::min);
        let dt = dt.min(bonds::shortest_period(plan) / plan.dem.steps_per_contact);
        if dt.is_finite() { dt } else { shortest_period(hosts).min(plan.duration) / 200.0 }
    })
}

/// A group of grains (its smallest) or the walls of one material that give way alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// How users know it.
    pub name: String,
    /// The group of grains; `None` for walls.
    pub group: Option<String>,
    /// Number of the material in the contact table.
    pub material: u32,
    /// Radius at contacts [m]; infinite for walls.
    pub radius: f64,
    /// What an overlap is held against, twice this [m]: of polyhedra the sphere that holds them, of others the radius.
    pub size: f64,
    /// Radius of the largest of them [m].
    pub largest: f64,
    /// Mass [kg]; infinite for what forces do not move.
    pub mass: f64,
}

impl Kind {
    /// As [`Table::pair`] wants it.
    pub fn body(&self) -> (u32, f64, f64) {
        (self.material, self.radius, self.mass)
    }
}

/// All kinds of bodies of a plan.
#[derive(Clone, Debug, Default)]
pub struct Bodies(Vec<Kind>);

impl Bodies {
    /// Pairs that can touch; the first is a group of grains.
    pub fn pairs(&self) -> impl Iterator<Item = (&Kind, &Kind)> {
        let later = |k: usize| self.0[k..].iter();
        let all = self.0.iter().enumerate().flat_map(move |(k, a)| later(k).map(move |b| (a, b)));
        all.filter(|(a, b)| a.group.is_some() && (a.mass.is_finite() || b.mass.is_finite()))
    }
}

/// The kinds of bodies of a plan: groups that have grains, then walls.
pub fn bodies(plan: &Plan, table: &Table, hosts: &Hosts) -> Bodies {
    let mut kinds = Vec::new();
    // What an impact moves is the grain with its added mass.
    let added = |group: &Particles, diameter: f64| {
        let displaced = |water: &Water| water.density * group.shape.mass(1.0, diameter);
        plan.water.as_ref().map_or(0.0, |water| water.added_mass * displaced(water))
    };
    for (name, group) in plan.particles.iter().filter(|(_, group)| group.count > 0) {
        let (smallest, largest) = (group.smallest_diameter(), group.largest_diameter());
        let free = matches!(group.motion, GrainMotion::Free {});
        let clump = group.shape.clump();
        let ([thin, thick], lightness) = clump.map_or(([0.5; 2], 1.0), |clump| {
            // What does not turn shows all of its mass.
            (clump.contact_radii(), if plan.contact.rotation { clump.lightness() } else { 1.0 })
        });
        kinds.push(Kind {
            name: name.clone(),
            group: Some(name.clone()),
            material: table.material(&group.material),
            radius: thin * smallest,
            size: if group.shape.is_polyhedron() { 0.5 } else { thin } * smallest,
            largest: thick * largest,
            mass: if free { sizes::mass(group, smallest) / lightness + added(group, smallest) } else { f64::INFINITY },
        });
    }
    for wall in plan.walls.values() {
        // A wall on a light structure gives way in an impact: its mass is the one the structure shows.
        let host = wall.host.as_deref().and_then(|name| hosts.index(name));
        let host = host.map(|index| {
            let host = &hosts.list[index];
            host.interface(wall.interface.as_deref()).map_or(f64::INFINITY, |interface| host.shown_mass(interface))
        });
        let own = wall.servo.as_ref().map(|s| s.mass).or(wall.body.as_ref().map(|b| b.mass));
        let kind = Kind {
            name: format!("wall of {}", wall.material),
            group: None,
            material: table.material(&wall.material),
            radius: f64::INFINITY,
            size: f64::INFINITY,
            largest: f64::INFINITY,
            mass: host.or(own).unwrap_or(f64::INFINITY),
        };
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    Bodies(kinds)
}

/// Shortest natural period of the hosts [s]; infinite without hosts.
pub fn shortest_period(hosts: &Hosts) -> f64 {
    hosts
        .list
        .iter()
        .filter_map(|h| h.natural_frequencies().last().copied())
        .filter(|f| *f > 0.0)
        .map(|f| 1.0 / f)
        .fold(f64::INFINITY, f64::min)
}

/// Typical fastest relative speed [m/s]: told, or the largest of a fall through the box or down to the lowest wall, the walls' speed, the hosts'
/// speed at resonance without grains, and the speeds at the start; 1 m/s where nothing tells.
pub fn speed_scale(plan: &Plan, hosts: &Hosts) -> f64 {
    if let Some(told) = plan.speed_scale {
        return told;
    }
    let gravity = plan.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let mut speed: f64 = 0.0;
    for wall in plan.walls.values() {
        if let Shape::Box { height, .. } = &wall.shape {
            speed = speed.max((2.0 * gravity * height).sqrt());
        }
        if let Some(motion) = &wall.motion {
            speed = speed.max(drive::usual_speed(&motion.signal));
        }
    }
    // In water grains soon fall no faster.
    if plan.water.is_none() {
        speed = speed.max((2.0 * gravity * fall::height(plan)).sqrt());
    }
    // What the stream gives a grain it loses again in part before it hits.
    if let Some(water) = water::water(plan) {
        speed = speed.max(0.5 * water.fastest(water::largest(plan)));
    }
    for group in plan.particles.values() {
        match &group.start {
            Start::At { velocity, .. } => {
                speed = velocity.iter().map(size).fold(speed, f64::max);
            }
            Start::Rows { speed: start, .. } => speed = speed.max(*start),
            Start::Random { velocity, speed: start, .. } | Start::Stream { velocity, speed: start, .. } => {
                speed = speed.max(size(velocity) + start);
            }
            Start::File { grains, .. } => speed = grains.velocity.iter().map(size).fold(speed, f64::max),
            Start::Settled { .. } => {}
        }
    }
    for (host, built) in plan.hosts.values().map(plan::Host::share).zip(&hosts.list) {
        let w = built.natural_frequencies().first().map_or(0.0, |f| std::f64::consts::TAU * f);
        let ratio = built.damping_ratio().max(1e-3);
        speed = speed.max(host.velocity.abs()).max(host.displacement.abs() * w);
        if let Some(base) = &host.base {
            let moved = if host.is_shaker() { drive::usual_speed(base) } else { drive::shaken_speed(base, w, ratio) };
            speed = speed.max(moved);
        }
        let stiffness = built.effective_mass() * w * w;
        if let Some(force) = host.force.as_ref().filter(|_| stiffness > 0.0) {
            speed = speed.max(drive::pushed_speed(force, w, ratio, stiffness));
        }
    }
    if speed > 0.0 { speed } else { 1.0 }
}

fn size(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
