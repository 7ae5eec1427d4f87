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
