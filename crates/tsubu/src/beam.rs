//! The beam that a bond between two grains is: Timoshenko's (1921), elastic, round, short or long.

use std::f64::consts::PI;
use tsubu_scene::plan::Bond;

/// Stiffnesses of a beam of length a against stretching [N/m], turning of its ends against the line between them, of one end against the other, and
/// twisting [N.m]: stored is (stretch u^2 + ends (t1^2 + t2^2) + bend |t1 - t2|^2 + twist w^2) / 2.
///
/// With k = E I / (a (1 + f)) and f = 12 E I / (K G A a^2) they are E A / a, 6 k, -(2 - f) k and G J / a; K is the shear coefficient of a round section,
/// 6 (1 + p) / (7 + 6 p) with Poisson's ratio p (Cowper 1966).
#[derive(Clone, Copy, Debug, Default)]
pub struct Stiffness {
    /// Against stretching [N/m].
    pub stretch: f64,
    /// Of each end against the line between both [N.m].
    pub ends: f64,
    /// Of one end against the other [N.m].
    pub bend: f64,
    /// Against twisting [N.m].
    pub twist: f64,
}

impl Stiffness {
    /// Of a round beam of a bond's material between grains, by radius and length [m].
    pub fn of(bond: &Bond, radius: f64, length: f64) -> Self {
        let (young, poisson) = (bond.young_modulus, bond.poisson_ratio);
        let shear = 0.5 * young / (1.0 + poisson);
        let Section { area, moment } = Section::round(radius);
        let coefficient = 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
        let f = 12.0 * young * moment / (shear * coefficient * area * length * length);
        let k = young * moment / (length * (1.0 + f));
        Self {
            stretch: young * area / length,
            ends: 6.0 * k,
            bend: (f - 2.0) * k,
            twist: shear * 2.0 * moment / length,
        }
    }
}

/// A round section. Its polar moment is twice the second moment.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Area [m^2].
    pub area: f64,
    /// Second moment of the area about a diameter [m^4].
    pub moment: f64,
}

impl Section {
    /// Of a radius [m].
    pub fn round(radius: f64) -> Self {
        Self { area: PI * radius * radius, moment: 0.25 * PI * radius.powi(4) }
    }
}
