//! Watches against known answers, each gate with something wrong that it refuses.

mod bodies;
mod coarse_grain;
mod contacts;
mod counts;
mod engines;
mod hops;
mod hydrostatic;
mod kernel;
mod orientation;
mod profile;
mod single;
mod slope;
mod stays;
mod stress_path;
mod temperature;
mod transport;
mod volumes;

use glam::DVec3;
use std::path::Path;
use tsubu::view::{Columns, Contact, View};
use tsubu::watch::{Sample, Watch, open};
use tsubu_scene::{Plan, Scene};

/// A grain as tests make it.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    pub at: DVec3,
    pub velocity: DVec3,
    pub radius: f64,
    pub mass: f64,
    pub free: bool,
    pub group: u32,
}

/// A free ball of mass 1 at rest.
pub fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
    Ball { at: DVec3::new(x, y, z), velocity: DVec3::ZERO, radius, mass: 1.0, free: true, group: 0 }
}

/// What an engine would show of these; ids count up.
pub fn view(balls: &[Ball], contacts: Vec<Contact>, ends: [Option<[f64; 2]>; 3]) -> View<'static> {
    let vectors = |of: fn(&Ball) -> DVec3| balls.iter().map(of).collect::<Vec<_>>();
    let reals = |of: fn(&Ball) -> f64| balls.iter().map(of).collect::<Vec<_>>();
    let grains = Columns {
        position: vectors(|b| b.at).into(),
        unwrap_offset: vectors(|_| DVec3::ZERO).into(),
        velocity: vectors(|b| b.velocity).into(),
        spin: vectors(|_| DVec3::ZERO).into(),
        radius: reals(|b| b.radius).into(),
        mass: reals(|b| b.mass).into(),
        inverse_mass: reals(|b| if b.free { 1.0 / b.mass } else { 0.0 }).into(),
        group: balls.iter().map(|b| b.group).collect(),
        id: (0..balls.len() as u32).collect(),
    };
    View { time: 0.0, periodic: ends, grains, contacts, ..View::default() }
}

/// Every pair that touches, also across periodic ends, pressed together with `force` [N].
pub fn touching(balls: &[Ball], ends: [Option<[f64; 2]>; 3], force: f64) -> Vec<Contact> {
    let mut contacts = Vec::new();
    for (i, a) in balls.iter().enumerate() {
        for (j, b) in balls.iter().enumerate().skip(i + 1) {
            let mut between = b.at - a.at;
            for (axis, end) in ends.iter().enumerate() {
                if let Some([low, high]) = end {
                    between[axis] -= (high - low) * (between[axis] / (high - low)).round();
                }
            }
            let overlap = a.radius + b.radius - between.length();
            if overlap > -1e-9 {
                let normal = between.normalize();
                let position = a.at + normal * (a.radius - 0.5 * overlap);
                let force = -force * normal;
                contacts.push(Contact {
                    first: i,
                    second: j,
                    wall: false,
                    position,
                    branch: between,
                    force,
                    normal,
                    overlap,
                });
            }
        }
    }
    contacts
}

/// A contact with a wall, whose point is `arm` from the centre.
pub fn on_wall(balls: &[Ball], first: usize, arm: DVec3, force: DVec3) -> Contact {
    let (normal, position) = (arm.normalize(), balls[first].at + arm);
    Contact { first, second: 0, wall: true, position, branch: arm, force, normal, overlap: 0.0 }
}

/// A scene with one watch `w`; `more` goes in front of it.
pub fn plan(dimension: u8, more: &str, watch: &str) -> Plan {
    let text = format!(
        "dimension = {dimension}\nduration = 1\n{more}\n[materials.glass]\nyoung-modulus = 1e7\ndensity = 2500\n[watch.w]\n{watch}\n"
    );
    let scene = Scene::parse("test", &text, Path::new("."), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    scene.plan().clone()
}

/// The watch of such a scene.
pub fn watch(dimension: u8, watch: &str) -> Box<dyn Watch> {
    watch_of(dimension, "", watch)
}

/// The watch of a scene with `more`.
pub fn watch_of(dimension: u8, more: &str, watch: &str) -> Box<dyn Watch> {
    let plan = plan(dimension, more, watch);
    open(&plan.watch["w"].measure, &plan)
}

/// Two groups, `a` and `b`, that watches can name.
pub const GROUPS: &str = "[particles.a]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[0, 0]]\n\
                          [particles.b]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[5, 0]]\n";

/// The scalar of a sample that is called so.
pub fn scalar(watch: &dyn Watch, sample: &Sample, name: &str) -> f64 {
    let names = watch.scalars();
    let k = names.iter().position(|n| n.split(" [").next() == Some(name));
    sample.scalars[k.unwrap_or_else(|| panic!("no `{name}` in {names:?}"))]
}

/// A column of the table of a sample.
pub fn column(watch: &dyn Watch, sample: &Sample, name: &str) -> Vec<f64> {
    let sheet = watch.sheet().unwrap();
    let names: Vec<String> = sheet.coordinates.into_iter().chain(sheet.values).collect();
    let k = names.iter().position(|n| n.split(" [").next() == Some(name));
    let k = k.unwrap_or_else(|| panic!("no `{name}` in {names:?}"));
    sample.rows.iter().map(|row| row[k]).collect()
}

/// Looks once.
pub fn once(watch: &mut dyn Watch, view: &View) -> Sample {
    let sample = watch.take(view);
    assert_eq!(sample.scalars.len(), watch.scalars().len());
    if let Some(sheet) = watch.sheet() {
        let width = sheet.coordinates.len() + sheet.values.len();
        assert!(sample.rows.iter().all(|row| row.len() == width));
    }
    sample
}

/// Whether two numbers agree to `share` of the second.
pub fn near(a: f64, b: f64, share: f64) -> bool {
    (a - b).abs() <= share * b.abs()
}

/// A number from 0 to 1, the same for the same `k`.
pub fn shaken(k: usize) -> f64 {
    (k as f64 * 0.754_877_666_246_693 + 0.3).fract()
}
