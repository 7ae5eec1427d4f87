//! The steady part of a series, its mean, and how well that is known.
//!
//! The start is cut off where the standard error of what is left is smallest (MSER-5, White 1997: the marginal standard error rule on
//! means of five). A series of which more than half would be cut has no steady part, nor has one whose batches rise or fall by more than
//! chance. The error is half the 95 % interval by the means of batches: neighbouring values of a run are not independent, long batches nearly are.

/// Values a mean of the rule.
const RULE: usize = 5;
/// Batches for the error, and Student's t for 95 % at one less.
const BATCHES: (usize, f64) = (16, 2.131);
/// Student's t for 99.9 % at two less than there are batches: what their slope stays below by chance.
const TREND: f64 = 4.140;
/// Fewer values than this tell no error.
const FEWEST: usize = 4 * BATCHES.0;

/// A steady part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Steady {
    /// Index of its first value.
    pub first: usize,
    pub mean: f64,
    /// Half the 95 % interval of the mean.
    pub error: f64,
}

impl Steady {
    /// The steady part of evenly spaced values; `None` if there is none, or too little to tell.
    pub fn of(values: &[f64]) -> Option<Self> {
        let fives: Vec<f64> = values.chunks_exact(RULE).map(mean).collect();
        // From the end on, so that each cut adds one mean to the sums.
        let (mut sum, mut squares, mut best) = (0.0, 0.0, (f64::INFINITY, 0));
        let least = fives.len() / 4;
        for (first, five) in fives.iter().enumerate().rev() {
            sum += five;
            squares += five * five;
            let count = (fives.len() - first) as f64;
            let error = (squares - sum * sum / count).max(0.0) / (count * count);
            if count as usize > least && error <= best.0 {
                best = (error, first);
            }
        }
        let first = RULE * best.1;
        let rest = values.get(first..)?;
        if 2 * first > values.len() || rest.len() < FEWEST || rest.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let batches: Vec<f64> = rest.chunks_exact(rest.len() / BATCHES.0).take(BATCHES.0).map(mean).collect();
        let middle = mean(&batches);
        if trend(&batches, middle) > TREND {
            return None;
        }
        let spread = batches.iter().map(|batch| (batch - middle).powi(2)).sum::<f64>() / (BATCHES.0 - 1) as f64;
        Some(Self { first, mean: mean(rest), error: BATCHES.1 * (spread / BATCHES.0 as f64).sqrt() })
    }
}

/// The size of the slope of evenly spaced values over its standard error.
fn trend(values: &[f64], middle: f64) -> f64 {
    let at = |k: usize| k as f64 - 0.5 * (values.len() - 1) as f64;
    let wide = (0..values.len()).map(|k| at(k).powi(2)).sum::<f64>();
    let slope = values.iter().enumerate().map(|(k, value)| at(k) * value).sum::<f64>() / wide;
    let rest = values.iter().enumerate().map(|(k, value)| (value - middle - slope * at(k)).powi(2)).sum::<f64>();
    slope.abs() / (rest / (values.len() - 2) as f64 / wide).sqrt()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between -1/2 and 1/2 that look random.
    fn noise(k: usize) -> f64 {
        let x = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let x = (x ^ (x >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        (x >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    /// Of independent values the interval is that of Student: 1.96 sd / sqrt(n) and a little more, sd = 1/sqrt(12). In a hundred series it
    /// holds the true mean about 95 times.
    #[test]
    fn the_interval_holds_the_mean_as_often_as_it_says() {
        let series = |k: usize| (0..1600).map(|i| 3.0 + noise(1600 * k + i)).collect::<Vec<_>>();
        let found: Vec<Steady> = (0..100).map(|k| Steady::of(&series(k)).expect("it is steady")).collect();
        let holds = found.iter().filter(|s| (s.mean - 3.0).abs() <= s.error).count();
        assert!((85..=99).contains(&holds), "{holds}");
        let wanted = 2.131 * (1.0_f64 / 12.0 / 1600.0).sqrt();
        let typical = mean(&found.iter().map(|s| s.error).collect::<Vec<_>>());
        assert!((typical / wanted - 1.0).abs() < 0.25, "{typical} {wanted}");
    }

    /// A start that dies away as exp(-t/100) from 5 is cut off; what would grow for ever has no steady part, nor has a short series.
    #[test]
    fn a_start_is_cut_off_and_a_drift_is_told() {
        let start = |i: usize| 5.0 * (-(i as f64) / 100.0).exp();
        let settles: Vec<f64> = (0..2000).map(|i| 1.0 + start(i) + 0.2 * noise(i)).collect();
        let found = Steady::of(&settles).expect("it is steady");
        assert!((200..800).contains(&found.first), "{found:?}");
        assert!((found.mean - 1.0).abs() < 0.02, "{found:?}");
        // The control: the mean of all is far off.
        assert!((mean(&settles) - 1.0).abs() > 0.2);
        let drifts: Vec<f64> = (0..2000).map(|i| i as f64 + noise(i)).collect();
        assert_eq!(Steady::of(&drifts), None);
        // A count that begins to rise late has its smallest error with all of it, and no steady part.
        let counts: Vec<f64> = (0..600_i32).map(|i| f64::from((i - 250).max(0) / 16)).collect();
        assert_eq!(Steady::of(&counts), None);
        assert_eq!(Steady::of(&settles[..60]), None);
        assert_eq!(Steady::of(&[f64::NAN; 500]), None);
    }
}
