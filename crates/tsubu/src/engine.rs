//! What every method must do.

use crate::ledger::{Energies, Ledger};
use crate::outside::Action;
use crate::partner::Hosts;
use crate::ranks::RankShare;
use crate::view::{View, Wants};
use crate::wall::{Velocity, Wall};
use std::any::Any;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{Advise, Frame, Hint, Kind, State};
use tsubu_scene::Plan;

/// What an engine did with one entry of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Scene key, for example `walls.casing.shape.box.width`.
    pub key: String,
    /// What was made of it.
    pub verdict: Verdict,
    /// One sentence: why, or by how much.
    pub text: String,
}

/// How far an engine honours a scene entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Replaced by something near it; the note says by how much.
    Approximated,
    /// Taken as it is, but hardly what is meant; the note says why, and after a semicolon what to do.
    Doubtful,
    /// Cannot be honoured: the run is refused.
    Refused,
}

/// Why a run stopped by itself (exit code 3).
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// A number is no longer finite.
    #[error("step {step}, t = {} s: the {what} of grain {grain} is not a number", digits(*time))]
    NotFinite {
        /// Step number.
        step: u64,
        /// Simulated time [s].
        time: f64,
        /// Grain id.
        grain: usize,
        /// Name of the column.
        what: &'static str,
    },
    /// Two bodies sit too deep in each other.
    #[error(
        "step {step}, t = {} s: grain {grain} overlaps {other} by {} of {of}, more than `dem.largest-overlap` = {limit}",
        digits(*time), digits(*ratio)
    )]
    Overlap {
        /// Step number.
        step: u64,
        /// Simulated time [s].
        time: f64,
        /// Grain id.
        grain: usize,
        /// The other body, as users know it.
        other: String,
        /// Overlap over what it is held against.
        ratio: f64,
        /// What that is: the diameter, of polyhedra that of their rounded edges.
        of: &'static str,
        /// The limit.
        limit: f64,
        /// Whether one of the two gives way to nothing: frozen, driven, or a wall that is moved as told.
        crushed: bool,
    },
    /// A bed did not come to rest in the time that it was given before time 0.
    #[error(
        "after {step} steps, {} s, the grains have not come to rest: grain {grain} moves at {speed:.3} m/s, and all together have \
         {share:.2} of the energy of a fall by a diameter", digits(*time)
    )]
    Unsettled {
        /// Steps of settling.
        step: u64,
        /// Time of settling [s].
        time: f64,
        /// Id of the fastest grain.
        grain: usize,
        /// Its speed [m/s].
        speed: f64,
        /// Kinetic energy of all over that of a fall by the smallest diameter.
        share: f64,
    },
    /// A lattice cluster was squeezed between opposite walls, or the box left its grid.
    #[error("step {step}, t = {} s: {text}", digits(*time))]
    Lattice {
        /// Step number.
        step: u64,
        /// Simulated time [s].
        time: f64,
        /// What happened.
        text: String,
        /// What to change.
        hint: Option<Hint>,
    },
}

/// A number as it is told in a sentence: with four digits behind the first.
pub(crate) fn digits(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}

impl Advise for Fault {
    fn hints(&self) -> Vec<Hint> {
        let hint = match self {
            Self::NotFinite { .. } => {
                Some("the time step is probably too long; `tsubu check` tells the longest safe one".into())
            }
            Self::Overlap { crushed, .. } => Some(of_overlaps(*crushed).into()),
            Self::Unsettled { .. } => Some(
                "raise `start.settled.time` of their group; grains without friction and damping, or with a `restitution` near 1, \
                 do not come to rest; `start.rows` begins without it"
                    .into(),
            ),
            Self::Lattice { hint, .. } => hint.clone(),
        };
        hint.into_iter().collect()
    }
}

/// What to do about bodies that sit too deep in each other.
const fn of_overlaps(crushed: bool) -> &'static str {
    if crushed {
        "a body that moves as told gives way to nothing: give the grain a way out, or stiffen the material; where grains \
         are meant to be crushed raise `dem.largest-overlap`; a shorter `dem.time-step` helps only against fast impacts"
    } else {
        "shorten `dem.time-step`, or stiffen the material; `tsubu check` tells which; where it is the load that presses \
         so deep, and no shorter step helps, raise `dem.largest-overlap`"
    }
}

/// A scene that this method cannot run (exit code 2).
#[derive(Debug, thiserror::Error)]
#[error("method `{method}` cannot run this scene:\n{}", .notes.iter().map(|n| format!("  {}: {}", n.key, n.text)).collect::<Vec<_>>().join("\n"))]
pub struct Refusal {
    /// `dem` or `lattice`.
    pub method: &'static str,
    /// Every refused entry.
    pub notes: Vec<Note>,
}

impl Refusal {
    /// One entry that this method refuses.
    pub fn of(method: &'static str, key: impl Into<String>, text: impl Into<String>) -> Self {
        Self { method, notes: vec![Note { key: key.into(), verdict: Verdict::Refused, text: text.into() }] }
    }

    /// A method that nobody acts on from outside.
    fn outside(key: String) -> Self {
        let text = "nothing acts on it from outside but what the scene says; `dem` lets itself be acted on";
        Self::of("of this scene", key, text)
    }

    /// A method that knows no grains of several spheres, or of cells.
    pub fn clumps(method: &'static str, group: &str, cells: bool) -> Self {
        let text = if cells {
            "its grains are not made of cells; `cl-ca` and `dem` compute them"
        } else {
            "its grains are no clumps; `dem` computes them"
        };
        Self::of(method, format!("particles.{group}.shape"), text)
    }

    /// A method whose grains nothing holds together.
    pub fn bonds(method: &'static str) -> Self {
        Self::of(method, "bond", "nothing holds its grains together; `dem` computes bonds")
    }

    /// A method that knows one rank.
    pub fn ranks(method: &'static str) -> Self {
        Self::of(method, "method", "it runs on one rank; `dem` runs on several")
    }

    /// A method that knows no stages.
    pub fn stages(method: &'static str) -> Self {
        Self::of(method, "stage", "it runs scenes of one stage; `dem` runs more")
    }
}

/// Why an engine could not be built.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The scene asks for something that the method cannot do.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The settling before time 0 failed.
    #[error("while settling before time 0: {0}")]
    Settling(Fault),
    /// A step after time 0 failed.
    #[error(transparent)]
    Running(#[from] Fault),
    /// A settled bed does not fit the engine it is given to.
    #[error("{0}")]
    Bed(String),
}

impl Advise for OpenError {
    fn hints(&self) -> Vec<Hint> {
        match self {
            Self::Settling(fault) | Self::Running(fault) => fault.hints(),
            Self::Refused(_) | Self::Bed(_) => Vec::new(),
        }
    }
}

/// Something that can advance a plan.
pub trait Engine: Send {
    /// What was approximated, entry by entry.
    fn notes(&self) -> &[Note];

    /// Time step [s].
    fn time_step(&self) -> f64;

    /// The key of a scene that says how long a step is, or what it follows from.
    fn step_key(&self) -> &str;

    /// Steps done since time 0.
    fn steps(&self) -> u64;

    /// Step and time [s] at which this stage of the run began; the first begins with the run.
    fn stage_begin(&self) -> (u64, f64) {
        (0, 0.0)
    }

    /// Simulated time [s]: steps times time step, so that it never drifts.
    fn time(&self) -> f64 {
        let (step, time) = self.stage_begin();
        time + (self.steps() - step) as f64 * self.time_step()
    }

    /// Goes over from the plan of one stage to that of the next, with hosts that have done so. What is held changes by it: the
    /// caller books that.
    fn change(&mut self, [_, now]: [&Plan; 2], _hosts: &Hosts) -> Result<(), OpenError> {
        Err(Refusal::stages(now.method.name()).into())
    }

    /// Turns the clock back to 0: what moves by a signal begins to do so now, from where it stands. The next stage has yet to begin.
    fn restart_clock(&mut self, plan: &Plan, _hosts: &Hosts) -> Result<(), OpenError> {
        Err(Refusal::stages(plan.method.name()).into())
    }

    /// Hosts were given the state of this moment after the engine was: what hangs on them is where they are.
    fn follow_hosts(&mut self, _hosts: &Hosts) {}

    /// Number of grains.
    fn grains(&self) -> usize;

    /// Number of places for grains on the lattice, taken or not; none where there is none.
    fn places(&self) -> usize {
        0
    }

    /// How many grains have come and gone since time 0, and which way: `stream NAME grains`, `removal NAME grains`.
    fn traffic(&self) -> Vec<(String, u64)> {
        Vec::new()
    }

    /// Steps of single grains since time 0: what the computing time was spent on.
    fn grain_steps(&self) -> u64 {
        self.steps() * self.grains() as u64
    }

    /// For how long each rank of the run has worked at its steps [s]; nothing where there is but one.
    fn worked(&self) -> &[f64] {
        &[]
    }

    /// Moves the system by `steps` steps, together with its hosts; posts every flow to the ledger.
    fn advance(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault>;

    /// The same where nobody looks at the system before it has advanced once more: what it is about to do next may be done already, and ranks need
    /// not tell each other what they have.
    fn advance_unseen(&mut self, steps: u64, hosts: &mut Hosts, ledger: &mut Ledger) -> Result<(), Fault> {
        self.advance(steps, hosts, ledger)
    }

    /// Gives all grains that forces move this velocity [m/s] on top of their own, before the first step. Says whether it can.
    fn set_in_motion(&mut self, _velocity: [f64; 3]) -> bool {
        false
    }

    /// Energy of the grains now (the hosts' rows are zero here; [`energies`] adds them).
    fn grain_energies(&self) -> Energies;

    /// Momentum of the grains now [N.s].
    fn momentum(&self) -> [f64; 3];

    /// Centre of mass of the grains that forces move [m]; zero where there are none.
    fn centre_of_mass(&self) -> [f64; 3];

    /// Number of touching pairs (grain-grain and grain-wall) in the last step.
    fn contacts(&self) -> usize;

    /// The answer of this moment.
    fn frame(&self, hosts: &Hosts) -> Frame {
        let mut frame = self.grain_frame(hosts);
        let contacts = self.contact_frame().columns.into_iter().filter(|column| column.kind == Kind::Contact);
        frame.columns.extend(contacts);
        frame
    }

    /// The same without the list of contacts.
    fn grain_frame(&self, hosts: &Hosts) -> Frame;

    /// The list of contacts, and what is said of the world in every file; nothing where a method has no such list.
    fn contact_frame(&self) -> Frame {
        Frame::default()
    }

    /// What the busiest of so many ranks would have; `None` where a method runs on one rank alone.
    fn on_ranks(&self, _ranks: usize) -> Option<RankShare> {
        None
    }

    /// What it can show to those who look on.
    fn offers(&self) -> Wants;

    /// This moment, with what is wanted of what it [offers](Engine::offers).
    fn view(&self, wants: Wants) -> View<'_>;

    /// The walls, in the order of their names; a method that has walls in another form shows none.
    fn walls(&self) -> &[Wall] {
        &[]
    }

    /// From now on a wall moves with this velocity, whatever its scene says, until it is told another.
    fn steer(&mut self, wall: &str, _velocity: Velocity) -> Result<(), Refusal> {
        Err(Refusal::outside(format!("walls.{wall}.motion")))
    }

    /// From now on somebody acts on the grains from outside, asked in every `every`-th step; those who do are counted from 0.
    fn act(&mut self, _every: u64, _action: Box<dyn Action>) -> Result<(), Refusal> {
        Err(Refusal::outside("particles".to_owned()))
    }

    /// Nobody acts from outside any more.
    fn leave(&mut self) {}

    /// Puts a copy in the place of a column of the [view](Engine::view) that lies in the engine's own memory, and gives that memory
    /// away: for those who look at the column longer than the engine keeps it.
    fn renew(&mut self, _column: &str) -> Option<Box<dyn Any + Send + Sync>> {
        None
    }

    /// Writes everything that the next step depends on.
    fn save<'a>(&'a self, state: &mut State<'a>);

    /// Takes the state back; the engine was built from the same plan. What is large may be taken out of `state`, so that it is never twice in memory.
    fn load(&mut self, state: &mut State) -> Result<(), MissingSection>;
}

/// Energy of grains and hosts together.
pub fn energies(engine: &dyn Engine, hosts: &Hosts) -> Energies {
    let mut energies = engine.grain_energies();
    let (kinetic, spring) = hosts.energy(engine.time());
    energies.host_kinetic = kinetic;
    energies.host_spring = spring;
    energies
}
