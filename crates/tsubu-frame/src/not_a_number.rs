//! JSON knows no not-a-number: it is written as `null`, and read back as not-a-number here.

use serde::{Deserialize, Deserializer};

/// A number, or `null`.
pub fn real<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(deserializer).map(|x| x.unwrap_or(f64::NAN))
}

/// A list of such.
pub fn reals<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let list = Vec::<Option<f64>>::deserialize(deserializer)?;
    Ok(list.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
}
