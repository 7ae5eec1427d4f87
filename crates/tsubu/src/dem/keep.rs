//! Contact history over a search, and in a checkpoint: by the ids of the bodies, since indices change.

use super::engine::DemEngine;
use super::memory::{Kept, Name, WallKey};
use crate::contact::Law;
use crate::find::candidates::BLOCK;

impl DemEngine {
    /// Every remembered contact, in the order of blocks.
    pub(super) fn kept(&self) -> Kept {
        let width = self.widest();
        let id = &self.grains.id;
        let mut kept = Kept::default();
        if width == 0 {
            return kept;
        }
        for (block, list) in self.touch.blocks.iter().zip(&self.candidates.lists) {
            for (law, memory) in (0..).zip(&block.memory) {
                for (c, &k) in memory.pairs.keys.iter().enumerate() {
                    let pair = list.pairs[k as usize];
                    let (first, second) =
                        (id[list.first + pair.own as usize], id[list.at[pair.place as usize] as usize]);
                    kept.push(Name { first, second, wall: false, patch: 0, law }, memory.pairs.of(c), width);
                }
                for (c, key) in memory.walls.keys.iter().enumerate() {
                    let first = id[list.first + key.own as usize];
                    let name = Name { first, second: key.wall, wall: true, patch: key.patch, law };
                    kept.push(name, memory.walls.of(c), width);
                }
            }
        }
        kept
    }

    /// Gives the new candidates the histories they had; a pair whose bodies have changed places gets its turned. What a
    /// contact holds whose body is gone, or whose pair is no candidate any more, is returned as lost [J].
    pub(super) fn restore(&mut self, mut kept: Kept) -> f64 {
        let width = self.widest();
        let laws = self.table.laws();
        for block in &mut self.touch.blocks {
            for (memory, law) in block.memory.iter_mut().zip(laws) {
                memory.clear(law.width());
            }
        }
        if width == 0 {
            return 0.0;
        }
        let mut index = vec![u32::MAX; self.grains.id.iter().max().map_or(0, |m| *m as usize + 1)];
        for (i, id) in self.grains.id.iter().enumerate() {
            index[*id as usize] = i as u32;
        }
        let index = |id: u32| index.get(id as usize).copied().filter(|i| *i != u32::MAX);
        let mut lost = 0.0;
        // Per block, which kept contact goes where.
        let mut pairs: Vec<Vec<(u32, usize)>> = vec![Vec::new(); self.candidates.lists.len()];
        let mut walls: Vec<Vec<(WallKey, usize)>> = vec![Vec::new(); self.candidates.lists.len()];
        let Kept { names, history } = &mut kept;
        for (n, (contact, history)) in names.iter().zip(history.chunks_exact_mut(width)).enumerate() {
            let law = &laws[contact.law as usize];
            let place = if contact.wall {
                index(contact.first).filter(|_| !self.walls[contact.second as usize].gone()).map(|i| {
                    let key = WallKey { own: i % BLOCK as u32, wall: contact.second, patch: contact.patch };
                    walls[i as usize / BLOCK].push((key, n));
                })
            } else {
                index(contact.first).zip(index(contact.second)).and_then(|(i, j)| {
                    let (block, k) = self.candidate(i, j).or_else(|| {
                        let found = self.candidate(j, i)?;
                        law.turned(history);
                        Some(found)
                    })?;
                    pairs[block].push((k, n));
                    Some(())
                })
            };
            if place.is_none() {
                lost += law.held(history);
            }
        }
        for (block, (mut pairs, mut walls)) in self.touch.blocks.iter_mut().zip(pairs.into_iter().zip(walls)) {
            pairs.sort_unstable();
            walls.sort_unstable();
            let of = |n: usize| (kept.names[n].law as usize, &kept.history[n * width..(n + 1) * width]);
            for (key, n) in pairs {
                let (law, history) = of(n);
                block.memory[law].pairs.push(key, history);
            }
            for (key, n) in walls {
                let (law, history) = of(n);
                block.memory[law].walls.push(key, history);
            }
        }
        lost
    }

    /// Columns of history of the law that has most.
    pub(super) fn widest(&self) -> usize {
        self.table.laws().iter().map(Law::width).max().unwrap_or_default()
    }

    /// Block and number of the candidate of grain `i` with grain `j`.
    fn candidate(&self, i: u32, j: u32) -> Option<(usize, u32)> {
        let block = i as usize / BLOCK;
        let list = &self.candidates.lists[block];
        let own = i as usize % BLOCK;
        let range = list.start[own] as usize..list.start[own + 1] as usize;
        let k = list.pairs[range.clone()].iter().position(|pair| list.at[pair.place as usize] == j)?;
        Some((block, (range.start + k) as u32))
    }
}
