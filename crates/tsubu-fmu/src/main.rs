//! The program that packs units: `tsubu-fmu SCENE -o FILE.fmu`.

use clap::Parser;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tsubu_fmu::description::Version;
use tsubu_fmu::error::Error;
use tsubu_fmu::pack::pack;
use tsubu_scene::{Scene, units};

/// Packs a scene with hosts as a Functional Mock-up Unit for co-simulation.
///
/// Each host with a `base` gets three inputs, the motion of that base, and what the scene says of it counts no more.
#[derive(Parser)]
#[command(name = "tsubu-fmu", version = tsubu::VERSION)]
struct Arguments {
    /// The scene
    scene: PathBuf,
    /// The unit to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Change a key of the scene
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// The communication step to be made for, "0.1 ms" or a number of seconds; without it that of the engine
    #[arg(long)]
    step: Option<String>,
    /// Version of the standard
    #[arg(long, value_enum, default_value_t)]
    fmi: Version,
    /// The library of this crate; without it the one beside this program
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
}

fn main() -> ExitCode {
    match work(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Complaints about a scene begin with the word themselves.
            let text = error.to_string();
            let text = if text.starts_with("error") { text } else { format!("error: {text}") };
            eprintln!("{text}");
            ExitCode::from(2)
        }
    }
}

fn work(arguments: &Arguments) -> Result<(), Error> {
    let step = arguments.step.as_deref().map(seconds).transpose()?;
    let scene = Scene::read(&arguments.scene, &arguments.set)?;
    let library = match &arguments.library {
        Some(library) => library.clone(),
        None => beside(),
    };
    pack(&scene, step, arguments.fmi, &library, &arguments.output)
}

/// A time as a number, or with its unit.
fn seconds(text: &str) -> Result<f64, Error> {
    if let Ok(number) = text.parse() {
        return Ok(number);
    }
    units::read(text, &units::TIME)
        .map_err(|_| Error::new(format!("`{text}` is no time")).hint("write 1e-4 or \"0.1 ms\""))
}

/// The library as cargo leaves it: beside this program, or one folder below where it built the program alone.
fn beside() -> PathBuf {
    let name = format!("{}tsubu_fmu{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let program = std::env::current_exe().unwrap_or_default();
    let folder = program.parent().unwrap_or(Path::new(""));
    let below = folder.join("deps").join(&name);
    if below.exists() { below } else { folder.join(name) }
}
