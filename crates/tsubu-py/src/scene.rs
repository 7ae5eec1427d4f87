//! Scenes.

use crate::error;
use crate::simulation::Simulation;
use crate::toml_value;
use crate::work::{Done, work};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tsubu::study;
use tsubu::study::apart::Apart;
use tsubu::study::response;
use tsubu::study::sweep::Sweep;
use tsubu::study::variant::Variant;
use tsubu_cli::{Failure, Logs};
use tsubu_frame::{Existing, Status};
use tsubu_scene::Complaints;

/// A scene that is right.
#[pyclass(frozen, module = "tsubu._tsubu")]
pub struct Scene {
    scene: tsubu_scene::Scene,
}

/// What a scene became, or the complaints about it.
fn read(py: Python<'_>, read: Result<tsubu_scene::Scene, Complaints>) -> PyResult<Scene> {
    read.map(|scene| Scene { scene }).map_err(|complaints| error::of(py, &Failure::from(&complaints)))
}

/// A judgement: good, text, advice.
type Line = (bool, String, String);

/// How long somebody waits for a verdict.
const PATIENCE: Duration = Duration::from_secs(9);

#[pymethods]
impl Scene {
    /// Reads a scene file, or the `scene.toml` of a folder.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf, changes: Vec<String>) -> PyResult<Self> {
        let inside = path.join("scene.toml");
        let path = if inside.is_file() { inside } else { path };
        read(py, py.detach(|| tsubu_scene::Scene::read(&path, &changes)))
    }

    /// Reads the text of a scene; files that it names are looked for in `folder`.
    #[staticmethod]
    fn parse(py: Python<'_>, name: &str, text: &str, folder: PathBuf) -> PyResult<Self> {
        read(py, py.detach(|| tsubu_scene::Scene::parse(name, text, &folder, &[])))
    }

    /// A scene from a dictionary with the tables and keys of a scene file.
    #[staticmethod]
    fn from_dict(py: Python<'_>, dictionary: &Bound<'_, PyDict>, folder: PathBuf) -> PyResult<Self> {
        let table = toml_value::table(dictionary)?;
        let text = toml::to_string(&table).map_err(|error| error::wrong(py, error, ""))?;
        read(py, py.detach(|| tsubu_scene::Scene::parse("scene", &text, &folder, &[])))
    }

    /// This scene with another value of a key.
    fn with_value(&self, py: Python<'_>, key: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let value = toml_value::of(value)?;
        read(py, py.detach(|| self.scene.with(&[(key, &value)])))
    }

    /// The name that it was read under.
    #[getter]
    fn name(&self) -> &str {
        self.scene.name()
    }

    /// Its title.
    #[getter]
    fn title(&self) -> &str {
        &self.scene.plan().title
    }

    /// The method that runs it.
    #[getter]
    fn method(&self) -> &str {
        self.scene.plan().method.name()
    }

    /// Its duration, of the first stage [s].
    #[getter]
    fn duration(&self) -> f64 {
        self.scene.plan().duration
    }

    /// What was typed.
    #[getter]
    fn text(&self) -> &str {
        self.scene.text()
    }

    /// The scene in SI numbers with every default.
    fn resolved(&self) -> String {
        self.scene.resolved_toml()
    }

    /// Whether the run would be refused or would fail, and all judgements: good, text, advice.
    fn check(&self, py: Python<'_>) -> PyResult<(bool, Vec<Line>)> {
        let judged = py.detach(|| tsubu_cli::judged(&self.scene, 1, PATIENCE));
        let verdict = judged.map_err(|failure| error::of(py, &failure))?;
        let lines = verdict.lines.into_iter().map(|line| (line.good, line.text, line.advice)).collect();
        Ok((verdict.fails, lines))
    }

    /// Runs it into a folder.
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        existing: &str,
        threads: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let existing = match existing {
            "overwrite" => Existing::Overwrite,
            "resume" => Existing::Resume,
            _ => Existing::Refuse,
        };
        let done = work(py, threads, progress, |watcher| tsubu::run::run(&self.scene, &folder, existing, watcher))?;
        let failed = |error| error::of(py, &Failure::of_scene(&error, &self.scene, &folder));
        let Done { value, raised } = done;
        let summary = value.map_err(failed)?;
        if summary.status != Status::Interrupted {
            return raised.map_or(Ok(()), Err);
        }
        let told = format!(
            "interrupted at t = {} s, step {}; the checkpoint is in {}: go on with `resume=True`",
            summary.simulated_seconds,
            summary.steps,
            folder.display()
        );
        Err(stopped(py, raised, told))
    }

    /// Runs every case of its sweep into a folder.
    fn sweep(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        overwrite: bool,
        threads: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let done =
            work(py, threads, progress, |watcher| study::sweep::sweep(&self.scene, &folder, overwrite, watcher))?;
        done.value.map_err(|error| error::of(py, &Failure::of_cases(&error, &self.scene, &folder)))?;
        not_raised(py, done.raised, &folder)
    }

    /// Its frequency response, into a folder.
    fn response(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        overwrite: bool,
        threads: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let done =
            work(py, threads, progress, |watcher| study::response::response(&self.scene, &folder, overwrite, watcher))?;
        done.value.map_err(|error| error::of(py, &Failure::of_cases(&error, &self.scene, &folder)))?;
        not_raised(py, done.raised, &folder)
    }

    /// The names of the runs of a sweep or a response (`study`) that are missing in a folder, for whoever hands them out; `begin` makes the
    /// folder, or takes one that was begun.
    fn missing(
        &self,
        py: Python<'_>,
        study: &str,
        folder: PathBuf,
        begin: bool,
        overwrite: bool,
    ) -> PyResult<Vec<String>> {
        let names = |study: &mut dyn Apart| {
            if begin {
                study.begin(overwrite)?;
            }
            study.missing()
        };
        let names = py.detach(|| match study {
            "sweep" => names(&mut Sweep::new(&self.scene, &folder)?),
            _ => names(&mut *response::runs(&self.scene, &folder)?),
        });
        names.map_err(|error| error::of(py, &Failure::of_cases(&error, &self.scene, &folder)))
    }

    /// Makes the tables of what is there of a sweep or a response (`study`).
    fn gather(&self, py: Python<'_>, study: &str, folder: PathBuf) -> PyResult<()> {
        let logs = Logs::read(&folder);
        let why = |name: &str| logs.why(name);
        let gathered = py.detach(|| match study {
            "sweep" => Sweep::new(&self.scene, &folder)?.gather(&why).map(drop),
            _ => response::runs(&self.scene, &folder)?.gather(&why).map(drop),
        });
        gathered.map_err(|error| error::of(py, &Failure::of_cases(&error, &self.scene, &folder)))
    }

    /// Runs it by several methods into a folder.
    fn compare(
        &self,
        py: Python<'_>,
        methods: &str,
        folder: PathBuf,
        overwrite: bool,
        threads: usize,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let variants = Variant::list(methods).map_err(|error| error::of(py, &Failure::of_words(&error)))?;
        let done = work(py, threads, progress, |watcher| {
            study::compare::compare(&self.scene, &variants, &folder, overwrite, watcher)
        })?;
        done.value.map_err(|error| error::of(py, &Failure::of_compare(&error, &self.scene, &folder)))?;
        not_raised(py, done.raised, &folder)
    }

    /// Opens it to be moved step by step: at its begin, or where a checkpoint in a folder left it.
    fn open(&self, py: Python<'_>, threads: usize, resume: Option<PathBuf>) -> PyResult<Simulation> {
        Simulation::open(py, &self.scene, threads, resume.as_deref())
    }
}

/// Work that can be gone on with was asked to stop.
fn not_raised(py: Python<'_>, raised: Option<PyErr>, folder: &Path) -> PyResult<()> {
    let told =
        || format!("interrupted; what is done is kept in {}: the same call goes on from there", folder.display());
    raised.map_or(Ok(()), |raised| Err(stopped(py, Some(raised), told())))
}

/// What is raised where work was asked to stop: Ctrl-C with words, anything else as it was.
fn stopped(py: Python<'_>, raised: Option<PyErr>, told: String) -> PyErr {
    match raised {
        Some(raised) if !raised.is_instance_of::<PyKeyboardInterrupt>(py) => raised,
        _ => PyKeyboardInterrupt::new_err(told),
    }
}
