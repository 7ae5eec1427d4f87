//! Hops of grains over a bed.

use super::course::{Course, Hop, NUMBERS, Phase, Seen, Sense, Touch};
use super::means::Means;
use super::{Axes, LETTERS, Sample, Sheet, Watch, axes, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Bed, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.hops",
    formula: "\
Hops: a grain that touched the bed leaves it, flies, and touches it again. The bed is what `bed` names: walls, frozen and
driven grains, other free grains. Touching is overlap; the contact is from the first touch of the bed to the last.
A row of the table for each finished hop, at the look that saw it end, with the contact that it began with:
start           time of take-off                                                                  [s]
height          highest centre along `up` above that at take-off                                  [m]
length          way of the centre along `along`, going on across periodic ends                    [m]
flight time     from take-off to the next touch                                                   [s]
impact angle    of the velocity against the bed, below the plane across `up`, before it                   [rad]
impact speed    before the contact, against the bed                                               [m/s]
rebound speed   after it                                                                          [m/s]
restitution     normal speed after the contact over that before, each along its own normal        [-]
contact time    from first touch to take-off                                                      [s]
overlap         the largest of the contact                                                        [m]
spin            before the contact                                                                [rad/s]
The history has the number of hops so far, their means, the highest and the deepest.
What nobody has seen is left out: a flight that was under way at the first look is no hop, and a contact that was there
then has no impact (`NaN`). A grain that comes to rest ends its last hop when it lands; that impact has no row. `from`
discards what is before; `lowest` leaves out the rattling of a grain between two others; after `most` hops the watch rests.",
    symbols: "",
    limits: "It looks at every step unless `every` is given, and a contact or flight between two looks is not seen: 10 \
looks a contact are few. Times of touch and take-off are taken between looks from overlap and speed, and are \
off by much less than a look where the look is short against the contact, by at most one where it is not; \
the apex is that of a parabola between looks. Speeds before and after a contact are those of the nearest \
look off the bed. Walls count as still. Where a grain touches several bodies the deepest gives the normal.",
    reference: "Niño and Garcia 1998 (Hydrol. Process. 12, 1197) for what a hop is; contact time as from first overlap to \
last",
};

/// Names of the single numbers; the first five are means.
const SCALARS: [&str; 8] = [
    "mean height [m]",
    "mean length [m]",
    "mean flight time [s]",
    "mean contact time [s]",
    "mean restitution [-]",
    "maximum height [m]",
    "maximum overlap [m]",
    "hops [-]",
];

/// A grain that does not touch the bed.
const NONE: u32 = u32::MAX;

/// Follows grains from touch to touch.
#[derive(Clone, Debug)]
pub(super) struct Hops {
    bed: Vec<Bed>,
    group: Option<u32>,
    sense: Sense,
    lowest: f64,
    most: usize,
    turns: Axes,
    /// By number of the grain.
    courses: Vec<Course>,
    /// Grains that there will ever be.
    grains: usize,
    means: Means,
    largest: [f64; 2],
    counted: usize,
    /// Deepest contact with the bed of every grain in sight, by its place in the list; scratch.
    deepest: Vec<u32>,
}

pub(super) fn open(asked: &watch::Hops, plan: &Plan) -> Hops {
    let watch::Hops { bed, group, along, up, lowest, most } = asked;
    Hops {
        bed: bed.clone(),
        group: group.as_ref().map(|name| group_number(plan, name)),
        sense: Sense { up: DVec3::from_array(*up), along: DVec3::from_array(*along) },
        lowest: *lowest,
        most: most.unwrap_or(usize::MAX),
        turns: if plan.dimension == 3 { axes(plan) } else { &[1] },
        courses: Vec::new(),
        grains: plan.numbered(),
        means: Means::new(5),
        largest: [f64::NAN; 2],
        counted: 0,
        deepest: Vec::new(),
    }
}

impl Hops {
    /// Finds the deepest contact with the bed of every grain.
    fn find_touches(&mut self, view: &View) {
        let [walls, fixed, free] = [Bed::Walls, Bed::FixedGrains, Bed::FreeGrains].map(|kind| self.bed.contains(&kind));
        self.deepest.clear();
        self.deepest.resize(view.len(), NONE);
        let mut touch = |i: usize, k: usize| {
            let deepest = &mut self.deepest[i];
            if *deepest == NONE || view.contacts[*deepest as usize].overlap < view.contacts[k].overlap {
                *deepest = k as u32;
            }
        };
        for (k, c) in view.contacts.iter().enumerate().filter(|(_, c)| c.overlap > 0.0) {
            if c.wall {
                if walls {
                    touch(c.first, k);
                }
                continue;
            }
            let bed = |other: usize| if view.free(other) { free } else { fixed };
            if bed(c.second) {
                touch(c.first, k);
            }
            if bed(c.first) {
                touch(c.second, k);
            }
        }
    }

    /// That contact, seen from grain `i`.
    fn touch(&self, view: &View, i: usize) -> Option<Touch> {
        let c = view.contacts.get(self.deepest[i] as usize)?;
        let (normal, bed) = match (c.wall, c.first == i) {
            (true, _) => (c.normal, DVec3::ZERO),
            (false, true) => (c.normal, view.grains.velocity[c.second]),
            (false, false) => (-c.normal, view.grains.velocity[c.first]),
        };
        Some(Touch { normal, overlap: c.overlap, bed })
    }

    fn count(&mut self, hop: &Hop) {
        self.counted += 1;
        self.means.take([hop.height, hop.length, hop.flight, hop.contact, hop.restitution].into_iter());
        // The larger of a number and of what is not a number is the number.
        self.largest = [self.largest[0].max(hop.height), self.largest[1].max(hop.overlap)];
    }

    fn row(&self, id: u32, hop: &Hop) -> Vec<f64> {
        let mut row = vec![
            f64::from(id),
            hop.start,
            hop.height,
            hop.length,
            hop.flight,
            hop.angle,
            hop.impact,
            hop.rebound,
            hop.restitution,
            hop.contact,
            hop.overlap,
        ];
        row.extend(self.turns.iter().map(|&a| hop.spin[a]));
        row
    }
}

impl Watch for Hops {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants { spins: true, ..Wants::TOUCHES }
    }

    fn scalars(&self) -> Vec<String> {
        SCALARS.map(String::from).to_vec()
    }

    fn so_far(&self) -> &'static [&'static str] {
        &[""]
    }

    fn sheet(&self) -> Option<Sheet> {
        let mut values: Vec<String> = [
            "start [s]",
            "height [m]",
            "length [m]",
            "flight time [s]",
            "impact angle [rad]",
            "impact speed [m/s]",
            "rebound speed [m/s]",
            "restitution [-]",
            "contact time [s]",
            "overlap [m]",
        ]
        .map(String::from)
        .to_vec();
        values.extend(self.turns.iter().map(|&a| format!("spin {} [rad/s]", LETTERS[a])));
        Some(Sheet { coordinates: vec!["id [-]".to_owned()], values, steady: false })
    }

    fn take(&mut self, view: &View) -> Sample {
        let mut rows = Vec::new();
        if self.counted < self.most {
            self.find_touches(view);
            let g = &view.grains;
            for i in 0..view.len() {
                if !view.free(i) || self.group.is_some_and(|group| g.group[i] != group) {
                    continue;
                }
                let id = g.id[i] as usize;
                if self.courses.len() <= id {
                    self.courses.resize_with(id + 1, Course::default);
                }
                let seen = Seen {
                    time: view.time,
                    place: view.unwrapped(i),
                    velocity: g.velocity[i],
                    spin: g.spin[i],
                    touch: self.touch(view, i),
                };
                let ended = self.courses[id].look(&seen, &self.sense);
                if let Some(hop) = ended.filter(|hop| hop.height >= self.lowest && self.counted < self.most) {
                    self.count(&hop);
                    rows.push(self.row(g.id[i], &hop));
                }
            }
        }
        let mut scalars: Vec<f64> = self.means.get().collect();
        scalars.extend(self.largest);
        scalars.push(self.counted as f64);
        Sample { scalars, rows }
    }

    fn save(&self, name: &str, state: &mut State) {
        let known = || self.courses.iter().enumerate().filter(|(_, course)| course.phase != Phase::New);
        let whole = known().flat_map(|(id, course)| [id as i64, course.phase as i64]);
        state.put_integer(
            &format!("{name}.courses"),
            [self.counted as i64].into_iter().chain(whole).collect::<Vec<_>>(),
        );
        state.put_real(&format!("{name}.course"), known().flat_map(|(_, c)| c.numbers()).collect::<Vec<_>>());
        state.put_real(&format!("{name}.hops"), [self.largest.to_vec(), self.means.numbers()].concat());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let key = format!("{name}.courses");
        let wrong = || MissingSection { name: key.clone(), kind: "integer" };
        let means_kept = self.means.numbers().len();
        let (hops, whole) = state.integer(&key)?.split_first().ok_or_else(wrong)?;
        let numbers = state.real(&format!("{name}.course"))?;
        let (largest, means) = state.real(&format!("{name}.hops"))?.split_first_chunk::<2>().ok_or_else(wrong)?;
        if NUMBERS * whole.len() != 2 * numbers.len() || means.len() != means_kept {
            return Err(wrong());
        }
        (self.counted, self.largest, self.means) = (*hops as usize, *largest, Means::from_numbers(means));
        // A checkpoint that names grains which the scene has not would ask for any amount of memory.
        if whole.as_chunks::<2>().0.iter().any(|[id, _]| !(0..self.grains as i64).contains(id)) {
            return Err(wrong());
        }
        self.courses.clear();
        for (&[id, phase], numbers) in whole.as_chunks::<2>().0.iter().zip(numbers.as_chunks::<NUMBERS>().0) {
            self.courses.resize_with(self.courses.len().max(id as usize + 1), Course::default);
            self.courses[id as usize] = Course::from_numbers(phase as usize, numbers);
        }
        Ok(())
    }
}
