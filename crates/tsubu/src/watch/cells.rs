//! Grains of some groups, counted in cubic cells (squares in the plane): what measures of mixing are made of.

use super::{Axes, Inside, axes, group_number};
use crate::view::View;
use std::collections::BTreeMap;
use tsubu_scene::plan::{Plan, Region};

/// Which grains are counted, and in which cells.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    groups: Vec<u32>,
    edge: f64,
    region: Inside,
    axes: Axes,
}

/// Numbers of grains by group.
#[derive(Clone, Debug)]
pub(super) struct Counts {
    /// In every cell that has grains.
    pub cells: BTreeMap<Vec<i64>, Vec<f64>>,
    /// In all of them.
    pub whole: Vec<f64>,
}

impl Cells {
    /// Cells with this edge [m], which begin at the origin of the scene.
    pub fn new<'a>(groups: impl Iterator<Item = &'a String>, edge: f64, region: Option<&Region>, plan: &Plan) -> Self {
        let groups = groups.map(|name| group_number(plan, name)).collect();
        Self { groups, edge, region: Inside::new(region, plan), axes: axes(plan) }
    }

    /// Counts free grains; `heard` is told of each: its place among the groups, and its index.
    pub fn count(&self, view: &View, mut heard: impl FnMut(usize, usize)) -> Counts {
        let nobody = vec![0.0; self.groups.len()];
        let mut counts = Counts { cells: BTreeMap::new(), whole: nobody.clone() };
        for i in 0..view.len() {
            let Some(group) = self.groups.iter().position(|group| *group == view.grains.group[i]) else { continue };
            let p = view.position(i);
            if !view.free(i) || !self.region.holds(p) {
                continue;
            }
            let cell = self.axes.iter().map(|&a| (p[a] / self.edge).floor() as i64).collect();
            counts.cells.entry(cell).or_insert_with(|| nobody.clone())[group] += 1.0;
            counts.whole[group] += 1.0;
            heard(group, i);
        }
        counts
    }
}

impl Counts {
    /// Number of all grains.
    pub fn all(&self) -> f64 {
        self.whole.iter().sum()
    }

    /// Share of every group.
    pub fn shares(&self) -> Vec<f64> {
        let all = self.all();
        self.whole.iter().map(|n| n / all).collect()
    }

    /// Lacey's index: (S0^2 - S^2) / (S0^2 - Sr^2), with variances summed over the groups.
    pub fn lacey(&self) -> f64 {
        let (all, shares) = (self.all(), self.shares());
        let apart: f64 = shares.iter().map(|p| p * (1.0 - p)).sum();
        let random = apart * self.cells.len() as f64 / all;
        let of_cell = |counts: &Vec<f64>| {
            let here: f64 = counts.iter().sum();
            here / all * counts.iter().zip(&shares).map(|(n, p)| (n / here - p).powi(2)).sum::<f64>()
        };
        let variance: f64 = self.cells.values().map(of_cell).sum();
        // One grain in every cell: apart and mixed at random are the same.
        if apart > random { (apart - variance) / (apart - random) } else { f64::NAN }
    }
}
