//! Samples of a posterior over the unit cube, where before nothing is more likely than anything else.
//!
//! Sequential Monte Carlo (Del Moral, Doucet and Jasra 2006): samples of the cube are led to the posterior by powers of the likelihood,
//! each as much larger as leaves half of the samples effective. In between they are drawn again by weight (systematic resampling) and
//! moved by differential evolution (ter Braak 2006): along the difference of two samples of the other half, so that shape and scale of the
//! posterior are those of the moves, and several peaks are no trouble. Same samples for any number of threads.

use crate::random::{Purpose, unit, words};
use rayon::prelude::*;

/// Samples.
pub(super) const SAMPLES: usize = 1000;
/// Moves of each sample at each power.
const MOVES: usize = 8;
/// A power is reached in so many halvings.
const HALVINGS: usize = 40;
/// Share of moves that go the whole way from one sample to another: from peak to peak.
const LEAPS: f64 = 0.1;
/// How far a move goes off its line.
const OFF: f64 = 1e-3;

/// Random numbers of one entity, one after the other.
pub(super) struct Stream {
    seed: u64,
    entity: u32,
    step: u64,
}

impl Stream {
    pub fn new(seed: u64, entity: u32) -> Self {
        Self { seed, entity, step: 0 }
    }

    /// The next number, from 0 to 1.
    pub fn next(&mut self) -> f64 {
        let [a, b, ..] = words(self.seed, Purpose::Calibration, self.entity, self.step);
        self.step += 1;
        unit(a, b)
    }

    /// One of so many.
    pub fn index(&mut self, number: usize) -> usize {
        ((self.next() * number as f64) as usize).min(number - 1)
    }
}

/// A sample with its logarithm of the likelihood.
type Sample = (Vec<f64>, f64);

/// Draws from the posterior of a likelihood, given as its logarithm.
pub(super) fn sample(dimension: usize, seed: u64, likelihood: impl Fn(&[f64]) -> f64 + Sync) -> Vec<Vec<f64>> {
    let mut streams: Vec<Stream> = (0..=SAMPLES).map(|entity| Stream::new(seed, entity as u32)).collect();
    let mut own = streams.split_off(SAMPLES);
    let mut samples: Vec<Sample> = streams
        .par_iter_mut()
        .map(|stream| {
            let place: Vec<f64> = (0..dimension).map(|_| stream.next()).collect();
            let value = likelihood(&place);
            (place, value)
        })
        .collect();
    let mut power = 0.0;
    while power < 1.0 {
        let next = next_power(&samples, power);
        let weights = weights(&samples, next - power);
        let drawn = systematic(&weights, own[0].next());
        samples = drawn.into_iter().map(|index| samples[index].clone()).collect();
        power = next;
        for _ in 0..MOVES {
            for half in 0..2 {
                let (movers, others) = halves(&mut samples, half);
                let streams = &mut streams[half * (SAMPLES / 2)..(half + 1) * (SAMPLES / 2)];
                movers
                    .par_iter_mut()
                    .zip(streams)
                    .for_each(|(sample, stream)| moved(sample, others, stream, power, &likelihood));
            }
        }
    }
    samples.into_iter().map(|sample| sample.0).collect()
}

fn halves(samples: &mut [Sample], half: usize) -> (&mut [Sample], &[Sample]) {
    let (first, second) = samples.split_at_mut(SAMPLES / 2);
    if half == 0 { (first, second) } else { (second, first) }
}

fn moved(sample: &mut Sample, others: &[Sample], stream: &mut Stream, power: f64, likelihood: impl Fn(&[f64]) -> f64) {
    let [a, b] = [0, 1].map(|_| &others[stream.index(others.len())].0);
    let far = if stream.next() < LEAPS { 1.0 } else { 2.38 / (2.0 * sample.0.len() as f64).sqrt() };
    let mut place = |x: f64, a: f64, b: f64| x + far * (a - b) + OFF * (stream.next() - 0.5);
    let proposed: Vec<f64> = sample.0.iter().zip(a).zip(b).map(|((x, a), b)| place(*x, *a, *b)).collect();
    let inside = proposed.iter().all(|x| (0.0..=1.0).contains(x));
    let chance = stream.next();
    if !inside {
        return;
    }
    let value = likelihood(&proposed);
    if chance < (power * (value - sample.1)).exp() {
        *sample = (proposed, value);
    }
}

/// The largest power, at most 1, that leaves half of the samples effective.
fn next_power(samples: &[Sample], power: f64) -> f64 {
    let effective = |next: f64| {
        let weights = weights(samples, next - power);
        1.0 / weights.iter().map(|w| w * w).sum::<f64>()
    };
    let enough = 0.5 * SAMPLES as f64;
    if effective(1.0) >= enough {
        return 1.0;
    }
    let (mut low, mut high) = (power, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if effective(middle) >= enough { low = middle } else { high = middle }
    }
    // A step that is too small to be a number would never end.
    if low > power { low } else { high }
}

fn weights(samples: &[Sample], power: f64) -> Vec<f64> {
    let highest = samples.iter().map(|sample| sample.1).fold(f64::NEG_INFINITY, f64::max);
    let raw: Vec<f64> = samples.iter().map(|sample| (power * (sample.1 - highest)).exp()).collect();
    let sum: f64 = raw.iter().sum();
    raw.into_iter().map(|weight| weight / sum).collect()
}

/// As many as there are, each about as often as its weight says, with one random number.
fn systematic(weights: &[f64], random: f64) -> Vec<usize> {
    let mut chosen = Vec::with_capacity(weights.len());
    let (mut index, mut sum) = (0, weights[0]);
    for i in 0..weights.len() {
        let at = (i as f64 + random) / weights.len() as f64;
        while sum < at && index + 1 < weights.len() {
            index += 1;
            sum += weights[index];
        }
        chosen.push(index);
    }
    chosen
}

/// So many places of the unit cube, each in a slice of its own along every axis; of several such sets the one whose nearest two are farthest
/// apart (maximin Latin hypercube; McKay, Beckman and Conover 1979, Johnson, Moore and Ylvisaker 1990).
pub(super) fn hypercube(dimension: usize, number: usize, seed: u64) -> Vec<Vec<f64>> {
    const TRIED: u32 = 200;
    let nearest = |places: &[Vec<f64>]| {
        let pairs = (0..number).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| distance(&places[i], &places[j])).fold(f64::INFINITY, f64::min)
    };
    // Samples have the entities before these.
    let sets = (0..TRIED).map(|set| {
        let mut stream = Stream::new(seed, u32::MAX - set);
        let mut axes: Vec<Vec<f64>> = Vec::new();
        for _ in 0..dimension {
            let mut axis: Vec<f64> = (0..number).map(|i| (i as f64 + 0.5) / number as f64).collect();
            for i in (1..number).rev() {
                axis.swap(i, stream.index(i + 1));
            }
            axes.push(axis);
        }
        (0..number).map(|i| axes.iter().map(|axis| axis[i]).collect()).collect::<Vec<Vec<f64>>>()
    });
    let measured = sets.map(|set| (nearest(&set), set));
    measured.reduce(|best, one| if one.0 > best.0 { one } else { best }).map(|(_, set)| set).unwrap_or_default()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(samples: &[Vec<f64>], axis: usize) -> [f64; 2] {
        let mean = samples.iter().map(|one| one[axis]).sum::<f64>() / samples.len() as f64;
        let square = samples.iter().map(|one| (one[axis] - mean).powi(2)).sum::<f64>() / samples.len() as f64;
        [mean, square.sqrt()]
    }

    /// Of a normal likelihood of width 0.02 about (0.3, 0.6), correlated by 0.9, the samples have mean, width and correlation: within four
    /// standard errors of 1000 independent ones. Control: those of half the likelihood's power are wider by sqrt(2).
    #[test]
    fn samples_are_those_of_a_normal_distribution() {
        let (wide, corr) = (0.02, 0.9_f64);
        let likelihood = |x: &[f64]| {
            let (a, b) = ((x[0] - 0.3) / wide, (x[1] - 0.6) / wide);
            -0.5 * (a * a - 2.0 * corr * a * b + b * b) / (1.0 - corr * corr)
        };
        let samples = sample(2, 1, likelihood);
        for (axis, centre) in [(0, 0.3), (1, 0.6)] {
            let [mean, deviation] = moments(&samples, axis);
            assert!((mean - centre).abs() < 4.0 * wide / 1000_f64.sqrt(), "{mean}");
            assert!((deviation / wide - 1.0).abs() < 4.0 / 2000_f64.sqrt(), "{deviation}");
        }
        let [m0, s0] = moments(&samples, 0);
        let [m1, s1] = moments(&samples, 1);
        let found = samples.iter().map(|x| (x[0] - m0) * (x[1] - m1)).sum::<f64>() / (1000.0 * s0 * s1);
        assert!((found - corr).abs() < 4.0 * (1.0 - corr * corr) / 1000_f64.sqrt(), "{found}");
        let half = sample(2, 1, |x| 0.5 * likelihood(x));
        assert!((moments(&half, 0)[1] / wide - 1.0).abs() > 4.0 / 2000_f64.sqrt());
    }

    /// Of two equal peaks far apart each has its share.
    #[test]
    fn two_peaks_keep_their_shares() {
        let peak = |x: f64, at: f64| (-0.5 * ((x - at) / 0.01_f64).powi(2)).exp();
        let samples = sample(1, 3, |x| (peak(x[0], 0.2) + 3.0 * peak(x[0], 0.8) + 1e-300).ln());
        let upper = samples.iter().filter(|x| x[0] > 0.5).count() as f64 / 1000.0;
        assert!((upper - 0.75).abs() < 0.08, "{upper}");
    }

    #[test]
    fn every_slice_of_a_hypercube_has_one_place() {
        let places = hypercube(3, 12, 5);
        for axis in 0..3 {
            let mut slices: Vec<usize> = places.iter().map(|place| (place[axis] * 12.0) as usize).collect();
            slices.sort_unstable();
            assert_eq!(slices, (0..12).collect::<Vec<_>>());
        }
    }
}
