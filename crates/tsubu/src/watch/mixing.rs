//! Mixing of any number of groups.

use super::cells::Cells;
use super::{Sample, Watch};
use crate::about::About;
use crate::view::{View, Wants};
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
Frozen and driven grains are left out. Where every cell holds one grain Lacey's index is not a number: take larger ones.",
    reference: "M after Lacey 1954 (J. Appl. Chem. 4, 257), summed over groups; E after Camesasca, Kaufman and Manas-Zloczower 2006 \
(Macromol. Theory Simul. 15, 595)",
};

/// Counts grains in cells.
#[derive(Clone, Debug)]
pub(super) struct Mixing {
    cells: Cells,
}

pub(super) fn open(asked: &watch::Mixing, plan: &Plan) -> Mixing {
    let watch::Mixing { groups, cell, region } = asked;
    let cells = match groups {
        Some(names) => Cells::new(names.iter(), *cell, region.as_ref(), plan),
        None => Cells::new(plan.particles.keys(), *cell, region.as_ref(), plan),
    };
    Mixing { cells }
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
        let counts = self.cells.count(view, |_, _| ());
        let all = counts.all();
        let of_cell = |counts: &Vec<f64>| {
            let here: f64 = counts.iter().sum();
            here / all * entropy(counts.iter().map(|n| n / here))
        };
        let disorder: f64 = counts.cells.values().map(of_cell).sum();
        let entropy = disorder / entropy(counts.shares().into_iter());
        Sample { scalars: vec![counts.lacey(), entropy, counts.cells.len() as f64], rows: Vec::new() }
    }
}

/// -sum x ln x; a share of nothing adds nothing.
fn entropy(shares: impl Iterator<Item = f64>) -> f64 {
    -shares.filter(|x| *x > 0.0).map(|x| x * libm::log(x)).sum::<f64>()
}
