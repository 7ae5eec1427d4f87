//! Signals and spectra given as a table: a CSV file with two columns, of which the first rises.

use crate::complaint::{Complaint, Place};
use crate::header::{self, Header};
use crate::lines::{Cell, Line, MOST_COMPLAINTS, lines};
use crate::units::{Dimension, FREQUENCY, Scale, TIME};

/// What stands in the first column, and what the second is called beside it.
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

/// The two columns of such a table.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Columns {
    pub axis: Vec<f64>,
    pub value: Vec<f64>,
}

/// Reads a CSV text that is the given source. A header line may give units: `time [ms], displacement [mm]`.
pub(super) fn read(text: &str, source: usize, axis: &Axis, value: &Dimension) -> Result<Columns, Vec<Complaint>> {
    let mut columns = Columns::default();
    let mut complaints = Vec::new();
    let mut comment = None;
    let mut layout: Option<(Option<char>, [Scale; 2])> = None;
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        if line.text.starts_with('#') {
            comment = Some(line);
            continue;
        }
        let (separator, scales) = if let Some(known) = layout {
            known
        } else {
            let separator = line.separator();
            let cells = header::cells(&line, separator);
            let hidden = comment.take().and_then(|comment| header::commented_out(&comment, &cells, source));
            if let Some(complaint) = hidden {
                return Err(vec![complaint]);
            }
            let named = !cells.is_empty() && cells.iter().all(|cell| header::is_name(cell.text));
            let scales = if named { header_scales(&line, &cells, source, axis, value) } else { Ok([Scale::SI; 2]) };
            match scales {
                Ok(scales) => layout = Some((separator, scales)),
                Err(wrong) => return Err(wrong),
            }
            if named {
                continue;
            }
            (separator, [Scale::SI; 2])
        };
        match row(&line, separator, scales, source, [axis.dimension, value], axis) {
            Ok(([x, value], place)) => {
                if let Some(last) = columns.axis.last().filter(|last| **last >= x) {
                    complaints
                        .push(axis.falls(x, *last).at(&place, format!("must be {} than the line before", axis.more())));
                } else {
                    columns.axis.push(x);
                    columns.value.push(value);
                }
            }
            Err(wrong) => complaints.extend(wrong),
        }
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() && columns.axis.is_empty() {
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

    /// What each must be.
    pub fn more(&self) -> &'static str {
        if self.name == "time" { "later" } else { "higher" }
    }

    fn is(&self, header: &Header<'_>) -> bool {
        [self.short, self.name].contains(&header.name.to_lowercase().as_str())
    }

    fn columns(&self) -> String {
        format!("{} and {}", self.name, self.beside)
    }
}

/// What the header makes of the numbers below it.
fn header_scales(
    line: &Line<'_>,
    cells: &[Cell<'_>],
    source: usize,
    axis: &Axis,
    value: &Dimension,
) -> Result<[Scale; 2], Vec<Complaint>> {
    let headers =
        two(line, cells, source, axis).map_err(|complaint| vec![complaint])?.map(|cell| Header::read(cell, source));
    if let [Ok(first), Ok(second)] = &headers
        && !axis.is(first)
        && axis.is(second)
    {
        return Err(vec![
            Complaint::new(format!("the second column is the {}", axis.name))
                .at(&second.cell.place(source), format!("the first column must be the {}", axis.name))
                .hint(format!("the columns of {} are {}, in this order", axis.table, axis.columns())),
        ]);
    }
    let [first, values] = headers;
    let scales = [
        first.and_then(|header| header.scale(source, axis.dimension)),
        values.and_then(|header| header.scale(source, value)),
    ];
    match scales {
        [Ok(first), Ok(value)] => Ok([first, value]),
        wrong => Err(wrong.into_iter().filter_map(Result::err).collect()),
    }
}

fn two<'a>(line: &Line<'_>, cells: &[Cell<'a>], source: usize, axis: &Axis) -> Result<[Cell<'a>; 2], Complaint> {
    <[Cell<'a>; 2]>::try_from(cells).map_err(|_| {
        Complaint::new(format!("{} has two columns, {}", axis.table, axis.columns()))
            .at(&line.place(source), format!("{} cells in this line", cells.len()))
    })
}

/// Both numbers of a row, and where the first stands.
fn row(
    line: &Line<'_>,
    separator: Option<char>,
    scales: [Scale; 2],
    source: usize,
    dimensions: [&Dimension; 2],
    axis: &Axis,
) -> Result<([f64; 2], Place), Vec<Complaint>> {
    let cells: Vec<Cell<'_>> = line.cells(separator).collect();
    let cells = two(line, &cells, source, axis).map_err(|complaint| vec![complaint])?;
    let numbers = [0, 1].map(|k| number(&cells[k], scales[k], source, dimensions[k]));
    match numbers {
        [Ok(first), Ok(value)] => Ok(([first, value], cells[0].place(source))),
        wrong => Err(wrong.into_iter().filter_map(Result::err).collect()),
    }
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
