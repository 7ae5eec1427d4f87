//! The standing guards: fuzzers, kills.

use crate::shell::cargo;

/// A guard with its arguments.
pub fn guard(name: &str, arguments: &[&str]) -> Result<(), String> {
    // Some cases are calls of the program.
    cargo(&["build", "--package", "tsubu-cli", "--package", "tsubu-guard", "--quiet"])?;
    cargo(&[&["run", "--package", "tsubu-guard", "--quiet", "--", name], arguments].concat())
}

/// What must hold in every change: a minute of cases, a few kills.
pub fn quick() -> Result<(), String> {
    // The same cases each time.
    guard("fuzz", &["--seconds", "60", "--cases", "15000"])?;
    guard("kills", &["--kills", "6"])
}
