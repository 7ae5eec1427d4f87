//! Grains longer than wide: each has one of the three axes of the lattice, and likes to lie like its neighbours and along its
//! way (after Baxter and Behringer 1990).

use super::collide::{REST, SLOTS};
use super::grains::Grains;
use super::numbers::{NOBODY, Numbers};
use crate::about::About;
use crate::lattice::direction::Direction;
use crate::random::{Purpose, unit, words};

pub(crate) const ABOUT: About = About {
    key: "method.after-baxter-behringer",
    formula: "as `after-peng-herrmann`, each grain with one of three axes; a turn is accepted by Metropolis with the energies of lying like the neighbours and along the way",
    symbols: "energies over temperature [-]",
    limits: "Orientation does not change where a grain fits.",
    reference: "after Baxter and Behringer 1990",
};

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
    /// Gives every grain a number, in the order of sites and slots.
    pub fn number(&mut self) {
        let mut numbers = Numbers::new(self.sites, self.mass() as usize);
        let mut count = 0;
        for (site, state) in self.state.iter().enumerate() {
            for slot in (0..SLOTS).filter(|slot| state >> slot & 1 == 1) {
                numbers.set(site, slot, count);
                count += 1;
            }
        }
        self.numbers = Some(numbers);
    }

    /// Makes grains that have numbers elongated, with axes drawn at random; those who are not there yet stand upright.
    pub fn elongate(&mut self) {
        let Some(numbers) = &self.numbers else { return };
        self.axes = vec![0; numbers.laps.len()];
        for site in 0..self.sites.count() {
            let w = words(self.seed, Purpose::Size, site as u32, 0);
            for (slot, who) in numbers.at(site).into_iter().enumerate().filter(|(_, who)| *who != NOBODY) {
                self.axes[who as usize] = ((u64::from(w[slot % 4].rotate_left(8 * slot as u32)) * 3) >> 32) as u8;
            }
        }
    }

    /// Axis of every grain by its number; nothing for round grains.
    pub fn axes(&self) -> &[u8] {
        &self.axes
    }

    /// Gives grains the axes of another time.
    pub fn set_axes(&mut self, axes: Vec<u8>) {
        self.axes = axes;
    }

    /// Axis of the grain in a slot, if there is one: that of direction 0 (upright), 1 or 2 and of its opposite.
    pub fn axis(&self, column: usize, row: usize, slot: usize) -> Option<usize> {
        let who = self.numbers.as_ref()?.at(self.sites.index(column, row))[slot];
        self.axes.get(who as usize).map(|axis| usize::from(*axis))
    }

    /// Asks every grain once, site by site, whether it would rather lie along another axis; nobody moves.
    pub fn align(&mut self, alignment: Alignment) {
        for column in 0..self.sites.columns {
            for row in 0..self.sites.rows {
                let at = self.sites.index(column, row);
                if self.state[at] != 0 && self.wall[at] == 0 {
                    self.align_site(column, row, at, alignment);
                }
            }
        }
    }

    fn align_site(&mut self, column: usize, row: usize, at: usize, alignment: Alignment) {
        let Some(numbers) = &self.numbers else { return };
        let mut alike = [0.0; 3];
        for way in Direction::ALL {
            let Some((c, r)) = self.sites.neighbour(column, row, way) else { continue };
            for who in numbers.at(self.sites.index(c, r)).into_iter().filter(|who| *who != NOBODY) {
                alike[usize::from(self.axes[who as usize])] += alignment.neighbours;
            }
        }
        for (slot, who) in numbers.at(at).into_iter().enumerate().filter(|(_, who)| *who != NOBODY) {
            let draw = words(self.seed, Purpose::Size, at as u32, self.step << 3 | slot as u64);
            let now = usize::from(self.axes[who as usize]);
            let other = (now + 1 + (draw[0] & 1) as usize) % 3;
            let worth = |axis: usize| alike[axis] + if slot != REST && slot % 3 == axis { alignment.way } else { 0.0 };
            let gain = worth(other) - worth(now);
            if gain >= 0.0 || unit(draw[1], draw[2]) < (gain / alignment.temperature).exp() {
                self.axes[who as usize] = other as u8;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grains::{Grains, Habits};
    use super::super::numbers::NOBODY;
    use super::Alignment;

    /// Every grain takes its number along, however it flies, collides, stops, falls and hops: each is somewhere, once, and
    /// has its axis. Nobody moves differently for having one.
    #[test]
    fn axes_go_along() {
        let habits = Habits { gravity: 0.2, dissipation: 0.5, roughness: 0.5 };
        let mut round = Grains::new(10, 40, [true, true], habits, 3);
        for row in 0..40 {
            round.set_wall(0, row, Some(0));
            (1..10).for_each(|column| round.set_site(column, row, 1 << (row % 7) | 1 << ((row + column) % 7)));
        }
        let mut long = round.clone();
        long.number();
        long.elongate();
        let axes = long.axes.clone();
        for _ in 0..60 {
            round.step();
            long.step();
            assert!(long.state == round.state);
            let numbers = long.numbers().expect("numbered");
            assert!((0..long.sites.count()).all(|site| numbers.state(site) == long.state[site]));
            let waiting = long.surplus().iter().flat_map(|waiting| &waiting.who[..usize::from(waiting.count)]);
            let there = (0..long.sites.count()).flat_map(|site| numbers.at(site)).filter(|who| *who != NOBODY);
            let mut all: Vec<u32> = there.chain(waiting.copied()).collect();
            all.sort_unstable();
            assert!(all.iter().enumerate().all(|(index, who)| index == *who as usize) && all.len() == axes.len());
        }
        assert_eq!(long.axes, axes);
        long.align(Alignment { neighbours: 0.0, way: 0.0, temperature: 1.0 });
        assert_ne!(long.axes, axes);
    }
}
