//! Mixing of two groups.

use super::cells::Cells;
use super::{Sample, Watch};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.segregation",
    formula: "\
How well two groups are mixed, by number.
Lacey index        M = (S0^2 - S^2) / (S0^2 - Sr^2)                                        [-]
height difference  mean height of the first group less that of the second, by mass        [m]
share              p, number of the first group over that of both                          [-]
cells              number of cells with grains in them                                     [-]
S^2 is the variance of the share of the first group over cubic cells (squares in the plane), each weighed by its grains;
S0^2 = p (1 - p) is that of groups apart, Sr^2 = p (1 - p) / n that of a random mixture, n the mean number of grains in a
cell. M is 0 where every cell is pure and 1 for random mixtures in the mean: a single one lies above or below 1 by chance, by
about sqrt(2 / cells) / (n - 1). More than that above 1 is order: groups in perfect order reach n / (n - 1). M is not cut at 1.",
    symbols: "",
    limits: "Depends on the size of the cells; cells at the border hold fewer. Cells begin at the origin of the scene. \
Frozen and driven grains are left out. Where every cell holds one grain Lacey's index is not a number: take larger ones.",
    reference: "Lacey 1954 (J. Appl. Chem. 4, 257)",
};

/// Counts grains in cells.
#[derive(Clone, Debug)]
pub(super) struct Segregation {
    cells: Cells,
}

pub(super) fn open(asked: &watch::Segregation, plan: &Plan) -> Segregation {
    let watch::Segregation { groups, cell, region } = asked;
    Segregation { cells: Cells::new(groups.iter(), *cell, region.as_ref(), plan) }
}

impl Watch for Segregation {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        ["Lacey index [-]", "height difference [m]", "share [-]", "cells [-]"].map(String::from).to_vec()
    }

    fn take(&mut self, view: &View) -> Sample {
        let (mut mass, mut moment) = ([0.0; 2], [0.0; 2]);
        let counts = self.cells.count(view, |k, i| {
            mass[k] += view.grains.mass[i];
            moment[k] += view.grains.mass[i] * view.position(i).z;
        });
        let height = |k: usize| moment[k] / mass[k];
        let scalars = vec![counts.lacey(), height(0) - height(1), counts.shares()[0], counts.cells.len() as f64];
        Sample { scalars, rows: Vec::new() }
    }
}
