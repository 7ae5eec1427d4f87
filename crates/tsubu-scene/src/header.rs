//! The header of a table: cells that are `name`, `name [unit]` or `name (unit)`.
//!
//! Every table that a scene reads has its header read here, so that a unit is converted everywhere, or refused.

use crate::complaint::Complaint;
use crate::lines::{Cell, Line};
use crate::units::{self, Dimension, Scale};

/// One cell of a header.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Header<'a> {
    pub cell: Cell<'a>,
    pub name: &'a str,
    unit: Option<&'a str>,
}

/// Words, not numbers. `nan` is a number gone wrong, not a word.
pub(crate) fn is_name(cell: &str) -> bool {
    cell.parse::<f64>().is_err() && unquoted(cell).starts_with(char::is_alphabetic)
}

fn unquoted(cell: &str) -> &str {
    cell.trim_matches('"').trim()
}

impl<'a> Header<'a> {
    /// Takes a cell apart.
    pub fn read(cell: Cell<'a>, source: usize) -> Result<Self, Complaint> {
        let text = unquoted(cell.text);
        let wrong = |what: &str| {
            Complaint::new(format!("the header cell `{}` {what}", cell.text))
                .at(&cell.place(source), "neither a name nor a name with its unit")
                .hint("write `name`, `name [unit]` or `name (unit)`, for example `time [ms]`")
        };
        let Some(open) = text.find(['[', '(']) else {
            if text.contains([']', ')']) {
                return Err(wrong("closes a bracket that was not opened"));
            }
            return Ok(Self { cell, name: text, unit: None });
        };
        let (name, rest) = text.split_at(open);
        let close = if rest.starts_with('[') { ']' } else { ')' };
        let unit =
            rest[1..].strip_suffix(close).ok_or_else(|| wrong("has a bracket that does not close at its end"))?;
        // Units have round brackets of their own, as in kg/(m s); square ones they have not.
        if unit.contains(['[', ']']) || name.trim().is_empty() || unit.trim().is_empty() {
            return Err(wrong("is not a name with one unit"));
        }
        Ok(Self { cell, name: name.trim(), unit: Some(unit.trim()) })
    }

    /// What makes the numbers below it SI.
    pub fn scale(&self, source: usize, want: &Dimension) -> Result<Scale, Complaint> {
        let place = self.cell.place(source);
        let needs = format!("needs {}", want.name);
        if let Some(unit) = self.unit {
            return Scale::read(unit, want).map_err(|error| {
                Complaint::new(format!("the unit [{unit}] does not fit: {}", error.title))
                    .at(&place, needs)
                    .hints(error.hints)
            });
        }
        if Scale::read(self.name, want).is_ok_and(|scale| scale.apply("1") != Some(1.0)) {
            return Err(Complaint::new(format!("the name `{}` is a unit", self.name))
                .at(&place, "a unit stands in brackets behind a name")
                .hint(format!("write a name before it, such as `value [{}]`", self.name)));
        }
        match self.unit_in_the_name() {
            None => Ok(Scale::SI),
            Some(unit) => Err(Complaint::new(format!("the name `{}` seems to end in a unit", self.name))
                .at(&place, "a unit stands in brackets")
                .hint(format!("write `name [{unit}]`; without a unit numbers are taken in SI"))),
        }
    }

    /// `time_ms`, `value/mm`, `t in ms` and `value {mm}` mean what they say.
    pub fn unit_in_the_name(&self) -> Option<&'a str> {
        let between = |c: char| !c.is_alphanumeric() && !matches!(c, '%' | '°' | '^');
        let (name, last) = self.name.trim_end_matches(between).rsplit_once(between)?;
        (self.unit.is_none() && !name.is_empty() && units::is_unit(last)).then_some(last)
    }
}

/// The cells of a header. Between blanks a unit belongs to the name before it.
pub(crate) fn cells<'a>(line: &Line<'a>, separator: Option<char>) -> Vec<Cell<'a>> {
    if separator.is_some() {
        return line.cells(separator).collect();
    }
    let mut cells: Vec<Cell<'a>> = Vec::new();
    for part in line.cells(None) {
        let goes_on = cells.last().is_some_and(|last| part.text.starts_with(['[', '(']) || is_open(last.text));
        match cells.last_mut().filter(|_| goes_on) {
            Some(last) => last.text = &line.text[last.begin - line.begin..part.begin - line.begin + part.text.len()],
            None => cells.push(part),
        }
    }
    cells
}

fn is_open(text: &str) -> bool {
    text.matches(['[', '(']).count() > text.matches([']', ')']).count()
}

/// A comment above the first cells of a table that tell no units themselves: a header behind a mark of comments, whose
/// units would be passed over with it.
pub(crate) fn commented_out(comment: &Line<'_>, first: &[Cell<'_>], source: usize) -> Option<Complaint> {
    let bare = comment.behind('#');
    let cells = cells(&bare, bare.separator());
    let has_unit =
        |cell: &Cell<'_>| Header::read(*cell, source).is_ok_and(|cell| cell.unit.is_some_and(units::is_unit));
    let told = first.iter().any(|cell| cell.text.contains(['[', '(']));
    (!told && cells.len() == first.len() && cells.iter().any(has_unit)).then(|| {
        Complaint::new("a comment tells the units of the columns")
            .at(&comment.place(source), "comments are passed over")
            .hint("take away the `#`, so that the line is the header, with its cells separated as those of the rows")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::lines;
    use crate::units::{LENGTH, TIME};

    fn headers(text: &str) -> Vec<(&str, Option<&str>)> {
        let line = lines(text).next().expect("a line");
        let cells = cells(&line, line.separator());
        cells
            .into_iter()
            .map(|cell| Header::read(cell, 0).expect("a header"))
            .map(|head| (head.name, head.unit))
            .collect()
    }

    #[test]
    fn a_cell_is_a_name_and_perhaps_a_unit() {
        let expected = [("time", Some("ms")), ("base value", Some("N s/m"))];
        for text in
            ["time [ms], base value (N s/m)", "time(ms);base value [N s/m]", "\"time [ms]\"\t\"base value [N s/m]\""]
        {
            assert_eq!(headers(text), expected, "{text}");
        }
        assert_eq!(headers("t [ms]   v [N s/m]"), [("t", Some("ms")), ("v", Some("N s/m"))]);
        assert_eq!(headers("t(ms) v"), [("t", Some("ms")), ("v", None)]);
        assert_eq!(headers("v (kg/(m s)),w"), [("v", Some("kg/(m s)")), ("w", None)]);
    }

    #[test]
    fn brackets_open_and_close() {
        for text in [
            "value [mm",
            "value mm]",
            "value (mm]",
            "value [mm] of",
            "value []",
            "[mm]",
            "value [mm] [s]",
            "value )mm(",
        ] {
            let line = lines(text).next().expect("a line");
            let cell = Cell { text: line.text, begin: 0 };
            assert!(Header::read(cell, 0).is_err(), "{text}");
        }
    }

    #[test]
    fn units_are_read_where_people_write_them() {
        let scale = |text: &'static str, want: &Dimension| {
            let header = Header::read(Cell { text, begin: 0 }, 0).expect("a header");
            header.scale(0, want).ok().and_then(|scale| scale.apply("2"))
        };
        assert_eq!(scale("time (ms)", &TIME), Some(0.002));
        assert_eq!(scale("time", &TIME), Some(2.0));
        assert_eq!(scale("base displacement", &LENGTH), Some(2.0));
        assert_eq!(scale("s", &TIME), Some(2.0));
        // Braces, and a unit in the place of the name, were once taken for names, and milliseconds for seconds.
        for text in [
            "time (mm)",
            "time_ms",
            "time/ms",
            "time in ms",
            "time, ms",
            "t-min",
            "time {ms}",
            "time <ms>",
            "ms",
            "min",
        ] {
            assert_eq!(scale(text, &TIME), None, "{text}");
        }
    }
}
