//! Where a superellipsoid touches a rounded polyhedron.
//!
//! Of all directions n the least of h(n) less the distance of the core along n, and then the rounding radius more: one contact, as between two superellipsoids. The core is flat, so n belongs to one of
//! its faces, to the arc between the faces of an edge, or to the cone of a corner; where two of these meet they tell the same, so nothing jumps as a contact wanders over the body. With an ellipsoid the
//! place is always one; a flat place of another superellipsoid on a flat face has many.

use super::Turned;
use crate::superellipsoid::Outline;
use crate::superellipsoid::at_wall::{AtWall, Ring};
use crate::superellipsoid::touch::{Rounding, Touch};
use glam::DVec3;

/// Over the size of the bodies: where features meet both may tell.
const MEET: f64 = 1e-9;

/// The same where one must tell.
const SURE: f64 = 1e-6;

/// Where they touch, the first the superellipsoid; nothing where the gap is `reach` [m] or more. The centre of the polyhedron is `apart` [m] from that of the other.
pub fn touch(round: &Outline, body: &Turned, apart: DVec3, reach: f64) -> Option<Touch> {
    let radius = body.rounding;
    let cut = radius + reach;
    let mut contact = least(round, body, apart, MEET * body.size, cut)?;
    // Where bodies are apart and the nearest is a corner out of reach, the far side of a thin one is what is left, and seems to be deep inside.
    if contact.overlap > 0.0 && !round.holds(contact.foot()) {
        contact = least(round, body, apart, SURE * body.size, f64::INFINITY)?;
    }
    if contact.overlap <= -cut {
        return None;
    }
    let share = (radius / (contact.radius + radius)).powi(2);
    let (force, torque) = (contact.force * share, contact.torque * share);
    Some(Touch {
        normal: contact.normal,
        overlap: contact.overlap + radius,
        points: [contact.point, contact.foot() - apart - contact.normal * radius],
        radii: [contact.radius, radius],
        // What one feels the other feels, too, and together they do not turn.
        rounding: Rounding { force, torques: [torque, apart.cross(force) - torque] },
        looks: 1,
    })
}

/// The least of what features tell of a core; nothing where a face says that the gap is `cut` [m] or more. Corners farther away are not looked at.
fn least(round: &Outline, body: &Turned, apart: DVec3, tolerance: f64, cut: f64) -> Option<AtWall> {
    let from = -apart;
    let mut least: Option<AtWall> = None;
    let mut take = |contact: AtWall| {
        if least.is_none_or(|least| contact.overlap < least.overlap) {
            least = Some(contact);
        }
    };
    for face in 0..body.faces() {
        let contact = round.at_plane(-body.normal(face), body.above(face, from));
        if contact.overlap <= -cut {
            return None;
        }
        if body.is_over(face, from + contact.foot()) {
            take(contact);
        }
    }
    for (edge, [first, second]) in body.shape.edges.iter().zip(&body.shape.sides) {
        let [a, b] = edge.map(|corner| apart + body.corner(corner));
        let [u, other] = [first, second].map(|face| -body.normal(*face));
        let v = (other - u * u.dot(other)).normalize_or_zero();
        let ring = Ring { across: [u, v], axis: u.cross(v), lean: [1.0, 0.0] };
        if let Some(contact) = round.at_edge(a, &ring, [0.0, v.dot(other).atan2(u.dot(other))]) {
            let way = (b - a).normalize_or_zero();
            let along = way.dot(contact.foot() - a);
            if along >= -tolerance && along <= way.dot(b - a) + tolerance {
                take(contact);
            }
        }
    }
    for (corner, point) in body.corners() {
        if let Some(contact) = round.at_point(apart + point, cut) {
            let sides = body.shape.edges.iter().filter_map(|[a, b]| {
                let other = if *a == corner { *b } else { *a };
                (*a == corner || *b == corner).then(|| body.corner(other) - point)
            });
            if sides.map(|side| -side.dot(contact.normal)).all(|ahead| ahead <= tolerance) {
                take(contact);
            }
        }
    }
    least
}

/// The same the other way round: the first is the polyhedron.
pub fn touched(body: &Turned, round: &Outline, apart: DVec3, reach: f64) -> Option<Touch> {
    let found = touch(round, body, -apart, reach)?;
    let Touch { normal, points: [p, q], radii: [r, s], rounding: Rounding { force, torques: [t, u] }, .. } = found;
    Some(Touch {
        normal: -normal,
        points: [q, p],
        radii: [s, r],
        rounding: Rounding { force: -force, torques: [u, t] },
        ..found
    })
}
