//! Signals given as a table: a CSV file with the columns time and value.

use crate::complaint::{Complaint, Place};
use crate::units::{self, Dimension, TIME};
use std::ops::Range;

/// A file of the wrong format is wrong in every line; a few are enough to see it.
const MOST_COMPLAINTS: usize = 5;

/// The two columns of a table signal.
#[derive(Debug, PartialEq)]
pub(super) struct Columns {
    pub time: Vec<f64>,
    pub value: Vec<f64>,
}

/// A cell of a line, trimmed, with its bytes in the file.
struct Cell<'a> {
    text: &'a str,
    span: Range<usize>,
}

/// Reads a CSV text that is the given source. A header line may give units: `time [ms], displacement [mm]`.
pub(super) fn read(text: &str, source: usize, value: &Dimension) -> Result<Columns, Vec<Complaint>> {
    let mut columns = Columns { time: Vec::new(), value: Vec::new() };
    let mut units = [String::new(), String::new()];
    let mut complaints = Vec::new();
    let mut first = true;
    let mut offset = 0;
    for raw in text.split_inclusive('\n') {
        let begin = offset;
        offset += raw.len();
        let line = raw.trim_start_matches('\u{feff}').trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let begin = begin + raw.find(line).unwrap_or(0);
        let cells = cells(line, begin);
        let place = Place::new(source, begin..begin + line.len());
        let [time_cell, value_cell] = cells.as_slice() else {
            complaints.push(
                Complaint::new("a table signal has two columns, time and value")
                    .at(&place, format!("{} cells in this line", cells.len())),
            );
            first = false;
            if complaints.len() >= MOST_COMPLAINTS {
                break;
            }
            continue;
        };
        let header = first && is_header(time_cell.text) && is_header(value_cell.text);
        first = false;
        if header {
            units = [unit_of(time_cell.text), unit_of(value_cell.text)];
            let cells = [(time_cell, &TIME), (value_cell, value)];
            complaints.extend(
                cells.iter().zip(&units).filter_map(|((cell, want), unit)| header_unit(cell, unit, source, want)),
            );
            if complaints.is_empty() {
                continue;
            }
            break;
        }
        let numbers = [number(time_cell, &units[0], source, &TIME), number(value_cell, &units[1], source, value)];
        match numbers {
            [Ok(time), Ok(value)] => {
                if let Some(last) = columns.time.last().filter(|last| **last >= time) {
                    complaints.push(
                        Complaint::new(format!("time does not rise: {time} s after {last} s"))
                            .at(&Place::new(source, time_cell.span.clone()), "must be later than the line before"),
                    );
                } else {
                    columns.time.push(time);
                    columns.value.push(value);
                }
            }
            [time, value] => complaints.extend([time.err(), value.err()].into_iter().flatten()),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() && columns.time.is_empty() {
        complaints
            .push(Complaint::new("the table has no rows").at(&Place::new(source, 0..0), "no numbers in this file"));
    }
    if complaints.is_empty() { Ok(columns) } else { Err(complaints) }
}

fn cells(line: &str, begin: usize) -> Vec<Cell<'_>> {
    let separator = [';', '\t', ','].into_iter().find(|c| line.contains(*c)).unwrap_or(' ');
    let mut at = begin;
    let mut cells = Vec::new();
    for part in line.split(separator) {
        let text = part.trim();
        let start = at + part.find(text).unwrap_or(0);
        cells.push(Cell { text, span: start..start + text.len() });
        at += part.len() + separator.len_utf8();
    }
    // Aligned columns have runs of blanks between them.
    if separator == ' ' {
        cells.retain(|cell| !cell.text.is_empty());
    }
    cells
}

/// Words, not numbers. `nan` is a number gone wrong, not a word.
fn is_header(cell: &str) -> bool {
    cell.parse::<f64>().is_err() && cell.trim_matches('"').starts_with(char::is_alphabetic)
}

/// The unit of a header cell `name [unit]`, empty for SI.
fn unit_of(cell: &str) -> String {
    let inside = cell.split_once('[').and_then(|(_, rest)| rest.split_once(']'));
    inside.map(|(unit, _)| unit.trim().to_string()).unwrap_or_default()
}

/// A unit that does not fit is one mistake in the header, not one in every row.
fn header_unit(cell: &Cell<'_>, unit: &str, source: usize, want: &Dimension) -> Option<Complaint> {
    let error = units::read(&format!("1 {unit}"), want).err().filter(|_| !unit.is_empty())?;
    Some(
        Complaint::new(format!("the unit [{unit}] does not fit: {}", error.title))
            .at(&Place::new(source, cell.span.clone()), format!("needs {}", want.name))
            .hints(error.hints),
    )
}

fn number(cell: &Cell<'_>, unit: &str, source: usize, dimension: &Dimension) -> Result<f64, Complaint> {
    let place = Place::new(source, cell.span.clone());
    let plain: f64 = cell.text.parse().map_err(|_| {
        Complaint::new(format!("`{}` is not a number", cell.text)).at(&place, format!("needs {}", dimension.name))
    })?;
    if !plain.is_finite() {
        return Err(Complaint::new(format!("`{}` is not a finite number", cell.text))
            .at(&place, format!("needs {}", dimension.name)));
    }
    if unit.is_empty() {
        return Ok(plain);
    }
    units::read(&format!("{} {unit}", cell.text), dimension).map_err(|error| {
        Complaint::new(format!("the header says [{unit}]: {}", error.title))
            .at(&place, format!("needs {}", dimension.name))
            .hints(error.hints)
    })
}
