//! Mixing of any number of groups.

use super::{Axes, Inside, Sample, Watch, axes, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use std::collections::BTreeMap;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.mixing",
    formula: "\
How well groups are mixed, by number, over cubic cells (squares in the plane).
Lacey index    M = (S0^2 - S^2) / (S0^2 - Sr^2)                          [-]
entropy index  E = sum_c n_c H_c / (n H)                                 [-]
cells          number of cells with grains in them                       [-]
p_g share of group g among all n grains, x_cg among the n_c of a cell,
S^2 = sum_c (n_c / n) sum_g (x_cg - p_g)^2, S0^2 = sum_g p_g (1 - p_g) that of groups apart,
Sr^2 = S0^2 / m that of a random mixture, m = n / cells the mean number of grains in a cell,
H_c = -sum_g x_cg ln x_cg, H = -sum_g p_g ln p_g.
M is 0 where every cell is pure and 1 for random mixtures in the mean, for two groups that of the watch `segregation`. E is 0
where every cell is pure and 1 where every cell is as the whole; of a random mixture it lies below 1, the more the fewer grains
a cell has.",
    symbols: "",
    limits: "Depends on the size of the cells; cells at the border hold fewer. Cells begin at the origin of the scene. \
Frozen and driven grains are left out.",
    reference: "M after Lacey 1954 (J. Appl. Chem. 4, 257), summed over groups; E after Camesasca, Kaufman and Manas-Zloczower 2006 \
(Macromol. Theory Simul. 15, 595)",
};

/// Counts grains in cells.
#[derive(Clone, Debug)]
pub(super) struct Mixing {
    groups: Vec<u32>,
    cell: f64,
    region: Inside,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Mixing, plan: &Plan) -> Mixing {
    let watch::Mixing { groups, cell, region } = asked;
    let groups = match groups {
        Some(names) => names.iter().map(|name| group_number(plan, name)).collect(),
        None => (0..plan.particles.len() as u32).collect(),
    };
    Mixing { groups, cell: *cell, region: Inside::new(region.as_ref(), plan), axes: axes(plan) }
}

impl Watch for Mixing {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        ["Lacey index [-]", "entropy index [-]", "cells [-]"].map(String::from).to_vec()
    }

    fn take(&mut self, view: &View) -> Sample {
        let mut cells: BTreeMap<Vec<i64>, Vec<f64>> = BTreeMap::new();
        let mut whole = vec![0.0; self.groups.len()];
        for i in 0..view.len() {
            let Some(k) = self.groups.iter().position(|group| *group == view.grains.group[i]) else { continue };
            let p = view.position(i);
            if !view.free(i) || !self.region.holds(p) {
                continue;
            }
            let cell = self.axes.iter().map(|&a| (p[a] / self.cell).floor() as i64).collect();
            cells.entry(cell).or_insert_with(|| vec![0.0; self.groups.len()])[k] += 1.0;
            whole[k] += 1.0;
        }
        let all: f64 = whole.iter().sum();
        let share: Vec<f64> = whole.iter().map(|n| n / all).collect();
        let apart: f64 = share.iter().map(|p| p * (1.0 - p)).sum();
        let random = apart * cells.len() as f64 / all;
        let (mut variance, mut disorder) = (0.0, 0.0);
        for counts in cells.values() {
            let here: f64 = counts.iter().sum();
            let off: f64 = counts.iter().zip(&share).map(|(n, p)| (n / here - p).powi(2)).sum();
            variance += here / all * off;
            disorder += here / all * entropy(counts.iter().map(|n| n / here));
        }
        let entropy = disorder / entropy(share.iter().copied());
        let scalars = vec![(apart - variance) / (apart - random), entropy, cells.len() as f64];
        Sample { scalars, rows: Vec::new() }
    }
}

/// -sum x ln x; a share of nothing adds nothing.
fn entropy(shares: impl Iterator<Item = f64>) -> f64 {
    -shares.filter(|x| *x > 0.0).map(|x| x * libm::log(x)).sum::<f64>()
}
