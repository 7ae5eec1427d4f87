//! Grains that are not to touch each other: pieces of one body, and grains that a bond holds.

/// The body of a grain that is a piece of none.
pub const NO_BODY: u32 = u32::MAX;

/// Which grains are joined to which, by their ids; empty where every grain is by itself.
#[derive(Clone, Debug, Default)]
pub struct Joined {
    /// The body of every grain; empty where none is a piece of one.
    body_of: Vec<u32>,
    /// The first partner of every grain among `partners`, and one more; empty without bonds.
    first: Vec<u32>,
    partners: Vec<u32>,
}

impl Joined {
    /// Pieces of bodies: `body_of` has the body of every grain, or [`NO_BODY`]; it may be empty.
    pub fn bodies(body_of: Vec<u32>) -> Self {
        Self { body_of, ..Self::default() }
    }

    /// Puts these bonds between two grains each in the place of all earlier ones.
    pub fn bond(&mut self, pairs: impl Iterator<Item = [u32; 2]>) {
        let mut both: Vec<[u32; 2]> = pairs.flat_map(|[a, b]| [[a, b], [b, a]]).collect();
        both.sort_unstable();
        let grains = both.last().map_or(0, |pair| pair[0] as usize + 1);
        self.first.clear();
        self.first.extend((0..=grains as u32).map(|id| both.partition_point(|pair| pair[0] < id) as u32));
        if both.is_empty() {
            self.first.clear();
        }
        self.partners = both.into_iter().map(|pair| pair[1]).collect();
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.body_of.is_empty() && self.partners.is_empty()
    }

    /// Whether a grain is joined to another one.
    pub fn are(&self, a: u32, b: u32) -> bool {
        let body = |id: u32| self.body_of.get(id as usize).copied().unwrap_or(NO_BODY);
        if body(a) != NO_BODY && body(a) == body(b) {
            return true;
        }
        let ends = self.first.get(a as usize).zip(self.first.get(a as usize + 1));
        ends.is_some_and(|(first, end)| self.partners[*first as usize..*end as usize].contains(&b))
    }
}

#[cfg(test)]
mod tests {
    use super::{Joined, NO_BODY};

    #[test]
    fn pieces_and_bonded_grains_are_joined() {
        let mut joined = Joined::bodies(vec![NO_BODY, 0, 0, 1, NO_BODY]);
        joined.bond([[0, 3], [3, 7]].into_iter());
        let pairs = [(1, 2), (0, 3), (3, 0), (7, 3), (3, 7)];
        let apart = [(0, 4), (2, 3), (0, 7), (7, 8), (9, 10)];
        assert!(pairs.iter().all(|(a, b)| joined.are(*a, *b)));
        assert!(apart.iter().all(|(a, b)| !joined.are(*a, *b)));
        joined.bond(std::iter::empty());
        assert!(!joined.are(0, 3) && joined.are(1, 2) && !joined.is_empty());
        assert!(Joined::default().is_empty());
    }
}
