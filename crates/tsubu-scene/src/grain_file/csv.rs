//! CSV: a header line that names the columns, or bare rows of numbers.
//!
//! Header cells are `x`, `y`, `z`, `d` or `diameter`, `r` or `radius`, `density`, `vx` ..., `wx` ..., with or without a unit in
//! brackets. What tells grains from each other (`id`, `name` ...) is passed over; any other column is refused. Without a header the columns are x, y, z and, if there is a fourth, the radius; in the plane x, z and, if
//! there is a third, the radius. Lines that begin with `#` are passed over.

use super::{Column, Rows, Slot};
use crate::complaint::Complaint;
use crate::header::{self, Header};
use crate::lines::{Cell, Line, lines};
use crate::suggest;

const NAMES: [&str; 14] =
    ["x", "y", "z", "d", "diameter", "r", "radius", "density", "vx", "vy", "vz", "wx", "wy", "wz"];
/// What other codes write beside and no number of a grain depends on; a column without a name counts rows.
const PASSED_OVER: [&str; 9] = ["id", "index", "type", "kind", "name", "species", "material", "group", ""];

pub(super) fn read(text: &str, rows: &mut Rows) {
    let mut layout: Option<(Option<char>, Vec<Column>)> = None;
    let mut comment = None;
    for line in lines(text).filter(|line| !line.text.is_empty()) {
        if line.text.starts_with('#') {
            comment = Some(line);
            continue;
        }
        let (separator, columns) = if let Some(known) = &layout {
            known
        } else {
            let separator = line.separator();
            let cells = header::cells(&line, separator);
            let hidden = comment.take().and_then(|comment| header::commented_out(&comment, &cells, rows.source));
            if let Some(complaint) = hidden {
                return rows.complain(complaint);
            }
            let named = cells.iter().any(|cell| header::is_name(cell.text));
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
        let read = Header::read(*cell, rows.source);
        match read.and_then(|header| header_column(&header, &columns, rows.source)) {
            Ok(column) => columns.push(column),
            Err(complaint) => rows.complain(complaint),
        }
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

fn header_column(header: &Header<'_>, others: &[Column], source: usize) -> Result<Column, Complaint> {
    let name = header.name.to_lowercase();
    let place = header.cell.place(source);
    let Some(mut column) = column(&name) else {
        if PASSED_OVER.contains(&name.as_str()) {
            return Ok(Column::new(Slot::Skip));
        }
        let complaint =
            Complaint::new(format!("unknown column `{}`", header.name)).at(&place, "not a column of grains");
        let complaint = match (header.unit_in_the_name(), suggest::nearest(&name, NAMES)) {
            (Some(unit), _) => complaint.hint(format!("a unit stands in brackets: `x [{unit}]`")),
            (None, Some(near)) => complaint.hint(format!("did you mean `{near}`?")),
            (None, None) => complaint.hint("take it out of the file if the grains do not need it"),
        };
        return Err(complaint.hint(format!("columns: {}", suggest::list(NAMES))));
    };
    if others.iter().any(|other| other.slot == column.slot) {
        return Err(
            Complaint::new(format!("the column `{name}` says again what another one says")).at(&place, "a second time")
        );
    }
    column.scale = header.scale(source, column.slot.dimension())?;
    Ok(column)
}

fn column(name: &str) -> Option<Column> {
    let slot = match name {
        "x" => Slot::Position(0),
        "y" => Slot::Position(1),
        "z" => Slot::Position(2),
        "d" | "diameter" => Slot::Diameter,
        "r" | "radius" => return Some(Column::radius()),
        "density" => Slot::Density,
        "vx" => Slot::Velocity(0),
        "vy" => Slot::Velocity(1),
        "vz" => Slot::Velocity(2),
        "wx" => Slot::Spin(0),
        "wy" => Slot::Spin(1),
        "wz" => Slot::Spin(2),
        _ => return None,
    };
    Some(Column::new(slot))
}
