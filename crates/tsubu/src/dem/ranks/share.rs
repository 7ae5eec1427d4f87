//! What goes over in a step: motion, loads, all grains.

use super::{Ranks, of_blocks};
use crate::dem::contact_forces::{BlockContacts, Load};
use crate::dem::integrate::Report;
use crate::neighbours::NeighbourLists;
use crate::ranks::Reader;
use crate::state::Grains;
use glam::DVec3;
use std::ops::Range;

/// In how many parts blocks are evaluated while messages are under way: between them messages move on.
const PARTS: usize = 8;

/// Grains of which a column goes over at once.
const AT_ONCE: usize = 1 << 16;

impl Ranks {
    /// What a step has done to all blocks: drifts, reports and the sums of its `contacts`; and the grains that others see.
    pub fn share_motion(
        &mut self,
        done: Halves,
        grains: &mut Grains,
        neighbours: &mut NeighbourLists,
        (reports, contacts): (&mut [Report], &mut [BlockContacts]),
    ) {
        if self.cuts.is_empty() {
            return;
        }
        let all = grains.len();
        let mut columns = done.columns(grains, self.whole);
        let (own, drifts) = (neighbours.own(), &mut neighbours.drifts.of);
        self.write(|ranks, rank, message| {
            if done.first {
                for drift in &drifts[own.clone()] {
                    put(message, [drift.offset, drift.velocity]);
                    message.push(drift.farthest);
                }
            }
            if done.second {
                for (report, block) in reports[own.clone()].iter().zip(&contacts[own.clone()]) {
                    put(message, [report.fixed_force]);
                    message.extend([report.correction, report.driven_power]);
                    block.put_sums(message);
                }
            }
            if ranks.whole {
                put_rows(message, &columns, ranks.grains(ranks.rank(), all));
            } else {
                put_rows(message, &columns, ranks.seams[rank].gives.iter().map(|i| *i as usize));
            }
        });
        self.send_and_read(|ranks, rank, message| {
            let from = ranks.blocks(rank);
            if done.first {
                for drift in &mut drifts[from.clone()] {
                    (drift.offset, drift.velocity) = (message.vector(), message.vector());
                    drift.farthest = message.number();
                }
            }
            if done.second {
                for (report, block) in reports[from.clone()].iter_mut().zip(&mut contacts[from]) {
                    report.fixed_force = message.vector();
                    (report.correction, report.driven_power) = (message.number(), message.number());
                    block.take_sums(message);
                }
            }
            if ranks.whole {
                take_rows(message, &mut columns, ranks.grains(rank, all));
            } else {
                take_rows(message, &mut columns, ranks.seams[rank].takes.iter().map(|i| *i as usize));
            }
        });
    }

    /// Evaluates the `own` blocks, those of a range that are asked for, and brings over loads on grains of others: outer blocks come first, the
    /// others while messages are under way.
    pub fn share_loads(
        &mut self,
        blocks: &mut [BlockContacts],
        own: Range<usize>,
        evaluate: impl Fn(&mut [BlockContacts], Range<usize>, &(dyn Fn(usize) -> bool + Sync)),
    ) {
        if self.cuts.is_empty() {
            return evaluate(blocks, own, &|_| true);
        }
        let outer = std::mem::take(&mut self.outer);
        evaluate(blocks, own.clone(), &|block| outer[block]);
        self.write(|ranks, rank, message| {
            for &[block, local] in &ranks.seams[rank].back {
                let load = &blocks[block as usize].loads[local as usize];
                put(message, [load.force, load.torque, load.dissipative.as_dvec3()]);
            }
        });
        let (mut messages, mut rest) = (std::mem::take(&mut self.messages), own.clone());
        self.pass_across_seams(&mut messages, || {
            let part = rest.start..(rest.start + own.len().div_ceil(PARTS)).min(rest.end);
            rest.start = part.end;
            evaluate(blocks, part, &|block| !outer[block]);
            !rest.is_empty()
        });
        self.outer = outer;
        for (rank, message) in messages.iter().enumerate().filter(|(rank, _)| *rank != self.rank()) {
            for block in &self.seams[rank].owed {
                blocks[*block as usize].loads.clear();
            }
            let mut message = Reader::new(message);
            for &block in &self.seams[rank].owed {
                let (force, torque, dissipative) = (message.vector(), message.vector(), message.vector().as_vec3());
                blocks[block as usize].loads.push(Load { force, torque, dissipative });
            }
        }
        self.messages = messages;
    }

    /// What the grains of all blocks have taken from the layers of a stream.
    pub fn share_reaction(&mut self, blocks: &mut [BlockContacts]) {
        self.share_of_blocks(
            blocks,
            |block, message| block.immersion.put_reaction(message),
            |block, message| block.immersion.take_reaction(message),
        );
    }

    /// The sums of all blocks.
    pub fn share_sums(&mut self, blocks: &mut [BlockContacts]) {
        self.share_of_blocks(blocks, BlockContacts::put_sums, BlockContacts::take_sums);
    }

    fn share_of_blocks(
        &mut self,
        blocks: &mut [BlockContacts],
        put: impl Fn(&BlockContacts, &mut Vec<f64>),
        take: impl Fn(&mut BlockContacts, &mut Reader),
    ) {
        if self.cuts.is_empty() {
            return;
        }
        self.write(|ranks, _, message| blocks[ranks.blocks(ranks.rank())].iter().for_each(|block| put(block, message)));
        self.send_and_read(|ranks, rank, message| {
            blocks[ranks.blocks(rank)].iter_mut().for_each(|block| take(block, message));
        });
    }

    /// Gives all ranks all grains as their owners have them.
    pub fn gather_grains(&mut self, grains: &mut Grains) {
        let Grains { position, velocity, acceleration, spin, angular_acceleration, .. } = grains;
        self.gather_columns([position, velocity, acceleration, spin, angular_acceleration]);
        self.apart = false;
    }

    /// Gives all ranks the positions of all grains; all else too where something looks at all of them in every step.
    pub fn gather_positions(&mut self, grains: &mut Grains) {
        if self.whole {
            return self.gather_grains(grains);
        }
        self.gather_columns([&mut grains.position]);
        self.apart = !self.cuts.is_empty();
    }

    /// One column after the other, in parts: messages of all grains are large.
    fn gather_columns<const N: usize>(&mut self, columns: [&mut Vec<DVec3>; N]) {
        if self.cuts.is_empty() {
            return;
        }
        for column in columns {
            let (all, mut column) = (column.len(), [column]);
            let most = (0..self.seams.len()).map(|rank| self.grains(rank, all).len()).max().unwrap_or_default();
            for part in 0..most.div_ceil(AT_ONCE) {
                let rows = |ranks: &Self, rank| ranks.grains(rank, all).skip(part * AT_ONCE).take(AT_ONCE);
                self.write(|ranks, _, message| put_rows(message, &column, rows(ranks, ranks.rank())));
                self.send_and_read(|ranks, rank, message| take_rows(message, &mut column, rows(ranks, rank)));
            }
        }
    }

    /// The columns that ranks know of their own grains alone, and that are not sorted with the others: they go by [`Self::move_grains`].
    pub fn columns_apart(&self) -> &'static [&'static str] {
        if self.apart { Grains::APART } else { &[] }
    }

    /// After grains have been sorted and cut anew, gives every rank what its grains have in the columns apart, from those that had them. `order` has
    /// where each was before; empty where it is.
    pub fn move_grains(&mut self, grains: &mut Grains, order: &[u32]) {
        if !self.apart {
            return;
        }
        let all = grains.len();
        let before = |i: usize| order.get(i).map_or(i, |before| *before as usize);
        let came_from = |ranks: &Self, from: usize, to: usize| {
            let had = of_blocks(&ranks.cuts_before, from, all);
            ranks.grains(to, all).filter(move |i| had.contains(&before(*i)))
        };
        let rank = self.rank();
        let mut columns = grains.apart();
        self.write(|ranks, other, message| put_rows(message, &columns, came_from(ranks, rank, other).map(before)));
        let had = of_blocks(&self.cuts_before, rank, all);
        for column in &mut columns {
            let old = column[had.clone()].to_vec();
            for i in came_from(self, rank, rank) {
                column[i] = old[before(i) - had.start];
            }
        }
        self.send_and_read(|ranks, other, message| take_rows(message, &mut columns, came_from(ranks, other, rank)));
    }

    /// After lists have been made, what goes over after a first half: how the grains move that others see, and what blocks do.
    pub fn share_start(&mut self, grains: &mut Grains, neighbours: &mut NeighbourLists) {
        if self.apart {
            self.share_motion(Halves { first: true, second: false }, grains, neighbours, (&mut [], &mut []));
        }
    }
}

/// Which halves of a step have been done since grains last went over.
#[derive(Clone, Copy, Debug)]
pub(in crate::dem) struct Halves {
    /// The first: positions have gone on.
    pub first: bool,
    /// The second: velocities are complete, and blocks report.
    pub second: bool,
}

impl Halves {
    /// What goes over of grains: where they are and how they move; after the second half alone, where something looks at all
    /// grains, what forces have made of them.
    fn columns(self, grains: &mut Grains, whole: bool) -> Vec<&mut Vec<DVec3>> {
        let Grains { position, velocity, acceleration, spin, angular_acceleration, .. } = grains;
        match self.first {
            // Who looks at all of them takes back by accelerations what velocities and spins are ahead.
            true if whole => vec![position, velocity, acceleration, spin, angular_acceleration],
            true => vec![position, velocity, spin],
            false if whole => vec![velocity, acceleration, spin, angular_acceleration],
            false => Vec::new(),
        }
    }
}

fn put<const N: usize>(message: &mut Vec<f64>, vectors: [DVec3; N]) {
    message.extend_from_slice(vectors.map(|vector| vector.to_array()).as_flattened());
}

fn put_rows(message: &mut Vec<f64>, columns: &[&mut Vec<DVec3>], rows: impl Iterator<Item = usize>) {
    for i in rows {
        for column in columns {
            message.extend_from_slice(column[i].as_ref());
        }
    }
}

fn take_rows(message: &mut Reader, columns: &mut [&mut Vec<DVec3>], rows: impl Iterator<Item = usize>) {
    for i in rows {
        for column in &mut *columns {
            column[i] = message.vector();
        }
    }
}
