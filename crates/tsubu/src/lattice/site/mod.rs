//! Models whose grains are on sites, as engines: what they share.
//!
//! A [`Model`] is a rule on sites, in spacings and steps. [`ground`] paints the walls and outlets of a scene onto its
//! lattice, [`start`] says where grains begin, [`build`] takes the plan apart and [`engine`] gives lengths, times and
//! masses to what the model does. [`hopping`], [`grains`] and [`pile`] are the models as seen from there, those with one
//! grain a site; [`gas`] builds the lattice gases, [`fhp`], [`grain_gas`] and [`avalanche`].

pub mod avalanche;
pub mod build;
pub mod engine;
pub mod fhp;
pub mod gas;
pub mod grain_gas;
pub mod grains;
pub mod ground;
pub mod hopping;
pub mod pile;
pub mod rule;
pub mod start;

use crate::view::Wants;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// A grain, where it is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seat {
    /// Its number.
    pub grain: usize,
    /// Its site.
    pub site: usize,
    /// Position less that of the site, in spacings: to the right, and up.
    pub offset: [f64; 2],
    /// Velocity, in spacings a step.
    pub velocity: [f64; 2],
    /// How often it has crossed the high end of a world that repeats itself along x and z, less how often the low one.
    pub laps: [i32; 2],
}

/// A force between a grain and another or a wall, on the sites of the lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The site of the grain that gives it.
    pub from: usize,
    /// The site of who takes it.
    pub to: usize,
    /// Force on who takes it, over the unit of force of the [model](Model::force_unit): to the right, and up.
    pub force: [f64; 2],
}

/// A rule by which grains on sites move.
pub trait Model: Send {
    /// One step.
    fn advance(&mut self) -> Result<(), String>;

    /// Steps done.
    fn step(&self) -> u64;

    /// Calls for every grain that is there.
    fn seats(&self, each: &mut dyn FnMut(Seat));

    /// A wall has vanished from a site, which is an outlet where grains are removed.
    fn free(&mut self, site: usize, outlet: bool);

    /// The most grains that a site holds, and how far one goes in a step at most [spacings].
    fn limits(&self) -> (usize, f64) {
        (1, 1.0)
    }

    /// A grain comes in at a site if it can, and then moves down; how it came.
    fn enter(&mut self, _grain: usize, _site: usize) -> Option<Seat> {
        None
    }

    /// The grains that were removed since the last call, as they were then.
    fn removed(&mut self) -> Vec<Seat>;

    /// The way that an elongated grain lies: a unit vector, to the right and up.
    fn axis(&self, _grain: usize) -> Option<[f64; 2]> {
        None
    }

    /// What it can show beside grains.
    fn offers(&self) -> Wants {
        Wants::GRAINS
    }

    /// Touching pairs and their forces, as far as it [offers](Model::offers) them.
    fn links(&self) -> Vec<Link> {
        Vec::new()
    }

    /// Number of touching pairs.
    fn contacts(&self) -> usize {
        0
    }

    /// What one stands for in [`Link::force`]: newtons, or the mass of the grain that gives it times spacings a step
    /// squared.
    fn force_unit(&self) -> ForceUnit {
        ForceUnit::Motion
    }

    /// Writes everything that the next step depends on.
    fn save(&self, state: &mut State);

    /// Takes it back.
    fn load(&mut self, state: &State) -> Result<(), MissingSection>;
}

/// Unit of the forces of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceUnit {
    /// Newtons.
    Newton,
    /// Mass of the giving grain times spacings a step squared.
    Motion,
}

/// An integer section of the given length.
pub(super) fn section<'a>(state: &'a State, name: &str, length: usize) -> Result<&'a [i64], MissingSection> {
    let values = state.integer(name)?;
    if values.len() == length { Ok(values) } else { Err(wrong(name)) }
}

/// That a section is not what it should be.
pub(super) fn wrong(name: &str) -> MissingSection {
    MissingSection { name: name.to_owned(), kind: "integer" }
}
