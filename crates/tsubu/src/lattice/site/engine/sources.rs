//! Grains that come in by streams and go by outlets, and walls that vanish.

use super::SiteEngine;
use crate::lattice::sheet::{OUT, WALL};
use crate::lattice::site::ground::NOBODY;
use crate::lattice::site::start::GrainStream;
use crate::ledger::Ledger;
use crate::random::{Purpose, words};

impl SiteEngine {
    /// Walls whose time has come vanish from the lattice.
    pub(super) fn open_gates(&mut self, time: f64) {
        if !self.scene.walls.iter().any(|wall| !wall.vanished() && wall.goes_by(time)) {
            return;
        }
        for wall in &mut self.scene.walls {
            wall.stand_or_go(time);
        }
        let (cells, owner) = self.scene.ground.paint(&self.scene.walls, &self.scene.removal);
        for (site, (&cell, &mine)) in cells.iter().zip(&owner).enumerate() {
            if self.scene.owner[site] != NOBODY && mine == NOBODY && cell != WALL {
                self.model.free(site, cell == OUT);
            }
        }
        self.scene.owner = owner;
    }

    /// Grains of streams come in where there is room, from a site drawn at random on.
    pub(super) fn insert(&mut self, time: f64, ledger: &mut Ledger) {
        let mut came = Vec::new();
        for GrainStream { first, count, sites, rate, from, placed } in &mut self.scene.streams {
            let due = ((time - *from) * *rate + 1.0).max(0.0) as usize;
            while *placed < due.min(*count) {
                let grain = *first + *placed;
                let [draw, ..] = words(self.scene.seed, Purpose::Stream, grain as u32, self.model.step());
                let begin = ((u64::from(draw) * sites.len() as u64) >> 32) as usize;
                let (before, after) = sites.split_at(begin);
                let Some(seat) = after.iter().chain(before).find_map(|&site| self.model.enter(grain, site)) else {
                    break;
                };
                came.push(seat);
                *placed += 1;
            }
        }
        self.present += came.len();
        for seat in came {
            self.exchange(1.0, &seat, ledger);
        }
    }

    /// Takes note of the grains that were removed in the last step.
    pub(super) fn remove(&mut self, ledger: &mut Ledger) {
        let removed = self.model.removed();
        self.present -= removed.len();
        for seat in removed {
            self.exchange(-1.0, &seat, ledger);
        }
    }
}
