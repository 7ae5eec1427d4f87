//! Signals, spectra and measured curves given as a table: a CSV file of a few columns, of which the first rises.

use crate::complaint::{Complaint, Place};
use crate::header::{self, Header};
use crate::lines::{Cell, Line, MOST_COMPLAINTS, lines};
use crate::units::{Dimension, FREQUENCY, Scale, TIME};

/// What stands in the first column, and what the others are called beside it.
pub(super) struct Axis {
    table: &'static str,
    name: &'static str,
    short: &'static str,
    beside: &'static str,
    dimension: &'static Dimension,
}

/// A signal: a value at each time.
pub(super) static OF_TIME: Axis =
    Axis { table: "a table signal", name: "time", short: "t", beside: "value", dimension: &TIME };
/// A spectrum: a density at each frequency.
pub(super) static OF_FREQUENCY: Axis = Axis {
    table: "a table of spectral densities",
    name: "frequency",
    short: "f",
    beside: "density",
    dimension: &FREQUENCY,
};

/// A measured response: a value at each frequency, and how well it is known.
pub(super) static OF_RESPONSE: Axis = Axis {
    table: "a measured response curve",
    name: "frequency",
    short: "f",
    beside: "what was measured, and its uncertainty",
    dimension: &FREQUENCY,
};

/// Reads a CSV text that is the given source: its columns, of which those behind the first measure `values`. A header line may give units:
/// `time [ms], displacement [mm]`.
pub(super) fn read(
    text: &str,
    source: usize,
    axis: &Axis,
    values: &[&Dimension],
) -> Result<Vec<Vec<f64>>, Vec<Complaint>> {
    let dimensions: Vec<&Dimension> = [axis.dimension].into_iter().chain(values.iter().copied()).collect();
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); dimensions.len()];
    let mut complaints = Vec::new();
    let mut comment = None;
    let mut layout: Option<(Option<char>, Vec<Scale>)> = None;
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        if line.text.starts_with('#') {
            comment = Some(line);
            continue;
        }
        if layout.is_none() {
            let separator = line.separator();
            let cells = header::cells(&line, separator);
            let hidden = comment.take().and_then(|comment| header::commented_out(&comment, &cells, source));
            if let Some(complaint) = hidden {
                return Err(vec![complaint]);
            }
            let named = !cells.is_empty() && cells.iter().all(|cell| header::is_name(cell.text));
            let scales = if named {
                header_scales(&line, &cells, source, axis, &dimensions)?
            } else {
                vec![Scale::SI; dimensions.len()]
            };
            layout = Some((separator, scales));
            if named {
                continue;
            }
        }
        let Some((separator, scales)) = &layout else { continue };
        match row(&line, *separator, scales, source, &dimensions, axis) {
            Ok((numbers, place)) => {
                let x = numbers[0];
                if let Some(last) = columns[0].last().filter(|last| **last >= x) {
                    complaints
                        .push(axis.falls(x, *last).at(&place, format!("must be {} than the line before", axis.more())));
                } else {
                    columns.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
                }
            }
            Err(wrong) => complaints.extend(wrong),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() && columns[0].is_empty() {
        complaints
            .push(Complaint::new("the table has no rows").at(&Place::new(source, 0..0), "no numbers in this file"));
    }
    if complaints.is_empty() { Ok(columns) } else { Err(complaints) }
}

impl Axis {
    /// The complaint that `x` comes after `last`, which it must be above.
    pub fn falls(&self, x: f64, last: f64) -> Complaint {
        let unit = self.dimension.si;
        Complaint::new(format!("{} does not rise: {x} {unit} after {last} {unit}", self.name))
    }

    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What each must be.
    pub fn more(&self) -> &'static str {
        if self.name == "time" { "later" } else { "higher" }
    }

    fn is(&self, header: &Header<'_>) -> bool {
        [self.short, self.name].contains(&header.name.to_lowercase().as_str())
    }

    fn columns(&self) -> String {
        let and = if self.beside.contains(" and ") { ", " } else { " and " };
        format!("{}{and}{}", self.name, self.beside)
    }
}

/// What the header makes of the numbers below it.
fn header_scales(
    line: &Line<'_>,
    cells: &[Cell<'_>],
    source: usize,
    axis: &Axis,
    dimensions: &[&Dimension],
) -> Result<Vec<Scale>, Vec<Complaint>> {
    counted(line, cells, source, axis, dimensions.len())?;
    let headers: Vec<_> = cells.iter().map(|cell| Header::read(*cell, source)).collect();
    if let [Ok(first), Ok(second), ..] = &headers[..]
        && !axis.is(first)
        && axis.is(second)
    {
        return Err(vec![
            Complaint::new(format!("the second column is the {}", axis.name))
                .at(&second.cell.place(source), format!("the first column must be the {}", axis.name))
                .hint(format!("the columns of {} are {}, in this order", axis.table, axis.columns())),
        ]);
    }
    all(headers.into_iter().zip(dimensions).map(|(header, dimension)| header?.scale(source, dimension)))
}

/// All that was found, or all that is wrong.
fn all<T>(found: impl Iterator<Item = Result<T, Complaint>>) -> Result<Vec<T>, Vec<Complaint>> {
    let (mut right, mut wrong) = (Vec::new(), Vec::new());
    for one in found {
        match one {
            Ok(one) => right.push(one),
            Err(complaint) => wrong.push(complaint),
        }
    }
    if wrong.is_empty() { Ok(right) } else { Err(wrong) }
}

/// A line has a cell for each column.
fn counted(
    line: &Line<'_>,
    cells: &[Cell<'_>],
    source: usize,
    axis: &Axis,
    columns: usize,
) -> Result<(), Vec<Complaint>> {
    if cells.len() == columns {
        return Ok(());
    }
    let number = if columns == 2 { "two" } else { "three" };
    let wrong = Complaint::new(format!("{} has {number} columns, {}", axis.table, axis.columns()));
    Err(vec![wrong.at(&line.place(source), format!("{} cells in this line", cells.len()))])
}

/// The numbers of a row, and where the first stands.
fn row(
    line: &Line<'_>,
    separator: Option<char>,
    scales: &[Scale],
    source: usize,
    dimensions: &[&Dimension],
    axis: &Axis,
) -> Result<(Vec<f64>, Place), Vec<Complaint>> {
    let cells: Vec<Cell<'_>> = line.cells(separator).collect();
    counted(line, &cells, source, axis, dimensions.len())?;
    let numbers = cells.iter().zip(scales).zip(dimensions);
    let numbers = all(numbers.map(|((cell, scale), dimension)| number(cell, *scale, source, dimension)))?;
    Ok((numbers, cells[0].place(source)))
}

fn number(cell: &Cell<'_>, scale: Scale, source: usize, dimension: &Dimension) -> Result<f64, Complaint> {
    let wrong = |what: &str| {
        Complaint::new(format!("`{}` is not a {what}", cell.text))
            .at(&cell.place(source), format!("needs {}", dimension.name))
    };
    match scale.apply(cell.text) {
        Some(number) if number.is_finite() => match dimension.absurd(number, false) {
            Some(why) => Err(Complaint::new(format!("`{}` cannot be meant: it {why}", cell.text))
                .at(&cell.place(source), format!("needs {} that something can have", dimension.name))),
            None => Ok(number),
        },
        Some(_) => Err(wrong("finite number")),
        None => Err(wrong("number")),
    }
}
