//! Ensembles: runs of one scene that differ in their seed, side by side on all threads, and what their mean is worth.

use crate::case::Judged;
use crate::keep;
use std::ops::RangeInclusive;
use std::sync::OnceLock;
use tsubu::student::interval_of_mean;
use tsubu_frame::{Claim, Ensemble, Origin};

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

/// The claims of a whole case, drawn once for every seed: each is judged by the interval of the mean of its values. What comes out the
/// same of every draw stays a single value, and a control has to refuse in most of them.
pub(super) fn drawn(of: &str, seeds: RangeInclusive<u64>, run: impl Fn(u64) -> Judged + Sync) -> Judged {
    let seeds: Vec<u64> = seeds.collect();
    if keep::is_spoilt() {
        // One draw shows whether a gate refuses wrong constants.
        return run(seeds[0]);
    }
    let first = OnceLock::new();
    let found = keep::runs(of, &seeds, |seed| {
        let claims = run(seed)?;
        let values = claims.iter().map(|claim| claim.value).collect();
        if seed == seeds[0] {
            let _ = first.set(claims);
        }
        Ok(values)
    })?;
    // Values alone are kept of a run that was done before.
    let first = first.into_inner().map_or_else(|| run(seeds[0]), Ok)?;
    of_draws(first, &seeds, &found)
}

/// The claims of the first draw as those of all, by the values that each draw found: all make the same claims.
pub(super) fn of_draws(first: Vec<Claim>, seeds: &[u64], values: &[Vec<f64>]) -> Judged {
    if let Some((seed, odd)) = seeds.iter().zip(values).find(|(_, values)| values.len() != first.len()) {
        return Err(format!("draw {seed} makes {} claims, the first {}", odd.len(), first.len()));
    }
    let of_claim = |i: usize| values.iter().map(|values| values[i]).collect();
    Ok(first.into_iter().enumerate().map(|(i, claim)| of_all(claim, seeds, of_claim(i))).collect())
}

/// The claim of the first draw as one of all draws.
fn of_all(claim: Claim, seeds: &[u64], values: Vec<f64>) -> Claim {
    if values.iter().all(|value| value.to_bits() == claim.value.to_bits()) {
        claim
    } else if claim.origin == Origin::Control {
        let mut sorted = values;
        sorted.sort_by(f64::total_cmp);
        let median = sorted[(sorted.len() - 1) / 2];
        Claim { value: median, pass: claim.low.is_none_or(|low| median >= low), ..claim }
    } else {
        claim.drawn(of(seeds, values))
    }
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

    /// What hangs on the draw becomes an ensemble, what does not stays a value, and a control that refuses in one draw of three fails.
    #[test]
    fn claims_are_drawn_again() {
        let source = |origin| Source::new(origin, "");
        let case = |seed: u64| {
            let control = if seed == 2 { 1.0 } else { 0.0 };
            Ok(vec![
                Claim::judge("drawn", seed as f64, Some(-2.0), Some(9.0), source(Origin::Own)),
                Claim::judge("the same", 4.0, Some(4.0), Some(4.0), source(Origin::ClosedForm)),
                Claim::judge("control", control, Some(1.0), None, source(Origin::Control)),
            ])
        };
        let claims = drawn("case", 1..=3, case).expect("claims");
        assert_eq!(claims[0].ensemble.as_ref().expect("an ensemble").members, [1.0, 2.0, 3.0]);
        assert_eq!((claims[0].value, claims[0].verdict()), (2.0, Verdict::Pass));
        assert!(claims[1].ensemble.is_none() && claims[1].pass);
        assert!(claims[2].ensemble.is_none() && !claims[2].pass && claims[2].value == 0.0);
        assert!(drawn("case", 1..=1, case).expect("claims").iter().all(|claim| claim.ensemble.is_none()));
    }

    /// A silo that jams in one draw of fifteen made a claim less there, and the program stopped with a message of its own language.
    #[test]
    fn draws_that_make_other_claims_are_told() {
        let case = |seed: u64| {
            let claim = |seed: u64| Claim::judge("n", seed as f64, None, None, Source::new(Origin::Own, ""));
            Ok((0..if seed == 8 { 1 } else { 2 }).map(|_| claim(seed)).collect())
        };
        assert_eq!(drawn("silo", 7..=9, case).err().as_deref(), Some("draw 8 makes 1 claims, the first 2"));
    }

    #[test]
    fn members_come_in_the_order_of_their_seeds() {
        let [ensemble] = members("seeds", 3..=9, |seed| Ok([seed as f64])).expect("runs");
        assert_eq!(ensemble.members, [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert!(members("none", 1..=2, |_| Err::<[f64; 1], _>("no".to_owned())).is_err());
    }
}
