//! What is wrong with a mesh, or at least worth knowing: triangles without area, holes, flipped neighbours.

mod diagnosis;
mod rims;
mod weld;

pub use diagnosis::{Diagnosis, Found};

use crate::plan::Vector;
use rims::Rims;
use std::collections::{HashMap, HashSet};
use weld::weld;

/// Twice the area over the square of the longest edge below which a triangle is a line: what single precision leaves of
/// corners that were meant to be on one.
const FLAT: f64 = 1e-10;
/// Size of a rim over the size of the mesh below which it is rather a hole than an opening.
const SMALL: f64 = 0.02;

/// Looks at everything. An open mesh is no mistake: hoppers are open.
pub fn diagnose(triangles: &[[Vector; 3]]) -> Diagnosis {
    let mut diagnosis = broken(triangles);
    let ends = ends(triangles);
    diagnosis.extent = length(ends);
    let (corner_of, corners) = weld(triangles, largest(diagnosis.extent));
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
                order.push((key, [triangle[i], triangle[j]]));
                [0, 0]
            });
            ways[usize::from(from > to)] += 1;
        }
    }
    let mut rim = Rims::new(corners);
    for (key, edge) in order {
        match edges[&key] {
            [1, 0] | [0, 1] => {
                diagnosis.open_edges.add(middle(&edge));
                rim.join(key, edge);
            }
            [1, 1] => {}
            [2, 0] | [0, 2] => diagnosis.flipped_edges.add(middle(&edge)),
            _ => diagnosis.crowded_edges.add(middle(&edge)),
        }
    }
    let rims = rim.all();
    diagnosis.rims = rims.len();
    let small = SMALL * largest(diagnosis.extent);
    let openings = || rims.iter().filter(|rim| rim.closed && rim.edges > 3 && rim.size >= small);
    diagnosis.openings = openings().count();
    diagnosis.narrowest = openings().map(|rim| rim.width).reduce(f64::min);
    diagnosis
}

/// The triangles with corners that differ by rounding put to one place.
pub(crate) fn welded(triangles: &[[Vector; 3]]) -> Vec<[Vector; 3]> {
    let (corner_of, corners) = weld(triangles, largest(length(ends(triangles))));
    let mut places = vec![None; corners];
    let mut place = |corner: Vector, number: usize| *places[number].get_or_insert(corner);
    let triangles = triangles.iter().zip(corner_of);
    triangles.filter_map(|(t, numbers)| numbers.map(|n| [0, 1, 2].map(|i| place(t[i], n[i])))).collect()
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

/// Smallest and largest coordinates of the corners of triangles [m], of all that are finite.
pub fn ends(triangles: &[[Vector; 3]]) -> [Vector; 2] {
    let finite = triangles.iter().flatten().filter(|corner| corner.iter().all(|x| x.is_finite()));
    finite.fold(NO_ENDS, |ends, corner| wider(ends, *corner))
}

const NO_ENDS: [Vector; 2] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

fn wider([low, high]: [Vector; 2], point: Vector) -> [Vector; 2] {
    [[0, 1, 2].map(|i| f64::min(low[i], point[i])), [0, 1, 2].map(|i| f64::max(high[i], point[i]))]
}

/// Lengths between ends; zero where there is nothing between.
fn length([low, high]: [Vector; 2]) -> Vector {
    [0, 1, 2].map(|i| f64::max(high[i] - low[i], 0.0))
}

fn largest(extent: Vector) -> f64 {
    extent.into_iter().fold(0.0, f64::max)
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

    /// A coordinate at the middle of a cell of the search was looked for in the two cells beside it and not in its own, so
    /// that this terrain, heights in micrometres, had 33 corners twice and holes where there are none.
    #[test]
    fn a_terrain_has_one_rim_wherever_its_corners_are() {
        let (columns, rows) = (81_usize, 33_usize);
        let corner = |i: usize, j: usize| {
            let [x, y] = [i, j].map(|n| n as f64);
            [x, y, ((0.3 * x).sin() * (0.2 * y).cos() * 1e6).round() / 1e6]
        };
        let squares = (0..columns - 1).flat_map(|i| (0..rows - 1).map(move |j| (i, j)));
        let terrain: Vec<[Vector; 3]> = squares
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let diagnosis = diagnose(&terrain);
        assert_eq!((diagnosis.corners, diagnosis.open_edges.count, diagnosis.rims), (2673, 224, 1), "{diagnosis}");
        assert_eq!((diagnosis.openings, diagnosis.extent[0], diagnosis.extent[1]), (1, 80.0, 32.0));
    }

    /// An open hopper was warned of like a mesh with holes.
    #[test]
    fn openings_are_told_from_holes() {
        let tube = |sides: usize| -> Vec<[Vector; 3]> {
            let at = |k: usize, z: f64| {
                let (sin, cos) = (k as f64 / sides as f64 * std::f64::consts::TAU).sin_cos();
                [(0.1 + z) * cos, (0.1 + z) * sin, z]
            };
            let side = |k: usize| {
                let [a, b] = [k, (k + 1) % sides];
                [[at(a, 0.0), at(b, 0.0), at(b, 1.0)], [at(a, 0.0), at(b, 1.0), at(a, 1.0)]]
            };
            (0..sides).flat_map(side).collect()
        };
        let mut hopper = tube(24);
        let diagnosis = diagnose(&hopper);
        assert_eq!((diagnosis.rims, diagnosis.openings), (2, 2), "{diagnosis}");
        assert!(diagnosis.narrowest.is_some_and(|width| (width - 0.2).abs() < 1e-12), "{diagnosis:?}");
        // One triangle that is missing is a hole, a whole side is an opening.
        let mut more = cube();
        more.remove(11);
        assert_eq!((diagnose(&more).rims, diagnose(&more).openings), (1, 0));
        more = cube().split_off(2);
        assert_eq!((diagnose(&more).rims, diagnose(&more).openings), (1, 1));
        // A triangle that is missing between the two openings lets them meet in a corner: no closed line any more.
        hopper.remove(0);
        assert_eq!((diagnose(&hopper).rims, diagnose(&hopper).openings), (1, 0));
    }
}
