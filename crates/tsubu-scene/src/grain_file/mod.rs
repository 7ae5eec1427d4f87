//! Grains from a file: places, and where the file has them diameters, velocities and spins.
//!
//! Each format says what stands in which column; the rows themselves are read here, so that a bad number is the same
//! message everywhere.

pub(crate) mod clump;
mod csv;
mod dump;
mod lammps;
mod vtp;
mod xyz;

use crate::complaint::{Complaint, Place};
use crate::lines::{Cell, Line, MOST_COMPLAINTS};
use crate::plan::{GrainTable, Vector};
use crate::units::{DENSITY, Dimension, LENGTH, MASS, NUMBER, SPEED, SPIN, Scale};
use std::sync::Arc;

/// What a file holds, and where.
#[derive(Clone, Debug, Default)]
pub(crate) struct GrainFile {
    pub grains: Arc<GrainTable>,
    /// The line of each grain, counted from 1.
    pub lines: Vec<u32>,
    /// The density of each grain [kg/m^3], where the file tells it: the scene's own must agree.
    pub densities: Vec<f64>,
    /// The mass of each grain [kg], likewise.
    pub masses: Vec<f64>,
}

impl GrainFile {
    /// The density that the file tells of each grain [kg/m^3]: itself, or by a mass; `volume` is that of a grain of a
    /// diameter, for which the scene's is taken where the file has none.
    pub fn told_densities(&self, diameter: f64, volume: impl Fn(f64) -> f64) -> Vec<f64> {
        let size = |index| self.grains.diameter.get(index).copied().unwrap_or(diameter);
        let by_mass = self.masses.iter().enumerate().map(|(index, mass)| mass / volume(size(index)));
        if self.densities.is_empty() { by_mass.collect() } else { self.densities.clone() }
    }
}

/// What a scene says about how the file is to be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct How {
    /// Three dimensions, not two.
    pub space: bool,
    /// Which atom type of a LAMMPS file.
    pub kind: Option<u32>,
}

/// The text of a file whose bytes are none: its grains in rows.
pub(crate) fn as_text(name: &str, bytes: &[u8]) -> Option<Result<String, Complaint>> {
    (ending(name) == "vtp").then(|| vtp::as_dump(name, bytes))
}

/// Reads the text of the file of that name, which is the given source of complaints.
pub(crate) fn read(name: &str, text: &str, source: usize, how: How) -> Result<GrainFile, Vec<Complaint>> {
    let mut rows = Rows { source, how, ..Rows::default() };
    match ending(name).as_str() {
        "csv" => csv::read(text, &mut rows),
        "xyz" => xyz::read(text, &mut rows),
        "data" => lammps::read(text, &mut rows),
        "lammpstrj" | "vtp" => dump::read(text, &mut rows),
        // Refused before it was read.
        _ => {}
    }
    if rows.complaints.is_empty() && rows.grains.position.is_empty() {
        rows.complain(
            Complaint::new("the file has no grains").at(&Place::new(source, 0..0), "no row of numbers in this file"),
        );
    }
    if rows.complaints.is_empty() {
        rows.sort_by_id();
        Ok(GrainFile {
            grains: Arc::new(rows.grains),
            lines: rows.lines,
            densities: rows.densities,
            masses: rows.masses,
        })
    } else {
        Err(rows.complaints)
    }
}

/// Whether a file of this name can be read; the complaint has yet to be placed.
pub(crate) fn known(name: &str) -> Result<(), Complaint> {
    const FORMATS: &str = "`.csv` (columns x, y, z, radius), `.xyz` (extended XYZ), `.data` (LAMMPS, atom_style sphere), `.lammpstrj` (a dump of LAMMPS), `.vtp` (VTK PolyData)";
    match ending(name).as_str() {
        "csv" | "xyz" | "data" | "lammpstrj" | "vtp" => Ok(()),
        "gz" | "bz2" | "xz" | "zip" | "zst" => {
            Err(Complaint::new(format!("`{name}` is compressed")).hint("unpack it and name what was in it"))
        }
        _ => Err(Complaint::new(format!("the ending of `{name}` tells no format of grains"))
            .hint(format!("formats: {FORMATS}"))),
    }
}

/// The ending of a file name in small letters, without the point.
pub(crate) fn ending(name: &str) -> String {
    name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase()).unwrap_or_default()
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    Skip,
    /// A number that says nothing here, and still must be one.
    Passed,
    Position(usize),
    Diameter,
    Density,
    Mass,
    Velocity(usize),
    Spin(usize),
    Id,
    Kind,
}

/// A column and what makes its numbers SI; a radius is a diameter with the factor 2.
#[derive(Clone, Copy, Debug)]
struct Column {
    slot: Slot,
    scale: Scale,
    factor: f64,
}

impl Slot {
    const fn dimension(self) -> &'static Dimension {
        match self {
            Self::Position(_) | Self::Diameter => &LENGTH,
            Self::Density => &DENSITY,
            Self::Mass => &MASS,
            Self::Velocity(_) => &SPEED,
            Self::Spin(_) => &SPIN,
            Self::Skip | Self::Passed | Self::Id | Self::Kind => &NUMBER,
        }
    }
}

impl Column {
    const fn new(slot: Slot) -> Self {
        Self { slot, scale: Scale::SI, factor: 1.0 }
    }

    const fn radius() -> Self {
        Self { factor: 2.0, ..Self::new(Slot::Diameter) }
    }
}

/// What one line says.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    position: Vector,
    diameter: f64,
    density: f64,
    mass: f64,
    velocity: Vector,
    spin: Vector,
    id: u64,
    kind: u64,
}

/// The grains read so far.
#[derive(Default)]
struct Rows {
    source: usize,
    how: How,
    grains: GrainTable,
    lines: Vec<u32>,
    densities: Vec<f64>,
    masses: Vec<f64>,
    ids: Vec<u64>,
    complaints: Vec<Complaint>,
}

impl Rows {
    fn complain(&mut self, complaint: Complaint) {
        self.complaints.push(complaint);
    }

    /// Whether reading on would only say the same again.
    const fn hopeless(&self) -> bool {
        self.complaints.len() >= MOST_COMPLAINTS
    }

    /// Reads one line; `None` after a complaint.
    fn row(&mut self, line: &Line<'_>, separator: Option<char>, columns: &[Column]) -> Option<Row> {
        let mut row = Row::default();
        let mut count = 0;
        for cell in line.cells(separator) {
            if let Some(column) = columns.get(count)
                && let Err(complaint) = self.cell(&mut row, *column, &cell)
            {
                self.complain(complaint);
                return None;
            }
            count += 1;
        }
        if count != columns.len() {
            let label = format!("{count} cells in this line, expected {}", columns.len());
            self.complain(Complaint::new("a row has another number of columns").at(&line.place(self.source), label));
            return None;
        }
        if !self.how.space
            && let Some(complaint) = leaves_the_plane(&row)
        {
            self.complain(complaint.at(&line.place(self.source), "in this line"));
            return None;
        }
        Some(row)
    }

    fn cell(&self, row: &mut Row, column: Column, cell: &Cell<'_>) -> Result<(), Complaint> {
        match column.slot {
            Slot::Skip => return Ok(()),
            Slot::Id | Slot::Kind => {
                let whole = cell.text.parse().map_err(|_| {
                    Complaint::new(format!("`{}` is not a whole number", cell.text))
                        .at(&cell.place(self.source), "needs a whole number")
                })?;
                *if column.slot == Slot::Id { &mut row.id } else { &mut row.kind } = whole;
                return Ok(());
            }
            _ => {}
        }
        let plain = column.scale.apply(cell.text).ok_or_else(|| {
            Complaint::new(format!("`{}` is not a number", cell.text)).at(&cell.place(self.source), "needs a number")
        })?;
        let number = plain * column.factor;
        if !number.is_finite() {
            return Err(Complaint::new(format!("`{}` is not a finite number", cell.text))
                .at(&cell.place(self.source), "needs a number"));
        }
        let above_zero = matches!(column.slot, Slot::Diameter | Slot::Density | Slot::Mass) && number > 0.0;
        if let Some(why) = column.slot.dimension().absurd(number, above_zero) {
            return Err(Complaint::new(format!("`{}` cannot be meant: it {why}", cell.text))
                .at(&cell.place(self.source), format!("needs {}", column.slot.dimension().name)));
        }
        match column.slot {
            Slot::Position(axis) => row.position[axis] = number,
            Slot::Velocity(axis) => row.velocity[axis] = number,
            Slot::Spin(axis) => row.spin[axis] = number,
            Slot::Diameter if number <= 0.0 => {
                return Err(Complaint::new(format!("`{}` is no size of a grain", cell.text))
                    .at(&cell.place(self.source), "needs a number above 0"));
            }
            Slot::Density if number <= 0.0 => {
                return Err(Complaint::new(format!("`{}` is no density of a grain", cell.text))
                    .at(&cell.place(self.source), "needs a number above 0"));
            }
            Slot::Diameter => row.diameter = number,
            Slot::Density => row.density = number,
            // What is held in place may weigh nothing.
            Slot::Mass => row.mass = number,
            Slot::Skip | Slot::Passed | Slot::Id | Slot::Kind => {}
        }
        Ok(())
    }

    /// Keeps a row as a grain.
    fn keep(&mut self, row: &Row, line: &Line<'_>, columns: &[Column]) {
        let has = |wanted: fn(Slot) -> bool| columns.iter().any(|column| wanted(column.slot));
        self.grains.position.push(row.position);
        self.lines.push(line.number);
        if has(|slot| slot == Slot::Diameter) {
            self.grains.diameter.push(row.diameter);
        }
        if has(|slot| slot == Slot::Density) {
            self.densities.push(row.density);
        }
        if has(|slot| slot == Slot::Mass) {
            self.masses.push(row.mass);
        }
        if has(|slot| slot == Slot::Id) {
            self.ids.push(row.id);
        }
        if has(|slot| matches!(slot, Slot::Velocity(_))) {
            self.grains.velocity.push(row.velocity);
        }
        if has(|slot| matches!(slot, Slot::Spin(_))) {
            self.grains.spin.push(row.spin);
        }
    }
}

impl Rows {
    /// Programs write grains in the order in which they happen to hold them; their numbers are what lasts.
    fn sort_by_id(&mut self) {
        fn sorted<T: Copy>(order: &[usize], column: &mut Vec<T>) {
            if !column.is_empty() {
                *column = order.iter().map(|index| column[*index]).collect();
            }
        }
        let mut order: Vec<usize> = (0..self.ids.len()).collect();
        if self.ids.is_sorted() {
            return;
        }
        order.sort_by_key(|index| self.ids[*index]);
        let GrainTable { position, diameter, velocity, spin } = &mut self.grains;
        for column in [position, velocity, spin] {
            sorted(&order, column);
        }
        sorted(&order, diameter);
        sorted(&order, &mut self.densities);
        sorted(&order, &mut self.masses);
        sorted(&order, &mut self.lines);
    }
}

fn leaves_the_plane(row: &Row) -> Option<Complaint> {
    let complaint = if row.position[1] != 0.0 || row.velocity[1] != 0.0 {
        Complaint::new("a grain leaves the plane: its y is not 0, but the scene has dimension 2")
    } else if row.spin[0] != 0.0 || row.spin[2] != 0.0 {
        Complaint::new("a grain spins out of the plane, but the scene has dimension 2")
    } else {
        return None;
    };
    Some(complaint.hint("the plane of a scene is x (to the right) and z (up); or set dimension = 3"))
}
