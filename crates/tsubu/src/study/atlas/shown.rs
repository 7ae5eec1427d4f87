//! What a cavity shows, and what it shows between two points of an atlas.

use nalgebra::Complex;

/// What a cavity shows at a frequency and acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shown {
    /// The mass m - i m' [kg].
    pub mass: Complex<f64>,
    /// How far off it may be [kg].
    pub error: f64,
    /// Force at two and three times the frequency (root of both squares) over the acceleration [kg].
    pub harmonics: f64,
}

/// Points at one frequency: acceleration [m/s^2], rising, and what is shown there.
pub(super) type Column = Vec<(f64, Shown)>;

/// The value at `x` of the straight line, over the logarithm, through two points; the larger of their errors.
pub(super) fn between([low, high]: [f64; 2], [below, above]: [Shown; 2], x: f64) -> Shown {
    let share = (x / low).ln() / (high / low).ln();
    Shown {
        mass: below.mass * (1.0 - share) + above.mass * share,
        error: below.error.max(above.error),
        harmonics: below.harmonics * (1.0 - share) + above.harmonics * share,
    }
}

/// What is shown at an acceleration [m/s^2], on the straight lines of a column; what its end shows beyond it.
pub(super) fn at(column: &[(f64, Shown)], acceleration: f64) -> Shown {
    let after = column.partition_point(|(own, _)| *own < acceleration);
    match (after.checked_sub(1).and_then(|before| column.get(before)), column.get(after)) {
        (Some((low, below)), Some((high, above))) => between([*low, *high], [*below, *above], acceleration),
        (Some((_, end)), None) | (None, Some((_, end))) => *end,
        (None, None) => Shown::default(),
    }
}
