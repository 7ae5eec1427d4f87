//! Ball-ball collisions (A9): v_a' = ((v_a + v_b) - e (v_a - v_b)) / 2 along the direction of a.
//!
//! A ball looks into the cells ahead. If a ball is there and they approach, the one that looks gives up the speed
//! j = (1 + e) (v_a - v_b) / 2; of several ahead the one that it approaches fastest counts. With `pairwise` the other gets it, so that a
//! head-on collision conserves momentum exactly;
//! if it moved another way, it takes the lattice direction nearest to the vector sum. With `literal` every ball updates
//! only itself. A ball whose speed changes sign rebounds: straight back with probability 1/2, to each neighbour of that
//! direction with probability 1/4 (`rebound-scatter`).
//!
//! A ball takes part in one collision a step. Pairs are taken in random order; a random number is drawn only when there is
//! more than one pair, or a rebound to scatter.

use super::Damper;
use super::ball_set::BallSet;
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::{EMPTY, WALL};
use crate::mutation::{Mutation, left_out};
use crate::random::{Purpose, words};
use tsubu_scene::plan::Collision;

/// An approaching pair: who looks, at whom, and twice the approach speed along the direction of the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    looker: u32,
    seen: u32,
    approach2: i64,
}

impl Damper {
    /// Phase 2, resting stacks apart.
    pub(super) fn collide(&mut self, wall: i64) {
        self.hit.clear();
        self.meet_floor(wall);
        self.meet_ceiling(wall);
        if self.look_everywhere {
            self.stale.fill(self.speed.len());
        }
        self.mark_watchers_of_oblique();
        self.pairs.clear();
        for word in 0..self.stale.0.len() {
            for i in BallSet::members(word, self.stale.0[word] | self.oblique.0[word]) {
                self.look(i, wall);
            }
        }
        self.shuffle_pairs();
        let pairs = std::mem::take(&mut self.pairs);
        // In a crowd everybody is next to somebody who collides: marking all at once is cheaper than one by one.
        self.crowded = 8 * pairs.len() > self.speed.len();
        for pair in &pairs {
            self.bounce(*pair);
        }
        if self.crowded {
            self.stale.fill(self.speed.len());
            self.crowded = false;
        }
        self.pairs = pairs;
    }

    /// The relative speed of a vertical and an oblique ball changes in free flight: a vertical ball that looks at an
    /// oblique one must look every step.
    fn mark_watchers_of_oblique(&mut self) {
        for word in 0..self.oblique.0.len() {
            for i in BallSet::members(word, self.oblique.0[word]) {
                for direction in [Direction::S, Direction::N] {
                    for &offset in &self.stencil.ahead[self.odd[i]][direction as usize] {
                        if let Ok(other) = usize::try_from(self.grid.at(self.cell[i].wrapping_add_signed(offset))) {
                            self.stale.insert(other);
                        }
                    }
                }
            }
        }
    }

    /// Looks at the cells ahead: a wall, a pair for later, or nothing to do until something changes.
    fn look(&mut self, i: usize, wall: i64) {
        let direction = self.direction[i];
        let (mut walled, mut pair) = (false, Pair { looker: i as u32, seen: 0, approach2: 0 });
        if !self.resting[i] {
            for cell in self.ahead(i, direction) {
                match self.grid.at(cell) {
                    EMPTY => {}
                    WALL => walled = true,
                    ball => {
                        let approach2 = self.approach2(i, ball as usize, wall);
                        if approach2 > pair.approach2 {
                            pair = Pair { seen: ball as u32, approach2, ..pair };
                        }
                    }
                }
            }
        }
        let oblique_at_wall = walled && !direction.is_vertical();
        if !oblique_at_wall && pair.approach2 <= 0 {
            self.stale.remove(i);
            return;
        }
        if self.hit.contains(i) {
            return;
        }
        if oblique_at_wall {
            self.stale.remove(i);
            self.hit_wall_ahead(i, wall);
            return;
        }
        let b = pair.seen as usize;
        if self.resting[b] && pair.approach2 <= 2 * self.rules.resting_speed {
            self.come_to_rest(i, wall);
        } else if self.resting[b] || !self.hit.contains(b) {
            self.pairs.push(pair);
        }
    }

    /// Twice the speed at which a ball approaches one that it sees ahead; 0 where that is the floor's affair: straight above one that rests.
    #[inline]
    fn approach2(&self, i: usize, b: usize, wall: i64) -> i64 {
        let direction = self.direction[i];
        if !self.resting[b] {
            return 2 * self.speed[i] - direction.twice_cosine(self.direction[b]) * self.speed[b];
        }
        if direction.is_vertical() { 0 } else { 2 * self.speed[i] - direction.twice_cosine(Direction::N) * wall }
    }

    /// Fisher-Yates with a multiplicative generator started from the counter-based one.
    fn shuffle_pairs(&mut self) {
        let count = self.pairs.len();
        if count < 2 {
            return;
        }
        let start = words(self.rules.seed, Purpose::Order, 0, self.step);
        let mut state = (u64::from(start[0]) << 32 | u64::from(start[1])) | 1;
        for last in (1..count).rev() {
            state = state.wrapping_mul(0xD134_2543_DE82_EF95);
            let other = ((state >> 32) * (last as u64 + 1)) >> 32;
            self.pairs.swap(last, other as usize);
        }
    }

    fn bounce(&mut self, pair: Pair) {
        if left_out(Mutation::BallCollision) {
            return;
        }
        let (a, b) = (pair.looker as usize, pair.seen as usize);
        let both = self.rules.collision == Collision::Pairwise;
        // A ball that another pair's chain of events has laid to rest or let go meanwhile is looked at again next step.
        if self.hit.contains(a) || self.resting[a] || (both && self.hit.contains(b)) {
            return;
        }
        self.strike(a, b, pair.approach2, self.direction[a]);
    }

    /// Ball a runs into ball b along `direction`; b may rest, then it is let go first.
    pub(super) fn strike(&mut self, a: usize, b: usize, approach2: i64, direction: Direction) {
        let jump = self.jump(approach2);
        if jump == 0 {
            return;
        }
        self.hit.insert(a);
        let old = self.velocity(a);
        let impulse = direction.times(-jump);
        let meant = old.plus(impulse);
        if self.rules.collision == Collision::Pairwise {
            self.tally.collision += jump * (approach2 - 2 * jump);
            self.push(b, direction.times(jump));
        } else {
            let gain = (meant.square4() - old.square4()) / 4 + self.scale.gravity / 2 * impulse.k;
            self.tally.rule = self.tally.rule.plus(impulse);
            self.tally.rules -= gain;
        }
        let speed = direction.along4(meant) / 4;
        if speed < 0 {
            let back = self.rebound_direction(a, direction.opposite());
            self.redirect(a, meant, back, -speed);
        } else {
            self.redirect(a, meant, direction, speed);
        }
    }

    /// Speed that changes hands in a collision, a multiple of the quantum: (1 + e) / 2 of the approach speed, cut down, but
    /// never so little that the pair goes on approaching.
    fn jump(&self, approach2: i64) -> i64 {
        let quantum = self.scale.quantum;
        let jump = (approach2 + self.rules.ball.of(approach2)) / 4;
        let cut = jump - jump % quantum;
        // Any jump up to the approach speed loses energy; beyond, it would make some.
        if 4 * cut >= approach2 || 2 * (cut + quantum) > approach2 { cut } else { cut + quantum }
    }

    /// Ball b gets an impulse from a collision that another ball saw.
    fn push(&mut self, b: usize, impulse: Vector) {
        if self.resting[b] {
            self.release_above(b);
        }
        self.hit.insert(b);
        let meant = self.velocity(b).plus(impulse);
        let direction = Direction::nearest(meant);
        let speed = self.scale.cut(direction.along4(meant) / 4);
        self.redirect(b, meant, direction, speed);
    }

    fn rebound_direction(&mut self, a: usize, back: Direction) -> Direction {
        if !self.rules.rebound_scatter {
            return back;
        }
        match self.rebound_word(a) >> 62 {
            0 => back.clockwise(),
            1 => back.counter_clockwise(),
            _ => back,
        }
    }

    /// A random word for this ball's rebound: one word a step from the counter-based generator, mixed with the ball's
    /// number (finaliser of SplitMix64), because a jammed bed rebounds fifty times a step.
    fn rebound_word(&mut self, a: usize) -> u64 {
        if self.lot.0 != self.step + 1 {
            let word = words(self.rules.seed, Purpose::Rebound, 0, self.step);
            self.lot = (self.step + 1, u64::from(word[0]) << 32 | u64::from(word[1]));
        }
        let mut z = self.lot.1.wrapping_add((a as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
}
