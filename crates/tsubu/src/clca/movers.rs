//! Where walls and driven grains are at a time: walls that stand are painted on the lattice, those that move push.

use super::bed::{Bed, NOWHERE};
use super::build::moves;
use super::engine::{ClCaEngine, Rule};
use crate::lattice::direction::Vector;
use crate::lattice::grid::WALL;
use crate::lattice::stage::Stage;
use crate::motion::value_and_rate;
use crate::partner::Hosts;
use crate::wall::Wall;

impl ClCaEngine {
    /// Paints the lattice anew: rims, walls that stand at `time`, frozen grains, and under the active rule all others.
    pub(super) fn paint(&mut self, time: f64) {
        self.bed.grid = self.stage.grid();
        for wall in self.walls.iter_mut().filter(|wall| !moves(wall)) {
            wall.stand_or_go(time);
            self.stage.paint(&mut self.bed.grid, wall);
        }
        let driven = |bed: &Bed, grain: usize| self.driven.iter().any(|d| d.0 == bed.kind(grain).group);
        for grain in 0..self.bed.len() {
            if self.bed.grains.cell[grain] == NOWHERE || driven(&self.bed, grain) {
                continue;
            }
            match (&self.rule, self.bed.kind(grain).free) {
                (_, false) => self.bed.paint(grain, WALL),
                (Rule::Active(_), true) => self.bed.paint(grain, grain as i32),
                (Rule::Passive(..), true) => {}
            }
        }
        if let Rule::Active(active) = &mut self.rule {
            active.wake_all(&self.bed);
        }
    }

    /// Brings walls that move, and driven grains, to where they are after `step` steps.
    pub(super) fn place_movers(&mut self, step: u64) {
        let Rule::Passive(_, pushers, last) = &mut self.rule else { return };
        let (time, before) = (step as f64 * self.dt, step.saturating_sub(1) as f64 * self.dt);
        for pusher in pushers {
            let wall = &self.walls[pusher.wall];
            let (now, then) = (shift(wall, &self.stage, time), shift(wall, &self.stage, before));
            pusher.moved = Vector { h: now.h - then.h, k: now.k - then.k };
            let grid = &self.bed.grid;
            let count = grid.columns() * grid.rows();
            if wall.goes_by(time) {
                pusher.cells.clear();
                pusher.cells.resize(count, false);
            } else if pusher.cells.is_empty() || now != then {
                pusher.stand(now, || {
                    let mut cells = vec![false; count];
                    self.stage.covered(grid, wall, now, |cell| cells[cell] = true);
                    cells
                });
            }
        }
        last.clear();
        last.resize(self.bed.len(), Vector::default());
        for (group, direction, signal) in &self.driven {
            let at = |time: f64| self.stage.vector(*direction * value_and_rate(signal, time).0);
            let (now, then) = (at(time), at(before));
            for (grain, last) in last.iter_mut().enumerate() {
                if self.bed.kind(grain).group == *group {
                    let drawn = self.bed.vector(self.drawn[grain] as usize).plus(now);
                    if let Some(cell) = self.stage.cell(&self.bed.grid, self.stage.position(drawn)) {
                        self.bed.grains.cell[grain] = cell as u32;
                    }
                    *last = Vector { h: now.h - then.h, k: now.k - then.k };
                }
            }
        }
    }
}

/// How far a wall that is moved as told has come since time 0, in whole steps of the lattice.
pub(super) fn shift(wall: &Wall, stage: &Stage, time: f64) -> Vector {
    let moved = |time: f64| wall.mover.displacement(time, &Hosts::default()).0;
    stage.vector(moved(time) - moved(0.0))
}
