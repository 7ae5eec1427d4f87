//! A law: an ordered stack of parts.

use super::chunk::Chunk;
use super::part::{Needs, Part};
use super::table::Pair;
use super::{coulomb, hertz, hooke, mindlin, rolling_constant, viscous};
use tsubu_scene::plan::{Contact, Damping, Normal, Rolling, Tangential};

/// Parts in the order of their stages.
#[derive(Debug)]
pub struct Law {
    parts: Vec<Box<dyn Part>>,
    /// What the parts need together.
    pub needs: Needs,
}

impl Law {
    /// The law that a scene's `[contact]` describes.
    pub fn new(contact: &Contact) -> Self {
        let mut parts: Vec<Box<dyn Part>> = Vec::new();
        match contact.normal {
            Normal::Hertz {} => parts.push(Box::new(hertz::Hertz)),
            Normal::Hooke { stiffness } => parts.push(Box::new(hooke::Hooke { stiffness })),
        }
        let attraction = contact.attraction;
        match contact.damping {
            Damping::None {} => {}
            Damping::Sqrt { reference_speed } => {
                parts.push(Box::new(viscous::Viscous { form: viscous::Form::Sqrt, attraction, reference_speed }));
            }
            Damping::Quarter {} => {
                let form = viscous::Form::Quarter;
                parts.push(Box::new(viscous::Viscous { form, attraction, reference_speed: 1.0 }));
            }
            Damping::Linear { reference_speed } => {
                parts.push(Box::new(viscous::Viscous { form: viscous::Form::Linear, attraction, reference_speed }));
            }
        }
        match contact.tangential {
            Tangential::None {} => {}
            Tangential::Coulomb { smoothing_speed } => parts.push(Box::new(coulomb::Coulomb { smoothing_speed })),
            Tangential::Mindlin {} => parts.push(Box::new(mindlin::Mindlin)),
        }
        match contact.rolling {
            Rolling::None {} => {}
            Rolling::Constant { smoothing_speed } => {
                parts.push(Box::new(rolling_constant::RollingConstant { smoothing_speed }));
            }
        }
        Self::of(parts)
    }

    /// A law of given parts, sorted by stage.
    pub fn of(mut parts: Vec<Box<dyn Part>>) -> Self {
        parts.sort_by_key(|p| p.stage());
        let needs = parts
            .iter()
            .map(|p| p.needs())
            .fold(Needs::default(), |a, b| Needs { history: a.history || b.history, roll: a.roll || b.roll });
        Self { parts, needs }
    }

    /// The parts, in the order they act.
    pub fn parts(&self) -> &[Box<dyn Part>] {
        &self.parts
    }

    /// Lets every part write its coefficient for a pair.
    pub fn prepare(&self, pair: &mut Pair) {
        for part in &self.parts {
            part.prepare(pair);
        }
    }

    /// Calls each part once on the chunk.
    pub fn apply(&self, chunk: &mut Chunk, dt: f64) {
        chunk.clear_results();
        for part in &self.parts {
            part.apply(chunk, dt);
        }
    }
}
