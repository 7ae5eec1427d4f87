//! LAMMPS data files, atom_style sphere, SI units: the sections `Atoms` (id type diameter density x y z, perhaps with
//! image flags) and `Velocities` (id vx vy vz wx wy wz). Grains stand in the order of their ids, whatever that of the file.

use super::{Column, Rows, Slot};
use crate::complaint::{Complaint, Place};
use crate::lines::{Line, lines};
use crate::suggest;
use std::collections::{BTreeSet, HashMap, HashSet};

const SECTIONS: [&str; 3] = ["Atoms", "Velocities", "Masses"];

/// Where in the file a line is.
#[derive(Clone, Copy, Default, PartialEq)]
enum Section {
    #[default]
    Head,
    Atoms,
    Velocities,
    Other,
}

pub(super) fn read(text: &str, rows: &mut Rows) {
    let mut file = File::default();
    let mut all = lines(text);
    // The first line is a title, but `write_data` tells the units there.
    if let Some(complaint) = all.next().and_then(|title| other_units(&title, rows.source)) {
        return rows.complain(complaint);
    }
    for line in all {
        let bare = line.before('#');
        // Small letters are no section but a slip in a row.
        let goes_on = if bare.text.is_empty() {
            Ok(())
        } else if bare.text.starts_with(char::is_uppercase) {
            file.begin(line, &bare, rows)
        } else {
            match file.section {
                Section::Head => file.head(line, &bare, rows),
                Section::Other => Ok(()),
                Section::Atoms => file.atom(line, &bare, rows),
                Section::Velocities => file.velocity(line, &bare, rows),
            }
        };
        match goes_on {
            Ok(()) => {}
            Err(Stop::Complaint(complaint)) => return rows.complain(complaint),
            Err(Stop::Hopeless) => return,
        }
    }
    if rows.complaints.is_empty()
        && let Some(complaint) = file.whole(rows)
    {
        rows.complain(complaint);
    }
}

/// `... timestep = 1000, units = cgs` in the title of what `write_data` wrote.
fn other_units(title: &Line, source: usize) -> Option<Complaint> {
    let (_, units) = title.text.split_once("units =")?;
    let units = units.split([',', ' ']).find(|word| !word.is_empty())?;
    (units != "si").then(|| {
        Complaint::new(format!("the file is in the units `{units}` of LAMMPS"))
            .at(&title.place(source), "only SI units are read")
            .hint("convert it to `units si`")
    })
}

/// Why reading ends before the file.
enum Stop {
    Complaint(Complaint),
    /// There are complaints enough.
    Hopeless,
}

impl From<Complaint> for Stop {
    fn from(complaint: Complaint) -> Self {
        Self::Complaint(complaint)
    }
}

/// What has been read so far.
#[derive(Default)]
struct File<'a> {
    section: Section,
    /// Atoms that the head promises, and where.
    promised: Option<(usize, Line<'a>)>,
    most_kinds: Option<u64>,
    columns: Vec<Column>,
    /// The grain of every atom; atoms of other types are not grains of this group.
    atoms: HashMap<u64, Option<usize>>,
    kinds: BTreeSet<u64>,
    /// Rows of atoms.
    found: usize,
    /// Where the velocities begin.
    velocities: Option<Line<'a>>,
    /// Atoms that have one.
    moved: HashSet<u64>,
}

impl<'a> File<'a> {
    fn begin(&mut self, line: Line<'a>, bare: &Line, rows: &mut Rows) -> Result<(), Stop> {
        self.section = match bare.text {
            "Atoms" => Section::Atoms,
            "Velocities" => Section::Velocities,
            // Spheres have their masses from densities; coefficients and labels are those of the laws of LAMMPS.
            "Masses" => Section::Other,
            other if other.ends_with(" Coeffs") || other.ends_with(" Type Labels") => Section::Other,
            other => {
                let complaint = Complaint::new(format!("the section `{other}` cannot be read"))
                    .at(&bare.place(rows.source), "not a section of grains");
                let near = suggest::nearest(other, SECTIONS).map(|near| format!("did you mean `{near}`?"));
                return Err(complaint.hints(near).hint(format!("sections: {}", suggest::list(SECTIONS))).into());
            }
        };
        if self.section == Section::Velocities {
            if self.atoms.is_empty() && rows.complaints.is_empty() {
                return Err(Complaint::new("the section `Velocities` stands before the section `Atoms`")
                    .at(&line.place(rows.source), "whose are they?")
                    .hint("`Atoms` comes first, as LAMMPS wants it")
                    .into());
            }
            self.velocities = Some(line);
            rows.grains.velocity = vec![[0.0; 3]; rows.grains.position.len()];
            rows.grains.spin = vec![[0.0; 3]; rows.grains.position.len()];
        }
        let style = line.text.split_once('#').map(|(_, style)| style.trim()).filter(|style| !style.is_empty());
        match style.filter(|style| self.section == Section::Atoms && *style != "sphere") {
            None => Ok(()),
            Some(style) => Err(Complaint::new(format!("atom_style `{style}` does not say how large the grains are"))
                .at(&line.place(rows.source), "needs `Atoms # sphere`")
                .into()),
        }
    }

    fn head(&mut self, line: Line<'a>, bare: &Line, rows: &Rows) -> Result<(), Stop> {
        let words: Vec<&str> = bare.text.split_whitespace().collect();
        match words.as_slice() {
            [count, "atoms"] => self.promised = count.parse().ok().map(|count| (count, line)),
            [count, "atom", "types"] => self.most_kinds = count.parse().ok(),
            // The ends of the world are the scene's own, and what is bound has its sections.
            [_, "bonds" | "angles" | "dihedrals" | "impropers" | "ellipsoids" | "lines" | "triangles" | "bodies"]
            | [_, "bond" | "angle" | "dihedral" | "improper", "types"]
            | [_, _, "xlo", "xhi"]
            | [_, _, "ylo", "yhi"]
            | [_, _, "zlo", "zhi"]
            | [_, _, _, "xy", "xz", "yz"]
            | [_, _, _, "avec" | "bvec" | "cvec"]
            | [_, _, _, "abc", "origin"]
            | [_, "extra", ..] => {}
            _ => {
                return Err(Complaint::new("a line of the head cannot be read")
                    .at(&bare.place(rows.source), "not a line of the head of a LAMMPS data file")
                    .hint("for example `2 atoms`, `1 atom types`, `0 0.1 xlo xhi`")
                    .into());
            }
        }
        Ok(())
    }

    fn atom(&mut self, line: Line, bare: &Line, rows: &mut Rows) -> Result<(), Stop> {
        self.found += 1;
        if self.columns.is_empty() {
            self.columns = atom_columns(bare.cells(None).count());
        }
        let Some(row) = rows.row(bare, None, &self.columns) else {
            return if rows.hopeless() { Err(Stop::Hopeless) } else { Ok(()) };
        };
        self.kinds.insert(row.kind);
        if row.kind == 0 || self.most_kinds.is_some_and(|most| row.kind > most) {
            let most = self.most_kinds.map_or_else(String::new, |most| format!(" to {most}, as the head says"));
            return Err(Complaint::new(format!("there is no atom type {}", row.kind))
                .at(&line.place(rows.source), format!("types go from 1{most}"))
                .into());
        }
        let kept = rows.how.kind.is_none_or(|kind| u64::from(kind) == row.kind);
        if self.atoms.insert(row.id, kept.then_some(rows.grains.position.len())).is_some() {
            return Err(Complaint::new(format!("the atom {} is there twice", row.id))
                .at(&line.place(rows.source), "again")
                .into());
        }
        if kept {
            rows.keep(&row, bare, &self.columns);
        }
        Ok(())
    }

    fn velocity(&mut self, line: Line, bare: &Line, rows: &mut Rows) -> Result<(), Stop> {
        let Some(row) = rows.row(bare, None, &velocity_columns()) else {
            return if rows.hopeless() { Err(Stop::Hopeless) } else { Ok(()) };
        };
        let unfit = match (self.atoms.get(&row.id), self.moved.insert(row.id)) {
            // The row of the atom has a complaint already.
            (None, _) if !rows.complaints.is_empty() => return Ok(()),
            (None, _) => format!("there is no atom {} to move", row.id),
            (Some(_), false) => format!("the velocity of the atom {} is there twice", row.id),
            (Some(grain), true) => {
                if let Some(grain) = *grain {
                    rows.grains.velocity[grain] = row.velocity;
                    rows.grains.spin[grain] = row.spin;
                }
                return Ok(());
            }
        };
        Err(Complaint::new(unfit).at(&line.place(rows.source), "in this line").into())
    }

    /// What only the end of the file can tell.
    fn whole(&self, rows: &Rows) -> Option<Complaint> {
        let (found, moved) = (self.found, self.moved.len());
        if self.promised.is_none() {
            return Some(
                Complaint::new("the head of the file does not say how many atoms there are")
                    .at(&Place::new(rows.source, 0..0), "no line such as `2 atoms`")
                    .hint("without it nobody can tell whether the file is whole"),
            );
        }
        if let Some((count, line)) = self.promised.filter(|(count, _)| *count != found) {
            let complaint = Complaint::new(format!("the file promises {count} atoms and has {found}"))
                .at(&line.place(rows.source), format!("says {count}"));
            return Some(complaint.hint("was it cut off while it was written?"));
        }
        if let Some(kind) = rows.how.kind.filter(|kind| found > 0 && !self.kinds.contains(&u64::from(*kind))) {
            let kinds: Vec<String> = self.kinds.iter().map(ToString::to_string).collect();
            return Some(
                Complaint::new(format!("no atom of the file is of type {kind}"))
                    .hint(format!("types in the file: {}", kinds.join(", "))),
            );
        }
        let line = self.velocities.filter(|_| moved < found)?;
        let complaint = Complaint::new(format!("the file has {found} atoms and the velocities of {moved}"));
        Some(complaint.at(&line.place(rows.source), "needs a row for each atom"))
    }
}

fn atom_columns(count: usize) -> Vec<Column> {
    let slots =
        [Slot::Id, Slot::Kind, Slot::Diameter, Slot::Density, Slot::Position(0), Slot::Position(1), Slot::Position(2)];
    // Image flags tell how often a grain went round a periodic world; its place is in the world already.
    let flags = if count == 10 { 3 } else { 0 };
    slots.into_iter().chain([Slot::Passed; 3].into_iter().take(flags)).map(Column::new).collect()
}

fn velocity_columns() -> [Column; 7] {
    let [v, w] = [Slot::Velocity, Slot::Spin].map(|slot| [0, 1, 2].map(slot));
    [Slot::Id, v[0], v[1], v[2], w[0], w[1], w[2]].map(Column::new)
}
