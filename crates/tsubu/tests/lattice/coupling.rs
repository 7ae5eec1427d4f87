//! What the box feels: weight, inertia, and the shift of the resonance.

use super::plans::{Run, coupled, plan};
use tsubu_scene::plan::*;

/// Mean force of a settled bed on a still box over its weight.
fn force_over_weight(mode: LatticeMode, count: usize) -> f64 {
    let mut run = Run::new(&plan(count, mode));
    run.advance(200).expect("nothing moves");
    let before = run.ledger.wall_impulse[2];
    run.advance(10_000).expect("nothing moves");
    (run.ledger.wall_impulse[2] - before) / (10_000.0 * 1e-4 * count as f64 * 0.2e-3 * 10.0)
}

#[test]
fn a_settled_bed_weighs_what_it_should() {
    for count in [1, 10, 37, 50, 160] {
        let ratio = force_over_weight(LatticeMode::Extended, count);
        assert!((ratio - 1.0).abs() < 1e-12, "{count} balls: {ratio}");
        // "Force only from balls that are moving": the literal automaton's defect, and the wrong variant of this gate.
        assert_eq!(force_over_weight(LatticeMode::Literal, count), 0.0);
    }
}

/// RMS displacement of the box over whole periods [m], without its mean.
fn rms(plan: &Plan, ratio: f64, discard: u64, measure: u64) -> f64 {
    let mut run = Run::new(plan);
    let natural = (123.4_f64 / 0.086).sqrt() / std::f64::consts::TAU;
    let period = (1.0 / (ratio * natural * plan.lattice.time_step)).round() as u64;
    run.advance(discard * period).expect("the box stays on its grid");
    let (mut sum, mut squares) = (0.0, 0.0);
    let steps = measure * period;
    for _ in 0..steps {
        run.advance(1).expect("the box stays on its grid");
        let z = run.hosts.list[0].displacement();
        sum += z;
        squares += z * z;
    }
    let n = steps as f64;
    (squares / n - (sum / n).powi(2)).max(0.0).sqrt()
}

/// Frequency ratio of the peak, by the parabola through the three highest points, and its height [m].
fn peak(count: usize, mode: LatticeMode, base: f64, ratios: &[f64]) -> (f64, f64) {
    let curve: Vec<f64> = ratios
        .iter()
        .map(|&ratio| {
            let mut plan = coupled(plan(count, mode), base, ratio);
            plan.lattice.head_room = 8;
            rms(&plan, ratio, if count == 0 { 60 } else { 40 }, 10)
        })
        .collect();
    let top = (0..curve.len()).max_by(|&a, &b| curve[a].total_cmp(&curve[b])).expect("the curve has points");
    if top == 0 || top + 1 == curve.len() {
        return (ratios[top], curve[top]);
    }
    let (l, c, r) = (curve[top - 1], curve[top], curve[top + 1]);
    let shift = 0.5 * (l - r) / (l - 2.0 * c + r);
    (ratios[top] + shift * (ratios[top + 1] - ratios[top]), c)
}

fn ratios(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round() as usize;
    (0..=count).map(|i| from + step * i as f64).collect()
}

/// Balls that stay on the floor are added mass: f_peak / f0 = 1 / sqrt(1 + N m / M).
#[test]
fn extended_bed_at_small_amplitude_is_added_mass() {
    for count in [10, 30, 50] {
        let limit = 1.0 / (1.0 + count as f64 * 0.2e-3 / 0.086_f64).sqrt();
        let (at, _) = peak(count, LatticeMode::Extended, 0.05e-3, &ratios(limit - 0.03, limit + 0.03, 0.01));
        assert!((at - limit).abs() < 0.01, "{count} balls: peak at {at}, limit {limit}");
        let (at, _) = peak(count, LatticeMode::Literal, 0.05e-3, &ratios(0.95, 1.05, 0.01));
        assert!((at - limit).abs() > 0.01, "the gate must notice missing inertia: {count} balls, {at}");
    }
}

/// The literal automaton damps, and does not shift the peak down: named by its authors as its defect.
#[test]
fn literal_automaton_damps_without_a_shift_down() {
    let points = ratios(0.94, 1.10, 0.02);
    let peaks: Vec<(f64, f64)> =
        [0, 10, 30, 50].iter().map(|&n| peak(n, LatticeMode::Literal, 0.5e-3, &points)).collect();
    for pair in peaks.windows(2) {
        assert!(pair[1].1 < pair[0].1, "the peak must fall: {peaks:?}");
        // The curves are ragged: half a point of the frequency grid is what the peak can be told to.
        assert!(pair[1].0 > pair[0].0 - 0.01, "the peak must not move down: {peaks:?}");
    }
    let (extended, _) = peak(50, LatticeMode::Extended, 0.5e-3, &points);
    assert!(extended < peaks[0].0 - 0.01, "the gate must notice a shift down: {extended}");
}
