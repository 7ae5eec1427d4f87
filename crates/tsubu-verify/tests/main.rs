//! The verification cases pass, and can fail.
#![allow(clippy::unwrap_used, reason = "a test that panics is a test that fails")]

use tsubu_verify::{CASES, chosen};

/// Cases against closed forms.
const CLOSED_FORMS: &[&str] = &[
    "chung-ooi-normal",
    "chung-ooi-restitution",
    "chung-ooi-oblique",
    "chung-ooi-sliding",
    "chung-ooi-no-slip",
    "chung-ooi-spin",
    "restitution-shapes",
    "damping-published",
    "tangential-spring",
    "three-spheres",
    "stacked",
    "pull-off",
    "slide-to-roll",
    "incline",
    "spin-down",
    "rolling-models",
    "haff",
    "centrifuging",
    "q-model",
    "rebound-on-steel",
    "starts-to-roll",
    "fhp-collisions",
    "contact-time",
    "damped-contact",
    "overlap-band",
    "pushed-row",
];

/// Lattice models of beds and piles, the fast ones.
const ON_LATTICES: &[&str] = &["litwiniszyn", "gutt-haff", "hemmingsson-herrmann"];

/// Single grains and packed columns in water.
const IN_WATER: &[&str] = &["settling", "released", "spin-in-water", "wet-rebound", "packed-column"];

/// Grains made of lattice points.
const CL_CA: &[&str] = &["collapse", "convection", "poured-heap", "pushed-plate", "turning"];

/// The quick cases that take a few seconds pass.
#[test]
fn quick_cases_pass() {
    let others = ["restitution", "drop-dem", "drop-lattice", "lump", "figure-9", "bed-at-rest", "fluidised"];
    for name in others.iter().chain(CL_CA).chain(IN_WATER).chain(ON_LATTICES).chain(CLOSED_FORMS) {
        for case in chosen(&[(*name).to_owned()], false).unwrap() {
            for claim in case.claims(None).unwrap() {
                assert!(
                    claim.pass,
                    "{name}: {} = {} not in {:?}..{:?}",
                    claim.name, claim.value, claim.low, claim.high
                );
            }
        }
    }
}

/// With the constants of the law changed by 5 % the study's claims fail.
#[test]
fn claims_can_fail() {
    for name in ["restitution", "drop-dem", "drop-lattice"].iter().chain(IN_WATER).chain(ON_LATTICES) {
        let case = CASES.iter().find(|c| c.name == *name).unwrap();
        let claims = (case.run)(0.95).unwrap();
        assert!(claims.iter().any(|c| !c.pass), "{name}: nothing noticed a law wrong by 5 %");
    }
}

/// Of the claims of these cases most are refused when the law is wrong by 5 %; what is left holds for any constants:
/// energy, rest, symmetry, and rates on which these constants have no say.
#[test]
fn most_claims_of_closed_forms_fail() {
    let mut weak = Vec::new();
    for name in CLOSED_FORMS {
        let case = CASES.iter().find(|c| c.name == *name).unwrap();
        let claims = (case.run)(0.95).unwrap();
        let failed = claims.iter().filter(|c| !c.pass).count();
        println!("{name}: {failed} of {}", claims.len());
        if 3 * failed < claims.len() {
            weak.push(format!("{name}: {failed} of {}", claims.len()));
        }
    }
    assert!(weak.is_empty(), "{weak:?}");
}

/// Names and studies do not clash, so that a name means one thing.
#[test]
fn names_are_unique() {
    for (i, case) in CASES.iter().enumerate() {
        assert!(CASES[i + 1..].iter().all(|c| c.name != case.name), "{} twice", case.name);
        assert!(CASES.iter().all(|c| c.study != case.name), "{} is a study too", case.name);
    }
    assert!(chosen(&["no such case".to_owned()], false).is_err());
}
