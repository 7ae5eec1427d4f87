//! Two spheres, or a sphere and a fixed plane, that meet under a law; and nothing else.

use super::Subject;
use glam::DVec3;
use tsubu::contact::chunk::Chunk;

/// A sphere; as the second body with an infinite radius, a fixed plane whose point nearest to the first is found.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    pub radius: f64,
    pub mass: f64,
    pub position: DVec3,
    pub velocity: DVec3,
    pub spin: DVec3,
}

impl Ball {
    /// A sphere at rest.
    pub fn new(radius: f64, density: f64, position: DVec3) -> Self {
        let mass = 4.0 / 3.0 * std::f64::consts::PI * density * radius.powi(3);
        Self { radius, mass, position, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }

    /// The plane z = 0, grains above.
    pub fn plane() -> Self {
        let zero = DVec3::ZERO;
        Self { radius: f64::INFINITY, mass: f64::INFINITY, position: zero, velocity: zero, spin: zero }
    }
}

/// Two bodies and the row they meet in.
pub struct Two<'a> {
    pub subject: &'a Subject,
    pub balls: [Ball; 2],
    pub chunk: Box<Chunk>,
    /// Largest overlap [m] and normal force [N] so far, and the time [s] in contact.
    pub deepest: f64,
    pub strongest: f64,
    pub touched: f64,
    action: [[DVec3; 2]; 2],
}

impl<'a> Two<'a> {
    pub fn new(subject: &'a Subject, balls: [Ball; 2]) -> Self {
        let chunk = subject.chunk(1);
        let (deepest, strongest, touched) = (0.0, 0.0, 0.0);
        Self { subject, balls, chunk, deepest, strongest, touched, action: [[DVec3::ZERO; 2]; 2] }
    }

    /// Fills the row with the geometry and motion of the bodies. Returns the arms.
    pub fn fill(&mut self) -> [f64; 2] {
        let [a, b] = &self.balls;
        let wall = b.radius.is_infinite();
        let between = if wall { DVec3::new(0.0, 0.0, -a.position.z) } else { b.position - a.position };
        let (distance, normal) = (between.length(), between.normalize());
        let overlap = if wall { a.radius - distance } else { a.radius + b.radius - distance };
        let arms = [a.radius - 0.5 * overlap, if wall { 0.0 } else { b.radius - 0.5 * overlap }];
        let relative = a.velocity - b.velocity + (a.spin * arms[0] + b.spin * arms[1]).cross(normal);
        let (closing, spin) = (relative.dot(normal), a.spin - b.spin);
        let c = &mut self.chunk;
        (c.overlap[0], c.closing[0], c.twist[0]) = (overlap, closing, spin.dot(normal));
        c.effective_radius[0] = 1.0 / (1.0 / a.radius + 1.0 / b.radius);
        c.effective_mass[0] = 1.0 / (1.0 / a.mass + 1.0 / b.mass);
        Chunk::set(&mut c.normal, 0, normal);
        Chunk::set(&mut c.slip, 0, relative - normal * closing);
        Chunk::set(&mut c.roll, 0, spin - normal * spin.dot(normal));
        arms
    }

    /// Force and torque on both bodies, by the row.
    fn act(&mut self, dt: f64) {
        let arms = self.fill();
        let reach =
            self.subject.law.reach(&self.subject.pair(self.chunk.effective_radius[0], self.chunk.effective_mass[0]));
        if self.chunk.overlap[0] <= -reach {
            self.chunk.history.iter_mut().for_each(|column| column[0] = 0.0);
            self.action = [[DVec3::ZERO; 2]; 2];
            return;
        }
        self.chunk.completion = 0.5 * dt;
        self.subject.apply(&mut self.chunk, dt);
        let c = &self.chunk;
        let normal = Chunk::vector(&c.normal, 0);
        let tangential = Chunk::vector(&c.tangential_force, 0);
        let force = tangential - normal * c.normal_force[0];
        let torque = Chunk::vector(&c.torque, 0);
        let turn = normal.cross(tangential);
        self.action = [[force, turn * arms[0] + torque], [-force, turn * arms[1] - torque]];
        self.deepest = self.deepest.max(c.overlap[0]);
        self.strongest = self.strongest.max(c.normal_force[0]);
        self.touched += if c.overlap[0] > 0.0 { dt } else { 0.0 };
    }

    /// A step of velocity Verlet; forces that depend on velocity see it predicted to the end of the step.
    pub fn step(&mut self, dt: f64) {
        let old = self.action;
        let half = self.balls.map(|b| b.velocity);
        let half_spin = self.balls.map(|b| b.spin);
        for (k, ball) in self.balls.iter_mut().enumerate().filter(|(_, b)| b.mass.is_finite()) {
            let inertia = 0.4 * ball.mass * ball.radius * ball.radius;
            ball.velocity = half[k] + old[k][0] * (dt / ball.mass);
            ball.spin = half_spin[k] + old[k][1] * (dt / inertia);
            ball.position += (half[k] + old[k][0] * (0.5 * dt / ball.mass)) * dt;
        }
        self.act(dt);
        for (k, ball) in self.balls.iter_mut().enumerate().filter(|(_, b)| b.mass.is_finite()) {
            let inertia = 0.4 * ball.mass * ball.radius * ball.radius;
            ball.velocity = half[k] + (old[k][0] + self.action[k][0]) * (0.5 * dt / ball.mass);
            ball.spin = half_spin[k] + (old[k][1] + self.action[k][1]) * (0.5 * dt / inertia);
        }
    }

    /// Steps until the bodies have met and parted, or `most` steps have gone by.
    pub fn meet(&mut self, dt: f64, most: usize) {
        let mut met = false;
        for _ in 0..most {
            self.step(dt);
            let overlap = self.chunk.overlap[0];
            met |= overlap > 0.0;
            let apart = self.action[0][0] == DVec3::ZERO && self.chunk.closing[0] < 0.0;
            if met && apart && overlap <= 0.0 {
                return;
            }
        }
    }
}
