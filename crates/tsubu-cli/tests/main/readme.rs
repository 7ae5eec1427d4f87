use crate::support::{Desk, shortened};
use std::path::Path;

/// A page of the project.
fn page(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)).unwrap()
}

/// The commands that the book's table of what works names, in order.
fn named_commands() -> Vec<String> {
    let text = page("docs/src/what-works.md");
    let rows = text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| what "));
    let shown = rows.map(|row| row.trim_end_matches(" |").rsplit("| ").next().unwrap().trim_matches('`'));
    // The doors to Python, to co-simulation and to clusters have tests of their own.
    let commands = shown.filter(|shown| {
        !["cargo xtask python", "cargo xtask fmu", "cargo xtask cluster", "cargo xtask mpi"].contains(shown)
    });
    commands
        .map(|shown| shown.strip_prefix("tsubu ").unwrap_or_else(|| panic!("no command: `{shown}`")).to_owned())
        .collect()
}

/// What the README names is a row of the table, so it works; and the README is read in minutes.
#[test]
fn the_readme_names_what_works_and_is_short() {
    let readme = page("README.md");
    assert!(readme.lines().count() <= 120, "the README has {} lines", readme.lines().count());
    let section = readme.split("## What works today").nth(1).unwrap().split("\n## ").next().unwrap();
    let bullets = section.split("\n- ").skip(1);
    // That of Python names a page instead.
    let shown: Vec<&str> = bullets.filter_map(|bullet| bullet.split("`tsubu ").nth(1)?.split('`').next()).collect();
    assert_eq!(shown.len(), 9);
    let known = named_commands();
    for command in shown {
        let listed = known.iter().any(|row| row == command) || ["verify --list", "view out/hopper"].contains(&command);
        assert!(listed, "`tsubu {command}` is not in docs/src/what-works.md");
    }
}

mod patient {
    use super::*;

    /// Every row of the table is true: its command ends well. Runs are cut short; verification cases are tested by name, and
    /// run in full elsewhere.
    #[test]
    #[ignore = "18 s: cargo xtask patient"]
    fn every_row_of_what_works_does() {
        let desk = Desk::empty();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let known = desk.done("verify --list").stdout;
        let commands = named_commands();
        assert!(commands.len() > 15, "the table is gone");
        for (index, command) in commands.iter().enumerate() {
            let command = command.replace("scenes/", &format!("{}/scenes/", root.display()));
            let folder = format!("row{index}");
            if let Some(names) = command.strip_prefix("verify ") {
                for name in names.split_whitespace() {
                    assert!(
                        known.contains(name),
                        "the table names `{name}`, which `tsubu verify --list` does not know"
                    );
                }
            } else if let Some(scene) = command.strip_prefix("run ").filter(|rest| !rest.contains(' ')) {
                // Every shipped scene is run elsewhere.
                assert!(Path::new(scene).exists(), "{scene}");
            } else if command.starts_with("run ") || command.starts_with("compare ") {
                desk.done(&format!("{command} -q -o {folder} {} --set claim=[]", shortened(&command, "0.05 s")));
            } else if command.starts_with("response ") {
                let short = "--set response.discard-periods=1 --set response.frequency-ratio=[0.95,1.0]";
                desk.done(&format!("{command} -q -o {folder} {short}"));
            } else if command.starts_with("design ") {
                desk.done(&format!("{command} -q -o {folder} --set design.runs=20 --set design.seeds=2"));
            } else if command.starts_with("calibrate ") {
                desk.done(&format!("{command} -q -o {folder} --set calibrate.runs=12 --set calibrate.checks=2"));
            } else {
                desk.done(&command);
            }
        }
    }
}
