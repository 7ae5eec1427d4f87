//! A structure that begins in the steady motion that its drive is expected to keep up.

use super::Host;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;
use tsubu_scene::plan::Signal;

/// What grains are taken for by a structure that they ride on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ballast {
    /// Part of their force in phase with the acceleration, over it [kg].
    pub mass: f64,
    /// Part in phase with the velocity, over velocity and angular frequency [kg].
    pub lossy_mass: f64,
    /// Their weight along the direction of motion [N].
    pub weight: f64,
}

impl Ballast {
    /// m - i m' [kg].
    fn complex(self) -> Complex<f64> {
        Complex::new(self.mass, -self.lossy_mass)
    }
}

impl Host {
    /// Amplitude [m] of what is told in the steady motion at `frequency` [Hz] with the grains as ballast.
    pub fn steady_amplitude(&self, frequency: f64, ballast: Ballast) -> f64 {
        self.steady(frequency, &self.seen, ballast.complex()).map_or(0.0, |(_, whole)| whole.norm())
    }

    /// Puts the structure into the steady motion at `frequency` [Hz], that of its drive, with the grains as ballast, at the moment when the walls are
    /// where they were drawn: base and force begin with the phase of that moment. Returns the velocity of the walls [m/s].
    pub fn begin_in_motion(&mut self, frequency: f64, ballast: Ballast) -> f64 {
        let (n, w) = (self.n, TAU * frequency);
        let stiffness = DMatrix::from_row_slice(n, n, &self.stiffness);
        let weight = DVector::from_fn(n, |i, _| self.seen[i] * ballast.weight);
        let (Some((amplitude, whole)), Some(sag)) =
            (self.steady(frequency, &self.seen, ballast.complex()), stiffness.lu().solve(&weight))
        else {
            return 0.0;
        };
        let sunk: f64 = sag.iter().zip(&self.seen).map(|(q, s)| q * s).sum();
        // On the way up, where sag and vibration cancel; at the turning point where the sag is the larger.
        let risen = (-sunk / whole.norm().max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        let turn = risen.asin() - whole.arg();
        for signal in [&mut self.base, &mut self.force].into_iter().flatten() {
            if let Signal::Sine { phase, .. } = signal {
                *phase += turn;
            }
        }
        for (i, (amplitude, sag)) in amplitude.iter().zip(&sag).enumerate() {
            let now = amplitude * Complex::from_polar(1.0, turn);
            (self.q[i], self.v[i]) = (sag + now.im, w * now.re);
        }
        // What is left of the displacement would tear the walls from the grains.
        let (left, square) = (self.displacement(), self.seen.iter().map(|s| s * s).sum::<f64>());
        for (q, s) in self.q.iter_mut().zip(&self.seen) {
            *q -= s * left / square;
        }
        self.settle_acceleration(0.0);
        self.power = self.powers(self.drive(0.0));
        self.velocity()
    }

    /// The steady motion at `frequency` [Hz] with a complex mass m - i m' [kg] at an interface that moves along the host's direction:
    /// amplitudes of what is told, and of the interface along that direction [m].
    pub fn answer(&self, frequency: f64, interface: usize, mass: Complex<f64>) -> Option<[Complex<f64>; 2]> {
        let hung = self.along(interface);
        let (amplitude, told) = self.steady(frequency, &hung, mass)?;
        Some([told, amplitude.iter().zip(&hung).map(|(q, h)| q * *h).sum()])
    }

    /// Amplitude of the acceleration of an interface along the host's direction, over that of a force there, at `frequency` [Hz] [1/kg].
    pub fn mobility_at(&self, frequency: f64, interface: usize) -> f64 {
        let (hung, w) = (self.along(interface), TAU * frequency);
        let push = DVector::from_iterator(self.n, hung.iter().map(|h| Complex::from(*h)));
        let amplitude = self.impedance(frequency, &hung, Complex::default()).lu().solve(&push);
        let moved = |q: DVector<Complex<f64>>| q.iter().zip(&hung).map(|(q, h)| q * *h).sum::<Complex<f64>>();
        amplitude.map_or(0.0, |q| w * w * moved(q).norm())
    }

    /// Amplitudes of all coordinates, and of what is told of them, from the value of the drive at time 0 on:
    /// (K - w^2 (M + m h h^T) + i w C) Q = (K + i w C) r Y + s F, with s what is told of each coordinate, h what a complex mass m hangs on.
    fn steady(
        &self,
        frequency: f64,
        hung: &[f64],
        hanging: Complex<f64>,
    ) -> Option<(DVector<Complex<f64>>, Complex<f64>)> {
        let phasor = |signal: &Option<Signal>| match signal {
            Some(Signal::Sine { amplitude, phase, .. }) => Complex::from_polar(*amplitude, *phase),
            _ => Complex::default(),
        };
        let (base, force) = (phasor(&self.base), phasor(&self.force));
        let n = self.n;
        let load = DVector::from_fn(n, |i, _| {
            let driven: Complex<f64> = (0..n).map(|j| self.spring(frequency, i, j) * self.driven[j]).sum();
            driven * base + force * self.seen[i]
        });
        let amplitude = self.impedance(frequency, hung, hanging).lu().solve(&load)?;
        let whole = amplitude.iter().zip(&self.seen).map(|(q, s)| q * *s).sum();
        Some((amplitude, whole))
    }

    /// K + i w C, an entry of it.
    fn spring(&self, frequency: f64, i: usize, j: usize) -> Complex<f64> {
        let at = i * self.n + j;
        Complex::new(self.stiffness[at], TAU * frequency * self.damping[at])
    }

    /// K - w^2 (M + m h h^T) + i w C.
    fn impedance(&self, frequency: f64, hung: &[f64], hanging: Complex<f64>) -> DMatrix<Complex<f64>> {
        let (n, w) = (self.n, TAU * frequency);
        DMatrix::from_fn(n, n, |i, j| {
            self.spring(frequency, i, j) - (hanging * (hung[i] * hung[j]) + self.mass[i * n + j]) * (w * w)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Ballast;
    use crate::ledger::Ledger;
    use crate::partner::Host;
    use std::f64::consts::TAU;
    use tsubu_scene::plan::{self, Keep, Signal, Structure};

    fn host() -> Host {
        let mass = vec![vec![2.0, 0.0], vec![0.0, 1.0]];
        let damping = vec![vec![0.6, -0.2], vec![-0.2, 0.3]];
        let stiffness = vec![vec![900.0, -300.0], vec![-300.0, 300.0]];
        Host::new(&plan::Host {
            structure: Structure::Matrices {
                mass,
                damping,
                stiffness,
                gyroscopic: None,
                speed: 0.0,
                coordinate: 1,
                participation: vec![1.0; 2],
            },
            direction: [0.0, 0.0, 1.0],
            interface: std::collections::BTreeMap::new(),
            at: None,
            copies: 1.0,
            base: Some(Signal::Sine { amplitude: 1e-3, frequency: 1.0, phase: 0.4 }),
            force: None,
            dwell: None,
            displacement: 0.0,
            velocity: 0.0,
        })
    }

    /// Largest displacement in the second and in the twentieth period of an empty structure; without a transient they are the same.
    fn drift(begin: impl Fn(&mut Host, f64)) -> f64 {
        let (frequency, steps) = (2.1, 4000);
        let mut host = host();
        begin(&mut host, frequency);
        let dt = 1.0 / (frequency * f64::from(steps));
        let mut highest = [0.0_f64; 20];
        for step in 0..20 * steps {
            let time = f64::from(step + 1) * dt;
            host.before(time, dt);
            host.after(time, dt, &mut Ledger::default());
            let period = &mut highest[(step / steps) as usize];
            *period = period.max(host.displacement().abs());
        }
        (highest[1] / highest[19] - 1.0).abs()
    }

    /// Two coordinates, driven by the base between their resonances: begun in motion they are steady from the first, begun at
    /// rest (the control) they are not.
    #[test]
    fn no_transient_is_left() {
        let ballast = Ballast { mass: 0.0, lossy_mass: 0.0, weight: 0.0 };
        let begun = drift(|host, frequency| {
            host.set_frequency(frequency, Keep::Displacement);
            let velocity = host.begin_in_motion(frequency, ballast);
            assert!(velocity > 0.0 && host.displacement().abs() < 1e-18);
        });
        assert!(begun < 1e-4, "{begun}");
        assert!(drift(|host, frequency| host.set_frequency(frequency, Keep::Displacement)) > 1e-2);
    }

    /// A weight that is too heavy for the vibration: the walls begin where they were drawn all the same.
    #[test]
    fn walls_begin_where_they_were_drawn() {
        let mut host = host();
        host.set_frequency(2.1, Keep::Displacement);
        host.begin_in_motion(2.1, Ballast { mass: 0.2, lossy_mass: 0.1, weight: -50.0 });
        assert!(host.displacement().abs() < 1e-15);
        assert!(host.energy(0.0).0 < (TAU * 2.1 * 1e-2_f64).powi(2));
    }
}
