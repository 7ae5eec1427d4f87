//! Single grains.

use super::{Axes, LETTERS, Sample, Sheet, Watch, axes};
use crate::about::About;
use crate::view::{View, Wants};
use std::collections::BTreeMap;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.track",
    formula: "\
Where single grains are: position [m], velocity [m/s], spin [rad/s], a row of the table for each look and grain. Grains
are numbered from 0 in the order of the names of their groups, then as they are listed; those of streams come last. With
`group` they are counted from the first one of that group; the table has the numbers among all.
Positions go on across periodic ends. A grain that is not there (yet, or any more) has no row. If only one grain is asked
for, the same numbers go into the history.",
    symbols: "",
    limits: "A table of many grains at many looks is large.",
    reference: "by definition",
};

/// Follows grains.
#[derive(Clone, Debug)]
pub(super) struct Track {
    ids: Vec<u32>,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Track, plan: &Plan) -> Track {
    let watch::Track { ids, group } = asked;
    let first = group.as_ref().map_or(0, |name| plan.first_of(name)) as u32;
    Track { ids: ids.iter().map(|id| first.saturating_add(*id)).collect(), axes: axes(plan) }
}

impl Track {
    fn names(&self) -> Vec<String> {
        let turns: Axes = if self.axes.len() == 3 { self.axes } else { &[1] };
        let of = |what: &'static str, unit: &'static str, axes: Axes| {
            axes.iter().map(move |&a| format!("{what} {} [{unit}]", LETTERS[a]))
        };
        of("position", "m", self.axes)
            .chain(of("velocity", "m/s", self.axes))
            .chain(of("spin", "rad/s", turns))
            .collect()
    }

    fn values(&self, view: &View, i: usize) -> Vec<f64> {
        let turns: Axes = if self.axes.len() == 3 { self.axes } else { &[1] };
        let (p, v, w) = (view.unwrapped(i), view.grains.velocity[i], view.grains.spin[i]);
        let plane = self.axes.iter();
        plane.clone().map(|&a| p[a]).chain(plane.map(|&a| v[a])).chain(turns.iter().map(|&a| w[a])).collect()
    }
}

impl Watch for Track {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants { spins: true, ..Wants::GRAINS }
    }

    fn scalars(&self) -> Vec<String> {
        if self.ids.len() == 1 { self.names() } else { Vec::new() }
    }

    fn sheet(&self) -> Option<Sheet> {
        Some(Sheet { coordinates: vec!["id [-]".to_owned()], values: self.names(), steady: false })
    }

    fn take(&mut self, view: &View) -> Sample {
        let index: BTreeMap<u32, usize> = view.grains.id.iter().enumerate().map(|(i, id)| (*id, i)).collect();
        let there = self.ids.iter().filter_map(|id| Some((*id, *index.get(id)?)));
        let rows: Vec<Vec<f64>> =
            there.map(|(id, i)| [f64::from(id)].into_iter().chain(self.values(view, i)).collect()).collect();
        let scalars = match (self.ids.len(), rows.first()) {
            (1, Some(row)) => row[1..].to_vec(),
            (1, None) => vec![f64::NAN; self.names().len()],
            _ => Vec::new(),
        };
        Sample { scalars, rows }
    }
}
