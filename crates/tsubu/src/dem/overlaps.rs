//! Overlaps: who touches whom, without forces.
//!
//! A watch that waits for the first and the last moment of a contact looks at every step. The list of contacts with their
//! forces needs every law and a copy of what contacts remember; the places need neither.

use super::contact_forces::ForceInput;
use super::features::PairFeatures;
use super::narrow_phase::{Spheres, TouchingPairs};
use super::shapes::PairShapes;
use super::wall_shapes::WallShapes;
use crate::view::Contact;
use glam::DVec3;

/// All pairs that overlap, of grains and of grains with walls, in the order of the list of contacts.
pub(super) fn overlaps(input: &ForceInput) -> Vec<Contact> {
    let (mut spheres, mut pairs) = (Spheres::default(), TouchingPairs::default());
    let (mut shapes, mut wall_shapes) = (PairShapes::default(), WallShapes::default());
    let mut features = PairFeatures::default();
    let mut elements = Vec::new();
    let mut contacts = Vec::new();
    let g = input.grains;
    for list in &input.neighbours.lists[input.neighbours.own()] {
        spheres.load(g, list, &input.neighbours.shifts);
        pairs.find(list, &spheres, 0.0);
        features.near.forget(list.pairs.len());
        features.take(&mut pairs, input, list, &spheres);
        shapes.find(&mut pairs, input, list, &spheres);
        for touching in pairs.under(0) {
            let second = list.pairs[touching.pair as usize].second;
            let ([ax, ay, az, a], [bx, by, bz, b]) = (spheres.at(touching.first), spheres.at(second));
            let branch = DVec3::new(bx - ax, by - ay, bz - az);
            let (mut overlap, mut normal) = (a + b - branch.length(), branch.normalize_or_zero());
            let first = list.first + touching.first as usize;
            let mut arm = normal * (a - 0.5 * overlap);
            if let Some(touch) = shapes.of(touching.pair) {
                (overlap, normal) = (touch.overlap, touch.normal);
                arm = touch.points[0] - normal * (0.5 * overlap);
            }
            contacts.push(Contact {
                first,
                second: list.grain_at[second as usize] as usize,
                wall: false,
                position: g.position[first] + arm,
                branch,
                force: DVec3::ZERO,
                normal,
                overlap,
            });
        }
        for (touching, contact) in features.contacts() {
            let second = list.pairs[touching.pair as usize].second;
            let ([ax, ay, az, a], [bx, by, bz, _]) = (spheres.at(touching.first), spheres.at(second));
            let first = list.first + touching.first as usize;
            let radius = input.bodies.rounding(first).unwrap_or(a);
            contacts.push(Contact {
                first,
                second: list.grain_at[second as usize] as usize,
                wall: false,
                position: g.position[first] + contact.points[0] + contact.normal * (radius - 0.5 * contact.overlap),
                branch: DVec3::new(bx - ax, by - ay, bz - az),
                force: DVec3::ZERO,
                normal: contact.normal,
                overlap: contact.overlap,
            });
        }
        for near in list.walls.chunk_by(|a, b| (a.own, a.wall) == (b.own, b.wall)) {
            let first = list.first + near[0].own as usize;
            let centre = g.position[first];
            elements.clear();
            elements.extend(near.iter().map(|near| near.element));
            wall_shapes.find(input, list, (near[0].own, near[0].wall), &elements, 0.0);
            contacts.extend(wall_shapes.found.iter().map(|shape| {
                let branch = shape.shift + shape.normal * (shape.radius - 0.5 * shape.overlap);
                Contact {
                    first,
                    second: near[0].wall as usize,
                    wall: true,
                    position: centre + branch,
                    branch,
                    force: DVec3::ZERO,
                    normal: shape.normal,
                    overlap: shape.overlap,
                }
            }));
        }
    }
    contacts
}
