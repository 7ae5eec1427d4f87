//! Unit expressions: products, quotients and powers of named units.
//!
//! ```text
//! expression = product { "/" divisor }
//! product    = factor { ( " " | "." | "*" ) factor }
//! divisor    = factor                         one factor only: kg/m s could mean two things
//! factor     = ( "(" expression ")" | symbol | "1" ) [ power ]
//! ```

use std::f64::consts::PI;

/// What a unit is in SI: `ratio * 10^ten` times the base units to their powers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    pub ratio: f64,
    pub ten: i32,
    pub powers: [i8; 4],
}

/// Why an expression is none.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Problem {
    /// A symbol that is not in the table.
    Symbol(String),
    /// A slash followed by a product without brackets.
    Ambiguous,
    /// Anything else.
    Form,
}

const ONE: Unit = Unit { ratio: 1.0, ten: 0, powers: [0; 4] };

/// A named unit and the prefixes it takes. Few on purpose: `Mm` is more often a slip than a megametre.
struct Symbol {
    name: &'static str,
    unit: Unit,
    prefixes: &'static str,
}

const fn symbol(name: &'static str, ten: i32, powers: [i8; 4], prefixes: &'static str) -> Symbol {
    Symbol { name, unit: Unit { ratio: 1.0, ten, powers }, prefixes }
}

const fn odd(name: &'static str, ratio: f64, powers: [i8; 4]) -> Symbol {
    Symbol { name, unit: Unit { ratio, ten: 0, powers }, prefixes: "" }
}

static SYMBOLS: &[Symbol] = &[
    symbol("m", 0, [1, 0, 0, 0], "kcmun"),
    symbol("g", -3, [0, 1, 0, 0], "kmun"),
    symbol("t", 3, [0, 1, 0, 0], ""),
    symbol("L", -3, [3, 0, 0, 0], "m"),
    symbol("s", 0, [0, 0, 1, 0], "mun"),
    odd("min", 60.0, [0, 0, 1, 0]),
    odd("h", 3600.0, [0, 0, 1, 0]),
    symbol("N", 0, [1, 1, -2, 0], "GMkmun"),
    symbol("Pa", 0, [-1, 1, -2, 0], "GMkhm"),
    symbol("bar", 5, [-1, 1, -2, 0], "m"),
    symbol("J", 0, [2, 1, -2, 0], "Mkmun"),
    symbol("W", 0, [2, 1, -3, 0], "Mkmun"),
    symbol("Hz", 0, [0, 0, -1, 0], "Mkm"),
    symbol("rad", 0, [0, 0, 0, 1], "m"),
    odd("deg", PI / 180.0, [0, 0, 0, 1]),
    odd("°", PI / 180.0, [0, 0, 0, 1]),
    odd("rev", 2.0 * PI, [0, 0, 0, 1]),
    odd("rpm", 2.0 * PI / 60.0, [0, 0, -1, 1]),
    symbol("%", -2, [0, 0, 0, 0], ""),
];

const fn prefix(letter: char) -> Option<(char, i32)> {
    Some(match letter {
        'G' => ('G', 9),
        'M' => ('M', 6),
        'k' => ('k', 3),
        'h' => ('h', 2),
        'c' => ('c', -2),
        'm' => ('m', -3),
        // u, the micro sign and the Greek letter are all in use.
        'u' | 'µ' | 'μ' => ('u', -6),
        'n' => ('n', -9),
        _ => return None,
    })
}

fn look_up(name: &str) -> Option<Unit> {
    if let Some(found) = SYMBOLS.iter().find(|symbol| symbol.name == name) {
        return Some(found.unit);
    }
    let mut letters = name.chars();
    let (letter, ten) = prefix(letters.next()?)?;
    let rest = letters.as_str();
    let base = SYMBOLS.iter().find(|symbol| symbol.name == rest && symbol.prefixes.contains(letter))?;
    Some(Unit { ten: base.unit.ten + ten, ..base.unit })
}

impl Unit {
    fn power(self, n: i32) -> Option<Self> {
        let mut powers = [0; 4];
        for (result, own) in powers.iter_mut().zip(self.powers) {
            *result = i8::try_from(i32::from(own).checked_mul(n)?).ok()?;
        }
        Some(Self { ratio: self.ratio.powi(n), ten: self.ten.checked_mul(n)?, powers })
    }

    fn times(self, other: Self) -> Option<Self> {
        let mut powers = [0; 4];
        for (result, (a, b)) in powers.iter_mut().zip(self.powers.into_iter().zip(other.powers)) {
            *result = a.checked_add(b)?;
        }
        Some(Self { ratio: self.ratio * other.ratio, ten: self.ten.checked_add(other.ten)?, powers })
    }
}

/// Reads a whole unit expression.
pub(super) fn parse(text: &str) -> Result<Unit, Problem> {
    let mut cursor = Cursor { rest: text, depth: 0 };
    let unit = cursor.expression()?;
    if cursor.rest.trim().is_empty() { Ok(unit) } else { Err(Problem::Form) }
}

struct Cursor<'a> {
    rest: &'a str,
    depth: u8,
}

impl Cursor<'_> {
    fn take(&mut self, accept: impl Fn(char) -> bool) -> bool {
        match self.rest.chars().next() {
            Some(c) if accept(c) => {
                self.rest = &self.rest[c.len_utf8()..];
                true
            }
            _ => false,
        }
    }

    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn expression(&mut self) -> Result<Unit, Problem> {
        // Each bracket is a call: text from outside must not choose how deep the stack goes.
        if self.depth > 8 {
            return Err(Problem::Form);
        }
        let mut result = self.factor()?;
        let mut divided = false;
        loop {
            self.skip_space();
            if self.take(|c| c == '/') {
                let divisor = self.factor()?.power(-1).ok_or(Problem::Form)?;
                result = result.times(divisor).ok_or(Problem::Form)?;
                divided = true;
                continue;
            }
            let product = self.take(|c| matches!(c, '.' | '*' | '·' | '⋅'));
            if !product && (self.rest.is_empty() || self.rest.starts_with(')')) {
                return Ok(result);
            }
            let factor = self.factor()?;
            if divided {
                return Err(Problem::Ambiguous);
            }
            result = result.times(factor).ok_or(Problem::Form)?;
        }
    }

    fn factor(&mut self) -> Result<Unit, Problem> {
        self.skip_space();
        let base = if self.take(|c| c == '(') {
            self.depth += 1;
            let inner = self.expression()?;
            self.depth -= 1;
            self.skip_space();
            if !self.take(|c| c == ')') {
                return Err(Problem::Form);
            }
            inner
        } else if self.take(|c| c == '1') {
            return Ok(ONE);
        } else {
            let begin = self.rest;
            while self.take(|c| c.is_alphabetic() || matches!(c, '%' | '°')) {}
            let name = &begin[..begin.len() - self.rest.len()];
            if name.is_empty() {
                return Err(Problem::Form);
            }
            look_up(name).ok_or_else(|| Problem::Symbol(name.to_string()))?
        };
        match self.exponent()? {
            Some(n) => base.power(n).ok_or(Problem::Form),
            None => Ok(base),
        }
    }

    /// `^2`, `^-2`, `**2`, `2`, or superscript figures.
    fn exponent(&mut self) -> Result<Option<i32>, Problem> {
        let marked = if self.rest.starts_with("**") {
            self.rest = &self.rest[2..];
            true
        } else {
            self.take(|c| c == '^')
        };
        let mut digits = String::new();
        while let Some(c) = self.rest.chars().next() {
            let Some(plain) = plain_figure(c).filter(|p| p.is_ascii_digit() || digits.is_empty()) else { break };
            // A bare minus after a symbol (`m-2`) is too easily a slip; it needs the mark or the superscript.
            if c == '-' && !marked {
                break;
            }
            digits.push(plain);
            self.rest = &self.rest[c.len_utf8()..];
        }
        if digits.is_empty() && !marked {
            return Ok(None);
        }
        match digits.parse::<i32>() {
            Ok(n) if n.abs() <= 9 => Ok(Some(n)),
            _ => Err(Problem::Form),
        }
    }
}

fn plain_figure(c: char) -> Option<char> {
    Some(match c {
        '0'..='9' | '-' => c,
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴'..='⁹' => char::from_digit(u32::from(c) - u32::from('⁰'), 10)?,
        _ => return None,
    })
}
