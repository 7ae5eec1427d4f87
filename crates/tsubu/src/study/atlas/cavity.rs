//! A cavity alone on a shaker: the mass that its grains show.
//!
//! Walls move as x = X sin(w t), X = a / w^2. The part of the grains' force at that frequency, over the acceleration, is a complex mass
//! m - i m': m in phase with the acceleration, m' with the velocity. A rigid ballast has its mass and m' = 0; the work that m' takes in
//! a period is pi m' (w X)^2. In terms of Masmoudi et al. 2016, m' over the mass of all grains is the loss factor.

use crate::engine;
use crate::interrupt::Interrupt;
use crate::ledger::{Account, Ledger};
use crate::methods;
use crate::partner::{Host, Hosts};
use crate::run::RunError;
use crate::study::response::tasks::seeded;
use crate::study::response::transient::{Block, until_steady};
use crate::trial::unsettled;
use nalgebra::Complex;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::time::Instant;
use tsubu_frame::State;
use tsubu_scene::plan::{Atlas, Keep, Plan, Scale, Signal, Structure};

/// Periods of a block: one that doubles its period twice is the same in each.
const BLOCK: u32 = 4;
/// Blocks that are measured at least, to know how they scatter.
const LEAST: usize = 5;
/// More are measured until the standard error is so small a share of what points may lie off lines.
const SURE: f64 = 0.25;

/// What a cavity shows at one frequency and acceleration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Mass in phase with the acceleration [kg].
    pub mass: f64,
    /// Mass in phase with the velocity [kg].
    pub lossy_mass: f64,
    /// Standard error of both together, from blocks of four periods [kg]; not known with one block.
    pub error: Option<f64>,
    /// Force at two and three times the frequency (root of both squares) over the acceleration [kg].
    pub harmonics: f64,
    /// Periods measured.
    pub measured: u32,
    /// The lossy mass that what grains have lost amounts to: the same where the motion is steady [kg].
    pub lost_mass: f64,
    /// Energy residual over what a lossy mass as large as all grains' would have taken.
    pub residual: f64,
    /// Periods before the measured ones.
    pub discarded: u32,
    /// Computing time [s].
    pub wall: f64,
}

impl Point {
    /// m - i m' [kg].
    pub fn complex(&self) -> Complex<f64> {
        Complex::new(self.mass, -self.lossy_mass)
    }
}

/// The plan of a cavity: its host gives way to a shaker that is at rest at time 0, for the bed, and gets as fast as the atlas will be.
pub(super) fn shaken(plan: &Plan, atlas: &Atlas) -> Plan {
    let mut plan = plan.clone();
    let ([slow, _], [_, strong]) = (atlas.frequency, atlas.acceleration);
    if let Some(host) = plan.hosts.get_mut(&atlas.host) {
        host.structure = Structure::Shaker {};
        let amplitude = strong / (TAU * slow).powi(2);
        let (from, to, duration) = (0.0, slow, 1.0 / slow);
        let (scale, keep) = (Scale::Linear, Keep::Displacement);
        host.base = Some(Signal::SineSweep { amplitude, from, to, duration, scale, keep });
        (host.force, host.at, host.displacement, host.velocity) = (None, None, 0.0, 0.0);
        host.interface.clear();
    }
    for wall in plan.walls.values_mut().filter(|wall| wall.host.as_ref() == Some(&atlas.host)) {
        wall.interface = None;
    }
    plan
}

/// A sine by its frequency [Hz] and the amplitude of its acceleration [m/s^2], through its middle at time 0.
fn sine(frequency: f64, acceleration: f64) -> Signal {
    let w = TAU * frequency;
    Signal::Sine { amplitude: acceleration / (w * w), frequency, phase: 0.0 }
}

/// Shakes a cavity, from its settled bed, until the motion is steady, and measures; `None` where it was interrupted.
pub(super) fn measure(
    plan: &Plan,
    atlas: &Atlas,
    seed: u32,
    bed: &State,
    [frequency, acceleration]: [f64; 2],
    interrupt: &Interrupt,
) -> Result<Option<Point>, RunError> {
    let begun = Instant::now();
    let plan = unsettled(&seeded(plan, seed));
    let mut hosts = Hosts::new(&plan.hosts);
    let host = hosts.index(&atlas.host).unwrap_or_default();
    let mut engine = methods::open(&plan, &hosts)?;
    engine.load(&mut bed.clone()).map_err(|error| engine::OpenError::Bed(error.to_string()))?;
    hosts.list[host].shake(sine(frequency, acceleration));
    let velocity = glam::DVec3::from_array(hosts.list[host].direction) * hosts.list[host].velocity();
    // At rest where they cannot be set in motion: it takes a little longer until all is steady.
    engine.set_in_motion(velocity.into());
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let steady = until_steady::<ComplexMass>(frequency, &mut *engine, &mut hosts, host, &mut ledger, interrupt)?;
    let Some(discarded) = steady else { return Ok(None) };
    let before = lost(&ledger);
    let first = engine.steps();
    let most = atlas.measure_periods.div_ceil(BLOCK) as usize;
    let enough = SURE * atlas.within * plan.grain_mass();
    let (mut found, mut harmonics) = (Vec::new(), 0.0);
    while found.len() < most.min(LEAST) || found.len() < most && standard_error(&found) > enough {
        let block = found.len() as u32 + 1;
        let end = first + (f64::from(BLOCK * block) / (frequency * engine.time_step())).round() as u64;
        let mut measured = ComplexMass::begin(frequency);
        while engine.steps() < end {
            if interrupt.asked() {
                return Ok(None);
            }
            engine.advance(1, &mut hosts, &mut ledger)?;
            measured.look(&hosts.list[host], engine.time());
        }
        found.push(measured.value());
        harmonics += measured.harmonics();
    }
    let n = found.len() as f64;
    let mean = found.iter().sum::<Complex<f64>>() / n;
    let speed = acceleration / (TAU * frequency);
    let measured = BLOCK * found.len() as u32;
    let of_a_mass = f64::from(measured) * PI * speed * speed;
    let whole = f64::from(discarded + measured) * PI * speed * speed;
    Ok(Some(Point {
        mass: mean.re,
        lossy_mass: -mean.im,
        error: (n > 1.0).then(|| standard_error(&found)),
        harmonics: harmonics / n,
        measured,
        lost_mass: (lost(&ledger) - before) / of_a_mass,
        residual: ledger.residual(&engine::energies(&*engine, &hosts)) / (whole * plan.grain_mass()),
        discarded,
        wall: begun.elapsed().as_secs_f64(),
    }))
}

/// Standard error of the mean of blocks [kg].
fn standard_error(blocks: &[Complex<f64>]) -> f64 {
    let n = blocks.len() as f64;
    let mean = blocks.iter().sum::<Complex<f64>>() / n;
    (blocks.iter().map(|one| (one - mean).norm_sqr()).sum::<f64>() / (n * (n - 1.0))).sqrt()
}

/// What has been lost since the ledger was opened [J].
fn lost(ledger: &Ledger) -> f64 {
    Account::ALL.iter().filter(|account| !account.is_work()).map(|account| ledger.flow(*account)).sum()
}

impl ComplexMass {
    /// The force at two and three times the frequency over the acceleration [kg].
    fn harmonics(&self) -> f64 {
        self.second.norm().hypot(self.third.norm()) / (self.displacement.norm() * self.w * self.w)
    }
}

/// The complex mass over a whole number of periods: force over acceleration, both at the frequency of the shaker.
struct ComplexMass {
    w: f64,
    force: Complex<f64>,
    second: Complex<f64>,
    third: Complex<f64>,
    displacement: Complex<f64>,
}

impl Block for ComplexMass {
    /// Forces of contacts are short.
    const UNSEEN: u64 = 1;

    fn begin(frequency: f64) -> Self {
        let none = Complex::default();
        Self { w: TAU * frequency, force: none, second: none, third: none, displacement: none }
    }

    fn look(&mut self, host: &Host, time: f64) {
        let turn = Complex::from_polar(1.0, -self.w * time);
        self.force += turn * host.grain_force();
        self.second += turn.powu(2) * host.grain_force();
        self.third += turn.powu(3) * host.grain_force();
        self.displacement += turn * host.displacement();
    }

    fn value(&self) -> Complex<f64> {
        self.force / (self.displacement * self.w * self.w)
    }
}
