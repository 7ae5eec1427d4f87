//! The verification cases pass, and can fail.

use tsubu::study::verify::{CASES, chosen};

/// The quick cases that take a few seconds pass.
#[test]
fn quick_cases_pass() {
    for name in ["restitution", "drop-dem", "drop-lattice", "lump", "figure-9"] {
        for case in chosen(&[name.to_owned()], false).unwrap() {
            for claim in case.claims().unwrap() {
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
    for name in ["restitution", "drop-dem", "drop-lattice"] {
        let case = CASES.iter().find(|c| c.name == name).unwrap();
        let claims = (case.run)(0.95).unwrap();
        assert!(claims.iter().any(|c| !c.pass), "{name}: nothing noticed a law wrong by 5 %");
    }
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
