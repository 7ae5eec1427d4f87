//! Random vibration by its power spectral density: a sum of sines that has it.

use crate::philox::{DRIVE, philox, unit};
use std::f64::consts::TAU;

/// A one-sided power spectral density S [x^2/Hz] at rising frequencies [Hz]: between them S = S0 (f / f0)^m, straight in
/// logarithms of both, as vibration tests are specified; outside 0.
pub(super) struct Spectrum<'a> {
    pub frequency: &'a [f64],
    pub density: &'a [f64],
}

/// A sum of sines: amplitudes [x], frequencies [Hz], phases [rad].
#[derive(Debug, Default, PartialEq)]
pub(super) struct Sines {
    pub amplitude: Vec<f64>,
    pub frequency: Vec<f64>,
    pub phase: Vec<f64>,
}

/// A piece of a spectrum: S0 f0, and m + 1.
struct Piece {
    from: f64,
    to: f64,
    scale: f64,
    power: f64,
}

impl Piece {
    /// Integral of S from its begin to `f`: S0 f0 ((f / f0)^(m + 1) - 1) / (m + 1), the logarithm for m = -1.
    fn below(&self, f: f64) -> f64 {
        let x = (f / self.from).ln();
        self.scale * if (self.power * x).abs() < 1e-9 { x } else { (self.power * x).exp_m1() / self.power }
    }

    /// Where that integral is reached.
    fn reaching(&self, integral: f64) -> f64 {
        let c = integral / self.scale;
        let x = if (self.power * c).abs() < 1e-9 { c } else { (self.power * c).ln_1p() / self.power };
        (self.from * x.exp()).clamp(self.from, self.to)
    }
}

impl Spectrum<'_> {
    fn pieces(&self) -> impl Iterator<Item = Piece> {
        self.frequency.windows(2).zip(self.density.windows(2)).map(|(f, s)| Piece {
            from: f[0],
            to: f[1],
            scale: s[0] * f[0],
            power: (s[1] / s[0]).ln() / (f[1] / f[0]).ln() + 1.0,
        })
    }

    /// Integral of S up to a frequency: the mean square of what vibrates below it.
    pub fn below(&self, f: f64) -> f64 {
        self.pieces().filter(|piece| piece.from < f).map(|piece| piece.below(f.min(piece.to))).sum()
    }

    /// The frequency up to which S has this integral.
    fn reaching(&self, mut integral: f64) -> f64 {
        for piece in self.pieces() {
            let whole = piece.below(piece.to);
            if integral <= whole {
                return piece.reaching(integral);
            }
            integral -= whole;
        }
        self.frequency.last().copied().unwrap_or_default()
    }

    /// One sine in each of `lines` bands of the same ratio of frequencies: its mean square A^2/2 is the integral of S over the band, its
    /// frequency is drawn within the band with the probability S, its phase evenly. So the mean square of the sum is the integral of S for every seed,
    /// and of what answers to it with |H|^2 the integral of |H|^2 S in the mean over seeds (Shinozuka and Jan 1972, with random frequencies
    /// against repeats).
    pub fn sines(&self, lines: u32, seed: u64) -> Sines {
        let mut sines = Sines::default();
        let (Some(first), Some(last)) = (self.frequency.first(), self.frequency.last()) else { return sines };
        let key = [seed as u32, (seed >> 32) as u32 ^ (DRIVE << 24)];
        let mut low = 0.0;
        for line in 0..lines {
            let edge = first * ((last / first).ln() * f64::from(line + 1) / f64::from(lines)).exp();
            let high = self.below(if line + 1 == lines { *last } else { edge });
            let [a, b, c, d] = philox([line, DRIVE, 0, 0], key);
            sines.amplitude.push((2.0 * (high - low).max(0.0)).sqrt());
            sines.frequency.push(self.reaching(low + unit(a, b) * (high - low)));
            sines.phase.push(TAU * unit(c, d));
            low = high;
        }
        sines
    }
}

#[cfg(test)]
mod tests {
    use super::Spectrum;
    use std::f64::consts::TAU;

    /// A specification of the usual kind: rising by 3 dB an octave, flat, falling by 6 dB an octave; and one piece of m = -1.
    const FREQUENCY: [f64; 5] = [20.0, 80.0, 350.0, 700.0, 2000.0];
    const DENSITY: [f64; 5] = [0.01, 0.04, 0.04, 0.02, 0.00245];

    fn spectrum() -> Spectrum<'static> {
        Spectrum { frequency: &FREQUENCY, density: &DENSITY }
    }

    /// The integral in closed form: 0.01/20 (80^2 - 20^2)/2 below 80 Hz (S = S0 f/f0), 0.04 (350 - 80) to 350 Hz, and 0.04 350 ln 2 to 700 Hz.
    /// Control: a trapezoid between the last two points, straight in S itself, is off by more than a tenth.
    #[test]
    fn mean_square_is_the_integral() {
        let near = |f: f64, exact: f64| {
            let found = spectrum().below(f);
            assert!((found / exact - 1.0).abs() < 1e-12, "{f} Hz: {found} {exact}");
        };
        let rising = 0.01 / 20.0 * (80.0_f64.powi(2) - 20.0_f64.powi(2)) / 2.0;
        near(80.0, rising);
        near(350.0, rising + 0.04 * 270.0);
        near(700.0, rising + 0.04 * 270.0 + 0.04 * 350.0 * 2.0_f64.ln());
        let last = spectrum().below(2000.0) - spectrum().below(700.0);
        assert!((0.5 * (0.02 + 0.00245) * 1300.0 / last - 1.0).abs() > 0.1);
        for f in [25.0, 80.0, 123.0, 500.0, 1999.0] {
            assert!((spectrum().reaching(spectrum().below(f)) / f - 1.0).abs() < 1e-12, "{f}");
        }
    }

    /// Mean square of the sines against the integral for any seed (to rounding), and their mean over a minute against it. Control: a one-sided density taken
    /// for a two-sided one gives twice as much.
    #[test]
    fn sines_have_the_mean_square() {
        let wanted = spectrum().below(2000.0);
        for seed in [1, 2, u64::MAX] {
            let sines = spectrum().sines(200, seed);
            let square: f64 = sines.amplitude.iter().map(|a| 0.5 * a * a).sum();
            assert!((square / wanted - 1.0).abs() < 1e-12, "{square} {wanted}");
            assert!((2.0 * square / wanted - 1.0).abs() > 0.9);
            assert!(sines.frequency.windows(2).all(|pair| pair[0] < pair[1]), "one in each band");
        }
        assert_eq!(spectrum().sines(200, 7), spectrum().sines(200, 7));
        assert!(spectrum().sines(200, 7) != spectrum().sines(200, 8));
        let sines = spectrum().sines(200, 3);
        let at = |t: f64| -> f64 {
            let lines = sines.amplitude.iter().zip(&sines.frequency).zip(&sines.phase);
            lines.map(|((a, f), p)| a * (TAU * f * t + p).sin()).sum()
        };
        let count = 20_000;
        let mean = (0..count).map(|k| at(f64::from(k) * 3.17e-3).powi(2)).sum::<f64>() / f64::from(count);
        assert!((mean / wanted - 1.0).abs() < 0.03, "{mean} {wanted}");
    }

    /// The mean square of an oscillator of damping ratio 0.05 at 150 Hz on such a base, of its relative displacement: the mean over seeds against the integral of
    /// S |H|^2 by small steps (Miles 1954 is the same for a flat density: pi f S / (4 zeta w^4)). Control: half of the lines at twice the density.
    #[test]
    fn what_answers_has_the_mean_square() {
        let (natural, zeta) = (150.0, 0.05);
        let gain = |f: f64| {
            let r = f / natural;
            1.0 / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)) / (TAU * natural).powi(4)
        };
        let steps = 200_000;
        let edge = |k: i32| 20.0 * (100.0_f64.ln() * f64::from(k) / f64::from(steps)).exp();
        let exact: f64 =
            (0..steps).map(|k| gain(edge(k)) * (spectrum().below(edge(k + 1)) - spectrum().below(edge(k)))).sum();
        let miles = TAU / 8.0 * natural * 0.04 / zeta / (TAU * natural).powi(4);
        assert!((exact / miles - 1.0).abs() < 0.05, "{exact:e} {miles:e}");
        let answer = |seed| -> f64 {
            let sines = spectrum().sines(200, seed);
            sines.amplitude.iter().zip(&sines.frequency).map(|(a, f)| 0.5 * a * a * gain(*f)).sum()
        };
        let seeds = 400;
        let mean = (1..=seeds).map(answer).sum::<f64>() / seeds as f64;
        assert!((mean / exact - 1.0).abs() < 0.02, "{mean:e} {exact:e}");
        assert!((2.0 * mean / exact - 1.0).abs() > 0.02, "a two-sided density");
    }
}
