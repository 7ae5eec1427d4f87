//! How well one candidate serves: its peak, found in few runs, or its root mean square over a band.
//!
//! A run at one frequency shows what the grains are to the structure there: a mass in phase with its acceleration and a lossy one. With these the
//! structure has its peak at a frequency that follows in closed form; the next run is there. It ends when the peak would move by less
//! than a tenth of half its width, where a resonance is half a percent lower than at its top.

use crate::interrupt::Interrupt;
use crate::partner::{Ballast, Host, Hosts};
use crate::run::RunError;
use crate::study::response::transient::{shown, unknown};
use crate::study::response::{Point, measure};
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;
use tsubu_frame::State;
use tsubu_scene::plan::{Goal, Plan, Response};

/// Runs that follow the peak of one candidate, at most: of an irregular motion it never stays where it is.
const MOST: usize = 6;
/// How near a run must be to the peak, over half its width.
const NEAR: f64 = 0.1;
/// Frequencies at which a peak is looked for.
const LOOKS: usize = 2001;

/// What a candidate does at one level of the drive, with one seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// What is to be low [m].
    pub rms: f64,
    /// Largest displacement from the mean [m].
    pub stroke: f64,
    /// Where the peak is, over the natural frequency [-].
    pub ratio: f64,
    /// Whether the peak was found as near as it is wanted.
    pub found: bool,
    /// Runs that it took.
    pub runs: u32,
    /// Largest energy residual.
    pub residual: f64,
    /// Computing time [s].
    pub wall: f64,
}

/// Measures a candidate from its settled bed; `None` where it was interrupted.
pub(super) fn answer(
    plan: &Plan,
    goal: Goal,
    reference: f64,
    seed: u32,
    bed: &State,
    interrupt: &Interrupt,
) -> Result<Option<Answer>, RunError> {
    let Some(wanted) = &plan.response else { return Ok(None) };
    let run = |ratio: f64, known: &[Point]| {
        let known: Vec<&Point> = known.iter().collect();
        measure(plan, wanted, seed, bed, reference * ratio, &known, interrupt)
    };
    match goal {
        Goal::Peak => follow(plan, wanted, reference, run),
        Goal::Band => band(&wanted.frequency_ratio, run),
    }
}

/// Runs at every frequency of a list, and takes the mean of the squares by the trapezoidal rule.
fn band(
    ratios: &[f64],
    mut run: impl FnMut(f64, &[Point]) -> Result<Option<Point>, RunError>,
) -> Result<Option<Answer>, RunError> {
    let mut points = Vec::new();
    for ratio in ratios {
        let Some(point) = run(*ratio, &points)? else { return Ok(None) };
        points.push(point);
    }
    let squares: Vec<(f64, f64)> =
        ratios.iter().zip(&points).map(|(ratio, point)| (*ratio, point.rms.powi(2))).collect();
    let integral: f64 = squares.windows(2).map(|two| 0.5 * (two[0].1 + two[1].1) * (two[1].0 - two[0].0)).sum();
    let mean = match (squares.first(), squares.last()) {
        (Some(first), Some(last)) if last.0 > first.0 => integral / (last.0 - first.0),
        _ => squares.first().map_or(f64::NAN, |one| one.1),
    };
    let top = squares.iter().fold((f64::NAN, 0.0), |top, one| if one.1 > top.1 { *one } else { top });
    Ok(Some(of_runs(&points, mean.sqrt(), 1.0, top.0, true)))
}

/// Follows the peak from run to run.
fn follow(
    plan: &Plan,
    wanted: &Response,
    reference: f64,
    mut run: impl FnMut(f64, &[Point]) -> Result<Option<Point>, RunError>,
) -> Result<Option<Answer>, RunError> {
    let mut points: Vec<Point> = Vec::new();
    let mut next = top(plan, wanted, reference, unknown(plan.grain_mass())).ratio;
    while points.len() < MOST {
        let Some(point) = run(next, &points)? else { return Ok(None) };
        let ballast = shown(&point);
        points.push(point);
        let expected = top(plan, wanted, reference, ballast);
        let there = expected.rms / rms_at(plan, wanted, reference, next, ballast);
        if (expected.ratio - next).abs() <= NEAR * expected.half_width {
            let rms = points.last().map_or(f64::NAN, |point| point.rms);
            return Ok(Some(of_runs(&points, rms * there, there, expected.ratio, true)));
        }
        next = expected.ratio;
    }
    // The highest of what was seen.
    let highest = points.iter().max_by(|a, b| a.rms.total_cmp(&b.rms));
    let [rms, ratio] = highest.map_or([f64::NAN; 2], |point| [point.rms, point.frequency / reference]);
    Ok(Some(of_runs(&points, rms, 1.0, ratio, false)))
}

fn of_runs(points: &[Point], rms: f64, there: f64, ratio: f64, found: bool) -> Answer {
    Answer {
        rms,
        stroke: there * points.iter().map(|point| point.peak).fold(0.0, f64::max),
        ratio,
        found,
        runs: points.len() as u32,
        residual: points.iter().map(|point| point.residual.abs()).fold(0.0, f64::max),
        wall: points.iter().map(|point| point.wall).sum(),
    }
}

/// The peak of a structure with a ballast.
struct Top {
    /// Over the natural frequency.
    ratio: f64,
    /// Root mean square [m].
    rms: f64,
    /// Half the width at the height over sqrt 2, over the natural frequency.
    half_width: f64,
}

fn host(plan: &Plan, wanted: &Response, frequency: f64) -> Option<Host> {
    let mut hosts = Hosts::new(&plan.hosts);
    let mut host = hosts.index(&wanted.host).map(|index| hosts.list.swap_remove(index))?;
    host.set_frequency(frequency, wanted.keep);
    Some(host)
}

fn rms_at(plan: &Plan, wanted: &Response, reference: f64, ratio: f64, ballast: Ballast) -> f64 {
    let frequency = reference * ratio;
    host(plan, wanted, frequency).map_or(f64::NAN, |host| host.steady_amplitude(frequency, ballast) / SQRT_2)
}

fn top(plan: &Plan, wanted: &Response, reference: f64, ballast: Ballast) -> Top {
    let ends = [wanted.frequency_ratio.first(), wanted.frequency_ratio.last()];
    let [from, to] = ends.map(|ratio| ratio.copied().unwrap_or(1.0));
    let step = (to - from) / (LOOKS - 1) as f64;
    let curve: Vec<(f64, f64)> = (0..LOOKS)
        .map(|i| from + step * i as f64)
        .map(|ratio| (ratio, rms_at(plan, wanted, reference, ratio, ballast)))
        .collect();
    let highest = curve.iter().fold(curve[0], |top, one| if one.1 > top.1 { *one } else { top });
    let high = curve.iter().filter(|one| one.1 * SQRT_2 >= highest.1).count();
    Top { ratio: highest.0, rms: highest.1, half_width: 0.5 * step * high as f64 }
}
