//! Partners: what grains meet once a step and push back on. Here: vibrating structures.

pub mod host;

pub use host::{Ballast, Host, Interface, Placed};

use crate::ledger::Ledger;
use std::collections::BTreeMap;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan;

/// All hosts of a scene, in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct Hosts {
    /// The hosts.
    pub list: Vec<Host>,
    names: Vec<String>,
}

impl Hosts {
    /// Builds the hosts of a plan at time 0.
    pub fn new(plan: &BTreeMap<String, plan::Host>) -> Self {
        Self { list: plan.values().map(Host::new).collect(), names: plan.keys().cloned().collect() }
    }

    /// Another stage of a run begins at `time` [s], with other drives.
    pub fn change(&mut self, plan: &BTreeMap<String, plan::Host>, time: f64) {
        for (host, plan) in self.list.iter_mut().zip(plan.values()) {
            host.change(plan, time);
        }
    }

    /// At time 0 of another clock: all drives begin now.
    pub fn begin_anew(&mut self) {
        for host in &mut self.list {
            host.begin_anew();
        }
    }

    /// Names, in the order of `list`.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Place of a host in `list`.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|n| n == name)
    }

    /// Kinetic energy and spring energy of all hosts [J].
    pub fn energy(&self, time: f64) -> (f64, f64) {
        self.list.iter().map(|h| h.energy(time)).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// First half of a step: every host moves to `time`, the end of the step.
    pub fn before(&mut self, time: f64, dt: f64) {
        for host in &mut self.list {
            host.before(time, dt);
        }
    }

    /// Second half: what the grains do to every host has been heard for `time` (the end of the step).
    pub fn after(&mut self, time: f64, dt: f64, ledger: &mut Ledger) {
        for host in &mut self.list {
            host.after(time, dt, ledger);
        }
    }

    /// Writes all hosts into a checkpoint.
    pub fn save(&self, state: &mut State) {
        for (host, name) in self.list.iter().zip(&self.names) {
            host.save(&format!("host.{name}"), state);
        }
    }

    /// Takes all hosts back from a checkpoint.
    pub fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        for (host, name) in self.list.iter_mut().zip(&self.names) {
            host.load(&format!("host.{name}"), state)?;
        }
        Ok(())
    }
}
