//! The Shields number of a bed, and how much a bed carries by published formulas.

use super::{Stream, Water};

/// A published rate of bedload: the Einstein number q / sqrt((s - 1) g d^3) is factor (Shields number - threshold)^1.5.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// Author and year.
    pub source: &'static str,
    /// [-]
    pub factor: f64,
    /// Shields number at which grains begin to move [-].
    pub threshold: f64,
}

impl Formula {
    /// The Einstein number at a Shields number [-]; nothing moves below the threshold.
    pub fn rate(&self, shields: f64) -> f64 {
        self.factor * (shields - self.threshold).max(0.0).powf(1.5)
    }
}

/// What rates are held against. Measured ones scatter by a factor of 2 about either.
pub const FORMULAS: [Formula; 2] = [
    Formula { source: "Meyer-Peter and Mueller 1948", factor: 8.0, threshold: 0.047 },
    Formula { source: "Wong and Parker 2006", factor: 3.97, threshold: 0.0495 },
];

impl Water {
    /// Stress of a stream on its bed [Pa]: of one in layers at the top of the bed, with what is given to grains above it; of a
    /// log-law stream, which knows no grains, rho U*^2. `None` without a stream of either kind.
    pub fn bed_stress(&self) -> Option<f64> {
        match &self.stream {
            Stream::Coupled(coupled) => Some(coupled.bed_stress()),
            Stream::LogLaw { shear_velocity, .. } => Some(self.density * shear_velocity * shear_velocity),
            Stream::Still | Stream::Table { .. } | Stream::Column { .. } => None,
        }
    }

    /// Stress over (s - 1) rho g d, for grains of a density [kg/m^3] and diameter [m] under gravity [m/s^2].
    pub fn shields(&self, stress: f64, (density, diameter): (f64, f64), gravity: f64) -> f64 {
        stress / ((density - self.density) * gravity * diameter)
    }
}

#[cfg(test)]
mod tests {
    use super::FORMULAS;

    /// At a Shields number of 0.147 Meyer-Peter and Mueller give 8 * 0.1^1.5 = 0.2530, below the threshold none gives anything.
    #[test]
    fn formulas_are_as_published() {
        assert!((FORMULAS[0].rate(0.147) - 0.252_98).abs() < 1e-5);
        assert!((FORMULAS[1].rate(0.1495) - 0.125_54).abs() < 1e-5);
        assert_eq!(FORMULAS.map(|formula| formula.rate(0.03)), [0.0; 2]);
    }
}
