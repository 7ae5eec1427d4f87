//! Imports go down: a room (a file or folder directly in `src`) uses rooms that ARCHITECTURE.md names before it, and no other.

use crate::shell::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Imports that go up and are still there: crate, room, what it uses. A list that may only become shorter.
const STILL_GO_UP: &[[&str; 3]] = &[];

/// Crates without an order: verification cases hardly build on one another.
const UNORDERED: [&str; 1] = ["tsubu-verify"];

#[test]
fn imports_go_down() {
    let Ok(map) = fs::read_to_string(root().join("ARCHITECTURE.md")) else { return };
    let mut wrong = Vec::new();
    let mut up = Vec::new();
    for (name, folder) in crates() {
        let rooms = rooms(&folder);
        let order = order(&map, &name);
        wrong.extend(
            rooms
                .keys()
                .filter(|room| !order.contains(room))
                .map(|room| format!("{name}: ARCHITECTURE.md, `Who imports whom`, does not say where `{room}` stands")),
        );
        wrong.extend(
            order
                .iter()
                .filter(|room| !rooms.contains_key(*room))
                .map(|room| format!("{name}: ARCHITECTURE.md, `Who imports whom`, names `{room}`, which is not there")),
        );
        let height = |room: &str| order.iter().position(|other| other == room);
        for (room, text) in &rooms {
            for used in used(text).into_iter().filter(|used| used != room && rooms.contains_key(used)) {
                if height(&used) > height(room) {
                    up.push([name.clone(), room.clone(), used]);
                }
            }
        }
    }
    let known = |import: &[String; 3]| STILL_GO_UP.iter().any(|known| known == import);
    wrong.extend(
        up.iter()
            .filter(|import| !known(import))
            .map(|[name, room, used]| format!("{name}: `{room}` uses `{used}`, which stands above it")),
    );
    wrong.extend(STILL_GO_UP.iter().filter(|known| !up.iter().any(|import| *known == import)).map(
        |[name, room, used]| format!("{name}: `{room}` no longer uses `{used}`: take it from the list `STILL_GO_UP`"),
    ));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Name and sources of every crate with an order.
fn crates() -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(root().join("crates")).expect("there are crates").flatten();
    let named = entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path().join("src")));
    named.filter(|(name, folder)| folder.is_dir() && !UNORDERED.contains(&name.as_str())).collect()
}

/// What is directly in a crate's `src`, with all code that stands there; tests beside the code do not count.
fn rooms(folder: &Path) -> BTreeMap<String, String> {
    let mut rooms = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a crate has sources").flatten() {
        let room = entry.path().file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !["lib", "main"].contains(&room.as_str()) {
            read(&entry.path(), rooms.entry(room).or_default());
        }
    }
    rooms
}

fn read(path: &Path, text: &mut String) {
    if path.is_dir() {
        fs::read_dir(path).expect("a folder").flatten().for_each(|entry| read(&entry.path(), text));
    } else if path.extension().is_some_and(|ending| ending == "rs") {
        let file = fs::read_to_string(path).expect("sources are text");
        let code = file.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        text.extend(code.lines().map(|line| line.split("//").next().unwrap_or_default()).flat_map(|line| [line, "\n"]));
    }
}

/// The rooms that code names after `crate::`, in braces too.
fn used(code: &str) -> Vec<String> {
    let name =
        |text: &str| text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default().to_owned();
    let mut used = Vec::new();
    for after in code.split("crate::").skip(1) {
        let Some(list) = after.strip_prefix('{') else {
            used.push(name(after));
            continue;
        };
        let mut depth = 0;
        let end = list.find('}').map_or(list.len(), |_| list.find(';').unwrap_or(list.len()));
        let top = list[..end].split(|c: char| {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            c == ',' && depth == 0
        });
        used.extend(top.map(|part| name(part.trim())));
    }
    used
}

/// The order of a crate's rooms: the words of its line or lines under `Who imports whom`.
fn order(map: &str, name: &str) -> Vec<String> {
    let section = map.split("## Who imports whom").nth(1).unwrap_or_default().split("\n## ").next().unwrap_or_default();
    let mut rows = section.lines().skip_while(|line| line.trim_end() != format!("    {name}:"));
    rows.next();
    let words = rows.take_while(|line| line.starts_with("        ")).flat_map(str::split_whitespace);
    words.map(str::to_owned).collect()
}

#[test]
fn what_is_used_is_read_from_the_code() {
    let code = "use crate::a::{B, c::D};\nuse crate::{e, f::{g, h}, i::J};\nfn k() { crate::l::m() }\n";
    assert_eq!(used(code), ["a", "e", "f", "i", "l"]);
    assert_eq!(used("let x = crate::VERSION;"), ["VERSION"]);
}

#[test]
fn the_order_is_read_from_the_map() {
    let map = "## Who imports whom\n\n    one:\n        a b\n        c\n    two:\n        d\n\n## Next\n    one:\n        z\n";
    assert_eq!(order(map, "one"), ["a", "b", "c"]);
    assert_eq!(order(map, "two"), ["d"]);
    assert!(order(map, "three").is_empty());
}
