//! What `response`, `atlas`, `design` and `calibrate` share: a study of many runs, each written down when it is done, which goes on where it was.

use super::{claims, run::warnings};
use crate::failure::Failure;
use crate::launch::{LaunchOptions, Left, Logs, OfStudy};
use crate::options::{FolderOptions, SceneOptions, WorkOptions, command_to_resume};
use crate::session::{Session, judge, resume};
use clap::Args;
use std::path::Path;
use tsubu::interrupt::Watcher;
use tsubu::study::apart::StudyRuns;
use tsubu::study::cases::CasesError;
use tsubu_frame::{ResultValue, Status, Summary};
use tsubu_scene::Scene;

#[derive(Args)]
pub struct PointsOptions {
    #[command(flatten)]
    pub scene: SceneOptions,
    #[command(flatten)]
    pub folder: FolderOptions,
    /// Go on where it stopped; this happens anyway
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    pub work: WorkOptions,
    #[command(flatten)]
    pub launch: LaunchOptions,
}

/// A study as the library has it: scene, folder, whether to overwrite.
pub type Study = fn(&Scene, &Path, bool, &Watcher) -> Result<Summary, CasesError>;

/// The same where each run is done by itself.
pub type Runs = for<'a> fn(&'a Scene, &Path) -> Result<StudyRuns<'a>, CasesError>;

/// Does the study `name`, whose runs are called `points`, here or `apart`, and tells what `table` reads from its folder.
pub fn run(
    name: &'static str,
    points: &str,
    options: &PointsOptions,
    study: Study,
    runs: Runs,
    table: fn(&Path) -> Result<String, Failure>,
) -> Result<(), Failure> {
    let session = Session::begin(name, &format!("-{name}"), &options.scene, &options.folder, &options.work)?;
    if options.resume {
        session.needs_folder()?;
    }
    if !options.launch.is_here()? {
        return apart(name, options, &session, runs, table);
    }
    let Session { scene, folder, .. } = &session;
    let overwrite = options.folder.overwrite;
    let work = |watcher: &Watcher| study(scene, folder, overwrite, watcher);
    let (done, _) = session.work(&format!("interrupted; {}", resume()), work);
    let summary = done.map_err(|error| Failure::of_cases(&error, scene, folder))?;
    if summary.status == Status::Interrupted {
        let message = format!("interrupted; the finished {points} are in {}", folder.display());
        let hint = if folder.is_dir() { resume() } else { "nothing was done yet: start it again".to_owned() };
        return Err(Failure::interrupted(message).hint(hint));
    }
    let again = format!("runs that are done are kept; `{}` tries those again that failed", command_to_resume());
    tell(&session, &summary, table, again)
}

/// The same where runs are done apart, or what is there of them is gathered.
fn apart(
    name: &'static str,
    options: &PointsOptions,
    session: &Session,
    runs: Runs,
    table: fn(&Path) -> Result<String, Failure>,
) -> Result<(), Failure> {
    let Session { scene, folder, .. } = session;
    let broken = |error| Failure::of_cases(&error, scene, folder);
    let mut study = runs(scene, folder).map_err(broken)?;
    let of_study = &mut OfStudy { study: &mut *study, session };
    let Left::Gather = options.launch.go(name, of_study, options.folder.overwrite, &options.work)? else {
        return Ok(());
    };
    let logs = Logs::read(folder);
    let summary = study.gather(&|run| logs.why(run)).map_err(broken)?;
    tell(session, &summary, table, "the same command as before does what is missing, and nothing else".to_owned())
}

/// Tells what came of it, and makes its page; `again` is what to do where some runs have no result.
fn tell(
    session: &Session,
    summary: &Summary,
    table: fn(&Path) -> Result<String, Failure>,
    again: String,
) -> Result<(), Failure> {
    let folder = &session.folder;
    let page = session.page()?;
    let claims: String = summary.claims.iter().map(claims::line).collect();
    session.show(&(table(folder)? + &claims + &warnings(&summary.warnings)), Some(&page))?;
    if summary.status == Status::Failed {
        // A design all of whose runs were done may have nothing within its limits.
        if summary.results.get("candidates failed") == Some(&ResultValue::Number(0.0)) {
            let message = "no candidate keeps within the limits; the last warning above says by how much";
            return Err(Failure::failed(message).hint("loosen that limit, or let `design.vary` reach farther"));
        }
        return Err(Failure::failed("some of the runs failed; the warnings above name them").hint(again));
    }
    judge(&summary.claims)
}
