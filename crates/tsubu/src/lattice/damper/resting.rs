//! Resting contacts: balls that lie on the floor, or on balls that do.
//!
//! A ball that straight from above meets the floor, or a ball at rest, at no more than the resting speed
//! (`lattice.resting-threshold` times g dt) comes to rest: it has the speed of the box from then on. All that rest are one body,
//! so a settled bed costs little a step whatever its size.
//!
//! Each step gravity makes the body approach the floor at r = g dt + (old - new speed of the box), that is (g + a) dt. As
//! long as r > 0 the floor takes m r from every ball. With resting impulses that is handed to the box: weight and
//! inertia, the impulse m (g + a) dt that the literal automaton leaves out. Without, it goes to the rules' account
//! ("force only from balls that are moving"). When r <= 0 the floor falls away faster than the balls: all fly. Without
//! resting impulses r above the resting speed is a collision like any other, and all are let go.

use super::Damper;
use crate::lattice::direction::{Direction, Vector};

impl Damper {
    /// Phase 1 and 2 of the resting balls: gravity and the floor, together.
    pub(super) fn carry_rest(&mut self, wall: i64) {
        if self.rest.count == 0 {
            self.rest.speed = wall;
            return;
        }
        let pulled = self.rest.speed - self.scale.gravity;
        let approach = wall - pulled;
        let too_fast = !self.rules.resting_impulses && approach > self.rules.resting_speed;
        if approach <= 0 || too_fast {
            self.rest.speed = pulled;
            self.release_all(false);
            self.rest.speed = wall;
            return;
        }
        let count = self.rest.count;
        self.rest.speed = wall;
        self.post_resting(Vector { h: 0, k: 2 * pulled }, wall, count);
        if self.rules.reset_when_blocked {
            // The bed stays in its cells although it has a speed; whole cells come back when the box moves by one.
            self.tally.rules += count * self.scale.gravity * 2 * wall;
        } else {
            self.rest.risen += wall;
        }
    }

    /// Books for `count` balls that the box brings from `old` to its own velocity in a resting contact.
    pub(super) fn post_resting(&mut self, old: Vector, wall: i64, count: i64) {
        let k = 2 * wall - old.k;
        let gain = wall * wall - old.square4() / 4 + self.scale.gravity / 2 * k;
        if self.rules.resting_impulses {
            self.tally.wall.k += count * k;
            self.tally.wall.h -= count * old.h;
            self.tally.collision += count * (k * wall - gain);
        } else {
            self.tally.rule.k += count * k;
            self.tally.rule.h -= count * old.h;
            self.tally.rules -= count * gain;
        }
    }

    /// A ball lies down on what is below it.
    pub(super) fn join(&mut self, i: usize, wall: i64) {
        self.post_resting(self.velocity(i), wall, 1);
        let stored = self.stored[i] * self.direction[i].k() / 2;
        let kept = if self.rules.reset_when_blocked { 0 } else { stored };
        self.tally.rules += self.scale.gravity * 2 * (stored - kept);
        // The balls at rest have had this step's rise of the box already, this one has not.
        let rise = if self.rules.reset_when_blocked {
            self.tally.rules += self.scale.gravity * 2 * wall;
            0
        } else {
            wall
        };
        self.point(i, Direction::S, 0);
        self.pull[i] = 0;
        self.resting[i] = true;
        self.stored[i] = kept + rise - self.rest.risen;
        self.rest.count += 1;
        self.stale.remove(i);
    }

    /// Lets a resting ball and all that stand on nothing else go, with the velocity they have.
    pub(super) fn release_above(&mut self, i: usize) {
        let mut next = vec![i];
        while let Some(i) = next.pop() {
            if self.resting[i] {
                self.release(i, true);
                next.extend(
                    self.balls_ahead(i, Direction::N).filter(|&above| self.resting[above] && !self.stands(above)),
                );
            }
        }
    }

    /// Lets everything go. `carried`: this step's rise has been given to the resting balls; phase 4 will give it to a flying ball again.
    pub(super) fn release_all(&mut self, carried: bool) {
        for i in 0..self.balls() {
            if self.resting[i] {
                self.release(i, carried);
            }
        }
        self.rest.risen = 0;
    }

    fn release(&mut self, i: usize, carried: bool) {
        self.resting[i] = false;
        self.rest.count -= 1;
        let speed = self.rest.speed;
        let mut offset = self.stored[i] + self.rest.risen;
        if carried {
            if self.rules.reset_when_blocked {
                self.tally.rules -= self.scale.gravity * 2 * speed;
            } else {
                offset -= speed;
            }
        }
        let direction = if speed > 0 { Direction::N } else { Direction::S };
        self.stored[i] = if speed > 0 { offset } else { -offset };
        self.point(i, direction, speed.abs());
        self.disturb(i);
    }
}
