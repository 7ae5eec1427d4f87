//! Values that programs stumble over.

use crate::draw::Draw;

/// As they stand in a scene behind the equals sign.
const VALUES: &[&str] = &[
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "5e-324",
    "1e-300",
    "1e-30",
    "1e-9",
    "1e9",
    "1e30",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "4294967296",
    "2147483648",
    "65536",
    "1000000000",
    "100000",
    "0x7fffffffffffffff",
    "true",
    "false",
    "1979-05-27",
    "07:32:00",
    "\"\"",
    "\" \"",
    "\"6\"",
    "\"nan\"",
    "\"inf\"",
    "\"nan m\"",
    "\"1e400 m\"",
    "\"1e-400 m\"",
    "\"-1 mm\"",
    "\"0 mm\"",
    "\"1 mm\"",
    "\"1 km\"",
    "\"1e300 s\"",
    "\"1e-300 s\"",
    "\"1 s\"",
    "\"1 ns\"",
    "\"6,5 mm\"",
    "\"6 furlong\"",
    "\"1 m/s\"",
    "\"1 kg/m s\"",
    "\"1e30 kg\"",
    "\"1e-30 g\"",
    "\"1 g\"",
    "\"1 Hz\"",
    "\"1e300 Hz\"",
    "\"10 %\"",
    "\"1e300 Pa\"",
    "\"1 Pa\"",
    "\"automatic\"",
    "\"step\"",
    "\"end\"",
    "\"never\"",
    "\"x\"",
    "\"-z\"",
    "\"dem\"",
    "\"lattice\"",
    "\"日本語 mm\"",
    "\"1 µm\"",
    "\"1\\u0000m\"",
    "\"\\u001b[31m\"",
    "\"\\u202e\"",
    "\"../../../etc/passwd\"",
    "\"/dev/null\"",
    "\".\"",
    "\"no-such-file.csv\"",
    "[]",
    "[[]]",
    "[nan]",
    "[0]",
    "[1, 0]",
    "[0, 1]",
    "[1, 2, 3]",
    "[0, 0, 0]",
    "[1e308, 1e308]",
    "[\"1 m\", \"2 m\"]",
    "[\"2 m\", \"1 m\"]",
    "[[1, 2], [3, 4]]",
    "[[1, 2, 3]]",
    "[[0, 0], [0, 0]]",
    "[1, \"a\", true]",
    "[\"sand\", \"sand\"]",
    "{}",
    "{ x = 1 }",
    "{ low = [0, 0], high = [1, 1] }",
    "{ low = [1, 1], high = [0, 0] }",
    "{ from = 0, to = 1e9, step = 1e-9 }",
    "{ from = 1, to = 0, step = 0 }",
    "{ sine = { amplitude = 1, frequency = 1 } }",
    "{ table = { time = [0, 0], value = [1] } }",
    "[{}]",
    "[{ x = 1 }]",
];

/// A value as text.
pub fn text(draw: &mut Draw) -> String {
    match draw.below(60) {
        0 => format!("\"{}\"", "é".repeat(1 << draw.below(16))),
        1 => "9".repeat(1 << draw.below(10)),
        2 => format!("[{}]", "1, ".repeat(1 << draw.below(12))),
        3 => format!("{:e}", f64::from_bits(draw.whole())),
        _ => (*draw.pick(VALUES)).to_owned(),
    }
}

/// A value that TOML can read.
pub fn value(draw: &mut Draw) -> toml::Value {
    let text = text(draw);
    let table: Option<toml::Table> = format!("x = {text}").parse().ok();
    table.and_then(|mut table| table.remove("x")).unwrap_or(toml::Value::Float(f64::NAN))
}

/// The word with one slip of the hand.
pub fn misspelt(draw: &mut Draw, word: &str) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    if letters.is_empty() {
        return "x".to_owned();
    }
    let at = draw.below(letters.len());
    match draw.below(4) {
        0 => letters.insert(at, letters[at]),
        1 => letters[at] = if letters[at] == 'e' { 'a' } else { 'e' },
        2 if letters.len() > 1 => drop(letters.remove(at)),
        _ if at > 0 => letters.swap(at - 1, at),
        _ => letters.push('s'),
    }
    letters.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::VALUES;

    #[test]
    fn every_value_is_toml() {
        for text in VALUES {
            assert!(format!("x = {text}").parse::<toml::Table>().is_ok(), "{text}");
        }
    }
}
