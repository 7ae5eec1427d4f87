//! A counting sort on many threads.
//!
//! The things are cut into pieces, and the cells into ranges of cells. First every piece sorts what it has by range, then every
//! range takes from all pieces what belongs to it, and sorts that by cell. Each thing comes out where one thread alone would
//! have put it, however many pieces and ranges there are.

use crate::threads;
use std::ops::Range;

/// Pieces, and ranges of cells, for each thread: some have much and others nothing.
const PARTS: usize = 8;

/// Memory of the sort.
#[derive(Clone, Debug, Default)]
pub struct CellSort {
    pieces: Vec<Piece>,
}

/// Some of the things, sorted by range of cells.
#[derive(Clone, Debug, Default)]
struct Piece {
    things: Range<u32>,
    /// Cell and thing.
    sorted: Vec<[u32; 2]>,
    /// Where each range of cells begins in `sorted`; one more than ranges.
    begin: Vec<u32>,
}

/// What a range of cells gets.
struct CellRange<'a> {
    number: usize,
    first_cell: u32,
    /// How many things are in cells before.
    before: u32,
    start: &'a mut [u32],
    members: &'a mut [u32],
}

impl CellSort {
    /// Sorts `things` numbers from 0 on by their cells of so many, on as many threads as there are `shares`; what has no cell is
    /// left out. Leaves in `members` the numbers, rising within a cell, and in `start` the first entry of each cell and the end.
    pub fn sort(
        &mut self,
        (things, cells): (usize, usize),
        shares: usize,
        cell_of: &(impl Fn(u32) -> Option<u32> + Sync),
        start: &mut Vec<u32>,
        members: &mut Vec<u32>,
    ) {
        let parts = if shares > 1 { PARTS * shares } else { 1 };
        let width = cells.div_ceil(parts).next_power_of_two();
        let ranges = cells.div_ceil(width);
        self.pieces.resize_with(parts, Piece::default);
        for (k, piece) in self.pieces.iter_mut().enumerate() {
            piece.things = (things * k / parts) as u32..(things * (k + 1) / parts) as u32;
        }
        threads::each(&mut self.pieces, shares, |piece| piece.sort(ranges, width.trailing_zeros(), cell_of));
        let pieces = &self.pieces;
        members.resize(pieces.iter().map(|piece| piece.sorted.len()).sum(), 0);
        start.resize(cells + 1, 0);
        start[cells] = members.len() as u32;
        let (mut starts, mut rest, mut before) = (&mut start[..cells], &mut members[..], 0);
        let of = |number: usize| {
            let (start, members);
            (start, starts) = std::mem::take(&mut starts).split_at_mut(width.min(cells - number * width));
            let own: usize = pieces.iter().map(|piece| piece.of(number).len()).sum();
            (members, rest) = std::mem::take(&mut rest).split_at_mut(own);
            let range = CellRange { number, first_cell: (number * width) as u32, before, start, members };
            before += own as u32;
            range
        };
        let mut ranges: Vec<CellRange> = (0..ranges).map(of).collect();
        threads::each(&mut ranges, shares, |range| range.fill(pieces));
    }
}

impl Piece {
    fn sort(&mut self, ranges: usize, shift: u32, cell_of: &impl Fn(u32) -> Option<u32>) {
        let Self { things, sorted, begin } = self;
        // One entry more, so that the next free place of a range can stand behind its begin until all are filled.
        begin.clear();
        begin.resize(ranges + 2, 0);
        for cell in things.clone().filter_map(cell_of) {
            begin[(cell >> shift) as usize + 2] += 1;
        }
        for i in 2..ranges + 2 {
            begin[i] += begin[i - 1];
        }
        sorted.resize(begin[ranges + 1] as usize, [0; 2]);
        for (cell, thing) in things.filter_map(|thing| Some((cell_of(thing)?, thing))) {
            let next = &mut begin[(cell >> shift) as usize + 1];
            sorted[*next as usize] = [cell, thing];
            *next += 1;
        }
        begin.pop();
    }

    fn of(&self, range: usize) -> &[[u32; 2]] {
        &self.sorted[self.begin[range] as usize..self.begin[range + 1] as usize]
    }
}

impl CellRange<'_> {
    fn fill(&mut self, pieces: &[Piece]) {
        let Self { number, first_cell, before, start, members } = self;
        let all = || pieces.iter().flat_map(|piece| piece.of(*number));
        start.fill(0);
        for [cell, _] in all() {
            start[(cell - *first_cell) as usize] += 1;
        }
        let mut next = *before;
        for first in start.iter_mut() {
            next += std::mem::replace(first, next);
        }
        for [cell, thing] in all() {
            let next = &mut start[(cell - *first_cell) as usize];
            members[(*next - *before) as usize] = *thing;
            *next += 1;
        }
        // Each cell's next free place is now where the next cell begins.
        start.copy_within(..start.len() - 1, 1);
        start[0] = *before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::option::of;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn things_come_out_as_one_thread_sorts_them(cells in vec(of(0u32..37), 0..300), shares in 1usize..6) {
            let (mut sort, mut start, mut members) = (CellSort::default(), Vec::new(), Vec::new());
            sort.sort((cells.len(), 37), shares, &|thing| cells[thing as usize], &mut start, &mut members);
            let mut expected: Vec<u32> = (0..cells.len() as u32).filter(|i| cells[*i as usize].is_some()).collect();
            expected.sort_by_key(|i| cells[*i as usize]);
            prop_assert_eq!(&members, &expected);
            for cell in 0..37u32 {
                let own = &members[start[cell as usize] as usize..start[cell as usize + 1] as usize];
                prop_assert!(own.iter().all(|i| cells[*i as usize] == Some(cell)));
            }
            prop_assert_eq!((start.len(), start[0], start[37] as usize), (38, 0, expected.len()));
        }
    }
}
