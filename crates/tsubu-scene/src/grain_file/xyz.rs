//! Extended XYZ, one frame: the number of grains, a comment with `Properties=...`, a line a grain. SI units.

use super::{Column, Rows, Slot};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use crate::suggest;

/// Properties that are read.
const KNOWN: [&str; 6] = ["pos", "velo", "omega", "radius", "diameter", "density"];

/// What a file without `Properties` holds.
const PLAIN: &str = "species:S:1:pos:R:3";

pub(super) fn read(text: &str, rows: &mut Rows) {
    let mut all = lines(text);
    let Some(first) = all.next() else { return };
    let Ok(count) = first.text.parse::<usize>() else {
        rows.complain(
            Complaint::new("an XYZ file begins with the number of grains")
                .at(&first.place(rows.source), "not a whole number"),
        );
        return;
    };
    let Some(comment) = all.next() else {
        rows.complain(too_short(&first, count, 0, rows.source));
        return;
    };
    let Some(columns) = properties(&comment, rows) else { return };
    let mut found = 0;
    for line in all.filter(|line| !line.text.is_empty()) {
        if found == count {
            rows.complain(
                Complaint::new("the file goes on after its grains")
                    .at(&line.place(rows.source), "here begins something else")
                    .also(&first.place(rows.source), "the number of grains")
                    .hint("of a file with several frames keep the one to start from"),
            );
            return;
        }
        found += 1;
        if let Some(row) = rows.row(&line, None, &columns) {
            rows.keep(&row, &line, &columns);
        } else if rows.hopeless() {
            return;
        }
    }
    if found < count && rows.complaints.is_empty() {
        rows.complain(too_short(&first, count, found, rows.source));
    }
}

fn too_short(first: &Line<'_>, count: usize, found: usize, source: usize) -> Complaint {
    Complaint::new(format!("the file ends after {found} of {count} grains"))
        .at(&first.place(source), format!("says {count}"))
        .hint("was it cut off while it was written?")
}

/// The columns as the comment line tells them: `name:type:width` one after the other.
fn properties(comment: &Line<'_>, rows: &mut Rows) -> Option<Vec<Column>> {
    let lower = comment.text.to_ascii_lowercase();
    let typed = lower.find("properties=").map(|at| at + "properties=".len());
    let text = typed.and_then(|at| comment.text.get(at..)).and_then(|rest| rest.split_whitespace().next());
    let text = text.map_or(PLAIN, |text| text.trim_matches('"'));
    let place = typed.map_or_else(
        || comment.place(rows.source),
        |at| Place::new(rows.source, comment.begin + at..comment.begin + at + text.len()),
    );
    let fields: Vec<&str> = text.split(':').collect();
    let mut columns = Vec::new();
    for field in fields.chunks(3) {
        let [name, form, width] = field else {
            rows.complain(Complaint::new("the list of properties is not whole").at(&place, "needs name:type:width"));
            return None;
        };
        let Some(width) = width.parse::<usize>().ok().filter(|width| (1..=1000).contains(width)) else {
            rows.complain(
                Complaint::new(format!("`{width}` is no width of the property `{name}`"))
                    .at(&place, "needs name:type:width"),
            );
            return None;
        };
        let name = name.to_ascii_lowercase();
        let slots: [Column; 3] = match name.as_str() {
            "pos" | "position" | "positions" => [0, 1, 2].map(|axis| Column::new(Slot::Position(axis))),
            "velo" | "vel" | "velocity" | "velocities" => [0, 1, 2].map(|axis| Column::new(Slot::Velocity(axis))),
            "omega" | "spin" | "angular_velocity" => [0, 1, 2].map(|axis| Column::new(Slot::Spin(axis))),
            "radius" => [Column::radius(); 3],
            "diameter" => [Column::new(Slot::Diameter); 3],
            "density" => [Column::new(Slot::Density); 3],
            "id" if form.eq_ignore_ascii_case("i") => [Column::new(Slot::Id); 3],
            // Writers of this format add what they like, under names of their own; a slip of the hand must not be lost.
            _ => {
                let near = suggest::nearest(&name, KNOWN).filter(|near| near.len().abs_diff(name.len()) <= 2);
                if let Some(near) = near {
                    rows.complain(
                        Complaint::new(format!("unknown property `{name}`"))
                            .at(&place, "in this list")
                            .hint(format!("did you mean `{near}`?")),
                    );
                    return None;
                }
                [Column::new(Slot::Skip); 3]
            }
        };
        let needs = match slots[0].slot {
            Slot::Skip => width,
            Slot::Diameter | Slot::Density | Slot::Id => 1,
            _ => 3,
        };
        if width != needs || slots[0].slot != Slot::Skip && columns.iter().any(|c: &Column| c.slot == slots[0].slot) {
            rows.complain(
                Complaint::new(format!("the property `{name}` must have {needs} columns and be there once"))
                    .at(&place, "in this list"),
            );
            return None;
        }
        columns.extend((0..width).map(|at| slots[at.min(2)]));
    }
    if !columns.iter().any(|column| column.slot == Slot::Position(0)) {
        rows.complain(
            Complaint::new("the file has no places")
                .at(&place, "no `pos` in this list")
                .hint("for example Properties=species:S:1:pos:R:3:radius:R:1"),
        );
        return None;
    }
    Some(columns)
}
