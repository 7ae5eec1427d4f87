//! `tsubu compare`: one scene by several methods.

use super::claims;
use super::run::{plural, warnings};
use crate::failure::Failure;
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::session::{Session, judge, resume};
use crate::table;
use clap::Args;
use std::path::Path;
use tsubu::interrupt::Watcher;
use tsubu::study::compare::compare;
use tsubu::study::variant::Variant;
use tsubu::threads::alone;
use tsubu_frame::{Cell, Status, Table};

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu compare damper.toml --methods dem,lattice       into out/damper-compare
  tsubu compare collapse.toml --methods all             by every method that can; the others say why not
  tsubu compare collapse.toml --methods dem,locked=dem:contact.rotation=false,cl-ca
                                                        DEM with and without rotation beside CL-CA

METHOD:KEY=VALUE changes the scene for one column, as --set does for all of them; several changes have colons between.
NAME= before it names the column and its folder.

An interrupted comparison goes on where it was when the same command is typed again.")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// The methods, with commas between: METHOD or NAME=METHOD:KEY=VALUE; `all` is every method that can
    #[arg(long, value_name = "METHOD,...", required = true)]
    methods: Vec<String>,
    #[command(flatten)]
    folder: FolderOptions,
    /// Go on where an interrupted comparison stopped; this happens anyway
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    work: WorkOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let variants = Variant::list(&options.methods.join(",")).map_err(|error| Failure::of_words(&error))?;
    let session = Session::begin("compare", "-compare", &options.scene, &options.folder, &options.work)?;
    if options.resume {
        session.needs_folder()?;
    }
    let Session { scene, folder, .. } = &session;
    let overwrite = options.folder.overwrite;
    let work = |watcher: &Watcher| alone(|| compare(scene, &variants, folder, overwrite, watcher));
    let (done, _) = session.work(&format!("interrupted; {}", resume()), work);
    let compared = done.map_err(|error| Failure::of_compare(&error, scene, folder))?;
    if compared.done.iter().any(|(_, summary)| summary.status == Status::Interrupted) {
        let message = format!("interrupted; what was computed so far is in {}", folder.display());
        return Err(Failure::interrupted(message).hint(resume()));
    }
    let page = session.page()?;
    let mut text = told(folder)?;
    text += &compared.refused.iter().map(ToString::to_string).collect::<String>();
    for (variant, summary) in &compared.done {
        for claim in &summary.claims {
            text += &claims::line(&claim.clone().of(&variant.name));
        }
        let warned: Vec<String> = summary.warnings.iter().map(|w| format!("{}: {w}", variant.name)).collect();
        text += &warnings(&warned);
    }
    session.show(&text, Some(&page))?;
    judge(compared.done.iter().flat_map(|(_, summary)| &summary.claims))
}

fn told(folder: &Path) -> Result<String, Failure> {
    let compared = Table::read(&folder.join("compare.csv")).map_err(|error| Failure::of_file(&error, folder))?;
    let mut rows =
        vec![compared.header.iter().map(|h| tsubu_frame::csv::split_unit(h).0.to_owned()).collect::<Vec<_>>()];
    // Of what nobody has there are only zeros.
    let says = |row: &&Vec<Cell>| row.iter().filter_map(Cell::number).any(|x| x != 0.0 && !x.is_nan());
    rows.extend(
        compared
            .rows
            .iter()
            .filter(says)
            .map(|row| row.iter().map(|c| c.number().map_or_else(|| c.to_string(), table::number)).collect()),
    );
    let silent = compared.rows.len() + 1 - rows.len();
    let table = table::aligned(&rows);
    Ok(if silent > 0 {
        format!("{table}  and {} of zeros in compare.csv\n", plural(silent as u64, "row"))
    } else {
        table
    })
}
