//! Random bits by the word: a function of (seed, purpose, place, step), whoever asks.

use super::bits::{Bits, WIDE, Wide};
use crate::random::{MULTIPLIERS, Purpose, WEYL, key};

/// Two wide words of fair bits for one place and step: what [`crate::random::words`] gives to the eight entities from
/// `WIDE place` on, side by side so that the compiler makes vectors of it.
#[inline(always)]
pub fn fair(seed: u64, purpose: Purpose, place: u32, step: u64) -> [Wide; 2] {
    const LOW: u64 = 0xFFFF_FFFF;
    let [mut key0, mut key1] = key(seed, purpose);
    let mut c0 = [0; WIDE];
    for (lane, c) in c0.iter_mut().enumerate() {
        *c = u64::from(place) * WIDE as u64 + lane as u64;
    }
    let mut c1 = [purpose as u64; WIDE];
    let mut c2 = [step & LOW; WIDE];
    let mut c3 = [step >> 32; WIDE];
    for _ in 0..10 {
        for lane in 0..WIDE {
            let first = c0[lane] * u64::from(MULTIPLIERS[0]);
            let second = c2[lane] * u64::from(MULTIPLIERS[1]);
            c0[lane] = second >> 32 ^ c1[lane] ^ u64::from(key0);
            c2[lane] = first >> 32 ^ c3[lane] ^ u64::from(key1);
            c1[lane] = second & LOW;
            c3[lane] = first & LOW;
        }
        (key0, key1) = (key0.wrapping_add(WEYL[0]), key1.wrapping_add(WEYL[1]));
    }
    for lane in 0..WIDE {
        c0[lane] |= c1[lane] << 32;
        c2[lane] |= c3[lane] << 32;
    }
    [Wide(c0), Wide(c2)]
}

/// A probability in 1/65536, for bits that are drawn many at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Odds(u32);

impl Odds {
    /// The nearest one to a probability.
    pub fn new(probability: f64) -> Self {
        Self((probability.clamp(0.0, 1.0) * 65536.0).round() as u32)
    }

    /// The probability.
    pub fn value(self) -> f64 {
        f64::from(self.0) / 65536.0
    }

    /// Bits that are set with this probability: a fair binary fraction is below it. From the last place to the first, a
    /// place that is 1 lets pass what a fair bit passes or what came so far; a place that is 0, what both pass.
    #[inline(always)]
    pub fn draw(self, seed: u64, purpose: Purpose, place: u32, step: u64) -> [Wide; 2] {
        if self.0 >= 65536 {
            return [!Wide::NONE; 2];
        }
        let mut bits = [Wide::NONE; 2];
        for level in self.0.trailing_zeros().min(16)..16 {
            let coin = fair(seed, purpose, place, step << 4 | u64::from(level));
            let one = self.0 >> level & 1 == 1;
            for (bits, coin) in bits.iter_mut().zip(coin) {
                *bits = if one { *bits | coin } else { *bits & coin };
            }
        }
        bits
    }
}

#[cfg(test)]
mod tests {
    use super::{Odds, fair};
    use crate::random::{Purpose, words};

    /// Side by side or one after the other: the same numbers.
    #[test]
    fn wide_numbers_are_the_single_ones() {
        let [first, second] = fair(77 << 30, Purpose::Turn, 5, 1 << 33 | 6);
        for lane in 0..8 {
            let [a, b, c, d] = words(77 << 30, Purpose::Turn, 40 + lane as u32, 1 << 33 | 6);
            assert_eq!(first.0[lane], u64::from(b) << 32 | u64::from(a));
            assert_eq!(second.0[lane], u64::from(d) << 32 | u64::from(c));
        }
    }

    /// Shares over a million bits, within five standard deviations.
    #[test]
    fn as_often_as_asked() {
        for wanted in [0.0, 1e-3, 0.25, 0.3, 0.5, 0.9, 1.0] {
            let odds = Odds::new(wanted);
            let draws = (0..1000).flat_map(|place| odds.draw(1, Purpose::Force, place, 3));
            let set: u32 = draws.flat_map(|w| w.0).map(u64::count_ones).sum();
            let share = f64::from(set) / 1_024_000.0;
            let scatter = (wanted * (1.0 - wanted) / 1_024_000.0_f64).sqrt();
            assert!((share - wanted).abs() <= 5.0 * scatter + 1e-5, "{wanted}: {share}");
        }
    }
}
