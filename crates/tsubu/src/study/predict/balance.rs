//! Harmonic balance: the steady motions of a structure that carries a cavity, from the mass that the cavity shows.
//!
//! A structure that moves as a sine with acceleration a at its cavity carries a complex mass m(f, a), and with that mass moves by
//! |X(m)| there. Both agree where w^2 |X(m(f, a))| = a: each root is a steady motion. Where the difference falls through zero the motion
//! is stable, where it rises it is not (a little more acceleration would be answered with more still).

use crate::partner::Host;
use crate::study::atlas::Chart;
use nalgebra::Complex;
use std::f64::consts::TAU;

/// Accelerations at which a root is looked for, and how much further than the atlas, as a ratio.
const LOOKS: usize = 160;
const BEYOND: f64 = 1e3;

/// A steady motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Amplitude of what the host tells [m].
    pub amplitude: f64,
    /// Amplitude of the acceleration of the cavity [m/s^2].
    pub acceleration: f64,
    /// Whether it comes back to itself.
    pub stable: bool,
}

/// Which end of the interval of the lossy mass is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lossy {
    /// The least that it may be: the highest answer.
    Least,
    /// As measured.
    Measured,
    /// The most.
    Most,
}

/// A structure with a cavity at an interface; without a chart the cavity is empty.
pub struct Balance<'a> {
    /// The structure, driven at the frequency that is asked for.
    pub host: &'a Host,
    /// Where the cavity hangs.
    pub interface: usize,
    /// What it shows.
    pub chart: Option<&'a Chart>,
    /// Accelerations that the chart knows [m/s^2].
    pub known: [f64; 2],
}

impl Balance<'_> {
    /// The mass that the cavity shows. A structure is no shaker: grains stir it at two and three times the frequency as well, by so much acceleration
    /// a unit of force (`stirred` [1/kg]), so that what they feel may be stronger or weaker by that share.
    fn mass(&self, frequency: f64, acceleration: f64, stirred: f64, lossy: Lossy) -> Complex<f64> {
        let Some(chart) = self.chart else { return Complex::default() };
        let shown = chart.at(frequency, acceleration);
        let more = 1.0 + stirred * shown.harmonics;
        let near = [acceleration / more, acceleration, acceleration * more].map(|a| chart.at(frequency, a).mass.im);
        let imaginary = match lossy {
            Lossy::Measured => shown.mass.im,
            Lossy::Least => (near.into_iter().fold(f64::NEG_INFINITY, f64::max) + shown.error).min(0.0),
            Lossy::Most => near.into_iter().fold(f64::INFINITY, f64::min) - shown.error,
        };
        Complex::new(shown.mass.re, imaginary)
    }

    /// All steady motions at a frequency [Hz], the smallest first.
    pub fn motions(&self, frequency: f64, lossy: Lossy) -> Vec<Motion> {
        let square = (TAU * frequency).powi(2);
        let stirred = self.host.mobility_at(2.0 * frequency, self.interface);
        let answer = |acceleration: f64| {
            let mass = self.mass(frequency, acceleration, stirred, lossy);
            let [told, hung] = self.host.answer(frequency, self.interface, mass)?;
            Some([told.norm(), square * hung.norm()])
        };
        let excess = |acceleration: f64| answer(acceleration).map_or(f64::NAN, |[_, found]| found - acceleration);
        let [low, high] = [self.known[0] / BEYOND, self.known[1] * BEYOND];
        let step = (high / low).ln() / (LOOKS - 1) as f64;
        let looks: Vec<(f64, f64)> =
            (0..LOOKS).map(|i| low * (step * i as f64).exp()).map(|a| (a, excess(a))).collect();
        let root = |two: &[(f64, f64)]| {
            let ([mut below, mut above], falls) = ([two[0].0, two[1].0], two[0].1 > 0.0);
            if (two[0].1 > 0.0) == (two[1].1 > 0.0) {
                return None;
            }
            for _ in 0..60 {
                let middle = 0.5 * (below + above);
                let end = if (excess(middle) > 0.0) == falls { &mut below } else { &mut above };
                *end = middle;
            }
            let acceleration = 0.5 * (below + above);
            let [amplitude, _] = answer(acceleration)?;
            Some(Motion { amplitude, acceleration, stable: falls })
        };
        looks.windows(2).filter_map(root).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::atlas::Shown;
    use tsubu_scene::plan::{self, Signal, Structure};

    const STRUCTURE: [f64; 3] = [0.086, 0.08, 123.4];
    const BASE: f64 = 0.5e-3;

    fn host(frequency: f64) -> Host {
        let [mass, damping, stiffness] = STRUCTURE;
        Host::new(&plan::Host {
            structure: Structure::Oscillator { mass, damping, stiffness, cubic_stiffness: 0.0 },
            direction: [0.0, 0.0, 1.0],
            interface: std::collections::BTreeMap::new(),
            at: None,
            copies: 1.0,
            base: Some(Signal::Sine { amplitude: BASE, frequency, phase: 0.0 }),
            force: None,
            dwell: None,
            displacement: 0.0,
            velocity: 0.0,
        })
    }

    /// Amplitude of an oscillator on a shaken base with a mass m - i m' on it: Y |k + i c w| / |k + i c w - w^2 (M + m - i m')|.
    fn closed(frequency: f64, mass: Complex<f64>) -> f64 {
        let ([m, c, k], w) = (STRUCTURE, TAU * frequency);
        let spring = Complex::new(k, c * w);
        BASE * (spring / (spring - (mass + m) * w * w)).norm()
    }

    fn motions(shown: impl Fn(f64) -> Complex<f64>, frequency: f64) -> Vec<Motion> {
        let places = (0..=40).map(|i| 0.5 * 100.0_f64.powf(f64::from(i) / 40.0));
        let point = |a: f64| ([6.0, a], Shown { mass: shown(a), error: 0.0, harmonics: 0.0 });
        let chart = Chart::new(places.map(point));
        let host = host(frequency);
        let balance = Balance { host: &host, interface: 0, chart: Some(&chart), known: [0.5, 50.0] };
        let found = balance.motions(frequency, Lossy::Measured);
        for motion in &found {
            let expected = closed(frequency, chart.at(frequency, motion.acceleration).mass);
            assert!((motion.amplitude / expected - 1.0).abs() < 1e-9);
            assert!((motion.amplitude * (TAU * frequency).powi(2) / motion.acceleration - 1.0).abs() < 1e-9);
        }
        found
    }

    /// Grains that ride in a weak motion and are left behind by a strong one: where the light structure resonates three motions are
    /// possible, a small one with all grains aboard, a large one without, and one between that is not stable; elsewhere, and with a mass
    /// that is always the same (the control), one.
    #[test]
    fn what_is_left_behind_makes_a_jump() {
        let left_behind = |a: f64| Complex::new(0.02 / (1.0 + (a / 8.0).powi(6)), -1e-4);
        let found = motions(left_behind, 6.0);
        assert_eq!(found.iter().map(|motion| motion.stable).collect::<Vec<_>>(), [true, false, true], "{found:?}");
        assert!(found[2].amplitude > 2.0 * found[0].amplitude);
        assert_eq!(motions(left_behind, 5.0).len(), 1);
        assert_eq!(motions(|_| Complex::new(0.02, -1e-4), 6.0).len(), 1);
    }

    /// A force of one newton at twice the frequency moves the structure by w^2 / |k - w^2 M + i c w|.
    #[test]
    fn higher_forces_meet_the_mass() {
        let ([m, c, k], w) = (STRUCTURE, TAU * 12.0);
        let expected = w * w / Complex::new(k - m * w * w, c * w).norm();
        assert!((host(6.0).mobility_at(12.0, 0) / expected - 1.0).abs() < 1e-12);
    }
}
