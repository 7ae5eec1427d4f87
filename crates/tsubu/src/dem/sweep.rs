//! Sweeps over the blocks, on many threads.
//!
//! A step sweeps twice: contacts, then the completion of the step. Every thread has its share of the blocks, the same in both,
//! so that what it has written stays in its own cache; and the second sweep goes back, so that it begins with what the first has
//! left in the cache. A thread that is done early takes blocks of others, from where they would come to last.

use crate::neighbours::block::BlockList;
use crate::threads::both;

/// What a sweep goes over: one thing or several for every neighbour list.
pub(super) trait BlockRange: Send + Sized {
    /// The lists of its blocks.
    fn lists(&self) -> &[BlockList];
    /// The first `blocks`, and the others.
    fn cut(self, blocks: usize) -> (Self, Self);
}

impl<T: Send> BlockRange for (&mut [T], &[BlockList]) {
    fn lists(&self) -> &[BlockList] {
        self.1
    }

    fn cut(self, blocks: usize) -> (Self, Self) {
        let (things, lists) = (self.0.split_at_mut(blocks), self.1.split_at(blocks));
        ((things.0, lists.0), (things.1, lists.1))
    }
}

/// Which way a thread goes through its share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Forward,
    Backward,
}

/// Runs `work` on every block of a range, in as many shares as there are threads; with one share on this thread alone.
pub(super) fn sweep<R: BlockRange>(range: R, direction: Direction, shares: usize, work: &(impl Fn(R) + Sync)) {
    if shares <= 1 {
        return walk(range, direction, false, work);
    }
    share(range, direction, shares, work);
}

/// Cuts a range in shares of equal work.
fn share<R: BlockRange>(range: R, direction: Direction, shares: usize, work: &(impl Fn(R) + Sync)) {
    if shares == 1 || range.lists().len() <= 1 {
        return walk(range, direction, true, work);
    }
    let left = shares / 2;
    let blocks = first_blocks(range.lists(), left, shares);
    let (first, others) = range.cut(blocks);
    both(|| share(first, direction, left, work), || share(others, direction, shares - left, work));
}

/// How many blocks are `left` of `shares` equal shares of the work; a block belongs where most of it does.
fn first_blocks(lists: &[BlockList], left: usize, shares: usize) -> usize {
    let all: usize = lists.iter().map(|list| list.work).sum();
    let mut before = 0;
    let belongs = |list: &&BlockList| {
        let middle = before + list.work / 2;
        before += list.work;
        middle * shares < all * left
    };
    lists.iter().take_while(belongs).count()
}

/// Goes through a range block by block; where it is `lent`, other threads may take a part of what is left.
fn walk<R: BlockRange>(range: R, direction: Direction, lent: bool, work: &(impl Fn(R) + Sync)) {
    let blocks = range.lists().len();
    if blocks <= 1 {
        if blocks == 1 {
            work(range);
        }
        return;
    }
    let (low, high) = range.cut(blocks / 2);
    let (next, later) = if direction == Direction::Forward { (low, high) } else { (high, low) };
    let (next, later) = (|| walk(next, direction, lent, work), || walk(later, direction, lent, work));
    if lent {
        both(next, later);
    } else {
        next();
        later();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;
    use std::sync::Mutex;

    fn lists(works: &[usize]) -> Vec<BlockList> {
        works.iter().enumerate().map(|(first, &work)| BlockList { first, work, ..BlockList::default() }).collect()
    }

    /// The blocks in the order in which they come.
    fn order(lists: &[BlockList], direction: Direction, shares: usize) -> Vec<usize> {
        let seen = Mutex::new(Vec::new());
        let mut things = vec![(); lists.len()];
        sweep((&mut things[..], lists), direction, shares, &|(_, lists): (&mut [()], &[BlockList])| {
            seen.lock().expect("nobody panics").push(lists[0].first);
        });
        seen.into_inner().expect("nobody panics")
    }

    #[test]
    fn goes_there_and_back() {
        let lists = lists(&[7; 11]);
        let there: Vec<usize> = (0..11).collect();
        assert_eq!(order(&lists, Direction::Forward, 1), there);
        assert_eq!(order(&lists, Direction::Backward, 1), there.into_iter().rev().collect::<Vec<_>>());
    }

    proptest! {
        #[test]
        fn every_block_comes_once_whatever_the_shares(works in vec(0usize..50, 0..30), shares in 1usize..9) {
            let mut seen = order(&lists(&works), Direction::Backward, shares);
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..works.len()).collect::<Vec<_>>());
        }
    }

    /// A cut misses equal shares by half of the block in which it falls; cuts at half of the blocks, here in a bed whose lower
    /// half touches and whose upper does not, miss them by half of all.
    #[test]
    fn shares_are_equal_but_for_half_a_block() {
        let works: Vec<usize> = (0..20).map(|block| if block < 10 { 300 + 2 * block } else { 0 }).collect();
        let lists = lists(&works);
        let (all, largest) = (works.iter().sum::<usize>(), 318);
        for (left, shares) in [(1, 2), (1, 3), (3, 7), (4, 8)] {
            let miss = |blocks: usize| (works[..blocks].iter().sum::<usize>() * shares).abs_diff(all * left);
            assert!(2 * miss(first_blocks(&lists, left, shares)) <= largest * shares, "{left} of {shares}");
        }
        assert!(2 * (works[..10].iter().sum::<usize>() * 2).abs_diff(all) > largest * 2);
    }
}
