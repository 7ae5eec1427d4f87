//! Grains that have passed a plane.

use super::classes::Classes;
use super::{Sample, Watch, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.discharge",
    formula: "\
Grains that have passed a plane along its normal since the first look, less those that came back.
passed grains  number                                                            [-]
passed mass    their mass                                                        [kg]
rate           change of the number since the last look over the time between    [1/s]
mass rate      the same for the mass                                             [kg/s]
With `sizes` also `passed mass below 1 mm`, `passed mass 1 mm to 2 mm`, `passed mass from 2 mm`: the mass of grains by diameter. [kg]
A grain has passed when its centre has. Where the world repeats itself along the normal, every passage counts. Grains that
come into the world in front of the plane do not count. One that vanished (see `removal`) between two looks counts if in
free fall from where and as fast as it was last seen it would have passed by now: look often enough to see grains that pass.
The mean of the rate is nearly the number that passed over the time from the first to the last look; exactly, where `every` is a whole number of steps.",
    symbols: "",
    limits: "A passage between two looks is seen only by where a grain is at the looks.",
    reference: "by definition",
};

/// Where a grain was last seen.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    /// Whole periods that it has passed; without periods -1 behind the plane and 0 in front.
    side: i64,
    mass: f64,
    /// Diameter [m].
    diameter: f64,
    /// Distance in front of the plane [m] and speed along the normal [m/s].
    ahead: f64,
    speed: f64,
}

/// Counts what passes.
#[derive(Clone, Debug)]
pub(super) struct Discharge {
    point: DVec3,
    normal: DVec3,
    group: Option<u32>,
    gravity: DVec3,
    seen: BTreeMap<u32, Seen>,
    /// Times of the first and the last look, and of the look that last saw a grain pass [s].
    first: Option<f64>,
    last: Option<f64>,
    passage: Option<f64>,
    /// Free grains that are still behind the plane, if it has two sides.
    waiting: i64,
    passed: i64,
    mass: f64,
    /// The classes by diameter, and the mass of each that has passed [kg].
    classes: Classes,
    by_size: Vec<f64>,
}

/// An outlet that nothing has passed for this share of the time is worth a word.
const QUIET: f64 = 0.25;

pub(super) fn open(asked: &watch::Discharge, plan: &Plan) -> Discharge {
    let watch::Discharge { point, normal, group, sizes } = asked;
    let classes = Classes::new(sizes.as_ref());
    Discharge {
        point: DVec3::from_array(*point),
        normal: DVec3::from_array(*normal),
        group: group.as_ref().map(|name| group_number(plan, name)),
        gravity: DVec3::from_array(plan.gravity),
        seen: BTreeMap::new(),
        first: None,
        last: None,
        passage: None,
        waiting: 0,
        passed: 0,
        mass: 0.0,
        by_size: vec![0.0; classes.len()],
        classes,
    }
}

impl Discharge {
    /// The period along the normal, if the world repeats itself along it.
    fn period(&self, view: &View) -> Option<f64> {
        let axis = (0..3).find(|&a| self.normal[a].abs() > 1.0 - 1e-12)?;
        view.periodic[axis].map(|[low, high]| high - low)
    }

    /// Books a grain that has passed so many times.
    fn pass(&mut self, times: i64, grain: &Seen) {
        self.passed += times;
        self.mass += times as f64 * grain.mass;
        if let Some(mass) = self.by_size.get_mut(self.classes.of(grain.diameter)) {
            *mass += times as f64 * grain.mass;
        }
    }

    fn look(&self, view: &View, i: usize, period: Option<f64>) -> Seen {
        let ahead = (view.unwrapped(i) - self.point).dot(self.normal);
        let side = match period {
            Some(period) => (ahead / period).floor() as i64,
            None => i64::from(ahead >= 0.0) - 1,
        };
        let diameter = 2.0 * view.grains.radius[i];
        Seen { side, mass: view.grains.mass[i], diameter, ahead, speed: view.grains.velocity[i].dot(self.normal) }
    }
}

impl Watch for Discharge {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        let all = ["passed grains [-]", "passed mass [kg]", "rate [1/s]", "mass rate [kg/s]"].map(String::from);
        let of_class = self.classes.names().map(|class| format!("passed mass {class} [kg]"));
        all.into_iter().chain(of_class).collect()
    }

    fn so_far(&self) -> &'static [&'static str] {
        &["passed"]
    }

    fn take(&mut self, view: &View) -> Sample {
        let (before, mass_before) = (self.passed, self.mass);
        let elapsed = self.last.map_or(f64::NAN, |last| view.time - last);
        let period = self.period(view);
        let mut gone = std::mem::take(&mut self.seen);
        self.waiting = 0;
        for i in 0..view.len() {
            if self.group.is_some_and(|group| view.grains.group[i] != group) {
                continue;
            }
            let id = view.grains.id[i];
            let now = self.look(view, i, period);
            if let Some(old) = gone.remove(&id) {
                self.pass(now.side - old.side, &now);
            }
            self.waiting += i64::from(period.is_none() && now.side < 0 && view.free(i));
            self.seen.insert(id, now);
        }
        let pull = self.gravity.dot(self.normal);
        for old in &gone.into_values().collect::<Vec<_>>() {
            let fallen = old.ahead + old.speed * elapsed + 0.5 * pull * elapsed * elapsed;
            if period.is_none() && old.side < 0 && fallen >= 0.0 {
                self.pass(1, old);
            }
        }
        self.first = self.first.or(Some(view.time));
        self.last = Some(view.time);
        if self.passed > before {
            self.passage = self.last;
        }
        let rates = [(self.passed - before) as f64 / elapsed, (self.mass - mass_before) / elapsed];
        let all = [self.passed as f64, self.mass, rates[0], rates[1]];
        Sample { scalars: all.into_iter().chain(self.by_size.iter().copied()).collect(), rows: Vec::new() }
    }

    /// Of outlets, which grains fall through, that have come to a stop with grains above them. One that nothing has passed may be shut, and
    /// opened by a later stage.
    fn remark(&self, last: bool) -> Option<String> {
        let (begin, end) = (self.first?, self.last?);
        let quiet = end - self.passage.unwrap_or(begin) > QUIET * (end - begin);
        let down = self.gravity.dot(self.normal) > 0.5 * self.gravity.length();
        let shut = self.passage.is_none() && !last;
        if !quiet || !down || self.waiting == 0 || shut {
            return None;
        }
        let verb = if self.waiting == 1 { "is" } else { "are" };
        let who = match self.passage {
            Some(time) => format!("since t = {time} s and {} {verb} still before it", self.waiting),
            None => format!("and {} {verb} before it", self.waiting),
        };
        Some(format!("no grain has passed {who}: the outlet may be blocked"))
    }

    fn save(&self, name: &str, state: &mut State) {
        let whole = self.seen.iter().flat_map(|(id, seen)| [i64::from(*id), seen.side]);
        let counts = [self.passed, self.waiting];
        state.put_integer(&format!("{name}.seen"), counts.into_iter().chain(whole).collect::<Vec<_>>());
        let real = self.seen.values().flat_map(|seen| [seen.mass, seen.ahead, seen.speed]);
        if !self.by_size.is_empty() {
            let diameters = self.seen.values().map(|seen| seen.diameter);
            let sizes = self.by_size.iter().copied().chain(diameters);
            state.put_real(&format!("{name}.sizes"), sizes.collect::<Vec<_>>());
        }
        let [first, last, passage] = [self.first, self.last, self.passage].map(|time| time.unwrap_or(f64::NAN));
        let head = [self.mass, first, last, passage];
        state.put_real(&format!("{name}.seen-real"), head.into_iter().chain(real).collect::<Vec<_>>());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let key = format!("{name}.seen");
        let wrong = || MissingSection { name: key.clone(), kind: "integer" };
        let (Some(([passed, waiting], whole)), Some(([mass, times @ ..], real))) = (
            state.integer(&key)?.split_first_chunk::<2>(),
            state.real(&format!("{name}.seen-real"))?.split_first_chunk::<4>(),
        ) else {
            return Err(wrong());
        };
        if 3 * whole.len() != 2 * real.len() {
            return Err(wrong());
        }
        (self.passed, self.waiting, self.mass) = (*passed, *waiting, *mass);
        let times: [f64; 3] = *times;
        [self.first, self.last, self.passage] = times.map(|time| Some(time).filter(|t| !t.is_nan()));
        // Without classes nobody asks how large they are.
        let mut diameters = vec![0.0; whole.len() / 2];
        if !self.by_size.is_empty() {
            let sizes = state.real(&format!("{name}.sizes"))?;
            if sizes.len() != self.by_size.len() + diameters.len() {
                return Err(wrong());
            }
            let (by_size, of_grains) = sizes.split_at(self.by_size.len());
            (self.by_size, diameters) = (by_size.to_vec(), of_grains.to_vec());
        }
        let pairs = whole.as_chunks::<2>().0.iter().zip(real.as_chunks::<3>().0).zip(diameters);
        let seen = |((&[id, side], &[mass, ahead, speed]), diameter): ((&[i64; 2], &[f64; 3]), f64)| {
            (id as u32, Seen { side, mass, diameter, ahead, speed })
        };
        self.seen = pairs.map(seen).collect();
        Ok(())
    }
}
