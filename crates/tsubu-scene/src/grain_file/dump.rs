//! LAMMPS dump files of grains, as tsubu and LAMMPS write them: of several snapshots the last one. Columns are known by their
//! names; SI units. Grains stand in the order of their ids.

use super::{Column, Rows, Slot};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use crate::suggest;
use std::collections::{BTreeSet, HashSet};

const ITEM: &str = "ITEM: ";
const ITEMS: [&str; 6] = ["UNITS", "TIMESTEP", "TIME", "NUMBER OF ATOMS", "BOX BOUNDS", "ATOMS"];
/// Columns that are read.
const NAMES: [&str; 18] = [
    "id", "type", "x", "y", "z", "xu", "yu", "zu", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "radius",
    "diameter", "density", "mass",
];
/// Columns of LAMMPS that no grain begins with: what acts on it, how often it went round the world, who computed it.
const PASSED_OVER: [&str; 20] = [
    "element", "mol", "proc", "procp1", "ix", "iy", "iz", "q", "fx", "fy", "fz", "tqx", "tqy", "tqz", "angmomx",
    "angmomy", "angmomz", "mux", "muy", "muz",
];
/// What begins the names of what a run computes itself.
const COMPUTED: [&str; 5] = ["c_", "f_", "v_", "i_", "d_"];

pub(super) fn read(text: &str, rows: &mut Rows) {
    if let Err(complaint) = snapshot(text, rows) {
        rows.complain(complaint);
    }
}

/// Reads the last snapshot. Errors in rows are with the rows already.
fn snapshot(text: &str, rows: &mut Rows) -> Result<(), Complaint> {
    let source = rows.source;
    let all: Vec<Line<'_>> = lines(text).filter(|line| !line.text.is_empty()).collect();
    let item = |line: &Line<'_>, name: &str| line.text.strip_prefix(ITEM).is_some_and(|rest| rest.starts_with(name));
    let other = |line: &&Line<'_>| line.text.starts_with(ITEM) && !ITEMS.iter().any(|name| item(line, name));
    if let Some(line) = all.iter().find(other) {
        return Err(Complaint::new(format!("`{}` is no part of a dump of grains", line.text))
            .at(&line.place(source), "unknown")
            .hint(format!("parts: {}", suggest::list(ITEMS))));
    }
    // It is said once, before the first snapshot.
    if let Some(units) = all.iter().position(|line| item(line, "UNITS")).and_then(|at| all.get(at + 1))
        && units.text != "si"
    {
        return Err(Complaint::new(format!("the file is in the units `{}` of LAMMPS", units.text))
            .at(&units.place(source), "only SI units are read")
            .hint("convert it to `units si`"));
    }
    if let Some(last) = all.last().filter(|_| !text.ends_with('\n')) {
        return Err(Complaint::new("the file ends within a line")
            .at(&last.place(source), "the last line")
            .hint("was it cut off while it was written? without this snapshot the one before is the last"));
    }
    let Some(begin) = all.iter().rposition(|line| item(line, "TIMESTEP")) else {
        return Err(Complaint::new("the file has no snapshot")
            .at(&Place::new(source, 0..0), "no line `ITEM: TIMESTEP`")
            .hint("LAMMPS writes such files by `dump ID all custom N FILE id type x y z vx vy vz radius`"));
    };
    let snapshot = &all[begin..];
    let missing = |name: &str| {
        Complaint::new(format!("the last snapshot has no `{ITEM}{name}`"))
            .at(&snapshot[0].place(source), "begins here")
            .hint("was the file cut off while it was written?")
    };
    let find = |name: &str| snapshot.iter().position(|line| item(line, name)).ok_or_else(|| missing(name));
    let promised = find("NUMBER OF ATOMS")?;
    let head = find("ATOMS")?;
    let count = snapshot.get(promised + 1).ok_or_else(|| missing("NUMBER OF ATOMS"))?;
    let Ok(wanted) = count.text.parse::<usize>() else {
        return Err(Complaint::new("the number of atoms is not a whole number").at(&count.place(source), "needs one"));
    };
    let columns = columns(&snapshot[head], source)?;
    let found = atoms(&snapshot[head + 1..], &columns, rows)?;
    if found != wanted && !rows.hopeless() {
        return Err(Complaint::new(format!("the last snapshot promises {wanted} atoms and has {found}"))
            .at(&count.place(source), format!("says {wanted}"))
            .hint("was the file cut off while it was written? without this snapshot the one before is the last"));
    }
    Ok(())
}

/// Reads the rows of a snapshot, and gives how many there are.
fn atoms(lines: &[Line<'_>], columns: &[Column], rows: &mut Rows) -> Result<usize, Complaint> {
    let has = |slot| columns.iter().any(|column| column.slot == slot);
    let (mut ids, mut kinds) = (HashSet::new(), BTreeSet::new());
    for line in lines {
        if let Some(item) = line.text.strip_prefix(ITEM) {
            return Err(Complaint::new(format!("`{ITEM}{item}` stands behind the atoms of the last snapshot"))
                .at(&line.place(rows.source), "a snapshot ends with its atoms"));
        }
        let Some(row) = rows.row(line, None, columns) else {
            if rows.hopeless() {
                break;
            }
            continue;
        };
        if has(Slot::Id) && !ids.insert(row.id) {
            return Err(
                Complaint::new(format!("the atom {} is there twice", row.id)).at(&line.place(rows.source), "again")
            );
        }
        kinds.insert(row.kind);
        if rows.how.kind.is_none_or(|kind| u64::from(kind) == row.kind) {
            rows.keep(&row, line, columns);
        }
    }
    match rows.how.kind {
        Some(_) if !has(Slot::Kind) => Err(Complaint::new("`kind` chooses an atom type, which the file does not tell")
            .hint("leave `kind` out, or dump the column `type`")),
        Some(kind) if rows.complaints.is_empty() && !kinds.contains(&u64::from(kind)) => {
            let kinds: Vec<String> = kinds.iter().map(ToString::to_string).collect();
            Err(Complaint::new(format!("no atom of the last snapshot is of type {kind}"))
                .hint(format!("types in it: {}", kinds.join(", "))))
        }
        _ => Ok(lines.len()),
    }
}

/// The columns by their names, behind `ITEM: ATOMS`.
fn columns(head: &Line<'_>, source: usize) -> Result<Vec<Column>, Complaint> {
    let cells: Vec<_> = head.cells(None).skip(2).collect();
    let named = |name: &str| cells.iter().any(|cell| cell.text == name);
    let mut columns: Vec<Column> = Vec::new();
    for cell in &cells {
        // Where a grain is in a periodic world, and where it would be had it not gone round; the first is what is meant.
        let axis = |names: [&str; 3]| names.iter().position(|name| *name == cell.text);
        let unwrapped = axis(["xu", "yu", "zu"]);
        let column = if let Some(axis) = axis(["x", "y", "z"]) {
            Column::new(Slot::Position(axis))
        } else if let Some(axis) = unwrapped {
            Column::new(if named(["x", "y", "z"][axis]) { Slot::Skip } else { Slot::Position(axis) })
        } else if let Some(axis) = axis(["vx", "vy", "vz"]) {
            Column::new(Slot::Velocity(axis))
        } else if let Some(axis) = axis(["omegax", "omegay", "omegaz"]) {
            Column::new(Slot::Spin(axis))
        } else {
            match cell.text {
                "id" => Column::new(Slot::Id),
                "type" => Column::new(Slot::Kind),
                "radius" => Column::radius(),
                "diameter" => Column::new(Slot::Diameter),
                "density" => Column::new(Slot::Density),
                "mass" => Column::new(Slot::Mass),
                name if PASSED_OVER.contains(&name) || COMPUTED.iter().any(|begin| name.starts_with(begin)) => {
                    Column::new(Slot::Skip)
                }
                name => return Err(unknown(name, &cell.place(source))),
            }
        };
        if column.slot != Slot::Skip && columns.iter().any(|other| other.slot == column.slot) {
            return Err(Complaint::new(format!("the column `{}` says again what another one says", cell.text))
                .at(&cell.place(source), "a second time"));
        }
        columns.push(column);
    }
    let missing: Vec<&str> = [0, 1, 2]
        .into_iter()
        .filter(|axis| !columns.iter().any(|column| column.slot == Slot::Position(*axis)))
        .map(|axis| ["x", "y", "z"][axis])
        .collect();
    if missing.is_empty() {
        return Ok(columns);
    }
    Err(Complaint::new(format!("there is no column {}", suggest::list(missing)))
        .at(&head.place(source), "the names of the columns")
        .hint("dump the columns `id type x y z vx vy vz omegax omegay omegaz radius mass`"))
}

fn unknown(name: &str, place: &Place) -> Complaint {
    let complaint = Complaint::new(format!("unknown column `{name}`"));
    if ["xs", "ys", "zs", "xsu", "ysu", "zsu"].contains(&name) {
        return complaint
            .at(place, "in parts of the box, not in metres")
            .hint("dump `x y z` or, of grains that went round a periodic world, `xu yu zu`");
    }
    let near = suggest::nearest(name, NAMES).map(|near| format!("did you mean `{near}`?"));
    complaint.at(place, "not a column of grains").hints(near).hint(format!("columns: {}", suggest::list(NAMES)))
}
