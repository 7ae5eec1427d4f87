//! Water: how it moves, and what it does to grains.
//!
//! Forces are parts, one file each, as those of a contact law are: they act on columns of grains ([`Parcel`]), one after
//! the other, and know nothing of threads, dimensions or books. Who owns the grains asks [`Water::act`] for the forces of a
//! moment and gets the sums for the books with them.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

mod buoyancy;
mod coupled;
mod drag;
mod fluctuation;
mod hindrance;
mod layers;
mod log_law;
mod logarithm;
mod magnus;
mod parcel;
mod part;
mod saffman;
mod shields;
mod stream;
mod submerged;
mod torque;

pub(crate) use coupled::EVERY;
pub use coupled::{Coupled, Top, Turnover};
pub use fluctuation::{Fluctuation, Gust};
pub use layers::Layers;
pub(crate) use parcel::LayerReaction;
pub use parcel::{Parcel, WaterPowers};
pub use part::{Part, WorkKind};
pub use shields::{FORMULAS, Formula};
pub use stream::Stream;
pub use submerged::Submerged;

use crate::about::About;
use crate::mutation::{Mutation, mutated};
use crate::state::sphere;
use buoyancy::Buoyancy;
use drag::Drag;
use glam::DVec3;
use magnus::Magnus;
use saffman::Saffman;
use torque::Torque;
use tsubu_scene::plan;

/// What the forces of the water and its flows are.
pub const ABOUT: &[&About] = &[
    &buoyancy::VERTICAL,
    &buoyancy::NORMAL,
    &stream::STILL,
    &stream::LOG_LAW,
    &stream::TABLE,
    &coupled::ABOUT,
    &stream::COLUMN,
    &hindrance::DI_FELICE,
    &hindrance::RICHARDSON_ZAKI,
    &drag::CONSTANT,
    &drag::STOKES_NEWTON,
    &drag::SCHILLER_NAUMANN,
    &drag::GIDASPOW,
    &drag::ABRAHAM,
    &drag::HAIDER_LEVENSPIEL,
    &torque::STOKES,
    &torque::FINITE_REYNOLDS,
    &saffman::SAFFMAN,
    &saffman::SAFFMAN_MEI,
    &magnus::MAGNUS,
    &magnus::OESTERLE_DINH,
    &fluctuation::ABOUT,
];

/// Karman's constant, in the log law's 5.75 = ln(10)/0.40.
pub const KARMAN: f64 = 0.40;

/// The water of a scene.
#[derive(Debug)]
pub struct Water {
    /// Density [kg/m^3].
    pub density: f64,
    /// Kinematic viscosity [m^2/s].
    pub viscosity: f64,
    /// Height up to which there is water [m], where no surface finds its level; infinite where there is none.
    surface: f64,
    /// Added mass over the mass of displaced water [-].
    pub added_mass: f64,
    /// How it moves.
    pub stream: Stream,
    /// Its turbulent fluctuation.
    pub fluctuation: Option<Fluctuation>,
    /// Whether the share that grains leave to the water matters to the forces.
    crowd: bool,
    parts: Vec<Box<dyn Part>>,
    /// Whether a part reads spins or writes a torque.
    rotates: bool,
}

impl Water {
    /// The water of a plan, under `gravity` [m/s^2].
    pub fn new(plan: &plan::Water, gravity: DVec3) -> Self {
        let mut parts: Vec<Box<dyn Part>> = vec![Box::new(Buoyancy::new(plan, gravity))];
        if plan.drag != (plan::Drag::None {}) {
            parts.push(Box::new(Drag::new(plan)));
        }
        for lift in &plan.lift {
            parts.push(match lift {
                plan::Lift::Saffman => Box::new(Saffman::new(plan, false)),
                plan::Lift::SaffmanMei => Box::new(Saffman::new(plan, true)),
                plan::Lift::Magnus => Box::new(Magnus::new(plan, false)),
                plan::Lift::MagnusOesterleDinh => Box::new(Magnus::new(plan, true)),
            });
        }
        if plan.torque != (plan::Torque::None {}) {
            parts.push(Box::new(Torque::new(plan)));
        }
        let stream = Stream::new(plan, gravity.x);
        Self {
            fluctuation: plan.fluctuation.as_ref().map(Fluctuation::new),
            density: plan.density,
            viscosity: plan.viscosity,
            surface: plan.surface.unwrap_or(f64::INFINITY),
            added_mass: mutated(Mutation::AddedMass, plan.added_mass),
            crowd: plan.hindrance != (plan::Hindrance::None {})
                || plan.drag == (plan::Drag::Gidaspow {})
                || matches!(stream, Stream::Column { .. }),
            stream,
            rotates: parts.iter().any(|part| part.rotates()),
            parts,
        }
    }

    /// The same water with the random numbers of a scene; in the plane nothing fluctuates across.
    #[must_use]
    pub fn seeded(mut self, seed: u64, in_space: bool) -> Self {
        if let Some(fluctuation) = &mut self.fluctuation {
            (fluctuation.seed, fluctuation.in_space) = (seed, in_space);
        }
        self
    }

    /// The water of the next stage: as that is planned, in the state that this one has come to.
    #[must_use]
    pub fn changed(self, plan: &plan::Water, gravity: DVec3) -> Self {
        let mut now = Self::new(plan, gravity);
        if let (Some(now), Some(earlier)) = (&mut now.fluctuation, self.fluctuation) {
            (now.seed, now.in_space) = (earlier.seed, earlier.in_space);
        }
        now.stream.go_on_from(self.stream);
        now
    }

    /// The parts that act.
    pub fn parts(&self) -> impl Iterator<Item = &dyn Part> {
        self.parts.iter().map(|part| &**part)
    }

    /// Height up to which there is water [m]; infinite where there is no surface.
    pub fn surface(&self) -> f64 {
        match &self.stream {
            Stream::Coupled(coupled) if coupled.is_free() => coupled.layers.top(),
            _ => self.surface,
        }
    }

    /// Height at which a picture shows it to end [m]: its surface, or the lid of a coupled stream.
    pub fn level(&self) -> Option<f64> {
        match &self.stream {
            Stream::Coupled(coupled) => Some(coupled.layers.top()),
            _ => Some(self.surface).filter(|surface| surface.is_finite()),
        }
    }

    /// The way it goes, as a unit vector; none where it stands still.
    pub fn direction(&self) -> Option<DVec3> {
        self.stream.direction()
    }

    /// Mass of water that moves along with a grain of this radius [m] when it is at `height` z [m]: C rho V, V what is under
    /// water [kg].
    pub fn added_mass(&self, radius: f64, height: f64) -> f64 {
        self.added_mass * self.density * sphere::volume(radius) * sphere::below((self.surface() - height) / radius)
    }

    /// Drag of a grain in water that passes it at `speed` [m/s]: the size of all forces that go with the motion relative to the water, in N.
    pub fn drag(&self, grain: Submerged, speed: f64) -> f64 {
        let mut parcel = Parcel { len: 1, ..Parcel::default() };
        (parcel.radius[0], parcel.sphericity[0]) = (grain.radius, grain.sphericity);
        parcel.begin(f64::INFINITY);
        parcel.flow[0][0] = speed;
        parcel.slip();
        for part in self.parts.iter().filter(|part| part.kind() == WorkKind::Relative) {
            part.apply(&mut parcel);
            parcel.post(WorkKind::Relative, &mut WaterPowers::default());
        }
        parcel.total(0).length()
    }

    /// Speed at which a grain of this mass [kg] sinks or rises in the end in still water [m/s], where drag carries its
    /// weight under water; by bisection. `None` without weight or drag.
    pub fn terminal(&self, grain: Submerged, mass: f64, gravity: f64) -> Option<f64> {
        let weight = (mass - self.density * grain.volume()).abs() * gravity;
        if weight <= 0.0 || self.drag(grain, 1.0) <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (0.0, 1e-9);
        while self.drag(grain, high) < weight {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if self.drag(grain, middle) < weight { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// Torque on a sphere of this radius [m] that turns at `spin` [rad/s] in water that does not: the size, in N.m.
    pub fn torque(&self, radius: f64, spin: f64) -> f64 {
        let mut parcel = Parcel { len: 1, ..Parcel::default() };
        parcel.radius[0] = radius;
        parcel.begin(f64::INFINITY);
        parcel.flow_spin[0][0] = spin;
        parcel.turn();
        for part in self.parts.iter().filter(|part| part.kind() == WorkKind::Turning) {
            part.apply(&mut parcel);
            parcel.post(WorkKind::Turning, &mut WaterPowers::default());
        }
        parcel.total_torque(0).length()
    }

    /// Whether it may turn grains.
    pub fn rotates(&self) -> bool {
        self.rotates
    }

    /// Fastest water that grains of this diameter [m] meet: at the surface, or ten diameters above the bed [m/s].
    pub fn fastest(&self, diameter: f64) -> f64 {
        // A normal number is rarely beyond two.
        let strength = |fluctuation: Fluctuation| fluctuation.strength * fluctuation.shares[0];
        let fluctuation = self.fluctuation.map_or(0.0, strength) * self.stream.most_turbulent();
        self.stream.fastest(self.surface(), diameter) + 2.0 * fluctuation
    }

    /// How many layers a stream has that gives to the grains and takes from them; without one, none.
    pub fn coupled_layers(&self) -> usize {
        if let Stream::Coupled(coupled) = &self.stream { coupled.layers.len() } else { 0 }
    }

    /// Whether what moves along with a grain depends on where the grain is.
    pub fn has_surface(&self) -> bool {
        self.surface().is_finite()
    }

    /// Forces and torques on the grains of a parcel, whose place, motion and size are filled in; adds their powers to `powers`.
    /// In water that is held still (while grains settle before time 0) nothing powers.
    pub fn act(&self, parcel: &mut Parcel, powers: &mut WaterPowers, held: bool) {
        parcel.begin(self.surface());
        if self.rotates {
            parcel.begin_turning();
        }
        if let Some(layers) = self.stream.layers() {
            layers.find(parcel);
        }
        if !held {
            self.stream.fill(parcel, self.crowd, self.rotates);
            if let Some(fluctuation) = &self.fluctuation {
                self.stream.fill_turbulence(parcel);
                parcel.fluctuate(fluctuation.strength, fluctuation.shares);
            }
        }
        parcel.slip();
        if self.rotates {
            parcel.turn();
        }
        for part in &self.parts {
            part.apply(parcel);
            parcel.post(part.kind(), powers);
        }
    }
}
