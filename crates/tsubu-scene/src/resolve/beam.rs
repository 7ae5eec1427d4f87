//! Modes of a beam that is clamped at one end (Euler and Bernoulli): w = cosh b x - cos b x - s (sinh b x - sin b x), with
//! cos(b L) cosh(b L) = -1 and f = (b L)^2 / (2 pi) sqrt(E I / (rho A L^4)).

use std::f64::consts::{PI, TAU};

/// Area [m^2] and second moment [m^4].
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    area: f64,
    second_moment: f64,
}

/// A rectangle, its height in the plane of bending [m].
pub(super) fn rectangle(width: f64, height: f64) -> Section {
    Section { area: width * height, second_moment: width * height.powi(3) / 12.0 }
}

/// A full circle [m].
pub(super) fn round(diameter: f64) -> Section {
    Section { area: PI * diameter.powi(2) / 4.0, second_moment: PI * diameter.powi(4) / 64.0 }
}

/// A mode of bending, of mean square 1 along the beam, so that its modal mass is the mass of the beam.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mode {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// Modal mass [kg].
    pub mass: f64,
    /// Share of the base motion [-]: the mean of the mode.
    pub participation: f64,
    /// b L, and 1 - s, which is too small to be had as a difference.
    root: f64,
    short: f64,
    length: f64,
}

impl Mode {
    /// Mode number 1, 2, ... of a beam.
    pub fn new(number: usize, length: f64, section: Section, modulus: f64, density: f64) -> Self {
        // cos x + 1 / cosh x = 0; near to an odd multiple of pi / 2.
        let mut root = (number as f64 - 0.5) * PI;
        for _ in 0..50 {
            let value = root.cos() + 1.0 / root.cosh();
            let slope = -root.sin() - root.tanh() / root.cosh();
            root -= value / slope;
        }
        let short = (root.sin() - root.cos() - (-root).exp()) / (root.sinh() + root.sin());
        let line_mass = density * section.area;
        let frequency = root * root / TAU * (modulus * section.second_moment / line_mass).sqrt() / (length * length);
        Self { frequency, mass: line_mass * length, participation: 2.0 * (1.0 - short) / root, root, short, length }
    }

    /// Shape and slope [1/m] at a share of the length.
    pub fn at(&self, share: f64) -> (f64, f64) {
        let x = self.root * share;
        let s = 1.0 - self.short;
        // cosh - s sinh and sinh - s cosh, without the difference of large numbers.
        let (falling, rising) = (0.5 * (1.0 + s) * (-x).exp(), 0.5 * self.short * x.exp());
        let shape = rising + falling - x.cos() + s * x.sin();
        let slope = rising - falling + x.sin() + s * x.cos();
        (shape, slope * self.root / self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::{Mode, rectangle};

    /// Roots 1.8751, 4.6941, 7.8548 (Blevins 1979); modes are orthogonal with mean square 1, their slope is the derivative, the mean
    /// is the participation; the node of the second mode lies at 0.7834 of the length.
    #[test]
    fn modes_are_those_of_a_cantilever() {
        let modes: Vec<Mode> =
            (1..=8).map(|number| Mode::new(number, 2.0, rectangle(0.02, 0.01), 210e9, 7850.0)).collect();
        for (mode, root) in modes.iter().zip([1.875_104_068_7, 4.694_091_133, 7.854_757_438_2]) {
            assert!((mode.root - root).abs() < 1e-9, "{}", mode.root);
        }
        let mean =
            |f: &dyn Fn(f64) -> f64| (0..20_000).map(|i| f((f64::from(i) + 0.5) / 20_000.0)).sum::<f64>() / 20_000.0;
        for (i, a) in modes.iter().enumerate() {
            for (k, b) in modes.iter().enumerate() {
                let product = mean(&|x| a.at(x).0 * b.at(x).0);
                assert!((product - f64::from(u8::from(i == k))).abs() < 1e-5, "{i} {k}: {product}");
            }
            assert!((mean(&|x| a.at(x).0) - a.participation).abs() < 1e-5, "{i}");
            let (h, x) = (1e-6, 0.7);
            let slope = (a.at(x + h).0 - a.at(x - h).0) / (2.0 * h * 2.0);
            assert!((slope / a.at(x).1 - 1.0).abs() < 1e-6, "{i}");
            assert!((a.at(1.0).0.abs() - 2.0).abs() < 1e-9 && a.at(0.0).0.abs() < 1e-12);
        }
        assert!(modes[1].at(0.783_4).0.abs() < 1e-3);
    }
}
