//! A sphere or disc thrown at a plane, in the plane of the picture: the bench of all single impacts.

use super::bench::{Rig, scalars, vectors};
use glam::DVec3;
use tsubu_frame::Kind;

/// What is thrown at what.
#[derive(Clone, Debug)]
pub(super) struct Throw<'a> {
    /// Young's modulus [Pa].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density [kg/m^3].
    pub density: f64,
    /// Radius [m].
    pub radius: f64,
    /// Restitution and friction of the pair.
    pub restitution: f64,
    /// Friction coefficient of the pair.
    pub friction: f64,
    /// Velocity along x and towards the plane [m/s].
    pub velocity: [f64; 2],
    /// Spin about y: positive rolls towards x [rad/s].
    pub spin: f64,
    /// Young's modulus of the plane over that of the sphere.
    pub wall: f64,
    /// What `[contact]` says.
    pub law: &'a str,
    /// The shape entry of the grain.
    pub shape: &'a str,
    /// Steps per contact.
    pub steps: f64,
}

impl Default for Throw<'_> {
    fn default() -> Self {
        Self {
            young: 70e9,
            poisson: 0.33,
            density: 2700.0,
            radius: 2.5e-3,
            restitution: 1.0,
            friction: 0.0,
            velocity: [0.0, 1.0],
            spin: 0.0,
            wall: 1e9,
            law: "tangential.none = {}",
            shape: "sphere = {}",
            steps: 2000.0,
        }
    }
}

/// What was seen of the impact.
pub(super) struct Seen {
    /// Largest force [N].
    pub force: f64,
    /// Largest overlap [m].
    pub overlap: f64,
    /// Time in contact [s].
    pub time: f64,
    /// Velocity afterwards: along x, and away from the plane [m/s].
    pub velocity: [f64; 2],
    /// Spin about y afterwards [rad/s].
    pub spin: f64,
    /// Residual of the energy's books over the energy turned over.
    pub residual: f64,
}

impl Throw<'_> {
    /// The scene.
    pub fn scene(&self) -> String {
        let Self { young, poisson, density, radius, restitution, friction, velocity, spin, law, shape, steps, wall } =
            self;
        let speed = velocity[1];
        let gap = 1e-4 * radius;
        format!(
            r#"
            title = "a sphere thrown at a plane"
            gravity = 0
            duration = {duration:e}
            speed-scale = {speed:e}
            [materials.ball]
            young-modulus = {young:e}
            poisson-ratio = {poisson}
            density = {density:e}
            restitution = {restitution}
            friction = {friction}
            [materials.plane]
            young-modulus = {plane:e}
            poisson-ratio = {poisson}
            restitution = {restitution}
            friction = {friction}
            [particles.ball]
            material = "ball"
            diameter = {diameter:e}
            shape.{shape}
            start.at = {{ position = [[0, {height:e}]], velocity = [[{along:e}, {down:e}]], spin = [{spin:e}] }}
            [walls.plane]
            material = "plane"
            shape.plane = {{}}
            [contact]
            {law}
            [dem]
            steps-per-contact = {steps}
            largest-overlap = 0.5
            "#,
            duration = 10.0 * radius / speed,
            plane = young * wall,
            diameter = 2.0 * radius,
            height = radius + gap,
            along = velocity[0],
            down = -speed,
        )
    }

    /// Throws it.
    pub fn go(&self, perturbation: f64) -> Result<Seen, String> {
        let mut rig = Rig::new(&self.scene(), perturbation)?;
        let (force, overlap, time) = watch(&mut rig)?;
        let (velocity, spin) = (rig.vector("velocity", 0), rig.vector("spin", 0));
        let residual = rig.residual();
        Ok(Seen { force, overlap, time, velocity: [velocity.x, velocity.z], spin: spin.y, residual })
    }
}

/// Goes through an impact: largest force [N], largest overlap [m], and time in contact [s].
pub(super) fn watch(rig: &mut Rig) -> Result<(f64, f64, f64), String> {
    let dt = rig.engine.time_step();
    let (mut force, mut overlap, mut touching) = (0.0f64, 0.0f64, 0u64);
    let last = (rig.plan.duration / dt) as u64;
    while rig.engine.steps() < last && (touching == 0 || rig.engine.contacts() > 0) {
        rig.steps(1)?;
        if rig.engine.contacts() > 0 {
            touching += 1;
            let frame = rig.frame();
            force = vectors(&frame, Kind::Contact, "force").iter().map(|f| DVec3::length(*f)).fold(force, f64::max);
            overlap = scalars(&frame, Kind::Contact, "overlap").into_iter().fold(overlap, f64::max);
        }
    }
    Ok((force, overlap, touching as f64 * dt))
}
