//! A host moved by Runge-Kutta 4 under a force that is constant in the step, as an automaton gives it.

use super::Host;
use crate::ledger::{Account, Ledger};
use crate::motion::value_and_rate;
use tsubu_scene::plan::Signal;

impl Host {
    /// One Runge-Kutta 4 step from `time` under a constant force of the grains [N].
    pub fn runge_kutta(&mut self, time: f64, dt: f64, grain_force: f64, ledger: &mut Ledger) {
        ledger.host_impulse += dt * grain_force;
        for (felt, seen) in self.felt.iter_mut().zip(&self.seen) {
            *felt = seen * grain_force;
        }
        if self.shaker {
            return self.shaken_step(time, dt, grain_force, ledger);
        }
        if self.n == 1 {
            self.runge_kutta_one(time, dt, grain_force, ledger);
            return self.follow_resonance(time + dt, dt);
        }
        let (q0, v0) = (self.q.clone(), self.v.clone());
        self.runge_kutta_many(time, dt, grain_force, &q0, &v0);
        self.grain_force = grain_force;
        self.settle_acceleration(time + dt);
        self.post(self.drive(time + dt), dt, ledger);
        self.follow_resonance(time + dt, dt);
    }

    /// The common case, without a heap or a loop in sight: Komatsuzaki's single degree of freedom. An automaton's step is
    /// so short that the sines of the excitation would cost as much as fifty balls, so each is taken once a step.
    fn runge_kutta_one(&mut self, time: f64, dt: f64, grain_force: f64, ledger: &mut Ledger) {
        let (m, c, k) = (self.mass[0], self.damping[0], self.stiffness[0]);
        let (w, r, cubic) = (self.seen[0], self.driven[0], self.cubic);
        let spring = |stretch: f64| if cubic == 0.0 { k * stretch } else { k * stretch + cubic * stretch.powi(3) };
        let inverse = self.mass_inverse[0];
        let times = [time, time + 0.5 * dt, time + dt];
        let base = match &self.steered {
            Some(piece) => times.map(|time| piece.at(time)),
            None => three(self.base.as_ref(), times),
        };
        let applied = three(self.force.as_ref(), times).map(|(value, _)| value);
        let slope = |at: usize, q: f64, v: f64| {
            let (y, y_rate) = base[at];
            (w * (applied[at] + grain_force) - c * (v - r * y_rate) - spring(q - r * y)) * inverse
        };
        let (q0, v0) = (self.q[0], self.v[0]);
        let half = 0.5 * dt;
        let a1 = slope(0, q0, v0);
        let v2 = v0 + half * a1;
        let a2 = slope(1, q0 + half * v0, v2);
        let v3 = v0 + half * a2;
        let a3 = slope(1, q0 + half * v2, v3);
        let v4 = v0 + dt * a3;
        let a4 = slope(2, q0 + dt * v3, v4);
        let sixth = dt / 6.0;
        let (q, v) = (q0 + sixth * (v0 + 2.0 * v2 + 2.0 * v3 + v4), v0 + sixth * (a1 + 2.0 * a2 + 2.0 * a3 + a4));
        let a = slope(2, q, v);
        // Work by Simpson's rule; the state in the middle is that of the cubic through both ends.
        let middle = (0.5 * (q0 + q) + 0.125 * dt * (v0 - v), 0.5 * (v0 + v) + 0.125 * dt * (a1 - a));
        let power = |at: usize, q: f64, v: f64| {
            let (y, y_rate) = base[at];
            let damper = c * (v - r * y_rate);
            [-(spring(q - r * y) + damper) * r * y_rate, applied[at] * w * v, damper * (v - r * y_rate)]
        };
        let ends = [power(0, q0, v0), power(1, middle.0, middle.1), power(2, q, v)];
        for (i, account) in [Account::BaseWork, Account::ForceWork, Account::HostDamping].into_iter().enumerate() {
            ledger.post(account, sixth * (ends[0][i] + 4.0 * ends[1][i] + ends[2][i]));
        }
        debug_assert!((m * inverse - 1.0).abs() < 1e-12);
        (self.q[0], self.v[0], self.a[0]) = (q, v, a);
        self.power = ends[2];
        self.grain_force = grain_force;
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
            kq.copy_from_slice(&self.v);
            kv.copy_from_slice(&self.a);
            for i in 0..n {
                dq[i] += weight / 6.0 * kq[i];
                dv[i] += weight / 6.0 * kv[i];
            }
        }
        for i in 0..n {
            self.q[i] = q0[i] + dt * dq[i];
            self.v[i] = v0[i] + dt * dv[i];
        }
    }
}

/// A signal at three equidistant times. Sines come from one call of the library and two rotations by half a step.
fn three(signal: Option<&Signal>, times: [f64; 3]) -> [(f64, f64); 3] {
    match signal {
        None => [(0.0, 0.0); 3],
        Some(Signal::Sine { amplitude, frequency, phase }) => {
            let rate = std::f64::consts::TAU * frequency;
            let (sin, cos) = (rate * times[1] + phase).sin_cos();
            let (half_sin, half_cos) = short_sine(0.5 * rate * (times[2] - times[0]));
            let value = |s: f64, c: f64| (amplitude * s, amplitude * rate * c);
            [
                value(sin * half_cos - cos * half_sin, cos * half_cos + sin * half_sin),
                value(sin, cos),
                value(sin * half_cos + cos * half_sin, cos * half_cos - sin * half_sin),
            ]
        }
        Some(other) => times.map(|t| value_and_rate(other, t)),
    }
}

/// Sine and cosine; for the small angle of half a step a short series is exact to the last bit or so.
fn short_sine(x: f64) -> (f64, f64) {
    const C: [f64; 6] = [1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0];
    if x.abs() > 0.01 {
        return x.sin_cos();
    }
    let s = x * x;
    let sine = x * (1.0 - s * C[0] * (1.0 - s * C[1] * (1.0 - s * C[2])));
    (sine, 1.0 - s * C[3] * (1.0 - s * C[4] * (1.0 - s * C[5])))
}
