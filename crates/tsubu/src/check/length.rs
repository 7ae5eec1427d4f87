//! Lengths in words.

/// In the unit that people would take.
pub(crate) fn length(metres: f64) -> String {
    let (number, unit) = match metres {
        x if x >= 1.0 || x == 0.0 => (x, "m"),
        x if x >= 1e-3 => (x * 1e3, "mm"),
        x => (x * 1e6, "um"),
    };
    format!("{} {unit}", format!("{number:.3e}").parse::<f64>().unwrap_or(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_read_well() {
        assert_eq!([80.0, 0.25, 0.0035, 2e-5, 0.0].map(length), ["80 m", "250 mm", "3.5 mm", "20 um", "0 m"]);
    }
}
