//! Fixed-point numbers of an automaton: speeds and distances as whole numbers, the same bits on every machine.
//!
//! The unit of speed is u = g dt / 1024, so that gravity adds exactly 1024 a step (1/1024 mm/s at the values of
//! Komatsuzaki 2003: g = 10 m/s^2, dt = 1e-4 s). The unit of distance is u dt. Without gravity the cell spacing is cut
//! into as many units as at those values.

use tsubu_scene::plan::Arithmetic;

/// Units of speed that gravity adds in one step.
pub const GRAVITY_UNITS: i64 = 1024;

/// What the whole numbers mean.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Distance units in a cell: dx / (u dt).
    pub cell: i64,
    /// Speed units that gravity adds in a step: [`GRAVITY_UNITS`] or 0.
    pub gravity: i64,
    /// Speeds that come out of a product are cut to multiples of this.
    pub quantum: i64,
    /// Unit of speed u [m/s].
    pub speed: f64,
    /// Unit of distance u dt [m].
    pub distance: f64,
}

impl Scale {
    /// The scale for a cell spacing [m], a gravity [m/s^2] and a step [s]; `half` tells whether half of g dt occurs, which
    /// the integer arithmetic then keeps.
    pub fn new(spacing: f64, gravity: f64, dt: f64, arithmetic: Arithmetic, half: bool) -> Self {
        let quantum = match arithmetic {
            Arithmetic::Fixed => 1,
            Arithmetic::Integer if half => GRAVITY_UNITS / 2,
            Arithmetic::Integer => GRAVITY_UNITS,
        };
        if gravity > 0.0 {
            let speed = gravity * dt / GRAVITY_UNITS as f64;
            let cell = (spacing / (speed * dt)).round() as i64;
            return Self { cell, gravity: GRAVITY_UNITS, quantum, speed, distance: speed * dt };
        }
        let cell = 60_000 * GRAVITY_UNITS;
        let distance = spacing / cell as f64;
        Self { cell, gravity: 0, quantum, speed: distance / dt, distance }
    }

    /// The nearest fixed-point speed [units] to a real one [m/s].
    #[inline]
    pub fn speed_units(&self, speed: f64) -> i64 {
        (speed / self.speed).round() as i64
    }

    /// A speed cut toward zero to a multiple of the quantum.
    #[inline]
    pub fn cut(&self, speed: i64) -> i64 {
        if self.quantum == 1 { speed } else { speed - speed % self.quantum }
    }
}

/// A coefficient of restitution in 1/65536.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Restitution(i64);

impl Restitution {
    /// The nearest representable coefficient.
    pub fn new(value: f64) -> Self {
        Self((value * 65536.0).round() as i64)
    }

    /// The coefficient.
    pub fn value(self) -> f64 {
        self.0 as f64 / 65536.0
    }

    /// e times an approach speed (not negative), cut down: a collision never gives back more than asked for.
    #[inline]
    pub fn of(self, approach: i64) -> i64 {
        (approach * self.0) >> 16
    }
}

#[cfg(test)]
mod tests {
    use super::{Restitution, Scale};
    use tsubu_scene::plan::Arithmetic;

    /// At the paper's values the unit is 1/1024 mm/s and a cell is 60 000 mm/s times a step.
    #[test]
    fn paper_values() {
        let scale = Scale::new(6e-3, 10.0, 1e-4, Arithmetic::Fixed, true);
        assert_eq!(scale.cell, 60_000 * 1024);
        assert!((scale.speed * 1024.0 - 1e-3).abs() < 1e-15);
        assert_eq!(scale.speed_units(1e-3), 1024);
    }

    #[test]
    fn integer_arithmetic_cuts_toward_zero() {
        let scale = Scale::new(6e-3, 10.0, 1e-4, Arithmetic::Integer, false);
        assert_eq!((scale.cut(2047), scale.cut(-2047), scale.cut(2048)), (1024, -1024, 2048));
        assert_eq!(Restitution::new(0.75).of(1024), 768);
    }
}
