//! Contacts per grain.

use super::{Inside, Sample, Watch, mean};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.coordination",
    formula: "\
Coordination number: contacts per grain, both grains of a contact counting it.
mean              Z = sum z / N over the free grains, frozen and driven ones left out       [-]
without rattlers  the same over the grains that are no rattlers, contacts with rattlers left out  [-]
rattlers          share of the grains that are rattlers                                     [-]
contacts          number of contacts of these grains, each once                             [-]
A rattler has fewer contacts than `fewest`; without it others may become rattlers, so they are taken out until none is
left. With fewest = 2 this is near the mechanical coordination number of Thornton (2000, Geotechnique 50, 43), which takes
grains with 0 and 1 contacts out once. Isostatic without friction are 2 D, with infinite friction D + 1.
Grains in a region count all their contacts, also those with grains outside.",
    symbols: "",
    limits: "Polyhedra that touch at several corners and edges have one contact, whatever the columns of the history count. A grain that touches a \
wall from two sides, or a box in a corner, has two contacts with it.",
    reference: "Thornton 2000, Geotechnique 50, 43",
};

/// Counts contacts.
#[derive(Clone, Debug)]
pub(super) struct Coordination {
    fewest: u32,
    walls: bool,
    region: Inside,
}

pub(super) fn open(asked: &watch::Coordination, plan: &Plan) -> Coordination {
    let watch::Coordination { fewest, walls, region } = asked;
    Coordination { fewest: *fewest, walls: *walls, region: Inside::new(region.as_ref(), plan) }
}

impl Coordination {
    /// Contacts of every grain with those that are left when rattlers are gone; `None` for rattlers and held grains.
    fn stripped(&self, view: &View) -> Vec<Option<u32>> {
        let mut count = view.touching(self.walls);
        let mut near: Vec<Vec<u32>> = vec![Vec::new(); view.len()];
        for c in view.pairs().filter(|c| !c.wall) {
            near[c.first].push(c.second as u32);
            near[c.second].push(c.first as u32);
        }
        let mut left: Vec<bool> = (0..view.len()).map(|i| view.free(i)).collect();
        let mut loose: Vec<usize> = (0..view.len()).filter(|&i| left[i] && count[i] < self.fewest).collect();
        while let Some(i) = loose.pop() {
            if !std::mem::take(&mut left[i]) {
                continue;
            }
            for &j in &near[i] {
                let j = j as usize;
                count[j] -= 1;
                if left[j] && count[j] < self.fewest {
                    loose.push(j);
                }
            }
        }
        count.into_iter().zip(left).map(|(count, left)| left.then_some(count)).collect()
    }
}

impl Watch for Coordination {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        ["mean [-]", "without rattlers [-]", "rattlers [-]", "contacts [-]"].map(String::from).to_vec()
    }

    fn take(&mut self, view: &View) -> Sample {
        let seen: Vec<bool> = (0..view.len()).map(|i| view.free(i) && self.region.holds(view.position(i))).collect();
        let own = || (0..view.len()).filter(|&i| seen[i]);
        let all = view.touching(self.walls);
        let stripped = self.stripped(view);
        let backbone = own().filter_map(|i| stripped[i]).map(f64::from);
        let rattlers = mean(own().map(|i| if stripped[i].is_none() { 1.0 } else { 0.0 }));
        let counted =
            view.pairs().filter(|c| (self.walls || !c.wall) && (seen[c.first] || (!c.wall && seen[c.second])));
        let scalars = vec![mean(own().map(|i| f64::from(all[i]))), mean(backbone), rattlers, counted.count() as f64];
        Sample { scalars, rows: Vec::new() }
    }
}
