//! A table of modes, a line for each, as a CSV file.

use crate::complaint::{Complaint, Place};
use crate::header::{self, Header};
use crate::lines::{Cell, MOST_COMPLAINTS, lines};
use crate::units::{FREQUENCY, MASS, NUMBER, Scale};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// What a table tells.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// The modes, as tables of a scene.
    pub modes: Vec<Value>,
    /// By name: translation and rotation, a vector for each mode.
    pub interfaces: BTreeMap<String, [Value; 2]>,
}

/// What a column tells.
#[derive(Clone, Debug, PartialEq)]
enum Column {
    Frequency(Scale),
    DampingRatio(Scale),
    Mass(Scale),
    Participation,
    /// One of x, y, z, rx, ry, rz of an interface, and what makes it SI.
    Shape(String, usize, f64),
}

impl Column {
    /// Whether both say the same, in whatever units.
    fn is_again(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Shape(name, axis, _), Self::Shape(other, again, _)) => (name, axis) == (other, again),
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

const AXES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Units of vectors that are normalised to a modal mass of one.
const NORMALISED: [(&str, f64); 6] = [
    ("-", 1.0),
    ("1/sqrt(kg)", 1.0),
    ("kg^-0.5", 1.0),
    ("1/sqrt(t)", 0.031_622_776_601_683_79),
    ("t^-0.5", 0.031_622_776_601_683_79),
    ("1/sqrt(g)", 31.622_776_601_683_793),
];

/// Reads a table that is the given source.
pub(super) fn read(text: &str, source: usize) -> Result<Found, Vec<Complaint>> {
    let mut left = lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('#'));
    let Some(head) = left.next() else {
        return Err(vec![
            Complaint::new("the table has no lines").at(&Place::new(source, 0..0), "nothing in this file"),
        ]);
    };
    let separator = head.separator();
    let columns: Vec<Result<Column, Complaint>> =
        header::cells(&head, separator).into_iter().map(|cell| column(cell, source)).collect();
    let mut complaints: Vec<Complaint> = columns.iter().filter_map(|column| column.clone().err()).collect();
    let columns: Vec<Column> = columns.into_iter().filter_map(Result::ok).collect();
    if complaints.is_empty()
        && let Some(again) =
            (1..columns.len()).find(|k| columns[..*k].iter().any(|before| before.is_again(&columns[*k])))
    {
        let cell = &header::cells(&head, separator)[again];
        complaints.push(
            Complaint::new(format!("the table of modes has the column `{}` twice", cell.text.trim()))
                .at(&cell.place(source), "again"),
        );
    }
    for (there, name) in [
        (columns.iter().any(|c| matches!(c, Column::Frequency(_))), "frequency"),
        (columns.iter().any(|c| matches!(c, Column::DampingRatio(_))), "damping ratio"),
    ] {
        if !there && complaints.is_empty() {
            complaints.push(
                Complaint::new(format!("the table of modes has no column `{name}`"))
                    .at(&head.place(source), "the header")
                    .hint(
                        "columns: `frequency [Hz]`, `damping ratio`, then `NAME x`, `NAME y`, ... for each interface",
                    ),
            );
        }
    }
    if !complaints.is_empty() {
        return Err(complaints);
    }
    let mut found = Found::default();
    let mut shapes: BTreeMap<String, Vec<[f64; 6]>> = BTreeMap::new();
    let mut highest = 0.0;
    for line in left {
        let cells: Vec<Cell<'_>> = line.cells(separator).collect();
        if cells.len() != columns.len() {
            complaints.push(
                Complaint::new("a mode has another number of cells than the header")
                    .at(&line.place(source), format!("{} cells for {} columns", cells.len(), columns.len())),
            );
        }
        let mut mode =
            Table::from_iter([("mass".to_owned(), Value::Float(1.0)), ("participation".to_owned(), Value::Float(0.0))]);
        mode.insert("shape".into(), Value::Float(1.0));
        for (cell, column) in cells.iter().zip(&columns) {
            match value(cell, column, source) {
                Ok(value) => {
                    let key = match column {
                        Column::Frequency(_) => {
                            if value < highest {
                                complaints.push(
                                    Complaint::new("the frequencies of the modes are out of order")
                                        .at(&cell.place(source), "lower than the line before")
                                        .hint("are these the lines of one structure? Sort them by frequency"),
                                );
                            }
                            highest = value;
                            "frequency"
                        }
                        Column::DampingRatio(_) => "damping-ratio",
                        Column::Mass(_) => "mass",
                        Column::Participation => "participation",
                        Column::Shape(name, axis, _) => {
                            let rows = shapes.entry(name.clone()).or_default();
                            if rows.len() <= found.modes.len() {
                                rows.push([0.0; 6]);
                            }
                            if let Some(row) = rows.last_mut() {
                                row[*axis] = value;
                            }
                            continue;
                        }
                    };
                    mode.insert(key.into(), Value::Float(value));
                }
                Err(wrong) => complaints.push(wrong),
            }
        }
        found.modes.push(Value::Table(mode));
        if complaints.len() >= MOST_COMPLAINTS {
            break;
        }
    }
    if complaints.is_empty() && found.modes.is_empty() {
        complaints.push(Complaint::new("the table has no modes").at(&head.place(source), "nothing below the header"));
    }
    let vectors = |rows: &[[f64; 6]], from: usize| {
        let vector = |row: &[f64; 6]| Value::Array(row[from..from + 3].iter().copied().map(Value::Float).collect());
        Value::Array(rows.iter().map(vector).collect())
    };
    found.interfaces = shapes.into_iter().map(|(name, rows)| (name, [vectors(&rows, 0), vectors(&rows, 3)])).collect();
    if complaints.is_empty() { Ok(found) } else { Err(complaints) }
}

fn column(cell: Cell<'_>, source: usize) -> Result<Column, Complaint> {
    let text = cell.text.trim_matches('"').trim();
    // Before units are looked at: those of normalised vectors are none that a scene knows.
    let (name, unit) =
        text.split_once('[').map_or((text, None), |(name, unit)| (name, Some(unit.trim_end_matches(']').trim())));
    if let Some((interface, axis)) = name.trim().rsplit_once(' ')
        && let Some(axis) = AXES.iter().position(|known| *known == axis)
    {
        let per = unit.map(|unit| if axis < 3 { unit } else { unit.trim_start_matches("rad/m").trim() });
        let scale = match per {
            None | Some("") => Some(1.0),
            Some(unit) => NORMALISED.iter().find(|(known, _)| *known == unit).map(|(_, scale)| *scale),
        };
        return scale.map(|scale| Column::Shape(interface.trim().to_owned(), axis, scale)).ok_or_else(|| {
            Complaint::new(format!("`{}` is no unit of a mode shape", unit.unwrap_or_default()))
                .at(&cell.place(source), "not known here")
                .hint("[1/sqrt(kg)], [1/sqrt(t)] or [1/sqrt(g)] for vectors of modal mass one; none beside a column `mass`")
        });
    }
    let header = Header::read(cell, source)?;
    match header.name.to_lowercase().replace(['_', '-'], " ").as_str() {
        "frequency" => Ok(Column::Frequency(header.scale(source, &FREQUENCY)?)),
        "damping ratio" => Ok(Column::DampingRatio(header.scale(source, &NUMBER)?)),
        "mass" => Ok(Column::Mass(header.scale(source, &MASS)?)),
        "participation" => Ok(Column::Participation),
        _ => Err(Complaint::new(format!("unknown column `{}` in a table of modes", header.name))
            .at(&cell.place(source), "not a column here")
            .hint("columns: `frequency [Hz]`, `damping ratio`, `mass [kg]`, `participation`, and `NAME x` to `NAME rz` of interfaces")),
    }
}

fn value(cell: &Cell<'_>, column: &Column, source: usize) -> Result<f64, Complaint> {
    let (number, above, dimension) = match column {
        Column::Frequency(scale) => (scale.apply(cell.text), true, &FREQUENCY),
        Column::DampingRatio(scale) => (scale.apply(cell.text), false, &NUMBER),
        Column::Mass(scale) => (scale.apply(cell.text), true, &MASS),
        Column::Participation => (cell.text.parse().ok(), false, &NUMBER),
        Column::Shape(_, _, scale) => (cell.text.parse::<f64>().ok().map(|value| value * scale), false, &NUMBER),
    };
    let fits = number.filter(|value| value.is_finite() && (!above || *value > 0.0));
    let fits = fits.filter(|value| !matches!(column, Column::DampingRatio(_)) || *value >= 0.0);
    let value = fits.ok_or_else(|| {
        Complaint::new(format!("`{}` cannot be meant", cell.text))
            .at(&cell.place(source), if above { "needs a number above 0" } else { "needs a finite number" })
    })?;
    match dimension.absurd(value, above) {
        Some(why) => Err(Complaint::new(format!("`{}` cannot be meant: it {why}", cell.text))
            .at(&cell.place(source), format!("needs {}", dimension.name))),
        None => Ok(value),
    }
}
