//! After Hemmingsson, Herrmann and Roux (1997): contact forces are handed down through a pile at rest, row by row.
//!
//! Every grain adds its weight to the sum T of the forces from above, T = (x to the right, z down), and hands T on to the
//! two grains below it, which stand 30 degrees from the vertical. Without friction
//!
//! ```text
//! f_left = T_z / sqrt(3) - T_x,    f_right = T_z / sqrt(3) + T_x        both at least 0: contacts push, they do not pull
//! ```
//!
//! When T leans further than 30 degrees, one contact opens and the other carries all, as far as friction mu holds it: up to
//! 30 degrees + atan(mu). What is still left over is level; it goes to the neighbour on that side, and from there on,
//! until somebody can take it. The vertical part of T always finds its way down, so the base carries the weight to the
//! last digit. A level force that finds no neighbour stays [unbalanced](Pile::unbalanced): such a pile would move.
//!
//! Two other ways to hand on: [`Split::Random`], in random shares of the vertical load alone (the q-model), and
//! `arching`, the probability with which a grain gives all of T to its outer neighbour below.

use super::sheet::{EMPTY, OUT, Sheet, WALL};
use crate::about::About;
use crate::random::{Purpose, unit, words};

pub(crate) const ABOUT: About = About {
    key: "method.after-hemmingsson-herrmann",
    formula: "f_left = T_z/sqrt(3) - T_x, f_right = T_z/sqrt(3) + T_x, both at least 0; what friction cannot hold goes to the neighbour",
    symbols: "T sum of the forces from above and the weight, x to the right, z down [N], f on the two grains below [N]",
    limits: "A pile at rest on a triangular lattice: nothing moves. Only vertical balance is exact where level forces \
find no neighbour.",
    reference: "after Hemmingsson, Herrmann and Roux 1997",
};

/// tan 30 degrees.
const TANGENT: f64 = 0.577_350_269_189_625_8;

/// How a grain shares what it carries between the two below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// As forces balance.
    Vector,
    /// In random shares, each as likely, of the vertical load.
    Random,
}

/// Choices of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// How loads are shared.
    pub split: Split,
    /// Friction coefficient between grains, mu [-].
    pub friction: f64,
    /// Probability that all goes to the outer neighbour [-].
    pub arching: f64,
}

/// A force from one site to another [N]: to the right, and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passed {
    /// Who gives it.
    pub from: usize,
    /// Who takes it: a grain or a wall.
    pub to: usize,
    /// To the right, and down [N].
    pub force: [f64; 2],
}

/// A pile, and how far its forces are known.
#[derive(Clone, Debug)]
pub struct Pile {
    /// Who sits where.
    pub sheet: Sheet,
    /// The rule.
    pub rule: Rule,
    /// Weight of every grain [N].
    pub weight: Vec<f64>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Level position of the axis, in spacings.
    pub axis: f64,
    /// Rows done, from the top.
    pub step: u64,
    /// Force on every site from above and from the side, own weight included once its row is done [N].
    pub load: Vec<[f64; 2]>,
    /// Level force that nobody takes, summed without sign [N].
    pub unbalanced: f64,
    /// Weight that nothing carries [N].
    pub falling: f64,
    /// Tangents of the steepest and the flattest lean that one contact holds.
    cone: [f64; 2],
}

impl Pile {
    /// A pile on a sheet; the axis is that of its centre of mass.
    pub fn new(sheet: Sheet, rule: Rule, weight: Vec<f64>, seed: u64) -> Self {
        let (mut mass, mut moment) = (0.0, 0.0);
        for (site, &cell) in sheet.cells.iter().enumerate() {
            if let Ok(grain) = usize::try_from(cell) {
                mass += weight[grain];
                moment += weight[grain] * sheet.point(site)[0];
            }
        }
        let load = vec![[0.0; 2]; sheet.cells.len()];
        let axis = moment / f64::max(mass, f64::MIN_POSITIVE);
        let angle = rule.friction.atan();
        let cone = [1.0, -1.0].map(|side| (std::f64::consts::FRAC_PI_6 + side * angle).min(1.57).tan());
        Self { sheet, rule, weight, seed, axis, step: 0, load, unbalanced: 0.0, falling: 0.0, cone }
    }

    /// Rows to do.
    pub fn rows(&self) -> u64 {
        self.sheet.rows() as u64 - 2
    }

    /// Does the next row; tells every force it hands on. Nothing is left to do after [`Self::rows`] steps.
    pub fn advance(&mut self, tell: &mut impl FnMut(Passed)) {
        if self.step < self.rows() {
            let row = self.sheet.rows() - 2 - self.step as usize;
            let sites = self.sheet.index(1, row)..self.sheet.index(self.sheet.columns() - 1, row);
            for site in sites.clone() {
                if let Ok(grain) = usize::try_from(self.sheet.cells[site]) {
                    self.load[site][1] += self.weight[grain];
                }
            }
            if self.rule.split == Split::Vector {
                self.lean(sites.clone(), tell);
            }
            for site in sites {
                if self.sheet.cells[site] >= 0 {
                    self.hand_down(site, tell);
                }
            }
        }
        self.step += 1;
    }

    /// Level forces go from neighbour to neighbour until all that are left over have been taken.
    fn lean(&mut self, sites: std::ops::Range<usize>, tell: &mut impl FnMut(Passed)) {
        for _ in sites.clone() {
            let mut moved = false;
            for (site, side) in sites.clone().map(|s| (s, 1)).chain(sites.clone().rev().map(|s| (s, -1))) {
                let excess = self.excess(site);
                let to = site.wrapping_add_signed(side);
                if excess * side as f64 <= 0.0 || matches!(self.sheet.cells[to], EMPTY | OUT) {
                    continue;
                }
                self.load[site][0] -= excess;
                self.load[to][0] += excess;
                moved |= self.sheet.cells[to] != WALL;
                tell(Passed { from: site, to, force: [excess, 0.0] });
            }
            if !moved {
                break;
            }
        }
    }

    /// The level part of a site's load that the sites below cannot take [N].
    fn excess(&self, site: usize) -> f64 {
        let [x, z] = self.load[site];
        if self.sheet.cells[site] < 0 || z <= 0.0 {
            return 0.0;
        }
        let [wide, narrow] = self.cone;
        let (low, high) = match self.stands(site) {
            [true, true] => (-wide, wide),
            [false, true] => (narrow, wide),
            [true, false] => (-wide, -narrow),
            [false, false] => return 0.0,
        };
        let excess = x - z * (x / z).clamp(low, high);
        // What rounding leaves is not worth handing on.
        if excess.abs() > 1e-13 * z { excess } else { 0.0 }
    }

    /// Whether the sites below, left and right, carry.
    fn stands(&self, site: usize) -> [bool; 2] {
        self.sheet.below(site).map(|s| !matches!(self.sheet.cells[s], EMPTY | OUT))
    }

    /// Gives what a grain carries to those below.
    fn hand_down(&mut self, site: usize, tell: &mut impl FnMut(Passed)) {
        let below = self.sheet.below(site);
        let excess = if self.rule.split == Split::Vector { self.excess(site) } else { 0.0 };
        self.unbalanced += excess.abs();
        let [x, z] = [self.load[site][0] - excess, self.load[site][1]];
        let left = match self.stands(site) {
            [false, false] => {
                self.falling += z;
                return;
            }
            [true, false] => [x, z],
            [false, true] => [0.0, 0.0],
            [true, true] => self.left_share(site, x, z),
        };
        for (to, force) in below.into_iter().zip([left, [x - left[0], z - left[1]]]) {
            if force != [0.0; 2] {
                self.load[to][0] += force[0];
                self.load[to][1] += force[1];
                tell(Passed { from: site, to, force });
            }
        }
    }

    /// What the left one of two grains below takes.
    fn left_share(&self, site: usize, x: f64, z: f64) -> [f64; 2] {
        let coins = words(self.seed, Purpose::Side, site as u32, 0);
        let outward = self.sheet.point(site)[0] - self.axis;
        if self.rule.arching > 0.0 && unit(coins[0], coins[1]) < self.rule.arching && outward.abs() > 1e-9 {
            return if outward < 0.0 { [x, z] } else { [0.0, 0.0] };
        }
        if self.rule.split == Split::Random {
            return [0.0, z * unit(coins[2], coins[3])];
        }
        // Along the line of centres, half of it level: f_left = z / sqrt(3) - x, between nothing and all.
        if x >= z * TANGENT {
            [0.0, 0.0]
        } else if x <= -z * TANGENT {
            [x, z]
        } else {
            let push = z * TANGENT - x;
            [-0.5 * push, 0.5 * push / TANGENT]
        }
    }
}
