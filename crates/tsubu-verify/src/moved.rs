//! What moved: claims as they came out now beside those that were stored.

use tsubu_frame::{Claim, Verdict};

/// A claim that is not what was stored.
#[derive(Debug, PartialEq)]
pub struct Moved<'a> {
    /// As it was stored; none where it is new.
    pub stored: Option<&'a Claim>,
    /// As it came out; none where it is gone.
    pub now: Option<&'a Claim>,
    /// In what way, in words.
    pub how: &'static str,
}

/// The claims of a case that are not what was stored, in the order in which they came out; those that are gone last.
pub fn moved<'a>(stored: &'a [Claim], now: &'a [Claim]) -> Vec<Moved<'a>> {
    let mut left: Vec<&Claim> = stored.iter().collect();
    let mut moved = Vec::new();
    for claim in now {
        let before = left.iter().position(|old| old.name == claim.name).map(|at| left.remove(at));
        let how = before.map_or(Some("it is new"), |before| how(before, claim));
        moved.extend(how.map(|how| Moved { stored: before, now: Some(claim), how }));
    }
    moved.extend(left.into_iter().map(|claim| Moved { stored: Some(claim), now: None, how: "it is gone" }));
    moved
}

/// In what way a claim is not what was stored. Measured times are never the same: they have moved where they hold no longer.
fn how(stored: &Claim, now: &Claim) -> Option<&'static str> {
    if now.timed && (now.verdict() != Verdict::Fail || stored.verdict() == Verdict::Fail) {
        return None;
    }
    if stored.verdict() != now.verdict() {
        return Some(match now.verdict() {
            Verdict::Pass => "it passes now",
            Verdict::Fail => "it fails now",
            Verdict::Undecided => "it is undecided now",
        });
    }
    if stored.value == now.value || stored.value.is_nan() && now.value.is_nan() {
        return None;
    }
    match [stored, now].map(interval) {
        [Some(before), _] if !within(before, now.value) => Some("its mean lies outside the stored interval"),
        [_, Some(after)] if !within(after, stored.value) => Some("the stored mean lies outside its interval"),
        [Some(_), _] | [_, Some(_)] => None,
        // Not-a-number beside a number is far away.
        [None, None] if (now.value - stored.value).abs() <= 0.1 * scale(stored) => None,
        [None, None] => Some("by more than a tenth of its accepted range"),
    }
}

fn interval(claim: &Claim) -> Option<[f64; 2]> {
    claim.ensemble.as_ref()?.interval.as_slice().try_into().ok()
}

fn within([from, to]: [f64; 2], value: f64) -> bool {
    value >= from && value <= to
}

/// How wide the accepted range is. One with a single end is as wide as the value is away from it, or as that end is from zero; without
/// a range there is only the value.
fn scale(stored: &Claim) -> f64 {
    match (stored.low, stored.high) {
        (Some(low), Some(high)) => high - low,
        (Some(end), None) | (None, Some(end)) => (stored.value - end).abs().max(end.abs()),
        (None, None) => stored.value.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu_frame::{Ensemble, Origin, Source};

    fn single(value: f64, low: Option<f64>, high: Option<f64>) -> Claim {
        Claim::judge("x", value, low, high, Source::new(Origin::Own, "a test"))
    }

    fn mean(members: [f64; 2], half: f64) -> Claim {
        let middle = 0.5 * (members[0] + members[1]);
        let interval = vec![middle - half, middle + half];
        let ensemble = Ensemble { seeds: vec![1, 2], members: members.to_vec(), interval };
        Claim::judge_ensemble("x", ensemble, Some(0.0), Some(10.0), Source::new(Origin::Own, "a test"))
    }

    fn how_of(stored: &Claim, now: &Claim) -> Option<&'static str> {
        let (stored, now) = ([stored.clone()], [now.clone()]);
        moved(&stored, &now).first().map(|moved| moved.how)
    }

    #[test]
    fn a_value_moves_by_a_tenth_of_its_range_or_by_its_verdict() {
        let of = |value| single(value, Some(0.0), Some(10.0));
        assert_eq!(how_of(&of(5.0), &of(5.9)), None);
        assert_eq!(how_of(&of(5.0), &of(6.1)), Some("by more than a tenth of its accepted range"));
        assert_eq!(how_of(&of(9.9), &of(10.1)), Some("it fails now"));
        assert_eq!(how_of(&of(10.1), &of(9.9)), Some("it passes now"));
        assert_eq!(how_of(&of(f64::NAN), &of(f64::NAN)), None);
        // A residual far below its only end may be another one; a count of gates may not.
        assert_eq!(how_of(&single(1e-12, None, Some(1e-6)), &single(3e-12, None, Some(1e-6))), None);
        assert!(how_of(&single(3.0, Some(1.0), None), &single(2.0, Some(1.0), None)).is_some());
    }

    /// Members that scatter widely say little: what lies in the interval has not moved.
    #[test]
    fn an_ensemble_moves_out_of_its_interval_either_way() {
        assert_eq!(how_of(&mean([4.0, 6.0], 1.0), &mean([4.5, 6.5], 1.0)), None);
        let out = how_of(&mean([4.0, 6.0], 0.3), &mean([4.5, 6.5], 2.0));
        assert_eq!(out, Some("its mean lies outside the stored interval"));
        let conversely = how_of(&mean([4.0, 6.0], 2.0), &mean([4.5, 6.5], 0.3));
        assert_eq!(conversely, Some("the stored mean lies outside its interval"));
        assert_eq!(how_of(&mean([4.0, 6.0], 1.0), &mean([4.0, 6.0], 9.0)), Some("it is undecided now"));
    }

    #[test]
    fn a_measured_time_moves_where_it_fails() {
        let timed = |value| Claim { timed: true, ..single(value, Some(50.0), None) };
        assert_eq!(how_of(&timed(90.0), &timed(300.0)), None);
        assert_eq!(how_of(&timed(90.0), &timed(40.0)), Some("it fails now"));
        assert_eq!(how_of(&timed(40.0), &timed(10.0)), None);
        assert!(how_of(&single(90.0, Some(50.0), None), &single(300.0, Some(50.0), None)).is_some());
    }

    #[test]
    fn new_and_lost_claims_are_told() {
        let named = |name: &str| Claim { name: name.to_owned(), ..single(1.0, None, None) };
        let (stored, now) = ([named("a"), named("b"), named("b")], [named("b"), named("c"), named("b")]);
        let found: Vec<_> = moved(&stored, &now).iter().map(|moved| moved.how).collect();
        assert_eq!(found, ["it is new", "it is gone"]);
    }
}
