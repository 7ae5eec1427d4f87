//! Numbers of all ranks in one place.

use super::Ranks;
use crate::ranks::Reader;
use std::ops::Range;

/// Blocks that are told of at once.
const AT_ONCE: usize = 16;

impl Ranks {
    /// What all ranks have, in the order of the ranks; `mine` alone where there is but one.
    pub fn gather(&self, mine: Vec<f64>) -> Vec<f64> {
        let Some(all) = &self.communicator else { return mine };
        let mut messages = vec![mine; all.size()];
        all.exchange(&mut messages);
        messages.concat()
    }

    /// Brings to the first rank what all have of their blocks, rank by rank and in parts: all at once is large. `write` makes the message of some own
    /// blocks, and the first rank reads them in the order of blocks.
    pub fn tell_first(
        &self,
        own: Range<usize>,
        mut write: impl FnMut(Range<usize>, &mut Vec<f64>),
        mut read: impl FnMut(&mut Reader),
    ) {
        let mut messages = vec![Vec::new(); self.seams.len().max(1)];
        let all = self.communicator.as_ref();
        for rank in 0..messages.len() {
            let (mine, first) = (rank == self.rank(), self.is_first());
            if !mine && !first {
                continue;
            }
            let blocks = if mine { own.clone() } else { self.blocks(rank) };
            let partner = if first { rank } else { 0 };
            for begin in blocks.clone().step_by(AT_ONCE) {
                messages[partner].clear();
                if mine {
                    write(begin..(begin + AT_ONCE).min(blocks.end), &mut messages[partner]);
                }
                if let Some(all) = all.filter(|_| rank > 0) {
                    all.exchange_while(&mut messages, &[partner], &mut || false);
                }
                if first {
                    read(&mut Reader::new(&messages[partner]));
                }
            }
        }
    }
}
