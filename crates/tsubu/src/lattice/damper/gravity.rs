//! Gravity: every step adds -g dt (d . z) to the speed along the direction d.
//!
//! With `projected` an oblique ball gains or loses half of g dt, which conserves the energy along its straight path; with
//! `unit` all of it. A ball on its way up whose speed runs out turns down: straight up becomes straight down with the
//! speed that is left over, so that the parabola goes on exactly; an oblique ball is turned to straight down.

use super::Damper;
use crate::lattice::direction::{Direction, Vector};

impl Damper {
    /// Phase 1 for the balls that do not rest.
    pub(super) fn pull_down(&mut self) {
        let g = self.scale.gravity;
        if g == 0 {
            return;
        }
        self.post_oblique_pull();
        let mut signs = 0;
        for (speed, pull) in self.speed.iter_mut().zip(&self.pull) {
            *speed += pull;
            signs |= *speed;
        }
        if signs < 0 {
            for i in 0..self.speed.len() {
                if self.speed[i] < 0 {
                    self.turn_down(i);
                }
            }
        }
    }

    /// Gravity acts on an oblique ball along its direction only; the lattice takes the rest.
    fn post_oblique_pull(&mut self) {
        let g = self.scale.gravity;
        for d in [Direction::NE, Direction::SE, Direction::SW, Direction::NW] {
            let count = self.oblique_count[d as usize];
            let pull = self.pull_of[d as usize];
            self.tally.rule.h += count * pull * d.h();
            self.tally.rule.k += count * (pull * d.k() + 2 * g);
        }
        let excess = self.pull_of[Direction::SE as usize] - g / 2;
        if excess != 0 && self.oblique_count.iter().sum::<i64>() != 0 {
            for i in 0..self.balls() {
                let d = self.direction[i];
                if self.oblique.contains(i) {
                    // Energy before and after the pull, each with the height at the time of its velocity.
                    let (old, new) = (self.speed[i], self.speed[i] + self.pull[i]);
                    self.tally.rules -= new * new - old * old + g / 2 * d.k() * (new + old);
                }
            }
        }
    }

    fn turn_down(&mut self, i: usize) {
        let left = -self.speed[i];
        if self.direction[i] == Direction::N {
            self.stored[i] = -self.stored[i];
            self.point(i, Direction::S, left);
            self.stale.insert(i);
            return;
        }
        let back = self.direction[i].opposite();
        let meant: Vector = back.times(left);
        let speed = self.scale.cut(left / 2);
        self.redirect(i, meant, Direction::S, speed);
    }
}
