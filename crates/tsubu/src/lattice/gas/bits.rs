//! Words of single bits, one bit a site.

use std::ops::{BitAnd, BitOr, BitXor, Not};

/// What bit logic needs: a word of 64 sites, or a row of such words.
pub trait Bits:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> + Not<Output = Self>
{
    /// No site.
    const NONE: Self;
}

impl Bits for u64 {
    const NONE: Self = 0;
}

/// Words in a row: what the widest vector of today's machines holds.
pub const WIDE: usize = 8;

/// 512 sites: eight words, written so that the compiler makes one vector of them.
#[derive(Clone, Copy)]
pub struct Wide(pub [u64; WIDE]);

impl Wide {
    /// The words from `first` on.
    #[inline(always)]
    pub fn at(words: &[u64], first: usize) -> Self {
        let mut wide = [0; WIDE];
        wide.copy_from_slice(&words[first..first + WIDE]);
        Self(wide)
    }

    /// Every site taken from the one below it; `before` is the word before these.
    #[inline(always)]
    #[must_use]
    pub fn from_below(self, before: u64) -> Self {
        let mut wide = self;
        for i in 0..WIDE {
            wide.0[i] = self.0[i] << 1 | if i == 0 { before } else { self.0[i - 1] } >> 63;
        }
        wide
    }

    /// Every site taken from the one above it; `after` is the word after these.
    #[inline(always)]
    #[must_use]
    pub fn from_above(self, after: u64) -> Self {
        let mut wide = self;
        for i in 0..WIDE {
            wide.0[i] = self.0[i] >> 1 | if i + 1 == WIDE { after } else { self.0[i + 1] } << 63;
        }
        wide
    }

    /// Whether there is any site.
    #[inline(always)]
    pub fn any(self) -> bool {
        let mut all = 0;
        for word in self.0 {
            all |= word;
        }
        all != 0
    }

    /// Writes the words.
    #[inline(always)]
    pub fn put(self, words: &mut [u64], first: usize) {
        words[first..first + WIDE].copy_from_slice(&self.0);
    }
}

impl Bits for Wide {
    const NONE: Self = Self([0; WIDE]);
}

impl BitAnd for Wide {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        let mut wide = self;
        for i in 0..WIDE {
            wide.0[i] &= other.0[i];
        }
        wide
    }
}

impl BitOr for Wide {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        let mut wide = self;
        for i in 0..WIDE {
            wide.0[i] |= other.0[i];
        }
        wide
    }
}

impl BitXor for Wide {
    type Output = Self;
    #[inline(always)]
    fn bitxor(self, other: Self) -> Self {
        let mut wide = self;
        for i in 0..WIDE {
            wide.0[i] ^= other.0[i];
        }
        wide
    }
}

impl Not for Wide {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        let mut wide = self;
        for word in &mut wide.0 {
            *word = !*word;
        }
        wide
    }
}
