//! What must pass before a change goes in, with Rust and a C compiler alone.

use crate::shell::{cargo, cargo_path, command, run};
use crate::{format, generate, guard, spelling, test};

/// Everything, the quick things first; the tests only if `tests`.
pub fn check(tests: bool) -> Result<(), String> {
    format::check()?;
    spelling::check()?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"])?;
    let mut documentation = command(&cargo_path(), &["doc", "--workspace", "--no-deps", "--quiet"]);
    documentation.env("RUSTDOCFLAGS", "-D warnings");
    run(documentation)?;
    generate::check()?;
    if tests {
        test::test()?;
    }
    guard::smoke()
}

/// What takes longer.
pub fn patient() -> Result<(), String> {
    test::patient()?;
    guard::quick()
}
