//! One run of a response: a bed, a frequency, a measurement.

use super::point::Point;
use super::transient;
use crate::engine::{self, Engine, OpenError};
use crate::interrupt::Interrupt;
use crate::ledger::{Account, Ledger};
use crate::methods;
use crate::partner::{Host, Hosts};
use crate::run::RunError;
use crate::trial::unsettled;
use crate::watch::Watches;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::Instant;
use tsubu_frame::{FrameWriter, RunFolder, State};
use tsubu_scene::plan::{Plan, Response, Signal};

/// First natural frequency of the host [Hz]; an error text if the host cannot be swept.
pub(in crate::study) fn reference_frequency(plan: &Plan, host: &str) -> Result<f64, String> {
    let hosts = Hosts::new(&plan.hosts);
    let index = hosts.index(host).ok_or_else(|| format!("`response.host`: there is no host `{host}`"))?;
    let shaken = &plan.hosts[host];
    let sine = |s: &Option<Signal>| matches!(s, Some(Signal::Sine { .. }));
    if !sine(&shaken.base) && !sine(&shaken.force) {
        return Err(format!(
            "`hosts.{host}` is not shaken by a sine: a response needs `base.sine` or `force.sine`, whose frequency it varies"
        ));
    }
    hosts.list[index]
        .natural_frequencies()
        .first()
        .copied()
        .ok_or_else(|| format!("`hosts.{host}` has no natural frequency"))
}

/// How long a run of this plan takes, compared with others.
pub(super) fn weight(plan: &Plan) -> usize {
    plan.particles.values().map(|p| p.count).sum()
}

pub(in crate::study) fn seeded(plan: &Plan, seed: u32) -> Plan {
    let mut plan = plan.clone();
    plan.seed += u64::from(seed);
    plan
}

/// Periods thrown away before measuring; `None`: until the motion is steady.
fn discard(plan: &Plan, wanted: &Response) -> Option<u32> {
    if weight(plan) == 0 { wanted.discard_periods_empty } else { wanted.discard_periods }
}

/// The state at time 0 of a case and seed, settled.
pub fn bed(plan: &Plan, seed: u32) -> Result<State<'static>, OpenError> {
    let plan = seeded(plan, seed);
    let hosts = Hosts::new(&plan.hosts);
    let mut state = State::default();
    let engine = methods::open(&plan, &hosts)?;
    engine.save(&mut state);
    Ok(state.into_owned())
}

/// Steps between two questions whether to stop.
const UNASKED: u64 = 8;

/// Runs one frequency [Hz] from a settled bed and measures; `None` where it was interrupted. `known` are points of the same case, which
/// tell how a run begins that is to be steady soon.
pub fn measure(
    plan: &Plan,
    wanted: &Response,
    seed: u32,
    bed: &State,
    frequency: f64,
    known: &[&Point],
    interrupt: &Interrupt,
) -> Result<Option<Point>, RunError> {
    let mut world = open(plan, wanted, seed, bed, frequency, known)?;
    world.measure(plan, wanted, seed, frequency, interrupt)
}

/// Runs frequencies [Hz] one after the other from a settled bed, each in the state that the one before has left. `done` hears of each
/// point as it comes.
pub(super) fn walk(
    plan: &Plan,
    wanted: &Response,
    seed: u32,
    bed: &State,
    frequencies: &[f64],
    interrupt: &Interrupt,
    done: &mut dyn FnMut(usize, Point),
) -> Result<(), RunError> {
    let Some(first) = frequencies.first() else { return Ok(()) };
    let mut world = open(plan, wanted, seed, bed, *first, &[])?;
    for (index, frequency) in frequencies.iter().enumerate() {
        let time = world.engine.time();
        world.hosts.list[world.host].go_over_to(*frequency, wanted.keep, time);
        match world.measure(plan, wanted, seed, *frequency, interrupt)? {
            Some(point) => done(index, point),
            None => return Ok(()),
        }
    }
    Ok(())
}

/// Grains, hosts and their books, with the host that is measured.
struct World {
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
    host: usize,
}

impl World {
    /// Waits until the motion at this frequency [Hz] is steady, and measures.
    fn measure(
        &mut self,
        plan: &Plan,
        wanted: &Response,
        seed: u32,
        frequency: f64,
        interrupt: &Interrupt,
    ) -> Result<Option<Point>, RunError> {
        let begun = Instant::now();
        let Self { engine, hosts, ledger, host } = self;
        let (host, dt) = (*host, engine.time_step());
        let steps = |periods: u32| (f64::from(periods) / (frequency * dt)).round() as u64;
        let discarded = match discard(plan, wanted) {
            Some(periods) => {
                let discard = engine.steps() + steps(periods);
                while engine.steps() < discard {
                    if interrupt.asked() {
                        return Ok(None);
                    }
                    engine.advance(UNASKED.min(discard - engine.steps()), hosts, ledger)?;
                }
                periods
            }
            None => match transient::die_away(frequency, &mut **engine, hosts, host, ledger, interrupt)? {
                Some(periods) => periods,
                None => return Ok(None),
            },
        };
        let before = Account::ALL.map(|a| ledger.flow(a));
        let mut window = Window::default();
        let mut watches = Watches::new(&seeded(plan, seed), &**engine);
        watches.begin(engine.steps());
        let count = steps(wanted.measure_periods);
        for step in 0..count {
            if interrupt.asked() {
                return Ok(None);
            }
            engine.advance(1, hosts, ledger)?;
            let phase = TAU * frequency * engine.time();
            window.take(&hosts.list[host], engine.time(), phase, 2 * step >= count);
            watches.look(&**engine, hosts)?;
        }
        let periods = f64::from(wanted.measure_periods);
        let flows: Vec<f64> = Account::ALL.iter().zip(before).map(|(&a, b)| (ledger.flow(a) - b) / periods).collect();
        let loss = Account::ALL.iter().zip(&flows).filter(|(a, _)| !a.is_work()).map(|(_, f)| f).sum();
        let residual = ledger.residual_relative(&engine::energies(&**engine, hosts));
        let watched = watches.scalars().zip(watches.told()).filter(|(_, mean)| mean.is_finite()).collect();
        let wall = begun.elapsed().as_secs_f64();
        Ok(Some(Point { frequency, loss, flows, watched, residual, discarded, wall, ..window.point(frequency) }))
    }
}

/// Everything at time 0 with the bed in place and the host shaken at this frequency [Hz].
fn open(
    plan: &Plan,
    wanted: &Response,
    seed: u32,
    bed: &State,
    frequency: f64,
    known: &[&Point],
) -> Result<World, OpenError> {
    let plan = unsettled(&seeded(plan, seed));
    let mut hosts = Hosts::new(&plan.hosts);
    let host = hosts.index(&wanted.host).unwrap_or_default();
    hosts.list[host].set_frequency(frequency, wanted.keep);
    let mut engine = methods::open(&plan, &hosts)?;
    engine.load(&mut bed.clone()).map_err(|e| OpenError::Bed(e.to_string()))?;
    if discard(&plan, wanted).is_none() {
        transient::begin(&plan, known, frequency, &mut *engine, &mut hosts, host);
    }
    let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    Ok(World { engine, hosts, ledger, host })
}

/// Writes nine frames of one period at the frequency [Hz] of a peak, first and last of equal phase, after the transient has died away.
pub(super) fn film(
    plan: &Plan,
    wanted: &Response,
    bed: &State,
    frequency: f64,
    known: &[&Point],
    folder: &RunFolder,
) -> Result<(), RunError> {
    let World { mut engine, mut hosts, mut ledger, .. } = open(plan, wanted, 0, bed, frequency, known)?;
    let step = |periods: f64| (periods / (frequency * engine.time_step())).round() as u64;
    let longest = known.iter().map(|point| point.discarded).max();
    let begin = f64::from(discard(plan, wanted).or(longest).unwrap_or(transient::LONGEST));
    let moments: Vec<u64> = (0..=8).map(|k| step(begin + f64::from(k) / 8.0)).collect();
    let mut frames = FrameWriter::create(folder.path(), crate::run::formats(plan));
    for moment in moments {
        engine.advance(moment - engine.steps(), &mut hosts, &mut ledger)?;
        frames.write(&engine.frame(&hosts))?;
    }
    Ok(frames.sync()?)
}

/// Sums over the measured periods.
#[derive(Default)]
struct Window {
    /// Number, sum and sum of squares of the displacement in each half.
    halves: [[f64; 3]; 2],
    highest: Option<f64>,
    lowest: Option<f64>,
    /// Displacement, force of the grains, displacement of the base, force on it and applied force times cosine and sine.
    fourier: [[f64; 2]; 5],
}

impl Window {
    fn take(&mut self, host: &Host, time: f64, phase: f64, second: bool) {
        let z = host.displacement();
        let half = &mut self.halves[usize::from(second)];
        *half = [half[0] + 1.0, half[1] + z, half[2] + z * z];
        self.highest = Some(self.highest.map_or(z, |h| h.max(z)));
        self.lowest = Some(self.lowest.map_or(z, |l| l.min(z)));
        let (sin, cos) = phase.sin_cos();
        let values = [z, host.grain_force(), host.base_at(time)[0], host.base_force(time), host.applied(time)];
        for (sums, value) in self.fourier.iter_mut().zip(values) {
            sums[0] += value * cos;
            sums[1] += value * sin;
        }
    }

    fn point(&self, frequency: f64) -> Point {
        let [a, b] = self.halves;
        let n = a[0] + b[0];
        let mean = (a[1] + b[1]) / n;
        let rms = |h: [f64; 3]| ((h[2] / h[0]) - (h[1] / h[0]).powi(2)).max(0.0).sqrt();
        let all = ((a[2] + b[2]) / n - mean * mean).max(0.0).sqrt();
        let [z, f, base, below, applied] = self.fourier.map(|s| [2.0 * s[0] / n, 2.0 * s[1] / n]);
        let size = z[0] * z[0] + z[1] * z[1];
        let w = TAU * frequency;
        let [base, below, applied] = [base, below, applied].map(|[cos, sin]| cos.hypot(sin));
        let ratio = |answer: f64, drive: f64| if drive > 0.0 { answer / drive } else { 0.0 };
        Point {
            frequency,
            rms: all,
            peak: (self.highest.unwrap_or(mean) - mean).max(mean - self.lowest.unwrap_or(mean)),
            amplitude: size.sqrt(),
            transmissibility: if base > 0.0 { ratio(size.sqrt(), base) } else { ratio(below, applied) },
            base_force: below,
            mean,
            // F = -m a - c v: the part of F in phase with z is m w^2.
            apparent_mass: if size > 0.0 { (f[0] * z[0] + f[1] * z[1]) / (size * w * w) } else { 0.0 },
            loss: 0.0,
            flows: Vec::new(),
            watched: BTreeMap::new(),
            drift: if all > 0.0 { (rms(b) - rms(a)) / all } else { 0.0 },
            residual: 0.0,
            discarded: 0,
            wall: 0.0,
        }
    }
}
