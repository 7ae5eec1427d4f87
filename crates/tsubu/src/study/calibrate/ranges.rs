//! Ranges of keys: from a place between 0 and 1 along each to the values of a run.

use crate::study::cases::{Case, name};
use tsubu_scene::plan::Calibrate;

/// Ends farther apart than this factor count by their logarithm.
const DECADE: f64 = 10.0;
/// Digits of a value that is tried.
const DIGITS: usize = 6;

/// The range of a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    pub key: String,
    pub low: f64,
    pub high: f64,
    /// As it is typed behind the number; empty for plain numbers.
    pub unit: String,
    /// Whether only whole numbers are values.
    whole: bool,
    /// Whether equal steps are equal factors.
    logarithmic: bool,
}

impl Range {
    /// All ranges of a calibration; in words why one is none.
    pub fn all(wanted: &Calibrate) -> Result<Vec<Self>, String> {
        wanted.vary.iter().map(|(key, ends)| Self::new(key, ends)).collect()
    }

    fn new(key: &str, ends: &[toml::Value]) -> Result<Self, String> {
        let example = "for example [0.2, 0.8] or [\"1 mm\", \"3 mm\"]";
        let numbers: Option<Vec<(f64, &str)>> = ends.iter().map(number).collect();
        let Some([(low, unit), (high, other)]) = numbers.as_deref() else {
            return Err(format!("`calibrate.vary` needs two numbers for `{key}`, {example}"));
        };
        if unit != other {
            return Err(format!(
                "`calibrate.vary` has two units for `{key}`, `{unit}` and `{other}`: write both ends in one"
            ));
        }
        if low >= high || !(high - low).is_finite() {
            return Err(format!("`calibrate.vary` has no range for `{key}`: {low} is not less than {high}"));
        }
        let whole = ends.iter().all(toml::Value::is_integer);
        let logarithmic = *low > 0.0 && high / low >= DECADE;
        Ok(Self { key: key.to_owned(), low: *low, high: *high, unit: (*unit).to_owned(), whole, logarithmic })
    }

    /// The value at a place from 0 to 1, in the unit of the range.
    pub fn value(&self, place: f64) -> f64 {
        let value = if self.logarithmic {
            self.low * (self.high / self.low).powf(place)
        } else {
            self.low + (self.high - self.low) * place
        };
        if self.whole { value.round() } else { value }
    }

    /// Where a value lies.
    fn place(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    fn typed(&self, place: f64) -> toml::Value {
        let value = self.value(place);
        if self.whole {
            return toml::Value::Integer(value as i64);
        }
        let value: f64 = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
        if self.unit.is_empty() { value.into() } else { format!("{value} {}", self.unit).into() }
    }

    /// The case at a place, and the place that its values have, which are written with a few digits.
    pub fn case(ranges: &[Self], place: &[f64]) -> (Case, Vec<f64>) {
        let values: Vec<(String, toml::Value)> =
            ranges.iter().zip(place).map(|(range, place)| (range.key.clone(), range.typed(*place))).collect();
        let exact = ranges.iter().zip(&values).map(|(range, (_, value))| number(value).map(|(x, _)| range.place(x)));
        let exact = exact.zip(place).map(|(exact, place)| exact.unwrap_or(*place)).collect();
        (Case { name: name(&values), values }, exact)
    }
}

/// A number, and what stands behind it.
fn number(value: &toml::Value) -> Option<(f64, &str)> {
    match value {
        toml::Value::Integer(x) => Some((*x as f64, "")),
        toml::Value::Float(x) => Some((*x, "")),
        toml::Value::String(text) => {
            let text = text.trim();
            let end =
                (1..=text.len()).rev().find(|end| text.get(..*end).is_some_and(|part| part.parse::<f64>().is_ok()))?;
            Some((text[..end].parse().ok()?, text[end..].trim()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_a_value_and_back() {
        let stiff = Range::new("a.stiffness", &["1 MPa".into(), "1e3 MPa".into()]).expect("a range");
        assert!((stiff.value(1.0 / 3.0) - 10.0).abs() < 1e-9, "equal steps are equal factors");
        let count = Range::new("a.count", &[1.into(), 5.into()]).expect("a range");
        let (case, place) = Range::case(&[stiff, count], &[0.123_456_789, 0.6]);
        assert_eq!(case.values[1].1, 3.into());
        assert_eq!(place[1], 0.5);
        assert!((place[0] - 0.123_456_789).abs() < 1e-5 && case.name.ends_with("MPa, count = 3"), "{}", case.name);
    }

    #[test]
    fn what_is_no_range_is_said() {
        for (ends, said) in [
            (["1 mm".into(), "2 cm".into()], "two units"),
            ([0.5.into(), 0.5.into()], "not less than"),
            ([true.into(), false.into()], "two numbers"),
            (["steel".into(), "glass".into()], "two numbers"),
        ] {
            let told = Range::new("key", &ends).expect_err("no range");
            assert!(told.contains(said), "{told}");
        }
    }
}
