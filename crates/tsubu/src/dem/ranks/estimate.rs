//! What a run would send on several ranks, found on one.

use super::{Ranks, cost, cuts};
use crate::neighbours::NeighbourLists;
use crate::neighbours::block::BLOCK;
use crate::ranks::RankShare;

/// Bytes of a number in a message.
const NUMBER: usize = 8;

impl Ranks {
    /// The share of the busiest of so many ranks, from lists of all blocks, the contacts of each, and how many numbers a block tells of walls and
    /// water with the motion, and of a stream before.
    pub fn share_of_busiest(
        &self,
        ranks: usize,
        neighbours: &NeighbourLists,
        contacts: impl Fn(usize) -> usize,
        [beside, ahead]: [usize; 2],
    ) -> RankShare {
        let lists = &neighbours.lists;
        let costs: Vec<f64> = (0..lists.len()).map(|block| cost(contacts(block))).collect();
        let cuts = cuts(&costs, ranks);
        let owner = |grain: u32| cuts.partition_point(|first| *first <= grain as usize / BLOCK) - 1;
        let mut loads = vec![0; ranks];
        let mut seen = Vec::new();
        let mut own = vec![0; ranks];
        let mut seams = vec![false; ranks * ranks];
        for (block, list) in lists.iter().enumerate() {
            let rank = owner((block * BLOCK) as u32);
            own[rank] += list.own;
            for halo in list.halo.iter().filter(|halo| owner(halo.grain) != rank) {
                loads[rank] += 1;
                let other = owner(halo.grain);
                (seams[rank * ranks + other], seams[other * ranks + rank]) = (true, true);
                seen.push((other, rank, halo.grain));
            }
        }
        seen.sort_unstable();
        seen.dedup();
        let share = |rank: usize| {
            let others = ranks - 1;
            let gives = seen.partition_point(|one| one.0 <= rank) - seen.partition_point(|one| one.0 < rank);
            // Where something looks at all grains they go over after each half of a step.
            let grains = if self.whole { 27 * own[rank] * others } else { 9 * gives };
            let own_blocks = (cuts[rank + 1] - cuts[rank]) * others;
            let blocks = own_blocks * (18 + beside + ahead);
            let partners = seams[rank * ranks..(rank + 1) * ranks].iter().filter(|seam| **seam).count();
            // Where lists are made anew few grains and contacts come to another rank.
            let columns =
                if self.whole { 15 * own[rank] * others } else { 3 * own[rank] * others + 9 * gives + 7 * own_blocks };
            let anew = columns + 2 * loads[rank] + own_blocks;
            RankShare {
                grains: own[rank],
                messages: others * if ahead > 0 { 2 } else { 1 } + partners,
                bytes: (NUMBER * (grains + blocks + 9 * loads[rank])) as f64,
                bytes_anew: (NUMBER * anew) as f64,
            }
        };
        let larger = |a: RankShare, b: RankShare| RankShare {
            grains: a.grains.max(b.grains),
            messages: a.messages.max(b.messages),
            bytes: a.bytes.max(b.bytes),
            bytes_anew: a.bytes_anew.max(b.bytes_anew),
        };
        (0..ranks).map(share).reduce(larger).unwrap_or_default()
    }
}
