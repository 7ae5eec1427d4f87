//! Ensembles: runs of one scene that differ in their seed, side by side on all threads, and what their mean is worth.

use crate::keep;
use std::ops::RangeInclusive;
use tsubu::student::interval_of_mean;
use tsubu_frame::Ensemble;

/// Runs one member for every seed; they come in the order of the seeds whatever the threads. `of` says what is run, in words that no
/// other ensemble of the case has: an interrupted verification finds its runs again by it.
pub(super) fn members<const N: usize>(
    of: &str,
    seeds: RangeInclusive<u64>,
    run: impl Fn(u64) -> Result<[f64; N], String> + Sync,
) -> Result<[Ensemble; N], String> {
    let seeds: Vec<u64> = seeds.collect();
    let found = keep::members(of, &seeds, run)?;
    Ok(std::array::from_fn(|i| self::of(&seeds, found.iter().map(|values| values[i]).collect())))
}

/// The members with the 95 % confidence interval of their mean, by Student's t.
pub(super) fn of(seeds: &[u64], members: Vec<f64>) -> Ensemble {
    let interval = interval_of_mean(&members).to_vec();
    Ensemble { seeds: seeds.to_vec(), members, interval }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu_frame::{Claim, Origin, Source, Verdict};

    /// A mean that happens to lie in the range is no pass where its interval does not.
    #[test]
    fn an_ensemble_passes_fails_or_is_undecided() {
        let members = [0.9, 1.0, 1.1, 1.0];
        let judged = |low, high| {
            let source = Source::new(Origin::Own, "");
            Claim::judge_ensemble("n", of(&[1, 2, 3, 4], members.to_vec()), low, high, source).verdict()
        };
        assert_eq!(judged(Some(0.8), Some(1.2)), Verdict::Pass);
        assert_eq!(judged(Some(0.95), Some(1.2)), Verdict::Undecided);
        assert_eq!(judged(None, Some(0.95)), Verdict::Undecided);
        assert_eq!(judged(Some(1.2), None), Verdict::Fail);
        assert_eq!(judged(None, Some(f64::NAN)), Verdict::Fail);
    }

    #[test]
    fn members_come_in_the_order_of_their_seeds() {
        let [ensemble] = members("seeds", 3..=9, |seed| Ok([seed as f64])).expect("runs");
        assert_eq!(ensemble.members, [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert!(members("none", 1..=2, |_| Err::<[f64; 1], _>("no".to_owned())).is_err());
    }
}
