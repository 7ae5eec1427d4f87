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
use crate::polyhedron::touch::{Contact, Search, touch};
use crate::polyhedron::{Turned, TurnedBodies};
use glam::DVec3;
use std::ops::Range;

/// The contacts of a block in which a polyhedron takes part, in the order of the neighbour list and of the features.
#[derive(Clone, Debug, Default)]
pub(super) struct PairFeatures {
    /// All that the block sees, by local index.
    bodies: TurnedBodies,
    search: Search,
    /// Pairs of the block, the pair once more for each of its contacts.
    pairs: Vec<TouchingPair>,
    contacts: Vec<Contact>,
    /// The same under one law.
    of_law: Vec<TouchingPair>,
    rows: Vec<u32>,
}

impl PairFeatures {
    /// Takes the pairs with a polyhedron from those whose spheres touch.
    pub fn take(&mut self, touching: &mut TouchingPairs, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        let Self { bodies, search, pairs, contacts, .. } = self;
        if !input.bodies.faceted() {
            return;
        }
        pairs.clear();
        contacts.clear();
        bodies.clear();
        let own = list.first..list.first + list.own;
        let halo = list.halo.iter().map(|halo| halo.grain as usize);
        let shapes = input.bodies.polyhedra();
        own.chain(halo).for_each(|i| bodies.push(shapes, input.bodies.polyhedron(i)));
        let shape = |local: u32| bodies.at(local as usize, shapes);
        touching.keep(|pair| {
            let locals = [pair.first, list.pairs[pair.pair as usize].second];
            let [first, second] = locals.map(shape);
            // Superellipsoids touch polyhedra as they touch all: once, see [`super::shapes`].
            let round = |local: u32| input.bodies.superellipsoid(list.grain_at[local as usize] as usize).is_some();
            if first.is_none() && second.is_none() || input.bodies.shaped() && locals.into_iter().any(round) {
                return true;
            }
            let [p, q] = locals.map(|local| spheres.at(local));
            let apart = DVec3::new(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
            let [a, b] = [(first, p), (second, q)].map(|(body, at)| body.unwrap_or_else(|| Turned::sphere(at[3])));
            touch([&a, &b], apart, input.laws.reach(), search, contacts);
            pairs.resize(contacts.len(), *pair);
            false
        });
    }

    /// The polyhedron that a grain is which the block sees, as it is turned.
    pub fn polyhedron<'a>(&'a self, input: &ForceInput<'a>, local: u32) -> Option<Turned<'a>> {
        if input.bodies.faceted() { self.bodies.at(local as usize, input.bodies.polyhedra()) } else { None }
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
        batch.shifted = true;
        for (r, contact) in self.rows(range).enumerate() {
            let locals = [batch.first[r], batch.second[r]].map(|local| local as usize);
            let branch = Chunk::vector(&batch.branch, r) + contact.points[1] - contact.points[0];
            // Cores that touch have no distance, but a normal all the same.
            let least = 1e-6 * branch.length().max(contact.points[0].length());
            let along = branch.dot(contact.normal);
            let branch = if along < least { contact.normal * least } else { branch };
            Chunk::set(&mut batch.branch, r, branch);
            let mut relative = Chunk::vector(&batch.relative_velocity, r);
            for (body, (local, sign)) in locals.into_iter().zip([1.0, -1.0]).enumerate() {
                let i = list.grain_at[local] as usize;
                batch.radius[body][r] = self.bodies.rounding(local).unwrap_or(input.grains.radius[i]);
                batch.set_shift(body, r, contact.points[body]);
                relative += sign * input.grains.spin[i].cross(contact.points[body]);
            }
            Chunk::set(&mut batch.relative_velocity, r, relative);
        }
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
