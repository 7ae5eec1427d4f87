//! Watches: they read, never write, and say what they want, so that nothing is made for nobody.
//!
//! A [`Watch`] turns a [`View`] into a [`Sample`]: numbers for the history and rows for a table of its own.
//! [`Watches`] are those of a run: when they look ([`Trigger`]), where their rows go, what their means are, and what of
//! them a checkpoint holds. One file a watch; each says what it measures, in which units, after whom, and where it ends.

mod axial;
mod cells;
mod classes;
mod course;
pub mod kernel;
pub(crate) mod means;
mod points;
mod run;
mod surface;
mod trigger;
mod volumes;

pub use run::Watches;
pub use trigger::Trigger;
use volumes::Volumes;

use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use std::fmt::Debug;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{self, Measure, Plan, Region};

/// Something that looks on.
pub trait Watch: Send + Debug {
    /// What is measured, formula, units, source, limits.
    fn about(&self) -> &'static About;

    /// What it wants to see.
    fn wants(&self) -> Wants;

    /// The numbers it gives, `what [unit]`.
    fn scalars(&self) -> Vec<String>;

    /// How the names of those begin that count or average what has been since the begin: the last value tells them, and no mean does.
    fn so_far(&self) -> &'static [&'static str] {
        &[]
    }

    /// How the names of those begin that are the components of an axis whose head and tail are alike: their means say nothing, the mean axis does.
    fn axis(&self) -> Option<&'static str> {
        None
    }

    /// Its own table, if it has one.
    fn sheet(&self) -> Option<Sheet> {
        None
    }

    /// Looks.
    fn take(&mut self, view: &View) -> Sample;

    /// What the reader of the results should know: that what was to be measured did not happen. `last`: no stage follows in which it may.
    fn remark(&self, _last: bool) -> Option<String> {
        None
    }

    /// Writes what the next look depends on into a checkpoint; most watches remember nothing.
    fn save(&self, _name: &str, _state: &mut State) {}

    /// Takes it back.
    fn load(&mut self, _name: &str, _state: &State) -> Result<(), MissingSection> {
        Ok(())
    }
}

/// The columns of a watch's own table, after the time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Columns that say what a row is about: `z [m]`.
    pub coordinates: Vec<String>,
    /// Columns of values.
    pub values: Vec<String>,
    /// Whether every look gives the same rows, so that each has a mean over time.
    pub steady: bool,
}

/// What a look gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sample {
    /// One value for each of [`Watch::scalars`]; not a number where there is nothing to measure.
    pub scalars: Vec<f64>,
    /// Rows of the table: coordinates, then values.
    pub rows: Vec<Vec<f64>>,
}

/// From the list of the kinds of watches, which stands in the plan (`tsubu_scene::plan::watch`): the file of each, here beside this
/// one, with its text and how it is opened.
macro_rules! watches {
    ($($file:ident::$kind:ident)*) => {
        $(pub(crate) mod $file;)*

        /// What the kinds of watches are.
        pub const ABOUT: &[&About] = &[$(&$file::ABOUT),*];

        /// Builds a watch.
        pub fn open(measure: &Measure, plan: &Plan) -> Box<dyn Watch> {
            match measure {
                $(Measure::$kind(asked) => Box::new($file::open(asked, plan))),*
            }
        }
    };
}
tsubu_scene::every_watch!();

/// Names of the axes.
const LETTERS: [&str; 3] = ["x", "y", "z"];

/// The axes that a scene has.
pub type Axes = &'static [usize];

fn axes(plan: &Plan) -> Axes {
    if plan.dimension == 3 { &[0, 1, 2] } else { &[0, 2] }
}

/// Number of a group; the scene has been checked, so it is there.
fn group_number(plan: &Plan, name: &str) -> u32 {
    plan.particles.keys().position(|known| known == name).unwrap_or(0) as u32
}

/// A box of space that may be everywhere.
#[derive(Clone, Debug)]
pub struct Inside {
    region: Option<Region>,
    axes: Axes,
}

impl Inside {
    /// A region of a plan; `None` is everywhere.
    pub fn new(region: Option<&plan::Region>, plan: &Plan) -> Self {
        Self { region: region.cloned(), axes: axes(plan) }
    }

    /// Whether a point is in it; the low ends belong to it, the high ends do not.
    pub fn holds(&self, p: DVec3) -> bool {
        self.holds_but(p, &[])
    }

    /// The same, not looking along some axes.
    pub fn holds_but(&self, p: DVec3, not: &[usize]) -> bool {
        let Some(region) = &self.region else { return true };
        let mut looked_at = self.axes.iter().filter(|a| !not.contains(a));
        looked_at.all(|&a| p[a] >= region.low[a] && p[a] < region.high[a]) && region.rounds(p.to_array(), 0.0)
    }
}

/// Mean of numbers; not a number if there are none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
    sum / count
}
