//! Which points of an atlas are measured next: where what a cavity shows bends.

use crate::study::journal::Exact;
use nalgebra::Complex;
use std::collections::BTreeMap;

/// Frequencies and accelerations that every atlas begins with.
const FREQUENCIES: usize = 3;
const ACCELERATIONS: usize = 5;
/// Neighbours are not brought nearer to each other than this, as ratios.
const NEAREST: f64 = 1.02;

/// A frequency [Hz] and an acceleration [m/s^2].
pub(super) type Place = (Exact, Exact);

/// What was found there: the complex mass over the mass of the grains, and its standard error.
pub(super) type Found = BTreeMap<Place, (Complex<f64>, f64)>;

/// The points that every atlas begins with, evenly spaced by ratio.
pub(super) fn first(frequency: [f64; 2], acceleration: [f64; 2]) -> Vec<Place> {
    let accelerations = spaced(acceleration, ACCELERATIONS);
    let column = |f: f64| accelerations.iter().map(move |a| (Exact(f), Exact(*a)));
    spaced(frequency, FREQUENCIES).into_iter().flat_map(column).collect()
}

/// Points to be measured next, at most so many: at each frequency, accelerations beside those that lie farther than `within` off the
/// line between their neighbours; once there are none, frequencies beside those that lie off so.
pub(super) fn next(found: &Found, within: f64, at_most: usize) -> Vec<Place> {
    let mut columns: BTreeMap<Exact, Vec<(f64, Complex<f64>, f64)>> = BTreeMap::new();
    for ((frequency, acceleration), (mass, error)) in found {
        columns.entry(*frequency).or_default().push((acceleration.0, *mass, *error));
    }
    let mut wanted = Vec::new();
    for (frequency, column) in &columns {
        wanted.extend(halves(&bent(column, within)).into_iter().map(|a| (*frequency, Exact(a))));
    }
    if wanted.is_empty() {
        let ends = [found.keys().map(|k| k.1).min(), found.keys().map(|k| k.1).max()].map(|a| a.map_or(1.0, |a| a.0));
        let list: Vec<(Exact, &Vec<_>)> = columns.iter().map(|(f, column)| (*f, column)).collect();
        let mut intervals: Vec<([f64; 2], bool)> =
            list.windows(2).map(|two| ([two[0].0.0, two[1].0.0], false)).collect();
        for (i, three) in list.windows(3).enumerate() {
            let [(low, below), (middle, column), (high, above)] = [three[0], three[1], three[2]];
            let share = (middle.0 / low.0).ln() / (high.0 / low.0).ln();
            let squares: f64 = column
                .iter()
                .map(|(a, mass, error)| {
                    let line = at(below, *a).0 * (1.0 - share) + at(above, *a).0 * share;
                    ((mass - line).norm() - 2.0 * error).max(0.0).powi(2)
                })
                .sum();
            if (squares / column.len() as f64).sqrt() > within {
                (intervals[i].1, intervals[i + 1].1) = (true, true);
            }
        }
        let between = halves(&intervals).into_iter().flat_map(|frequency| {
            spaced(ends, ACCELERATIONS).into_iter().map(move |a| (Exact(frequency), Exact(a)))
        });
        wanted.extend(between);
    }
    wanted.retain(|place| !found.contains_key(place));
    wanted.truncate(at_most);
    wanted
}

/// The intervals of a column, and whether they are to be halved.
fn bent(column: &[(f64, Complex<f64>, f64)], within: f64) -> Vec<([f64; 2], bool)> {
    let mut intervals: Vec<([f64; 2], bool)> =
        column.windows(2).map(|two| ([two[0].0, two[1].0], false)).collect();
    for (i, three) in column.windows(3).enumerate() {
        let [(low, below, _), (a, mass, error), (high, above, _)] = [three[0], three[1], three[2]];
        let off = (mass - between([low, high], [below, above], a)).norm();
        // Scatter is no bend.
        if off - 2.0 * error > within {
            (intervals[i].1, intervals[i + 1].1) = (true, true);
        }
    }
    intervals
}

/// The middles of the intervals that are to be halved.
fn halves(intervals: &[([f64; 2], bool)]) -> Vec<f64> {
    let wide = |[low, high]: &[f64; 2]| high / low > NEAREST * NEAREST;
    intervals.iter().filter(|(ends, wanted)| *wanted && wide(ends)).map(|([low, high], _)| tidy((low * high).sqrt())).collect()
}

/// The value at `x` of the straight line, over the logarithm, through two points.
pub(super) fn between([low, high]: [f64; 2], [below, above]: [Complex<f64>; 2], x: f64) -> Complex<f64> {
    let share = (x / low).ln() / (high / low).ln();
    below * (1.0 - share) + above * share
}

/// Value and error on the straight lines, over the logarithm, of a column; those of its end beyond it.
pub(super) fn at(column: &[(f64, Complex<f64>, f64)], a: f64) -> (Complex<f64>, f64) {
    let after = column.partition_point(|(own, ..)| *own < a);
    match (after.checked_sub(1).and_then(|before| column.get(before)), column.get(after)) {
        (Some((low, below, first)), Some((high, above, second))) => {
            (between([*low, *high], [*below, *above], a), first.max(*second))
        }
        (Some((_, end, error)), None) | (None, Some((_, end, error))) => (*end, *error),
        (None, None) => (Complex::default(), 0.0),
    }
}

/// So many numbers, evenly spaced by ratio.
fn spaced([low, high]: [f64; 2], number: usize) -> Vec<f64> {
    let step = (high / low).ln() / (number - 1) as f64;
    let inner = (1..number - 1).map(|i| tidy(low * (step * i as f64).exp()));
    std::iter::once(low).chain(inner).chain([high]).collect()
}

/// Six digits: more nobody wants to read.
fn tidy(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refined(shown: impl Fn(f64, f64) -> Complex<f64>, error: f64) -> Found {
        let mut found = Found::new();
        let mut wanted = first([4.0, 9.0], [1.0, 30.0]);
        while !wanted.is_empty() {
            found.extend(wanted.into_iter().map(|place| (place, (shown(place.0.0, place.1.0), error))));
            wanted = next(&found, 0.05, 200_usize.saturating_sub(found.len()));
        }
        found
    }

    /// Grains that ride until the floor falls faster than they do, and are lost sight of after: points gather where that happens, at
    /// every frequency alike, and no frequency is added. Control: what scatters as much as it bends is left alone.
    #[test]
    fn points_go_where_the_mass_bends() {
        let shown = |_: f64, a: f64| Complex::new(if a < 9.81 { 1.0 } else { 9.81 / a }, 0.0);
        let found = refined(shown, 0.0);
        let near = found.keys().filter(|(_, a)| (7.0..14.0).contains(&a.0)).count();
        assert!(near > found.len() / 3 && found.len() < 60, "{near} of {}", found.len());
        let columns: std::collections::BTreeSet<Exact> = found.keys().map(|(f, _)| *f).collect();
        assert_eq!(columns.len(), FREQUENCIES);
        assert_eq!(refined(shown, 0.5).len(), FREQUENCIES * ACCELERATIONS);
    }

    /// What changes with the frequency alone has frequencies added, and an atlas ends where its points are used up.
    #[test]
    fn frequencies_are_added_where_they_matter() {
        let found = refined(|f, _| Complex::new((f - 6.0).abs() / 3.0, 0.0), 0.0);
        assert!(found.len() > FREQUENCIES * ACCELERATIONS && found.len() <= 200, "{}", found.len());
    }
}
