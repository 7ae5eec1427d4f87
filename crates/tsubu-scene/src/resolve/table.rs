//! Signals given as a table: a CSV file with the columns time and value.

use crate::complaint::{Complaint, Place};
use crate::header::{self, Header};
use crate::lines::{Cell, Line, MOST_COMPLAINTS, lines};
use crate::units::{Dimension, Scale, TIME};

/// The two columns of a table signal.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Columns {
    pub time: Vec<f64>,
    pub value: Vec<f64>,
}

/// Reads a CSV text that is the given source. A header line may give units: `time [ms], displacement [mm]`.
pub(super) fn read(text: &str, source: usize, value: &Dimension) -> Result<Columns, Vec<Complaint>> {
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
            let scales = if named { header_scales(&line, &cells, source, value) } else { Ok([Scale::SI; 2]) };
            match scales {
                Ok(scales) => layout = Some((separator, scales)),
                Err(wrong) => return Err(wrong),
            }
            if named {
                continue;
            }
            (separator, [Scale::SI; 2])
        };
        match row(&line, separator, scales, source, value) {
            Ok(([time, value], place)) => {
                if let Some(last) = columns.time.last().filter(|last| **last >= time) {
                    complaints.push(
                        Complaint::new(format!("time does not rise: {time} s after {last} s"))
                            .at(&place, "must be later than the line before"),
                    );
                } else {
                    columns.time.push(time);
                    columns.value.push(value);
                }
            }
            Err(wrong) => complaints.extend(wrong),
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

/// What the header makes of the numbers below it; the first column is time.
fn header_scales(
    line: &Line<'_>,
    cells: &[Cell<'_>],
    source: usize,
    value: &Dimension,
) -> Result<[Scale; 2], Vec<Complaint>> {
    let [time, values] = two(line, cells, source).map_err(|complaint| vec![complaint])?;
    let headers = [time, values].map(|cell| Header::read(cell, source));
    if let [Ok(first), Ok(second)] = &headers
        && !is_time(first)
        && is_time(second)
    {
        return Err(vec![
            Complaint::new("the second column is the time")
                .at(&second.cell.place(source), "the first column must be the time")
                .hint("the columns of a table signal are time and value, in this order"),
        ]);
    }
    let [time, values] = headers;
    let scales =
        [time.and_then(|header| header.scale(source, &TIME)), values.and_then(|header| header.scale(source, value))];
    match scales {
        [Ok(time), Ok(value)] => Ok([time, value]),
        wrong => Err(wrong.into_iter().filter_map(Result::err).collect()),
    }
}

fn is_time(header: &Header<'_>) -> bool {
    ["t", "time"].contains(&header.name.to_lowercase().as_str())
}

fn two<'a>(line: &Line<'_>, cells: &[Cell<'a>], source: usize) -> Result<[Cell<'a>; 2], Complaint> {
    <[Cell<'a>; 2]>::try_from(cells).map_err(|_| {
        Complaint::new("a table signal has two columns, time and value")
            .at(&line.place(source), format!("{} cells in this line", cells.len()))
    })
}

/// Time and value of a row, and where the time stands.
fn row(
    line: &Line<'_>,
    separator: Option<char>,
    scales: [Scale; 2],
    source: usize,
    value: &Dimension,
) -> Result<([f64; 2], Place), Vec<Complaint>> {
    let cells: Vec<Cell<'_>> = line.cells(separator).collect();
    let cells = two(line, &cells, source).map_err(|complaint| vec![complaint])?;
    let numbers = [(&cells[0], scales[0], &TIME), (&cells[1], scales[1], value)]
        .map(|(cell, scale, dimension)| number(cell, scale, source, dimension));
    match numbers {
        [Ok(time), Ok(value)] => Ok(([time, value], cells[0].place(source))),
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
