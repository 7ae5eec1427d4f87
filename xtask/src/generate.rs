//! Pages that are made from the code.

use crate::shell::root;
use std::fs;

/// Every generated file with its content.
fn pages() -> [(&'static str, String); 2] {
    [
        ("docs/src/scene-reference.md", tsubu_scene::reference()),
        ("docs/scene.schema.json", format!("{:#}\n", tsubu_scene::schema())),
    ]
}

/// Writes them.
pub fn write() -> Result<(), String> {
    for (name, content) in pages() {
        let path = root().join(name);
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
    let stale: Vec<&str> = pages()
        .into_iter()
        .filter(|(name, content)| fs::read_to_string(root().join(name)).is_ok_and(|text| text == *content).eq(&false))
        .map(|(name, _)| name)
        .collect();
    if stale.is_empty() { Ok(()) } else { Err(format!("out of date: {}; run `cargo xtask gen`", stale.join(", "))) }
}
