//! What is wrong with a mesh, or at least worth knowing: triangles without area, holes, flipped neighbours.

use crate::plan::Vector;
use std::collections::{HashMap, HashSet};
use std::fmt;

/// Places that are told; of the rest only the number.
const TOLD: usize = 3;
/// Twice the area over the square of the longest edge below which a triangle is a line: what single precision leaves of
/// corners that were meant to be on one.
const FLAT: f64 = 1e-10;
/// Distance over the size of the mesh within which corners are one corner.
const WELD: f64 = 1e-9;

/// How often something was found, and where the first few are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// How often.
    pub count: usize,
    /// Where [m]: middles of triangles or edges, the first few.
    pub places: Vec<Vector>,
}

impl Found {
    fn add(&mut self, place: Vector) {
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
    /// Triangles with a corner that is no finite number.
    pub not_finite: Found,
    /// Triangles without area.
    pub degenerate: Found,
    /// Triangles that are there more than once.
    pub duplicated: Found,
    /// Edges with one triangle: the rims of holes, or of an open mesh.
    pub open_edges: Found,
    /// Closed lines that the open edges make.
    pub rims: usize,
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

/// Looks at everything. An open mesh is no mistake: hoppers are open.
pub fn diagnose(triangles: &[[Vector; 3]]) -> Diagnosis {
    let mut diagnosis = broken(triangles);
    let (corner_of, corners) = weld(triangles);
    diagnosis.corners = corners;
    let mut seen: HashSet<[usize; 3]> = HashSet::new();
    // Under the two corners of an edge, smaller first: how often it is gone along this way and the other way.
    let mut edges: HashMap<[usize; 2], [usize; 2]> = HashMap::new();
    let mut order = Vec::new();
    for (triangle, corners) in triangles.iter().zip(corner_of) {
        let Some(corners) = corners.filter(|[a, b, c]| a != b && b != c && c != a) else { continue };
        let mut sorted = corners;
        sorted.sort_unstable();
        if !seen.insert(sorted) {
            diagnosis.duplicated.add(middle(triangle));
            continue;
        }
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (from, to) = (corners[i], corners[j]);
            let key = [from.min(to), from.max(to)];
            let ways = edges.entry(key).or_insert_with(|| {
                order.push((key, middle(&[triangle[i], triangle[j]])));
                [0, 0]
            });
            ways[usize::from(from > to)] += 1;
        }
    }
    let mut rim = Rims::new(corners);
    for (key, place) in order {
        match edges[&key] {
            [1, 0] | [0, 1] => {
                diagnosis.open_edges.add(place);
                rim.join(key);
            }
            [1, 1] => {}
            [2, 0] | [0, 2] => diagnosis.flipped_edges.add(place),
            _ => diagnosis.crowded_edges.add(place),
        }
    }
    diagnosis.rims = rim.count();
    diagnosis
}

/// Only what makes a mesh useless: corners that are no numbers, triangles without area.
pub(crate) fn broken(triangles: &[[Vector; 3]]) -> Diagnosis {
    let mut diagnosis = Diagnosis { triangles: triangles.len(), ..Diagnosis::default() };
    for triangle in triangles {
        if triangle.iter().flatten().any(|x| !x.is_finite()) {
            diagnosis.not_finite.add(middle(triangle));
        } else if is_flat(triangle) {
            diagnosis.degenerate.add(middle(triangle));
        }
    }
    diagnosis
}

fn is_flat(triangle: &[Vector; 3]) -> bool {
    let [a, b, c] = triangle;
    let edge = |from: &Vector, to: &Vector| [0, 1, 2].map(|i| to[i] - from[i]);
    let edges = [edge(a, b), edge(b, c), edge(c, a)];
    let longest = edges.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    if longest == 0.0 || !longest.is_finite() {
        return true;
    }
    // Scaled first: the square of a tiny area would vanish.
    let [u, v] = [edges[0].map(|x| x / longest), edges[1].map(|x| x / longest)];
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    cross.iter().map(|x| x * x).sum::<f64>().sqrt() <= FLAT
}

fn middle(points: &[Vector]) -> Vector {
    [0, 1, 2].map(|i| points.iter().map(|point| point[i]).sum::<f64>() / points.len() as f64)
}

/// Numbers the corners; those nearer to each other than rounding are one. `None` for triangles that are not finite.
fn weld(triangles: &[[Vector; 3]]) -> (Vec<Option<[usize; 3]>>, usize) {
    let finite = || triangles.iter().flatten().filter(|corner| corner.iter().all(|x| x.is_finite()));
    let size = (0..3)
        .map(|i| {
            let low = finite().map(|corner| corner[i]).fold(f64::INFINITY, f64::min);
            finite().map(|corner| corner[i]).fold(f64::NEG_INFINITY, f64::max) - low
        })
        .fold(0.0, f64::max);
    let reach = if size.is_finite() { WELD * size } else { 0.0 };
    let mut known: HashMap<[i64; 3], Vec<(Vector, usize)>> = HashMap::new();
    let mut count = 0;
    let mut number = |corner: Vector| {
        let cell = |x: f64, step: f64| if reach > 0.0 { ((x + step) / reach).floor() as i64 } else { 0 };
        // What is near may have been rounded to the cell beside.
        for steps in 0..8 {
            let key = [0, 1, 2].map(|i| cell(corner[i], if steps >> i & 1 == 0 { -0.5 * reach } else { 0.5 * reach }));
            let near = |other: &&(Vector, usize)| (0..3).all(|i| (other.0[i] - corner[i]).abs() <= reach);
            if let Some((_, number)) = known.get(&key).and_then(|there| there.iter().find(near)) {
                return *number;
            }
        }
        known.entry(corner.map(|x| cell(x, 0.0))).or_default().push((corner, count));
        count += 1;
        count - 1
    };
    let numbered = triangles
        .iter()
        .map(|triangle| triangle.iter().flatten().all(|x| x.is_finite()).then(|| triangle.map(&mut number)))
        .collect();
    (numbered, count)
}

/// Open edges that share corners make one rim.
struct Rims {
    parent: Vec<usize>,
    touched: Vec<bool>,
}

impl Rims {
    fn new(corners: usize) -> Self {
        Self { parent: (0..corners).collect(), touched: vec![false; corners] }
    }

    fn root(&mut self, mut corner: usize) -> usize {
        while self.parent[corner] != corner {
            self.parent[corner] = self.parent[self.parent[corner]];
            corner = self.parent[corner];
        }
        corner
    }

    fn join(&mut self, [a, b]: [usize; 2]) {
        self.touched[a] = true;
        self.touched[b] = true;
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a] = b;
    }

    fn count(&self) -> usize {
        (0..self.parent.len()).filter(|corner| self.touched[*corner] && self.parent[*corner] == *corner).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit cube, all normals outwards.
    fn cube() -> Vec<[Vector; 3]> {
        let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|x| x as f64);
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|side| side.map(corner)).collect()
    }

    #[test]
    fn a_cube_is_clean() {
        let diagnosis = diagnose(&cube());
        assert!(diagnosis.is_clean(), "{diagnosis}");
        assert_eq!((diagnosis.triangles, diagnosis.corners, diagnosis.rims), (12, 8, 0));
        assert_eq!(diagnosis.to_string(), "12 triangles, 8 corners; closed, all normals on one side");
    }

    #[test]
    fn corners_that_differ_by_rounding_are_one() {
        let shaken: Vec<[Vector; 3]> = cube()
            .iter()
            .enumerate()
            .map(|(i, triangle)| triangle.map(|corner| corner.map(|x| x + 1e-10 * (i as f64 - 6.0) / 6.0)))
            .collect();
        assert!(diagnose(&shaken).is_clean(), "{}", diagnose(&shaken));
    }

    #[test]
    fn missing_triangles_leave_rims() {
        let mut open = cube();
        open.remove(11);
        let diagnosis = diagnose(&open);
        assert_eq!((diagnosis.open_edges.count, diagnosis.rims), (3, 1));
        open.remove(0);
        let diagnosis = diagnose(&open);
        assert_eq!(diagnosis.open_edges.count, 6);
        assert!(diagnosis.flipped_edges.is_empty() && diagnosis.crowded_edges.is_empty());
        assert!(diagnosis.to_string().starts_with("11 triangles") || diagnosis.to_string().starts_with("10 triangles"));
    }

    #[test]
    fn a_flipped_triangle_has_three_flipped_edges() {
        let mut flipped = cube();
        flipped[5].swap(0, 1);
        let diagnosis = diagnose(&flipped);
        assert_eq!((diagnosis.flipped_edges.count, diagnosis.open_edges.count), (3, 0));
    }

    #[test]
    fn degenerate_and_duplicated_triangles_are_counted_and_nothing_else() {
        let mut more = cube();
        more.push([more[0][1], more[0][2], more[0][0]]);
        more.push([[0.0; 3], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]]);
        more.push([[0.0; 3], [0.0; 3], [0.0, 1.0, 0.0]]);
        more.push([[0.0; 3], [f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let diagnosis = diagnose(&more);
        assert_eq!((diagnosis.duplicated.count, diagnosis.degenerate.count, diagnosis.not_finite.count), (1, 2, 1));
        assert!(
            diagnosis.degenerate.to_string().starts_with("2, the first at (0.5, 0, 0) m"),
            "{}",
            diagnosis.degenerate
        );
    }

    #[test]
    fn three_triangles_on_an_edge_are_a_crowd() {
        let fin = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, -1.0, -1.0]];
        let mut more = cube();
        more.push(fin);
        let diagnosis = diagnose(&more);
        assert_eq!((diagnosis.crowded_edges.count, diagnosis.open_edges.count, diagnosis.rims), (1, 2, 1));
    }

    #[test]
    fn slivers_are_no_lines() {
        assert!(!is_flat(&[[0.0; 3], [1e-6, 0.0, 0.0], [0.5e-6, 1e-12, 0.0]]));
        assert!(is_flat(&[[1e-30; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]));
        assert!(diagnose(&[]).is_clean());
    }
}
