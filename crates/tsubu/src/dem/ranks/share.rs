//! What goes over in a step: motion, loads, all grains.

use super::{Ranks, of_blocks};
use crate::dem::contact_forces::{BlockContacts, Load};
use crate::dem::integrate::Report;
use crate::neighbours::NeighbourLists;
use crate::neighbours::drift::Drift;
use crate::ranks::Reader;
use crate::state::Grains;
use glam::DVec3;

impl Ranks {
    /// What moving has done: drifts or reports of all blocks, and the grains that others see.
    pub fn share_motion(
        &mut self,
        done: Halves,
        grains: &mut Grains,
        neighbours: &mut NeighbourLists,
        reports: &mut [Report],
    ) {
        if self.cuts.is_empty() {
            return;
        }
        let all = grains.len();
        let mut columns = done.columns(grains, self.whole);
        let (own, drifts) = (neighbours.own(), &mut neighbours.drifts.of);
        self.write(|ranks, rank, message| {
            for (drift, report) in drifts[own.clone()].iter().zip(&reports[own.clone()]) {
                if done.first {
                    put(message, [drift.offset, drift.velocity]);
                    message.push(drift.farthest);
                }
                if done.second {
                    put(message, [report.fixed_force]);
                    message.extend([report.correction, report.driven_power]);
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
            for (drift, report) in drifts[from.clone()].iter_mut().zip(&mut reports[from]) {
                if done.first {
                    (drift.offset, drift.velocity) = (message.vector(), message.vector());
                    drift.farthest = message.number();
                }
                if done.second {
                    report.fixed_force = message.vector();
                    (report.correction, report.driven_power) = (message.number(), message.number());
                }
            }
            if ranks.whole {
                take_rows(message, &mut columns, ranks.grains(rank, all));
            } else {
                take_rows(message, &mut columns, ranks.seams[rank].takes.iter().map(|i| *i as usize));
            }
        });
    }

    /// What forces have done: sums of all blocks, and loads on grains of others.
    pub fn share_forces(&mut self, blocks: &mut [BlockContacts]) {
        if self.cuts.is_empty() {
            return;
        }
        self.write(|ranks, rank, message| {
            for block in &blocks[ranks.blocks(ranks.rank())] {
                block.sums.put(message);
                for load in &block.walls {
                    put(message, [load.force, load.torque]);
                }
                block.immersion.put(message);
            }
            for &[block, local] in &ranks.seams[rank].back {
                let load = &blocks[block as usize].loads[local as usize];
                put(message, [load.force, load.torque, load.dissipative.as_dvec3()]);
            }
        });
        self.send_and_read(|ranks, rank, message| {
            for block in &mut blocks[ranks.blocks(rank)] {
                block.sums.take(message);
                for load in &mut block.walls {
                    (load.force, load.torque) = (message.vector(), message.vector());
                }
                block.immersion.take(message);
                block.loads.clear();
            }
            for &block in &ranks.seams[rank].owed {
                let (force, torque, dissipative) = (message.vector(), message.vector(), message.vector().as_vec3());
                blocks[block as usize].loads.push(Load { force, torque, dissipative });
            }
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

    /// One column after the other: messages of all grains are large.
    fn gather_columns<const N: usize>(&mut self, columns: [&mut Vec<DVec3>; N]) {
        if self.cuts.is_empty() {
            return;
        }
        for column in columns {
            let (all, mut column) = (column.len(), [column]);
            self.write(|ranks, _, message| put_rows(message, &column, ranks.grains(ranks.rank(), all)));
            self.send_and_read(|ranks, rank, message| take_rows(message, &mut column, ranks.grains(rank, all)));
        }
    }

    /// After grains have been sorted and cut anew, gives every rank what its grains have beside positions, from those that had them. `order` has
    /// where each was before; empty where it is.
    pub fn move_grains(&mut self, grains: &mut Grains, order: &[u32]) {
        if !self.apart {
            return;
        }
        let all = grains.len();
        let came_from = |ranks: &Self, from: usize, to: usize| {
            let had = of_blocks(&ranks.cuts_before, from, all);
            let before = |i: usize| order.get(i).map_or(i, |before| *before as usize);
            ranks.grains(to, all).filter(move |i| had.contains(&before(*i)))
        };
        let Grains { velocity, acceleration, spin, angular_acceleration, .. } = grains;
        let mut columns = [velocity, acceleration, spin, angular_acceleration];
        self.write(|ranks, rank, message| put_rows(message, &columns, came_from(ranks, ranks.rank(), rank)));
        self.send_and_read(|ranks, rank, message| {
            take_rows(message, &mut columns, came_from(ranks, rank, ranks.rank()));
        });
    }

    /// After lists have been made, how the grains move that others see, and what blocks do: as after a first half.
    pub fn share_start(&mut self, grains: &mut Grains, drifts: &mut [Drift]) {
        if !self.apart {
            return;
        }
        let mut columns = [&mut grains.velocity, &mut grains.spin];
        self.write(|ranks, rank, message| {
            for drift in &drifts[ranks.blocks(ranks.rank())] {
                put(message, [drift.velocity]);
            }
            put_rows(message, &columns, ranks.seams[rank].gives.iter().map(|i| *i as usize));
        });
        self.send_and_read(|ranks, rank, message| {
            for drift in &mut drifts[ranks.blocks(rank)] {
                drift.velocity = message.vector();
            }
            take_rows(message, &mut columns, ranks.seams[rank].takes.iter().map(|i| *i as usize));
        });
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
    message.extend(vectors.iter().flat_map(DVec3::to_array));
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
