//! Quantities in text: `"6 mm"`, `"0.08 N s/m"`, `"2650 kg/m^3"`.
//!
//! A number without quotes is taken in SI units; text must carry a unit, because `"6"` in a file of millimetres and
//! grams is a guess waiting to go wrong. Scaling by powers of ten is done on the decimal text, so that `"6 mm"` is
//! the same double as `0.006`.

mod expression;

use expression::Unit;

/// A kind of quantity: what it is called, its SI unit, and the units people write it in.
#[derive(Debug, PartialEq)]
pub struct Dimension {
    /// What it is called, with its article: "a length".
    pub name: &'static str,
    /// The SI unit, empty for plain numbers.
    pub si: &'static str,
    /// Powers of metre, kilogram, second and radian.
    powers: [i8; 4],
    /// Smallest and largest magnitude that can be meant, far outside of what anybody simulates: numbers beyond are slips, and
    /// their squares and quotients no numbers any more.
    limits: [f64; 2],
    /// Units worth suggesting.
    pub units: &'static [&'static str],
    /// Text a user could have typed.
    pub examples: &'static [&'static str],
}

macro_rules! dimensions {
    ($($id:ident $name:literal $si:literal $powers:tt $limits:tt $units:tt $examples:tt $doc:literal)*) => {
        $(#[doc = $doc] pub static $id: Dimension =
            Dimension { name: $name, si: $si, powers: $powers, limits: $limits, units: &$units, examples: &$examples };)*
        /// Every dimension a scene can ask for.
        pub static DIMENSIONS: &[&Dimension] = &[$(&$id),*];
    };
}

dimensions! {
    NUMBER "a plain number" "" [0, 0, 0, 0] [1e-30, 1e30] ["%"] ["0.75", "75 %"] "Plain numbers."
    LENGTH "a length" "m" [1, 0, 0, 0] [1e-12, 1e9] ["m", "cm", "mm", "um", "km"] ["6 mm", "0.096 m"] "Lengths."
    MASS "a mass" "kg" [0, 1, 0, 0] [1e-27, 1e18] ["kg", "g", "mg", "t"] ["0.2 g", "86 g"] "Masses."
    TIME "a time" "s" [0, 0, 1, 0] [1e-15, 1e12] ["s", "ms", "us", "ns", "min", "h"] ["2 s", "20 us"] "Times."
    FREQUENCY "a frequency" "Hz" [0, 0, -1, 0] [1e-12, 1e15] ["Hz", "kHz", "1/s"] ["6 Hz"] "Frequencies, in cycles."
    SPEED "a speed" "m/s" [1, 0, -1, 0] [1e-15, 1e9] ["m/s", "mm/s", "cm/s", "km/h"] ["1 m/s", "5 mm/s"] "Speeds."
    ACCELERATION "an acceleration" "m/s^2" [1, 0, -2, 0] [1e-15, 1e12] ["m/s^2", "mm/s^2", "cm/s^2", "g"] ["9.8 m/s^2", "2 g"]
        "Accelerations; g is standard gravity, 9.80665 m/s^2."
    ACCELERATION_DENSITY "a spectral density of acceleration" "(m/s^2)^2/Hz" [2, 0, -3, 0] [1e-30, 1e24]
        ["(m/s^2)^2/Hz", "m^2/s^3", "g^2/Hz"] ["0.04 g^2/Hz", "4 m^2/s^3"] "Power spectral densities of accelerations; g is standard gravity."
    FORCE_DENSITY "a spectral density of force" "N^2/Hz" [2, 2, -3, 0] [1e-40, 1e36] ["N^2/Hz"] ["0.5 N^2/Hz"]
        "Power spectral densities of forces."
    FORCE "a force" "N" [1, 1, -2, 0] [1e-30, 1e18] ["N", "mN", "kN"] ["61.7 mN", "2 N"] "Forces."
    STIFFNESS "a stiffness" "N/m" [0, 1, -2, 0] [1e-20, 1e20] ["N/m", "N/mm", "kN/m", "N/cm"] ["123.4 N/m"] "Stiffnesses."
    CUBIC_STIFFNESS "a cubic stiffness" "N/m^3" [-2, 1, -2, 0] [1e-20, 1e30] ["N/m^3", "N/mm^3"] ["2e6 N/m^3"] "Stiffnesses that grow with the square of the stretch."
    DAMPING "a damping coefficient" "N s/m" [0, 1, -1, 0] [1e-25, 1e20] ["N s/m", "N.s/m", "N s/mm", "kg/s"] ["0.08 N s/m"]
        "Coefficients of viscous damping."
    PRESSURE "a pressure or modulus" "Pa" [-1, 1, -2, 0] [1e-15, 1e25] ["Pa", "kPa", "MPa", "GPa", "N/mm^2"] ["0.5 GPa", "3 MPa"]
        "Pressures and elastic moduli."
    DENSITY "a density" "kg/m^3" [-3, 1, 0, 0] [1e-9, 1e9] ["kg/m^3", "g/cm^3"] ["2650 kg/m^3", "1.18 g/cm^3"] "Densities."
    ANGLE "an angle" "rad" [0, 0, 0, 1] [1e-15, 1e9] ["deg", "rad"] ["40 deg", "0.5 rad"] "Angles."
    SPIN "an angular speed" "rad/s" [0, 0, -1, 1] [1e-15, 1e12] ["rad/s", "deg/s", "rpm"] ["10 rad/s", "95 rpm"] "Angular speeds."
    TURN_PER_LENGTH "a rotation per length" "rad/m" [-1, 0, 0, 1] [1e-15, 1e15] ["rad/m", "deg/mm"] ["2 rad/m"] "Rotations for a unit of a coordinate."
    TURN_DAMPING "a torque over a spin" "N m s" [2, 1, -1, 0] [1e-30, 1e20] ["N m s", "N mm s"] ["2 mN m s"]
        "Coefficients of viscous damping of a turning body."
    AREA "an area" "m^2" [2, 0, 0, 0] [1e-24, 1e18] ["m^2", "cm^2", "mm^2"] ["4 cm^2", "1e-4 m^2"] "Areas."
    VOLUME "a volume" "m^3" [3, 0, 0, 0] [1e-36, 1e27] ["m^3", "L", "cm^3", "mm^3"] ["0.5 L", "300 cm^3"] "Volumes; a litre is L."
    INERTIA "a moment of inertia" "kg m^2" [2, 1, 0, 0] [1e-50, 1e30] ["kg m^2", "g cm^2", "g mm^2"] ["2 g cm^2"] "Moments of inertia."
    AREA_RATE "an area per time" "m^2/s" [2, 0, -1, 0] [1e-20, 1e12] ["m^2/s", "cm^2/s", "mm^2/s"] ["1e-6 m^2/s", "1 mm^2/s"]
        "Areas per time: kinematic viscosities, discharges per width."
    RATE "a rate" "1/s" [0, 0, -1, 0] [1e-12, 1e15] ["1/s", "1/ms", "1/min"] ["500 1/s"] "Rates: so many in a second."
    DISC_DAMPING "a rate per length" "1/(m s)" [-1, 0, -1, 0] [1e-12, 1e18] ["1/(m s)", "1/(mm s)"] ["5e5 1/(m s)"]
        "Rates per length: damping in proportion to the radius of the contact disc."
    SLOWNESS "an inverse speed" "s/m" [-1, 0, 1, 0] [1e-12, 1e15] ["s/m", "s/mm"] ["0.5 s/m"] "Inverse speeds."
    LOAD_RATE "a rate of force" "N/s" [1, 1, -3, 0] [1e-25, 1e20] ["N/s", "kN/s", "N/ms"] ["2 N/s"] "Forces that grow."
    ENERGY_DENSITY "an energy density" "J/m^3" [-1, 1, -2, 0] [1e-15, 1e15] ["J/m^3", "kJ/m^3", "Pa", "kPa"] ["300 kJ/m^3"] "Energy densities."
    VISCOSITY "a viscosity" "Pa s" [-1, 1, -1, 0] [1e-15, 1e15] ["Pa s", "mPa s", "kg/(m s)"] ["1 mPa s"] "Viscosities, mass per length and time."
    ENERGY "an energy" "J" [2, 1, -2, 0] [1e-30, 1e20] ["J", "mJ"] ["1e-9 J", "0.2 mJ"] "Energies."
    SURFACE_ENERGY "a surface energy" "J/m^2" [0, 1, -2, 0] [1e-15, 1e9] ["J/m^2", "mJ/m^2"] ["50 mJ/m^2"] "Surface energies."
}

impl Dimension {
    /// Examples, quoted as in a scene: `"6 mm"` or `"0.096 m"`.
    pub fn examples_text(&self) -> String {
        let quoted: Vec<String> = self.examples.iter().map(|text| quote_example(text)).collect();
        quoted.join(" or ")
    }

    /// Why a number cannot be meant: it is too large, or, where only what is `above_zero` counts, too small.
    pub(crate) fn absurd(&self, value: f64, above_zero: bool) -> Option<String> {
        let [smallest, largest] = self.limits;
        let told = |what, limit: f64| Some(format!("{what} {limit:e} {}", self.si).trim_end().to_string());
        match value.abs() {
            x if x > largest => told("is beyond", largest),
            x if above_zero && x < smallest => told("is below", smallest),
            _ => None,
        }
    }

    /// The units worth suggesting, as one line.
    pub fn units_text(&self) -> String {
        self.units.join(", ")
    }
}

/// A plain number is typed without quotes, anything with a unit needs them.
fn quote_example(text: &str) -> String {
    if text.parse::<f64>().is_ok() { text.to_string() } else { format!("\"{text}\"") }
}

/// Why a text is not the quantity that is needed here.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitError {
    /// One line: what is wrong.
    pub title: String,
    /// A few words for under the offending text.
    pub label: String,
    /// Ways out.
    pub hints: Vec<String>,
}

impl UnitError {
    fn new(title: impl Into<String>, label: impl Into<String>) -> Self {
        Self { title: title.into(), label: label.into(), hints: Vec::new() }
    }

    fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }
}

/// Reads a quantity with its unit and gives it in SI.
pub fn read(text: &str, want: &Dimension) -> Result<f64, UnitError> {
    let trimmed = text.trim();
    let Some((number, rest)) = split_number(trimmed) else {
        return Err(no_number(trimmed, want));
    };
    let unit_text = rest.trim();
    if unit_text.is_empty() {
        return Err(missing_unit(trimmed, want));
    }
    if let Some(tail) = unit_text.strip_prefix(',')
        && tail.starts_with(|c: char| c.is_ascii_digit())
    {
        return Err(UnitError::new(format!("`{trimmed}` has a decimal comma"), "use a decimal point")
            .hint(format!("for example {}", want.examples_text())));
    }
    let unit = parse(unit_text, want).map_err(|problem| unknown(&problem, trimmed, want))?;
    if unit.powers != want.powers {
        return Err(wrong_dimension(trimmed, &unit, want));
    }
    let value = scale(number, &unit);
    if value.is_finite() {
        Ok(value)
    } else {
        Err(UnitError::new(format!("`{trimmed}` is too large to be stored"), "not a finite number"))
    }
}

/// A lone g is a gram, but no acceleration is in grams, and no density of it in their squares.
fn parse(text: &str, want: &Dimension) -> Result<Unit, expression::Problem> {
    if *want == ACCELERATION && text == "g" {
        return Ok(Unit { ratio: STANDARD_GRAVITY, ten: 0, powers: ACCELERATION.powers });
    }
    if *want == ACCELERATION_DENSITY && ["g^2/Hz", "g²/Hz", "g2/Hz"].contains(&text) {
        return Ok(Unit { ratio: STANDARD_GRAVITY * STANDARD_GRAVITY, ten: 0, powers: ACCELERATION_DENSITY.powers });
    }
    expression::parse(text)
}

/// Standard gravity [m/s^2].
const STANDARD_GRAVITY: f64 = 9.80665;

/// A unit of a whole column, read once for all its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale(Option<Unit>);

impl Scale {
    /// Numbers that are SI already.
    pub const SI: Self = Self(None);

    /// The unit `text`, which must be one of `want`.
    pub fn read(text: &str, want: &Dimension) -> Result<Self, UnitError> {
        // As a quantity, so that what is wrong is said in the same words.
        read(&format!("1 {text}"), want)?;
        Ok(Self(parse(text.trim(), want).ok()))
    }

    /// The number in SI; `None` where the text is no number, infinite where it is too large.
    pub fn apply(self, number: &str) -> Option<f64> {
        let plain: f64 = number.parse().ok()?;
        Some(match self.0 {
            Some(unit) if plain.is_finite() => scale(number, &unit),
            _ => plain,
        })
    }
}

/// Whether the text alone is a unit of any kind.
pub(crate) fn is_unit(text: &str) -> bool {
    expression::parse(text).is_ok_and(|unit| unit.powers != NUMBER.powers)
}

/// Splits the longest number off the front. `6e3 m` has an exponent, `6 em` does not.
fn split_number(text: &str) -> Option<(&str, &str)> {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        let begin = at;
        while bytes.get(at).is_some_and(|b| b.is_ascii_digit() || (*b == b'_' && at > begin)) {
            at += 1;
        }
        at
    };
    let start = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut end = digits(start);
    let mut count = end - start;
    if bytes.get(end) == Some(&b'.') {
        let after = digits(end + 1);
        count += after - end - 1;
        // `6.mm` would be a product of nothing: leave a lone point to the unit, which then complains.
        if after > end + 1 {
            end = after;
        }
    }
    if count == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let after = digits(end + 1 + sign);
        if after > end + 1 + sign {
            end = after;
        }
    }
    Some((&text[..end], &text[end..]))
}

/// Number times unit. The power of ten goes into the decimal text: one correct rounding instead of two.
fn scale(number: &str, unit: &Unit) -> f64 {
    let number = number.replace('_', "");
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>()),
        None => (number.as_str(), Ok(0)),
    };
    let decimal = match exponent {
        Ok(exponent) => format!("{mantissa}e{}", exponent.saturating_add(unit.ten)),
        Err(_) => number.clone(),
    };
    let value: f64 = decimal.parse().unwrap_or(f64::NAN);
    // Exactly one for every decimal unit, and then the product must not round again.
    if unit.ratio == 1.0 { value } else { value * unit.ratio }
}

fn no_number(text: &str, want: &Dimension) -> UnitError {
    let lower = text.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if lower.starts_with("nan") || lower.starts_with("inf") {
        return UnitError::new(format!("`{text}` is not a finite number"), format!("needs {}", want.name));
    }
    UnitError::new(
        format!("`{text}` does not begin with a number"),
        format!("needs {}, such as {}", want.name, want.examples_text()),
    )
}

fn missing_unit(text: &str, want: &Dimension) -> UnitError {
    if want.si.is_empty() {
        return UnitError::new(format!("the number {text} is in quotes"), "a plain number is needed")
            .hint(format!("write {text} without quotes"));
    }
    UnitError::new(format!("`{text}` has no unit"), format!("needs {} with its unit", want.name))
        .hint(format!("text needs a unit, for example {}", want.examples_text()))
        .hint(format!("a number without quotes is taken in SI units: {text} means {text} {}", want.si))
}

fn unknown(problem: &expression::Problem, text: &str, want: &Dimension) -> UnitError {
    match problem {
        expression::Problem::Symbol(symbol) => {
            let mut error = UnitError::new(format!("unknown unit `{symbol}` in `{text}`"), "not a unit known here");
            if let Some(near) = crate::suggest::nearest(symbol, want.units.iter().copied()) {
                error = error.hint(format!("did you mean `{near}`?"));
            }
            error.hint(format!("{} is written in: {}", want.name, want.units_text()))
        }
        expression::Problem::Ambiguous => {
            UnitError::new(format!("the unit of `{text}` can be read in two ways"), "what does the slash divide?")
                .hint("put the divisor in brackets, as in kg/(m s), or write products first, as in N s/m")
        }
        expression::Problem::Form => UnitError::new(format!("the unit of `{text}` cannot be read"), "not a unit")
            .hint("units are built like N s/m, m/s^2, kg/m^3")
            .hint(format!("{} is written in: {}", want.name, want.units_text())),
    }
}

fn wrong_dimension(text: &str, unit: &Unit, want: &Dimension) -> UnitError {
    let found = DIMENSIONS.iter().find(|dimension| dimension.powers == unit.powers);
    let what = found.map_or_else(|| "a quantity of another kind".to_string(), |dimension| dimension.name.to_string());
    let error = UnitError::new(format!("`{text}` is {what}, not {}", want.name), format!("needs {}", want.name));
    if want.si.is_empty() {
        return error.hint("a plain number has no unit: write it without quotes");
    }
    error.hint(format!("for example {}; known units: {}", want.examples_text(), want.units_text()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn si(text: &str, want: &Dimension) -> f64 {
        read(text, want).unwrap_or_else(|error| panic!("{text}: {error:?}"))
    }

    #[test]
    fn common_quantities_are_the_same_doubles_as_their_si_numbers() {
        assert_eq!(si("6 mm", &LENGTH), 0.006);
        assert_eq!(si("6mm", &LENGTH), 0.006);
        assert_eq!(si("0.2 g", &MASS), 0.0002);
        assert_eq!(si("123.4 N/m", &STIFFNESS), 123.4);
        assert_eq!(si("1 N/cm", &STIFFNESS), 100.0);
        assert_eq!(si("0.5 GPa", &PRESSURE), 0.5e9);
        assert_eq!(si("2650 kg/m^3", &DENSITY), 2650.0);
        assert_eq!(si("1.18 g/cm3", &DENSITY), 1180.0);
        assert_eq!(si("1.18 g cm⁻³", &DENSITY), 1180.0);
        assert_eq!(si("0.08 N s/m", &DAMPING), 0.08);
        assert_eq!(si("0.08 N.s/m", &DAMPING), 0.08);
        assert_eq!(si("0.08 N·s/m", &DAMPING), 0.08);
        assert_eq!(si("0.08 N/(m/s)", &DAMPING), 0.08);
        assert_eq!(si("20 us", &TIME), 2e-5);
        assert_eq!(si("20 µs", &TIME), 2e-5);
        assert_eq!(si("2 min", &TIME), 120.0);
        assert_eq!(si("6 Hz", &FREQUENCY), 6.0);
        assert_eq!(si("6 1/s", &FREQUENCY), 6.0);
        assert_eq!(si("9.8 m/s^2", &ACCELERATION), 9.8);
        assert_eq!(si("9.8 m/s/s", &ACCELERATION), 9.8);
        assert_eq!(si("9.8 m/s²", &ACCELERATION), 9.8);
        assert_eq!(si("2 g", &ACCELERATION), 19.6133);
        assert_eq!(si("1 g^2/Hz", &ACCELERATION_DENSITY), 9.80665 * 9.80665);
        assert_eq!(si("3 (m/s^2)^2/Hz", &ACCELERATION_DENSITY), 3.0);
        assert_eq!(si("4 N^2/Hz", &FORCE_DENSITY), 4.0);
        assert_eq!(si("180 deg", &ANGLE), std::f64::consts::PI);
        assert_eq!(si("60 rpm", &SPIN), 2.0 * std::f64::consts::PI);
        assert_eq!(si("75 %", &NUMBER), 0.75);
        assert_eq!(si("-1_000.5e-3 m", &LENGTH), -1.0005);
    }

    #[test]
    fn every_suggested_unit_and_example_can_be_read() {
        for dimension in DIMENSIONS {
            for unit in dimension.units {
                si(&format!("1 {unit}"), dimension);
            }
            for example in dimension.examples.iter().filter(|text| text.parse::<f64>().is_err()) {
                si(example, dimension);
            }
            if !dimension.si.is_empty() {
                assert_eq!(si(&format!("1 {}", dimension.si), dimension), 1.0);
            }
        }
    }

    #[test]
    fn what_is_not_the_quantity_is_refused() {
        let wrong = ["6", "mm", "", "6 kg", "nan m", "inf m", "6 mn", "1e999 m", "6,5 mm", "6 m/", "6 m)", "6 m^^2"];
        for text in wrong {
            assert!(read(text, &LENGTH).is_err(), "{text}");
        }
        assert!(read("1 kg/m s", &PRESSURE).is_err(), "a slash before a product is ambiguous");
        assert!(read("10 1/s", &SPIN).is_err(), "cycles or radians?");
    }

    proptest! {
        #[test]
        fn any_number_survives_the_trip_through_text(value in proptest::num::f64::NORMAL) {
            prop_assert_eq!(si(&format!("{value:?} m"), &LENGTH), value);
            prop_assert_eq!(si(&format!("{value:e} m"), &LENGTH), value);
        }

        #[test]
        fn a_prefix_only_moves_the_decimal_point(digits in 1_i64..1_000_000_000, point in -8_i32..8) {
            let expected: f64 = format!("{digits}e{}", point - 3).parse().expect("a number");
            prop_assert_eq!(si(&format!("{digits}e{point} mm"), &LENGTH), expected);
        }

        #[test]
        fn no_text_makes_the_reader_panic(text in ".{0,40}") {
            for dimension in DIMENSIONS {
                let _ = read(&text, dimension);
                let _ = read(&format!("1 {text}"), dimension);
            }
        }
    }
}
