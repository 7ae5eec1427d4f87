//! LAMMPS data files, atom_style sphere, SI units: the sections `Atoms` (id type diameter density x y z, perhaps with
//! image flags) and `Velocities` (id vx vy vz wx wy wz). Densities are the materials' here, and are passed over.

use super::{Column, Rows, Slot};
use crate::complaint::Complaint;
use crate::lines::{Line, lines};
use std::collections::{HashMap, HashSet};

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
    let mut most_kinds: Option<u64> = None;
    // The grain of every atom; atoms of other types are not grains of this group.
    let mut atoms: HashMap<u64, Option<usize>> = HashMap::new();
    let mut moved: HashSet<u64> = HashSet::new();
    let mut kinds: Vec<u64> = Vec::new();
    let mut found = 0;
    let mut velocities: Option<Line<'_>> = None;
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
            if section == Section::Velocities {
                if atoms.is_empty() && rows.complaints.is_empty() {
                    rows.complain(
                        Complaint::new("the section `Velocities` stands before the section `Atoms`")
                            .at(&line.place(rows.source), "whose are they?")
                            .hint("`Atoms` comes first, as LAMMPS wants it"),
                    );
                    return;
                }
                velocities = Some(line);
                rows.grains.velocity = vec![[0.0; 3]; rows.grains.position.len()];
                rows.grains.spin = vec![[0.0; 3]; rows.grains.position.len()];
            }
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
                if let Some(count) = bare.text.strip_suffix("atom types") {
                    most_kinds = count.trim().parse().ok();
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
                if row.kind == 0 || most_kinds.is_some_and(|most| row.kind > most) {
                    let most = most_kinds.map_or_else(String::new, |most| format!(" to {most}, as the head says"));
                    rows.complain(
                        Complaint::new(format!("there is no atom type {}", row.kind))
                            .at(&line.place(rows.source), format!("types go from 1{most}")),
                    );
                    return;
                }
                let kept = rows.how.kind.is_none_or(|kind| u64::from(kind) == row.kind);
                if atoms.insert(row.id, kept.then_some(rows.grains.position.len())).is_some() {
                    rows.complain(
                        Complaint::new(format!("the atom {} is there twice", row.id))
                            .at(&line.place(rows.source), "again"),
                    );
                    return;
                }
                if !kept {
                    continue;
                }
                rows.keep(&row, &bare, &columns);
            }
            Section::Velocities => {
                let Some(row) = rows.row(&bare, None, &velocity_columns()) else {
                    if rows.hopeless() {
                        return;
                    }
                    continue;
                };
                let unfit = match (atoms.get(&row.id), moved.insert(row.id)) {
                    // The row of the atom has a complaint already.
                    (None, _) if !rows.complaints.is_empty() => continue,
                    (None, _) => format!("there is no atom {} to move", row.id),
                    (Some(_), false) => format!("the velocity of the atom {} is there twice", row.id),
                    (Some(grain), true) => {
                        if let Some(grain) = *grain {
                            rows.grains.velocity[grain] = row.velocity;
                            rows.grains.spin[grain] = row.spin;
                        }
                        continue;
                    }
                };
                rows.complain(Complaint::new(unfit).at(&line.place(rows.source), "in this line"));
                return;
            }
        }
    }
    if rows.complaints.is_empty() {
        whole(rows, promised, found, &kinds, velocities.map(|line| (moved.len(), line)));
    }
}

/// What only the end of the file can tell.
fn whole(
    rows: &mut Rows,
    promised: Option<(usize, Line<'_>)>,
    found: usize,
    kinds: &[u64],
    moved: Option<(usize, Line<'_>)>,
) {
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
    } else if let Some((moved, line)) = moved.filter(|(moved, _)| *moved < found) {
        rows.complain(
            Complaint::new(format!("the file has {found} atoms and the velocities of {moved}"))
                .at(&line.place(rows.source), "needs a row for each atom"),
        );
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
