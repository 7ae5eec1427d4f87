//! The standing guards: fuzzers, kills.

use crate::shell::{command, program, run};

/// A guard with its arguments.
pub fn guard(name: &str, arguments: &[&str]) -> Result<(), String> {
    run(command(&program("tsubu-guard")?, &[&[name], arguments].concat()))
}

/// What must hold in every change: under a minute of cases, a few kills.
pub fn quick() -> Result<(), String> {
    // The same cases each time.
    guard("fuzz", &["--seconds", "60", "--cases", "10000"])?;
    guard("kills", &["--kills", "6"])
}
