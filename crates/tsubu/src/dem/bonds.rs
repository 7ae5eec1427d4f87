//! Bonds between grains: beams that carry force, bending and twisting until they break. While a bond holds, it takes the place of the contact.
//!
//! Every bond is evaluated alone; then every grain adds what its bonds do to it, in the order of the bonds: the same bits on any number of
//! threads.

mod beam;
mod make;

use super::bodies::Bodies;
use super::contact_forces::BlockContacts;
use super::orientation::Orientation;
use crate::beam::Stiffness;
use crate::neighbours::block::BLOCK;
use crate::neighbours::grid::{PeriodicBounds, nearest_image};
use crate::state::Grains;
use crate::threads::{each_in_parts, shares};
use beam::{Act, Beam};
use glam::{DQuat, DVec3};
use std::ops::Range;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

pub(super) use make::refused;

/// All bonds, and what a scene says of them.
#[derive(Debug, Default)]
pub(super) struct Bonds {
    entries: Vec<plan::Bond>,
    /// Of each entry, of each group, whether it bonds its grains.
    joins: Vec<Vec<bool>>,
    /// Entries whose bonds have been made.
    made: Vec<bool>,
    seed: u64,
    plane: bool,
    /// Those that hold, in the order in which they were made.
    list: Vec<Beam>,
    /// How many have been made, and how many have broken.
    counted: u64,
    broken: u64,
    bonded: Vec<Bonded>,
    /// Bonds, and which end, of all bonded grains.
    ends: Vec<(u32, u8)>,
    /// Stored [J].
    pub stored: f64,
    /// Lost in damping [W].
    pub lost: f64,
}

/// A grain that has bonds, and what they do to it.
#[derive(Clone, Debug)]
struct Bonded {
    row: u32,
    /// Its place in [`Bonds::ends`].
    ends: Range<u32>,
    force: DVec3,
    torque: DVec3,
    /// The part of both that damps.
    damping: [DVec3; 2],
}

/// How grains are turned.
#[derive(Clone, Copy)]
pub(super) struct Attitudes<'a> {
    pub orientation: &'a Orientation,
    pub bodies: &'a Bodies,
}

impl Attitudes<'_> {
    /// Of the grain with an id.
    pub fn of(&self, id: u32) -> DQuat {
        let own = || self.orientation.of(id).unwrap_or(DQuat::IDENTITY);
        self.bodies.orientation(id).unwrap_or_else(own)
    }
}

impl Bonds {
    /// Whether none holds now.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many have broken so far.
    pub fn broken(&self) -> u64 {
        self.broken
    }

    /// The ids of the grains of each.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.list.iter().map(|bond| bond.grains)
    }

    /// Where these grains are among the grains.
    pub fn rows(&self) -> impl Iterator<Item = [u32; 2]> {
        self.list.iter().map(|bond| bond.rows)
    }

    /// Finds the grains wherever they have been sorted to; bonds of grains that have gone go with them.
    pub fn find(&mut self, grains: &Grains) {
        if self.is_empty() && self.bonded.is_empty() {
            return;
        }
        let numbers = grains.id.iter().max().map_or(0, |id| *id as usize + 1);
        let mut row_of = vec![u32::MAX; numbers];
        for (row, id) in (0..).zip(&grains.id) {
            row_of[*id as usize] = row;
        }
        let row = |id: u32| row_of.get(id as usize).copied().unwrap_or(u32::MAX);
        self.list.retain_mut(|bond| {
            bond.rows = bond.grains.map(row);
            !bond.rows.contains(&u32::MAX)
        });
        let ends =
            (0..).zip(&self.list).flat_map(|(k, bond)| (0..).zip(bond.rows).map(move |(end, row)| (row, (k, end))));
        let mut ends: Vec<(u32, (u32, u8))> = ends.collect();
        ends.sort_unstable();
        let still =
            |row, ends| Bonded { row, ends, force: DVec3::ZERO, torque: DVec3::ZERO, damping: [DVec3::ZERO; 2] };
        self.bonded.clear();
        let mut first = 0;
        for same in ends.chunk_by(|a, b| a.0 == b.0) {
            let end = first + same.len() as u32;
            self.bonded.push(still(same[0].0, first..end));
            first = end;
        }
        self.ends = ends.into_iter().map(|(_, end)| end).collect();
    }

    /// Evaluates all at this moment.
    pub fn evaluate(&mut self, grains: &Grains, attitudes: Attitudes, periodic: &PeriodicBounds) {
        let shares = shares(self.list.len());
        each_in_parts(&mut self.list, shares, &|bond: &mut Beam| {
            bond.evaluate(grains, branch(periodic, grains, bond.rows), bond.grains.map(|id| attitudes.of(id)));
        });
        self.stored = self.list.iter().map(|bond| bond.energy).sum();
        self.lost = self.list.iter().map(|bond| bond.lost).sum();
        let (list, ends) = (&self.list, &self.ends);
        each_in_parts(&mut self.bonded, shares, &|grain: &mut Bonded| {
            (grain.force, grain.torque, grain.damping) = (DVec3::ZERO, DVec3::ZERO, [DVec3::ZERO; 2]);
            for &(k, end) in &ends[grain.ends.start as usize..grain.ends.end as usize] {
                let (bond, sign) = (&list[k as usize], if end == 0 { -1.0 } else { 1.0 });
                let on = |act: &Act| [sign * act.force, act.torque[end as usize]];
                let (elastic, damping) = (on(&bond.elastic), on(&bond.damping));
                grain.force += elastic[0] + damping[0];
                grain.torque += elastic[1] + damping[1];
                grain.damping = [grain.damping[0] + damping[0], grain.damping[1] + damping[1]];
            }
        });
    }

    /// Adds what bonds do to what contacts do to the grains of each of the `own` blocks.
    pub fn add(&self, blocks: &mut [BlockContacts], own: &Range<usize>) {
        for grain in self.bonded.iter().filter(|grain| own.contains(&(grain.row as usize / BLOCK))) {
            let row = grain.row as usize;
            let load = &mut blocks[row / BLOCK].loads[row % BLOCK];
            load.force += grain.force;
            load.torque += grain.torque;
        }
    }

    /// Power of all torques with the spins as they are now [W], on grains that forces move.
    pub fn torque_power(&self, grains: &Grains) -> f64 {
        let free = self.bonded.iter().filter(|grain| grains.inverse_mass[grain.row as usize] != 0.0);
        free.map(|grain| grain.torque.dot(grains.spin[grain.row as usize])).sum()
    }

    /// What damping takes at this time level, when velocities are completed: a third with those that the forces were computed with, see
    /// [`super::integrate`].
    pub fn measure(&mut self, grains: &Grains) {
        let power = |grain: &Bonded| {
            let row = grain.row as usize;
            grain.damping[0].dot(grains.velocity[row]) + grain.damping[1].dot(grains.spin[row])
        };
        self.lost = (self.lost - 2.0 * self.bonded.iter().map(power).sum::<f64>()) / 3.0;
    }

    /// Force on the grain in row `i` [N].
    pub fn on(&self, i: usize) -> DVec3 {
        let found = self.bonded.binary_search_by_key(&(i as u32), |grain| grain.row);
        found.map_or(DVec3::ZERO, |k| self.bonded[k].force)
    }

    /// Whether some carry more than they can.
    pub fn overloaded(&self) -> bool {
        self.list.iter().any(|bond| self.too_much(bond))
    }

    fn too_much(&self, bond: &Beam) -> bool {
        let entry = &self.entries[bond.entry as usize];
        let strengths = [entry.tensile_strength, entry.shear_strength];
        let mut both = strengths.iter().zip(bond.stress);
        both.any(|(strength, stress)| strength.is_some_and(|strength| stress > strength * bond.strength))
    }

    /// Lets those go that carry too much.
    fn give_way(&mut self) {
        let before = self.list.len();
        let gone: Vec<bool> = self.list.iter().map(|bond| self.too_much(bond)).collect();
        let mut gone = gone.into_iter();
        self.list.retain(|_| !gone.next().unwrap_or_default());
        self.broken += (before - self.list.len()) as u64;
    }

    pub fn save(&self, state: &mut State) {
        if self.entries.is_empty() {
            return;
        }
        let whole = |f: &dyn Fn(&Beam) -> i64| self.list.iter().map(f).collect::<Vec<_>>();
        state.put_integer("bonds.entry", whole(&|bond| i64::from(bond.entry)));
        state.put_integer("bonds.first", whole(&|bond| i64::from(bond.grains[0])));
        state.put_integer("bonds.second", whole(&|bond| i64::from(bond.grains[1])));
        let made = self.made.iter().map(|made| i64::from(*made));
        state.put_integer("bonds.broken", made.chain([self.counted as i64, self.broken as i64]).collect::<Vec<_>>());
        let real = |bond: &Beam| {
            let axes = bond.axes.iter().flat_map(DQuat::to_array);
            let numbers: Vec<f64> = axes.chain([bond.length, bond.radius, bond.strength, bond.relaxation]).collect();
            numbers
        };
        state.put_real("bonds.beams", self.list.iter().flat_map(real).collect::<Vec<_>>());
        state.put_real("bonds.sums", vec![self.stored, self.lost]);
    }

    /// Takes it back, with the grains that were saved beside.
    pub fn load(&mut self, state: &State, grains: &Grains) -> Result<(), MissingSection> {
        if self.entries.is_empty() {
            return Ok(());
        }
        let missing = |name: &str| MissingSection { name: name.to_owned(), kind: "real" };
        let [entry, first, second] = ["bonds.entry", "bonds.first", "bonds.second"].map(|name| state.integer(name));
        let (entry, first, second) = (entry?, first?, second?);
        let (counts, numbers) = (state.integer("bonds.broken")?, state.real("bonds.beams")?.as_chunks::<12>().0);
        let alike = [first.len(), second.len(), numbers.len()].iter().all(|length| *length == entry.len());
        let known = entry.iter().all(|k| (0..self.entries.len() as i64).contains(k));
        if !alike || !known || counts.len() != self.entries.len() + 2 {
            return Err(missing("bonds.beams"));
        }
        for (made, count) in self.made.iter_mut().zip(counts) {
            *made = *count != 0;
        }
        (self.counted, self.broken) = (counts[self.entries.len()] as u64, counts[self.entries.len() + 1] as u64);
        self.list = entry
            .iter()
            .zip(first.iter().zip(second))
            .zip(numbers)
            .map(|((k, (first, second)), n)| {
                let bond = &self.entries[*k as usize];
                let axes = [0, 4].map(|at| DQuat::from_xyzw(n[at], n[at + 1], n[at + 2], n[at + 3]));
                let (length, radius) = (n[8], n[9]);
                Beam {
                    entry: *k as u32,
                    grains: [*first as u32, *second as u32],
                    axes,
                    length,
                    radius,
                    strength: n[10],
                    relaxation: n[11],
                    stiffness: Stiffness::of(bond, radius, length),
                    ..Beam::default()
                }
            })
            .collect();
        self.find(grains);
        if self.list.len() != entry.len() {
            return Err(missing("bonds.first"));
        }
        let &[stored, lost] = state.real("bonds.sums")? else { return Err(missing("bonds.sums")) };
        (self.stored, self.lost) = (stored, lost);
        Ok(())
    }
}

/// From the first to the second of two grains, across a periodic end where that is nearer [m].
fn branch(periodic: &PeriodicBounds, grains: &Grains, rows: [u32; 2]) -> DVec3 {
    let [i, j] = rows.map(|row| row as usize);
    nearest_image(periodic, grains.position[j] - grains.position[i])
}
