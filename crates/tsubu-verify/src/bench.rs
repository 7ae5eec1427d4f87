//! Small scenes for verification cases, made in code where a scene file would hide the point.

use glam::DVec3;
use std::path::Path;
use tsubu::engine::{self, Engine};
use tsubu::ledger::{Account, Ledger};
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::{Claim, Frame, Kind, Source, Values};
use tsubu_scene::{Plan, Scene};

/// The plan of a scene text that is part of the program.
pub(super) fn plan(text: &str) -> Result<Plan, String> {
    let scene = Scene::parse("verification case", text, std::path::Path::new("."), &[]).map_err(|c| c.to_string())?;
    Ok(scene.plan().clone())
}

/// Multiplies the constants of the contact law: stiffness and restitution.
pub(super) fn spoil(plan: &mut Plan, factor: f64) {
    for material in plan.materials.values_mut() {
        material.young_modulus *= factor;
        material.restitution *= factor;
    }
    let pairs = plan.material_pair.iter_mut().filter_map(|pair| pair.contact.as_mut());
    for contact in pairs.chain([&mut plan.contact]) {
        if let tsubu_scene::plan::Normal::Hooke { stiffness } = &mut contact.normal {
            *stiffness *= factor;
        }
    }
}

/// The changes that multiply stiffness and restitution of every material of a scene text.
pub(super) fn spoiled_materials(text: &str, factor: f64) -> Result<Vec<String>, String> {
    if factor == 1.0 {
        return Ok(Vec::new());
    }
    let mut changes = Vec::new();
    for (name, material) in plan(text)?.materials {
        changes.push(format!("materials.{name}.young-modulus={:e}", material.young_modulus * factor));
        changes.push(format!("materials.{name}.restitution={}", material.restitution * factor));
    }
    Ok(changes)
}

/// Multiplies by the perturbation what [`spoil`] leaves alone as well: friction of every kind, surface energy, density of water.
fn spoil_all(plan: &mut Plan, factor: f64) {
    spoil(plan, factor);
    if let Some(water) = &mut plan.water {
        water.density *= factor;
    }
    for m in plan.materials.values_mut() {
        for value in [&mut m.friction, &mut m.rolling_friction, &mut m.twisting_friction, &mut m.surface_energy] {
            *value *= factor;
        }
    }
}

/// An engine on its way, with all that goes with it.
pub(super) struct Rig {
    /// What the scene says, spoiled.
    pub plan: Plan,
    /// The engine.
    pub engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
}

impl Rig {
    /// From a scene text.
    pub fn new(text: &str, perturbation: f64) -> Result<Self, String> {
        Self::of(plan(text)?, perturbation)
    }

    /// From a scene text that names files in a folder.
    pub fn in_folder(text: &str, folder: &Path, perturbation: f64) -> Result<Self, String> {
        let scene = Scene::parse("verification case", text, folder, &[]).map_err(|c| c.to_string())?;
        Self::of(scene.plan().clone(), perturbation)
    }

    /// From a plan.
    pub fn of(mut plan: Plan, perturbation: f64) -> Result<Self, String> {
        spoil_all(&mut plan, perturbation);
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open(&plan, &hosts).map_err(|e| e.to_string())?;
        let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
        Ok(Self { plan, engine, hosts, ledger })
    }

    /// Makes steps.
    pub fn steps(&mut self, count: u64) -> Result<(), String> {
        self.engine.advance(count, &mut self.hosts, &mut self.ledger).map_err(|e| e.to_string())
    }

    /// Goes on to a time [s], or the next step after it.
    pub fn until(&mut self, time: f64) -> Result<(), String> {
        let target = (time / self.engine.time_step()).ceil() as u64;
        self.steps(target.saturating_sub(self.engine.steps()))
    }

    /// Goes on until something touches and has parted again.
    pub fn impact(&mut self) -> Result<(), String> {
        let last = (self.plan.duration / self.engine.time_step()) as u64;
        while self.engine.contacts() == 0 && self.engine.steps() < last {
            self.steps(1)?;
        }
        while self.engine.contacts() > 0 && self.engine.steps() < last {
            self.steps(1)?;
        }
        Ok(())
    }

    /// What can be seen now.
    pub fn frame(&self) -> Frame {
        self.engine.frame(&self.hosts)
    }

    /// A vector of every grain, by its id.
    pub fn vectors(&self, name: &str) -> Vec<DVec3> {
        vectors(&self.frame(), Kind::Grain, name)
    }

    /// A vector of one grain.
    pub fn vector(&self, name: &str, grain: usize) -> DVec3 {
        self.vectors(name).get(grain).copied().unwrap_or(DVec3::NAN)
    }

    /// Speed of the grain along x, which a flat scene asks for most.
    pub fn speed(&self) -> f64 {
        self.vector("velocity", 0).x
    }

    /// Energy that the books cannot explain, over the energy turned over.
    pub fn residual(&self) -> f64 {
        self.ledger.residual_relative(&engine::energies(&*self.engine, &self.hosts))
    }

    /// The same in joules.
    pub fn unexplained(&self) -> f64 {
        self.ledger.residual(&engine::energies(&*self.engine, &self.hosts))
    }

    /// Energy posted to an account [J].
    pub fn flow(&self, account: Account) -> f64 {
        self.ledger.flow(account)
    }
}

/// A vector column of a frame; empty where there is none.
pub(super) fn vectors(frame: &Frame, kind: Kind, name: &str) -> Vec<DVec3> {
    match frame.column(kind, name).map(|c| &c.values) {
        Some(Values::Vector(v)) => v.iter().map(|p| DVec3::from_array(*p)).collect(),
        _ => Vec::new(),
    }
}

/// A scalar column of a frame; empty where there is none.
pub(super) fn scalars(frame: &Frame, kind: Kind, name: &str) -> Vec<f64> {
    match frame.column(kind, name).map(|c| &c.values) {
        Some(Values::Scalar(v)) => v.clone(),
        _ => Vec::new(),
    }
}

/// A claim that a value is the expected one within a share of it.
pub(super) fn near(name: impl Into<String>, value: f64, expected: f64, share: f64, source: Source) -> Claim {
    within(name, value, expected, share * expected.abs(), source)
}

/// A claim that a value is the expected one within a distance.
pub(super) fn within(name: impl Into<String>, value: f64, expected: f64, distance: f64, source: Source) -> Claim {
    Claim::judge(name, value, Some(expected - distance), Some(expected + distance), source)
}

/// A claim with two ends.
pub(super) fn between(name: impl Into<String>, value: f64, low: f64, high: f64, source: Source) -> Claim {
    Claim::judge(name, value, Some(low), Some(high), source)
}

/// A claim with a lower end.
pub(super) fn at_least(name: impl Into<String>, value: f64, low: f64, source: Source) -> Claim {
    Claim::judge(name, value, Some(low), None, source)
}
