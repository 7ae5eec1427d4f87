//! Misspelt words in all texts, by codespell: it knows the common misspellings, not the dictionary, and so says little and is right.

use crate::shell::{command, python_with};
use std::process::Stdio;

/// The version whose list of misspellings is meant: a later one may find more.
const VERSION: &str = "2.4.3";

/// Looks through every file that git knows; `.codespellrc` says which not, and which words are right. Says so where there is no codespell.
pub fn check() -> Result<(), String> {
    let import = format!("from codespell_lib import __version__ as found; assert found == '{VERSION}'");
    let Some(python) = python_with(&format!("codespell=={VERSION}"), &import) else {
        eprintln!("\nSKIPPED: spelling is not checked, for want of a Python 3 with the package codespell {VERSION}");
        return Ok(());
    };
    let listed = command("git", &["ls-files"]).stderr(Stdio::inherit()).output();
    let listed = listed.ok().filter(|listed| listed.status.success()).ok_or("`git ls-files` failed")?;
    let files = String::from_utf8(listed.stdout).map_err(|_| "a file has a name that is no text")?;
    eprintln!("\n> codespell, on every file that git knows");
    let found = command(&python, &["-m", "codespell_lib"]).args(files.lines()).status();
    if found.is_ok_and(|status| status.success()) {
        return Ok(());
    }
    Err("words are misspelt, see above\nhint: mend them; one that is right goes into the list of `.codespellrc`"
        .to_owned())
}
