//! From the points of a case to its curve, its peak and its damping.

use super::point::Point;
use crate::ledger::Account;
use crate::partner::Hosts;
use crate::student::interval_of_mean;
use std::collections::{BTreeMap, BTreeSet};
use tsubu_scene::plan::Plan;

/// One frequency of a case, over all seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Frequency [Hz].
    pub frequency: f64,
    /// Frequency over the host's natural frequency [-].
    pub ratio: f64,
    /// Root mean square displacement: mean, lowest, highest over the seeds [m].
    pub rms: [f64; 3],
    /// Largest displacement, mean over the seeds [m].
    pub peak: f64,
    /// Amplitude of the acceleration at the driving frequency, mean over the seeds [m/s^2].
    pub acceleration: f64,
    /// Of a base that moves, the amplitude over its own; of a force, the force on the base over it; mean over the seeds [-].
    pub transmissibility: f64,
    /// Amplitude of the force on the base, mean over the seeds [N].
    pub base_force: f64,
    /// Mass the grains add, mean over the seeds [kg].
    pub apparent_mass: f64,
    /// Loss per cycle, mean over the seeds [J].
    pub loss: f64,
    /// Energy of every account per cycle, mean over the seeds [J].
    pub flows: Vec<f64>,
    /// Largest drift over the seeds [-].
    pub drift: f64,
    /// Most periods that were thrown away, over the seeds.
    pub discarded: u32,
    /// What watches told, by its column: mean, lowest, highest over the seeds.
    pub watched: BTreeMap<String, [f64; 3]>,
}

/// Top of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Where [-].
    pub ratio: f64,
    /// How high [m].
    pub rms: f64,
    /// How far the neighbours of the highest point are from it, at most [-].
    pub within: f64,
    /// Half the width at 1/sqrt(2) of the height over the peak's place: the half-power damping ratio; not-a-number where
    /// the curve does not fall that far on both sides.
    pub half_power_damping: f64,
}

/// Why the top of a curve of such heights may not be the top: it is at an end, or its neighbours are far below.
pub fn doubt(heights: &[f64]) -> Option<&'static str> {
    let top = (0..heights.len()).max_by(|a, b| heights[*a].total_cmp(&heights[*b]))?;
    let lower = |neighbour: usize| heights[neighbour] < 0.7 * heights[top];
    if heights.len() == 1 {
        None
    } else if top == 0 || top + 1 == heights.len() {
        Some(
            "the highest motion is at an end of the frequencies, so the peak may lie beyond: widen `response.frequency-ratio`",
        )
    } else if lower(top - 1) || lower(top + 1) {
        Some(
            "the peak is narrower than the frequencies beside it are apart, and may be higher between them: a smaller `response.peak-within`, or a smaller step",
        )
    } else {
        None
    }
}

/// Frequencies at which two steady motions were found, by coming from below and from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    /// Lowest and highest such frequency, over the natural frequency [-].
    pub ratios: [f64; 2],
    /// Largest difference of the root mean squares, over the larger [-].
    pub gap: f64,
}

impl Hysteresis {
    /// How much two curves must differ to be told apart.
    const APART: f64 = 0.1;

    /// Compares the curve up with the curve down.
    pub fn between(up: &[Row], down: &[Row]) -> Option<Self> {
        let gap = |row: &Row| {
            let other = down.iter().find(|other| other.ratio == row.ratio)?;
            Some((row.ratio, (row.rms[0] - other.rms[0]).abs() / row.rms[0].max(other.rms[0])))
        };
        let apart: Vec<(f64, f64)> = up.iter().filter_map(gap).filter(|(_, gap)| *gap > Self::APART).collect();
        let (first, last) = (apart.first()?, apart.last()?);
        Some(Self { ratios: [first.0, last.0], gap: apart.iter().map(|(_, gap)| *gap).fold(0.0, f64::max) })
    }
}

/// A case with everything that is reported of it.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// Name of the case.
    pub name: String,
    /// Number of grains.
    pub particles: usize,
    /// The curve.
    pub rows: Vec<Row>,
    /// Its top; `None` without points.
    pub peak: Option<Peak>,
    /// 95 % interval of the mean of the tops of each seed's own curve [m]; nothing with one seed.
    pub peak_interval: Option<[f64; 2]>,
    /// Where the curve up and the curve down part; nothing where there is one of them, or where they agree.
    pub hysteresis: Option<Hysteresis>,
    /// Energy lost per cycle over 2 pi times the spring energy, at the frequency nearest to the peak [-].
    pub loss_factor: f64,
    /// Mass the grains add, there [kg].
    pub apparent_mass: f64,
    /// 1/sqrt(1 + m/M): where the peak would be if all grains moved with the host [-].
    pub added_mass_limit: f64,
    /// Energy of every account per cycle, there [J].
    pub flows: Vec<f64>,
    /// Computing time of all points [s].
    pub wall: f64,
    /// Largest energy residual of its runs.
    pub residual: f64,
}

impl CaseResult {
    /// Gathers the points (frequency over `reference`, point) of a case.
    pub fn new(name: &str, plan: &Plan, reference: f64, points: &[(f64, &Point)]) -> Self {
        let mut ratios: Vec<f64> = points.iter().map(|(ratio, _)| *ratio).collect();
        ratios.sort_by(f64::total_cmp);
        ratios.dedup();
        let at = |ratio: f64| points.iter().filter(move |(own, _)| *own == ratio).map(|(_, point)| *point);
        let rows: Vec<Row> = ratios.iter().filter_map(|&ratio| row(ratio, &at(ratio).collect::<Vec<_>>())).collect();
        let host = Hosts::new(&plan.hosts);
        let wanted = plan.response.as_ref().and_then(|r| host.index(&r.host)).unwrap_or_default();
        let mass = host.list.get(wanted).map_or(f64::NAN, crate::partner::Host::modal_mass);
        let grains = plan.grain_mass();
        let curve: Vec<(f64, f64)> = rows.iter().map(|r| (r.ratio, r.rms[0])).collect();
        let top = peak(&curve);
        let nearest = top
            .and_then(|t| rows.iter().min_by(|a, b| (a.ratio - t.ratio).abs().total_cmp(&(b.ratio - t.ratio).abs())));
        let stiffness = mass * (std::f64::consts::TAU * reference).powi(2);
        // Spring energy at the largest stretch: the root mean square of a sine is its amplitude over sqrt 2.
        let loss_factor = nearest
            .map_or(f64::NAN, |r| r.loss / (std::f64::consts::TAU * 0.5 * stiffness * 2.0 * r.rms[0] * r.rms[0]));
        Self {
            name: name.to_owned(),
            particles: plan.particles.values().map(|p| p.count).sum(),
            peak: top,
            peak_interval: None,
            hysteresis: None,
            loss_factor,
            apparent_mass: nearest.map_or(f64::NAN, |r| r.apparent_mass),
            added_mass_limit: 1.0 / (1.0 + grains / mass).sqrt(),
            flows: nearest.map_or_else(|| vec![0.0; Account::ALL.len()], |r| r.flows.clone()),
            wall: points.iter().map(|(_, p)| p.wall).sum(),
            residual: points.iter().map(|(_, p)| p.residual.abs()).fold(0.0, f64::max),
            rows,
        }
    }
}

/// What the tops of the seeds' own curves are worth together: points of a case as seed, frequency ratio and root mean square [m].
pub(super) fn peak_interval(points: impl Iterator<Item = (u32, f64, f64)>) -> Option<[f64; 2]> {
    let mut curves: BTreeMap<u32, Vec<(f64, f64)>> = BTreeMap::new();
    for (seed, ratio, rms) in points {
        curves.entry(seed).or_default().push((ratio, rms));
    }
    let top = |curve: &mut Vec<(f64, f64)>| {
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(peak(curve)?.rms)
    };
    let tops: Vec<f64> = curves.values_mut().filter_map(top).collect();
    (tops.len() > 1).then(|| interval_of_mean(&tops))
}

fn row(ratio: f64, points: &[&Point]) -> Option<Row> {
    let n = points.len() as f64;
    let first = points.first()?;
    let mean = |f: &dyn Fn(&Point) -> f64| points.iter().map(|p| f(p)).sum::<f64>() / n;
    let lowest = points.iter().map(|p| p.rms).fold(f64::INFINITY, f64::min);
    let highest = points.iter().map(|p| p.rms).fold(0.0, f64::max);
    Some(Row {
        frequency: first.frequency,
        ratio,
        rms: [mean(&|p| p.rms), lowest, highest],
        peak: mean(&|p| p.peak),
        acceleration: mean(&|p| p.amplitude * (std::f64::consts::TAU * p.frequency).powi(2)),
        transmissibility: mean(&|p| p.transmissibility),
        base_force: mean(&|p| p.base_force),
        apparent_mass: mean(&|p| p.apparent_mass),
        loss: mean(&|p| p.loss),
        flows: (0..first.flows.len()).map(|i| mean(&|p| p.flows[i])).collect(),
        drift: points.iter().map(|p| p.drift.abs()).fold(0.0, f64::max),
        discarded: points.iter().map(|p| p.discarded).max().unwrap_or_default(),
        watched: watched(points),
    })
}

/// What watches told in the points of a row; of seeds that saw nothing the others tell.
fn watched(points: &[&Point]) -> BTreeMap<String, [f64; 3]> {
    let columns: BTreeSet<&String> = points.iter().flat_map(|p| p.watched.keys()).collect();
    let over_seeds = |column: &String| {
        let told: Vec<f64> = points.iter().filter_map(|p| p.watched.get(column).copied()).collect();
        let mean = told.iter().sum::<f64>() / told.len() as f64;
        let lowest = told.iter().copied().fold(f64::INFINITY, f64::min);
        [mean, lowest, told.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    };
    columns.into_iter().map(|column| (column.clone(), over_seeds(column))).collect()
}

/// Top of a curve of (place, height), by the parabola through the highest point and its neighbours, and the half-power
/// damping by straight lines between the points.
pub fn peak(curve: &[(f64, f64)]) -> Option<Peak> {
    let (i, &(x, y)) = curve.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    let (mut ratio, mut rms) = (x, y);
    if i > 0 && i + 1 < curve.len() {
        let ((x0, y0), (x2, y2)) = (curve[i - 1], curve[i + 1]);
        // Newton's divided differences; exact for unequal spacing.
        let first = (y - y0) / (x - x0);
        let second = ((y2 - y) / (x2 - x) - first) / (x2 - x0);
        if second < 0.0 {
            ratio = 0.5 * (x0 + x) - 0.5 * first / second;
            rms = y0 + first * (ratio - x0) + second * (ratio - x0) * (ratio - x);
        }
    }
    let half = rms / std::f64::consts::SQRT_2;
    let crossing = |a: (f64, f64), b: (f64, f64)| a.0 + (b.0 - a.0) * (half - a.1) / (b.1 - a.1);
    let left = (0..i).rev().find(|&k| curve[k].1 <= half).map(|k| crossing(curve[k], curve[k + 1]));
    let right = (i + 1..curve.len()).find(|&k| curve[k].1 <= half).map(|k| crossing(curve[k - 1], curve[k]));
    let half_power_damping = match (left, right) {
        (Some(left), Some(right)) => (right - left) / (2.0 * ratio),
        _ => f64::NAN,
    };
    let neighbours = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|k| curve.get(k));
    let within = neighbours.map(|near| (near.0 - x).abs()).fold(0.0, f64::max);
    Some(Peak { ratio, rms, within, half_power_damping })
}

#[cfg(test)]
mod tests {
    use super::{doubt, peak, peak_interval};

    #[test]
    fn a_top_that_may_be_none_is_told() {
        assert_eq!((doubt(&[1.0]), doubt(&[0.8, 1.0, 0.9])), (None, None));
        assert!(doubt(&[0.8, 0.9, 1.0]).is_some_and(|text| text.contains("at an end")));
        assert!(doubt(&[0.8, 1.0, 0.6]).is_some_and(|text| text.contains("narrower")));
    }

    /// Three seeds with tops of 1, 2 and 3: Student's interval of their mean, 4.303/sqrt(3) to both sides; one seed has none.
    #[test]
    fn seeds_say_what_a_peak_is_worth() {
        let points = |seeds: u32| {
            (1..=seeds)
                .flat_map(|seed| [1.1, 0.9, 1.0].map(|x| (seed, x, f64::from(seed) * (1.0 - (x - 1.0_f64).powi(2)))))
        };
        let [low, high] = peak_interval(points(3)).expect("three seeds");
        assert!((0.5 * (low + high) - 2.0).abs() < 1e-9 && (high - 2.0 - 4.303 / 3.0_f64.sqrt()).abs() < 1e-3);
        assert_eq!(peak_interval(points(1)), None);
    }

    /// The closed form of a damped oscillator: the peak and the half-power damping come back from its sampled curve.
    #[test]
    fn peak_of_a_known_oscillator() {
        let zeta = 0.05;
        let height = |r: f64, zeta: f64| 1.0 / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)).sqrt();
        let curve = |zeta: f64| -> Vec<(f64, f64)> {
            (0..=60).map(|i| 0.7 + 0.01 * f64::from(i)).map(|r| (r, height(r, zeta))).collect()
        };
        let top = peak(&curve(zeta)).expect("a curve has a top");
        assert!((top.ratio - (1.0 - 2.0 * zeta * zeta).sqrt()).abs() < 1e-3);
        assert!((top.half_power_damping / zeta - 1.0).abs() < 0.02, "{}", top.half_power_damping);
        // The control: another damping is told apart by the same tolerance.
        let other = peak(&curve(1.05 * zeta)).expect("a curve has a top");
        assert!((other.half_power_damping / zeta - 1.0).abs() > 0.02);
    }
}
