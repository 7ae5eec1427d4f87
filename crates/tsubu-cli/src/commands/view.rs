//! `tsubu view`: runs in the browser.

use super::run::run_shown;
use crate::failure::Failure;
use crate::looked_at::PageOptions;
use crate::options::{FolderOptions, SceneOptions, WorkOptions};
use crate::session::Session;
use clap::Args;
use std::path::{Path, PathBuf};
use tsubu_frame::Existing;
use tsubu_view::Server;

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu view out/hopper                       prints an address, and opens it
  tsubu view out/few out/many                 two runs side by side, with one camera
  tsubu view hopper.toml                      runs the scene, as `tsubu run --view` does
  tsubu view out/hopper --port 8000 --no-open

The page is for this machine alone, and for who knows the address. Ctrl-C ends it.")]
pub struct Options {
    /// Folders of runs, several are shown side by side; or one scene, which is run
    #[arg(value_name = "DIR|SCENE", required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    page: PageOptions,
    #[command(flatten, next_help_heading = "For a scene")]
    scene: ForScene,
}

/// What a scene is run with.
#[derive(Args)]
struct ForScene {
    /// Change a value of the scene; may be repeated
    #[arg(long, value_name = "KEY.PATH=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    folder: FolderOptions,
    /// Go on from the checkpoint in the folder
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    #[command(flatten)]
    work: WorkOptions,
}

impl ForScene {
    /// An option that folders have no use for.
    fn told(&self) -> Option<&'static str> {
        let Self { set, folder, resume, work } = self;
        let told = [
            (!set.is_empty(), "--set"),
            (folder.is_told(), "--output"),
            (folder.overwrite, "--overwrite"),
            (*resume, "--resume"),
            (work.told_by().is_some(), work.told_by().unwrap_or_default()),
            (work.quiet, "--quiet"),
        ];
        told.into_iter().find_map(|(told, name)| told.then_some(name))
    }
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let Options { paths, page, scene } = options;
    if let Some(file) = paths.iter().find(|path| path.is_file()) {
        return if paths.len() == 1 { run_scene(file, scene, *page) } else { Err(one_scene(file)) };
    }
    if let Some(name) = scene.told() {
        return Err(Failure::wrong(format!("`{name}` is for a scene that is run; {} is none", paths[0].display())));
    }
    let server = Server::bind(paths, page.port).map_err(|error| Failure::of_words(&error))?;
    page.open(&server.address())?;
    // There is nothing to save: Ctrl-C ends the program.
    server.serve(&|| false).map_err(|error| Failure::of_words(&error))
}

fn run_scene(file: &Path, options: &ForScene, page: PageOptions) -> Result<(), Failure> {
    let ForScene { set, folder, resume, work } = options;
    let scene = SceneOptions { scene: file.to_owned(), set: set.clone() };
    let existing = if *resume { Existing::Resume } else { folder.existing() };
    let session = Session::begin("run", "", &scene, folder, work)?;
    run_shown(&session, existing, page)
}

fn one_scene(file: &Path) -> Failure {
    let text = format!("{} is a file: one scene can be run and shown, or folders of runs", file.display());
    Failure::wrong(text).hint("run the scenes, then view their folders together")
}
