//! Mutations: a constant of an engine 5 % too large, or a rule left out, on purpose, to see which verification cases notice.
//!
//! The feature `mutations` compiles them in. Without it `mutated` gives back what it gets and `left_out` says no, both known when
//! the program is compiled: the engines are the same as if nothing stood here.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

/// What can be wrong on purpose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mutation {
    /// Young's modulus.
    Young,
    /// Poisson's ratio.
    Poisson,
    /// Stiffness of linear springs, Hooke's and Luding's.
    LinearStiffness,
    /// Damping coefficient that a restitution gives.
    Damping,
    /// Tangential stiffness.
    TangentialStiffness,
    /// Friction coefficient.
    Friction,
    /// Rolling friction coefficient.
    RollingFriction,
    /// Twisting friction coefficient.
    TwistingFriction,
    /// Arm of a rolling spring or torque.
    RollingArm,
    /// Surface energy and cohesion.
    Cohesion,
    /// Viscosity of a film.
    FilmViscosity,
    /// Moment of inertia of a grain.
    Inertia,
    /// Drag of water.
    Drag,
    /// Added mass.
    AddedMass,
    /// Buoyancy.
    Buoyancy,
    /// Gravity.
    Gravity,
    /// Force on the second grain of a contact, which is that on the first.
    ThirdLaw,
    /// Losses of energy, as the books have them.
    Losses,
    /// Energy of rotation, as the books have it.
    Rotation,
    /// A tangential spring that gets softer holds less.
    UnloadingRescale,
    /// Springs are kept when neighbour lists are rebuilt.
    HistoryTransfer,
    /// Bodies that touch resist that they slide.
    Sliding,
    /// Places and velocities are brought on together, to second order in time.
    SecondOrder,
    /// Balls of the damper automaton collide.
    BallCollision,
    /// Three particles of an FHP gas that meet turn.
    TripleCollision,
    /// Nothing wrong: a grain of DEM begins a last bit beside its place, and lattices, whose places are whole numbers, draw other random
    /// numbers. It tells which claims hang on the draw.
    LastBit,
}

use Mutation::{
    AddedMass, BallCollision, Buoyancy, Cohesion, Damping, Drag, FilmViscosity, Friction, Gravity, HistoryTransfer,
    Inertia, LinearStiffness, Losses, Poisson, RollingArm, RollingFriction, Rotation, SecondOrder, Sliding,
    TangentialStiffness, ThirdLaw, TripleCollision, TwistingFriction, UnloadingRescale, Young,
};

/// How much larger a mutated constant is.
const FACTOR: f64 = 1.05;

impl Mutation {
    /// All, in the order of tables, each with what it does in words.
    pub const ALL: [(Self, &str); 25] = [
        (Young, "Young's modulus 5 % too large"),
        (Poisson, "Poisson's ratio 5 % too large"),
        (LinearStiffness, "stiffness of linear springs 5 % too large"),
        (Damping, "damping coefficient 5 % too large"),
        (TangentialStiffness, "tangential stiffness 5 % too large"),
        (Friction, "friction 5 % too large"),
        (RollingFriction, "rolling friction 5 % too large"),
        (TwistingFriction, "twisting friction 5 % too large"),
        (RollingArm, "arm of rolling 5 % too long"),
        (Cohesion, "surface energy and cohesion 5 % too large"),
        (FilmViscosity, "viscosity of a film 5 % too large"),
        (Inertia, "moment of inertia 5 % too large"),
        (Drag, "drag coefficient 5 % too large"),
        (AddedMass, "added mass 5 % too large"),
        (Buoyancy, "buoyancy 5 % too large"),
        (Gravity, "gravity 5 % too large"),
        (ThirdLaw, "the second grain of a contact is pushed 5 % too hard"),
        (Losses, "losses of energy are booked 5 % too large"),
        (Rotation, "energy of rotation is booked 5 % too large"),
        (UnloadingRescale, "a tangential spring that gets softer holds what it held"),
        (HistoryTransfer, "springs are forgotten when neighbour lists are rebuilt"),
        (Sliding, "what slides is not resisted"),
        (SecondOrder, "forward differences in place of the step of second order"),
        (BallCollision, "balls of the damper automaton do not collide"),
        (TripleCollision, "three particles of an FHP gas that meet do not turn"),
    ];

    /// By its words.
    pub fn named(words: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, of)| *of == words).map(|(mutation, _)| *mutation)
    }
}

/// A constant, too large where that is the mutation at work.
#[inline(always)]
pub(crate) fn mutated(what: Mutation, value: f64) -> f64 {
    // What is nothing stays so: the mutation does not reach it.
    if value != 0.0 && at_work(what) { FACTOR * value } else { value }
}

/// Whether a rule is left out.
#[inline(always)]
pub(crate) fn left_out(rule: Mutation) -> bool {
    at_work(rule)
}

#[cfg(not(feature = "mutations"))]
#[inline(always)]
fn at_work(_: Mutation) -> bool {
    false
}

#[cfg(feature = "mutations")]
pub use switch::{reached, set};

#[cfg(feature = "mutations")]
use switch::at_work;

#[cfg(feature = "mutations")]
mod switch {
    use super::Mutation;
    use std::cell::Cell;

    // Of a thread, so that whoever runs a case in a pool of one thread has its own mutation.
    thread_local! {
        static AT_WORK: Cell<Option<Mutation>> = const { Cell::new(None) };
        /// A bit for each mutation that was asked for.
        static REACHED: Cell<u32> = const { Cell::new(0) };
    }

    pub(super) fn at_work(what: Mutation) -> bool {
        REACHED.set(REACHED.get() | 1 << what as u32);
        AT_WORK.get() == Some(what)
    }

    /// Puts a mutation to work in all engines of this thread, or none.
    pub fn set(mutation: Option<Mutation>) {
        AT_WORK.set(mutation);
    }

    /// The mutations that would have changed something on this thread since this was last asked.
    pub fn reached() -> Vec<Mutation> {
        let bits = REACHED.take();
        let all = Mutation::ALL.iter().map(|(mutation, _)| *mutation);
        all.filter(|mutation| bits & (1 << *mutation as u32) != 0).collect()
    }
}
