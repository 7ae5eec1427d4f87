//! A law: an ordered stack of parts.

use super::chunk::{Chunk, Column, ZERO};
use super::pair::{Constants, Pair};
use super::part::{Needs, Part, Slot, Stage};
use super::root::most;
use multiversion::multiversion;
use tsubu_scene::plan::Contact;

/// Parts in the order of their stages.
#[derive(Debug)]
pub struct Law {
    parts: Vec<Box<dyn Part>>,
    /// First column of history of every part.
    at: Vec<usize>,
    /// What happens to each column of history when the bodies change places.
    pub slots: Vec<Slot>,
    /// What the parts need together.
    pub needs: Needs,
    /// Whether a normal force that pulls carries friction.
    pulled_friction: bool,
}

impl Law {
    /// The law that a `[contact]` describes, the scene's or that of a pair of materials.
    pub fn new(contact: &Contact) -> Self {
        Self { pulled_friction: contact.pulled_friction, ..Self::of(super::parts(contact)) }
    }

    /// A law of given parts, sorted by stage.
    pub fn of(mut parts: Vec<Box<dyn Part>>) -> Self {
        parts.sort_by_key(|p| p.stage());
        let needs = parts.iter().map(|p| p.needs()).fold(Needs::default(), Needs::and);
        let (mut at, mut slots) = (Vec::new(), Vec::new());
        for part in &parts {
            at.push(slots.len());
            slots.extend(part.history());
        }
        Self { parts, at, slots, needs, pulled_friction: false }
    }

    /// The parts, in the order they act.
    pub fn parts(&self) -> &[Box<dyn Part>] {
        &self.parts
    }

    /// Columns of history of a contact.
    pub fn width(&self) -> usize {
        self.slots.len()
    }

    /// How far apart [m] bodies of a pair may be and still hold each other.
    pub fn reach(&self, pair: &Pair) -> f64 {
        self.parts.iter().map(|p| p.reach(pair)).fold(0.0, f64::max)
    }

    /// Lets every part find its numbers for a pair of materials.
    pub fn prepare(&self, constants: &mut Constants) {
        for part in &self.parts {
            part.prepare(constants);
        }
    }

    /// Lets every part tell the verdict about a pair of bodies.
    pub fn judge(&self, pair: &mut Pair) {
        for part in &self.parts {
            part.judge(pair);
        }
    }

    /// Calls each part once on the chunk.
    pub fn apply(&self, chunk: &mut Chunk, dt: f64) {
        chunk.clear_results();
        let mut loaded = false;
        for (part, at) in self.parts.iter().zip(&self.at) {
            if !loaded && part.stage() >= Stage::Tangential {
                load(chunk, self.pulled_friction);
                loaded = true;
            }
            part.apply(chunk, *at, dt);
        }
    }

    /// Slopes of the stored energy of all rows over their effective radii [N].
    pub fn energy_slopes(&self, chunk: &Chunk) -> Column {
        let mut slopes = ZERO;
        self.parts.iter().for_each(|part| part.energy_slopes(chunk, &mut slopes));
        slopes
    }

    /// Energy [J] that a contact's history still holds when it opens.
    pub fn held(&self, history: &[f64]) -> f64 {
        self.parts.iter().zip(&self.at).map(|(part, at)| part.held(&history[*at..])).sum()
    }

    /// The history of the same contact with the two bodies changed.
    pub fn turned(&self, history: &mut [f64]) {
        for (value, slot) in history.iter_mut().zip(&self.slots) {
            if *slot == Slot::Odd {
                *value = -*value;
            }
        }
    }
}

/// What friction multiplies: the normal force and, under cohesion, the pull-off force that holds the faces together. An
/// attracting normal force alone carries none (mu times a force below zero would push the bodies along their motion) or, if
/// `pulled`, mu times its size.
#[multiversion(targets = "simd")]
fn load(chunk: &mut Chunk, pulled: bool) {
    let share = if pulled { -1.0 } else { 0.0 };
    for i in 0..chunk.rows() {
        let pressed = chunk.normal_force[i] + chunk.pull_off[i];
        chunk.load[i] = most(pressed, share * pressed);
    }
}
