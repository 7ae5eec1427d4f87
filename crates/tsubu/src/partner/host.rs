//! A vibrating structure that carries walls.
//!
//! M q'' + (C + speed G) (q' - r y') + K (q - r y) = w F(t) + F_grains
//!
//! q: generalised displacements [m], measured from the equilibrium without grains and with the structure's own weight
//! carried; y: base displacement [m]; r: how the base drives each coordinate (ones for matrices, participation for modes);
//! w: how much of each coordinate is told and takes the force (one at `coordinate`, mode shapes for modes); F_grains: what grains do to
//! each coordinate, by the interfaces that their walls hang on. Komatsuzaki 2003, eq. (1), is the case of one coordinate.
//!
//! With DEM the structure moves by velocity Verlet in step with the grains (damping implicit, exact for any C); with the
//! automaton by Runge-Kutta 4 under the force of the step.

mod base_force;
mod dwell;
mod in_motion;
mod interface;
mod matrices;
mod runge_kutta;
mod shaker;
mod state;
mod steered;
mod whirl;

pub use dwell::Dwelling;
pub use in_motion::Ballast;
pub use interface::{Interface, Placed};

use crate::ledger::{Account, Ledger};
use crate::motion::value_and_rate;
use dwell::Dwell;
use matrices::{dot, inverse, matrices, multiply, quadratic};
use steered::Piece;
use tsubu_scene::plan::{self, Keep, Signal};

/// A structure in motion.
#[derive(Clone, Debug)]
pub struct Host {
    n: usize,
    mass: Vec<f64>,
    damping: Vec<f64>,
    stiffness: Vec<f64>,
    /// Inverse of M, and of M + C dt/2 for the dt it was made for.
    mass_inverse: Vec<f64>,
    implicit_inverse: (f64, Vec<f64>),
    seen: Vec<f64>,
    driven: Vec<f64>,
    /// Whether it is where its base is, whatever it feels.
    shaker: bool,
    /// Where walls hang: first what moves along `direction`, then those with names.
    interfaces: Vec<Interface>,
    /// Moment of its own weight [N.m] and angle at time 0 [rad] of a pendulum.
    weight: Option<(f64, f64)>,
    /// k3 of an oscillator's spring [N/m^3].
    cubic: f64,
    /// Unit direction of the motion.
    pub direction: [f64; 3],
    base: Option<Signal>,
    /// Where its base goes, once somebody outside moves it.
    steered: Option<Piece>,
    force: Option<Signal>,
    dwell: Option<Dwell>,
    /// Since when they drive it [s].
    driven_since: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    v_half: Vec<f64>,
    /// Powers at the last time level: base work, force work, damper loss [W].
    power: [f64; 3],
    /// Force of the grains along `direction` at the last time level [N], and what they do to each coordinate.
    grain_force: f64,
    felt: Vec<f64>,
    /// The same of the step that is being made.
    heard: (f64, Vec<f64>),
    work: Vec<f64>,
}

impl Host {
    /// Builds a host at time 0, without grain forces.
    pub fn new(plan: &plan::Host) -> Self {
        let plan = &plan.share();
        let (mass, damping, stiffness, mut seen, driven) = matrices(&plan.structure);
        let n = seen.len();
        let interfaces = Interface::all(plan, &mut seen);
        let weight = match plan.structure {
            plan::Structure::Pendulum { moment, angle, .. } => Some((moment, angle)),
            _ => None,
        };
        let mut host = Self {
            n,
            mass_inverse: inverse(&mass, n),
            implicit_inverse: (f64::NAN, Vec::new()),
            mass,
            damping,
            stiffness,
            shaker: plan.is_shaker(),
            direction: plan.direction,
            base: plan.base.clone(),
            steered: None,
            force: plan.force.clone(),
            dwell: None,
            driven_since: 0.0,
            q: seen.iter().map(|_| plan.displacement).collect(),
            v: seen.iter().map(|_| plan.velocity).collect(),
            a: vec![0.0; n],
            v_half: vec![plan.velocity; n],
            power: [0.0; 3],
            grain_force: 0.0,
            felt: vec![0.0; n],
            heard: (0.0, vec![0.0; n]),
            work: vec![0.0; 4 * n],
            seen,
            driven,
            interfaces,
            weight,
            cubic: match plan.structure {
                plan::Structure::Oscillator { cubic_stiffness, .. } => cubic_stiffness,
                _ => 0.0,
            },
        };
        host.settle_acceleration(0.0);
        host.power = host.powers(host.drive(0.0));
        host.begin_dwell(plan.dwell.as_ref());
        host
    }

    /// Displacement that the walls see [m].
    pub fn displacement(&self) -> f64 {
        dot(&self.seen, &self.q)
    }

    /// Velocity that the walls see [m/s]; between `before` and `after` the one predicted for the end of the step.
    pub fn velocity(&self) -> f64 {
        dot(&self.seen, &self.v)
    }

    /// Force of the grains in the last step [N].
    pub fn grain_force(&self) -> f64 {
        self.grain_force
    }

    /// Undamped natural frequencies [Hz], lowest first, of the structure without grains; of a rotor those of its whirl at its speed.
    pub fn natural_frequencies(&self) -> Vec<f64> {
        if let Some(whirl) = self.whirl() {
            return whirl;
        }
        self.undamped().into_iter().map(|(frequency, _)| frequency).collect()
    }

    /// Mass of the lowest mode, where its displacement is told [kg]: the structure near that resonance is an oscillator of this mass.
    pub fn modal_mass(&self) -> f64 {
        self.undamped().first().map_or(f64::NAN, |(_, seen)| 1.0 / (seen * seen))
    }

    /// Natural frequency [Hz] and modal mass [kg] of the mode in which what is told moves most for its energy; none of a shaker.
    pub fn livest_mode(&self) -> Option<[f64; 2]> {
        let modes = self.undamped().into_iter().map(|(frequency, seen)| [frequency, 1.0 / (seen * seen)]);
        modes.min_by(|a, b| a[1].total_cmp(&b[1]))
    }

    /// Natural frequencies [Hz] of the undamped modes, lowest first, and what is seen of each when its modal mass is one [1/sqrt(kg)].
    fn undamped(&self) -> Vec<(f64, f64)> {
        if self.shaker {
            return Vec::new();
        }
        let n = self.n;
        let m = nalgebra::DMatrix::from_row_slice(n, n, &self.mass);
        let k = nalgebra::DMatrix::from_row_slice(n, n, &self.stiffness);
        // K x = w^2 M x becomes symmetric with the Cholesky factor of M.
        let Some(cholesky) = m.cholesky() else { return Vec::new() };
        let Some(l_inverse) = cholesky.l().try_inverse() else { return Vec::new() };
        let hanging = nalgebra::DMatrix::from_element(n, n, self.weight.map_or(0.0, |(moment, _)| moment));
        let modes = (&l_inverse * (k + hanging) * l_inverse.transpose()).symmetric_eigen();
        let vectors = l_inverse.transpose() * modes.eigenvectors;
        let seen = vectors.column_iter().map(|x| x.iter().zip(&self.seen).map(|(x, w)| x * w).sum());
        let frequency = |w2: &f64| w2.max(0.0).sqrt() / std::f64::consts::TAU;
        let mut found: Vec<(f64, f64)> = modes.eigenvalues.iter().map(frequency).zip(seen).collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
    }

    /// Damping ratio of the lowest mode, from the damping seen along it [-].
    pub fn damping_ratio(&self) -> f64 {
        // Exact for one coordinate and for modal lists; for coupled matrices an estimate from the diagonal.
        let n = self.n;
        let ratio = |i: usize| {
            let hanging = self.weight.map_or(0.0, |(moment, _)| moment);
            let (m, c, k) = (self.mass[i * n + i], self.damping[i * n + i], self.stiffness[i * n + i] + hanging);
            (k / m, c / (2.0 * (k * m).sqrt()))
        };
        (0..n).map(ratio).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |r| r.1)
    }

    /// Mass that the structure shows to a push along its direction: 1 / (w . M^-1 w) [kg].
    pub fn effective_mass(&self) -> f64 {
        1.0 / self.mobility(&self.seen)
    }

    /// w . M^-1 w: the acceleration of a point that sees `w` of each coordinate, over the force on it [1/kg].
    fn mobility(&self, w: &[f64]) -> f64 {
        let mut x = vec![0.0; self.n];
        multiply(&self.mass_inverse, w, &mut x);
        dot(w, &x)
    }

    /// Replaces the frequency [Hz] of base and force sines.
    pub fn set_frequency(&mut self, hertz: f64, keep: Keep) {
        for (signal, keep) in [(&mut self.base, keep), (&mut self.force, Keep::Displacement)] {
            if let Some(Signal::Sine { amplitude, frequency, .. }) = signal {
                *amplitude *= keep.amplitude(hertz, *frequency);
                *frequency = hertz;
            }
        }
        self.settle_acceleration(0.0);
        self.power = self.powers(self.drive(0.0));
    }

    /// The same at `time` [s] of a run; the phase goes on.
    pub fn go_over_to(&mut self, hertz: f64, keep: Keep, time: f64) {
        let since = time - self.driven_since;
        for signal in [&mut self.base, &mut self.force].into_iter().flatten() {
            if let Signal::Sine { frequency, phase, .. } = signal {
                let turns = (*frequency - hertz) * since;
                *phase += std::f64::consts::TAU * (turns - turns.floor());
            }
        }
        self.set_frequency(hertz, keep);
        self.settle_acceleration(time);
        self.power = self.powers(self.drive(time));
    }

    /// At time 0 of another clock: base and force begin now.
    pub fn begin_anew(&mut self) {
        self.driven_since = 0.0;
        self.settle_acceleration(0.0);
        self.power = self.powers(self.drive(0.0));
    }

    /// Another stage of a run begins at `time` [s]: from then on base and force are those of `plan`.
    pub fn change(&mut self, plan: &plan::Host, time: f64) {
        let plan = &plan.share();
        if (&self.base, &self.force) != (&plan.base, &plan.force) {
            (self.base, self.force, self.driven_since) = (plan.base.clone(), plan.force.clone(), time);
            self.begin_dwell(plan.dwell.as_ref());
        }
        // Of a pendulum gravity may have changed.
        if let (Some(weight), plan::Structure::Pendulum { moment, .. }) = (&mut self.weight, &plan.structure) {
            weight.0 = *moment;
        }
        self.settle_acceleration(time);
        self.power = self.powers(self.drive(time));
    }

    /// Kinetic energy and spring energy at `time` [J].
    pub fn energy(&self, time: f64) -> (f64, f64) {
        if self.shaker {
            return (0.0, 0.0);
        }
        let y = self.base(time).0;
        let stretch: Vec<f64> = self.q.iter().zip(&self.driven).map(|(q, r)| q - r * y).collect();
        // 1 - cos(a) would lose what small angles store.
        let raised = |(moment, angle): (f64, f64)| 2.0 * moment * (0.5 * (self.q[0] + angle)).sin().powi(2);
        let stored = 0.5 * quadratic(&self.stiffness, &stretch)
            + self.weight.map_or(0.0, raised)
            + 0.25 * self.cubic * stretch[0].powi(4);
        (0.5 * quadratic(&self.mass, &self.v), stored)
    }

    /// First half of a velocity-Verlet step that ends at `time` [s]: half kick and drift; the velocity becomes a prediction.
    pub fn before(&mut self, time: f64, dt: f64) {
        if self.shaker {
            return self.follow_base(time);
        }
        for i in 0..self.n {
            self.v_half[i] = self.v[i] + 0.5 * dt * self.a[i];
            self.q[i] += dt * self.v_half[i];
            self.v[i] = self.v_half[i] + 0.5 * dt * self.a[i];
        }
    }

    /// Second half: what the grains do has been [heard](Host::hear) for `time`, the end of the step.
    pub fn after(&mut self, time: f64, dt: f64, ledger: &mut Ledger) {
        if self.implicit_inverse.0 != dt {
            let matrix: Vec<f64> = self.mass.iter().zip(&self.damping).map(|(m, c)| m + 0.5 * dt * c).collect();
            self.implicit_inverse = (dt, inverse(&matrix, self.n));
        }
        let drive = self.drive(time);
        let grain_force = self.heard.0;
        std::mem::swap(&mut self.felt, &mut self.heard.1);
        self.heard.0 = 0.0;
        self.heard.1.fill(0.0);
        if !self.shaker {
            self.net_force(drive, true);
            multiply(&self.implicit_inverse.1, &self.work[..self.n], &mut self.a);
            for i in 0..self.n {
                self.v[i] = self.v_half[i] + 0.5 * dt * self.a[i];
            }
        }
        ledger.host_impulse += 0.5 * dt * (self.grain_force + grain_force);
        self.grain_force = grain_force;
        self.post(drive, dt, ledger);
        self.follow_resonance(time, dt);
    }

    fn base(&self, time: f64) -> (f64, f64) {
        match (&self.steered, &self.base) {
            (Some(piece), _) => piece.at(time),
            (None, Some(signal)) => value_and_rate(signal, time - self.driven_since),
            (None, None) => (0.0, 0.0),
        }
    }

    fn drive(&self, time: f64) -> Drive {
        let (y, y_rate) = self.base(time);
        Drive { y, y_rate, applied: self.applied(time) }
    }

    /// Applied force at `time` [s] [N].
    pub fn applied(&self, time: f64) -> f64 {
        self.force.as_ref().map_or(0.0, |s| value_and_rate(s, time - self.driven_since).0)
    }

    /// Puts all forces on the coordinates into the first n entries of `work`; the dampers see the half-step velocities or
    /// the present ones.
    fn net_force(&mut self, drive: Drive, half: bool) {
        let n = self.n;
        let Drive { y, y_rate, applied } = drive;
        let velocity = if half { &self.v_half } else { &self.v };
        let (force, rest) = self.work.split_at_mut(n);
        let (rates, stretches) = rest.split_at_mut(n);
        for i in 0..n {
            rates[i] = velocity[i] - self.driven[i] * y_rate;
            stretches[i] = self.q[i] - self.driven[i] * y;
        }
        for (i, force) in force.iter_mut().enumerate() {
            let row = i * n..(i + 1) * n;
            *force = (self.seen[i] * applied + self.felt[i])
                - dot(&self.damping[row.clone()], rates)
                - dot(&self.stiffness[row], &stretches[..n]);
        }
        if self.cubic != 0.0 {
            force[0] -= self.cubic * stretches[0].powi(3);
        }
        if let Some((moment, angle)) = self.weight {
            force[0] -= moment * (self.q[0] + angle).sin();
        }
    }

    /// Acceleration from the present q, v and grain force; a shaker goes to where its base is.
    fn settle_acceleration(&mut self, time: f64) {
        if self.shaker {
            return self.follow_base(time);
        }
        let drive = self.drive(time);
        self.net_force(drive, false);
        multiply(&self.mass_inverse, &self.work[..self.n], &mut self.a);
    }

    /// Base work, force work and damper loss per time at this time level [W].
    fn powers(&self, drive: Drive) -> [f64; 3] {
        let Drive { y, y_rate, applied } = drive;
        if self.shaker {
            return self.power_of_shaker(y_rate);
        }
        let mut base = 0.0;
        let mut damper = 0.0;
        for i in 0..self.n {
            let mut spring_force = 0.0;
            let mut damper_force = 0.0;
            for j in 0..self.n {
                spring_force += self.stiffness[i * self.n + j] * (self.q[j] - self.driven[j] * y);
                damper_force += self.damping[i * self.n + j] * (self.v[j] - self.driven[j] * y_rate);
            }
            if self.cubic != 0.0 {
                spring_force += self.cubic * (self.q[i] - self.driven[i] * y).powi(3);
            }
            base -= (spring_force + damper_force) * self.driven[i] * y_rate;
            damper += damper_force * (self.v[i] - self.driven[i] * y_rate);
        }
        [base, applied * self.velocity(), damper]
    }

    /// Posts the work of the step that ended at `time`, by the trapezoidal rule.
    fn post(&mut self, drive: Drive, dt: f64, ledger: &mut Ledger) {
        let now = self.powers(drive);
        let accounts = [Account::BaseWork, Account::ForceWork, Account::HostDamping];
        for (account, (old, new)) in accounts.into_iter().zip(self.power.into_iter().zip(now)) {
            ledger.post(account, 0.5 * dt * (old + new));
        }
        self.power = now;
    }
}

/// What drives a structure at one time: evaluated once a time level, for the motion and for the books.
#[derive(Clone, Copy)]
struct Drive {
    y: f64,
    y_rate: f64,
    applied: f64,
}
