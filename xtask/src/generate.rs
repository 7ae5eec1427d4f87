//! Pages that are made from the code.

use crate::blocks;
use crate::shell::{output, program, root};
use std::fs;

/// Pages of the book that the program prints.
const PRINTED: [&str; 8] = ["contact", "water", "watches", "walls", "methods", "claims", "held-against", "origins"];

/// The scene file for editors.
pub const SCHEMA: &str = "docs/scene.schema.json";

/// Every generated file with its content.
fn pages() -> Result<Vec<(String, String)>, String> {
    let tsubu = program("tsubu")?;
    let mut pages = vec![
        ("docs/src/scene-reference.md".to_owned(), blocks::printed(&tsubu, "scene-reference")?),
        (SCHEMA.to_owned(), output(&tsubu, &["schema"])?),
    ];
    for name in PRINTED {
        pages.push((format!("docs/src/explained/{name}.md"), blocks::printed(&tsubu, name)?));
    }
    pages.push(blocks::filled("README.md", "verdicts", &blocks::printed(&tsubu, "verdicts")?)?);
    pages.extend(blocks::pages(&tsubu)?);
    Ok(pages)
}

/// Writes them.
pub fn write() -> Result<(), String> {
    for (name, content) in pages()? {
        let path = root().join(&name);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|error| format!("cannot make the folder of {name}: {error}"))?;
        }
        fs::write(path, content).map_err(|error| format!("cannot write {name}: {error}"))?;
        eprintln!("wrote {name}");
    }
    Ok(())
}

/// Fails if one is out of date.
pub fn check() -> Result<(), String> {
    let stale: Vec<String> = pages()?
        .into_iter()
        .filter(|(name, content)| fs::read_to_string(root().join(name)).is_ok_and(|text| text == *content).eq(&false))
        .map(|(name, _)| name)
        .collect();
    if stale.is_empty() { Ok(()) } else { Err(format!("out of date: {}; run `cargo xtask gen`", stale.join(", "))) }
}
