//! Contacts of polyhedra and polygons: of every pair as many as there are features that touch.
//!
//! Neighbour lists and the narrow phase see the sphere that holds a body. Pairs with a polyhedron are taken from what touches there and looked at again; a row of a batch is
//! then a contact of two features, given to the law as that of two spheres of the rounding radii. Scenes without polyhedra pass all of this by.

use super::contact_batch::ContactBatch;
use super::contact_forces::ForceInput;
use super::contact_history::FeatureKey;
use super::narrow_phase::{Spheres, TouchingPair, TouchingPairs};
use crate::contact::chunk::Chunk;
use crate::neighbours::block::BlockList;
use crate::polyhedron::Turned;
use crate::polyhedron::awake::{Awake, Couple};
use crate::polyhedron::contact::Contact;
use crate::polyhedron::near::Near;
use crate::polyhedron::touch::{Search, touch};
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
    awake: Awake,
    search: Search,
    /// Pairs of the block, the pair once more for each of its contacts.
    pairs: Vec<TouchingPair>,
    contacts: Vec<Contact>,
    /// The same under one law.
    of_law: Vec<TouchingPair>,
    rows: Vec<u32>,
    /// Of each row of the batch, see [`Contact`].
    overlap: Vec<f64>,
    share: Vec<f64>,
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
        let Self { near, gives, paths, awake, search, pairs, contacts, .. } = self;
        if !input.bodies.faceted() {
            return;
        }
        pairs.clear();
        contacts.clear();
        gives.clear();
        paths.clear();
        // One after the other: so many bodies are on their way from memory at once, and none waits for another.
        let body = |grain: &u32| input.bodies.body(*grain as usize);
        paths.extend(list.grain_at.iter().map(|grain| body(grain).map_or(0.0, |body| body.path)));
        let turned = |(local, grain): (u32, &u32)| {
            input.bodies.polyhedron(*grain as usize).unwrap_or_else(|| Turned::sphere(spheres.at(local)[3]))
        };
        let seen: Vec<Turned> = (0..).zip(&list.grain_at).map(turned).collect();
        gives.extend(list.grain_at.iter().map(|grain| {
            let body = body(grain)?;
            // Without rotation no body gives way by turning.
            let inverse_inertia = if input.laws.rotation { body.inverse_inertia } else { DMat3::ZERO };
            Some(Gives { rounding: body.polyhedron.as_ref()?.rounding(), inverse_inertia })
        }));
        let reach = input.laws.reach();
        let shaped = input.bodies.shaped();
        let path =
            |pair: &TouchingPair| paths[pair.first as usize] + paths[list.pairs[pair.pair as usize].second as usize];
        let mut tell = |couple: &Couple| pairs.push(TouchingPair { first: couple.bodies[0], pair: couple.pair });
        // By itself, for a processor cannot guess who sleeps.
        touching.keep(|pair| !near.is_apart(pair.pair as usize, path(pair)));
        touching.keep(|pair| {
            let bodies = [pair.first, list.pairs[pair.pair as usize].second];
            let [a, b] = bodies.map(|local| &seen[local as usize]);
            if !a.is_faceted() && !b.is_faceted() {
                return true;
            }
            // Superellipsoids touch polyhedra as they touch all: once, see [`super::shapes`].
            let round = |local: u32| input.bodies.superellipsoid(list.grain_at[local as usize] as usize).is_some();
            if shaped && bodies.into_iter().any(round) {
                return true;
            }
            let [p, q] = bodies.map(|local| spheres.at(local));
            let apart = DVec3::new(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
            let couple = Couple { pair: pair.pair, bodies, apart, path: path(pair) };
            if a.is_faceted() && b.is_faceted() {
                near.wake(couple, [a, b], reach, search, awake);
                if awake.is_full() {
                    awake.touch(near, (&seen, reach), contacts, &mut tell);
                }
            } else {
                // Those before come first.
                awake.touch(near, (&seen, reach), contacts, &mut tell);
                let before = contacts.len();
                touch([a, b], apart, reach, search, contacts);
                (before..contacts.len()).for_each(|_| tell(&couple));
            }
            false
        });
        awake.touch(near, (&seen, reach), contacts, tell);
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

    fn rows(&self, range: Range<usize>) -> impl ExactSizeIterator<Item = &Contact> + Clone {
        self.rows[range].iter().map(|row| &self.contacts[*row as usize])
    }

    /// What their histories go by.
    pub fn keys(&self, range: Range<usize>) -> impl ExactSizeIterator<Item = FeatureKey> + Clone {
        let pairs = self.of_law[range.clone()].iter();
        pairs.zip(self.rows(range)).map(|(pair, row)| FeatureKey { pair: pair.pair, feature: row.feature })
    }

    /// Puts the spheres that stand for features into the rows of a batch.
    pub fn gather(&mut self, batch: &mut ContactBatch, range: Range<usize>, input: &ForceInput, list: &BlockList) {
        let rotation = input.laws.rotation;
        batch.shifted = true;
        self.overlap.clear();
        self.share.clear();
        for (r, row) in self.rows[range].iter().enumerate() {
            let contact = &self.contacts[*row as usize];
            self.overlap.push(contact.overlap);
            self.share.push(contact.share);
            let branch = Chunk::vector(&batch.branch, r) + contact.points[1] - contact.points[0];
            let along = branch.dot(contact.normal);
            // Cores that touch have no distance, but a normal all the same. Few are near enough to ask for roots.
            let near = 1e-11 * branch.length_squared().max(contact.points[0].length_squared());
            let least = if along > 0.0 && along * along > near {
                0.0
            } else {
                1e-6 * branch.length().max(contact.points[0].length())
            };
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
    pub fn lie_back(&self, batch: &mut ContactBatch) {
        lie_back(batch, &self.overlap, &self.share);
    }

    /// After the law: the normal force that belongs to such an overlap.
    pub fn push_less(&self, batch: &mut ContactBatch) {
        push_less(batch, &self.share);
    }
}

#[multiversion(targets = "simd")]
fn lie_back(batch: &mut ContactBatch, overlap: &[f64], share: &[f64]) {
    for r in 0..batch.chunk.rows().min(overlap.len()).min(share.len()) {
        batch.chunk.overlap[r] = overlap[r];
        batch.chunk.closing[r] *= share[r];
    }
}

#[multiversion(targets = "simd")]
fn push_less(batch: &mut ContactBatch, share: &[f64]) {
    let chunk = &batch.chunk;
    let rows = chunk.rows().min(share.len());
    for k in 0..3 {
        let (normal, force, dissipative) = (&chunk.normal[k], &mut batch.force[k], &mut batch.dissipative[k]);
        for r in 0..rows {
            let lacks = normal[r] * (1.0 - share[r]);
            let (less, damped) =
                (force[r] + lacks * chunk.normal_force[r], dissipative[r] + lacks * chunk.damping_force[r]);
            force[r] = if share[r] < 1.0 { less } else { force[r] };
            dissipative[r] = if share[r] < 1.0 { damped } else { dissipative[r] };
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
