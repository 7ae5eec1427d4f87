//! Sweeps over the blocks, on many threads.
//!
//! A step sweeps twice: contacts, then the completion of the step. Every thread has its share of the blocks, the same in both,
//! so that what it has written stays in its own cache; and the second sweep goes back, so that it begins with what the first has
//! left in the cache. A thread that is done early takes blocks of others, from where they would come to last.

use crate::find::candidates::List;
use crate::threads::both;

/// What a sweep goes over: one thing or several for every list of candidates.
pub(super) trait Row: Send + Sized {
    /// The lists of its blocks.
    fn lists(&self) -> &[List];
    /// The first `blocks`, and the others.
    fn cut(self, blocks: usize) -> (Self, Self);
}

impl<T: Send> Row for (&mut [T], &[List]) {
    fn lists(&self) -> &[List] {
        self.1
    }

    fn cut(self, blocks: usize) -> (Self, Self) {
        let (things, lists) = (self.0.split_at_mut(blocks), self.1.split_at(blocks));
        ((things.0, lists.0), (things.1, lists.1))
    }
}

/// Which way a thread goes through its share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    There,
    Back,
}

/// Runs `work` on every block of a row, in as many shares as there are threads; with one share on this thread alone.
pub(super) fn sweep<R: Row>(row: R, way: Way, shares: usize, work: &(impl Fn(R) + Sync)) {
    if shares <= 1 {
        return walk(row, way, false, work);
    }
    share(row, way, shares, work);
}

/// Cuts a row in shares of equal work.
fn share<R: Row>(row: R, way: Way, shares: usize, work: &(impl Fn(R) + Sync)) {
    if shares == 1 || row.lists().len() <= 1 {
        return walk(row, way, true, work);
    }
    let left = shares / 2;
    let blocks = first_blocks(row.lists(), left, shares);
    let (first, others) = row.cut(blocks);
    both(|| share(first, way, left, work), || share(others, way, shares - left, work));
}

/// How many blocks are `left` of `shares` equal shares of the work; a block belongs where most of it does.
fn first_blocks(lists: &[List], left: usize, shares: usize) -> usize {
    let all: usize = lists.iter().map(|list| list.work).sum();
    let mut before = 0;
    let belongs = |list: &&List| {
        let middle = before + list.work / 2;
        before += list.work;
        middle * shares < all * left
    };
    lists.iter().take_while(belongs).count()
}

/// Goes through a row block by block; where it is `lent`, other threads may take a part of what is left.
fn walk<R: Row>(row: R, way: Way, lent: bool, work: &(impl Fn(R) + Sync)) {
    let blocks = row.lists().len();
    if blocks <= 1 {
        if blocks == 1 {
            work(row);
        }
        return;
    }
    let (low, high) = row.cut(blocks / 2);
    let (next, later) = if way == Way::There { (low, high) } else { (high, low) };
    let (next, later) = (|| walk(next, way, lent, work), || walk(later, way, lent, work));
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

    fn lists(works: &[usize]) -> Vec<List> {
        works.iter().enumerate().map(|(first, &work)| List { first, work, ..List::default() }).collect()
    }

    /// The blocks in the order in which they come.
    fn order(lists: &[List], way: Way, shares: usize) -> Vec<usize> {
        let seen = Mutex::new(Vec::new());
        let mut things = vec![(); lists.len()];
        sweep((&mut things[..], lists), way, shares, &|(_, lists): (&mut [()], &[List])| {
            seen.lock().expect("nobody panics").push(lists[0].first);
        });
        seen.into_inner().expect("nobody panics")
    }

    #[test]
    fn goes_there_and_back() {
        let lists = lists(&[7; 11]);
        let there: Vec<usize> = (0..11).collect();
        assert_eq!(order(&lists, Way::There, 1), there);
        assert_eq!(order(&lists, Way::Back, 1), there.into_iter().rev().collect::<Vec<_>>());
    }

    proptest! {
        #[test]
        fn every_block_comes_once_whatever_the_shares(works in vec(0usize..50, 0..30), shares in 1usize..9) {
            let mut seen = order(&lists(&works), Way::Back, shares);
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
