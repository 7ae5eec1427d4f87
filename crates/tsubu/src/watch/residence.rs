//! How long grains stay in a region.

use super::{Inside, Sample, Sheet, Watch, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use std::collections::BTreeMap;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.residence",
    formula: "\
How long grains stay in a region, from the look that first sees them inside to the look that no longer does.
inside                 grains that are inside now                                                    [-]
left                   grains that have left so far, by an edge of it or because they were removed   [-]
residence time         mean of those that came in and left since the first look                      [s]
residence time spread  their standard deviation                                                      [s]
age                    mean time since those inside came in, or since the first look                 [s]
Grains that are inside at the first look count among `inside` and `left`; nobody knows since when they are there, so they have
no residence time. One that comes back begins anew. The table has a row for every grain that left: its id, when it came and how
long it stayed.",
    symbols: "",
    limits: "Known to the time between two looks. Frozen and driven grains are left out.",
    reference: "by definition; Danckwerts 1953 (Chem. Eng. Sci. 2, 1)",
};

/// Knows who is inside since when.
#[derive(Clone, Debug)]
pub(super) struct Residence {
    region: Inside,
    group: Option<u32>,
    /// Since when those inside are there.
    inside: BTreeMap<u32, Entry>,
    begun: bool,
    left: u64,
    /// Number, sum [s] and sum of squares [s^2] of the residence times.
    sums: [f64; 3],
}

/// When a grain was first seen inside [s], and whether it was seen to come.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    time: f64,
    seen: bool,
}

pub(super) fn open(asked: &watch::Residence, plan: &Plan) -> Residence {
    let watch::Residence { region, group } = asked;
    Residence {
        region: Inside::new(Some(region), plan),
        group: group.as_ref().map(|name| group_number(plan, name)),
        inside: BTreeMap::new(),
        begun: false,
        left: 0,
        sums: [0.0; 3],
    }
}

impl Watch for Residence {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        ["inside [-]", "left [-]", "residence time [s]", "residence time spread [s]", "age [s]"]
            .map(String::from)
            .to_vec()
    }

    fn so_far(&self) -> &'static [&'static str] {
        &["left", "residence time"]
    }

    fn sheet(&self) -> Option<Sheet> {
        let values = ["came [s]", "residence time [s]"].map(str::to_owned).to_vec();
        Some(Sheet { coordinates: vec!["id [-]".to_owned()], values, steady: false })
    }

    fn take(&mut self, view: &View) -> Sample {
        let mut before = std::mem::take(&mut self.inside);
        for i in 0..view.len() {
            let of_group = self.group.is_none_or(|group| view.grains.group[i] == group);
            if of_group && view.free(i) && self.region.holds(view.position(i)) {
                let id = view.grains.id[i];
                let entry = before.remove(&id).unwrap_or(Entry { time: view.time, seen: self.begun });
                self.inside.insert(id, entry);
            }
        }
        self.begun = true;
        self.left += before.len() as u64;
        let mut rows = Vec::new();
        for (id, entry) in before.into_iter().filter(|(_, entry)| entry.seen) {
            let stayed = view.time - entry.time;
            let [count, sum, squares] = self.sums;
            self.sums = [count + 1.0, sum + stayed, squares + stayed * stayed];
            rows.push(vec![f64::from(id), entry.time, stayed]);
        }
        let [count, sum, squares] = self.sums;
        let mean = sum / count;
        let spread = (squares / count - mean * mean).max(0.0).sqrt();
        // The larger of nothing known and 0 would be 0.
        let spread = if count > 0.0 { spread } else { f64::NAN };
        let age = super::mean(self.inside.values().map(|entry| view.time - entry.time));
        Sample { scalars: vec![self.inside.len() as f64, self.left as f64, mean, spread, age], rows }
    }

    fn save(&self, name: &str, state: &mut State) {
        let whole = self.inside.iter().flat_map(|(id, entry)| [i64::from(*id), i64::from(entry.seen)]);
        let head = [self.left as i64, i64::from(self.begun)];
        state.put_integer(&format!("{name}.inside"), head.into_iter().chain(whole).collect::<Vec<_>>());
        let times = self.inside.values().map(|entry| entry.time);
        state.put_real(&format!("{name}.times"), self.sums.into_iter().chain(times).collect::<Vec<_>>());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let key = format!("{name}.inside");
        let (Some(([left, begun], whole)), Some((sums, times))) = (
            state.integer(&key)?.split_first_chunk::<2>(),
            state.real(&format!("{name}.times"))?.split_first_chunk::<3>(),
        ) else {
            return Err(MissingSection { name: key, kind: "integer" });
        };
        if whole.len() != 2 * times.len() {
            return Err(MissingSection { name: key, kind: "integer" });
        }
        (self.left, self.begun, self.sums) = (*left as u64, *begun != 0, *sums);
        let entry = |(&[id, seen], &time): (&[i64; 2], &f64)| (id as u32, Entry { time, seen: seen != 0 });
        self.inside = whole.as_chunks::<2>().0.iter().zip(times).map(entry).collect();
        Ok(())
    }
}
