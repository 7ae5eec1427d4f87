//! Sweeps over the blocks, on many threads.
//!
//! A step sweeps twice: contacts, then the completion of the step. Every thread has its share of the blocks, the same in both,
//! so that what it has written stays in its own cache; and the second sweep goes back, so that it begins with what the first has
//! left in the cache. A thread that is done early takes blocks of others, from where they would come to last.

use crate::find::candidates::List;

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
    let all: usize = row.lists().iter().map(|list| list.work).sum();
    let mut before = 0;
    // A block belongs where most of it does.
    let first = row.lists().iter().take_while(|list| {
        let middle = before + list.work / 2;
        before += list.work;
        middle * shares < all * left
    });
    let blocks = first.count();
    let (first, others) = row.cut(blocks);
    rayon::join(|| share(first, way, left, work), || share(others, way, shares - left, work));
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
        rayon::join(next, later);
    } else {
        next();
        later();
    }
}
