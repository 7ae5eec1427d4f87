//! Two of the flows of GDR MiDi 2004, in the plane: between plates that shear it under a constant pressure, and down between upright
//! walls. The incline is the case `rheology`.

mod chute;
mod shear;

pub(super) use chute::vertical_chute;
pub(super) use shear::plane_shear;

use super::beds::{law, sampled};
use super::bench::{Rig, scalars, vectors};
use tsubu_frame::{Kind, Values};

/// Stiffness of the springs in units of the pressure: grains overlap by less than a thousandth of their size.
const STIFFNESS: f64 = 2e3;
/// Restitution, as there.
const RESTITUTION: f64 = 0.1;
/// Friction of grains on grains, as there.
const FRICTION: f64 = 0.4;
/// Time between two looks, about that of a contact: the forces on a plate change as fast.
const PAUSE: f64 = 0.05;

/// The published law of plane shear, from memory: friction and share of the area at an inertial number.
fn published(inertial: f64) -> [f64; 2] {
    [0.25 + 1.1 * inertial, 0.81 - 0.3 * inertial]
}

/// Discs between two planes that grains stick to, the lower at z = 0, the upper pressed down with a pressure of 1; all in units of
/// grain diameter, grain mass and pressure.
#[derive(Clone, Copy)]
struct Flow {
    /// Length of the periodic world.
    length: f64,
    /// Discs above a unit of length.
    layers: f64,
    /// Friction of grains on grains.
    friction: f64,
    /// Speed of the lower plane along x.
    speed: f64,
    /// Gravity along x.
    gravity: f64,
    seed: u64,
}

/// The middle of the flow in the mean over time, in slabs between the planes.
struct Seen {
    /// Distance of the planes.
    height: f64,
    /// Of every slab: middle height, mean speed along x, share of the area that discs fill.
    slabs: Vec<[f64; 3]>,
    /// Force along x on the lower and the upper plane over the length, and down on the lower one.
    drag: [f64; 2],
    pressure: f64,
    /// Mean mass a unit of length.
    mass: f64,
}

/// What is seen at one time: height, speed along x and radius of every grain, force on the floor along x and up, force on the lid along x, and
/// height of the highest grain.
struct Look {
    grains: Vec<[f64; 3]>,
    floor: [f64; 2],
    lid: f64,
    top: f64,
}

impl Flow {
    fn rig(&self, perturbation: f64) -> Result<Rig, String> {
        let Self { length, layers, friction, speed, gravity, seed } = *self;
        let high = 1.8 * layers;
        let rough = if friction > 0.0 { 1.0 } else { 0.0 };
        let text = format!(
            r#"
            title = "discs between two planes"
            seed = {seed}
            gravity = [{gravity}, 0]
            duration = 10000
            periodic.x = [0, {length}]
            {law}
            [materials.plate]
            young-modulus = 1e6
            restitution = {RESTITUTION}
            friction = {friction}
            [[material-pair]]
            between = ["grain", "plate"]
            friction = {rough}
            rolling-friction = {rough}
            contact.rolling.epsd = {{}}
            [particles.discs]
            material = "grain"
            count = {count}
            size.uniform = {{ smallest = 0.8, largest = 1.2 }}
            mass = 1
            shape.disc.thickness = 1
            start.random = {{ velocity = [{middle}, 0], region = {{ low = [0, 0], high = [{length}, {high}] }} }}
            [walls.a-floor]
            material = "plate"
            shape.plane.normal = [0, 1]
            motion = {{ direction = [1, 0], signal.steady.rate = {speed} }}
            [walls.b-lid]
            material = "plate"
            shape.plane = {{ point = [0, {high}], normal = [0, -1] }}
            servo = {{ direction = [0, -1], force = {length}, mass = {length}, damping = {length} }}
            "#,
            law = law(STIFFNESS, friction, RESTITUTION),
            // The momentum of a steady shear: it would come in through the plates, and take its time.
            middle = 0.5 * speed,
            count = (length * layers) as u32,
        );
        Rig::new(&text, perturbation)
    }

    /// What it does from one time to another, in slabs of about `thick`.
    fn seen(&self, span: [f64; 2], thick: f64, perturbation: f64) -> Result<Seen, String> {
        let mut rig = self.rig(perturbation)?;
        let frame = rig.frame();
        let radii = scalars(&frame, Kind::Grain, "radius");
        let mass = scalars(&frame, Kind::Grain, "mass").iter().sum::<f64>() / self.length;
        let looks = sampled(&mut rig, [span[0], span[1], PAUSE], |rig| {
            let frame = rig.frame();
            let places = vectors(&frame, Kind::Grain, "position").into_iter();
            let grains: Vec<[f64; 3]> = places
                .zip(vectors(&frame, Kind::Grain, "velocity"))
                .zip(&radii)
                .map(|((p, v), r)| [p.z, v.x, *r])
                .collect();
            let (mut floor, mut lid) = ([0.0; 2], 0.0);
            let seconds = match frame.column(Kind::Contact, "second").map(|column| &column.values) {
                Some(Values::Integer(seconds)) => seconds.clone(),
                _ => Vec::new(),
            };
            // Forces are those on the grain.
            for (second, force) in seconds.iter().zip(vectors(&frame, Kind::Contact, "force")) {
                match second {
                    -1 => floor = [floor[0] - force.x, floor[1] - force.z],
                    -2 => lid -= force.x,
                    _ => {}
                }
            }
            let top = grains.iter().map(|g| g[0] + g[2]).fold(0.0, f64::max);
            Look { grains, floor, lid, top }
        })?;
        let times = looks.len() as f64;
        let mean = |of: fn(&Look) -> f64| looks.iter().map(of).sum::<f64>() / times;
        let height = mean(|look| look.top);
        let count = (height / thick).round().max(1.0);
        let thick = height / count;
        let slabs = (0..count as usize).map(|slab| {
            let low = slab as f64 * thick;
            let inside =
                || looks.iter().flat_map(|look| &look.grains).filter(move |g| (low..low + thick).contains(&g[0]));
            let speed = inside().map(|g| g[1]).sum::<f64>() / inside().count() as f64;
            let area = inside().map(|g| std::f64::consts::PI * g[2] * g[2]).sum::<f64>() / times;
            [low + 0.5 * thick, speed, area / (thick * self.length)]
        });
        Ok(Seen {
            height,
            slabs: slabs.collect(),
            drag: [mean(|look| look.floor[0]) / self.length, mean(|look| look.lid) / self.length],
            pressure: -mean(|look| look.floor[1]) / self.length,
            mass,
        })
    }
}
