//! Which points of an atlas are measured next: where what a cavity shows bends.

use super::shown::{Column, Shown, at, between};
use crate::study::journal::Exact;
use std::collections::BTreeMap;

/// Frequencies and accelerations that every atlas begins with.
const FREQUENCIES: usize = 3;
const ACCELERATIONS: usize = 5;
/// Neighbours are not brought nearer to each other than this, as ratios.
const NEAREST: f64 = 1.02;

/// A frequency [Hz] and an acceleration [m/s^2].
pub(super) type Place = (Exact, Exact);

/// What was found there, over the mass of the grains.
pub(super) type Found = BTreeMap<Place, Shown>;

/// The points that every atlas begins with, evenly spaced by ratio.
pub(super) fn first(frequency: [f64; 2], acceleration: [f64; 2]) -> Vec<Place> {
    let accelerations = spaced(acceleration, ACCELERATIONS);
    let column = |f: f64| accelerations.iter().map(move |a| (Exact(f), Exact(*a)));
    spaced(frequency, FREQUENCIES).into_iter().flat_map(column).collect()
}

/// Points to be measured next, at most so many: at each frequency, accelerations beside those that lie farther than `within` off the
/// line between their neighbours; once there are none, frequencies beside those that lie off so.
pub(super) fn next(found: &Found, within: f64, at_most: usize) -> Vec<Place> {
    let mut columns: BTreeMap<Exact, Column> = BTreeMap::new();
    for ((frequency, acceleration), shown) in found {
        columns.entry(*frequency).or_default().push((acceleration.0, *shown));
    }
    let mut wanted = Vec::new();
    for (frequency, column) in &columns {
        // Scatter is no bend.
        let bent = |line: Shown, (_, own): &(f64, Shown)| (own.mass - line.mass).norm() - 2.0 * own.error > within;
        let accelerations: Vec<f64> = column.iter().map(|(acceleration, _)| *acceleration).collect();
        let bends = column
            .windows(3)
            .map(|three| bent(between([three[0].0, three[2].0], [three[0].1, three[2].1], three[1].0), &three[1]));
        wanted.extend(halves(&accelerations, bends).into_iter().map(|a| (*frequency, Exact(a))));
    }
    if wanted.is_empty() {
        let frequencies: Vec<f64> = columns.keys().map(|frequency| frequency.0).collect();
        let list: Vec<(f64, &Column)> = columns.iter().map(|(frequency, column)| (frequency.0, column)).collect();
        let bends = list.windows(3).map(|three| {
            let [(low, below), (middle, column), (high, above)] = [three[0], three[1], three[2]];
            let off = |(a, own): &(f64, Shown)| {
                let line = between([low, high], [at(below, *a), at(above, *a)], middle);
                ((own.mass - line.mass).norm() - 2.0 * own.error).max(0.0).powi(2)
            };
            (column.iter().map(off).sum::<f64>() / column.len() as f64).sqrt() > within
        });
        let ends = [found.keys().map(|k| k.1).min(), found.keys().map(|k| k.1).max()].map(|a| a.map_or(1.0, |a| a.0));
        let between = halves(&frequencies, bends)
            .into_iter()
            .flat_map(|frequency| spaced(ends, ACCELERATIONS).into_iter().map(move |a| (Exact(frequency), Exact(a))));
        wanted.extend(between);
    }
    wanted.retain(|place| !found.contains_key(place));
    wanted.truncate(at_most);
    wanted
}

/// The middles of the intervals on either side of those inner places that bend.
fn halves(places: &[f64], bends: impl Iterator<Item = bool>) -> Vec<f64> {
    let mut wanted = vec![false; places.len().saturating_sub(1)];
    for (index, bends) in bends.enumerate() {
        wanted[index] |= bends;
        wanted[index + 1] |= bends;
    }
    let wide = |two: &&[f64]| two[1] / two[0] > NEAREST * NEAREST;
    let intervals = places.windows(2).zip(wanted).filter_map(|(two, wanted)| wanted.then_some(two));
    intervals.filter(wide).map(|two| tidy((two[0] * two[1]).sqrt())).collect()
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
    use nalgebra::Complex;

    fn refined(shown: impl Fn(f64, f64) -> Complex<f64>, error: f64) -> Found {
        let mut found = Found::new();
        let mut wanted = first([4.0, 9.0], [1.0, 30.0]);
        while !wanted.is_empty() {
            let point = |(f, a): Place| Shown { mass: shown(f.0, a.0), error, harmonics: 0.0 };
            found.extend(wanted.into_iter().map(|place| (place, point(place))));
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
