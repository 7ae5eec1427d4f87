//! Grains longer than wide: each has one of the three axes of the lattice, and likes to lie like its neighbours and along its
//! way (after Baxter and Behringer 1990).

use super::collide::{REST, SLOTS};
use super::grains::Grains;
use crate::lattice::direction::Direction;
use crate::random::{Purpose, unit, words};

/// What lying alike is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// Energy that two neighbours save by lying alike.
    pub neighbours: f64,
    /// Energy that a flying grain saves by lying along its way.
    pub way: f64,
    /// Temperature of the Metropolis rule, in the same unit.
    pub temperature: f64,
}

impl Grains {
    /// Makes the grains elongated, with axes drawn at random.
    pub fn elongate(&mut self) {
        let drawn = |at: usize| {
            let w = words(self.seed, Purpose::Size, at as u32, 0);
            (0..SLOTS)
                .map(|slot| (((u64::from(w[slot % 4].rotate_left(8 * slot as u32)) * 3) >> 32) as u16) << (2 * slot))
                .sum()
        };
        let own = |at: usize, all: u16| {
            (0..SLOTS).filter(|slot| self.state[at] >> slot & 1 == 1).map(|slot| all & 3 << (2 * slot)).sum()
        };
        self.axes = (0..self.state.len()).map(|at| own(at, drawn(at))).collect();
        self.next_axes = vec![0; self.state.len()];
    }

    /// Axis of the grain in a slot, if there is one: that of direction 0 (upright), 1 or 2 and of its opposite.
    pub fn axis(&self, column: usize, row: usize, slot: usize) -> Option<usize> {
        let at = column * self.rows + row;
        (self.state[at] >> slot & 1 == 1 && !self.axes.is_empty()).then(|| usize::from(self.axes[at] >> (2 * slot) & 3))
    }

    /// Asks every grain once, site by site, whether it would rather lie along another axis; nobody moves.
    pub fn align(&mut self, alignment: Alignment) {
        for column in 0..self.columns {
            for row in 0..self.rows {
                let at = column * self.rows + row;
                if self.state[at] != 0 && self.wall[at] == 0 {
                    self.align_site(column, row, at, alignment);
                }
            }
        }
    }

    fn align_site(&mut self, column: usize, row: usize, at: usize, alignment: Alignment) {
        let mut alike = [0.0; 4];
        for way in Direction::ALL {
            let Some((c, r)) = self.neighbour(column, row, way) else { continue };
            for slot in 0..SLOTS {
                if let Some(axis) = self.axis(c, r, slot) {
                    alike[axis] += alignment.neighbours;
                }
            }
        }
        for slot in (0..SLOTS).filter(|slot| self.state[at] >> slot & 1 == 1) {
            let draw = words(self.seed, Purpose::Size, at as u32, self.step << 3 | slot as u64);
            let now = usize::from(self.axes[at] >> (2 * slot) & 3);
            let other = (now + 1 + (draw[0] & 1) as usize) % 3;
            let worth = |axis: usize| alike[axis] + if slot != REST && slot % 3 == axis { alignment.way } else { 0.0 };
            let gain = worth(other) - worth(now);
            if gain >= 0.0 || unit(draw[1], draw[2]) < (gain / alignment.temperature).exp() {
                self.axes[at] = self.axes[at] & !(3 << (2 * slot)) | (other as u16) << (2 * slot);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::collide::SLOTS;
    use super::super::grains::{Grains, Habits};
    use super::Alignment;

    /// Every grain takes its axis along, however it flies, collides, stops, falls and hops: where all have one axis, all keep it;
    /// and nobody moves differently for having one.
    #[test]
    fn axes_go_along() {
        let habits = Habits { gravity: 0.2, dissipation: 0.5, roughness: 0.5 };
        let mut round = Grains::new(10, 40, [true, true], habits, 3);
        for row in 0..40 {
            round.set_wall(0, row, false);
            (1..10).for_each(|column| round.set_site(column, row, 1 << (row % 7) | 1 << ((row + column) % 7)));
        }
        let mut long = round.clone();
        long.elongate();
        let two = |state: u8| (0..SLOTS).map(|slot| u16::from(state >> slot & 1) << (2 * slot + 1)).sum();
        long.axes = long.state.iter().map(|state| two(*state)).collect();
        for _ in 0..60 {
            round.step();
            long.step();
            assert!(long.state == round.state);
            assert!(long.axes.iter().zip(&long.state).all(|(axes, state)| *axes == two(*state)));
        }
        long.align(Alignment { neighbours: 0.0, way: 0.0, temperature: 1.0 });
        assert!(long.axes.iter().zip(&long.state).any(|(axes, state)| *axes != two(*state)));
    }
}
