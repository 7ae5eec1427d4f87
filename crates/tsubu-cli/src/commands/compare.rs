//! `tsubu compare`: one scene by several methods.

use super::{claims, report, run::warnings};
use crate::failure::Failure;
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::output;
use crate::progress::Progress;
use crate::{stop, table};
use clap::Args;
use std::path::Path;
use tsubu::run::Watcher;
use tsubu::study::compare::compare;
use tsubu_frame::{Status, Table};
use tsubu_scene::plan::Method;

#[derive(Args)]
#[command(after_help = "\
Example:
  tsubu compare damper.toml --methods dem,lattice       into out/damper-compare")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// The methods, with commas between
    #[arg(long, value_name = "METHOD,...", value_delimiter = ',', required = true)]
    methods: Vec<String>,
    #[command(flatten)]
    folder: FolderOptions,
    #[command(flatten)]
    work: WorkOptions,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let methods: Vec<Method> = options.methods.iter().map(|name| method(name)).collect::<Result<_, _>>()?;
    if let Some(twice) = methods.iter().enumerate().find_map(|(i, m)| methods[..i].contains(m).then_some(m)) {
        return Err(Failure::wrong(format!("method `{}` is named twice", twice.name())));
    }
    let scene = options.scene.read()?;
    let folder = options.folder.folder(&options.scene, "-compare");
    let pool = options.work.pool()?;
    let progress = Progress::new("compare", options.work.quiet);
    let watcher = Watcher { interrupted: stop::listen(), progress: &|done| progress.set(done) };
    let done = pool.install(|| compare(&scene, &methods, &folder, options.folder.existing(), &watcher));
    progress.end();
    let summaries = done.map_err(|error| Failure::of_compare(&error, &folder))?;
    if summaries.iter().any(|summary| summary.status == Status::Interrupted) {
        let message = format!("interrupted; what was computed so far is in {}", folder.display());
        return Err(
            Failure::interrupted(message).hint("a comparison does not resume: start it again with `--overwrite`")
        );
    }
    let page = pool.install(|| report::write(&folder))?;
    let mut text = told(&folder)?;
    for (method, summary) in methods.iter().zip(&summaries) {
        for claim in &summary.claims {
            text += &claims::line(&claim.clone().of(method.name()));
        }
        let warned: Vec<String> = summary.warnings.iter().map(|w| format!("{}: {w}", method.name())).collect();
        text += &warnings(&warned);
    }
    output::print(&text)?;
    output::tell(&format!("results in {}; open {}\n", folder.display(), page.display()));
    if summaries.iter().flat_map(|s| &s.claims).all(|claim| claim.pass) { Ok(()) } else { Err(Failure::claim()) }
}

fn method(name: &str) -> Result<Method, Failure> {
    let names = Method::ALL.map(Method::name).join(", ");
    Method::ALL
        .into_iter()
        .find(|m| m.name() == name)
        .ok_or_else(|| Failure::wrong(format!("method `{name}` is unknown")).hint(format!("methods: {names}")))
}

fn told(folder: &Path) -> Result<String, Failure> {
    let compared = Table::read(&folder.join("compare.csv")).map_err(|error| Failure::of_file(&error, folder))?;
    let mut rows =
        vec![compared.header.iter().map(|h| tsubu_frame::csv::split_unit(h).0.to_owned()).collect::<Vec<_>>()];
    rows.extend(
        compared
            .rows
            .iter()
            .map(|row| row.iter().map(|c| c.number().map_or_else(|| c.to_string(), table::number)).collect()),
    );
    Ok(table::aligned(&rows))
}
