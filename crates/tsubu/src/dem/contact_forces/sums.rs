//! Sums over the contacts of a block, and of all.

use crate::ranks::Reader;

/// Power lost in contacts [W].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::dem) struct ContactLosses {
    pub normal: f64,
    pub sliding: f64,
    pub rolling: f64,
}

impl ContactLosses {
    fn each(&mut self) -> [&mut f64; 3] {
        [&mut self.normal, &mut self.sliding, &mut self.rolling]
    }

    fn add(&mut self, other: &Self) {
        self.normal += other.normal;
        self.sliding += other.sliding;
        self.rolling += other.rolling;
    }

    /// Adds a correction [W], to each in proportion.
    pub fn correct(&mut self, correction: f64) {
        let total: f64 = self.each().map(|lost| lost.abs()).iter().sum();
        if total > 0.0 {
            for lost in self.each() {
                *lost += correction * lost.abs() / total;
            }
        }
    }
}

/// Sums over contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::dem) struct ContactSums {
    /// Stored energy [J].
    pub stored: f64,
    pub lost: ContactLosses,
    /// Touching pairs.
    pub contacts: usize,
    /// Deepest overlap [m].
    pub deepest: f64,
}

impl ContactSums {
    pub(super) fn add(&mut self, other: &Self) {
        self.stored += other.stored;
        self.lost.add(&other.lost);
        self.contacts += other.contacts;
        self.deepest = self.deepest.max(other.deepest);
    }

    /// Writes them into a message.
    pub fn put(&self, message: &mut Vec<f64>) {
        let ContactLosses { normal, sliding, rolling } = self.lost;
        message.extend([self.stored, normal, sliding, rolling, self.contacts as f64, self.deepest]);
    }

    /// Takes them from a message.
    pub fn take(&mut self, message: &mut Reader) {
        let mut next = || message.number();
        self.stored = next();
        self.lost = ContactLosses { normal: next(), sliding: next(), rolling: next() };
        (self.contacts, self.deepest) = (next() as usize, next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::DemEngine;
    use crate::engine::Engine as _;
    use crate::ledger::Ledger;
    use crate::partner::Hosts;
    use std::path::Path;
    use tsubu_scene::Scene;

    /// Were each rank to sum its own blocks, and these sums be added, the bits would hang on the cuts.
    #[test]
    fn sums_in_the_order_of_ranks_have_other_bits() {
        let text = "duration = '1 s'\ngravity = 10\n[materials.glass]\nyoung-modulus = '10 MPa'\nrestitution = 0.6\nfriction = 0.5\n\
                    [particles.balls]\nmaterial = 'glass'\ncount = 2500\ndiameter = '2 mm'\nmass = '10 mg'\n\
                    start.rows = { spacing = 1, jitter = 0.8, speed = 0.3 }\n[walls.box]\nmaterial = 'glass'\n\
                    shape.box = { width = '110 mm', height = '200 mm' }\n";
        let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let mut engine = DemEngine::new(scene.plan(), &Hosts::default()).unwrap_or_else(|error| panic!("{error}"));
        let differs = |engine: &DemEngine| {
            let blocks = &engine.contacts.blocks;
            let sum = |ranks: usize| {
                let mut all = ContactSums::default();
                for rank in blocks.chunks(blocks.len().div_ceil(ranks)) {
                    let mut own = ContactSums::default();
                    for block in rank {
                        own.add(&block.sums);
                    }
                    all.add(&own);
                }
                all.stored
            };
            assert_eq!(sum(1), engine.contacts.sums.stored);
            sum(2) != sum(1)
        };
        let moments = (0..20).filter(|_| {
            let moved = engine.advance(50, &mut Hosts::default(), &mut Ledger::default());
            moved.unwrap_or_else(|fault| panic!("{fault}"));
            differs(&engine)
        });
        assert!(moments.count() > 0);
    }
}
