//! What goes over in a step: motion, loads, all grains.

use super::Ranks;
use crate::dem::contact_forces::{BlockContacts, Load};
use crate::dem::integrate::Report;
use crate::neighbours::NeighbourLists;
use crate::ranks::Reader;
use crate::state::Grains;
use glam::DVec3;
use std::ops::Range;

impl Ranks {
    /// What moving has done: reports and drifts of all blocks, and where the grains are that others see.
    pub fn share_motion(&mut self, grains: &mut Grains, neighbours: &mut NeighbourLists, reports: &mut [Report]) {
        if self.cuts.is_empty() {
            return;
        }
        let (own, drifts) = (neighbours.own(), &mut neighbours.drifts.of);
        self.write(|ranks, rank, message| {
            for (drift, report) in drifts[own.clone()].iter().zip(&reports[own.clone()]) {
                put(message, [drift.offset, drift.velocity, report.fixed_force]);
                message.extend([drift.farthest, report.correction, report.driven_power]);
            }
            if ranks.whole {
                return put_grains(message, grains, ranks.grains(ranks.rank(), grains));
            }
            for &i in &ranks.seams[rank].gives {
                let i = i as usize;
                put(message, [grains.position[i], grains.velocity[i], grains.spin[i]]);
            }
        });
        self.send_and_read(|ranks, rank, message| {
            let from = ranks.blocks(rank);
            for (drift, report) in drifts[from.clone()].iter_mut().zip(&mut reports[from]) {
                for vector in [&mut drift.offset, &mut drift.velocity, &mut report.fixed_force] {
                    *vector = message.vector();
                }
                for number in [&mut drift.farthest, &mut report.correction, &mut report.driven_power] {
                    *number = message.number();
                }
            }
            if ranks.whole {
                return take_grains(message, grains, ranks.grains(rank, grains));
            }
            for &i in &ranks.seams[rank].takes {
                let i = i as usize;
                for column in [&mut grains.position, &mut grains.velocity, &mut grains.spin] {
                    column[i] = message.vector();
                }
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
        if self.cuts.is_empty() {
            return;
        }
        self.write(|ranks, _, message| put_grains(message, grains, ranks.grains(ranks.rank(), grains)));
        self.send_and_read(|ranks, rank, message| take_grains(message, grains, ranks.grains(rank, grains)));
    }
}

fn put<const N: usize>(message: &mut Vec<f64>, vectors: [DVec3; N]) {
    message.extend(vectors.iter().flat_map(DVec3::to_array));
}

fn put_grains(message: &mut Vec<f64>, grains: &Grains, own: Range<usize>) {
    let Grains { position, velocity, acceleration, spin, angular_acceleration, .. } = grains;
    for i in own {
        put(message, [position[i], velocity[i], acceleration[i], spin[i], angular_acceleration[i]]);
    }
}

fn take_grains(message: &mut Reader, grains: &mut Grains, from: Range<usize>) {
    let Grains { position, velocity, acceleration, spin, angular_acceleration, .. } = grains;
    for i in from {
        for column in [&mut *position, velocity, acceleration, spin, angular_acceleration] {
            column[i] = message.vector();
        }
    }
}
