//! Drawing at random, the same again from the same seed.

/// A source of random choices.
pub struct Draw(fastrand::Rng);

impl Draw {
    /// The choices of one case: each kind and number has its own.
    pub fn new(seed: u64, kind: &str, number: u64) -> Self {
        let kind = kind.bytes().fold(0, |sum, byte| mix(sum ^ u64::from(byte)));
        Self(fastrand::Rng::with_seed(mix(mix(seed ^ kind) ^ number)))
    }

    /// A number below `end`, which is above 0.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.usize(..end)
    }

    /// A number from 0 to 1.
    pub fn share(&mut self) -> f64 {
        self.0.f64()
    }

    /// A whole number of any size.
    pub fn whole(&mut self) -> u64 {
        self.0.u64(..)
    }

    /// True once in so many times.
    pub fn one_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// One of a list that is not empty.
    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }

    /// The list in another order.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        self.0.shuffle(list);
    }
}

/// The finishing step of splitmix64: neighbours in, strangers out.
const fn mix(number: u64) -> u64 {
    let number = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let number = (number ^ (number >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let number = (number ^ (number >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    number ^ (number >> 31)
}

#[cfg(test)]
mod tests {
    use super::Draw;

    #[test]
    fn a_case_is_drawn_again_and_no_other_one() {
        let first = |seed, kind, number| Draw::new(seed, kind, number).whole();
        assert_eq!(first(1, "data", 2), first(1, "data", 2));
        let others = [first(2, "data", 2), first(1, "scenes", 2), first(1, "data", 3)];
        assert!(others.iter().all(|other| *other != first(1, "data", 2)));
    }
}
