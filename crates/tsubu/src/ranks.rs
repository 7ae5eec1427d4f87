//! Ranks: programs that make one run together.
//!
//! Rank and communicator are the words of MPI (Message Passing Interface Forum 1994). Whoever starts the programs brings the communicator;
//! nothing here knows how messages travel.

use std::fmt::Debug;

/// How the ranks of a run talk. All of them call the same functions in the same order; whoever does not is waited for.
pub trait Communicator: Debug + Send + Sync {
    /// The number of this rank, from 0.
    fn rank(&self) -> usize;

    /// How many ranks there are.
    fn size(&self) -> usize;

    /// Sends the message in place `r` to rank `r`, and puts in its place what that rank has sent here. A message to oneself stays.
    fn exchange(&self, messages: &mut [Vec<f64>]) {
        let others: Vec<usize> = (0..self.size()).filter(|rank| *rank != self.rank()).collect();
        self.exchange_while(messages, &others, &mut || false);
    }

    /// The same with some `partners` alone, each of which has this rank among its own; at work while messages are under way: `work` does a part, and
    /// tells whether there is more.
    fn exchange_while(&self, messages: &mut [Vec<f64>], partners: &[usize], work: &mut dyn FnMut() -> bool);

    /// Puts the message of rank 0 in the place of everybody's.
    fn broadcast(&self, message: &mut Vec<f64>);
}

/// What the busiest of several ranks would have of a scene, and what it would send.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RankShare {
    /// Its own grains.
    pub grains: usize,
    /// Messages in a step.
    pub messages: usize,
    /// Bytes in a step, all messages together.
    pub bytes: f64,
    /// Bytes beside these whenever neighbour lists are made anew.
    pub bytes_anew: f64,
}

/// Reads a message in the order in which it was written.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'a>(std::slice::Iter<'a, f64>);

impl<'a> Reader<'a> {
    pub fn new(message: &'a [f64]) -> Self {
        Self(message.iter())
    }

    /// Whether all has been read.
    pub fn is_at_end(&self) -> bool {
        self.0.as_slice().is_empty()
    }

    /// The next number; behind the end there are zeros.
    pub fn number(&mut self) -> f64 {
        self.0.next().copied().unwrap_or_default()
    }

    /// The next numbers; fewer at the end.
    pub fn numbers(&mut self, count: usize) -> &'a [f64] {
        let rest = self.0.as_slice();
        let (now, later) = rest.split_at(count.min(rest.len()));
        self.0 = later.iter();
        now
    }

    /// The next vector.
    pub fn vector(&mut self) -> glam::DVec3 {
        let Some((vector, rest)) = self.0.as_slice().split_first_chunk() else {
            return glam::DVec3::new(self.number(), self.number(), self.number());
        };
        self.0 = rest.iter();
        glam::DVec3::from_array(*vector)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read() {
        let mut reader = Reader::new(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(reader.number(), 1.0);
        assert_eq!(reader.vector(), glam::DVec3::new(2.0, 3.0, 4.0));
        assert!(!reader.is_at_end());
        assert_eq!(reader.numbers(9), [5.0, 6.0]);
        assert!(reader.is_at_end());
    }
}
