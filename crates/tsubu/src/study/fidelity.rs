//! Two fidelities: what a dear model gives, told by few of its runs and many of a cheap one.
//!
//! dear(x) = rho cheap(x) + difference(x), with a Gaussian process for the cheap model and one for the difference, each independent of the other
//! (Kennedy and O'Hagan 2000, 2.2); rho is the most likely of a list. Where rho is 0 the cheap model tells nothing, and what is left is the
//! process of the dear one alone.

use super::surrogate::Surrogate;

/// Factors that are tried.
const FACTORS: usize = 16;
const STEP: f64 = 0.1;

/// What is known of a dear model by way of a cheap one.
#[derive(Clone, Debug)]
pub struct TwoFidelities {
    /// rho.
    pub factor: f64,
    difference: Surrogate,
}

impl TwoFidelities {
    /// Fits values of the dear model at places where the cheap one is expected to give `cheap`; with zeros for these it is the process of the
    /// dear model alone. `None` as of [`Surrogate::fit`].
    pub fn fit(places: &[Vec<f64>], values: &[f64], cheap: &[f64]) -> Option<Self> {
        let with = |factor: f64| {
            let left: Vec<f64> = values.iter().zip(cheap).map(|(dear, cheap)| dear - factor * cheap).collect();
            Some(Self { factor, difference: Surrogate::fit(places, &left)? })
        };
        if cheap.iter().all(|value| *value == 0.0) {
            return with(0.0);
        }
        let all = (0..FACTORS).filter_map(|i| with(i as f64 * STEP));
        all.reduce(|best, one| if one.difference.likelihood() > best.difference.likelihood() { one } else { best })
    }

    /// What is expected of the dear model at a place, and its standard deviation, from the same of the cheap one.
    pub fn at(&self, place: &[f64], cheap: [f64; 2]) -> [f64; 2] {
        let [mean, deviation] = self.difference.at(place);
        [mean + self.factor * cheap[0], deviation.hypot(self.factor * cheap[1])]
    }

    /// The same, had it measured at a place what it expects there.
    #[must_use]
    pub fn believing(self, place: &[f64]) -> Self {
        Self { factor: self.factor, difference: self.difference.believing(place) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pair of Forrester, Sobester and Keane (2007), of one coordinate: dear f(x) = (6 x - 2)^2 sin(12 x - 4), cheap f/2 + 10 (x - 1/2) - 5. rho is 2
    /// there, and the difference a straight line; here the dear one is halved, so that rho is 1. Five places of the dear model then tell it to a
    /// twentieth of its scatter. Control: without the cheap one they do not, to a half.
    #[test]
    fn a_cheap_model_tells_what_few_runs_do_not() {
        let dear = |x: f64| 0.5 * (6.0 * x - 2.0).powi(2) * (12.0 * x - 4.0).sin();
        let cheap = |x: f64| dear(x) + 10.0 * (x - 0.5) - 5.0;
        let places =
            |number: usize| -> Vec<Vec<f64>> { (0..number).map(|i| vec![i as f64 / (number - 1) as f64]).collect() };
        let many = places(21);
        let process =
            Surrogate::fit(&many, &many.iter().map(|at| cheap(at[0])).collect::<Vec<_>>()).expect("21 places");
        let few = places(5);
        let values: Vec<f64> = few.iter().map(|at| dear(at[0])).collect();
        let miss = |known: &[f64], told: &dyn Fn(&[f64]) -> [f64; 2]| {
            let fit = TwoFidelities::fit(&few, &values, known).expect("five places");
            let squares: Vec<f64> =
                places(100).iter().map(|at| (fit.at(at, told(at))[0] - dear(at[0])).powi(2)).collect();
            (fit.factor, (squares.iter().sum::<f64>() / 100.0).sqrt())
        };
        let mean = places(100).iter().map(|at| dear(at[0])).sum::<f64>() / 100.0;
        let scatter = (places(100).iter().map(|at| (dear(at[0]) - mean).powi(2)).sum::<f64>() / 100.0).sqrt();
        let expected: Vec<f64> = few.iter().map(|at| process.at(at)[0]).collect();
        let (factor, both) = miss(&expected, &|at| process.at(at));
        let (none, alone) = miss(&[0.0; 5], &|_| [0.0; 2]);
        assert!((factor - 1.0).abs() < 0.05 && none == 0.0, "{factor}");
        assert!(both < 0.05 * scatter && alone > 0.5 * scatter, "{both} {alone} {scatter}");
    }

    /// A cheap model that has nothing to do with the dear one gets the factor 0, or next to it: the difference is then simpler.
    #[test]
    fn a_cheap_model_that_tells_nothing_is_left_out() {
        let places: Vec<Vec<f64>> = (0..12).map(|i| vec![f64::from(i) / 11.0]).collect();
        let values: Vec<f64> = places.iter().map(|at| (2.0 * at[0]).sin()).collect();
        let cheap: Vec<f64> = (0..12).map(|i| f64::from((i * 7) % 5)).collect();
        let fit = TwoFidelities::fit(&places, &values, &cheap).expect("twelve places");
        assert_eq!(fit.factor, 0.0);
    }
}
