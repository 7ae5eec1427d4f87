//! DEM by its outcome.

mod books;
mod come_and_go;
mod everything;
mod gates;
mod idle;
mod orientation;
mod pairs;
mod place;
mod plane;
mod rest;
mod same_bits;
mod seams;

use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_scene::{Scene, TEMPLATES};

/// A template scene with some keys changed, at time 0.
pub fn open(template: &str, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    let text = TEMPLATES.iter().find(|t| t.name == template).unwrap().text;
    open_text(text, changes)
}

/// A scene text with some keys changed, at time 0.
pub fn open_text(text: &str, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    run_text(text, std::path::Path::new("."), changes)
}

/// The same for a scene that names files in a folder.
pub fn run_text(text: &str, folder: &std::path::Path, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let scene = Scene::parse("test", text, folder, &changes).unwrap_or_else(|c| panic!("{c}"));
    let hosts = Hosts::new(&scene.plan().hosts);
    let engine = engine::open(scene.plan(), &hosts).unwrap();
    let ledger = Ledger::open(engine::stocks(&*engine, &hosts), engine.momentum());
    (engine, hosts, ledger)
}
