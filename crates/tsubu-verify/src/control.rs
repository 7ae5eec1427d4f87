//! Controls: which wrong model refuses which claim.
//!
//! A control is a wrong model, run through the same code and held against a copy of a claim's gate. A copy measures the same
//! thing: what a name says after its last colon, whatever the numbers in it.

use tsubu_frame::{Claim, Origin, Source, Verdict};

/// How the name of a control begins.
const WRONG: &str = "wrong on purpose: ";

/// What is wrong in the second run of a case: its perturbation.
pub(crate) const SPOILT: f64 = 0.95;

/// A gate that refuses: one whose interval reaches into the range has decided nothing.
fn refuses(gate: &Claim) -> bool {
    gate.verdict() == Verdict::Fail
}

/// A claim that a wrong model is refused by at least so many of the same gates.
pub(super) fn refused(what: &str, gates: &[Claim], least: u32) -> Claim {
    let refuses = gates.iter().filter(|gate| refuses(gate)).map(|gate| gate.name.clone()).collect();
    Claim { refuses, ..refused_number(what, gates, least) }
}

/// The same for a number or a formula that was never run: it shows that a gate can fail, and controls no claim.
pub(super) fn refused_number(what: &str, gates: &[Claim], least: u32) -> Claim {
    let count = gates.iter().filter(|gate| refuses(gate)).count();
    let name = format!("{WRONG}{what}: gates that refuse it, of {}", gates.len());
    let source = Source::new(Origin::Control, "a gate can fail (studies/README.md)");
    Claim::judge(name, count as f64, Some(f64::from(least)), None, source)
}

/// Tells every claim of a case the controls that refuse it.
pub(super) fn attach(claims: &mut [Claim]) {
    let controls: Vec<(String, Vec<String>)> = claims
        .iter()
        .filter(|c| c.pass && !c.refuses.is_empty())
        .map(|c| (wrong(&c.name), c.refuses.clone()))
        .collect();
    for claim in claims.iter_mut().filter(|claim| claim.origin != Origin::Control) {
        let refuse = controls.iter().filter(|(_, gates)| gates.iter().any(|gate| copies(gate, &claim.name)));
        claim.controls.extend(refuse.map(|(what, _)| what.clone()));
        // The same may be done wrong to two models.
        claim.controls.dedup();
    }
}

/// Tells every claim that holds whether it holds no more where the constants of its case are 5 % too small.
pub(super) fn attach_spoilt(claims: &mut [Claim], spoilt: &[Claim]) {
    let refused: Vec<&Claim> = spoilt.iter().filter(|claim| refuses(claim)).collect();
    for claim in claims.iter_mut().filter(|claim| claim.pass && claim.origin != Origin::Control) {
        if refused.iter().any(|other| copies(&other.name, &claim.name)) {
            claim.controls.push("the case's constants 5 % too small".to_owned());
        }
    }
}

/// Whether a claim holds and nothing was shown that it does not hold for.
pub fn is_missing(claim: &Claim) -> bool {
    claim.pass && claim.controls.is_empty() && !matches!(claim.origin, Origin::Control | Origin::Regression)
}

/// What is wrong in a control, of its name.
fn wrong(name: &str) -> String {
    let what = name.strip_prefix(WRONG).unwrap_or(name);
    what.rsplit_once(": ").map_or(what, |(what, _)| what).to_owned()
}

/// Whether two gates measure the same thing.
fn copies(gate: &str, claim: &str) -> bool {
    let quantity = |name: &str| -> String {
        let measured = name.rsplit_once(": ").map_or(name, |(_, measured)| measured);
        measured.chars().filter(|c| !c.is_ascii_digit() && !matches!(c, '.' | '-' | '+')).collect()
    };
    gate == claim || !quantity(gate).is_empty() && quantity(gate) == quantity(claim)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A control knows of the claims that it copies, and of no others; a number that was not run is no control, and what is left undecided of
    /// a wrong model is not refused.
    #[test]
    fn a_control_refuses_the_claims_whose_gate_it_copies() {
        let gate = |name: &str, value: f64| Claim::judge(name, value, None, Some(1.0), Source::new(Origin::Own, ""));
        let wrong = [gate("b, 3 rows: height", 2.0), gate("b, 3 rows: width", 0.0)];
        let number = refused_number("a formula", &[gate("b: width", 7.0)], 1);
        let mut claims = vec![gate("a, 5 rows: height", 0.5), gate("a, 5 rows: width", 0.5), number];
        claims.push(refused("a bed of water", &wrong, 1));
        attach(&mut claims);
        assert_eq!(claims[0].controls, ["a bed of water"]);
        assert!(is_missing(&claims[1]) && !is_missing(&claims[3]));
        let between = crate::ensemble::of(&[1, 2, 3], vec![0.9, 1.0, 1.3]);
        let open = [gate("a: height", 1.0).drawn(between), gate("a: width", f64::NAN)];
        assert_eq!(
            (refused("few draws", &open, 1).value, &*refused("few draws", &open, 1).refuses),
            (1.0, &["a: width".to_owned()][..])
        );
        attach_spoilt(&mut claims, &[gate("a, 5 rows: height", 0.5), gate("a, 5 rows: width", 1.5)]);
        assert_eq!(claims[1].controls.len(), 1);
        assert_eq!(claims[0].controls.len(), 1);
    }
}
