//! A vibrating structure that carries walls.
//!
//! M q'' + C (q' - r y') + K (q - r y) = w (F(t) + F_grains)
//!
//! q: generalised displacements [m], measured from the equilibrium without grains and with the structure's own weight
//! carried; y: base displacement [m]; r: how the base drives each coordinate (ones for matrices, participation for modes);
//! w: how much of each coordinate the walls see (one at `coordinate`, mode shapes for modes). Komatsuzaki 2003, eq. (1), is
//! the case of one coordinate.
//!
//! With DEM the structure moves by velocity Verlet in step with the grains (damping implicit, exact for any C); with the
//! automaton by Runge-Kutta 4 under the force of the step.

use crate::ledger::{Account, Ledger};
use crate::motion::value_and_rate;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{self, Signal, Structure};

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
    /// Unit direction of the motion.
    pub direction: [f64; 3],
    base: Option<Signal>,
    force: Option<Signal>,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    v_half: Vec<f64>,
    /// Powers at the last time level: base work, force work, damper loss [W].
    power: [f64; 3],
    /// Force of the grains at the last time level [N].
    grain_force: f64,
    work: Vec<f64>,
}

impl Host {
    /// Builds a host at time 0, without grain forces.
    pub fn new(plan: &plan::Host) -> Self {
        let (mass, damping, stiffness, seen, driven) = matrices(&plan.structure);
        let n = seen.len();
        let mut host = Self {
            n,
            mass_inverse: inverse(&mass, n),
            implicit_inverse: (f64::NAN, Vec::new()),
            mass,
            damping,
            stiffness,
            direction: plan.direction,
            base: plan.base.clone(),
            force: plan.force.clone(),
            q: seen.iter().map(|_| plan.displacement).collect(),
            v: seen.iter().map(|_| plan.velocity).collect(),
            a: vec![0.0; n],
            v_half: vec![plan.velocity; n],
            power: [0.0; 3],
            grain_force: 0.0,
            work: vec![0.0; 4 * n],
            seen,
            driven,
        };
        host.settle_acceleration(0.0);
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

    /// Acceleration that the walls see [m/s^2].
    pub fn acceleration(&self) -> f64 {
        dot(&self.seen, &self.a)
    }

    /// Force of the grains in the last step [N].
    pub fn grain_force(&self) -> f64 {
        self.grain_force
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.n
    }

    /// Undamped natural frequencies [Hz], lowest first, of the structure without grains.
    pub fn natural_frequencies(&self) -> Vec<f64> {
        let n = self.n;
        let m = nalgebra::DMatrix::from_row_slice(n, n, &self.mass);
        let k = nalgebra::DMatrix::from_row_slice(n, n, &self.stiffness);
        // K x = w^2 M x becomes symmetric with the Cholesky factor of M.
        let Some(cholesky) = m.cholesky() else { return Vec::new() };
        let Some(l_inverse) = cholesky.l().try_inverse() else { return Vec::new() };
        let symmetric = &l_inverse * k * l_inverse.transpose();
        let mut w2: Vec<f64> = symmetric.symmetric_eigenvalues().iter().copied().collect();
        w2.sort_by(f64::total_cmp);
        w2.iter().map(|w2| w2.max(0.0).sqrt() / std::f64::consts::TAU).collect()
    }

    /// Damping ratio of the lowest mode, from the damping seen along it [-].
    pub fn damping_ratio(&self) -> f64 {
        // Exact for one coordinate and for modal lists; for coupled matrices an estimate from the diagonal.
        let n = self.n;
        let ratio = |i: usize| {
            let (m, c, k) = (self.mass[i * n + i], self.damping[i * n + i], self.stiffness[i * n + i]);
            (k / m, c / (2.0 * (k * m).sqrt()))
        };
        (0..n).map(ratio).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |r| r.1)
    }

    /// Mass that walls feel when they are pushed: 1 / (w . M^-1 w) [kg].
    pub fn effective_mass(&self) -> f64 {
        let mut x = vec![0.0; self.n];
        multiply(&self.mass_inverse, &self.seen, &mut x);
        1.0 / dot(&self.seen, &x)
    }

    /// Replaces the excitation frequency of base and force sines [Hz].
    pub fn set_frequency(&mut self, hertz: f64) {
        for signal in [&mut self.base, &mut self.force].into_iter().flatten() {
            if let Signal::Sine { frequency, .. } = signal {
                *frequency = hertz;
            }
        }
        self.settle_acceleration(0.0);
    }

    /// Kinetic energy and spring energy at `time` [J].
    pub fn energy(&self, time: f64) -> (f64, f64) {
        let y = self.base(time).0;
        let stretch: Vec<f64> = self.q.iter().zip(&self.driven).map(|(q, r)| q - r * y).collect();
        (0.5 * quadratic(&self.mass, &self.v), 0.5 * quadratic(&self.stiffness, &stretch))
    }

    /// First half of a velocity-Verlet step: half kick and drift; the velocity becomes a prediction.
    pub fn before(&mut self, dt: f64) {
        for i in 0..self.n {
            self.v_half[i] = self.v[i] + 0.5 * dt * self.a[i];
            self.q[i] += dt * self.v_half[i];
            self.v[i] = self.v_half[i] + 0.5 * dt * self.a[i];
        }
    }

    /// Second half: the grains' force [N] along `direction` is known at `time`, the end of the step.
    pub fn after(&mut self, time: f64, dt: f64, grain_force: f64, ledger: &mut Ledger) {
        if self.implicit_inverse.0 != dt {
            let matrix: Vec<f64> = self.mass.iter().zip(&self.damping).map(|(m, c)| m + 0.5 * dt * c).collect();
            self.implicit_inverse = (dt, inverse(&matrix, self.n));
        }
        let (y, y_rate) = self.base(time);
        let applied = self.applied(time) + grain_force;
        let (rhs, rest) = self.work.split_at_mut(self.n);
        for i in 0..self.n {
            rest[i] = self.v_half[i] - self.driven[i] * y_rate;
            rest[self.n + i] = self.q[i] - self.driven[i] * y;
        }
        for i in 0..self.n {
            let row = i * self.n..(i + 1) * self.n;
            rhs[i] = self.seen[i] * applied
                - dot(&self.damping[row.clone()], &rest[..self.n])
                - dot(&self.stiffness[row], &rest[self.n..2 * self.n]);
        }
        multiply(&self.implicit_inverse.1, rhs, &mut self.a);
        for i in 0..self.n {
            self.v[i] = self.v_half[i] + 0.5 * dt * self.a[i];
        }
        ledger.host_impulse += 0.5 * dt * (self.grain_force + grain_force);
        self.grain_force = grain_force;
        self.post(time, dt, ledger);
    }

    /// One Runge-Kutta 4 step from `time` under a constant force of the grains [N].
    pub fn runge_kutta(&mut self, time: f64, dt: f64, grain_force: f64, ledger: &mut Ledger) {
        let n = self.n;
        let (q0, v0) = (self.q.clone(), self.v.clone());
        let mut k = [[0.0; 2]; 4];
        if n == 1 {
            // The common case, without a heap in sight: Komatsuzaki's single degree of freedom.
            let (m, c, s) = (self.mass[0], self.damping[0], self.stiffness[0]);
            let (w, r) = (self.seen[0], self.driven[0]);
            let slope = |host: &Self, t: f64, q: f64, v: f64| {
                let (y, y_rate) = host.base(t);
                let f = w * (host.applied(t) + grain_force) - c * (v - r * y_rate) - s * (q - r * y);
                [v, f / m]
            };
            k[0] = slope(self, time, q0[0], v0[0]);
            k[1] = slope(self, time + 0.5 * dt, q0[0] + 0.5 * dt * k[0][0], v0[0] + 0.5 * dt * k[0][1]);
            k[2] = slope(self, time + 0.5 * dt, q0[0] + 0.5 * dt * k[1][0], v0[0] + 0.5 * dt * k[1][1]);
            k[3] = slope(self, time + dt, q0[0] + dt * k[2][0], v0[0] + dt * k[2][1]);
            let sum = |i: usize| dt / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
            self.q[0] = q0[0] + sum(0);
            self.v[0] = v0[0] + sum(1);
        } else {
            self.runge_kutta_many(time, dt, grain_force, &q0, &v0);
        }
        self.grain_force = grain_force;
        ledger.host_impulse += dt * grain_force;
        self.settle_acceleration(time + dt);
        self.post(time + dt, dt, ledger);
    }

    fn runge_kutta_many(&mut self, time: f64, dt: f64, grain_force: f64, q0: &[f64], v0: &[f64]) {
        let n = self.n;
        self.grain_force = grain_force;
        let (mut dq, mut dv) = (vec![0.0; n], vec![0.0; n]);
        let (mut kq, mut kv) = (vec![0.0; n], vec![0.0; n]);
        for (fraction, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            for i in 0..n {
                self.q[i] = q0[i] + fraction * dt * kq[i];
                self.v[i] = v0[i] + fraction * dt * kv[i];
            }
            self.settle_acceleration(time + fraction * dt);
            for i in 0..n {
                kq[i] = self.v[i];
                kv[i] = self.a[i];
                dq[i] += weight / 6.0 * kq[i];
                dv[i] += weight / 6.0 * kv[i];
            }
        }
        for i in 0..n {
            self.q[i] = q0[i] + dt * dq[i];
            self.v[i] = v0[i] + dt * dv[i];
        }
    }

    /// Writes the state under `name`.
    pub fn save(&self, name: &str, state: &mut State) {
        let mut values = Vec::with_capacity(3 * self.n + 4);
        values.extend(&self.q);
        values.extend(&self.v);
        values.extend(&self.a);
        values.extend(self.power);
        values.push(self.grain_force);
        state.put_real(name, values);
    }

    /// Takes the state back.
    pub fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let values = state.real(name)?;
        let n = self.n;
        if values.len() != 3 * n + 4 {
            return Err(MissingSection { name: name.to_owned(), kind: "real" });
        }
        self.q.copy_from_slice(&values[..n]);
        self.v.copy_from_slice(&values[n..2 * n]);
        self.a.copy_from_slice(&values[2 * n..3 * n]);
        self.power.copy_from_slice(&values[3 * n..3 * n + 3]);
        self.grain_force = values[3 * n + 3];
        Ok(())
    }

    fn base(&self, time: f64) -> (f64, f64) {
        self.base.as_ref().map_or((0.0, 0.0), |s| value_and_rate(s, time))
    }

    fn applied(&self, time: f64) -> f64 {
        self.force.as_ref().map_or(0.0, |s| value_and_rate(s, time).0)
    }

    /// Acceleration from the present q, v and grain force.
    fn settle_acceleration(&mut self, time: f64) {
        let (y, y_rate) = self.base(time);
        let applied = self.applied(time) + self.grain_force;
        let (rhs, rest) = self.work.split_at_mut(self.n);
        for i in 0..self.n {
            rest[i] = self.v[i] - self.driven[i] * y_rate;
            rest[self.n + i] = self.q[i] - self.driven[i] * y;
        }
        for i in 0..self.n {
            let row = i * self.n..(i + 1) * self.n;
            rhs[i] = self.seen[i] * applied
                - dot(&self.damping[row.clone()], &rest[..self.n])
                - dot(&self.stiffness[row], &rest[self.n..2 * self.n]);
        }
        multiply(&self.mass_inverse, rhs, &mut self.a);
        self.power = self.powers(time);
    }

    /// Base work, force work and damper loss per time at this time level [W].
    fn powers(&self, time: f64) -> [f64; 3] {
        let (y, y_rate) = self.base(time);
        let mut base = 0.0;
        let mut damper = 0.0;
        for i in 0..self.n {
            let mut spring_force = 0.0;
            let mut damper_force = 0.0;
            for j in 0..self.n {
                spring_force += self.stiffness[i * self.n + j] * (self.q[j] - self.driven[j] * y);
                damper_force += self.damping[i * self.n + j] * (self.v[j] - self.driven[j] * y_rate);
            }
            base -= (spring_force + damper_force) * self.driven[i] * y_rate;
            damper += damper_force * (self.v[i] - self.driven[i] * y_rate);
        }
        [base, self.applied(time) * self.velocity(), damper]
    }

    /// Posts the work of the step that ended at `time`, by the trapezoidal rule.
    fn post(&mut self, time: f64, dt: f64, ledger: &mut Ledger) {
        let now = self.powers(time);
        let accounts = [Account::BaseWork, Account::ForceWork, Account::HostDamping];
        for (account, (old, new)) in accounts.into_iter().zip(self.power.into_iter().zip(now)) {
            ledger.post(account, 0.5 * dt * (old + new));
        }
        self.power = now;
    }
}

type Matrices = (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>);

/// M, C, K (row by row), w and r of a structure.
fn matrices(structure: &Structure) -> Matrices {
    match structure {
        Structure::Oscillator { mass, stiffness, damping } => {
            (vec![*mass], vec![*damping], vec![*stiffness], vec![1.0], vec![1.0])
        }
        Structure::Matrices { mass, damping, stiffness, coordinate } => {
            let n = mass.len();
            let seen = (0..n).map(|i| f64::from(u8::from(i == *coordinate))).collect();
            (mass.concat(), damping.concat(), stiffness.concat(), seen, vec![1.0; n])
        }
        Structure::Modes { mode } => {
            let n = mode.len();
            let mut m = vec![0.0; n * n];
            let mut c = m.clone();
            let mut k = m.clone();
            for (i, mode) in mode.iter().enumerate() {
                let w = std::f64::consts::TAU * mode.frequency;
                m[i * n + i] = mode.mass;
                c[i * n + i] = 2.0 * mode.damping_ratio * mode.mass * w;
                k[i * n + i] = mode.mass * w * w;
            }
            (m, c, k, mode.iter().map(|m| m.shape).collect(), mode.iter().map(|m| m.participation).collect())
        }
    }
}

/// Inverse of a positive definite matrix (the scene reader refuses others).
fn inverse(matrix: &[f64], n: usize) -> Vec<f64> {
    if n == 1 {
        return vec![1.0 / matrix[0]];
    }
    let inverse = nalgebra::DMatrix::from_row_slice(n, n, matrix).try_inverse();
    inverse.map_or_else(|| vec![f64::NAN; n * n], |m| m.transpose().as_slice().to_vec())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn multiply(matrix: &[f64], x: &[f64], out: &mut [f64]) {
    let n = x.len();
    for (i, out) in out.iter_mut().enumerate() {
        *out = dot(&matrix[i * n..(i + 1) * n], x);
    }
}

fn quadratic(matrix: &[f64], x: &[f64]) -> f64 {
    let n = x.len();
    (0..n).map(|i| x[i] * dot(&matrix[i * n..(i + 1) * n], x)).sum()
}
