//! Volume, centre of mass and moments of inertia of a convex body with rounded edges, exactly.
//!
//! The body is its core, a prism on every face, a sector of a cylinder along every edge and a sector of a ball at every corner. The integrals of 1, x and x x' over each are known: over tetrahedra
//! (Mirtich 1996), over sectors of a cylinder by hand, and over sectors of a ball by the theorem of Stokes on the sphere, as sums over the arcs that bound them (Arvo 1995):
//!
//! ```text
//! integral of u      1/2 sum of a m                     a: angle of an arc, m: unit normal of its plane, inwards
//! integral of u u'   1/3 (W + sum of ((v - u) x m) m')  u, v: its ends, W: the solid angle
//! ```

use super::{Core, Point, across, round};
use crate::clump::Integrals;
use nalgebra::Matrix3;

/// The integrals over all that is nearer to a core than `rounding`. In the plane over its area.
pub(crate) fn measured(core: &Core, rounding: f64, space: bool) -> Integrals {
    // From a point within, or digits are lost.
    let origin = core.corners.iter().sum::<Point>() / core.corners.len() as f64;
    let about = core.clone().about(&origin);
    let sum = if space { solid(&about, rounding) } else { area(&about, rounding) };
    let shift = origin * sum.first.transpose();
    Integrals {
        volume: sum.volume,
        first: sum.first + origin * sum.volume,
        second: sum.second + shift + shift.transpose() + origin * origin.transpose() * sum.volume,
    }
}

fn solid(core: &Core, r: f64) -> Integrals {
    let mut sum = Integrals::default();
    for face in &core.faces {
        let at = |i: usize| core.corners[face.corners[i]];
        let out = face.plane.normal * r;
        for k in 1..face.corners.len() - 1 {
            let [a, b, c] = [at(0), at(k), at(k + 1)];
            sum.add(&tetrahedron([Point::zeros(), a, b, c]));
            let [d, e, f] = [a + out, b + out, c + out];
            for four in [[a, b, c, d], [b, c, d, e], [c, d, e, f]] {
                sum.add(&tetrahedron(four));
            }
        }
    }
    for ([a, b], normals) in core.edges() {
        sum.add(&along_edge([core.corners[a], core.corners[b]], normals, r));
    }
    for (i, corner) in core.corners.iter().enumerate() {
        let normals: Vec<Point> =
            core.faces.iter().filter(|face| face.corners.contains(&i)).map(|face| face.plane.normal).collect();
        sum.add(&at_corner(corner, &normals, r));
    }
    sum
}

/// The same in the plane: of a slice of thickness 1 about y = 0, without what thickness adds.
fn area(core: &Core, r: f64) -> Integrals {
    let mut sum = Integrals::default();
    let mut ends = vec![Vec::new(); core.corners.len()];
    for face in &core.faces {
        let [a, b] = [0, 1].map(|k| core.corners[face.corners[k]]);
        let out = face.plane.normal * r;
        for three in [[Point::zeros(), a, b], [a, b, a + out], [b, a + out, b + out]] {
            sum.add(&triangle(three));
        }
        face.corners.iter().for_each(|corner| ends[*corner].push(face.plane.normal));
    }
    for (corner, normals) in core.corners.iter().zip(ends) {
        let [Some(u), Some(v)] = [normals.first(), normals.get(1)] else { continue };
        sum.add(&sector(corner, [*u, *v], r));
    }
    sum
}

fn tetrahedron(corners: [Point; 4]) -> Integrals {
    let [a, b, c, d] = corners;
    let volume = (b - a).dot(&(c - a).cross(&(d - a))).abs() / 6.0;
    let total: Point = corners.iter().sum();
    let squares: Matrix3<f64> = corners.iter().chain([&total]).map(|v| v * v.transpose()).sum();
    Integrals { volume, first: total * (volume / 4.0), second: squares * (volume / 20.0) }
}

fn triangle(corners: [Point; 3]) -> Integrals {
    let [a, b, c] = corners;
    let area = 0.5 * (b - a).cross(&(c - a)).norm();
    let total: Point = corners.iter().sum();
    let squares: Matrix3<f64> = corners.iter().chain([&total]).map(|v| v * v.transpose()).sum();
    Integrals { volume: area, first: total * (area / 3.0), second: squares * (area / 12.0) }
}

/// A sector of a disc at a corner, from one direction to another.
fn sector(corner: &Point, [u, v]: [Point; 2], r: f64) -> Integrals {
    let angle = u.cross(&v).norm().atan2(u.dot(&v));
    let middle = (u + v).normalize();
    let beside = across(&middle);
    let area = 0.5 * r * r * angle;
    let arm = middle * (4.0 / 3.0 * r * (0.5 * angle).sin() / angle);
    let fourth = r.powi(4) / 8.0;
    let own = middle * middle.transpose() * (fourth * (angle + angle.sin()))
        + beside * beside.transpose() * (fourth * (angle - angle.sin()));
    let mixed = corner * arm.transpose();
    Integrals {
        volume: area,
        first: (corner + arm) * area,
        second: (corner * corner.transpose() + mixed + mixed.transpose()) * area + own,
    }
}

/// A sector of a cylinder along an edge.
fn along_edge([a, b]: [Point; 2], [u, v]: [Point; 2], r: f64) -> Integrals {
    let (centre, edge) = ((a + b) * 0.5, b - a);
    let length = edge.norm();
    let angle = u.cross(&v).norm().atan2(u.dot(&v));
    let middle = (u + v).normalize();
    let beside = middle.cross(&(edge / length));
    let volume = 0.5 * r * r * angle * length;
    let arm = middle * (4.0 / 3.0 * r * (0.5 * angle).sin() / angle);
    let fourth = length * r.powi(4) / 8.0;
    let own = middle * middle.transpose() * (fourth * (angle + angle.sin()))
        + beside * beside.transpose() * (fourth * (angle - angle.sin()))
        + edge * edge.transpose() * (volume / 12.0);
    let mixed = centre * arm.transpose();
    Integrals {
        volume,
        first: (centre + arm) * volume,
        second: (centre * centre.transpose() + mixed + mixed.transpose()) * volume + own,
    }
}

/// A sector of a ball at a corner, between the normals of the faces that meet there.
fn at_corner(corner: &Point, normals: &[Point], r: f64) -> Integrals {
    let axis = normals.iter().sum::<Point>().normalize();
    let mut order: Vec<usize> = (0..normals.len()).collect();
    round(&mut order, &axis, |i| normals[i]);
    let (mut angle, mut first, mut second) = (0.0, Point::zeros(), Matrix3::zeros());
    for (k, i) in order.iter().enumerate() {
        let (u, v) = (normals[*i], normals[order[(k + 1) % order.len()]]);
        let turn = u.cross(&v);
        let m = turn.normalize();
        first += m * (0.5 * turn.norm().atan2(u.dot(&v)));
        second += (v - u).cross(&m) * m.transpose();
        // Of the triangle with the axis (Van Oosterom and Strackee 1983).
        angle += 2.0 * axis.dot(&turn).atan2(1.0 + axis.dot(&u) + u.dot(&v) + v.dot(&axis));
    }
    let second = (Matrix3::identity() * angle + second) / 3.0;
    let (volume, arm, own) = (angle * r.powi(3) / 3.0, first * (r.powi(4) / 4.0), second * (r.powi(5) / 5.0));
    let mixed = corner * arm.transpose();
    Integrals {
        volume,
        first: corner * volume + arm,
        second: corner * corner.transpose() * volume + mixed + mixed.transpose() + own,
    }
}
