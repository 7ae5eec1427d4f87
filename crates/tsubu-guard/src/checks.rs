//! Judges what `tsubu check` makes of a scene that was accepted: the engine is built and goes a little way.

use crate::bundle::Bundle;
use crate::outcome::Outcome;
use crate::reading;
use std::path::Path;
use tsubu::trial;

/// Checks the scene of a bundle.
pub fn judge(bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    let Ok(scene) = reading::read(bundle, &folder.join("scene")) else { return Ok(Outcome::Refused) };
    let text = match trial::check(scene.plan(), trial::Target::default(), &mut |_, _| ()) {
        Ok(verdict) => verdict.to_string(),
        Err(refusal) => refusal.to_string(),
    };
    match text.lines().find(|line| line.contains("NaN")) {
        Some(line) => Err(format!("says what is no number: {line}")),
        None => Ok(Outcome::Accepted),
    }
}
