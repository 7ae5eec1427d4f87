//! What is wrong with the beginning of a run: grains in walls or in each other, grains beside their vessel, removal that nobody
//! can come to.

use super::engine::DemEngine;
use super::room::Clearance;
use crate::engine::{Note, Refusal, Verdict};
use crate::view::Contact;
use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use tsubu_scene::plan::{Particles, Periodic, Plan, Region, Removal, Start};

/// Overlap with a wall over diameter from which it is said: what one types is more exact, and beds that other codes have
/// written lie under load.
const SLACK: f64 = 1e-3;
/// The same in files.
const SLACK_IN_FILES: f64 = 0.05;
/// As many overlaps are named; one wrong number puts all grains into a wall.
const NAMED: usize = 4;
/// Of more given places than this only some are looked at.
const LOOKED_AT: usize = 20_000;

/// A group with its name and what its places are called.
struct Group<'a> {
    name: &'a str,
    of: &'a Particles,
    first_id: u32,
}

impl Group<'_> {
    /// The key that says where a grain begins.
    fn key(&self, id: u32) -> String {
        let (start, part) = ("particles", self.name);
        match &self.of.start {
            Start::At { .. } => {
                let pieces = self.of.shape.clump().map_or(1, |clump| clump.pieces.len() as u32);
                format!("{start}.{part}.start.at.position[{}]", (id - self.first_id) / pieces)
            }
            Start::File { .. } => format!("{start}.{part}.start.file"),
            Start::Rows { .. } => format!("{start}.{part}.start.rows"),
            Start::Settled { .. } => format!("{start}.{part}.start.settled"),
            Start::Random { .. } => format!("{start}.{part}.start.random"),
            Start::Stream { .. } => format!("{start}.{part}.start.stream"),
        }
    }

    fn slack(&self) -> f64 {
        if matches!(self.of.start, Start::File { .. }) { SLACK_IN_FILES } else { SLACK }
    }
}

impl DemEngine {
    /// Judges the moment before the first step: what cannot go well is refused, what is hardly meant so is noted.
    pub(super) fn judge_start(&mut self, plan: &Plan) -> Result<(), Refusal> {
        let groups = self.groups(plan);
        let mut notes = self.overlapping_grains(plan, &groups);
        notes.extend(self.strays(&groups));
        notes.extend(out_of_reach(plan));
        notes.extend(self.emptied_at_once(plan));
        let refused: Vec<Note> = notes.iter().filter(|note| note.verdict == Verdict::Refused).cloned().collect();
        if refused.is_empty() {
            self.notes.extend(notes);
            return Ok(());
        }
        Err(Refusal { method: "dem", notes: refused })
    }

    fn groups<'a>(&self, plan: &'a Plan) -> Vec<Group<'a>> {
        let mut groups: Vec<Group> =
            plan.particles.iter().map(|(name, of)| Group { name, of, first_id: u32::MAX }).collect();
        for (group, id) in self.grains.group.iter().zip(&self.grains.id) {
            let first = &mut groups[*group as usize].first_id;
            *first = (*first).min(*id);
        }
        groups
    }

    /// Grains that begin in walls or in other grains.
    fn overlapping_grains(&self, plan: &Plan, groups: &[Group]) -> Vec<Note> {
        let limit = plan.dem.largest_overlap;
        let of = |grain: usize| (&groups[self.grains.group[grain] as usize], self.grains.id[grain]);
        let mut deep: Vec<(f64, Contact)> = Vec::new();
        for contact in self.overlaps() {
            let ratio = self.overlap_ratio(&contact);
            if ratio > if contact.wall { of(contact.first).0.slack().min(limit) } else { limit } {
                deep.push((ratio, contact));
            }
        }
        deep.sort_by(|a, b| b.0.total_cmp(&a.0).then(of(a.1.first).1.cmp(&of(b.1.first).1)));
        let mut notes: Vec<Note> = Vec::new();
        for (ratio, contact) in deep.iter().take(NAMED) {
            let (group, id) = of(contact.first);
            let verdict = if *ratio > limit { Verdict::Refused } else { Verdict::Doubtful };
            let other = self.named(contact);
            let (what, way_out) =
                if contact.wall { ("the wall", "or the wall") } else { ("that grain", "or the other") };
            let rounded = self.integration.bodies.rounding(contact.first).is_some();
            let whole = if rounded { "twice its rounding radius" } else { "its diameter" };
            let mut text = format!("grain {id} begins {ratio:.3} of {whole} deep in {other}; move the grain {way_out}");
            if verdict == Verdict::Refused && *ratio < 1.0 {
                let _ = write!(text, "; a `dem.largest-overlap` above {ratio:.3} would let it be pushed out of {what}");
            }
            notes.push(Note { key: group.key(id), verdict, text });
        }
        if let (Some(last), more @ 1..) = (notes.last_mut(), deep.len().saturating_sub(NAMED)) {
            let _ = write!(last.text, " (and {more} more like it)");
        }
        notes
    }

    /// Given places beside the vessel in which the others are.
    fn strays(&self, groups: &[Group]) -> Vec<Note> {
        let mut notes = Vec::new();
        for (number, group) in groups.iter().enumerate() {
            if !matches!(group.of.start, Start::At { .. } | Start::File { .. }) {
                continue;
            }
            let free = |i: &usize| self.grains.group[*i] as usize == number && self.grains.inverse_mass[*i] > 0.0;
            let count = (0..self.grains.len()).filter(free).count();
            let places: Vec<(u32, DVec3)> = (0..self.grains.len())
                .filter(free)
                .step_by(count.div_ceil(LOOKED_AT).max(1))
                .map(|i| (self.grains.id[i], self.grains.position[i]))
                .collect();
            let all: Vec<DVec3> = places.iter().map(|place| place.1).collect();
            let clearance = Clearance::of_places(&self.walls, &all, self.integration.gravity);
            let mut found: BTreeMap<&str, (usize, u32)> = BTreeMap::new();
            for (id, place) in &places {
                if let Some(wall) = clearance.strays(*place) {
                    let (count, first) = found.entry(&wall.name).or_insert((0, *id));
                    (*count, *first) = (*count + 1, (*first).min(*id));
                }
            }
            notes.extend(found.into_iter().map(|(wall, (strays, first))| Note {
                key: group.key(first),
                verdict: Verdict::Doubtful,
                text: format!(
                    "{strays} of the {} places looked at lie on the other side of the wall `{wall}` than most, that of grain {first} first; move them, or leave them out",
                    places.len()
                ),
            }));
        }
        notes
    }

    /// Regions of removal in which all grains begin.
    fn emptied_at_once(&self, plan: &Plan) -> Vec<Note> {
        let free = || (0..self.grains.len()).filter(|i| self.grains.inverse_mass[*i] > 0.0);
        let takes_all = |removal: &Removal| free().all(|i| removal.takes(self.grains.position[i].to_array()));
        let all = plan.removal.iter().filter(|(_, removal)| free().next().is_some() && takes_all(removal));
        all.map(|(name, removal)| {
            let way_out = match removal {
                Removal::Behind { .. } => "does `normal` point to where grains stay?",
                Removal::Inside { .. } => "move it to where grains leave",
            };
            let text = format!("all grains that forces move begin in there and vanish at once; {way_out}");
            Note { key: format!("removal.{name}"), verdict: Verdict::Doubtful, text }
        })
        .collect()
    }

    /// Overlap over diameter, of the smaller grain.
    pub(super) fn overlap_ratio(&self, contact: &Contact) -> f64 {
        let radius = |i: usize| self.integration.bodies.rounding(i).unwrap_or(self.grains.radius[i]);
        let second = if contact.wall { f64::INFINITY } else { radius(contact.second) };
        contact.overlap / (2.0 * radius(contact.first).min(second))
    }

    /// Whom a contact is with, as users know it.
    pub(super) fn named(&self, contact: &Contact) -> String {
        if contact.wall {
            format!("the wall `{}`", self.walls[contact.second].name)
        } else {
            format!("grain {}", self.grains.id[contact.second])
        }
    }
}

/// A half-space in which centres of grains stay: a point of it and its normal.
type Bound = ([f64; 3], [f64; 3]);

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Regions of removal behind planes, outside boxes or beyond periodic ends, where nobody comes.
fn out_of_reach(plan: &Plan) -> Vec<Note> {
    // A later stage may open the way.
    if plan.stage.len() > 1 {
        return Vec::new();
    }
    let smallest = plan.particles.values().map(Particles::smallest_diameter).fold(f64::INFINITY, f64::min);
    // So near to a wall a centre comes before the run stops.
    let nearest = if smallest.is_finite() { (0.5 - plan.dem.largest_overlap).max(0.0) * smallest } else { 0.0 };
    let bounds = bounds(plan, nearest);
    let beyond = |removal: &Removal| bounds.iter().find(|(_, sides)| never_meets(removal, sides));
    let note = |(name, removal)| {
        let (what, _) = beyond(removal)?;
        let text = format!("no grain leaves there: it lies behind {what}; move it to where grains come");
        Some(Note { key: format!("removal.{name}"), verdict: Verdict::Doubtful, text })
    };
    plan.removal.iter().filter_map(note).collect()
}

/// What keeps grains in, by name.
fn bounds(plan: &Plan, nearest: f64) -> Vec<(String, Vec<Bound>)> {
    use tsubu_scene::plan::Shape;
    let mut bounds = Vec::new();
    for (name, wall) in &plan.walls {
        let moves = wall.host.is_some() || wall.motion.is_some() || wall.servo.is_some() || wall.body.is_some();
        if moves || wall.rotation.is_some() || wall.until.is_some() {
            continue;
        }
        let sides = match &wall.shape {
            Shape::Plane { point, normal } => {
                vec![([0, 1, 2].map(|k| point[k] + nearest * normal[k]), *normal)]
            }
            Shape::Box { width, height, depth, floor_centre: [x, y, z] } => {
                let half = [0.5 * width - nearest, 0.5 * depth - nearest, 0.5 * height - nearest];
                sides([*x, *y, z + 0.5 * height], half, if plan.dimension == 2 { &[0, 2] } else { &[0, 1, 2] })
            }
            _ => continue,
        };
        bounds.push((format!("the wall `{name}`"), sides));
    }
    let Periodic { x, y, z } = &plan.periodic;
    for (axis, ends) in [x, y, z].into_iter().enumerate() {
        let Some([low, high]) = *ends else { continue };
        let (mut middle, mut half) = ([0.0; 3], [0.0; 3]);
        (middle[axis], half[axis]) = (0.5 * (low + high), 0.5 * (high - low));
        bounds.push((format!("the end of periodic.{}", ["x", "y", "z"][axis]), sides(middle, half, &[axis])));
    }
    bounds
}

/// Both sides along some axes.
fn sides(middle: [f64; 3], half: [f64; 3], axes: &[usize]) -> Vec<Bound> {
    let side = |axis: &usize, way: f64| {
        let (mut point, mut normal) = (middle, [0.0; 3]);
        (point[*axis], normal[*axis]) = (middle[*axis] - way * half[*axis], way);
        (point, normal)
    };
    axes.iter().flat_map(|axis| [side(axis, 1.0), side(axis, -1.0)]).collect()
}

/// Whether a region has no point inside of the bounds; `false` where it may have.
fn never_meets(removal: &Removal, bounds: &[Bound]) -> bool {
    match removal {
        Removal::Inside { region: Region { low, high, .. } } => bounds.iter().any(|(point, normal)| {
            let farthest = [0, 1, 2].map(|k| if normal[k] > 0.0 { high[k] } else { low[k] } - point[k]);
            dot(farthest, *normal) < 0.0
        }),
        // The farthest point along its normal: in a corner of a box; a single plane goes on for ever unless it is parallel.
        Removal::Behind { point, normal } => {
            let mut left = *normal;
            let mut farthest = 0.0;
            for (at, side) in bounds {
                let along = dot(*normal, *side);
                if along > 1e-12 {
                    farthest += along * dot(*at, *side);
                    left = [0, 1, 2].map(|k| left[k] - along * side[k]);
                }
            }
            // What the bounds do not hold back may go behind any plane.
            dot(left, left) < 1e-18 && farthest >= dot(*point, *normal)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{never_meets, sides};
    use tsubu_scene::plan::{Region, Removal};

    #[test]
    fn a_region_beyond_a_box_is_never_met() {
        let walls = sides([0.0, 0.0, 1.0], [1.0, 1.0, 1.0], &[0, 1, 2]);
        let behind = |point: [f64; 3], normal: [f64; 3]| Removal::Behind { point, normal };
        let inside = |low: [f64; 3], high: [f64; 3]| Removal::Inside { region: Region::of_box(low, high) };
        let slanted = [0.6, 0.0, 0.8];
        for (removal, never) in [
            (behind([0.0, 0.0, -0.1], [0.0, 0.0, 1.0]), true),
            (behind([0.0, 0.0, 0.1], [0.0, 0.0, 1.0]), false),
            (behind([-1.0, 0.0, -0.01], slanted), true),
            (behind([-1.0, 0.0, 0.01], slanted), false),
            (behind([0.0, 0.0, -0.1], [0.0, 0.0, -1.0]), false),
            (inside([-3.0, -1.0, 0.0], [-1.1, 1.0, 1.0]), true),
            (inside([-3.0, -1.0, 0.0], [-0.9, 1.0, 1.0]), false),
        ] {
            assert_eq!(never_meets(&removal, &walls), never, "{removal:?}");
        }
        // A floor alone does not hold back from a slanted plane.
        assert!(!never_meets(&behind([0.0, 0.0, -5.0], slanted), &sides([0.0; 3], [0.0; 3], &[2])[..1]));
    }
}
