//! One run on several ranks: all have the grains, and each has the blocks of a stretch of their order in space.
//!
//! A rank makes lists, forces and steps for its own blocks alone. What these see of other grains, and what they do to them, goes over in two
//! exchanges a step: motion when positions have gone on, with what blocks have summed, which is added up in the order of the blocks: the same
//! bits on any number of ranks; and loads, while the blocks that touch no grain of other ranks are evaluated. Before grains are sorted anew, all
//! ranks get the positions of all; what else grains have goes to the rank that has them from then on.

mod estimate;
mod gather;
mod share;

pub(super) use share::Halves;

use crate::neighbours::NeighbourLists;
use crate::neighbours::block::{BLOCK, Incoming};
use crate::ranks::{Communicator, Reader};
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

/// The ranks of a run, as this one sees them; by default it is alone.
#[derive(Debug, Default)]
pub(super) struct Ranks {
    communicator: Option<Arc<dyn Communicator>>,
    /// Whether something looks at all grains in every step, so that all go over.
    whole: bool,
    /// The first block of every rank, and the number of blocks.
    cuts: Vec<usize>,
    /// The same before the last cut.
    cuts_before: Vec<usize>,
    /// Whether ranks know of the grains of others no more than the positions.
    apart: bool,
    /// All other ranks.
    others: Vec<usize>,
    /// Those that see grains of this one, or have grains that it sees.
    partners: Vec<usize>,
    seams: Vec<Seam>,
    /// Of every block: whether it is an own one with loads on grains of others.
    outer: Vec<bool>,
    messages: Vec<Vec<f64>>,
    work: Work,
}

/// How long ranks work. It decides who has which blocks, and no bit.
#[derive(Debug, Default)]
struct Work {
    /// Each rank from the first step on, as it last told all others [s]: the same on all ranks, for all of them cut by it.
    all: Vec<f64>,
    /// The same up to the last cut [s].
    before_cut: Vec<f64>,
    /// This rank up to now [s].
    own: f64,
    /// Since when this rank works.
    since: Option<Instant>,
}

/// What goes over between this rank and another.
#[derive(Clone, Debug, Default)]
struct Seam {
    /// Own grains that the other sees.
    gives: Vec<u32>,
    /// Its grains that blocks of this rank see.
    takes: Vec<u32>,
    /// Where loads on its grains are: own blocks, and local numbers there.
    back: Vec<[u32; 2]>,
    /// Its blocks that have loads on own grains, a load each.
    owed: Vec<u32>,
}

impl Seam {
    /// Whether nothing goes over.
    fn is_empty(&self) -> bool {
        self.back.is_empty() && self.owed.is_empty()
    }
}

impl Ranks {
    /// With `whole` all grains go over in every step.
    pub fn new(communicator: Option<Arc<dyn Communicator>>, whole: bool) -> Self {
        let (rank, size) = communicator.as_ref().map_or((0, 0), |all| (all.rank(), all.size()));
        Self {
            communicator,
            whole,
            cuts: Vec::new(),
            cuts_before: Vec::new(),
            apart: false,
            others: (0..size).filter(|other| *other != rank).collect(),
            partners: Vec::new(),
            seams: vec![Seam::default(); size],
            outer: Vec::new(),
            messages: vec![Vec::new(); size],
            work: Work { all: vec![0.0; size], before_cut: vec![0.0; size], ..Work::default() },
        }
    }

    pub fn is_alone(&self) -> bool {
        self.communicator.is_none()
    }

    fn rank(&self) -> usize {
        self.communicator.as_ref().map_or(0, |all| all.rank())
    }

    /// The blocks of a rank.
    fn blocks(&self, rank: usize) -> Range<usize> {
        self.cuts[rank]..self.cuts[rank + 1]
    }

    /// The rank that has a grain.
    pub fn owner(&self, grain: u32) -> usize {
        self.cuts.partition_point(|first| *first <= grain as usize / BLOCK) - 1
    }

    /// Cuts so many blocks by what they cost, of which `contacts` tells the contacts in the last step. Gives the own ones, where there are several ranks.
    pub fn cut(&mut self, blocks: usize, contacts: impl Fn(usize) -> usize) -> Option<Range<usize>> {
        let size = self.communicator.as_ref()?.size();
        let cuts = cuts(&self.costs(blocks, contacts), size);
        self.cuts_before = std::mem::replace(&mut self.cuts, cuts);
        self.work.before_cut.clone_from(&self.work.all);
        Some(self.blocks(self.rank()))
    }

    /// What every block costs: by its contacts, and by how long its rank has worked for such since the last cut.
    fn costs(&self, blocks: usize, contacts: impl Fn(usize) -> usize) -> Vec<f64> {
        let cost = |block: usize| cost(contacts(block));
        let told = |ends: &[usize]| (ends[0]..ends[1]).map(cost).sum::<f64>();
        let worked = self.work.all.iter().zip(&self.work.before_cut).map(|(all, before)| all - before);
        let pace: Vec<f64> = self.cuts.windows(2).zip(worked).map(|(ends, worked)| worked / told(ends)).collect();
        let mean = pace.iter().filter(|pace| pace.is_finite()).sum::<f64>() / pace.len() as f64;
        let of = |block: usize| {
            let rank = self.cuts.partition_point(|first| *first <= block).saturating_sub(1);
            let pace = pace.get(rank).map_or(1.0, |pace| pace / mean);
            // Short times tell little.
            cost(block) * if pace.is_finite() { pace.clamp(0.5, 2.0) } else { 1.0 }
        };
        (0..blocks).map(of).collect()
    }

    /// Work of every rank so far [s].
    pub fn worked(&self) -> &[f64] {
        &self.work.all
    }

    /// What is done from here on is work.
    pub fn begin_to_work(&mut self) {
        self.work.since = (!self.is_alone()).then(Instant::now);
    }

    /// Finds out from new lists what goes over, and tells them where loads on own grains come from.
    pub fn agree(&mut self, neighbours: &mut NeighbourLists) {
        if self.is_alone() {
            return;
        }
        for seam in &mut self.seams {
            *seam = Seam::default();
        }
        self.messages.iter_mut().for_each(Vec::clear);
        self.outer.clear();
        self.outer.resize(neighbours.lists.len(), false);
        let own = neighbours.own();
        for (block, list) in own.clone().zip(&neighbours.lists[own.clone()]) {
            for (local, halo) in
                (list.own..).zip(&list.halo).filter(|(_, halo)| !own.contains(&(halo.grain as usize / BLOCK)))
            {
                let owner = self.owner(halo.grain);
                self.seams[owner].takes.push(halo.grain);
                self.seams[owner].back.push([block as u32, local as u32]);
                self.outer[block] = true;
                self.messages[owner].extend([f64::from(halo.grain), block as f64]);
            }
        }
        let mut messages = std::mem::take(&mut self.messages);
        self.pass(&mut messages);
        self.messages = messages;
        let mut held = vec![0; neighbours.lists.len()];
        for (seam, message) in self.seams.iter_mut().zip(&self.messages) {
            let mut message = Reader::new(message);
            while !message.is_at_end() {
                let (grain, block) = (message.number() as u32, message.number() as u32);
                seam.gives.push(grain);
                seam.owed.push(block);
                let local = held[block as usize];
                held[block as usize] += 1;
                let incoming = Incoming { own: grain % BLOCK as u32, block, local };
                neighbours.lists[grain as usize / BLOCK].incoming.push(incoming);
            }
            for grains in [&mut seam.gives, &mut seam.takes] {
                grains.sort_unstable();
                grains.dedup();
            }
        }
        self.partners.clear();
        self.partners.extend(self.others.iter().filter(|rank| !self.seams[**rank].is_empty()));
        for list in &mut neighbours.lists[own] {
            list.incoming.sort_unstable_by_key(|incoming| (incoming.own, incoming.block, incoming.local));
        }
    }

    /// Writes a message to every other rank.
    fn write(&mut self, write: impl Fn(&Self, usize, &mut Vec<f64>)) {
        let mut messages = std::mem::take(&mut self.messages);
        for (rank, message) in messages.iter_mut().enumerate().filter(|(rank, _)| *rank != self.rank()) {
            message.clear();
            write(self, rank, message);
        }
        self.messages = messages;
    }

    /// Sends what was written, and reads what comes from each.
    fn send_and_read(&mut self, mut read: impl FnMut(&Self, usize, &mut Reader)) {
        let mut messages = std::mem::take(&mut self.messages);
        let own = self.rank();
        self.note_work();
        self.work.all[own] = self.work.own;
        for message in &mut messages {
            message.push(self.work.own);
        }
        self.pass(&mut messages);
        for (rank, message) in messages.iter().enumerate().filter(|(rank, _)| *rank != own) {
            if let Some((worked, message)) = message.split_last() {
                self.work.all[rank] = *worked;
                read(self, rank, &mut Reader::new(message));
            }
        }
        self.messages = messages;
    }

    /// Adds the work since it was last noted.
    fn note_work(&mut self) {
        if let Some(since) = &mut self.work.since {
            let now = Instant::now();
            self.work.own += now.duration_since(std::mem::replace(since, now)).as_secs_f64();
        }
    }

    /// Sends a message to every rank, and puts what each sends in its place; nothing comes where there is but one.
    pub fn pass(&mut self, messages: &mut [Vec<f64>]) {
        let others = std::mem::take(&mut self.others);
        self.pass_to(&others, messages, || false);
        self.others = others;
    }

    /// The same with ranks that share a seam with this one, at work while messages are under way.
    fn pass_across_seams(&mut self, messages: &mut [Vec<f64>], work: impl FnMut() -> bool) {
        let partners = std::mem::take(&mut self.partners);
        self.pass_to(&partners, messages, work);
        self.partners = partners;
    }

    /// Sends messages to these ranks, and puts what they send in their place; `work` meanwhile does a part, and tells whether there is more. To wait is
    /// no work.
    fn pass_to(&mut self, partners: &[usize], messages: &mut [Vec<f64>], mut work: impl FnMut() -> bool) {
        let Some(all) = self.communicator.clone() else { return };
        self.note_work();
        all.exchange_while(messages, partners, &mut || {
            let more = work();
            self.note_work();
            more
        });
        self.work.since = self.work.since.map(|_| Instant::now());
    }

    /// The grains of a rank, of so many.
    fn grains(&self, rank: usize, grains: usize) -> Range<usize> {
        of_blocks(&self.cuts, rank, grains)
    }

    /// Whether this is the first rank.
    pub fn is_first(&self) -> bool {
        self.rank() == 0
    }

    /// The ranks other than this one that have one of these grains, each once.
    pub fn others(&self, grains: [Option<u32>; 2]) -> impl Iterator<Item = usize> {
        let several = self.communicator.is_some();
        let [first, second] = grains.map(|grain| grain.filter(|_| several).map(|grain| self.owner(grain)));
        let rank = self.rank();
        [first, second.filter(|second| Some(*second) != first)]
            .into_iter()
            .flatten()
            .filter(move |owner| *owner != rank)
    }

    /// As many messages as there are ranks.
    pub fn letters(&self) -> Vec<Vec<f64>> {
        vec![Vec::new(); self.seams.len()]
    }
}

/// The grains of a rank with these cuts, of so many.
fn of_blocks(cuts: &[usize], rank: usize, grains: usize) -> Range<usize> {
    (cuts[rank] * BLOCK).min(grains)..(cuts[rank + 1] * BLOCK).min(grains)
}

/// What a block with so many contacts costs, in a unit of its own.
fn cost(contacts: usize) -> f64 {
    (4 * BLOCK + 5 * contacts) as f64
}

/// The first block of every rank, and the number of blocks: each rank gets about as much of the `costs`.
fn cuts(costs: &[f64], ranks: usize) -> Vec<usize> {
    let all: f64 = costs.iter().sum();
    let (mut cuts, mut before) = (Vec::with_capacity(ranks + 1), 0.0);
    for (block, cost) in costs.iter().enumerate() {
        // A block belongs where most of it does.
        let middle = before + 0.5 * cost;
        while cuts.len() as f64 * all <= middle * ranks as f64 && cuts.len() < ranks {
            cuts.push(block);
        }
        before += cost;
    }
    cuts.resize(ranks + 1, costs.len());
    cuts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work of the busiest of two ranks over the mean.
    fn imbalance(costs: &[f64], cuts: &[usize]) -> f64 {
        let of = |k: usize| costs[cuts[k]..cuts[k + 1]].iter().sum::<f64>();
        2.0 * of(0).max(of(1)) / (of(0) + of(1))
    }

    /// A hopper that has emptied on one side: as many blocks for each rank would leave one of them waiting.
    #[test]
    fn cuts_follow_what_blocks_cost() {
        let costs: Vec<f64> = (0..40).map(|block| cost(if block < 20 { 3 * BLOCK } else { 0 })).collect();
        assert!(imbalance(&costs, &cuts(&costs, 2)) < 1.05);
        assert!(imbalance(&costs, &[0, 20, 40]) > 1.5);
    }

    /// The other of two ranks, which says that it has worked for a second, and lets this one wait.
    #[derive(Debug)]
    struct Other;

    impl Communicator for Other {
        fn rank(&self) -> usize {
            0
        }

        fn size(&self) -> usize {
            2
        }

        fn exchange_while(&self, messages: &mut [Vec<f64>], _: &[usize], _: &mut dyn FnMut() -> bool) {
            messages[1] = vec![1.0];
        }

        fn broadcast(&self, _: &mut Vec<f64>) {}
    }

    /// All ranks cut by the same numbers: what this one has worked since it last told the others is not among them.
    #[test]
    fn a_cut_takes_what_all_ranks_know() {
        let mut ranks = Ranks::new(Some(Arc::new(Other)), false);
        ranks.cut(40, |_| 0);
        ranks.begin_to_work();
        ranks.send_and_read(|_, _, _| {});
        let told = ranks.costs(40, |_| 0);
        std::thread::sleep(std::time::Duration::from_millis(20));
        ranks.pass(&mut [Vec::new(), Vec::new()]);
        assert_eq!(ranks.costs(40, |_| 0), told);
        ranks.send_and_read(|_, _, _| {});
        assert_ne!(ranks.costs(40, |_| 0), told);
    }

    #[test]
    fn more_ranks_than_blocks_leave_some_without() {
        assert_eq!(cuts(&[1.0, 1.0], 4), [0, 0, 1, 1, 2]);
        assert_eq!(cuts(&[], 2), [0, 0, 0]);
    }
}
