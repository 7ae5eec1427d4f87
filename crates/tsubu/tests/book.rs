//! What the book says of the code.

use std::collections::BTreeSet;
use std::path::Path;
use tsubu::ledger::{Account, Energies};

/// The first cells of a table of a page, in backticks, by the word in its head.
fn rows(page: &str, head: &str) -> BTreeSet<String> {
    let table = page.split(&format!("\n| {head} |")).nth(1).unwrap_or_default();
    let lines = table.lines().skip(1).take_while(|line| line.starts_with('|'));
    lines.filter_map(|line| line.split('`').nth(1)).map(str::to_owned).collect()
}

/// The page of the ledger lacked three energies and four accounts: those that came with water and moving walls.
#[test]
fn the_ledger_page_has_every_energy_and_account() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/theory/ledger.md");
    let page = std::fs::read_to_string(page).unwrap();
    let energies = Energies::default().terms().map(|(name, _)| name.to_owned());
    assert_eq!(rows(&page, "energy"), BTreeSet::from(energies));
    for (head, is_work) in [("work", true), ("loss", false)] {
        let accounts = Account::ALL.iter().filter(|account| account.is_work() == is_work);
        assert_eq!(rows(&page, head), accounts.map(|account| account.name().to_owned()).collect(), "{head}");
    }
}
