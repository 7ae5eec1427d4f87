//! A set of balls, a bit each.

/// A set of balls.
#[derive(Clone, Debug, Default)]
pub(super) struct BallSet(pub(super) Vec<u64>);

impl BallSet {
    pub(super) fn new(count: usize) -> Self {
        Self(vec![0; count.div_ceil(64)])
    }

    #[inline]
    pub(super) fn insert(&mut self, i: usize) {
        self.0[i / 64] |= 1 << (i % 64);
    }

    #[inline]
    pub(super) fn remove(&mut self, i: usize) {
        self.0[i / 64] &= !(1 << (i % 64));
    }

    #[inline]
    pub(super) fn contains(&self, i: usize) -> bool {
        self.0[i / 64] >> (i % 64) & 1 == 1
    }

    /// The balls of one word of a set.
    #[inline]
    pub(super) fn members(word: usize, mut bits: u64) -> impl Iterator<Item = usize> {
        std::iter::from_fn(move || {
            let next = (bits != 0).then(|| 64 * word + bits.trailing_zeros() as usize);
            bits &= bits.wrapping_sub(1);
            next
        })
    }

    #[inline]
    pub(super) fn clear(&mut self) {
        // A word or two: cheaper one by one than by a call.
        for word in &mut self.0 {
            if *word != 0 {
                *word = 0;
            }
        }
    }

    pub(super) fn fill(&mut self, count: usize) {
        for (w, word) in self.0.iter_mut().enumerate() {
            let left = count - 64 * w;
            *word = if left >= 64 { u64::MAX } else { (1 << left) - 1 };
        }
    }
}
