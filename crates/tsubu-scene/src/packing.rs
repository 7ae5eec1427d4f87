//! Spheres in a closed mesh, for a clump that stands for it.
//!
//! Every sphere lies within the mesh. Candidates are the largest ones that touch it at given points of its surface (Ferellec and McDowell 2010),
//! found by shrinking balls (Ma, Bae and Choi 2012); of these that one comes next which covers most of what is not covered yet (the
//! greedy choice of Li, Xu and Meng 2015), after it was moved to where it covers still more. The first n of a packing are the packing of n, so what is
//! not covered falls with every sphere.

mod cells;
mod convex;
mod polyhedron;
mod tree;

pub(crate) use convex::faces;

use crate::complaint::Complaint;
use crate::mesh_check;
use crate::plan::{Packing, Vector};
use cells::Cells;
use nalgebra::Vector3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use tree::Tree;

/// Points of the surface that candidates touch.
const SAMPLES: usize = 6000;
/// Rounds of a shrinking ball; a few are enough.
const ROUNDS: usize = 40;
/// How often a sphere's place is looked for at half of the step; the first is the width of a cell.
const HALVINGS: usize = 10;

/// A sphere, centre and radius.
type Ball = (Vector3<f64>, f64);

/// Packs at most so many spheres into the body that the triangles enclose. The complaint has yet to be placed.
pub(crate) fn pack(triangles: &[[Vector; 3]], most: usize) -> Result<Packing, Complaint> {
    let found = mesh_check::diagnose(triangles);
    polyhedron::closed(&found)?;
    let triangles: Vec<[Vector3<f64>; 3]> =
        mesh_check::welded(triangles).into_iter().map(|triangle| triangle.map(Vector3::from)).collect();
    let (solid, surface) = polyhedron::measured(&triangles)?;
    let mut cells = Cells::fill(&triangles, solid.volume)?;
    let centre = Vector3::from(solid.centre);
    let reach = triangles.iter().flatten().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
    let samples = samples(&triangles, surface);
    let tree = Tree::new(triangles);
    let candidates: Vec<Ball> = samples.iter().map(|(point, inward)| largest(&tree, *point, *inward)).collect();
    let spheres = cover(&mut cells, &tree, &candidates, most);
    if spheres.is_empty() {
        return Err(Complaint::new("the mesh is too thin: no sphere is found in it")
            .hint("a clump needs a body with some thickness"));
    }
    let gaps = samples.iter().map(|(point, _)| {
        spheres.iter().map(|(centre, radius)| (point - centre).norm() - radius).fold(f64::INFINITY, f64::min).max(0.0)
    });
    let (sum, widest) = gaps.fold((0.0, 0.0_f64), |(sum, widest), gap| (sum + gap, widest.max(gap)));
    Ok(Packing {
        spheres: spheres.into_iter().map(|(centre, radius)| (centre.into(), radius)).collect(),
        solid,
        surface,
        reach,
        triangles: found.triangles,
        gap: [sum / samples.len() as f64 / (2.0 * reach), widest / (2.0 * reach)],
    })
}

/// Points spread evenly over the surface, each with the direction inwards there.
fn samples(triangles: &[[Vector3<f64>; 3]], surface: f64) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let mut samples = Vec::with_capacity(SAMPLES);
    let mut passed = 0.0;
    for [a, b, c] in triangles {
        let normal = (b - a).cross(&(c - a));
        passed += 0.5 * normal.norm();
        while ((samples.len() as f64 + 0.5) / SAMPLES as f64) * surface < passed && samples.len() < SAMPLES {
            // Roberts's sequence in the plane, folded into the triangle.
            let k = samples.len() as f64;
            let [u, v] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3].map(|step: f64| (0.5 + k * step).fract());
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            samples.push((a + (b - a) * u + (c - a) * v, -normal.normalize()));
        }
    }
    samples
}

/// The largest sphere within the body that touches it at a point of its surface.
fn largest(tree: &Tree, point: Vector3<f64>, inward: Vector3<f64>) -> Ball {
    let mut radius = tree.extent();
    for _ in 0..ROUNDS {
        let centre = point + inward * radius;
        let (nearest, distance) = tree.nearest(centre);
        if distance >= radius * (1.0 - 1e-9) {
            return (centre, distance.min(radius));
        }
        // Through both points, tangent at the first.
        let across = nearest - point;
        radius = across.norm_squared() / (2.0 * inward.dot(&across));
    }
    (point, 0.0)
}

/// Spheres one after the other, each where it covers most. What a candidate covers can only fall, so that its last number is enough to pass it over.
fn cover(cells: &mut Cells, tree: &Tree, candidates: &[Ball], most: usize) -> Vec<Ball> {
    let mut queue: BinaryHeap<(usize, Reverse<usize>)> =
        candidates.iter().enumerate().map(|(i, ball)| (cells.covers(ball), Reverse(i))).collect();
    let mut spheres = Vec::new();
    while spheres.len() < most
        && let Some((_, Reverse(i))) = queue.pop()
    {
        let now = (cells.covers(&candidates[i]), Reverse(i));
        if queue.peek().is_some_and(|next| now < *next) {
            queue.push(now);
            continue;
        }
        if now.0 == 0 {
            break;
        }
        let ball = moved(cells, tree, candidates[i]);
        cells.cover(&ball);
        spheres.push(ball);
    }
    spheres
}

/// Moves a sphere step by step to where it covers more; of equal places the one with more room is better.
fn moved(cells: &Cells, tree: &Tree, ball: Ball) -> Ball {
    let (mut best, mut worth, mut step) = (ball, (cells.covers(&ball), ball.1), cells.width());
    for _ in 0..HALVINGS {
        let mut better = true;
        while better {
            better = false;
            // To all neighbours of a cell: a sphere between two faces moves along both.
            for way in 0..27 {
                let centre = best.0 + Vector3::new(way / 9, way / 3 % 3, way % 3).map(|k| f64::from(k - 1) * step);
                // A sphere whose centre stays within its last one stays within the body.
                if step >= best.1 {
                    continue;
                }
                let next = (centre, tree.nearest(centre).1);
                let value = (cells.covers(&next), next.1);
                if value > worth {
                    (best, worth, better) = (next, value, true);
                }
            }
        }
        step *= 0.5;
    }
    best
}
