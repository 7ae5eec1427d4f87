//! Contacts one by one.

use super::{Axes, Inside, LETTERS, Sample, Sheet, Watch, axes};
use crate::about::About;
use crate::view::{Contact, View, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.contacts",
    formula: "\
The contacts one by one, a row of the table for each look and contact
first, second     numbers of both grains, or of a grain and a wall (`wall` is 1)
position, normal  where they touch [m]; unit vector from the first to the second
force, overlap    on the first [N]; how deep [m]
and in the history
contacts          how many there are
deepest overlap, largest force
Walls are numbered from 0 in the order of their names. The region holds points of contact; a point
beyond a periodic end is put back between the ends. Where some grains are no spheres, also
first body, second body   their numbers, which are those of their first grains; 0 for a wall
pairs of bodies   how many touch, each once however many of their grains do; without walls",
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
    /// Whether some grains are pieces of bodies.
    bodies: bool,
}

pub(super) fn open(asked: &watch::Contacts, plan: &Plan) -> List {
    let watch::Contacts { walls, region } = asked;
    let bodies = plan.particles.values().any(|group| group.shape.is_clump());
    List { walls: *walls, region: Inside::new(region.as_ref(), plan), axes: axes(plan), bodies }
}

impl List {
    fn vector(&self, v: DVec3) -> impl Iterator<Item = f64> {
        self.axes.iter().map(move |&a| v[a])
    }

    fn row(&self, view: &View, place: DVec3, c: &Contact) -> Vec<f64> {
        let id = |i: usize| f64::from(view.grains.id[i]);
        let second = if c.wall { c.second as f64 } else { id(c.second) };
        let vectors = [place, c.normal, c.force].into_iter().flat_map(|v| self.vector(v));
        let numbers = [id(c.first), second, f64::from(u8::from(c.wall))];
        let bodies = self.bodies.then(|| bodies(view, c).map(f64::from));
        numbers.into_iter().chain(bodies.into_iter().flatten()).chain(vectors).chain([c.overlap]).collect()
    }
}

/// Numbers of the bodies that touch: of a sphere its own, of any other that of its first grain, of a wall 0.
fn bodies(view: &View, c: &Contact) -> [u32; 2] {
    let body = |i: usize| {
        let first = view.body_of.get(i).copied().flatten().map_or(i, |body| view.bodies[body as usize].grain);
        view.grains.id[first]
    };
    [body(c.first), if c.wall { 0 } else { body(c.second) }]
}

impl Watch for List {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants { bodies: self.bodies, ..Wants::CONTACTS }
    }

    fn scalars(&self) -> Vec<String> {
        let names = ["contacts [-]", "deepest overlap [m]", "largest force [N]"].into_iter();
        names.chain(self.bodies.then_some("pairs of bodies [-]")).map(String::from).collect()
    }

    fn sheet(&self) -> Option<Sheet> {
        let of = |what: &'static str, unit: &'static str| {
            self.axes.iter().map(move |&a| format!("{what} {} [{unit}]", LETTERS[a]))
        };
        let coordinates = ["first [-]", "second [-]", "wall [-]"];
        let bodies = self.bodies.then_some(["first body [-]", "second body [-]"]).into_iter().flatten();
        Some(Sheet {
            coordinates: coordinates.into_iter().chain(bodies).map(String::from).collect(),
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
        let mut scalars = vec![listed.len() as f64, largest(&|c| c.overlap), largest(&|c| c.force.length())];
        if self.bodies {
            let mut pairs: Vec<[u32; 2]> =
                listed.iter().filter(|(_, c)| !c.wall).map(|(_, c)| bodies(view, c)).collect();
            for pair in &mut pairs {
                pair.sort_unstable();
            }
            pairs.sort_unstable();
            pairs.dedup();
            scalars.push(pairs.len() as f64);
        }
        Sample { scalars, rows }
    }
}
