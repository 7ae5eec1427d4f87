//! Quantities for readers: a number and the unit, with the prefix, in which it is short.

use crate::text::{self, short};
use tsubu_frame::unit::for_people;

/// The factor and prefix with which values up to `largest` read as short numbers. Only units that take prefixes in
/// practice get one; angles are read in degrees.
pub fn prefix(unit: &str, largest: f64) -> (f64, String) {
    let (factor, found) = prefixed(unit, largest);
    (factor, text::unit(&found))
}

fn prefixed(unit: &str, largest: f64) -> (f64, String) {
    let (angle, degrees) = for_people(unit);
    if degrees != unit {
        return (angle, degrees.to_owned());
    }
    let takes = matches!(unit, "m" | "s" | "J" | "N" | "W" | "m/s" | "Pa" | "J/s" | "Hz");
    if !takes || !largest.is_finite() || largest <= 0.0 {
        return (1.0, unit.to_owned());
    }
    // Long times are told in seconds, great lengths in metres.
    let steps: &[(f64, f64, &str)] = match unit {
        "m" | "s" | "m/s" => &[(0.1, 1.0, ""), (0.5e-4, 1e3, "m"), (0.5e-7, 1e6, "µ")],
        _ => &[
            (1e9, 1e-9, "G"),
            (1e6, 1e-6, "M"),
            (1e3, 1e-3, "k"),
            (0.5, 1.0, ""),
            (0.5e-3, 1e3, "m"),
            (0.5e-6, 1e6, "µ"),
        ],
    };
    steps
        .iter()
        .find(|(from, _, _)| largest >= *from)
        .map_or((1e9, format!("n{unit}")), |(_, factor, sign)| (*factor, format!("{sign}{unit}")))
}

/// A quantity with the prefix that makes it short.
pub(crate) fn quantity(x: f64, unit: &str) -> (String, String) {
    let (factor, unit) = prefix(unit, x.abs());
    (short(x * factor), if unit == "-" { String::new() } else { unit })
}

/// The same as one text.
pub(crate) fn spoken(x: f64, unit: &str) -> String {
    let (value, unit) = quantity(x, unit);
    if unit.is_empty() { value } else { format!("{value} {unit}") }
}

/// Prefixes of units that scenes know.
const PREFIXES: [(&str, f64); 9] =
    [("", 1.0), ("n", 1e-9), ("u", 1e-6), ("µ", 1e-6), ("m", 1e-3), ("c", 1e-2), ("k", 1e3), ("M", 1e6), ("G", 1e9)];

/// Values as a scene writes them in the unit of the first of them; nothing where one is no number, or of another unit than by its prefix.
pub(crate) fn of_one_unit(values: &[String]) -> Option<(Vec<f64>, String)> {
    let parts = |text: &String| {
        let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
        Some((number.parse::<f64>().ok()?, unit.trim().to_owned()))
    };
    let values: Vec<(f64, String)> = values.iter().map(parts).collect::<Option<_>>()?;
    let unit = values.first()?.1.clone();
    let numbers = values.iter().map(|(x, other)| Some(x * times(other, &unit)?)).collect::<Option<_>>()?;
    Some((numbers, if unit.is_empty() { "-".to_owned() } else { unit }))
}

/// How many of another unit one is, where they differ by their prefixes alone.
fn times(one: &str, other: &str) -> Option<f64> {
    if one == other {
        return Some(1.0);
    }
    let base =
        |unit: &'_ str, prefix: &str| unit.strip_prefix(prefix).filter(|base| !base.is_empty()).map(str::to_owned);
    let pairs = PREFIXES.iter().flat_map(|of_one| PREFIXES.iter().map(move |of_other| (of_one, of_other)));
    let mut same = pairs.filter(|(of_one, of_other)| base(one, of_one.0) == base(other, of_other.0));
    // A thousandth of a length is a millionth of its square.
    let ((_, factor), (_, divisor)) = same.find(|pair| base(one, pair.0.0).is_some() && !one.contains('^'))?;
    Some(factor / divisor)
}

#[cfg(test)]
mod tests {
    use super::of_one_unit;

    /// 0.6 cm stood at 0.6 of an axis in mm.
    #[test]
    fn values_are_told_in_one_unit() {
        let read = |values: &[&str]| of_one_unit(&values.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>());
        let (numbers, unit) = read(&["2 mm", "0.6 cm", "0.008 m"]).expect("lengths");
        assert!(numbers.iter().zip([2.0, 6.0, 8.0]).all(|(a, b)| (a - b).abs() < 1e-9) && unit == "mm", "{numbers:?}");
        assert_eq!(read(&["20 us", "2 ms"]).map(|found| found.0[1].round()), Some(2000.0));
        assert_eq!(read(&["0.5", "1"]), Some((vec![0.5, 1.0], "-".to_owned())));
        for other in [["2 mm", "3"], ["2 mm", "3 s"], ["2 mm^2", "3 m^2"], ["2 mm", "steel"]] {
            assert_eq!(read(&other), None, "{other:?}");
        }
    }
}
