//! Mixing of two groups.

use super::{Axes, Inside, Sample, Watch, axes, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use std::collections::BTreeMap;
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
Frozen and driven grains are left out.",
    reference: "Lacey 1954 (J. Appl. Chem. 4, 257)",
};

/// Counts grains in cells.
#[derive(Clone, Debug)]
pub(super) struct Segregation {
    groups: [u32; 2],
    cell: f64,
    region: Inside,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Segregation, plan: &Plan) -> Segregation {
    let watch::Segregation { groups, cell, region } = asked;
    Segregation {
        groups: [0, 1].map(|k| group_number(plan, &groups[k])),
        cell: *cell,
        region: Inside::new(region.as_ref(), plan),
        axes: axes(plan),
    }
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
        let mut cells: BTreeMap<Vec<i64>, [f64; 2]> = BTreeMap::new();
        let (mut number, mut mass, mut moment) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for i in 0..view.len() {
            let Some(k) = self.groups.iter().position(|group| *group == view.grains.group[i]) else { continue };
            let p = view.position(i);
            if !view.free(i) || !self.region.holds(p) {
                continue;
            }
            let cell = self.axes.iter().map(|&a| (p[a] / self.cell).floor() as i64).collect();
            cells.entry(cell).or_default()[k] += 1.0;
            number[k] += 1.0;
            mass[k] += view.grains.mass[i];
            moment[k] += view.grains.mass[i] * p.z;
        }
        let all = number[0] + number[1];
        let share = number[0] / all;
        let apart = share * (1.0 - share);
        let variance: f64 = cells.values().map(|[a, b]| (a + b) / all * (a / (a + b) - share).powi(2)).sum();
        let random = apart * cells.len() as f64 / all;
        let height = |k: usize| moment[k] / mass[k];
        let scalars = vec![(apart - variance) / (apart - random), height(0) - height(1), share, cells.len() as f64];
        Sample { scalars, rows: Vec::new() }
    }
}
