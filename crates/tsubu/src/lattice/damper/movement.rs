//! Movement: S += v; a ball whose stored distance has reached a cell moves by one cell.
//!
//! A cell that its owner leaves in the same step counts as free, so balls in line move together and a falling bed keeps
//! its shape. If several balls want one cell, each has the same chance and the others stay.

use super::Damper;
use crate::lattice::grid::EMPTY;
use crate::random::{Purpose, words};

/// What a ball does in this step: it may want to move, be about to, or have lost the lottery.
const STAYS: u8 = 0;
const WANTS: u8 = 1;
const ASKED: u8 = 2;

impl Damper {
    /// Phase 4.
    pub(super) fn travel(&mut self) {
        let cell = self.scale.cell;
        let mut room = 0;
        for (stored, speed) in self.stored.iter_mut().zip(&self.speed) {
            *stored += speed;
            room |= cell - 1 - *stored;
        }
        if room >= 0 {
            return;
        }
        self.movers.clear();
        for i in 0..self.stored.len() {
            if self.stored[i] >= cell && !self.resting[i] {
                self.movers.push(i);
                self.claims[i] = WANTS;
            }
        }
        self.draw_lots();
        for place in 0..self.movers.len() {
            self.try_move(self.movers[place]);
        }
        for place in 0..self.movers.len() {
            let i = self.movers[place];
            if self.stored[i] >= cell {
                self.stay(i);
            }
            self.claims[i] = STAYS;
        }
    }

    /// Among movers that want a cell of the first one is picked.
    fn draw_lots(&mut self) {
        for first in 0..self.movers.len() {
            let i = self.movers[first];
            if self.claims[i] != WANTS {
                continue;
            }
            let rivals = self.movers[first..].iter().filter(|&&other| self.are_rivals(i, other)).count();
            if rivals < 2 {
                continue;
            }
            let goal = self.grid.neighbour(self.cell[i], self.odd[i], self.direction[i]);
            let word = words(self.rules.seed, Purpose::Lottery, goal as u32, self.step)[0];
            let winner = (u64::from(word) * rivals as u64) >> 32;
            let mut number = 0;
            for place in first..self.movers.len() {
                let other = self.movers[place];
                if self.are_rivals(i, other) {
                    if number != winner {
                        self.claims[other] = STAYS;
                    }
                    number += 1;
                }
            }
        }
    }

    /// Whether a mover still wants a cell that the first one takes; it does itself.
    fn are_rivals(&self, first: usize, other: usize) -> bool {
        let mut goals = self.ahead(other, self.direction[other]);
        self.claims[other] == WANTS
            && goals.any(|goal| self.ahead(first, self.direction[first]).any(|cell| cell == goal))
    }

    /// Moves a ball, first whoever sits in its goal and moves too. Returns whether it moved.
    fn try_move(&mut self, i: usize) -> bool {
        if self.claims[i] != WANTS {
            return false;
        }
        // Asked twice means a ring of balls that wait for each other: nobody moves.
        self.claims[i] = ASKED;
        let direction = self.direction[i];
        let free = (0..self.stencil.ahead[self.odd[i]][direction as usize].len()).all(|k| {
            let goal = self.goal(i, direction, k);
            let owner = self.grid.at(goal);
            // Who has moved may still have a part of it.
            owner == EMPTY
                || usize::try_from(owner).is_ok_and(|owner| self.try_move(owner) && self.grid.at(goal) == EMPTY)
        });
        // One that has moved since may have come into a cell that was free.
        let free = free && self.ahead(i, direction).all(|goal| self.grid.at(goal) == EMPTY);
        if free {
            self.step_ahead(i);
        }
        free
    }

    fn step_ahead(&mut self, i: usize) {
        let (cell, odd, direction) = (self.cell[i], self.odd[i], self.direction[i]);
        for &offset in &self.stencil.behind[odd][direction as usize] {
            self.grid.set(cell.wrapping_add_signed(offset), EMPTY);
        }
        for &offset in &self.stencil.ahead[odd][direction as usize] {
            self.grid.set(cell.wrapping_add_signed(offset), i as i32);
        }
        self.cell[i] = self.grid.neighbour(cell, odd, direction);
        if !direction.is_vertical() {
            self.odd[i] ^= 1;
        }
        self.stored[i] -= self.scale.cell;
        if !self.rules.keep_remainder {
            self.forget(i, 0);
        }
        self.disturb(i);
        self.near.insert(i);
    }

    /// The way was blocked: the stored distance is forgotten, or kept no larger than lets the ball go as soon as it can.
    fn stay(&mut self, i: usize) {
        let most = self.scale.cell + self.speed[i];
        if self.rules.reset_when_blocked {
            self.forget(i, 0);
        } else if self.stored[i] > most {
            self.forget(i, most);
        }
    }

    fn forget(&mut self, i: usize, kept: i64) {
        self.tally.rules += self.scale.gravity * self.direction[i].k() * (self.stored[i] - kept);
        self.stored[i] = kept;
    }
}
