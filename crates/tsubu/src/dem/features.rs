//! Contacts of polyhedra and polygons: of every pair as many as there are features that touch.
//!
//! Neighbour lists and the narrow phase see the sphere that holds a body. Pairs with a polyhedron are taken from what touches there and looked at again; a row of a batch is
//! then a contact of two features, given to the law as that of two spheres of the rounding radii. Scenes without polyhedra pass all of this by.

use super::contact_batch::ContactBatch;
use super::contact_forces::ForceInput;
use super::contact_history::FeatureKey;
use super::narrow_phase::{Spheres, TouchingPair, TouchingPairs};
use crate::contact::chunk::Chunk;
use crate::neighbours::lists::BlockList;
use crate::polyhedron::Turned;
use crate::polyhedron::near::Near;
use crate::polyhedron::touch::{Contact, Search, touch};
use glam::{DMat3, DVec3};
use multiversion::multiversion;
use std::ops::Range;

/// The contacts of a block in which a polyhedron takes part, in the order of the neighbour list and of the features.
#[derive(Clone, Debug, Default)]
pub(super) struct PairFeatures {
    /// What pairs of polyhedra of the block may touch soon; changes places with what the block has kept.
    pub near: Near,
    /// How polyhedra give way that the block sees, by local index.
    gives: Vec<Option<Gives>>,
    /// How far these have gone [m].
    paths: Vec<f64>,
    search: Search,
    /// Pairs of the block, the pair once more for each of its contacts.
    pairs: Vec<TouchingPair>,
    contacts: Vec<Contact>,
    /// The same under one law.
    of_law: Vec<TouchingPair>,
    rows: Vec<u32>,
}

/// What rows ask of a polyhedron, side by side.
#[derive(Clone, Copy, Debug)]
struct Gives {
    /// Rounding radius [m].
    rounding: f64,
    /// Inverse inertia in space [1/(kg.m^2)].
    inverse_inertia: DMat3,
}

impl PairFeatures {
    /// Takes the pairs with a polyhedron from those whose spheres touch.
    pub fn take(&mut self, touching: &mut TouchingPairs, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        let Self { near, gives, paths, search, pairs, contacts, .. } = self;
        if !input.bodies.faceted() {
            return;
        }
        pairs.clear();
        contacts.clear();
        gives.clear();
        paths.clear();
        let mut seen = Vec::with_capacity(list.grain_at.len());
        for grain in &list.grain_at {
            let body = input.bodies.body(*grain as usize);
            let turned = input.bodies.polyhedron(*grain as usize);
            seen.push(turned);
            paths.push(body.map_or(0.0, |body| body.path));
            gives.push(turned.zip(body).map(|(turned, body)| {
                // Without rotation no body gives way by turning.
                let inverse_inertia = if input.laws.rotation { body.inverse_inertia } else { DMat3::ZERO };
                Gives { rounding: turned.rounding, inverse_inertia }
            }));
        }
        let reach = input.laws.reach();
        let shaped = input.bodies.shaped();
        let path =
            |pair: &TouchingPair| paths[pair.first as usize] + paths[list.pairs[pair.pair as usize].second as usize];
        // By itself, for a processor cannot guess who sleeps.
        touching.keep(|pair| !near.is_apart(pair.pair as usize, path(pair)));
        touching.keep(|pair| {
            let (first, second) = (pair.first, list.pairs[pair.pair as usize].second);
            let [a, b] = [first, second].map(|local| &seen[local as usize]);
            if a.is_none() && b.is_none() {
                return true;
            }
            // Superellipsoids touch polyhedra as they touch all: once, see [`super::shapes`].
            let round = |local: u32| input.bodies.superellipsoid(list.grain_at[local as usize] as usize).is_some();
            if shaped && (round(first) || round(second)) {
                return true;
            }
            let (p, q) = (spheres.at(first), spheres.at(second));
            let apart = DVec3::new(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
            if let (Some(a), Some(b)) = (a, b) {
                near.touch(pair.pair as usize, path(pair), ([a, b], apart, reach), search, contacts);
            } else {
                let a = a.unwrap_or_else(|| Turned::sphere(p[3]));
                let b = b.unwrap_or_else(|| Turned::sphere(q[3]));
                touch([&a, &b], apart, reach, search, contacts);
            }
            pairs.resize(contacts.len(), *pair);
            false
        });
    }

    /// All contacts with their pairs.
    pub fn contacts(&self) -> impl Iterator<Item = (&TouchingPair, &Contact)> {
        self.pairs.iter().zip(&self.contacts)
    }

    /// Looks for those under a law. Returns how many they are.
    pub fn under(&mut self, law: usize, input: &ForceInput, list: &BlockList) -> usize {
        let Self { pairs, contacts, of_law, rows, .. } = self;
        of_law.clear();
        rows.clear();
        let several = input.laws.reaches.len() > 1;
        let material = |local: u32| input.grains.material[list.grain_at[local as usize] as usize];
        for ((row, pair), contact) in (0..).zip(&*pairs).zip(&*contacts) {
            if several {
                let second = list.pairs[pair.pair as usize].second;
                let number = input.laws.table.law(input.laws.table.index(material(pair.first), material(second)));
                if number != law || contact.overlap <= -input.laws.reaches[law] {
                    continue;
                }
            }
            of_law.push(*pair);
            rows.push(row);
        }
        rows.len()
    }

    /// Pairs of some of the rows under the law.
    pub fn pairs(&self, range: Range<usize>) -> &[TouchingPair] {
        &self.of_law[range]
    }

    fn rows(&self, range: Range<usize>) -> impl Iterator<Item = &Contact> {
        self.rows[range].iter().map(|row| &self.contacts[*row as usize])
    }

    /// What their histories go by.
    pub fn keys(&self, range: Range<usize>) -> impl Iterator<Item = FeatureKey> {
        let pairs = self.of_law[range.clone()].iter();
        pairs.zip(self.rows(range)).map(|(pair, row)| FeatureKey { pair: pair.pair, feature: row.feature })
    }

    /// Puts the spheres that stand for features into the rows of a batch.
    pub fn gather(&self, batch: &mut ContactBatch, range: Range<usize>, input: &ForceInput, list: &BlockList) {
        let rotation = input.laws.rotation;
        batch.shifted = true;
        for (r, contact) in self.rows(range).enumerate() {
            let branch = Chunk::vector(&batch.branch, r) + contact.points[1] - contact.points[0];
            // Cores that touch have no distance, but a normal all the same.
            let least = 1e-6 * branch.length().max(contact.points[0].length());
            let along = branch.dot(contact.normal);
            let branch = if along < least { contact.normal * least } else { branch };
            Chunk::set(&mut batch.branch, r, branch);
            for (body, local) in [batch.first[r], batch.second[r]].into_iter().enumerate() {
                if let Some(gives) = &self.gives[local as usize] {
                    batch.radius[body][r] = gives.rounding;
                }
                batch.set_shift(body, r, contact.points[body]);
            }
            let spin = |body: usize, local: u32| {
                if rotation {
                    Chunk::vector(&batch.spin[body], r)
                } else {
                    input.grains.spin[list.grain_at[local as usize] as usize]
                }
            };
            let [first, second] = [spin(0, batch.first[r]), spin(1, batch.second[r])];
            let relative = Chunk::vector(&batch.relative_velocity, r) + first.cross(contact.points[0]);
            Chunk::set(&mut batch.relative_velocity, r, relative - second.cross(contact.points[1]));
        }
    }

    /// Gives the rows the mass that their bodies show there, see [`super::bodies::Bodies::show_mass`].
    pub fn show_mass(&self, batch: &mut ContactBatch, input: &ForceInput, list: &BlockList) {
        show_mass(batch, &self.gives, &|local, shift, normal| {
            input.bodies.turning(list.grain_at[local as usize] as usize, shift, normal)
        });
    }

    /// After the geometry of spheres: edges that lie back overlap by less, and nearer points close them less fast.
    pub fn lie_back(&self, batch: &mut ContactBatch, range: Range<usize>) {
        for (r, contact) in self.rows(range).enumerate() {
            batch.chunk.overlap[r] = contact.overlap;
            batch.chunk.closing[r] *= contact.share;
        }
    }

    /// After the law: the normal force that belongs to such an overlap.
    pub fn push_less(&self, batch: &mut ContactBatch, range: Range<usize>) {
        for (r, contact) in self.rows(range).enumerate().filter(|(_, contact)| contact.share < 1.0) {
            let lacks = Chunk::vector(&batch.chunk.normal, r) * (1.0 - contact.share);
            let force = Chunk::vector(&batch.force, r) + lacks * batch.chunk.normal_force[r];
            let dissipative = Chunk::vector(&batch.dissipative, r) + lacks * batch.chunk.damping_force[r];
            Chunk::set(&mut batch.force, r, force);
            Chunk::set(&mut batch.dissipative, r, dissipative);
        }
    }
}

/// `turning` tells how much those give way that are no polyhedra.
#[multiversion(targets = "simd")]
fn show_mass(batch: &mut ContactBatch, gives: &[Option<Gives>], turning: &dyn Fn(u32, DVec3, DVec3) -> f64) {
    for r in 0..batch.chunk.rows() {
        let normal = Chunk::vector(&batch.chunk.normal, r);
        let mut more = 0.0;
        for (body, local) in [batch.first[r], batch.second[r]].into_iter().enumerate() {
            let shift = batch.shift(body, r);
            more += match &gives[local as usize] {
                Some(gives) => {
                    let lever = shift.cross(normal);
                    lever.dot(gives.inverse_inertia * lever)
                }
                None => turning(local, shift, normal),
            };
        }
        if more > 0.0 {
            batch.chunk.effective_mass[r] = 1.0 / (1.0 / batch.chunk.effective_mass[r] + more);
        }
    }
}
