//! The response of a structure from an atlas of its cavity, in no time, with spot checks by full simulation.

mod balance;
mod cavity;
mod checks;
mod write;

pub use balance::{Balance, Lossy, Motion};

use super::atlas::Cavity;
use super::cases::{self, Case, CasesError, case_plans};
use super::journal::{Journal, Place};
use super::response::{peak, refine, tasks};
use crate::interrupt::Watcher;
use crate::partner::Hosts;
use crate::run::RunError;
use rayon::prelude::*;
use std::path::Path;
use std::time::Instant;
use tsubu_frame::{Status, Summary};
use tsubu_scene::{Plan, Scene, plan};

/// What a prediction writes beside what every study writes.
const FILES: [&str; 2] = ["prediction.csv", "cases.csv"];
/// Frequencies of a curve; beside its peak, and where it bends, there are more.
const FREQUENCIES: usize = 601;

/// How much nearer to each other these are.
const NEARER: f64 = 16.0;

/// Predicts the response of a scene's host into `folder`, from cavities of atlases, and simulates so many frequencies of each case: the
/// peak, then its flanks. In the folder of an earlier prediction of the same scene what it has simulated is kept; the rest is replaced, for
/// the atlas may be another.
pub fn predict(
    scene: &Scene,
    cavities: &[Cavity],
    spot_checks: usize,
    folder: &Path,
    overwrite: bool,
    watcher: &Watcher,
) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene, cavities)?;
    let place = Place { study: "predict", scene, folder };
    let earlier: Option<checks::Done> = place.earlier(overwrite)?;
    let curves: Vec<Curve> = (0..task.cases.len()).into_par_iter().map(|case| task.curve(case)).collect();
    let predicted_in = begun.elapsed().as_secs_f64();
    let wanted = checks::wanted(&curves, spot_checks);
    cases::open(wanted.iter().map(|(case, _)| (&task.cases[*case], &task.plans[*case])))?;
    let folder = place.open(earlier.is_some(), overwrite, &FILES)?;
    let journal = Journal::append(&folder)?;
    let checks = task.check(&curves, &wanted, &earlier.unwrap_or_default(), &journal, watcher)?;
    let status = match checks.failures.is_empty() {
        _ if watcher.interrupt.asked() => Status::Interrupted,
        true => Status::Finished,
        false => Status::Failed,
    };
    let _held = watcher.interrupt.hold();
    let took = [predicted_in, begun.elapsed().as_secs_f64()];
    Ok(write::write(&folder, scene, &task, &curves, &checks, status, took)?)
}

/// The predicted curves of a scene, without any file.
pub fn curves(scene: &Scene, cavities: &[Cavity]) -> Result<Vec<Curve>, CasesError> {
    let task = Task::new(scene, cavities)?;
    Ok((0..task.cases.len()).into_par_iter().map(|case| task.curve(case)).collect())
}

/// What is predicted at one frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Frequency [Hz].
    pub frequency: f64,
    /// Over the host's natural frequency [-].
    pub ratio: f64,
    /// All steady motions, the smallest first, of the first bed.
    pub motions: Vec<Motion>,
    /// Least and largest amplitude of the largest stable motion, over the beds and what each may be off [m].
    pub within: [f64; 2],
}

impl Row {
    /// The largest stable motion.
    pub fn largest(&self) -> Option<Motion> {
        self.motions.iter().copied().rfind(|motion| motion.stable)
    }

    /// The smallest stable motion, where there are several.
    pub fn smallest(&self) -> Option<Motion> {
        self.motions.iter().copied().find(|motion| motion.stable).filter(|one| Some(*one) != self.largest())
    }
}

/// The predicted response of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Frequencies, rising.
    pub rows: Vec<Row>,
    /// Accelerations that the atlas knows [m/s^2]; nothing for an empty cavity.
    pub known: Option<[f64; 2]>,
}

impl Curve {
    /// Where the largest stable motion is largest: frequency over the natural frequency, root mean square [m].
    pub fn peak(&self) -> Option<(f64, f64)> {
        self.top(|row| row.largest().map(|motion| motion.amplitude))
    }

    /// The same of the lower or the higher end of what the atlas tells.
    fn peak_of_end(&self, end: usize) -> Option<(f64, f64)> {
        self.top(|row| Some(row.within[end]).filter(|amplitude| amplitude.is_finite()))
    }

    fn top(&self, amplitude: impl Fn(&Row) -> Option<f64>) -> Option<(f64, f64)> {
        let rms = |row: &Row| Some((row.ratio, amplitude(row)? / std::f64::consts::SQRT_2));
        let curve: Vec<(f64, f64)> = self.rows.iter().filter_map(rms).collect();
        peak(&curve).map(|top| (top.ratio, top.rms))
    }

    /// The row nearest to a frequency ratio.
    fn nearest(&self, ratio: f64) -> Option<&Row> {
        self.rows.iter().min_by(|a, b| (a.ratio - ratio).abs().total_cmp(&(b.ratio - ratio).abs()))
    }
}

/// What is to be predicted.
struct Task<'a> {
    wanted: plan::Response,
    reference: f64,
    cases: Vec<Case>,
    plans: Vec<Plan>,
    /// The cavity of each case; nothing where it is empty.
    cavities: Vec<Option<&'a Cavity>>,
    interfaces: Vec<usize>,
}

impl<'a> Task<'a> {
    fn new(scene: &Scene, atlas: &'a [Cavity]) -> Result<Self, CasesError> {
        let wanted = scene.plan().response.clone().ok_or_else(|| {
            CasesError::Scene(
                "the scene has no `[response]`: a prediction is of the response that it asks for".to_owned(),
            )
        })?;
        if scene.plans().len() > 1 {
            return Err(CasesError::Scene("a prediction is of a scene of one stage: leave `[[stage]]` out".to_owned()));
        }
        let cases = cases::cases(&wanted.vary);
        let plans = case_plans(scene, &cases)?;
        let reference = tasks::reference_frequency(scene.plan(), &wanted.host).map_err(CasesError::Scene)?;
        let (mut cavities, mut interfaces) = (Vec::new(), Vec::new());
        for (case, plan) in cases.iter().zip(&plans) {
            let named = |what: String| {
                let case = if case.name.is_empty() { String::new() } else { format!("case `{}`: ", case.name) };
                CasesError::Scene(format!("{case}{what}"))
            };
            interfaces.push(hangs(plan, &wanted.host).map_err(named)?);
            let found = if plan.grains() == 0 { None } else { Some(cavity::find(plan, &wanted.host, atlas)) };
            cavities.push(found.transpose().map_err(|why| named(format!("the atlas has no such cavity: {why}")))?);
        }
        Ok(Self { wanted, reference, cases, plans, cavities, interfaces })
    }

    /// The structure of a case, shaken at a frequency [Hz].
    fn structure(&self, case: usize, frequency: f64) -> crate::partner::Host {
        let mut hosts = Hosts::new(&self.plans[case].hosts);
        let mut host = hosts.list.swap_remove(hosts.index(&self.wanted.host).unwrap_or_default());
        host.set_frequency(frequency, self.wanted.keep);
        host
    }

    fn curve(&self, case: usize) -> Curve {
        let ratios = &self.wanted.frequency_ratio;
        let [from, to] = [ratios.first(), ratios.last()].map(|ratio| ratio.copied().unwrap_or(1.0));
        let row = |index: usize| self.row(case, from + (to - from) * index as f64 / (FREQUENCIES - 1) as f64);
        let number = if to > from { FREQUENCIES } else { 1 };
        let known_range = self.cavities[case].map(|cavity| cavity.acceleration);
        let mut rows: Vec<Row> = (0..number).into_par_iter().map(row).collect();
        // Peaks that are narrower than the frequencies are apart, and jumps.
        let within = (to - from) / (NEARER * (FREQUENCIES - 1) as f64);
        loop {
            let height = |row: &Row| Some((row.ratio, row.largest()?.amplitude));
            let curve: Vec<(f64, f64)> = rows.iter().filter_map(height).collect();
            let more = refine::next(&curve, within);
            let known = rows.len();
            rows.par_extend(more.into_par_iter().map(|ratio| self.row(case, ratio)));
            rows.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
            rows.dedup_by(|a, b| a.ratio == b.ratio);
            if rows.len() == known {
                return Curve { rows, known: known_range };
            }
        }
    }

    fn row(&self, case: usize, ratio: f64) -> Row {
        let frequency = self.reference * ratio;
        let host = self.structure(case, frequency);
        let cavity = self.cavities[case];
        // Of an empty cavity any acceleration will do.
        let known = cavity.map_or([1e-3, 1e3], |cavity| cavity.acceleration);
        let motions = |chart, lossy| {
            Balance { host: &host, interface: self.interfaces[case], chart, known }.motions(frequency, lossy)
        };
        let charts: Vec<_> = match cavity {
            Some(cavity) => cavity.charts.iter().map(Some).collect(),
            None => vec![None],
        };
        let first = motions(charts.first().copied().flatten(), Lossy::Measured);
        let largest = |motions: Vec<Motion>| motions.into_iter().rfind(|motion| motion.stable);
        let ends = charts
            .iter()
            .flat_map(|chart| [Lossy::Least, Lossy::Measured, Lossy::Most].map(|lossy| motions(*chart, lossy)));
        let amplitudes: Vec<f64> = ends.filter_map(largest).map(|motion| motion.amplitude).collect();
        let least = amplitudes.iter().copied().fold(f64::INFINITY, f64::min);
        Row { frequency, ratio, motions: first, within: [least, amplitudes.iter().copied().fold(0.0, f64::max)] }
    }

    fn fail(&self, case: usize, error: RunError) -> CasesError {
        CasesError::Run { case: self.cases[case].name.clone(), error }
    }
}

/// The one interface that all walls of a cavity hang on.
fn hangs(plan: &Plan, name: &str) -> Result<usize, String> {
    let Some(host) = plan.hosts.get(name) else { return Err(format!("there is no host `{name}`")) };
    if host.turns() {
        return Err(format!("`{name}` is a pendulum, whose walls turn: a prediction knows motion along a line"));
    }
    if let plan::Structure::Oscillator { cubic_stiffness, .. } = &host.structure
        && *cubic_stiffness != 0.0
    {
        return Err(format!(
            "`hosts.{name}` has a `cubic-stiffness`: a prediction knows linear structures; use `tsubu response`"
        ));
    }
    let mut places = plan.walls.iter().map(|(wall, plan)| (wall, &plan.host, &plan.interface));
    let Some((first, _, interface)) = places.clone().next() else {
        return Err("there are no walls, and so no cavity".to_owned());
    };
    if let Some((wall, ..)) = places.clone().find(|(_, host, _)| host.as_deref() != Some(name)) {
        return Err(format!(
            "the wall `{wall}` does not hang on `{name}`: a prediction knows cavities that do as a whole"
        ));
    }
    if let Some((wall, ..)) = places.find(|(_, _, other)| *other != interface) {
        return Err(format!("the walls `{first}` and `{wall}` hang on two interfaces: a prediction knows one cavity"));
    }
    let built = crate::partner::Host::new(host);
    built.interface(interface.as_deref()).ok_or_else(|| format!("the host `{name}` has no such interface"))
}
