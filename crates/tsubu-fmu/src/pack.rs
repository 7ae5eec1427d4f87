//! A scene becomes a unit: an archive with its description, the scene with the files that it names, and this library.

use crate::description::{About, IDENTIFIER, Version, describe};
use crate::error::Error;
use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;
use tsubu::run::{Simulation, scene_hash};
use tsubu_scene::Scene;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The scene among the resources of a unit.
pub const SCENE: &str = "scene.toml";

/// A scene that is ready to be a unit.
#[derive(Debug)]
pub struct Prepared {
    /// With a time step of its own.
    pub scene: Scene,
    /// That step [s].
    pub time_step: f64,
    /// The communication step that it is made for [s].
    pub step: f64,
}

/// What binds a description to its scene: the hash of the scene as text.
pub fn token(scene: &str) -> String {
    scene_hash(scene)
}

/// Opens a scene to see that it can be, and gives it a time step that divides the communication step [s]; without one each step of the
/// engine is one.
///
/// # Errors
///
/// A scene that cannot be a unit: one of several stages, one that goes on from another run, one without a host whose base could be
/// moved, one that does not open.
pub fn prepare(scene: &Scene, step: Option<f64>) -> Result<Prepared, Error> {
    let plan = scene.plan();
    if scene.plans().len() > 1 {
        return Err(Error::new("a scene of several stages cannot be a unit: the tool says how long it runs")
            .hint("leave out `stage`; a bed that settles is `start.settled`"));
    }
    if plan.start_from.is_some() {
        return Err(Error::new("a scene that goes on from another run cannot be a unit, which is whole")
            .hint("leave out `start-from`; a bed that settles is `start.settled`"));
    }
    if plan.hosts.values().all(|host| host.base.is_none()) {
        return Err(Error::new("no host of this scene has a `base` that a tool could move").hint(
            "add one, and hang walls on it with `host = \"casing\"`: \
             hosts.casing = { structure.shaker = {}, base.sine = { amplitude = \"1 mm\", frequency = \"30 Hz\" } }",
        ));
    }
    let opened = Simulation::open(scene).map_err(|error| Error::of_run(&error, scene))?;
    let (own, key) = (opened.engine.time_step(), opened.engine.step_key().to_owned());
    if !key.ends_with("time-step") {
        return Err(Error::new(format!(
            "the step of method `{}` follows from `{key}`, and cannot be made to fit a communication step",
            plan.method.name()
        ))
        .hint("take `dem` or `lattice`"));
    }
    let step = step.unwrap_or(own);
    if !(step.is_finite() && step > 0.0) {
        return Err(Error::new(format!("a communication step of {step} s")));
    }
    // A quotient that rounding has put just above a whole number is that number.
    let time_step = step / (step / own - 1e-9).ceil().max(1.0);
    let scene = scene.changed(&[format!("{key}={time_step:?}")])?;
    Ok(Prepared { scene, time_step, step })
}

/// The unit as an archive; `library` is this library, as it was built.
///
/// # Errors
///
/// Those of [`prepare`], and an archive that cannot be written.
pub fn archive(scene: &Scene, step: Option<f64>, version: Version, library: &[u8]) -> Result<Vec<u8>, Error> {
    let Prepared { scene, time_step, step } = prepare(scene, step)?;
    let text = scene.resolved_toml();
    let plan = scene.plan();
    let about = About { version, plan, token: &token(&text), time_step, step };
    let binary = format!("binaries/{}/{IDENTIFIER}{}", version.platform(), std::env::consts::DLL_SUFFIX);
    let mut files = vec![
        ("modelDescription.xml".to_owned(), describe(&about).into_bytes()),
        (binary, library.to_vec()),
        (format!("resources/{SCENE}"), text.into_bytes()),
    ];
    let companions = scene.companions().into_iter();
    files.extend(companions.map(|(name, bytes)| (format!("resources/{name}"), bytes)));
    zipped(&files).map_err(|error| Error::new(format!("the archive cannot be made: {error}")))
}

fn zipped(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, zip::result::ZipError> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    // Without the time of day: the same scene makes the same bytes.
    let plain = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    let plain = plain.last_modified_time(zip::DateTime::default());
    for (name, bytes) in files {
        let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
        writer.start_file(name.as_str(), plain.unix_permissions(mode))?;
        writer.write_all(bytes)?;
    }
    Ok(writer.finish()?.into_inner())
}

/// Packs a scene into a file: written beside it and renamed, so that it is never half there.
///
/// # Errors
///
/// Those of [`archive`], a library that is not there, and a file that cannot be written.
pub fn pack(scene: &Scene, step: Option<f64>, version: Version, library: &Path, file: &Path) -> Result<(), Error> {
    let code = fs::read(library).map_err(|error| {
        Error::new(format!("cannot read the library {}: {error}", library.display()))
            .hint("build it with `cargo build -p tsubu-fmu`, or name it with `--library`")
    })?;
    let bytes = archive(scene, step, version, &code)?;
    let beside = file.with_extension("fmu.part");
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, file));
    written.map_err(|error| Error::new(format!("cannot write {}: {error}", file.display())))
}
