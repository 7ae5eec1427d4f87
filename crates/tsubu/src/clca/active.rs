//! The active rule: a grain moves if there is room.
//!
//! Every grain finds its provisional direction from where all are at the beginning of the step: straight down, else the
//! side that it prefers, else the other. Grains then move one after the other, in the order of [`rank`] with ties drawn,
//! and look again: whose way has been taken tries its other directions, or rests.
//!
//! A grain that cannot move sleeps until a point beside it is left, so a step costs only what moves. Many movers of one rank take
//! their turns in strips of the lattice, side by side; ties are then drawn within a strip.

use super::bed::{Bed, GrainKind, Grains, NOWHERE};
use super::order::{Pull, rank};
use super::strips::{Strips, Window};
use crate::lattice::direction::Direction;
use crate::lattice::grid::{EMPTY, Numbering};
use crate::lattice::shape::Stencil;
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
    /// Rank, parity and number of its strip, and a random number.
    key: u64,
    grain: u32,
    wish: Wish,
    preference: [Direction; 3],
}

/// Bits of a key below the rank: one for the parity, 28 for the strip, 32 drawn.
const RANK: u32 = 61;
const PARITY: u32 = 60;
const STRIP: u32 = 32;

/// What came of the turns of a strip.
#[derive(Clone, Debug, Default)]
struct Outcome {
    /// Grains and what they have done.
    done: Vec<(u32, Option<Wish>)>,
    /// Grains to look at in the next step.
    woken: Vec<u32>,
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
        self.list = list;
        self.list.clear();
        let strips = Strips::new(bed, turns.len());
        turns.par_iter_mut().with_min_len(WORTH_A_THREAD).for_each(|turn| {
            let strip = strips.of(bed.grid.column_and_row(bed.grains.cell[turn.grain as usize] as usize).0);
            turn.key |= (strips.turn(strip) as u64) << PARITY | (strip as u64) << STRIP;
        });
        turns.par_sort_unstable_by_key(|turn| (turn.key, turn.grain));
        let mut moved = 0;
        for together in turns.chunk_by(|a, b| a.key >> PARITY == b.key >> PARITY) {
            let rows: Vec<&[Turn]> = together.chunk_by(|a, b| a.key >> STRIP == b.key >> STRIP).collect();
            let numbers = rows.iter().map(|row| (row[0].key >> STRIP) as usize & ((1 << (PARITY - STRIP)) - 1));
            let Bed { grid, grains, kinds, stencils, .. } = &mut *bed;
            let movers = Movers { numbering: grid.numbering(), grains, kinds, stencils };
            let take = |(turns, mut window): (&[Turn], Window)| movers.take_turns(turns, &mut window, pull);
            let windows = strips.windows(grid, numbers);
            let outcomes: Vec<Outcome> = rows.into_par_iter().zip(windows).map(take).collect();
            for Outcome { done, woken } in outcomes {
                for (grain, wish) in done {
                    moved += usize::from(wish.is_some());
                    bed.act(grain as usize, wish);
                }
                for grain in woken {
                    self.wake(grain);
                }
            }
        }
        self.turns = turns;
        bed.step += 1;
        moved
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
        let at = |cell: usize| bed.grid.at(cell);
        let movers = Movers::of(bed);
        let here = movers.stand(i, 0);
        let turned = || if self.turning { movers.way_to_turn(at, i, preference, word[2] & 1 == 1) } else { None };
        let wish = preference.into_iter().find(|&d| here.room(at, d)).map(Wish::Move).or_else(turned)?;
        let rank = match wish {
            Wish::Move(direction) => rank(direction, bed.grains.last[i], Some(pull)),
            Wish::Turn(_) => 4,
        };
        Some(Turn { key: rank << RANK | u64::from(word[0]), grain, wish, preference })
    }

    fn wake(&mut self, grain: u32) {
        if !self.awake[grain as usize] {
            self.awake[grain as usize] = true;
            self.list.push(grain);
        }
    }
}

impl Bed {
    /// A grain has done something; its points are painted already.
    fn act(&mut self, grain: usize, wish: Option<Wish>) {
        let went = match wish {
            Some(Wish::Move(direction)) => {
                let cell = self.grains.cell[grain] as usize;
                self.grains.cell[grain] = self.grid.neighbour(cell, self.odd(cell), direction) as u32;
                Some(direction)
            }
            Some(Wish::Turn(by)) => {
                self.grains.turn[grain] = (self.grains.turn[grain] + by) % self.kind(grain).orientations;
                None
            }
            None => None,
        };
        self.note(grain, went);
    }
}

/// What those who take their turns know of the bed, besides their piece of the lattice.
#[derive(Clone, Copy)]
struct Movers<'a> {
    numbering: Numbering,
    /// As they were at the beginning of the step: nobody takes two turns.
    grains: &'a Grains,
    kinds: &'a [GrainKind],
    stencils: &'a [Stencil],
}

impl<'a> Movers<'a> {
    fn of(bed: &'a Bed) -> Self {
        Self { numbering: bed.grid.numbering(), grains: &bed.grains, kinds: &bed.kinds, stencils: &bed.stencils }
    }

    /// Lets grains act, one after the other.
    fn take_turns(&self, turns: &[Turn], window: &mut Window, pull: Pull) -> Outcome {
        let mut outcome = Outcome { done: Vec::with_capacity(turns.len()), woken: Vec::with_capacity(turns.len()) };
        for turn in turns {
            let here = self.stand(turn.grain as usize, 0);
            let wish = self.wish_again(window, &here, turn);
            outcome.done.push((turn.grain, wish));
            outcome.woken.push(turn.grain);
            match wish {
                Some(Wish::Move(direction)) => {
                    here.shift(window, turn.grain, direction);
                    self.wake_behind(window, &here, direction, pull, &mut outcome.woken);
                }
                Some(Wish::Turn(by)) => self.turn(window, turn.grain, by),
                None => {}
            }
        }
        outcome
    }

    fn kind(&self, grain: usize) -> &'a GrainKind {
        &self.kinds[self.grains.kind[grain] as usize]
    }

    /// Where a grain is, and its shape turned by so many times 60 degrees more.
    #[inline]
    fn stand(&self, grain: usize, by: u8) -> Stand<'a> {
        let cell = self.grains.cell[grain] as usize;
        let kind = self.kind(grain);
        let mut turned = self.grains.turn[grain] + by;
        if turned >= kind.orientations {
            turned -= kind.orientations;
        }
        Stand {
            cell,
            odd: self.numbering.column_and_row(cell).0 & 1,
            stencil: &self.stencils[kind.stencil + turned as usize],
        }
    }

    /// Turns the points of a grain.
    fn turn(&self, window: &mut Window, grain: u32, by: u8) {
        for (by, content) in [(0, EMPTY), (by, grain as i32)] {
            let here = self.stand(grain as usize, by);
            for &offset in &here.stencil.points[here.odd] {
                window.set(here.cell.wrapping_add_signed(offset), content);
            }
        }
    }

    /// Names those who could move into the points that a grain has left.
    fn wake_behind(&self, window: &Window, here: &Stand, direction: Direction, pull: Pull, woken: &mut Vec<u32>) {
        let against = [pull.straight, pull.sides[0], pull.sides[1]].map(Direction::opposite);
        for &offset in &here.stencil.behind[here.odd][direction as usize] {
            let left = here.cell.wrapping_add_signed(offset);
            let odd = self.numbering.column_and_row(left).0 & 1;
            for d in against {
                let owner = window.at(self.numbering.neighbour(left, odd, d));
                if owner >= 0 {
                    woken.push(owner as u32);
                }
            }
        }
    }

    /// What a grain does now that others have moved: what it meant to, else the first of its directions that is free.
    #[inline]
    fn wish_again(&self, window: &Window, here: &Stand, turn: &Turn) -> Option<Wish> {
        let at = |cell: usize| window.at(cell);
        let still = match turn.wish {
            Wish::Move(direction) => here.room(at, direction),
            Wish::Turn(by) => self.opens(at, turn.grain as usize, by, turn.preference),
        };
        let others = || turn.preference.into_iter().find(|&d| here.room(at, d)).map(Wish::Move);
        if still { Some(turn.wish) } else { others() }
    }

    /// The turn, to one side or the other as the coin says, after which the grain can move.
    fn way_to_turn(
        &self,
        at: impl Fn(usize) -> i32 + Copy,
        grain: usize,
        preference: [Direction; 3],
        coin: bool,
    ) -> Option<Wish> {
        let orientations = self.kind(grain).orientations;
        if orientations == 1 {
            return None;
        }
        let ways = if coin { [1, orientations - 1] } else { [orientations - 1, 1] };
        ways.into_iter().find(|&by| self.opens(at, grain, by, preference)).map(Wish::Turn)
    }

    /// Whether there is room to turn, and for a move after that.
    fn opens(&self, at: impl Fn(usize) -> i32, grain: usize, by: u8, preference: [Direction; 3]) -> bool {
        let Stand { cell, odd, stencil } = self.stand(grain, by);
        // Its own points are free to it.
        let free = |offset: &isize| {
            let content = at(cell.wrapping_add_signed(*offset));
            content == EMPTY || content == grain as i32
        };
        stencil.points[odd].iter().all(free)
            && preference.iter().any(|&d| stencil.ahead[odd][d as usize].iter().all(free))
    }
}

/// Where a grain is, and its shape.
struct Stand<'a> {
    cell: usize,
    /// Parity of its column.
    odd: usize,
    stencil: &'a Stencil,
}

impl Stand<'_> {
    /// Whether there is room to move by one spacing: only the points that would be taken are looked at.
    #[inline]
    fn room(&self, at: impl Fn(usize) -> i32, direction: Direction) -> bool {
        let ahead = &self.stencil.ahead[self.odd][direction as usize];
        ahead.iter().all(|&offset| at(self.cell.wrapping_add_signed(offset)) == EMPTY)
    }

    /// Moves the points by one spacing.
    #[inline]
    fn shift(&self, window: &mut Window, grain: u32, direction: Direction) {
        for &offset in &self.stencil.ahead[self.odd][direction as usize] {
            let taken = self.cell.wrapping_add_signed(offset);
            debug_assert_eq!(window.at(taken), EMPTY, "grain {grain} takes a point that is not free");
            window.set(taken, grain as i32);
        }
        for &offset in &self.stencil.behind[self.odd][direction as usize] {
            window.set(self.cell.wrapping_add_signed(offset), EMPTY);
        }
    }
}
