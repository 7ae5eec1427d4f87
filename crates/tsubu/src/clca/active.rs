//! The active rule: a grain moves if there is room.
//!
//! Every grain finds its provisional direction from where all are at the beginning of the step: straight down, else the
//! side that it prefers, else the other. Grains then move one after the other, in the order of [`rank`] with ties drawn,
//! and look again: whose way has been taken tries its other directions, or rests.
//!
//! A grain that cannot move sleeps until a point beside it is left, so a step costs only what moves.

use super::bed::{Bed, NOWHERE};
use super::order::{Pull, rank};
use crate::lattice::direction::Direction;
use crate::lattice::grid::EMPTY;
use crate::random::{Purpose, words};
use rayon::prelude::*;

/// Grains that a thread looks at in one go: a look takes a tenth of a microsecond.
const WORTH_A_THREAD: usize = 1024;

/// What a grain means to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wish {
    Move(Direction),
    /// Turn clockwise by that many times 60 degrees.
    Turn(u8),
}

/// A grain that means to do something, and when its turn comes.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Rank, then a random number.
    key: u64,
    grain: u32,
    wish: Wish,
    preference: [Direction; 3],
}

/// Who may be able to move.
#[derive(Clone, Debug, Default)]
pub struct Active {
    /// Grains to look at in the next step, each once.
    list: Vec<u32>,
    awake: Vec<bool>,
    plans: Vec<Option<Turn>>,
    turns: Vec<Turn>,
    /// The way gravity pulled in the last step.
    pull: Option<Pull>,
    /// Grains that cannot move may turn.
    pub turning: bool,
    /// Look at every grain in every step: slow, the same bits; for tests. Turning needs it, as it looks farther than a
    /// sleeping grain would notice.
    pub everywhere: bool,
}

impl Active {
    /// Wakes every grain: something else than a move of a grain has changed.
    pub fn wake_all(&mut self, bed: &Bed) {
        self.awake.clear();
        self.awake.resize(bed.len(), false);
        self.list.clear();
        let free = bed.present().filter(|&grain| bed.kind(grain).free);
        self.list.extend(free.map(|grain| grain as u32));
        for &grain in &self.list {
            self.awake[grain as usize] = true;
        }
    }

    /// One step. Returns how many grains moved or turned.
    pub fn step(&mut self, bed: &mut Bed, pull: Pull) -> usize {
        if self.pull != Some(pull) || self.everywhere || self.turning || self.awake.len() != bed.len() {
            self.wake_all(bed);
        }
        self.pull = Some(pull);
        bed.motion.fill(super::bed::Motion::default());
        let list = std::mem::take(&mut self.list);
        let mut turns = std::mem::take(&mut self.turns);
        turns.clear();
        for &grain in &list {
            self.awake[grain as usize] = false;
        }
        // A plan is made from where all are now, so any thread may make it.
        let mut plans = std::mem::take(&mut self.plans);
        let (this, shown) = (&*self, &*bed);
        let plan = |&grain: &u32| this.provisional(shown, grain, pull);
        list.par_iter().with_min_len(WORTH_A_THREAD).map(plan).collect_into_vec(&mut plans);
        for (&grain, turn) in list.iter().zip(&plans) {
            match turn {
                Some(turn) => turns.push(*turn),
                None => bed.note(grain as usize, None),
            }
        }
        self.plans = plans;
        turns.par_sort_unstable_by_key(|turn| (turn.key, turn.grain));
        self.list = list;
        self.list.clear();
        let mut done = 0;
        for turn in &turns {
            self.wake(turn.grain);
            let grain = turn.grain as usize;
            match wish_again(bed, turn) {
                Some(Wish::Move(direction)) => {
                    done += 1;
                    let left = shift(bed, grain, direction);
                    bed.note(grain, Some(direction));
                    self.wake_behind(bed, left, grain, direction, pull);
                }
                Some(Wish::Turn(by)) => {
                    done += 1;
                    bed.paint(grain, EMPTY);
                    bed.grains.turn[grain] = (bed.grains.turn[grain] + by) % bed.kind(grain).orientations;
                    bed.paint(grain, grain as i32);
                    bed.note(grain, None);
                }
                None => bed.note(grain, None),
            }
        }
        self.turns = turns;
        bed.step += 1;
        done
    }

    /// What a grain would do if the others stayed where they are.
    fn provisional(&self, bed: &Bed, grain: u32, pull: Pull) -> Option<Turn> {
        let i = grain as usize;
        if bed.grains.cell[i] == NOWHERE {
            return None;
        }
        let word = words(bed.seed, Purpose::Move, grain, bed.step);
        let lean = bed.grains.past[i].lean(bed.memory);
        let preference = pull.preference(lean, word[1] & 1 == 1);
        let turned = || if self.turning { way_to_turn(bed, i, preference, word[2] & 1 == 1) } else { None };
        let wish = preference.into_iter().find(|&d| room(bed, i, d)).map(Wish::Move).or_else(turned)?;
        let rank = match wish {
            Wish::Move(direction) => rank(direction, bed.grains.last[i], Some(pull)),
            Wish::Turn(_) => 4,
        };
        Some(Turn { key: rank << 32 | u64::from(word[0]), grain, wish, preference })
    }

    fn wake(&mut self, grain: u32) {
        if !self.awake[grain as usize] {
            self.awake[grain as usize] = true;
            self.list.push(grain);
        }
    }

    /// Wakes those who could move into the points that a grain has left.
    fn wake_behind(&mut self, bed: &Bed, start: usize, grain: usize, direction: Direction, pull: Pull) {
        let against = [pull.straight, pull.sides[0], pull.sides[1]].map(Direction::opposite);
        for &offset in &bed.stencil(grain).behind[bed.odd(start)][direction as usize] {
            let left = start.wrapping_add_signed(offset);
            let odd = bed.odd(left);
            for d in against {
                let owner = bed.grid.at(bed.grid.neighbour(left, odd, d));
                if owner >= 0 {
                    self.wake(owner as u32);
                }
            }
        }
    }
}

/// Whether a grain has room to move by one spacing: only the points it would take are looked at.
#[inline]
fn room(bed: &Bed, grain: usize, direction: Direction) -> bool {
    let cell = bed.grains.cell[grain] as usize;
    let ahead = &bed.stencil(grain).ahead[bed.odd(cell)][direction as usize];
    ahead.iter().all(|&offset| bed.grid.at(cell.wrapping_add_signed(offset)) == EMPTY)
}

/// Moves a grain by one spacing; returns the cell that it came from.
#[inline]
fn shift(bed: &mut Bed, grain: usize, direction: Direction) -> usize {
    let cell = bed.grains.cell[grain] as usize;
    let odd = bed.odd(cell);
    let stencil = &bed.stencils[bed.kind(grain).stencil + bed.grains.turn[grain] as usize];
    for &offset in &stencil.ahead[odd][direction as usize] {
        let taken = cell.wrapping_add_signed(offset);
        debug_assert_eq!(bed.grid.at(taken), EMPTY, "grain {grain} takes a point that is not free");
        bed.grid.set(taken, grain as i32);
    }
    for &offset in &stencil.behind[odd][direction as usize] {
        bed.grid.set(cell.wrapping_add_signed(offset), EMPTY);
    }
    bed.grains.cell[grain] = bed.grid.neighbour(cell, odd, direction) as u32;
    cell
}

/// What a grain does now that others have moved: what it meant to, else the first of its directions that is free.
fn wish_again(bed: &Bed, turn: &Turn) -> Option<Wish> {
    let grain = turn.grain as usize;
    let still = match turn.wish {
        Wish::Move(direction) => room(bed, grain, direction),
        Wish::Turn(by) => opens(bed, grain, by, turn.preference),
    };
    let others = || turn.preference.into_iter().find(|&d| room(bed, grain, d)).map(Wish::Move);
    if still { Some(turn.wish) } else { others() }
}

/// The turn, to one side or the other as the coin says, after which the grain can move.
fn way_to_turn(bed: &Bed, grain: usize, preference: [Direction; 3], coin: bool) -> Option<Wish> {
    let orientations = bed.kind(grain).orientations;
    if orientations == 1 {
        return None;
    }
    let ways = if coin { [1, orientations - 1] } else { [orientations - 1, 1] };
    ways.into_iter().find(|&by| opens(bed, grain, by, preference)).map(Wish::Turn)
}

/// Whether there is room to turn, and for a move after that.
fn opens(bed: &Bed, grain: usize, by: u8, preference: [Direction; 3]) -> bool {
    let cell = bed.grains.cell[grain] as usize;
    let odd = bed.odd(cell);
    let kind = bed.kind(grain);
    let turned = &bed.stencils[kind.stencil + ((bed.grains.turn[grain] + by) % kind.orientations) as usize];
    // Its own points are free to it.
    let free = |offset: &isize| {
        let content = bed.grid.at(cell.wrapping_add_signed(*offset));
        content == EMPTY || content == grain as i32
    };
    turned.points[odd].iter().all(free) && preference.iter().any(|&d| turned.ahead[odd][d as usize].iter().all(free))
}
