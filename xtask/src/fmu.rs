//! Units for co-simulation: packed, and validated and moved by FMPy.

use crate::python::{environment, recent};
use crate::shell::{command, program, root, run};

/// Packs units and tests them; says so where there is no Python or no network.
pub fn fmu(arguments: &[&str]) -> Result<(), String> {
    if !recent() {
        return skipped("there is no Python 3.10 or later with `venv`");
    }
    let requirements = root().join("crates/tsubu-fmu/tests/requirements.txt");
    let home = root().join("target/fmu-test");
    let Some(python) = environment(&home, &["-r", &requirements.to_string_lossy()]) else {
        return skipped("FMPy cannot be installed: is there a network?");
    };
    let mut test = command(&python.to_string_lossy(), &["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]);
    test.env("TSUBU_FMU", program("tsubu-fmu")?).env("TSUBU", program("tsubu")?);
    test.args(arguments).arg("crates/tsubu-fmu/tests");
    run(test)
}

#[expect(clippy::unnecessary_wraps, reason = "how the chore ends there")]
fn skipped(why: &str) -> Result<(), String> {
    eprintln!("\nSKIPPED: units for co-simulation are not tested, for {why}");
    Ok(())
}
