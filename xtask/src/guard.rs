//! The standing guards: fuzzers, kills, one answer in every way.

use crate::shell::{command, program, released, run};

/// A guard with its arguments.
pub fn guard(name: &str, arguments: &[&str]) -> Result<(), String> {
    run(command(&program("tsubu-guard")?, &[&[name], arguments].concat()))
}

/// A guard of the program as users have it.
pub fn of_released(name: &str, arguments: &[&str]) -> Result<(), String> {
    guard(name, &[&["--tsubu", &released()?], arguments].concat())
}

/// That every scene runs, and gives on other threads, cut and with frames what it gives without.
pub fn smoke() -> Result<(), String> {
    guard("variants", &["--quick", "--last-way"])
}

/// What must hold in every change: every scene in all ways, under a minute of cases, a few kills.
pub fn quick() -> Result<(), String> {
    guard("variants", &["--quick"])?;
    // The same cases each time.
    guard("fuzz", &["--seconds", "60", "--cases", "10000"])?;
    guard("kills", &["--kills", "6"])
}
