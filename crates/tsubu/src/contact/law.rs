//! A law: an ordered stack of parts.

use super::chunk::Chunk;
use super::part::{Needs, Part, Slot, Stage};
use super::root::most;
use super::table::{Constants, Pair};
use super::{
    cohesion_constant, contact_width, coulomb, dashpot, dmt, epsd, hertz, hooke, jkr, lubrication, mindlin,
    rolling_constant,
};
use super::{rolling_spring, rolling_viscous, sjkr, spring, twisting_sliding, twisting_spring, viscous};
use multiversion::multiversion;
use tsubu_scene::plan::{Cohesion, Contact, Damping, Film, Normal, Rolling, Tangential, Twisting};

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
}

impl Law {
    /// The law that a `[contact]` describes, the scene's or that of a pair of materials.
    pub fn new(contact: &Contact) -> Self {
        let parts = [
            Some(normal(&contact.normal)),
            cohesion(&contact.cohesion),
            damping(contact),
            tangential(&contact.tangential),
            rolling(&contact.rolling),
            twisting(&contact.twisting),
            film(contact),
        ];
        Self::of(parts.into_iter().flatten().collect())
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
        Self { parts, at, slots, needs }
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
                load(chunk);
                loaded = true;
            }
            part.apply(chunk, *at, dt);
        }
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

fn normal(normal: &Normal) -> Box<dyn Part> {
    match *normal {
        Normal::Hertz {} => Box::new(hertz::Hertz),
        Normal::Hooke { stiffness } => Box::new(hooke::Hooke { stiffness }),
    }
}

fn cohesion(cohesion: &Cohesion) -> Option<Box<dyn Part>> {
    match *cohesion {
        Cohesion::None {} => None,
        Cohesion::Dmt {} => Some(Box::new(dmt::part())),
        Cohesion::Jkr {} => Some(Box::new(jkr::Jkr)),
        Cohesion::Sjkr {} => Some(Box::new(sjkr::part())),
        Cohesion::Constant {} => Some(Box::new(cohesion_constant::part())),
    }
}

fn damping(contact: &Contact) -> Option<Box<dyn Part>> {
    let attraction = contact.attraction;
    let hertz = matches!(contact.normal, Normal::Hertz {});
    let viscous = |form, reference_speed| -> Option<Box<dyn Part>> {
        Some(Box::new(viscous::Viscous { form, hertz, attraction, reference_speed }))
    };
    let told = |dashpot| -> Option<Box<dyn Part>> { Some(Box::new(dashpot::Told { dashpot, attraction })) };
    match contact.damping {
        Damping::None {} => None,
        Damping::Sqrt { reference_speed } => viscous(viscous::Form::Sqrt, reference_speed),
        Damping::Quarter {} => viscous(viscous::Form::Quarter, 1.0),
        Damping::Linear { reference_speed } => viscous(viscous::Form::Linear, reference_speed),
        Damping::Rate { rate } => told(dashpot::Dashpot::Rate(rate)),
        Damping::Dashpot { coefficient } => told(dashpot::Dashpot::Constant(coefficient)),
    }
}

fn tangential(tangential: &Tangential) -> Option<Box<dyn Part>> {
    match *tangential {
        Tangential::None {} => None,
        Tangential::Coulomb { smoothing_speed } => Some(Box::new(coulomb::part(smoothing_speed))),
        Tangential::Mindlin { form, damping } => Some(Box::new(mindlin::Mindlin { form, damping })),
        Tangential::Spring { ratio, damping, cohesion } => Some(Box::new(spring::Spring { ratio, damping, cohesion })),
    }
}

fn rolling(rolling: &Rolling) -> Option<Box<dyn Part>> {
    match *rolling {
        Rolling::None {} => None,
        Rolling::Constant { smoothing_speed } => Some(Box::new(rolling_constant::part(smoothing_speed))),
        Rolling::Viscous { coefficient } => Some(Box::new(rolling_viscous::part(coefficient))),
        Rolling::Epsd { ratio, damping_ratio } => Some(Box::new(epsd::Epsd { told: Some([ratio, damping_ratio]) })),
        Rolling::Epsd2 {} => Some(Box::new(epsd::Epsd { told: None })),
        Rolling::Spring { stiffness, damping } => Some(Box::new(rolling_spring::RollingSpring { stiffness, damping })),
        Rolling::ContactWidth { smoothing_speed } => Some(Box::new(contact_width::part(smoothing_speed))),
    }
}

fn twisting(twisting: &Twisting) -> Option<Box<dyn Part>> {
    match *twisting {
        Twisting::None {} => None,
        Twisting::Sliding { smoothing_spin } => Some(Box::new(twisting_sliding::part(smoothing_spin))),
        Twisting::Spring {} => Some(Box::new(twisting_spring::TwistingSpring)),
    }
}

fn film(contact: &Contact) -> Option<Box<dyn Part>> {
    match contact.film {
        Film::None {} => None,
        Film::Lubrication { roughness, reach, viscosity, in_contact } => {
            let beside_damping = contact.damping != Damping::None {};
            Some(Box::new(lubrication::Lubrication { roughness, reach, viscosity, in_contact, beside_damping }))
        }
    }
}

/// What friction multiplies: the normal force and, under cohesion, the pull-off force that holds the faces together. An
/// attracting normal force alone carries no friction; it would push the bodies along their motion.
#[multiversion(targets = "simd")]
fn load(chunk: &mut Chunk) {
    for i in 0..chunk.rows() {
        chunk.load[i] = most(chunk.normal_force[i] + chunk.pull_off[i], 0.0);
    }
}
