//! Litwiniszyn's stochastic model of a bed that runs out (1956 to 1964): voids walk upward at random.
//!
//! Grains sit in cages. When the grain of a cage leaves, one of the two cages above gives its grain, with probabilities p
//! and 1 - p; so the void walks up, a row at a time. Voids do not feel each other: each has reached the surface before the
//! next one sets out. The mean number of voids that pass a cage obeys the diffusion equation with the height y in the
//! place of time,
//!
//! ```text
//! dP/dy = B d2P/dx2,   B = a^2 / (2 b)        cages 2a wide and b high; here a = d/2, b = d sqrt(3)/2: B = 0.14434 d
//! ```
//!
//! Where one of the two cages above is a wall, the grain comes from the other: walls reflect. A void that finds no grain
//! above goes on through empty cages, for a bed may begin, or a gate leave it, with a gap below; where no grain is higher up
//! it is at the surface and ends there.

use super::sheet::{EMPTY, OUT, Sheet, Trail};
use crate::about::About;
use crate::random::{Purpose, unit, words};

pub(crate) const ABOUT: About = About {
    key: "method.litwiniszyn",
    formula: "a void takes the grain of one of the two cages above it, with probability p and 1 - p;  dP/dy = B d2P/dx2, B = a^2/(2 b)",
    symbols: "P mean number of voids that pass a cage [-], y height, x across [m], cages 2a wide and b high [m], B = \
0.14434 d, d spacing [m]",
    limits: "Voids do not feel each other; no time but the order of voids, no inertia, no walls' friction.",
    reference: "Litwiniszyn 1956, 1964",
};

/// B of the lattice over the spacing [-]: a^2/(2 b) with a = 1/2 and b = sqrt(3)/2.
pub const SPREAD: f64 = 0.144_337_567_297_406_43;

/// A bed with outlets.
#[derive(Clone, Debug)]
pub struct Litwiniszyn {
    /// Who sits where.
    pub sheet: Sheet,
    /// Probability that a void goes to the left, p [-].
    pub left: f64,
    /// Voids that set out from each outlet site in a step [-], 0 to 1.
    pub rate: f64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps done.
    pub step: u64,
    /// The last move of every grain.
    pub trail: Trail,
    outlets: Vec<usize>,
    /// The last site with a grain at the start: rows follow each other, so that no grain is above any later one.
    last: usize,
}

impl Litwiniszyn {
    /// A bed on a sheet; its outlets are the sites [`OUT`] with another site above.
    pub fn new(sheet: Sheet, left: f64, rate: f64, seed: u64) -> Self {
        let trail = Trail::new(&sheet);
        let last = sheet.cells.iter().rposition(|&cell| cell >= 0).unwrap_or(0);
        let mut bed = Self { sheet, left, rate, seed, step: 0, trail, outlets: Vec::new(), last };
        bed.find_outlets();
        bed
    }

    /// Looks for outlets anew, after somebody else has changed the sheet.
    pub fn find_outlets(&mut self) {
        let sheet = &self.sheet;
        let rim = sheet.columns() * (sheet.rows() - 1);
        let open = |site: &usize| *site < rim && sheet.above(*site).iter().any(|&s| sheet.cells[s] != OUT);
        self.outlets = sheet.sites(OUT).filter(open).collect();
    }

    /// One step: every outlet sends a void with probability `rate`; calls for every site whose grain a void takes.
    pub fn advance(&mut self, arrives: &mut impl FnMut(usize)) {
        self.step += 1;
        for index in 0..self.outlets.len() {
            let outlet = self.outlets[index];
            let coin = words(self.seed, Purpose::Outlet, outlet as u32, self.step);
            if unit(coin[0], coin[1]) < self.rate {
                self.walk(outlet, arrives);
            }
        }
    }

    /// One void, from an outlet to the surface.
    fn walk(&mut self, outlet: usize, arrives: &mut impl FnMut(usize)) {
        let mut here = outlet;
        let mut coins = [0; 4];
        for row in 0.. {
            // A number of 32 bits a row: four rows to a call.
            if row % 4 == 0 {
                coins = words(self.seed, Purpose::Side, outlet as u32, (self.step << 20) | (row / 4));
            }
            let above = self.sheet.above(here);
            let side = usize::from(f64::from(coins[row as usize % 4]) >= self.left * 4_294_967_296.0);
            let either = [above[side], above[1 - side]];
            let cells = &mut self.sheet.cells;
            let Some(next) = either.into_iter().find(|&s| cells[s] >= 0) else {
                let Some(next) = either.into_iter().find(|&s| cells[s] == EMPTY && s < self.last) else { break };
                here = next;
                continue;
            };
            let grain = std::mem::replace(&mut cells[next], EMPTY);
            if here == outlet {
                self.sheet.removed.push((grain, here));
            } else {
                cells[here] = grain;
            }
            // From the upper left one goes down to the right.
            self.trail.moves(grain, self.step, [if next == above[0] { 1 } else { -1 }, -1]);
            arrives(next);
            here = next;
        }
    }
}

/// The mean number of voids that pass each site of a sheet full of grains per void that sets out, those of all outlets
/// added up: what [`Litwiniszyn`] tends to, without chance.
pub fn frequency(sheet: &Sheet, left: f64) -> Vec<f64> {
    let mut mean = vec![0.0; sheet.cells.len()];
    for site in 0..sheet.columns() * (sheet.rows() - 1) {
        let here = if sheet.cells[site] == OUT { 1.0 } else { mean[site] };
        if here == 0.0 {
            continue;
        }
        let above = sheet.above(site);
        match above.map(|s| sheet.cells[s] >= 0) {
            [true, true] => {
                mean[above[0]] += left * here;
                mean[above[1]] += (1.0 - left) * here;
            }
            [true, false] => mean[above[0]] += here,
            [false, true] => mean[above[1]] += here,
            [false, false] => {}
        }
    }
    mean
}
