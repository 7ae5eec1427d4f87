//! The benchmarks.

use crate::shell::cargo;

/// Runs them all, or what the arguments choose.
pub fn bench(arguments: &[&str]) -> Result<(), String> {
    let mut words = vec!["bench", "--package", "tsubu"];
    words.extend(arguments);
    cargo(&words)
}
