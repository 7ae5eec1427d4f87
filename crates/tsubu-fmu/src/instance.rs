//! An instance of a unit: what a tool has told it, and in which mode it is.

use crate::error::Error;
use crate::moving::{Moment, Motion, Moving};
use crate::pack;
use crate::variables::{Meaning, Told, Variable, variables};
use std::path::Path;
use tsubu_scene::Scene;

/// The modes of the standard that this unit has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Made, or reset.
    Instantiated,
    /// The motion at the start may be told.
    Initialization,
    /// Steps may be made.
    Step,
    /// Over: values can still be read.
    Terminated,
    /// A step has failed: values can still be read, and a reset begins anew.
    Failed,
}

/// A scene that a tool moves.
pub struct Instance {
    scene: Scene,
    variables: Vec<Variable>,
    /// What was told of the base of each host; of those without a base nothing ever is.
    bases: Vec<Motion>,
    /// The same when time began.
    first: Vec<Motion>,
    mode: Mode,
    /// Time of the tool when the engine's clock stands at 0 [s].
    start: f64,
    moving: Option<Moving>,
}

/// Everything that an instance was at a moment.
#[derive(Clone)]
pub struct Snapshot {
    bases: Vec<Motion>,
    first: Vec<Motion>,
    mode: Mode,
    start: f64,
    moment: Option<Moment>,
}

impl Instance {
    /// Reads the scene in the folder of resources of a unit; `token` is what the description of the unit says.
    ///
    /// # Errors
    ///
    /// A scene that is wrong, and a token that belongs to another.
    pub fn new(resources: &Path, token: &str) -> Result<Self, Error> {
        let scene = Scene::read(&resources.join(pack::SCENE), &[])?;
        if pack::token(scene.text()) != token {
            return Err(Error::new("the description of this unit and the scene in it do not belong together")
                .hint("pack the scene again"));
        }
        Ok(Self::of(scene))
    }

    /// The same of a scene.
    pub fn of(scene: Scene) -> Self {
        let still = vec![Motion::default(); scene.plan().hosts.len()];
        let variables = variables(scene.plan());
        let (bases, first) = (still.clone(), still);
        Self { scene, variables, bases, first, mode: Mode::Instantiated, start: 0.0, moving: None }
    }

    /// Its mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Begins the mode in which the motion at the start is told; `start` is the time of the tool then [s].
    ///
    /// # Errors
    ///
    /// Another mode than the first.
    pub fn begin(&mut self, start: f64) -> Result<(), Error> {
        self.must_be(&[Mode::Instantiated], "initialization")?;
        if !start.is_finite() {
            return Err(Error::new(format!("a start at {start} s")));
        }
        (self.mode, self.start) = (Mode::Initialization, start);
        Ok(())
    }

    /// Ends that mode: the scene is opened, its bed settles. Returns what its method had to say of it.
    ///
    /// # Errors
    ///
    /// Another mode, and a scene that does not open.
    pub fn settle(&mut self) -> Result<Vec<String>, Error> {
        self.must_be(&[Mode::Initialization], "the end of initialization")?;
        let moving = self.opened()?;
        let notes = moving.notes().map(|(key, text)| format!("{key}: {text}")).collect();
        self.mode = Mode::Step;
        Ok(notes)
    }

    /// Moves everything from a communication point by a step [s].
    ///
    /// # Errors
    ///
    /// Another mode, a step that does not fit the engine's (nothing has moved then), and a step of the engine that fails: nothing goes on
    /// then but a reset.
    pub fn step(&mut self, point: f64, size: f64) -> Result<(), Error> {
        self.must_be(&[Mode::Step], "a step")?;
        let Some(moving) = &mut self.moving else { return Err(Error::new("the scene is not open")) };
        let begin = point - self.start;
        let steps = moving.steps(begin, begin + size)?;
        let moved = moving.advance(steps, &self.bases);
        if moved.is_err() {
            self.mode = Mode::Failed;
        }
        moved
    }

    /// Ends the simulation. Returns what is to be said of its books.
    ///
    /// # Errors
    ///
    /// A mode in which nothing moves.
    pub fn terminate(&mut self) -> Result<Option<String>, Error> {
        self.must_be(&[Mode::Step], "the end")?;
        self.mode = Mode::Terminated;
        Ok(self.moving.as_ref().filter(|moving| !moving.books_close()).map(Moving::unexplained))
    }

    /// Makes it what it was when it was made.
    pub fn reset(&mut self) {
        *self = Self::of(self.scene.clone());
    }

    /// Nothing may be done any more: something in it has gone wrong that should not.
    pub fn give_up(&mut self) {
        self.mode = Mode::Failed;
        self.moving = None;
    }

    /// Tells a motion.
    ///
    /// # Errors
    ///
    /// What is no input, no number, or comes too late.
    pub fn set(&mut self, reference: u32, value: f64) -> Result<(), Error> {
        let (mode, variable) = (self.mode, self.variable(reference)?);
        let Meaning::Base(host, told) = variable.meaning else {
            return Err(Error::new(format!("`{}` cannot be set", variable.name)));
        };
        if !value.is_finite() {
            return Err(Error::new(format!("`{}` is set to {value}", variable.name)));
        }
        self.must_be(&[Mode::Instantiated, Mode::Initialization, Mode::Step], "an input")?;
        let base = &mut self.bases[host];
        match told {
            Told::Displacement => base.displacement = value,
            Told::Velocity => base.velocity = value,
            Told::Acceleration => base.acceleration = value,
        }
        // What was opened to be looked at began in another motion.
        if mode != Mode::Step && told != Told::Acceleration {
            self.moving = None;
        }
        Ok(())
    }

    /// Tells a number.
    ///
    /// # Errors
    ///
    /// What is none, what is not known before the initialization, and a scene that does not open.
    pub fn number(&mut self, reference: u32) -> Result<f64, Error> {
        let variable = self.variable(reference)?;
        let meaning = variable.meaning;
        if variable.is_boolean() {
            return Err(Error::new(format!("`{}` is no number", variable.name)));
        }
        if let Meaning::Base(host, told) = meaning {
            let Motion { displacement, velocity, acceleration } = self.bases[host];
            return Ok(match told {
                Told::Displacement => displacement,
                Told::Velocity => velocity,
                Told::Acceleration => acceleration,
            });
        }
        let start = self.start;
        if meaning == Meaning::Time {
            return Ok(start + self.moving.as_ref().map_or(0.0, Moving::time));
        }
        let moving = self.looked_at()?;
        let energies = moving.energies();
        Ok(match meaning {
            Meaning::Displacement(host) => moving.host(host)[0],
            Meaning::Velocity(host) => moving.host(host)[1],
            Meaning::Force(host) => moving.host(host)[2],
            Meaning::MeanForce(host) => moving.host(host)[3],
            Meaning::Kinetic => energies.kinetic + energies.rotational,
            Meaning::Potential => energies.potential,
            Meaning::Elastic => energies.elastic,
            Meaning::Structures => energies.host_kinetic + energies.host_spring,
            Meaning::Dissipated => moving.dissipated(),
            Meaning::BaseWork => moving.base_work(),
            Meaning::Residual => moving.residual(),
            Meaning::Time | Meaning::Base(..) | Meaning::Well => f64::NAN,
        })
    }

    /// Tells what is true or false.
    ///
    /// # Errors
    ///
    /// As [`Instance::number`].
    pub fn truth(&mut self, reference: u32) -> Result<bool, Error> {
        let variable = self.variable(reference)?;
        if !variable.is_boolean() {
            return Err(Error::new(format!("`{}` is a number", variable.name)));
        }
        Ok(self.mode != Mode::Failed && self.looked_at()?.books_close())
    }

    /// What it is now.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            bases: self.bases.clone(),
            first: self.first.clone(),
            mode: self.mode,
            start: self.start,
            moment: self.moving.as_ref().map(Moving::moment),
        }
    }

    /// Makes it what it was.
    ///
    /// # Errors
    ///
    /// A scene that does not open.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let Snapshot { bases, first, mode, start, moment } = snapshot;
        let moving = moment.as_ref().map(|moment| Moving::at(&self.scene, first, moment)).transpose()?;
        (self.bases, self.first, self.mode, self.start, self.moving) =
            (bases.clone(), first.clone(), *mode, *start, moving);
        Ok(())
    }

    fn variable(&self, reference: u32) -> Result<&Variable, Error> {
        let none = || Error::new(format!("there is no variable with the value reference {reference}"));
        self.variables.get(reference as usize).ok_or_else(none)
    }

    fn must_be(&self, modes: &[Mode], what: &str) -> Result<(), Error> {
        if modes.contains(&self.mode) {
            return Ok(());
        }
        let error = Error::new(format!("{what} is asked for in the mode {:?}", self.mode));
        Err(if self.mode == Mode::Failed { error.hint("reset the instance, or make another") } else { error })
    }

    /// What is looked at between steps, or when the start is being told.
    fn looked_at(&mut self) -> Result<&mut Moving, Error> {
        if self.moving.is_none() {
            self.must_be(&[Mode::Initialization], "an output")?;
        }
        self.opened()
    }

    fn opened(&mut self) -> Result<&mut Moving, Error> {
        let moving = if let Some(moving) = self.moving.take() {
            moving
        } else {
            self.first.clone_from(&self.bases);
            Moving::open(&self.scene, &self.first)?
        };
        Ok(self.moving.insert(moving))
    }
}
