//! LAMMPS data files, atom_style sphere, SI units: the sections `Atoms` (id type diameter density x y z, perhaps with
//! image flags) and `Velocities` (id vx vy vz wx wy wz). Densities are the materials' here, and are passed over.

use super::{Column, Rows, Slot};
use crate::complaint::Complaint;
use crate::lines::{Line, lines};
use std::collections::HashMap;

/// Where in the file a line is.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    Head,
    Atoms,
    Velocities,
    Other,
}

pub(super) fn read(text: &str, rows: &mut Rows) {
    let mut section = Section::Head;
    let mut promised: Option<(usize, Line<'_>)> = None;
    let mut columns: Vec<Column> = Vec::new();
    let mut grain_of: HashMap<u64, usize> = HashMap::new();
    let mut kinds: Vec<u64> = Vec::new();
    let mut found = 0;
    let mut velocity_seen = false;
    // The first line is a title, whatever it says.
    for line in lines(text).skip(1) {
        let bare = line.before('#');
        if bare.text.is_empty() {
            continue;
        }
        // Small letters are no section but a slip in a row.
        if bare.text.starts_with(char::is_uppercase) {
            section = match bare.text {
                "Atoms" => Section::Atoms,
                "Velocities" => Section::Velocities,
                _ => Section::Other,
            };
            let style = line.text.split_once('#').map(|(_, style)| style.trim()).filter(|style| !style.is_empty());
            if let (Section::Atoms, Some(style)) = (section, style)
                && style != "sphere"
            {
                rows.complain(
                    Complaint::new(format!("atom_style `{style}` does not say how large the grains are"))
                        .at(&line.place(rows.source), "needs `Atoms # sphere`"),
                );
                return;
            }
            continue;
        }
        match section {
            Section::Head => {
                if let Some(count) = bare.text.strip_suffix("atoms").and_then(|count| count.trim().parse().ok()) {
                    promised = Some((count, line));
                }
            }
            Section::Other => {}
            Section::Atoms => {
                found += 1;
                if columns.is_empty() {
                    columns = atom_columns(bare.cells(None).count());
                }
                let Some(row) = rows.row(&bare, None, &columns) else {
                    if rows.hopeless() {
                        return;
                    }
                    continue;
                };
                if !kinds.contains(&row.kind) {
                    kinds.push(row.kind);
                }
                if rows.how.kind.is_some_and(|kind| u64::from(kind) != row.kind) {
                    continue;
                }
                if grain_of.insert(row.id, rows.grains.position.len()).is_some() {
                    rows.complain(
                        Complaint::new(format!("the atom {} is there twice", row.id))
                            .at(&line.place(rows.source), "again"),
                    );
                    return;
                }
                rows.keep(&row, &bare, &columns);
            }
            Section::Velocities => {
                if !velocity_seen {
                    velocity_seen = true;
                    rows.grains.velocity = vec![[0.0; 3]; rows.grains.position.len()];
                    rows.grains.spin = vec![[0.0; 3]; rows.grains.position.len()];
                }
                let Some(row) = rows.row(&bare, None, &velocity_columns()) else {
                    if rows.hopeless() {
                        return;
                    }
                    continue;
                };
                // Atoms of other types are not grains of this group.
                if let Some(grain) = grain_of.get(&row.id) {
                    rows.grains.velocity[*grain] = row.velocity;
                    rows.grains.spin[*grain] = row.spin;
                }
            }
        }
    }
    if rows.complaints.is_empty() {
        whole(rows, promised, found, &kinds, velocity_seen && grain_of.is_empty());
    }
}

/// What only the end of the file can tell.
fn whole(rows: &mut Rows, promised: Option<(usize, Line<'_>)>, found: usize, kinds: &[u64], too_early: bool) {
    if let Some((count, line)) = promised.filter(|(count, _)| *count != found) {
        rows.complain(
            Complaint::new(format!("the file promises {count} atoms and has {found}"))
                .at(&line.place(rows.source), format!("says {count}"))
                .hint("was it cut off while it was written?"),
        );
    } else if let Some(kind) = rows.how.kind.filter(|kind| found > 0 && !kinds.contains(&u64::from(*kind))) {
        let mut kinds = kinds.to_vec();
        kinds.sort_unstable();
        let kinds: Vec<String> = kinds.iter().map(ToString::to_string).collect();
        rows.complain(
            Complaint::new(format!("no atom of the file is of type {kind}"))
                .hint(format!("types in the file: {}", kinds.join(", "))),
        );
    } else if too_early {
        rows.complain(Complaint::new("the section `Velocities` stands before the section `Atoms`"));
    }
}

fn atom_columns(count: usize) -> Vec<Column> {
    let slots =
        [Slot::Id, Slot::Kind, Slot::Diameter, Slot::Skip, Slot::Position(0), Slot::Position(1), Slot::Position(2)];
    // Image flags tell how often a grain went round a periodic world; its place is in the world already.
    let flags = if count == 10 { 3 } else { 0 };
    slots.into_iter().chain([Slot::Skip; 3].into_iter().take(flags)).map(Column::new).collect()
}

fn velocity_columns() -> [Column; 7] {
    let [v, w] = [Slot::Velocity, Slot::Spin].map(|slot| [0, 1, 2].map(slot));
    [Slot::Id, v[0], v[1], v[2], w[0], w[1], w[2]].map(Column::new)
}
