//! Ranges of keys: from a place between 0 and 1 along each to the values of a run.

use crate::study::cases::{Case, name};
use std::collections::BTreeMap;
use tsubu_scene::range::{ends, number, value};

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
    /// All ranges of a study; in words why one is none.
    pub fn all(study: &str, vary: &BTreeMap<String, Vec<toml::Value>>) -> Result<Vec<Self>, String> {
        vary.iter().map(|(key, ends)| Self::new(study, key, ends)).collect()
    }

    /// From two values, or from `[{ from, to }]`.
    pub fn new(study: &str, key: &str, values: &[toml::Value]) -> Result<Self, String> {
        let ends = ends(values).map_or_else(|| values.to_vec(), Vec::from);
        let example = "for example [0.2, 0.8] or [\"1 mm\", \"3 mm\"]";
        let numbers: Option<Vec<(f64, &str)>> = ends.iter().map(number).collect();
        let Some([(low, unit), (high, other)]) = numbers.as_deref() else {
            return Err(format!("`{study}.vary` needs two numbers for `{key}`, {example}"));
        };
        if unit != other {
            return Err(format!(
                "`{study}.vary` has two units for `{key}`, `{unit}` and `{other}`: write both ends in one"
            ));
        }
        if low >= high || !(high - low).is_finite() {
            return Err(format!("`{study}.vary` has no range for `{key}`: {low} is not less than {high}"));
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

    /// The same as it is typed.
    pub fn typed(&self, place: f64) -> toml::Value {
        let size = self.value(place);
        let few = if self.whole { size } else { format!("{size:.*e}", DIGITS - 1).parse().unwrap_or(size) };
        value(few, &self.unit, self.whole)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_a_value_and_back() {
        let stiff = Range::new("calibrate", "a.stiffness", &["1 MPa".into(), "1e3 MPa".into()]).expect("a range");
        assert!((stiff.value(1.0 / 3.0) - 10.0).abs() < 1e-9, "equal steps are equal factors");
        let count = Range::new("calibrate", "a.count", &[1.into(), 5.into()]).expect("a range");
        let (case, place) = Range::case(&[stiff, count], &[0.123_456_789, 0.6]);
        assert_eq!(case.values[1].1, 3.into());
        assert_eq!(place[1], 0.5);
        let table: toml::Table = "from = 1\nto = 5".parse().expect("a table");
        assert_eq!(Range::new("design", "a.count", &[table.into()]).map(|range| range.typed(0.6)), Ok(3.into()));
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
            let told = Range::new("calibrate", "key", &ends).expect_err("no range");
            assert!(told.contains(said), "{told}");
        }
    }
}
