//! Units as people read them. Files keep to SI.

/// The factor and unit in which a person reads a value of this SI unit: angles are read in degrees.
pub fn for_people(unit: &str) -> (f64, &str) {
    if unit == "rad" { (180.0 / std::f64::consts::PI, "°") } else { (1.0, unit) }
}
