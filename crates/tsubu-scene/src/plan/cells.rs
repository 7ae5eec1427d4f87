//! Grains of cells as bodies of DEM: polygons where the outline has no bays, discs otherwise.

use super::body::scaled;
use super::polyhedron::with_mass;
use super::{Clump, ClumpOrientation, GrainShape};
use crate::cells::{AREA, Cells, place};
use crate::clump::Solid;
use crate::polyhedron::{Plane, core, crossing, faces, measured};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Radius of the disc that stands for a cell at the rim [spacings]: those of neighbours touch, so grains that stand beside each other on the
/// lattice do too.
const DISC: f64 = 0.5;

/// The sides of an outline without bays; `None`: it has some, or a hole.
pub(crate) fn planes(cells: &Cells) -> Option<Vec<Plane>> {
    let corners: Vec<Vector3<f64>> = cells.outline().into_iter().map(|at| 0.5 * point(place(at))).collect();
    if crossing(&corners).is_some() { None } else { faces(&corners, false).ok() }
}

fn point([x, z]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(x, 0.0, z)
}

/// How the cells are spread, about the middle of all, in spacings.
fn solid(cells: &Cells) -> Solid {
    let spread = cells.spread();
    let [x, z] = spread.long();
    let (about, across) = (spread.beside([x, z]), spread.beside([-z, x]));
    Solid {
        volume: AREA * cells.points().len() as f64,
        centre: point(spread.centre).into(),
        moments: [about, about + across, across],
        axes: [[x, 0.0, z], [0.0, 1.0, 0.0], [-z, 0.0, x]],
    }
}

/// The discs at the rim; what is within cannot be touched.
fn discs(cells: &Cells) -> Vec<([f64; 3], f64)> {
    cells.rim().map(|at| (point(place(at)).into(), DISC)).collect()
}

/// The body: outline of the cells, mass and moments of inertia of the cells.
pub(super) fn body(cells: &Cells, rounding: f64, orientation: ClumpOrientation) -> Option<Clump> {
    let solid = solid(cells);
    if let Some(planes) = planes(cells) {
        return Some(with_mass(core(&planes, rounding, false)?, rounding, &solid, false, orientation));
    }
    let body = scaled(&discs(cells), &solid, 0.0, orientation);
    // Of what is flat the area, which goes with the square of the size.
    let size = (solid.moments[1] / body.moments[1]).sqrt();
    Some(Clump { volume: solid.volume / (size * size), ..body })
}

/// What stands for cells in DEM, and what it has more than they have, over what they have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellError {
    /// Discs of a clump; `None`: it is a polygon.
    pub discs: Option<usize>,
    /// Of the area.
    pub area: f64,
    /// Of the moment of inertia about the middle, at the same density.
    pub inertia: f64,
}

impl GrainShape {
    /// The cells that it is made of.
    pub fn cells(&self) -> Option<Cells> {
        if let Self::Cells { outline, .. } = self { outline.cells() } else { None }
    }

    /// The diameter of a body that has a size of its own [m]; of cells that make no body, which is complained about elsewhere, their spacing.
    pub fn own_diameter(&self) -> Option<f64> {
        let Self::Cells { spacing, .. } = self else { return None };
        let (cells, body) = (self.cells(), self.clump());
        let share = cells.zip(body).map(|(cells, body)| AREA * cells.points().len() as f64 / body.volume);
        Some(spacing * share.unwrap_or(1.0).sqrt())
    }

    /// How well the outline that others touch stands for the cells, whose mass and moment of inertia the body has. A disc stands for every cell,
    /// also for those within.
    pub fn cell_error(&self) -> Option<CellError> {
        let Self::Cells { outline, rounding, .. } = self else { return None };
        let cells = outline.cells()?;
        let solid = solid(&cells);
        let (discs, area, polar) = if let Some(planes) = planes(&cells) {
            let body =
                measured(&core(&planes, *rounding, false)?.about(&Vector3::from(solid.centre)), *rounding, false);
            (None, body.volume, body.second.trace())
        } else {
            let area = PI * DISC * DISC * cells.points().len() as f64;
            // Of the squared distance a cell has 5/36 itself, a disc half its squared radius.
            (Some(cells.rim().count()), area, area * (solid.moments[1] - 5.0 / 36.0 + 0.5 * DISC * DISC))
        };
        Some(CellError {
            discs,
            area: area / solid.volume - 1.0,
            inertia: polar / (solid.volume * solid.moments[1]) - 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::GrainPoints;

    const RANDOM: ClumpOrientation = ClumpOrientation::Random;

    fn grain(at: &[[i64; 2]]) -> GrainShape {
        let at = at.iter().map(|[h, k]| [*h as f64, 0.0, *k as f64]).collect();
        let outline = GrainPoints::Points { at };
        GrainShape::Cells { outline, spacing: 2.0, rounding: 0.1, thickness: 3.0, orientation: RANDOM }
    }

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found} {expected}");
    }

    /// A row of five, slanting: a polygon; mass of the cells; the long axis along the row, with a moment of inertia of a cell about it and
    /// one of the row across. Reach: from the middle to the rounded corner.
    #[test]
    fn a_row_is_a_polygon_with_the_mass_of_its_cells() {
        let shape = grain(&[[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]);
        let body = shape.clump().expect("a body");
        assert!(shape.is_polyhedron() && body.polyhedron.is_some());
        let diameter = shape.own_diameter().expect("a size");
        near(shape.mass(7.0, diameter), 7.0 * 3.0 * 5.0 * AREA * 4.0);
        let per = (diameter / 2.0).powi(2);
        near(body.moments[0] * per, 5.0 / 72.0);
        near(body.moments[2] * per, 2.0 + 5.0 / 72.0);
        near(body.axes[0][0], AREA);
        near(body.axes[0][2], 0.5);
        // The corner lies 2.5 along the row, on its line; two sides meet there at 60 degrees to it.
        let corner = 2.5 - 0.1 * (1.0 / (1.0_f64 / 3.0).sqrt().atan().cos() - 1.0);
        near(diameter, 2.0 * 2.0 * corner);
        // Of the area a quarter of a cell is not there, and what six corners of 120 degrees lose by rounding.
        let lost = 0.25 * AREA + 6.0 * 0.01 * (1.0 / 3f64.sqrt() - PI / 6.0);
        near(shape.cell_error().expect("an error").area, -lost / (5.0 * AREA));
    }

    /// A hook has a bay: discs in the places of its cells, which touch and do not overlap; mass and moment of inertia of the cells.
    #[test]
    fn a_hook_is_a_clump() {
        let shape = grain(&[[0, 0], [0, 2], [1, 3], [2, 2], [2, 0], [2, -2]]);
        let body = shape.clump().expect("a body");
        assert!(!shape.is_polyhedron() && body.polyhedron.is_none());
        let diameter = shape.own_diameter().expect("a size");
        near(shape.mass(1.0, diameter), 3.0 * 6.0 * AREA * 4.0);
        assert_eq!(body.pieces.len(), 6);
        near(body.pieces[0].1 * diameter, 1.0);
        let error = shape.cell_error().expect("an error");
        near(error.area, PI / 4.0 / AREA - 1.0);
        // A filled hexagon of radius 2 with one cell missing at its rim has one more row of discs, none within.
        let mut points = Cells::hexagon(2).points().to_vec();
        points.retain(|at| *at != [0, 4] && *at != [1, 3]);
        let discs = grain(&points).cell_error().expect("an error").discs;
        assert_eq!(discs, Some(12));
    }
}
