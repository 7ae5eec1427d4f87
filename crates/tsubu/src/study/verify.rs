//! Verification: every claim re-run by one command.

mod bench;
mod contact;

use tsubu_frame::Claim;

/// One verification case: a few claims from one set of runs.
pub struct Case {
    /// Name, as in `tsubu verify NAME`.
    pub name: &'static str,
    /// Study it belongs to; `tsubu verify STUDY` runs all its cases.
    pub study: &'static str,
    /// One line.
    pub about: &'static str,
    /// Minutes rather than seconds: only with `--all`, or when asked for by its own name.
    pub long: bool,
    /// Runs it. The factor multiplies the constants of the contact law; 1 but in the tests that show that the
    /// claims can fail.
    pub run: fn(spoiler: f64) -> Result<Vec<Claim>, String>,
}

/// All cases, in the order they are listed and run.
pub static CASES: &[Case] = &[Case {
    name: "restitution",
    study: "contact",
    about: "V-05: restitution in = restitution out, for every damping form, at wall and pair",
    long: false,
    run: contact::restitution,
}];

/// The cases that the given names choose: case names or study names; none given means all quick ones.
/// Fails with the first name that is neither.
pub fn chosen(names: &[String], all: bool) -> Result<Vec<&'static Case>, String> {
    if names.is_empty() {
        return Ok(CASES.iter().filter(|c| all || !c.long).collect());
    }
    let mut chosen = Vec::new();
    for name in names {
        let before = chosen.len();
        chosen.extend(CASES.iter().filter(|c| c.name == name || (c.study == name && (all || !c.long))));
        if chosen.len() == before {
            return Err(format!("there is no verification case or study `{name}`; `tsubu verify --list` shows them"));
        }
    }
    Ok(chosen)
}

impl Case {
    /// Runs the case; its claims carry its study's name.
    pub fn claims(&self) -> Result<Vec<Claim>, String> {
        Ok((self.run)(1.0)?.into_iter().map(|c| c.of(self.study)).collect())
    }
}
