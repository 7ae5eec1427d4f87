//! Distributions of diameters: their means and their ends.

use crate::plan::{GrainShape, GrainTable, Particles, Size, Start};

impl Size {
    /// Mean diameter [m] by number; `None` where all are equal. Of the laws with tails it is that of the whole law: the
    /// tails that are cut are equal in deviations, and what they change is below a percent.
    pub fn mean(&self, shape: &GrainShape) -> Option<f64> {
        match self {
            Self::Equal {} => None,
            Self::Uniform { smallest, largest } => Some(0.5 * (smallest + largest)),
            Self::Normal { mean, .. } => Some(*mean),
            Self::LogNormal { median, deviation, .. } => Some(median * (0.5 * deviation * deviation).exp()),
            Self::Sieve { diameter, passing } => sieve_mean(diameter, passing, shape),
        }
    }

    /// Smallest and largest diameter [m]; `None` where all are equal.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Self::Equal {} => None,
            Self::Uniform { smallest, largest } => Some([*smallest, *largest]),
            Self::Normal { mean, deviation, cut } => Some([mean - cut * deviation, mean + cut * deviation]),
            Self::LogNormal { median, deviation, cut } => {
                Some([median * (-cut * deviation).exp(), median * (cut * deviation).exp()])
            }
            Self::Sieve { diameter, .. } => Some([*diameter.first()?, *diameter.last()?]),
        }
    }
}

/// The sieve curve tells shares of mass. Between two sieves a and b the mass is spread evenly over the diameter, so the
/// number of grains goes with d^-3 (discs: d^-2) there, and both the number and its moment are integrals in closed form.
fn sieve_mean(diameter: &[f64], passing: &[f64], shape: &GrainShape) -> Option<f64> {
    let mut number = 0.0;
    let mut moment = 0.0;
    for (d, p) in diameter.windows(2).zip(passing.windows(2)) {
        let [a, b] = [d[0], d[1]];
        let share = (p[1] - p[0]) / (b - a);
        let [inverse, square] = [1.0 / a - 1.0 / b, 0.5 * (1.0 / (a * a) - 1.0 / (b * b))];
        match shape {
            GrainShape::Sphere {}
            | GrainShape::Clump { .. }
            | GrainShape::ClumpFile { .. }
            | GrainShape::ClumpMesh { .. }
            | GrainShape::Superellipsoid { .. }
            | GrainShape::Polyhedron { .. }
            | GrainShape::PolyhedronMesh { .. } => {
                number += share * square;
                moment += share * inverse;
            }
            GrainShape::Disc { .. } | GrainShape::Polygon { .. } | GrainShape::Cells { .. } => {
                number += share * inverse;
                moment += share * (b / a).ln();
            }
        }
    }
    let mean = moment / number;
    (mean.is_finite() && mean > 0.0).then_some(mean)
}

impl Particles {
    /// The largest diameter [m] that a grain of the group can have.
    pub fn largest_diameter(&self) -> f64 {
        self.extreme(f64::max, 1)
    }

    /// The smallest diameter [m] that a grain of the group can have.
    pub fn smallest_diameter(&self) -> f64 {
        self.extreme(f64::min, 0)
    }

    fn extreme(&self, pick: fn(f64, f64) -> f64, end: usize) -> f64 {
        if let Start::File { grains, .. } = &self.start
            && let Some(diameter) = grains.diameter.iter().copied().reduce(pick)
        {
            return diameter;
        }
        self.size.ends().map_or(self.diameter, |ends| ends[end])
    }
}

impl GrainShape {
    /// Mass [kg] of a grain of that density [kg/m^3] and diameter [m].
    pub fn mass(&self, density: f64, diameter: f64) -> f64 {
        match self {
            Self::Sphere {} => density * std::f64::consts::PI / 6.0 * diameter.powi(3),
            Self::Clump { .. }
            | Self::ClumpFile { .. }
            | Self::ClumpMesh { .. }
            | Self::Superellipsoid { .. }
            | Self::Polyhedron { .. }
            | Self::PolyhedronMesh { .. } => {
                density * self.clump().map_or(std::f64::consts::PI / 6.0, |clump| clump.volume) * diameter.powi(3)
            }
            Self::Polygon { thickness, .. } | Self::Cells { thickness, .. } => {
                let area = self.clump().map_or(std::f64::consts::PI / 4.0, |clump| clump.volume);
                density * area * diameter.powi(2) * thickness
            }
            Self::Disc { thickness } => density * std::f64::consts::PI / 4.0 * diameter.powi(2) * thickness,
        }
    }
}

impl GrainTable {
    /// Mean of the diameters [m]; `None` where the file has none.
    pub fn mean_diameter(&self) -> Option<f64> {
        // The mean of the differences: of a million equal grains the mean is theirs, to the last digit.
        let first = *self.diameter.first()?;
        let more: f64 = self.diameter.iter().map(|diameter| diameter - first).sum();
        Some(first + more / self.diameter.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPHERE: GrainShape = GrainShape::Sphere {};

    #[test]
    fn a_narrow_sieve_holds_its_middle() {
        let narrow = Size::Sieve { diameter: vec![0.999, 1.001], passing: vec![0.0, 1.0] };
        assert!((narrow.mean(&SPHERE).expect("a mean") - 1.0).abs() < 1e-5);
        assert!((narrow.mean(&GrainShape::Disc { thickness: 1.0 }).expect("a mean") - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_sieve_mean_agrees_with_counting() {
        let sieve = Size::Sieve { diameter: vec![1.0, 2.0, 4.0], passing: vec![0.0, 0.25, 1.0] };
        for (shape, power) in [(SPHERE, 3), (GrainShape::Disc { thickness: 1.0 }, 2)] {
            let mut number = 0.0;
            let mut moment = 0.0;
            for i in 0..300_000 {
                let d = 1.0 + (f64::from(i) + 0.5) * 1e-5;
                let share = if d < 2.0 { 0.25 } else { 0.375 };
                number += share / d.powi(power);
                moment += share * d / d.powi(power);
            }
            let mean = sieve.mean(&shape).expect("a mean");
            assert!((mean - moment / number).abs() < 1e-8, "{mean} is not {}", moment / number);
        }
    }

    #[test]
    fn equal_grains_have_their_diameter() {
        let grains = GrainTable { diameter: vec![0.009; 1_000_003], ..GrainTable::default() };
        assert_eq!(grains.mean_diameter(), Some(0.009));
        assert_eq!(GrainTable::default().mean_diameter(), None);
    }

    #[test]
    fn ends_are_where_the_tails_are_cut() {
        assert_eq!(Size::Normal { mean: 2.0, deviation: 0.25, cut: 2.0 }.ends(), Some([1.5, 2.5]));
        let [low, high] = Size::LogNormal { median: 3.0, deviation: 0.1, cut: 2.0 }.ends().expect("ends");
        assert!((low * high - 9.0).abs() < 1e-12 && high > 3.0);
    }
}
