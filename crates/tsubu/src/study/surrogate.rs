//! A Gaussian process: what was measured at some places, guessed at all others, with how sure the guess is.
//!
//! Values are a constant, plus a random field with the correlation (1 + s + s^2/3) exp(-s), s = sqrt(5) |dx / l| (Matern 5/2), plus noise. One
//! length a coordinate and the noise are the most likely ones on a grid, constant and variance follow in closed form (Rasmussen and
//! Williams 2006, 2.25, 2.26, 5.8).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use std::f64::consts::{PI, SQRT_2};

/// Lengths that are tried, where coordinates go from 0 to 1.
const LENGTHS: [f64; 7] = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4];
/// Variance of the noise over that of the field.
const NOISES: [f64; 7] = [1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0];
/// Without measurements that say otherwise, a length is expected about here, within this factor.
const EXPECTED: f64 = 1.0;
const FACTOR: f64 = 3.0;
/// Rounds through all coordinates.
const ROUNDS: usize = 3;

/// A fitted Gaussian process.
#[derive(Clone, Debug)]
pub struct Surrogate {
    places: Vec<Vec<f64>>,
    values: DVector<f64>,
    lengths: Vec<f64>,
    noise: f64,
    factor: Cholesky<f64, Dyn>,
    mean: f64,
    variance: f64,
    /// R^-1 (y - mean).
    weights: DVector<f64>,
}

impl Surrogate {
    /// Fits values that were measured at places; coordinates are best between 0 and 1. `None` with fewer than two values, or some that are
    /// not finite.
    pub fn fit(places: &[Vec<f64>], values: &[f64]) -> Option<Self> {
        let finite = places.iter().flatten().chain(values).all(|x| x.is_finite());
        if values.len() < 2 || places.len() != values.len() || !finite {
            return None;
        }
        let values = DVector::from_column_slice(values);
        let mut lengths = vec![EXPECTED; places[0].len()];
        let mut noise = NOISES[2];
        let likely = |lengths: &[f64], noise: f64| {
            let unexpected: f64 = lengths.iter().map(|l| ((l / EXPECTED).ln() / FACTOR.ln()).powi(2)).sum();
            Self::with(places, &values, lengths, noise)
                .map_or(f64::NEG_INFINITY, |fit| fit.likelihood() - 0.5 * unexpected)
        };
        for _ in 0..ROUNDS {
            noise = most(&NOISES, |noise| likely(&lengths, noise));
            for axis in 0..lengths.len() {
                let tried = |length: f64| {
                    let mut lengths = lengths.clone();
                    lengths[axis] = length;
                    likely(&lengths, noise)
                };
                lengths[axis] = most(&LENGTHS, tried);
            }
        }
        Self::with(places, &values, &lengths, noise)
    }

    fn with(places: &[Vec<f64>], values: &DVector<f64>, lengths: &[f64], noise: f64) -> Option<Self> {
        let n = places.len();
        let correlations = DMatrix::from_fn(n, n, |i, j| {
            correlation(&places[i], &places[j], lengths) + if i == j { noise } else { 0.0 }
        });
        let factor = Cholesky::new(correlations)?;
        let ones = DVector::from_element(n, 1.0);
        let mean = factor.solve(values).sum() / factor.solve(&ones).sum();
        let off = values.add_scalar(-mean);
        let weights = factor.solve(&off);
        // Equal values are known as well as floating point lets them be.
        let variance = (off.dot(&weights) / n as f64).max(f64::EPSILON);
        let (places, lengths) = (places.to_vec(), lengths.to_vec());
        Some(Self { places, values: values.clone(), lengths, noise, factor, mean, variance, weights })
    }

    /// Logarithm of the likelihood, but for a constant.
    pub(super) fn likelihood(&self) -> f64 {
        let determinant: f64 = self.factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum();
        -0.5 * self.places.len() as f64 * self.variance.ln() - determinant
    }

    /// What is expected at a place without noise, and its standard deviation.
    pub fn at(&self, place: &[f64]) -> [f64; 2] {
        let near = DVector::from_iterator(
            self.places.len(),
            self.places.iter().map(|other| correlation(place, other, &self.lengths)),
        );
        let mean = self.mean + near.dot(&self.weights);
        let left = 1.0 - near.dot(&self.factor.solve(&near));
        [mean, (self.variance * left.max(0.0)).sqrt()]
    }

    /// Standard deviation of one measurement about the field.
    pub fn noise(&self) -> f64 {
        (self.variance * self.noise).sqrt()
    }

    /// The same, had it measured at a place what it expects there: for the choice of several places at once (Ginsbourger et al. 2010,
    /// "kriging believer").
    #[must_use]
    pub fn believing(self, place: &[f64]) -> Self {
        let mut places = self.places.clone();
        places.push(place.to_vec());
        let values = self.values.clone().push(self.at(place)[0]);
        match Self::with(&places, &values, &self.lengths, self.noise) {
            // What is only believed makes nothing more or less variable.
            Some(sure) => Self { variance: self.variance, ..sure },
            None => self,
        }
    }
}

/// The member for which something is largest; of equals the first.
fn most(members: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let mut best = (members[0], of(members[0]));
    for &member in &members[1..] {
        let value = of(member);
        if value > best.1 {
            best = (member, value);
        }
    }
    best.0
}

fn correlation(a: &[f64], b: &[f64], lengths: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).zip(lengths).map(|((a, b), length)| ((a - b) / length).powi(2)).sum();
    let s = (5.0 * square).sqrt();
    (1.0 + s + s * s / 3.0) * (-s).exp()
}

/// How far a normally distributed value is expected to fall below `best`: (best - m) P(z) + sd p(z), z = (best - m) / sd (Mockus 1975).
pub fn expected_improvement([mean, deviation]: [f64; 2], best: f64) -> f64 {
    let gain = best - mean;
    if deviation <= 0.0 {
        return gain.max(0.0);
    }
    let z = gain / deviation;
    let probability = 0.5 * libm::erfc(-z / SQRT_2);
    gain * probability + deviation * (-0.5 * z * z).exp() / (2.0 * PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Surrogate, expected_improvement};

    fn smooth(place: &[f64]) -> f64 {
        (3.0 * place[0]).sin() + (place[1] - 0.4).powi(2)
    }

    /// Points of a plane that are spread evenly (Roberts 2018: steps of the plastic number).
    fn spread(number: usize) -> Vec<Vec<f64>> {
        (1..=number).map(|i| [0.754_877_666_2, 0.569_840_290_9].map(|step| (step * i as f64) % 1.0).to_vec()).collect()
    }

    /// Twenty points of a smooth function tell the others: of 200 places nearly all lie within two deviations, the error is a tenth of
    /// the function's scatter, and a measured point is known. The control: with the values in another order it is not small.
    #[test]
    fn a_few_points_tell_the_others() {
        let places = spread(20);
        let values: Vec<f64> = places.iter().map(|place| smooth(place)).collect();
        let rms = |fit: &Surrogate| {
            let squares = spread(200).iter().map(|place| (fit.at(place)[0] - smooth(place)).powi(2)).sum::<f64>();
            (squares / 200.0).sqrt()
        };
        let fit = Surrogate::fit(&places, &values).expect("twenty points");
        assert!(rms(&fit) < 0.03, "{}", rms(&fit));
        let inside = spread(200).into_iter().filter(|place| {
            let [mean, deviation] = fit.at(place);
            (mean - smooth(place)).abs() < 2.0 * deviation + 1e-3
        });
        assert!(inside.count() > 180);
        assert!((fit.at(&places[3])[0] - values[3]).abs() < 1e-3 && fit.at(&places[3])[1] < 1e-2);
        let mut shuffled = values.clone();
        shuffled.rotate_left(7);
        assert!(rms(&Surrogate::fit(&places, &shuffled).expect("twenty points")) > 0.2);
    }

    /// A place where it is believed to have measured is known from then on; elsewhere the mean stays.
    #[test]
    fn what_is_believed_is_known() {
        let places = spread(6);
        let values: Vec<f64> = places.iter().map(|place| smooth(place)).collect();
        let fit = Surrogate::fit(&places, &values).expect("six points");
        let (there, elsewhere) = ([0.05, 0.95], [0.5, 0.5]);
        let believing = fit.clone().believing(&there);
        // Noise has at most a tenth of the variance, so that one measurement leaves at most sqrt(0.1) of the deviation.
        assert!(believing.at(&there)[1] < 0.32 * fit.at(&there)[1]);
        assert!((believing.at(&elsewhere)[0] - fit.at(&elsewhere)[0]).abs() < 1e-6);
        assert!(Surrogate::fit(&places[..1], &values[..1]).is_none());
        assert!(Surrogate::fit(&places, &[f64::NAN; 6]).is_none());
    }

    /// Of a standard normal value half is below 0, by 0.3989 in the mean; what is sure gains what it gains.
    #[test]
    fn improvement_is_that_of_the_normal_distribution() {
        assert!((expected_improvement([0.0, 1.0], 0.0) - 0.398_942_28).abs() < 1e-8);
        assert!(
            (expected_improvement([-2.0, 0.0], 1.0) - 3.0).abs() < 1e-12
                && expected_improvement([2.0, 0.0], 1.0) == 0.0
        );
        assert!((expected_improvement([-50.0, 1.0], 0.0) - 50.0).abs() < 1e-9);
    }
}
