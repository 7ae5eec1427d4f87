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
