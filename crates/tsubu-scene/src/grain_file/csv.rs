//! CSV: a header line that names the columns, or bare rows of numbers.
//!
//! Header cells are `x`, `y`, `z`, `d` or `diameter`, `r` or `radius`, `vx` ..., `wx` ..., with or without a unit in
//! brackets. Without a header the columns are x, y, z and, if there is a fourth, the radius; in the plane x, z and, if
//! there is a third, the radius. Lines that begin with `#` are passed over.

use super::{Column, Rows, Slot};
use crate::complaint::Complaint;
use crate::lines::{Cell, Line, lines};
use crate::suggest;
use crate::units::{self, Dimension, LENGTH, SPEED, SPIN};

const NAMES: [&str; 13] = ["x", "y", "z", "d", "diameter", "r", "radius", "vx", "vy", "vz", "wx", "wy", "wz"];

pub(super) fn read(text: &str, rows: &mut Rows) {
    let mut layout: Option<(Option<char>, Vec<Column>)> = None;
    for line in lines(text).filter(|line| !line.text.is_empty() && !line.text.starts_with('#')) {
        let (separator, columns) = if let Some(known) = &layout {
            known
        } else {
            let separator = line.separator();
            let cells: Vec<Cell<'_>> = line.cells(separator).collect();
            let named = cells.iter().any(|cell| is_name(cell.text));
            let columns = if named { header(&line, &cells, rows) } else { bare(&line, cells.len(), rows) };
            let Some(columns) = columns else { return };
            layout = Some((separator, columns));
            if named {
                continue;
            }
            let Some(known) = &layout else { return };
            known
        };
        if let Some(row) = rows.row(&line, *separator, columns) {
            rows.keep(&row, &line, columns);
        } else if rows.hopeless() {
            return;
        }
    }
}

/// Words, not numbers. `nan` is a number gone wrong, not a word.
fn is_name(cell: &str) -> bool {
    cell.parse::<f64>().is_err() && cell.trim_matches('"').starts_with(char::is_alphabetic)
}

fn bare(line: &Line<'_>, count: usize, rows: &mut Rows) -> Option<Vec<Column>> {
    let [x, y, z] = [0, 1, 2].map(|axis| Column::new(Slot::Position(axis)));
    Some(match (count, rows.how.space) {
        (3, true) => vec![x, y, z],
        (4, _) => vec![x, y, z, Column::radius()],
        (2, false) => vec![x, z],
        (3, false) => vec![x, z, Column::radius()],
        _ => {
            let form = if rows.how.space { "x, y, z or x, y, z, radius" } else { "x, z or x, z, radius" };
            rows.complain(
                Complaint::new(format!("bare rows are {form}"))
                    .at(&line.place(rows.source), format!("{count} cells in this line"))
                    .hint("for other columns name them in the first line: x,y,z,diameter,vx,vy,vz,wx,wy,wz"),
            );
            return None;
        }
    })
}

fn header(line: &Line<'_>, cells: &[Cell<'_>], rows: &mut Rows) -> Option<Vec<Column>> {
    let known_complaints = rows.complaints.len();
    let mut columns: Vec<Column> = Vec::new();
    for cell in cells {
        let text = cell.text.trim_matches('"');
        let (name, unit) = match text.split_once('[') {
            Some((name, rest)) => (name, rest.split(']').next().unwrap_or_default().trim()),
            None => (text, ""),
        };
        let name = name.trim().to_lowercase();
        let Some((mut column, dimension)) = column(&name) else {
            // What other codes write beside (id, mass, density) is passed over; a slip of the hand must not be.
            if let Some(near) = suggest::nearest(&name, NAMES) {
                rows.complain(
                    Complaint::new(format!("unknown column `{name}`"))
                        .at(&cell.place(rows.source), "not a column of grains")
                        .hint(format!("did you mean `{near}`?"))
                        .hint(format!("columns: {}", suggest::list(NAMES))),
                );
            }
            columns.push(Column::new(Slot::Skip));
            continue;
        };
        if columns.iter().any(|other| other.slot == column.slot) {
            rows.complain(
                Complaint::new(format!("the column `{name}` says again what another one says"))
                    .at(&cell.place(rows.source), "a second time"),
            );
        }
        if !unit.is_empty() {
            match units::read(&format!("1 {unit}"), dimension) {
                Ok(scale) => column.scale *= scale,
                Err(error) => rows.complain(
                    Complaint::new(format!("the unit [{unit}] does not fit: {}", error.title))
                        .at(&cell.place(rows.source), format!("needs {}", dimension.name))
                        .hints(error.hints),
                ),
            }
        }
        columns.push(column);
    }
    let needed: &[(usize, &str)] = if rows.how.space { &[(0, "x"), (1, "y"), (2, "z")] } else { &[(0, "x"), (2, "z")] };
    let missing = needed.iter().filter(|(axis, _)| !columns.iter().any(|c| c.slot == Slot::Position(*axis)));
    let missing: Vec<&str> = missing.map(|(_, name)| *name).collect();
    if !missing.is_empty() && rows.complaints.len() == known_complaints {
        rows.complain(
            Complaint::new(format!("there is no column {}", suggest::list(missing)))
                .at(&line.place(rows.source), "the names of the columns")
                .hint(format!("columns: {}", suggest::list(NAMES))),
        );
    }
    (rows.complaints.len() == known_complaints).then_some(columns)
}

fn column(name: &str) -> Option<(Column, &'static Dimension)> {
    let slot = match name {
        "x" => Slot::Position(0),
        "y" => Slot::Position(1),
        "z" => Slot::Position(2),
        "d" | "diameter" => Slot::Diameter,
        "r" | "radius" => return Some((Column::radius(), &LENGTH)),
        "vx" => Slot::Velocity(0),
        "vy" => Slot::Velocity(1),
        "vz" => Slot::Velocity(2),
        "wx" => Slot::Spin(0),
        "wy" => Slot::Spin(1),
        "wz" => Slot::Spin(2),
        _ => return None,
    };
    let dimension = match slot {
        Slot::Velocity(_) => &SPEED,
        Slot::Spin(_) => &SPIN,
        _ => &LENGTH,
    };
    Some((Column::new(slot), dimension))
}
