//! Functions of Python that act on grains.

use crate::arrays;
use crate::lease::{Column, Leases};
use glam::DVec3;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::{Arc, Mutex, PoisonError};
use tsubu::outside::{Action, Heed, Moment, Push};
use tsubu::state::Grains;

/// What a function has raised: it is raised again when the step is done.
pub type Raised = Arc<Mutex<Option<PyErr>>>;

/// A function that is asked for forces.
pub struct Function {
    pub asked: Py<PyAny>,
    /// The columns that it is given.
    pub columns: Vec<&'static str>,
    pub raised: Raised,
}

/// Columns of grains that lie in the memory of an engine, by their names in frames.
pub const COLUMNS: [&str; 7] = ["id", "group", "position", "velocity", "spin", "radius", "mass"];

/// The name of a column that lies in the memory of an engine.
pub fn column(name: &str) -> PyResult<&'static str> {
    let known = COLUMNS.into_iter().find(|known| *known == name);
    known.ok_or_else(|| PyKeyError::new_err(format!("`{name}`: a function may see {}", COLUMNS.join(", "))))
}

fn of<'a>(grains: &'a Grains, name: &str) -> Column<'a> {
    match name {
        "group" => Column::Whole(&grains.group),
        "position" => Column::Vectors(&grains.position),
        "velocity" => Column::Vectors(&grains.velocity),
        "spin" => Column::Vectors(&grains.spin),
        "radius" => Column::Numbers(&grains.radius),
        "mass" => Column::Numbers(&grains.mass),
        _ => Column::Whole(&grains.id),
    }
}

impl Function {
    fn ask(
        &self,
        py: Python<'_>,
        time: f64,
        step: u64,
        grains: &Grains,
        leases: &mut Leases,
        push: &mut Push,
    ) -> PyResult<()> {
        let now = PyDict::new(py);
        now.set_item("time", time)?;
        now.set_item("step", step)?;
        for name in &self.columns {
            now.set_item(name, leases.array(py, name, of(grains, name))?)?;
        }
        let answer = self.asked.bind(py).call1((now,))?;
        let fill = |column: &mut Vec<DVec3>, value: &Bound<'_, PyAny>, what: &str| -> PyResult<()> {
            if !value.is_none() {
                arrays::vectors(value, grains.len(), what, column)?;
            }
            Ok(())
        };
        match answer.cast::<PyTuple>() {
            Ok(both) if both.len() == 2 => {
                fill(&mut push.force, &both.get_item(0)?, "forces")?;
                fill(&mut push.torque, &both.get_item(1)?, "torques")
            }
            _ => fill(&mut push.force, &answer, "forces"),
        }
    }
}

impl Action for Function {
    fn act(&mut self, moment: Moment<'_>, push: &mut Push) -> Heed {
        let Moment { time, step, grains } = moment;
        Python::attach(|py| {
            if self.raised.lock().unwrap_or_else(PoisonError::into_inner).is_some() {
                return Heed::Stop;
            }
            let mut leases = Leases::default();
            let asked = self.ask(py, time, step, grains, &mut leases, push);
            // The step goes on and writes: arrays that the function has kept get the memory.
            leases.end(|name| grains.renew(name));
            let Err(error) = asked else { return Heed::Act };
            *self.raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            Heed::Stop
        })
    }
}
