use crate::support::Desk;
use std::path::Path;

/// The commands that the README's table of what works names, in order.
fn named_commands() -> Vec<String> {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let text = std::fs::read_to_string(readme).unwrap();
    let table = text.split("## What works today").nth(1).unwrap().split("\n## ").next().unwrap();
    let rows = table.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| what "));
    rows.map(|row| {
        let shown = row.trim_end_matches(" |").rsplit("| ").next().unwrap();
        shown.trim_matches('`').strip_prefix("tsubu ").unwrap_or_else(|| panic!("no command in `{row}`")).to_owned()
    })
    .collect()
}

/// Every row of the table is true: its command ends well. Runs are cut short; verification cases are tested by name, and
/// run in full elsewhere.
#[test]
fn every_row_of_the_readme_works() {
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
                assert!(known.contains(name), "the README names `{name}`, which `tsubu verify --list` does not know");
            }
        } else if command.starts_with("run ") || command.starts_with("compare ") {
            desk.done(&format!("{command} -q -o {folder} --set 'duration=0.05 s' --set claim=[]"));
        } else if command.starts_with("response ") {
            let short = "--set response.discard-periods=1 --set response.frequency-ratio=[0.95,1.0]";
            desk.done(&format!("{command} -q -o {folder} {short}"));
        } else {
            desk.done(&command);
        }
    }
}
