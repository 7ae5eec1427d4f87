//! `tsubu predict`: the response of a structure from an atlas of its cavity.

use super::run::warnings;
use crate::failure::Failure;
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::session::{Session, resume};
use crate::table;
use clap::{Args, value_parser};
use std::path::{Path, PathBuf};
use tsubu::check::human_time;
use tsubu::interrupt::Watcher;
use tsubu::study::atlas::{self, Cavity};
use tsubu_frame::{ResultValue, Status, Summary, Table};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu atlas damper.toml                                       the cavity alone, into out/damper-atlas
  tsubu predict structure.toml out/damper-atlas                 into out/structure-prediction
  tsubu predict structure.toml out/damper-atlas --spot-checks 3 the peak and its flanks are simulated in full, too

The scene's `[response]` says for which frequencies and cases.
An interrupted prediction goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Folders of atlases, one of which has the scene's cavity
    #[arg(required = true, value_name = "ATLAS")]
    atlas: Vec<PathBuf>,
    /// Frequencies of each case that are simulated in full beside: 0, 1 (the peak), 2 or 3 (with its flanks)
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u8).range(0..=3))]
    spot_checks: u8,
    #[command(flatten)]
    folder: FolderOptions,
    /// Go on where it stopped; this happens anyway
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    work: WorkOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let session = Session::begin("predict", "-prediction", &options.scene, &options.folder, &options.work)?;
    if options.resume {
        session.needs_folder()?;
    }
    let read = |folder: &PathBuf| atlas::read(folder).map_err(|error| Failure::wrong(error.to_string()));
    let cavities: Vec<Cavity> =
        options.atlas.iter().map(read).collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    let Session { scene, folder, .. } = &session;
    let (overwrite, number) = (options.folder.overwrite, usize::from(options.spot_checks));
    let work = |watcher: &Watcher| tsubu::study::predict::predict(scene, &cavities, number, folder, overwrite, watcher);
    let (done, _) = session.work(&format!("interrupted; {}", resume()), work);
    let summary = done.map_err(|error| Failure::of_cases(&error, scene, folder))?;
    if summary.status == Status::Interrupted {
        let message = format!("interrupted; the prediction with the checks that are done is in {}", folder.display());
        return Err(Failure::interrupted(message).hint(resume()));
    }
    let page = session.page()?;
    session.show(&(cases(folder, &summary)? + &warnings(&summary.warnings)), Some(&page))?;
    if summary.status == Status::Failed {
        return Err(Failure::failed("some of the spot checks failed; the warnings above name them"));
    }
    Ok(())
}

/// A line for each case: what is predicted, and what a simulation of the peak says.
fn cases(folder: &Path, summary: &Summary) -> Result<String, Failure> {
    let file = folder.join("cases.csv");
    let cases = Table::read(&file).map_err(|error| Failure::of_file(&error, folder))?;
    let column = |name: &str| cases.numbers(name).unwrap_or_else(|| vec![f64::NAN; cases.rows.len()]);
    let [ratio, rms, low, high, simulated, error] = [
        "peak frequency ratio",
        "peak rms",
        "peak spread low",
        "peak spread high",
        "simulated rms",
        "error of the peak",
    ]
    .map(column);
    let header = ["case", "peak ratio", "peak rms mm", "within mm", "simulated mm", "error %"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for (row, name) in cases.texts("case").unwrap_or_default().into_iter().enumerate() {
        let within = format!("{} to {}", table::number(1e3 * low[row]), table::number(1e3 * high[row]));
        let numbers = [1e3 * simulated[row], 100.0 * error[row]].map(table::number);
        let first = [name, table::number(ratio[row]), table::number(1e3 * rms[row]), within];
        rows.push(first.into_iter().chain(numbers).collect());
    }
    let told = match summary.results.get("seconds of the prediction alone") {
        Some(ResultValue::Number(seconds)) => format!("  predicted in {}\n", human_time(*seconds)),
        _ => String::new(),
    };
    Ok(table::aligned(&rows) + &told)
}
