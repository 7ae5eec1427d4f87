//! A sweep over the columns of a gas: one step, or two.
//!
//! A column's next state needs its neighbours' present ones, so each is written in its place with a copy of the column before.
//! In a sweep of two steps the second follows one column behind the first, while both are in the nearest caches: the memory gives
//! and takes every column once for two steps. Strips of columns are swept side by side; of what lies beside them they work out for
//! themselves what the second step needs.

use super::bits::WIDE;
use super::chance::Odds;
use super::step::{self, BLOCK, Spec, Walls};
use rayon::prelude::*;

/// Words of a strip of columns: what a thread works off at one go. Long enough that waking it and the columns at the edges
/// cost little.
const WORDS_A_STRIP: usize = 1 << 16;

/// The fewest columns of a strip.
const FEWEST: usize = 16;

/// How the columns of a gas are swept.
#[derive(Clone, Debug)]
pub struct Sweep {
    columns: usize,
    /// Words of a column.
    length: usize,
    /// Columns of a strip.
    strip: usize,
    desks: Vec<Desk>,
}

/// What a strip needs beside its columns.
#[derive(Clone, Debug)]
struct Desk {
    /// Two columns to the left and two to the right of the strip as they were before the sweep, from left to right.
    beside: [Vec<u64>; 4],
    /// The column before the one at work as it was before the first step, and before the second.
    before: [Vec<u64>; 2],
    /// The column at work as it was.
    here: Vec<u64>,
    /// A column beside the strip after the first step.
    edge: Vec<u64>,
    /// Turns that the force made in the strip in the last sweep.
    turns: [u64; 2],
}

/// What is the same for the whole lattice.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// The rules, and how many steps have been done.
    pub spec: Spec,
    /// Sites of walls, and of smooth ones that stand upright and lie flat.
    pub solid: &'a [u64],
    /// Empty where there are none.
    pub smooth: [&'a [u64]; 2],
    /// Rows.
    pub rows: usize,
    /// Whether ends meet, along x and z.
    pub periodic: [bool; 2],
}

impl Field<'_> {
    /// The next state of column `number` after `later` steps of a sweep, into `next`; counts what the force turned.
    fn column(&self, number: usize, later: u64, from: [&[u64]; 3], next: &mut [u64], turns: &mut [u64; 2]) {
        let spec = Spec { step: self.spec.step + later, ..self.spec };
        let words = number * spec.blocks * WIDE..(number + 1) * spec.blocks * WIDE;
        let smooth = self.smooth.map(|plane| plane.get(words.clone()).unwrap_or(&[]));
        let walls = Walls { solid: &self.solid[words], smooth };
        step::column(&spec, number, from, walls, next);
        if spec.force != [Odds::default(); 2] {
            let turned = step::force(&spec, number, walls.solid, next);
            (0..2).for_each(|axis| turns[axis] += turned[axis]);
        }
        step::close(next, spec.blocks, self.rows, self.periodic[1]);
    }
}

impl Sweep {
    /// For so many columns of so many blocks.
    pub fn new(columns: usize, blocks: usize) -> Self {
        let length = (blocks + 2) * BLOCK;
        let strip = (WORDS_A_STRIP / length).max(FEWEST).min(columns);
        let empty = vec![0; length];
        let desk = Desk {
            beside: [0; 4].map(|_| empty.clone()),
            before: [0; 2].map(|_| empty.clone()),
            here: empty.clone(),
            edge: empty,
            turns: [0; 2],
        };
        Self { columns, length, strip, desks: vec![desk; columns.div_ceil(strip)] }
    }

    /// Number of strips.
    #[cfg(test)]
    pub fn strips(&self) -> usize {
        self.desks.len()
    }

    /// Turns that the force made in the last sweep along both axes.
    pub fn turns(&self) -> [u64; 2] {
        self.desks.iter().fold([0; 2], |sum, desk| [sum[0] + desk.turns[0], sum[1] + desk.turns[1]])
    }

    /// The column so many places from the left end, where there is one.
    fn number(&self, place: isize, periodic: bool) -> Option<usize> {
        let columns = self.columns as isize;
        (periodic || (0..columns).contains(&place)).then(|| place.rem_euclid(columns) as usize)
    }

    /// One step, or `two`, of all columns.
    pub fn run(&mut self, field: &Field, now: &mut [u64], two: bool) {
        let (strip, length) = (self.strip, self.length);
        let ends = |index: usize| (index * strip, ((index + 1) * strip).min(self.columns));
        let mut desks = std::mem::take(&mut self.desks);
        for (index, desk) in desks.iter_mut().enumerate() {
            let (first, end) = ends(index);
            let places = [first as isize - 2, first as isize - 1, end as isize, end as isize + 1];
            for (column, place) in desk.beside.iter_mut().zip(places) {
                match self.number(place, field.periodic[0]) {
                    Some(number) => column.copy_from_slice(&now[number * length..(number + 1) * length]),
                    None => column.fill(0),
                }
            }
            desk.turns = [0; 2];
        }
        let work = |(index, (columns, desk)): (usize, (&mut [u64], &mut Desk))| {
            let (first, end) = ends(index);
            let left = self.number(first as isize - 1, field.periodic[0]);
            let right = self.number(end as isize, field.periodic[0]);
            desk.sweep(field, first, columns, two.then_some([left, right]));
        };
        if desks.len() == 1 {
            work((0, (now, &mut desks[0])));
        } else {
            now.par_chunks_mut(strip * length).zip(desks.par_iter_mut()).enumerate().for_each(work);
        }
        self.desks = desks;
    }
}

impl Desk {
    /// Sweeps a strip from column `first` on. With `edges`, the numbers of the columns beside it if there are any, two steps.
    fn sweep(&mut self, field: &Field, first: usize, strip: &mut [u64], edges: Option<[Option<usize>; 2]>) {
        let Self { beside: [left2, left, right, right2], before: [before, before2], here, edge, turns } = self;
        let length = here.len();
        let count = strip.len() / length;
        let unseen = &mut [0; 2];
        before.copy_from_slice(left);
        match edges.and_then(|[left, _]| left) {
            Some(number) => field.column(number, 0, [left2, left, &strip[..length]], before2, unseen),
            None => before2.fill(0),
        }
        for i in 0..count {
            let (done, rest) = strip.split_at_mut(i * length);
            let (column, after) = rest.split_at_mut(length);
            here.copy_from_slice(column);
            let next = if i + 1 == count { right.as_slice() } else { &after[..length] };
            field.column(first + i, 0, [before, here, next], column, turns);
            std::mem::swap(before, here);
            if edges.is_some() && i > 0 {
                let behind = &mut done[(i - 1) * length..];
                here.copy_from_slice(behind);
                field.column(first + i - 1, 1, [before2, here, column], behind, turns);
                std::mem::swap(before2, here);
            }
        }
        if let Some([_, right_edge]) = edges {
            match right_edge {
                Some(number) => field.column(number, 0, [before, right, right2], edge, unseen),
                None => edge.fill(0),
            }
            let last = &mut strip[(count - 1) * length..];
            here.copy_from_slice(last);
            field.column(first + count - 1, 1, [before2, here, edge], last, turns);
        }
    }
}
