//! Who touches whom, without forces.
//!
//! A watch that waits for the first and the last moment of a contact looks at every step. The list of contacts with their
//! forces needs every law and a copy of what contacts remember; the places need neither.

use super::sieve::{Hits, Spheres};
use super::touch::Scene;
use crate::view::Contact;
use glam::DVec3;

/// All pairs that overlap, of grains and of grains with walls, in the order of the list of contacts.
pub(super) fn touches(scene: &Scene) -> Vec<Contact> {
    let (mut spheres, mut hits) = (Spheres::default(), Hits::default());
    let mut touching = Vec::new();
    let mut elements = Vec::new();
    let mut contacts = Vec::new();
    let g = scene.grains;
    for list in &scene.candidates.lists {
        spheres.place(g, list, &scene.candidates.shifts);
        hits.sieve(list, &spheres, 0.0);
        for hit in hits.under(0) {
            let place = list.pairs[hit.candidate as usize].place;
            let ([ax, ay, az, a], [bx, by, bz, b]) = (spheres.at(hit.own), spheres.at(place));
            let between = DVec3::new(bx - ax, by - ay, bz - az);
            let overlap = a + b - between.length();
            let normal = between.normalize_or_zero();
            let first = list.first + hit.own as usize;
            contacts.push(Contact {
                first,
                second: list.at[place as usize] as usize,
                wall: false,
                position: g.position[first] + normal * (a - 0.5 * overlap),
                between,
                force: DVec3::ZERO,
                normal,
                overlap,
            });
        }
        for near in list.walls.chunk_by(|a, b| (a.own, a.wall) == (b.own, b.wall)) {
            let first = list.first + near[0].own as usize;
            let (centre, radius) = (g.position[first], g.radius[first]);
            elements.clear();
            elements.extend(near.iter().map(|candidate| candidate.element));
            scene.walls[near[0].wall as usize].touching(&elements, centre, radius, &mut touching);
            contacts.extend(touching.iter().map(|touch| {
                let (normal, overlap) = (-touch.nearest.normal, radius - touch.nearest.distance);
                let between = normal * (radius - 0.5 * overlap);
                Contact {
                    first,
                    second: near[0].wall as usize,
                    wall: true,
                    position: centre + between,
                    between,
                    force: DVec3::ZERO,
                    normal,
                    overlap,
                }
            }));
        }
    }
    contacts
}
