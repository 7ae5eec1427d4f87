//! The picture: figures, particle images, animations and the self-contained report page.
//!
//! It reads what a run left in its folder and nothing else: [`build`] makes a [`page::Report`] of it, [`report`]
//! writes that as `report.html`, with the figures beside it.

use std::path::{Path, PathBuf};

use tsubu_frame::{FileError, RunFolder};

pub mod animation;
mod atlas;
pub mod balls;
mod calibration;
mod canvas;
mod claims;
pub mod colour;
mod compare;
pub mod compass;
mod design;
mod ensemble;
mod field;
pub mod figure;
mod gallery;
mod legend;
mod moments;
mod moving;
pub mod page;
mod plot;
mod prediction;
pub mod quantity;
pub mod raster;
mod response;
mod run;
mod solid;
mod source;
mod steady;
pub mod strip;
mod summary;
mod sweep;
pub mod text;
mod veil;
mod verify;
mod wall_motion;
mod watch;

use page::Report;
use source::Source;

/// The file of the page.
const PAGE: &str = "report.html";

/// A folder of which no report can be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// There is no such folder.
    #[error("{} is not a folder", path.display())]
    NoFolder {
        /// What was asked for.
        path: PathBuf,
    },
    /// It holds nothing that tsubu writes.
    #[error(
        "{} holds no results: none of summary.json, history.csv, response.csv, atlas.csv, prediction.csv, design.csv, posterior.csv, sweep.csv, compare.json, verify.json or frames/ is in it",
        path.display()
    )]
    NoResults {
        /// The folder.
        path: PathBuf,
    },
    /// The report could not be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// A page that was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// Its path.
    pub page: PathBuf,
    /// What is missing, cut off or not tsubu's among the results; the page says it, too.
    pub damage: Vec<String>,
}

/// Writes `report.html` and `figures/` into a folder of results, whatever kind it is.
pub fn report(dir: &Path) -> Result<Written, ReportError> {
    let (report, Source { files, damage, .. }) = gather(dir)?;
    let names = files.iter().map(|(name, _)| name.as_str()).chain([PAGE]);
    let folder = RunFolder::open(dir, names)?;
    for (name, bytes) in &files {
        folder.write(name, bytes)?;
    }
    folder.write(PAGE, report.to_html().as_bytes())?;
    folder.sync()?;
    Ok(Written { page: folder.file(PAGE), damage })
}

/// What the report of a folder says, without writing anything.
pub fn build(dir: &Path) -> Result<Report, ReportError> {
    gather(dir).map(|(report, _)| report)
}

fn gather(dir: &Path) -> Result<(Report, Source), ReportError> {
    if !dir.is_dir() {
        return Err(ReportError::NoFolder { path: dir.to_owned() });
    }
    let mut source = Source::new(dir);
    let report = if source.has("verify.json") {
        verify::build(&mut source)
    } else if source.has("compare.json") || source.has("compare.csv") {
        compare::build(&mut source)
    } else if source.has("atlas.csv") {
        atlas::build(&mut source)
    } else if source.has("design.csv") {
        design::build(&mut source)
    } else if source.has("posterior.csv") || source.has("runs.csv") {
        calibration::build(&mut source)
    } else if source.has("prediction.csv") {
        prediction::build(&mut source)
    } else if source.has("response.csv") {
        response::build(&mut source)
    } else if source.has("sweep.csv") {
        sweep::build(&mut source)
    } else if ["summary.json", "history.csv", "frames"].iter().any(|name| source.has(name)) {
        run::build(&mut source)
    } else {
        return Err(ReportError::NoResults { path: dir.to_owned() });
    };
    Ok((report, source))
}
