//! The matrices of a structure as programs for finite elements write them, told apart by what their files begin with.

mod abaqus;
mod calculix;
mod market;
mod modes;
mod nastran;

use crate::complaint::{Complaint, Place};
use crate::lines::lines;
use std::collections::{BTreeMap, BTreeSet};

pub(super) use calculix::names;
pub(super) use modes::modes;

/// The largest matrix that is read.
const MOST: usize = 400;

/// A coordinate of a structure: the displacement of a node along x, y, z (1 to 3), its rotation about them (4 to 6), or, with direction 0,
/// one that belongs to no direction. Coordinates that are only numbered have nodes from 1 on and direction 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Coordinate {
    pub node: u64,
    pub direction: u8,
}

/// What a matrix is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    Mass,
    Damping,
    Stiffness,
}

impl Role {
    pub fn key(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::Damping => "damping",
            Self::Stiffness => "stiffness",
        }
    }
}

/// What a program calculates in, with seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    /// Its unit of mass [kg].
    mass: f64,
    /// Its unit of length [m].
    length: f64,
}

impl Units {
    /// By the word of a scene.
    pub fn named(word: &str) -> Option<Self> {
        match word {
            "m-kg-s" => Some(Self { mass: 1.0, length: 1.0 }),
            "mm-t-s" => Some(Self { mass: 1000.0, length: 1e-3 }),
            // A mass that a pound-force gives 1 in/s^2: 4.448 221 615 260 5 N over 0.0254 m/s^2.
            "in-lbf-s" => Some(Self { mass: 175.126_835_246_476_35, length: 0.0254 }),
            _ => None,
        }
    }
}

/// A square matrix by its entries that are not 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Matrix {
    /// All of its coordinates.
    pub coordinates: BTreeSet<Coordinate>,
    entries: BTreeMap<(Coordinate, Coordinate), f64>,
}

impl Matrix {
    fn set(&mut self, row: Coordinate, column: Coordinate, value: f64) {
        self.coordinates.extend([row, column]);
        self.entries.insert((row, column), value);
    }

    /// With the mirror image of every entry whose mirror image is not written.
    fn mirrored(mut self) -> Self {
        let more: Vec<_> = self.entries.iter().map(|((row, column), value)| ((*column, *row), *value)).collect();
        for (place, value) in more {
            self.entries.entry(place).or_insert(value);
        }
        self
    }

    fn numbered(rows: &[Vec<f64>]) -> Self {
        let at = |index: usize| Coordinate { node: index as u64 + 1, direction: 0 };
        let mut matrix = Self::default();
        for (i, row) in rows.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                matrix.set(at(i), at(j), *value);
            }
        }
        matrix
    }

    /// Row by row, with these coordinates: displacements in m and rotations in rad, masses in kg.
    pub fn rows(&self, coordinates: &[Coordinate], units: Units) -> Vec<Vec<f64>> {
        let arm = |coordinate: Coordinate| if coordinate.direction > 3 { units.length } else { 1.0 };
        let entry = |row: Coordinate, column: Coordinate| {
            self.entries.get(&(row, column)).map_or(0.0, |value| value * (units.mass * arm(row) * arm(column)))
        };
        coordinates.iter().map(|row| coordinates.iter().map(|column| entry(*row, *column)).collect()).collect()
    }
}

/// Reads a matrix. The text is the given source; `names` are the coordinates of a file that only numbers them.
pub(super) fn read(text: &str, source: usize, role: Role, names: Option<&[Coordinate]>) -> Result<Matrix, Complaint> {
    let mut all = lines(text).map(|line| line.text);
    let first = all.find(|line| !line.is_empty() && !line.starts_with("**") && !line.starts_with('$'));
    let first = first.unwrap_or_default().to_uppercase();
    let words: Vec<&str> = first.split_whitespace().collect();
    let numbered =
        matches!(words[..], [row, column, _] if [row, column].iter().all(|word| word.parse::<u64>().is_ok()));
    let matrix = if first.starts_with("%%MATRIXMARKET") {
        Matrix::numbered(&market::read(text, source)?)
    } else if first.starts_with('*') || first.contains(',') && !first.starts_with("DMIG") {
        abaqus::read(text, source, role)?
    } else if numbered {
        calculix::read(text, source, names)?
    } else {
        nastran::read(text, source, role)?
    };
    let size = matrix.coordinates.len();
    if size == 0 || size > MOST {
        return Err(Complaint::new(format!("the matrix has {size} coordinates"))
            .at(&Place::new(source, 0..text.lines().next().map_or(0, str::len)), format!("1 to {MOST} can be read"))
            .hint("reduce the structure to its interfaces, or give its modes in a `modal-table`"));
    }
    Ok(matrix)
}

/// `1.5+4` and `1.5D+04` are 1.5e4.
fn number(field: &str) -> Option<f64> {
    let mut text = field.to_uppercase().replace('D', "E");
    if let Some(sign) = text.rfind(['+', '-']).filter(|sign| *sign > 0 && !text[..*sign].ends_with('E')) {
        text.insert(sign, 'E');
    }
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// Units in which a number is what it is.
#[cfg(test)]
const AS_WRITTEN: Units = Units { mass: 1.0, length: 1.0 };

#[cfg(test)]
mod tests {
    use super::*;

    /// The end of a beam of length L: 12 E I / L^3, 6 E I / L^2, 4 E I / L, in millimetres and in metres.
    #[test]
    fn rotations_bring_their_length() {
        let end = |modulus: f64, area_moment: f64, length: f64| {
            let bending = modulus * area_moment / length;
            [[12.0 / length / length, 6.0 / length], [6.0 / length, 4.0]].map(|row| row.map(|value| value * bending))
        };
        let coordinates = [3, 5].map(|direction| Coordinate { node: 8, direction });
        let mut matrix = Matrix::default();
        for (row, values) in coordinates.iter().zip(end(2.1e5, 1000.0, 100.0)) {
            for (column, value) in coordinates.iter().zip(values) {
                matrix.set(*row, *column, value);
            }
        }
        let found = matrix.rows(&coordinates, Units::named("mm-t-s").expect("units"));
        for (found, expected) in found.iter().flatten().zip(end(2.1e11, 1e-9, 0.1).iter().flatten()) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        }
    }
}
