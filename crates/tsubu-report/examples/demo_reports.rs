//! Writes one report of each kind from made-up results, to be looked at: `cargo run --example demo_reports -- DIR`.

#![allow(clippy::unwrap_used)]

#[path = "../tests/main/fixture.rs"]
mod fixture;

fn main() {
    let dir = std::path::PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "demo-reports".into()));
    fixture::run(&dir.join("swinging-box"), "dem", 60);
    fixture::response(&dir.join("damper-response"));
    fixture::compare(&dir.join("two-methods"));
    fixture::sweep(&dir.join("sweep"));
    fixture::calibration(&dir.join("calibration"));
    fixture::verify(&dir.join("verification"), false);
    for name in ["swinging-box", "damper-response", "two-methods", "sweep", "calibration", "verification"] {
        println!("{}", tsubu_report::report(&dir.join(name)).unwrap().page.display());
    }
}
