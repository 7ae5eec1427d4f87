//! Contacts one by one.

use super::{Axes, Inside, LETTERS, Sample, Sheet, Watch, axes};
use crate::about::About;
use crate::view::{Contact, View, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.contacts",
    formula: "\
The contacts one by one, a row of the table for each look and contact: numbers of both grains, or of a grain and a wall (walls
are numbered from 0 in the order of their names, and `wall` is 1), point of contact [m], unit normal from the first to the
second, force on the first [N], overlap [m]. In the history: how many there are, the deepest overlap, the largest force.
The region holds points of contact; a point beyond a periodic end is put back between the ends.",
    symbols: "",
    limits: "The list is long. A look at every contact of a large bed is a large table; look rarely.",
    reference: "by definition",
};

/// Lists contacts.
#[derive(Clone, Debug)]
pub(super) struct List {
    region: Inside,
    walls: bool,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Contacts, plan: &Plan) -> List {
    let watch::Contacts { walls, region } = asked;
    List { walls: *walls, region: Inside::new(region.as_ref(), plan), axes: axes(plan) }
}

impl List {
    fn vector(&self, v: DVec3) -> impl Iterator<Item = f64> {
        self.axes.iter().map(move |&a| v[a])
    }

    fn row(&self, view: &View, place: DVec3, c: &Contact) -> Vec<f64> {
        let id = |i: usize| f64::from(view.grains.id[i]);
        let second = if c.wall { c.second as f64 } else { id(c.second) };
        let vectors = [place, c.normal, c.force].into_iter().flat_map(|v| self.vector(v));
        [id(c.first), second, f64::from(u8::from(c.wall))].into_iter().chain(vectors).chain([c.overlap]).collect()
    }
}

impl Watch for List {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        ["contacts [-]", "deepest overlap [m]", "largest force [N]"].map(String::from).to_vec()
    }

    fn sheet(&self) -> Option<Sheet> {
        let of = |what: &'static str, unit: &'static str| {
            self.axes.iter().map(move |&a| format!("{what} {} [{unit}]", LETTERS[a]))
        };
        Some(Sheet {
            coordinates: ["first [-]", "second [-]", "wall [-]"].map(String::from).to_vec(),
            values: of("position", "m")
                .chain(of("normal", "-"))
                .chain(of("force", "N"))
                .chain(["overlap [m]".to_owned()])
                .collect(),
            steady: false,
        })
    }

    fn take(&mut self, view: &View) -> Sample {
        let placed = view.contacts.iter().map(|c| (view.put(c.position), c));
        let listed: Vec<_> = placed.filter(|(place, c)| (self.walls || !c.wall) && self.region.holds(*place)).collect();
        let largest = |of: &dyn Fn(&Contact) -> f64| listed.iter().map(|(_, c)| of(c)).fold(0.0, f64::max);
        let mut rows: Vec<Vec<f64>> = listed.iter().map(|(place, c)| self.row(view, *place, c)).collect();
        // The order of the engine's own lists says nothing.
        rows.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        let scalars = vec![listed.len() as f64, largest(&|c| c.overlap), largest(&|c| c.force.length())];
        Sample { scalars, rows }
    }
}
