//! Which way a grain would rather go, and which grain goes first (C-3 of Sakaguchi 2001).

use crate::lattice::direction::Direction;

/// The way gravity pulls: straight, and the two oblique directions beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pull {
    /// Along gravity.
    pub straight: Direction,
    /// Beside it: to the right, to the left.
    pub sides: [Direction; 2],
}

impl Pull {
    /// Gravity down.
    pub const DOWN: Self = Self { straight: Direction::S, sides: [Direction::SE, Direction::SW] };
    /// Gravity up, as a shaken box has it for a moment.
    pub const UP: Self = Self { straight: Direction::N, sides: [Direction::NE, Direction::NW] };

    /// All three directions in the order in which a grain tries them: straight; then the side to which it has leant, or
    /// that which the coin gives.
    #[inline]
    pub fn preference(self, lean: i32, coin: bool) -> [Direction; 3] {
        let [right, left] = self.sides;
        let to_the_left = if lean == 0 { coin } else { lean < 0 };
        if to_the_left { [self.straight, left, right] } else { [self.straight, right, left] }
    }
}

/// Rank of a move: those of lower rank go first. (Rank 0, rest, has no move.)
#[inline]
pub fn rank(direction: Direction, last: Option<Direction>, pull: Option<Pull>) -> u64 {
    match pull {
        _ if last == Some(direction) => 1,
        Some(pull) if direction == pull.straight => 2,
        Some(pull) if pull.sides.contains(&direction) => 3,
        _ => 4,
    }
}

/// The sideways moves of up to 32 steps: two bits a step, the youngest lowest; a rest forgets them all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Past(pub u64);

impl Past {
    /// One more move.
    #[inline]
    #[must_use]
    pub fn then(self, direction: Direction) -> Self {
        let side = match direction.h() {
            1 => 1,
            -1 => 2,
            _ => 0,
        };
        Self(self.0 << 2 | side)
    }

    /// Moves to the right less moves to the left among the last `memory` steps, 1 to 32.
    #[inline]
    pub fn lean(self, memory: u32) -> i32 {
        const RIGHT: u64 = 0x5555_5555_5555_5555;
        let window = self.0 & (u64::MAX >> (64 - 2 * memory));
        (window & RIGHT).count_ones() as i32 - (window & !RIGHT).count_ones() as i32
    }
}

#[cfg(test)]
mod tests {
    use super::{Past, Pull};
    use crate::lattice::direction::Direction::{N, NE, S, SE, SW};

    #[test]
    fn a_grain_leans_to_where_it_went() {
        let past = Past::default().then(SE).then(SW).then(SW).then(S);
        assert_eq!([1, 2, 3, 4, 32].map(|memory| past.lean(memory)), [0, -1, -2, -1, -1]);
        assert_eq!(Pull::DOWN.preference(past.lean(2), false), [S, SW, SE]);
        assert_eq!(Pull::UP.preference(0, false)[..2], [N, NE]);
    }
}
