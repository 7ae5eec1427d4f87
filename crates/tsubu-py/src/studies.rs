//! What needs no scene of the user's: verification, pages, templates.

use crate::error;
use crate::work::work;
use pyo3::prelude::*;
use std::path::PathBuf;
use tsubu_cli::Failure;
use tsubu_scene::TEMPLATES;

/// The claims of verification cases, as JSON: a list of pairs of a case's name and a claim.
#[pyfunction]
pub fn verify(
    py: Python<'_>,
    names: Vec<String>,
    all: bool,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let chosen = tsubu_verify::chosen(&names, all).map_err(|text| error::of(py, &Failure::wrong(text)))?;
    let done = work(py, threads, progress, |watcher| {
        tsubu_cli::claims(&chosen, rayon::current_num_threads(), |share| {
            (watcher.progress)(share);
            !watcher.interrupt.asked()
        })
    })?;
    if let Some(raised) = done.raised {
        return Err(raised);
    }
    let claims = done.value.map_err(|failure| error::of(py, &failure))?;
    serde_json::to_string(&claims).map_err(|told| error::wrong(py, told, ""))
}

/// Makes figures and a page of a folder of results; gives the path of the page.
#[pyfunction]
pub fn report(py: Python<'_>, folder: PathBuf) -> PyResult<PathBuf> {
    let written = py.detach(|| tsubu_report::report(&folder));
    written.map(|written| written.page).map_err(|error| error::of(py, &Failure::of_report(&error)))
}

/// The example scenes: name, a line about it, the text, and the files that it names with what is in them.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "it is unpacked where it is called")]
pub fn templates() -> Vec<(&'static str, &'static str, &'static str, Vec<(&'static str, &'static str)>)> {
    TEMPLATES.iter().map(|template| (template.name, template.about, template.text, template.files().to_vec())).collect()
}
