//! Grains that leave a scene, which the user did not mean: how many, where, when.
//!
//! A free grain is lost when it is outside the box around all that is drawn and all grains at the begin, grown by half of its size, and
//! falls where nothing lies below: no wall, no grains that are held, nothing that takes grains out.

use crate::engine::Engine;
use crate::view::{View, Wants};
use crate::wall::{Wall, meets_box};
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::Plan;
use tsubu_scene::plan::{Region, Removal};

/// Section of a checkpoint.
const LOST: &str = "run.lost";

/// A box of space.
#[derive(Clone, Copy, Debug)]
struct Extent {
    low: DVec3,
    high: DVec3,
}

impl Extent {
    const NOTHING: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    fn around(points: impl Iterator<Item = DVec3>) -> Self {
        points.fold(Self::NOTHING, |all, p| Self { low: all.low.min(p), high: all.high.max(p) })
    }

    /// Grown by half of its largest side to all sides.
    fn grown(self) -> Self {
        let more = DVec3::splat(0.5 * (self.high - self.low).max_element().max(0.0));
        Self { low: self.low - more, high: self.high + more }
    }

    fn holds(&self, p: DVec3) -> bool {
        p.cmpge(self.low).all() && p.cmple(self.high).all()
    }

    /// Whether a way from a point leads through it.
    fn is_met(&self, from: DVec3, way: DVec3) -> bool {
        self.low.cmple(self.high).all() && meets_box(from, way, self.low, self.high)
    }
}

/// The first grain that was lost.
#[derive(Clone, Copy, Debug)]
struct First {
    time: f64,
    place: DVec3,
    id: u32,
}

/// What was seen of lost grains.
#[derive(Debug)]
pub(super) struct Lost {
    /// Nothing is lost in here.
    scene: Extent,
    first: Option<First>,
    /// The most at any look.
    most: usize,
}

impl Lost {
    pub fn new(engine: &dyn Engine) -> Self {
        let outlines = engine.walls().iter().map(Wall::outline);
        let corners = outlines.flat_map(|o| o.lines.into_iter().flatten().chain(o.triangles.into_iter().flatten()));
        let view = engine.view(Wants::GRAINS);
        let grains = view.grains.position.iter().copied();
        Self { scene: Extent::around(corners.chain(grains)).grown(), first: None, most: 0 }
    }

    /// Looks for grains that are lost now.
    pub fn look(&mut self, plan: &Plan, engine: &dyn Engine) {
        let (walls, down) = (engine.walls(), DVec3::from_array(plan.gravity).normalize_or_zero());
        if walls.is_empty() || down == DVec3::ZERO {
            return;
        }
        let view = engine.view(Wants::GRAINS);
        let outside = |i: &usize| !self.scene.holds(view.position(*i)) && falls(&view, *i, down);
        let outside: Vec<usize> = (0..view.len()).filter(outside).collect();
        if outside.is_empty() {
            return;
        }
        let held = Extent::around((0..view.len()).filter(|i| !view.free(*i)).map(|i| view.position(i)));
        let is_met = |p: DVec3| {
            held.is_met(p, down)
                || walls.iter().any(|wall| wall.stops(p, down))
                || plan.removal.values().any(|removal| takes(removal, p, down))
        };
        let lost: Vec<usize> = outside.into_iter().filter(|i| !is_met(view.position(*i))).collect();
        self.most = self.most.max(lost.len());
        if let (None, Some(&i)) = (self.first, lost.first()) {
            self.first = Some(First { time: view.time, place: view.position(i), id: view.grains.id[i] });
        }
    }

    /// In words, if any was lost.
    pub fn told(&self, plan: &Plan) -> Option<String> {
        let First { time, place, id } = self.first?;
        let axes =
            ["x", "y", "z"].into_iter().zip(place.to_array()).filter(|(axis, _)| plan.dimension == 3 || *axis != "y");
        let place: Vec<String> = axes.map(|(axis, at)| format!("{axis} = {at:.3} m")).collect();
        let who = if self.most == 1 { "1 grain has".to_owned() } else { format!("{} grains have", self.most) };
        Some(format!(
            "{who} left the scene and fall where nothing lies below: the first, grain {id}, was seen at t = {time:.3} s at {}; close the walls \
             there, or take such grains out with `removal`",
            place.join(", ")
        ))
    }

    pub fn save(&self, state: &mut State) {
        let first = self.first.map(|First { time, place, id }| [time, place.x, place.y, place.z, f64::from(id)]);
        let numbers = [self.scene.low, self.scene.high].into_iter().flat_map(|p| p.to_array());
        let numbers = numbers.chain([self.most as f64]).chain(first.into_iter().flatten());
        state.put_real(LOST, numbers.collect::<Vec<_>>());
    }

    pub fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let numbers = state.real(LOST)?;
        let Some((&[a, b, c, d, e, f, most], first)) = numbers.split_first_chunk() else {
            return Err(MissingSection { name: LOST.to_owned(), kind: "real" });
        };
        self.scene = Extent { low: DVec3::new(a, b, c), high: DVec3::new(d, e, f) };
        self.most = most as usize;
        self.first = match *first {
            [time, x, y, z, id] => Some(First { time, place: DVec3::new(x, y, z), id: id as u32 }),
            _ => None,
        };
        Ok(())
    }
}

/// Whether a grain is moved by forces, and down.
fn falls(view: &View, i: usize, down: DVec3) -> bool {
    view.free(i) && view.grains.velocity[i].dot(down) > 0.0
}

/// Whether grains are taken out somewhere below a point.
fn takes(removal: &Removal, from: DVec3, down: DVec3) -> bool {
    match removal {
        Removal::Inside { region: Region { low, high, .. } } => {
            Extent { low: DVec3::from_array(*low), high: DVec3::from_array(*high) }.is_met(from, down)
        }
        Removal::Behind { normal, .. } => down.dot(DVec3::from_array(*normal)) < 0.0 || removal.takes(from.to_array()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_meets_a_box_or_passes_it() {
        let extent = Extent { low: DVec3::ZERO, high: DVec3::ONE };
        let down = DVec3::NEG_Z;
        assert!(extent.is_met(DVec3::new(0.5, 0.5, 3.0), down));
        assert!(!extent.is_met(DVec3::new(0.5, 1.5, 3.0), down));
        assert!(!extent.is_met(DVec3::new(0.5, 0.5, -3.0), down), "it lies behind");
        assert!(extent.is_met(DVec3::new(-1.0, 0.5, 1.5), DVec3::new(0.8, 0.0, -0.6)));
        for way in [down, DVec3::new(0.48, 0.36, -0.8)] {
            assert!(!Extent::NOTHING.is_met(DVec3::ZERO, way), "{way}");
        }
    }
}
