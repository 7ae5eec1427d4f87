//! Simulations: scenes that are moved step by step.

use crate::arrays;
use crate::error;
use crate::forces::{COLUMNS, Function, Raised, column};
use crate::frame::Frame;
use crate::lease::{Column, Leases};
use crate::pools;
use glam::DVec3;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};
use tsubu::engine::OpenError;
use tsubu::ledger::Account;
use tsubu::run::{RunError, Simulation as Opened};
use tsubu::view::Wants;
use tsubu::wall::Velocity;
use tsubu_cli::Failure;
use tsubu_frame::{Kind, Values};
use tsubu_scene::Scene;

/// How long steps go on before Ctrl-C is looked for.
const LOOK: Duration = Duration::from_millis(30);

/// A scene that is moved step by step.
#[pyclass(frozen, module = "tsubu._tsubu")]
pub struct Simulation {
    core: Mutex<Option<Core>>,
    threads: usize,
    raised: Raised,
}

struct Core {
    opened: Opened,
    leases: Leases,
    /// Whether columns lie in the memory of the engine.
    lends: bool,
    /// Steps that take about as long as [`LOOK`].
    block: u64,
    failed: bool,
}

impl Core {
    /// Whatever lets the engine write into its columns goes through here.
    fn end_leases(&mut self) {
        let Self { opened, leases, .. } = self;
        leases.end(|name| opened.engine.renew(name));
    }
}

impl Drop for Core {
    fn drop(&mut self) {
        self.end_leases();
    }
}

fn closed(py: Python<'_>) -> PyErr {
    error::wrong(py, "the simulation is closed", "open its scene again")
}

fn failed(py: Python<'_>, error: &RunError, scene: &Scene, folder: &Path) -> PyErr {
    error::of(py, &Failure::of_scene(error, scene, folder))
}

impl Simulation {
    pub fn open(py: Python<'_>, scene: &Scene, threads: usize, resume: Option<&Path>) -> PyResult<Self> {
        let pool = pools::take(threads).map_err(|text| error::wrong(py, text, ""))?;
        let opened = py.detach(|| {
            pool.install(|| match resume {
                Some(folder) => Opened::resume(scene, folder),
                None => Opened::open(scene),
            })
        });
        let folder = resume.unwrap_or(Path::new("."));
        let mut opened = opened.map_err(|error| failed(py, &error, scene, folder))?;
        let lends = opened.engine.renew("id").is_some();
        let core = Core { opened, leases: Leases::default(), lends, block: 1, failed: false };
        Ok(Self { core: Mutex::new(Some(core)), threads, raised: Raised::default() })
    }

    /// What is open, where nobody moves it: who waited for that could wait for oneself.
    fn guard(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Option<Core>>> {
        match self.core.try_lock() {
            Ok(guard) => Ok(guard),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                let hint = "a force is told all that it may see; from another thread wait until `advance` has returned";
                Err(error::wrong(py, "the simulation is in the middle of a step", hint))
            }
        }
    }

    fn with<T>(&self, py: Python<'_>, look: impl FnOnce(&mut Core) -> PyResult<T>) -> PyResult<T> {
        match &mut *self.guard(py)? {
            Some(core) => look(core),
            None => Err(closed(py)),
        }
    }
}

#[pymethods]
impl Simulation {
    /// Simulated time [s].
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |core| Ok(core.opened.engine.time()))
    }

    /// Steps since time 0.
    #[getter]
    fn steps(&self, py: Python<'_>) -> PyResult<u64> {
        self.with(py, |core| Ok(core.opened.engine.steps()))
    }

    /// Time step [s].
    #[getter]
    fn time_step(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |core| Ok(core.opened.engine.time_step()))
    }

    /// Number of grains.
    #[getter]
    fn particles(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |core| Ok(core.opened.engine.grains()))
    }

    /// Touching pairs in the last step.
    #[getter]
    fn touching(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |core| Ok(core.opened.engine.contacts()))
    }

    /// The name of the present stage.
    #[getter]
    fn stage(&self, py: Python<'_>) -> PyResult<Option<String>> {
        self.with(py, |core| Ok(core.opened.stage().map(str::to_owned)))
    }

    /// Steps from now to the one that ends nearest to a time [s].
    fn steps_to(&self, py: Python<'_>, time: f64) -> PyResult<u64> {
        self.with(py, |core| Ok(core.opened.steps_to(time)))
    }

    /// Steps of the present stage that are left.
    fn steps_left(&self, py: Python<'_>) -> PyResult<u64> {
        self.with(py, |core| Ok(core.opened.steps_left()))
    }

    /// Moves everything by so many steps, in pieces between which Ctrl-C is heard.
    fn advance(&self, py: Python<'_>, steps: u64) -> PyResult<()> {
        let mut guard = self.guard(py)?;
        let Some(core) = guard.as_mut() else { return Err(closed(py)) };
        if core.failed {
            let hint = "open its scene again, or go on from a checkpoint with `resume`";
            return Err(error::wrong(py, "the simulation has failed and does not go on", hint));
        }
        core.end_leases();
        let pool = pools::take(self.threads).map_err(|text| error::wrong(py, text, ""))?;
        let mut left = steps;
        while left > 0 {
            let (block, before) = (core.block.min(left), core.opened.engine.steps());
            let begun = Instant::now();
            let opened = &mut core.opened;
            let done = py.detach(|| pool.install(|| opened.advance(block)));
            if let Err(fault) = done {
                core.failed = true;
                return Err(error::of(py, &Failure::from(&OpenError::Running(fault))));
            }
            if let Some(raised) = self.raised.lock().unwrap_or_else(PoisonError::into_inner).take() {
                return Err(raised);
            }
            py.check_signals()?;
            left -= (core.opened.engine.steps() - before).min(left);
            core.block = if begun.elapsed() < LOOK { (2 * core.block).min(1 << 20) } else { (core.block / 2).max(1) };
        }
        Ok(())
    }

    /// Goes over to the next stage now; says whether there is one.
    fn next_stage(&self, py: Python<'_>) -> PyResult<bool> {
        let pool = pools::take(self.threads).map_err(|text| error::wrong(py, text, ""))?;
        self.with(py, |core| {
            core.end_leases();
            let opened = &mut core.opened;
            let done = py.detach(|| pool.install(|| opened.next_stage()));
            done.map_err(|error| failed(py, &error, core.opened.scene(), Path::new(".")))
        })
    }

    /// Names and units of the columns of grains.
    fn grain_columns(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, &'static str)>> {
        self.with(py, |core| {
            let frame = core.opened.engine.grain_frame(&core.opened.hosts);
            Ok(frame.of(Kind::Grain).map(|column| (column.name, column.unit)).collect())
        })
    }

    /// A column of grains, in the order of the engine: in its memory where it lies there, else a copy.
    fn grain_column<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.with(py, |core| {
            if COLUMNS.contains(&name) {
                return seen(py, core, column(name)?);
            }
            let frame = core.opened.engine.grain_frame(&core.opened.hosts);
            let found = frame.of(Kind::Grain).find(|column| column.name == name);
            let Some(found) = found else { return Err(PyKeyError::new_err(name.to_owned())) };
            let ids = core.opened.engine.view(Wants::GRAINS).grains.id.into_owned();
            Ok(arrays::of_values(py, in_order(&found.values, &ids, frame.integers(Kind::Grain, "id"))))
        })
    }

    /// This moment as a frame, grains in the order of their ids.
    fn frame(&self, py: Python<'_>) -> PyResult<Frame> {
        self.with(py, |core| Ok(Frame { frame: core.opened.engine.frame(&core.opened.hosts) }))
    }

    /// Names of the walls.
    fn wall_names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |core| Ok(core.opened.engine.walls().iter().map(|wall| wall.name.clone()).collect()))
    }

    /// A wall: force [N], torque [N.m] about its centre, displacement [m], velocity [m/s], spin [rad/s], centre [m], whether it has vanished.
    fn wall<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, |core| {
            let engine = &core.opened.engine;
            let at = engine.walls().iter().position(|wall| wall.name == name);
            let Some(at) = at else { return Err(PyKeyError::new_err(name.to_owned())) };
            let load = engine.view(Wants::WALLS).walls.get(at).copied().unwrap_or_default();
            let wall = &engine.walls()[at];
            let told = PyDict::new(py);
            let vectors = [
                ("force", load.force),
                ("torque", load.torque),
                ("displacement", wall.pose.offset),
                ("velocity", wall.pose.velocity),
                ("spin", wall.pose.spin),
                ("centre", wall.pose.origin()),
            ];
            for (name, vector) in vectors {
                told.set_item(name, numpy::PyArray1::from_slice(py, &vector.to_array()))?;
            }
            told.set_item("vanished", wall.vanished())?;
            Ok(told)
        })
    }

    /// A wall moves with this velocity [m/s] and spin [rad/s] from now on.
    fn steer(&self, py: Python<'_>, wall: &str, linear: [f64; 3], spin: [f64; 3]) -> PyResult<()> {
        self.with(py, |core| {
            let velocity = Velocity { linear: DVec3::from_array(linear), spin: DVec3::from_array(spin) };
            let steered = core.opened.engine.steer(wall, velocity);
            steered.map_err(|refusal| failed(py, &RunError::Open(refusal.into()), core.opened.scene(), Path::new(".")))
        })
    }

    /// The hosts: name, displacement [m], velocity [m/s], force of the grains [N].
    fn hosts(&self, py: Python<'_>) -> PyResult<Vec<(String, f64, f64, f64)>> {
        self.with(py, |core| {
            let hosts = &core.opened.hosts;
            let told = hosts.names().iter().zip(&hosts.list);
            Ok(told.map(|(name, h)| (name.clone(), h.displacement(), h.velocity(), h.grain_force())).collect())
        })
    }

    /// Energies and accounts [J], and the residual [J] and its share of the energy turned over [-].
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, |core| {
            let (energies, ledger) = (core.opened.energies(), &core.opened.ledger);
            let told = PyDict::new(py);
            for (name, value) in energies.terms() {
                told.set_item(name, value)?;
            }
            for account in Account::ALL {
                told.set_item(account.name(), ledger.flow(account))?;
            }
            told.set_item("residual", ledger.residual(&energies))?;
            told.set_item("residual_relative", ledger.residual_relative(&energies))?;
            let momentum = ledger.momentum_residual(core.opened.engine.momentum());
            told.set_item("momentum residual", DVec3::from_array(momentum).length())?;
            Ok(told)
        })
    }

    /// Hash of everything that the next step depends on.
    fn state_hash(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |core| Ok(core.opened.state().hash()))
    }

    /// Writes scene and state into a folder.
    fn checkpoint(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        self.with(py, |core| {
            let written = core.opened.checkpoint(&folder);
            written.map_err(|error| error::of(py, &Failure::of_file(&error, &folder)))
        })
    }

    /// Asks a function for forces in every `every`-th step; it is given the columns.
    fn act(&self, py: Python<'_>, function: Py<PyAny>, every: u64, columns: Vec<String>) -> PyResult<()> {
        let columns = columns.iter().map(|name| column(name)).collect::<PyResult<Vec<_>>>()?;
        let function = Function { asked: function, columns, raised: Arc::clone(&self.raised) };
        self.with(py, |core| {
            let acts = core.opened.engine.act(every, Box::new(function));
            acts.map_err(|refusal| failed(py, &RunError::Open(refusal.into()), core.opened.scene(), Path::new(".")))
        })
    }

    /// Asks nobody for forces any more.
    fn leave(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |core| {
            core.opened.engine.leave();
            Ok(())
        })
    }

    /// Gives its memory back.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        *self.guard(py)? = None;
        Ok(())
    }
}

/// A column of the view.
fn seen<'py>(py: Python<'py>, core: &mut Core, name: &'static str) -> PyResult<Bound<'py, PyAny>> {
    let Core { opened, leases, lends, .. } = core;
    let grains = opened.engine.view(Wants { spins: true, ..Wants::GRAINS }).grains;
    let vectors = |column: &Cow<'_, [DVec3]>, leases: &mut Leases| match column {
        Cow::Borrowed(rows) if *lends => leases.array(py, name, Column::Vectors(rows)),
        other => Ok(arrays::of_vectors(py, other)),
    };
    let numbers = |column: &Cow<'_, [f64]>, leases: &mut Leases| match column {
        Cow::Borrowed(rows) if *lends => leases.array(py, name, Column::Numbers(rows)),
        other => Ok(arrays::of_values(py, Values::Scalar(other.to_vec()))),
    };
    let whole = |column: &Cow<'_, [u32]>, leases: &mut Leases| match column {
        Cow::Borrowed(rows) if *lends => leases.array(py, name, Column::Whole(rows)),
        other => Ok(arrays::of_values(py, Values::Integer(other.iter().map(|&id| i64::from(id)).collect()))),
    };
    match name {
        "position" => vectors(&grains.position, leases),
        "velocity" => vectors(&grains.velocity, leases),
        "spin" => vectors(&grains.spin, leases),
        "radius" => numbers(&grains.radius, leases),
        "mass" => numbers(&grains.mass, leases),
        "group" => whole(&grains.group, leases),
        _ => whole(&grains.id, leases),
    }
}

/// Rows that stand in the order of `from`, in the order of `ids`.
fn in_order(values: &Values, ids: &[u32], from: &[i64]) -> Values {
    let places: Vec<usize> = ids.iter().filter_map(|&id| from.binary_search(&i64::from(id)).ok()).collect();
    match values {
        Values::Scalar(v) => Values::Scalar(places.iter().map(|&at| v[at]).collect()),
        Values::Vector(v) => Values::Vector(places.iter().map(|&at| v[at]).collect()),
        Values::Quaternion(v) => Values::Quaternion(places.iter().map(|&at| v[at]).collect()),
        Values::Integer(v) => Values::Integer(places.iter().map(|&at| v[at]).collect()),
    }
}
