//! Every case is a test of its own, made from the list of cases: none can be forgotten, and one that fails hides no other.
//!
//! Quick cases that take more than a few seconds are named `patient::` and run by `cargo xtask patient`.
//! Long cases are ignored unless asked for: `cargo nextest run --release -p tsubu-verify --run-ignored only beverloo`.

use libtest_mimic::{Arguments, Failed, Trial, run};
use std::fmt::Write;
use tsubu_frame::Claim;
use tsubu_verify::{CASES, Case, Moved, moved, recorded};

/// Quick cases above this budget [s] wait for whoever has patience: they would take most of the time of all tests. Those up to it run a
/// second time, with a law that is wrong, unless they try something wrong of their own; the others do so when they are asked to.
const PROMPT: u32 = 5;

/// So does this one, several times as slow as in a release.
const SLOWER_IN_TESTS: &[&str] = &["pull-off"];

/// Cases against closed forms: a wrong law must show in a third of their claims at least. What is left holds for any constants:
/// energy, rest, symmetry, and rates on which these constants have no say.
const CLOSED_FORMS: &[&str] = &[
    "centrifuging",
    "chung-ooi-no-slip",
    "chung-ooi-normal",
    "chung-ooi-oblique",
    "chung-ooi-restitution",
    "chung-ooi-sliding",
    "chung-ooi-spin",
    "contact-time",
    "damped-contact",
    "damping-published",
    "drop-dem",
    "drop-lattice",
    "fhp-collisions",
    "gutt-haff",
    "haff",
    "incline",
    "overlap-band",
    "pull-off",
    "pushed-row",
    "rebound-on-steel",
    "restitution",
    "restitution-shapes",
    "rolling-models",
    "settling",
    "slide-to-roll",
    "spin-down",
    "stacked",
    "starts-to-roll",
    "tangential-spring",
    "three-spheres",
];

/// Cases that no factor reaches and that try nothing wrong of their own: a list that may only become shorter.
const CANNOT_FAIL: &[&str] = &[];

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    for case in CASES {
        let slow = case.budget > PROMPT || SLOWER_IN_TESTS.contains(&case.name);
        let patient = case.is_quick() && slow;
        let kind = if patient { "patient::" } else { "" };
        let passes = Trial::test(format!("{kind}{}::passes", case.name), || passes(case));
        trials.push(passes.with_ignored_flag(!case.is_quick() || patient));
        let asked = !case.is_quick() || case.budget > PROMPT || tries_something_wrong(case);
        let kind = if asked { "" } else { kind };
        let can_fail = Trial::test(format!("{kind}{}::can_fail", case.name), || can_fail(case));
        trials.push(can_fail.with_ignored_flag(asked || patient));
    }
    trials.push(Trial::test("lists::name_cases", lists_name_cases));
    run(&arguments, trials).exit();
}

/// All its claims hold, and are what was kept of them.
fn passes(case: &Case) -> Result<(), Failed> {
    let (claims, kept) = (case.claims(None)?, recorded(case.name));
    let mut wrong = String::new();
    for claim in claims.iter().filter(|claim| !claim.pass) {
        let _ = writeln!(wrong, "{} = {} not in {:?}..{:?}", claim.name, claim.value, claim.low, claim.high);
    }
    for Moved { stored, now, how } in moved(&kept, &claims).into_iter().filter(|_| !kept.is_empty()) {
        let name = now.or(stored).map_or("", |claim| &claim.name);
        let [kept, now] = [stored, now].map(|claim| claim.map(|claim| claim.value));
        let _ = writeln!(wrong, "{name}: kept {kept:?}, now {now:?}: {how}; `cargo xtask claims {}`", case.name);
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.into()) }
}

/// Whether it is held by its own controls alone, which must pass with it.
fn tries_something_wrong(case: &Case) -> bool {
    !CLOSED_FORMS.contains(&case.name) && recorded(case.name).iter().any(own)
}

/// Whether a claim is that something wrong on purpose was refused.
fn own(claim: &Claim) -> bool {
    claim.name.starts_with("wrong on purpose")
}

/// It notices that the constants of the law are 5 % too small, or it tries something wrong itself.
fn can_fail(case: &Case) -> Result<(), Failed> {
    let claims = (case.run)(0.95)?;
    let refused = claims.iter().filter(|claim| !claim.pass).count();
    let wanted = if CLOSED_FORMS.contains(&case.name) { claims.len().div_ceil(3) } else { 1 };
    let can = refused >= wanted || wanted == 1 && claims.iter().any(own);
    match (can, CANNOT_FAIL.contains(&case.name)) {
        (true, false) | (false, true) => Ok(()),
        (false, false) => Err(format!("a law wrong by 5 % fails {refused} of {} claims", claims.len()).into()),
        (true, true) => Err("it can fail now: take it from the list `CANNOT_FAIL`".into()),
    }
}

/// What the lists name is there and is tested.
fn lists_name_cases() -> Result<(), Failed> {
    let known = |name: &str| CASES.iter().any(|case| case.name == name && case.is_quick());
    match CLOSED_FORMS.iter().chain(CANNOT_FAIL).find(|name| !known(name)) {
        Some(name) => Err(format!("`{name}` is no quick case").into()),
        None => Ok(()),
    }
}
