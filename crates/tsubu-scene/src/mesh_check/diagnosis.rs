//! What was found in a mesh, as numbers and in words.

use crate::plan::Vector;
use std::fmt;

/// Places that are told; of the rest only the number.
const TOLD: usize = 3;

/// How often something was found, and where the first few are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// How often.
    pub count: usize,
    /// Where [m]: middles of triangles or edges, the first few.
    pub places: Vec<Vector>,
}

impl Found {
    pub(super) fn add(&mut self, place: Vector) {
        self.count += 1;
        if self.places.len() < TOLD {
            self.places.push(place);
        }
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// "3, the first at (0, 1, 2)".
impl fmt::Display for Found {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.count)?;
        let [x, y, z] = match self.places.first() {
            Some(place) if place.iter().all(|x| x.is_finite()) => place.map(short),
            _ => return Ok(()),
        };
        let first = if self.count > 1 { "the first " } else { "" };
        write!(formatter, ", {first}at ({x}, {y}, {z}) m")
    }
}

/// Six digits are enough to find a place.
fn short(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// What was found in a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnosis {
    /// Number of triangles.
    pub triangles: usize,
    /// Number of different corners.
    pub corners: usize,
    /// From the smallest to the largest coordinate along each axis [m].
    pub extent: Vector,
    /// Triangles with a corner that is no finite number.
    pub not_finite: Found,
    /// Triangles without area.
    pub degenerate: Found,
    /// Triangles that are there more than once.
    pub duplicated: Found,
    /// Edges with one triangle: the rims of holes, or of an open mesh.
    pub open_edges: Found,
    /// Lines that the open edges make.
    pub rims: usize,
    /// Rims that look as if they were meant: closed lines of more than three edges (a triangle that is missing has three)
    /// which are not small beside the mesh.
    pub openings: usize,
    /// Width of the narrowest of them along the axes [m].
    pub narrowest: Option<f64>,
    /// Edges that more than two triangles share.
    pub crowded_edges: Found,
    /// Edges whose two triangles go round the same way, so that their normals are on different sides.
    pub flipped_edges: Found,
}

impl Diagnosis {
    /// Whether nothing at all was found: a closed surface with all normals on one side.
    pub const fn is_clean(&self) -> bool {
        self.not_finite.is_empty()
            && self.degenerate.is_empty()
            && self.duplicated.is_empty()
            && self.open_edges.is_empty()
            && self.crowded_edges.is_empty()
            && self.flipped_edges.is_empty()
    }
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} triangles, {} corners", self.triangles, self.corners)?;
        if self.is_clean() {
            return write!(formatter, "; closed, all normals on one side");
        }
        let rims = if self.rims == 1 { "1 rim".to_string() } else { format!("{} rims", self.rims) };
        let open = format!("open along {rims}: edges with one triangle");
        for (what, found) in [
            ("triangles with corners that are no finite numbers", &self.not_finite),
            ("triangles without area", &self.degenerate),
            ("triangles that are there twice", &self.duplicated),
            (open.as_str(), &self.open_edges),
            ("edges that more than two triangles share", &self.crowded_edges),
            ("edges where the normal changes sides", &self.flipped_edges),
        ] {
            if !found.is_empty() {
                write!(formatter, "; {what}: {found}")?;
            }
        }
        Ok(())
    }
}
