//! The book.

use crate::shell::{command, root, run, succeeds};

/// Builds it with mdBook; says so where that is not there.
pub fn book() -> Result<(), String> {
    let own = root().join("target/tools/bin/mdbook").to_string_lossy().into_owned();
    let Some(mdbook) = ["mdbook", &own].into_iter().find(|name| succeeds(command(name, &["--version"]))) else {
        eprintln!("\nSKIPPED: the book is not built, as there is no mdbook here (`.ci/install`)");
        return Ok(());
    };
    let folder = root().join("target/book");
    run(command(mdbook, &["build", "docs", "--dest-dir", &folder.to_string_lossy()]))
}

#[cfg(test)]
mod tests {
    use super::root;
    use crate::generate;
    use serde_json::Value;
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::{Path, PathBuf};

    /// Every page of the book, and every page that is read on its own.
    fn pages() -> Vec<PathBuf> {
        let mut pages: Vec<PathBuf> =
            ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(|name| root().join(name)).to_vec();
        for folder in ["docs", "studies", "benches", "scenes"] {
            walk(&root().join(folder), &mut pages);
        }
        pages
    }

    fn walk(folder: &Path, pages: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                walk(&path, pages);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                pages.push(path);
            }
        }
    }

    /// The text without blocks and spans of code, in which `](` is no link.
    fn prose(text: &str) -> String {
        let lines = text.split("```").step_by(2).flat_map(str::lines);
        lines.map(|line| line.split('`').step_by(2).collect::<Vec<_>>().join("code") + "\n").collect()
    }

    fn links(text: &str) -> Vec<String> {
        let prose = prose(text);
        let targets = prose.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        targets.map(|(target, _)| target.to_owned()).filter(|target| !target.contains("://")).collect()
    }

    /// What a heading is called in a link.
    fn anchors(text: &str) -> BTreeSet<String> {
        let headings = text.split("```").step_by(2).flat_map(str::lines).filter(|line| line.starts_with('#'));
        let slug = |c: char| match c {
            c if c.is_alphanumeric() || c == '_' || c == '-' => c.to_lowercase().next(),
            c if c.is_whitespace() => Some('-'),
            _ => None,
        };
        headings.map(|line| line.trim_start_matches('#').trim().chars().filter_map(slug).collect()).collect()
    }

    fn broken(page: &Path, text: &str) -> Vec<String> {
        let folder = page.parent().expect("a folder");
        let leads_nowhere = |target: &String| {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.to_owned() } else { folder.join(file) };
            if anchor.is_empty() || path.extension().is_none_or(|extension| extension != "md") {
                return !path.exists();
            }
            fs::read_to_string(&path).map_or(true, |there| !anchors(&there).contains(anchor))
        };
        links(text).into_iter().filter(leads_nowhere).collect()
    }

    #[test]
    fn every_link_leads_somewhere() {
        let mut lost = Vec::new();
        for page in pages() {
            let text = fs::read_to_string(&page).expect("a page");
            lost.extend(broken(&page, &text).into_iter().map(|target| format!("{}: {target}", page.display())));
        }
        assert!(lost.is_empty(), "broken links:\n{}", lost.join("\n"));
    }

    /// The controls: a file, a heading, a heading of another page that are not there; code is no link.
    #[test]
    fn a_broken_link_is_seen() {
        let page = root().join("docs/src/introduction.md");
        let text = "[a](no.md) [b](#no) [c](first-run.md#no) [d](first-run.md) `[e](f)`\n```\n[g](h)\n```\n";
        assert_eq!(broken(&page, text), ["no.md", "#no", "first-run.md#no"]);
    }

    /// A page that is not in the summary is not in the book.
    #[test]
    fn every_page_is_in_the_book() {
        let source = root().join("docs/src");
        let summary = fs::read_to_string(source.join("SUMMARY.md")).expect("the summary");
        let told: BTreeSet<PathBuf> = links(&summary).into_iter().map(|target| source.join(target)).collect();
        let mut pages = Vec::new();
        walk(&source, &mut pages);
        pages.retain(|page| !page.ends_with("SUMMARY.md"));
        let left_out: Vec<_> = pages.iter().filter(|page| !told.contains(*page)).collect();
        assert!(left_out.is_empty(), "not in docs/src/SUMMARY.md: {left_out:?}");
    }

    /// All code of the crates, file by file.
    fn sources() -> Vec<(PathBuf, String)> {
        fn inner(folder: &Path, sources: &mut Vec<(PathBuf, String)>) {
            for entry in fs::read_dir(folder).expect("a folder").flatten() {
                let path = entry.path();
                if path.is_dir() {
                    inner(&path, sources);
                } else if path.extension().is_some_and(|extension| extension == "rs") {
                    let text = fs::read_to_string(&path).expect("a source");
                    sources.push((path, text));
                }
            }
        }
        let mut sources = Vec::new();
        for entry in fs::read_dir(root().join("crates")).expect("the crates").flatten() {
            inner(&entry.path().join("src"), &mut sources);
        }
        sources
    }

    /// Whether a text declares a name: as a type, a function, a module, a constant or a field.
    fn declares(text: &str, name: &str) -> bool {
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        let item = |word: &str| {
            let start = format!("{word} {name}");
            text.match_indices(&start).any(|(at, _)| ends(&text[at + start.len()..]))
        };
        let field = || {
            let start = format!("{name}:");
            text.match_indices(&start).any(|(at, _)| {
                let before = text[..at].chars().next_back();
                let after = &text[at + start.len()..];
                !before.is_some_and(|c| c.is_alphanumeric() || c == '_') && !after.starts_with(':')
            })
        };
        ["struct", "enum", "trait", "type", "fn", "mod", "const", "static"].into_iter().any(item) || field()
    }

    /// Whether the code has a name: `Type`, `function`, `Type::member`.
    fn is_code(sources: &[(PathBuf, String)], name: &str) -> bool {
        let Some((owner, member)) = name.rsplit_once("::") else {
            return sources.iter().any(|(_, text)| declares(text, name));
        };
        let owner = owner.rsplit("::").next().unwrap_or(owner);
        // Columns are made by a macro, in a file that is called as they are.
        let is_called =
            |path: &Path| path.file_stem().is_some_and(|stem| stem == owner || stem == &*owner.to_lowercase());
        let homes = sources.iter().filter(|(path, text)| declares(text, owner) || is_called(path));
        let folders: BTreeSet<&Path> = homes.filter_map(|(path, _)| path.parent()).collect();
        let near = sources.iter().filter(|(path, _)| path.parent().is_some_and(|folder| folders.contains(folder)));
        near.into_iter().any(|(_, text)| declares(text, member))
    }

    /// What stands in backticks in a column of the tables of a page.
    fn column(page: &str, head: &str) -> Vec<String> {
        let (mut at, mut words) = (None, Vec::new());
        for line in page.lines() {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            if cells.len() < 3 {
                at = None;
            } else if let Some(found) = cells.iter().position(|cell| *cell == head) {
                at = Some(found);
            } else if let Some(cell) = at.and_then(|at| cells.get(at)) {
                words.extend(cell.split('`').skip(1).step_by(2).map(str::to_owned));
            }
        }
        words
    }

    /// The paths of all keys in a part of a JSON Schema that stands at `path`; names of one's own are `NAME`.
    fn keys(schema: &Value, path: &str, known: &mut BTreeSet<String>) {
        let named = schema["properties"].as_object().into_iter().flatten();
        let own = schema.get("additionalProperties").filter(|own| own.is_object());
        for (name, part) in named.map(|(name, part)| (name.as_str(), part)).chain(own.map(|part| ("NAME", part))) {
            let path = format!("{path}.{name}").trim_start_matches('.').to_owned();
            keys(part, &path, known);
            known.insert(path);
        }
        let inner = ["anyOf", "oneOf", "allOf"].iter().filter_map(|of| schema[of].as_array()).flatten();
        for part in inner.chain(schema.get("items")) {
            keys(part, path, known);
        }
    }

    /// The page of symbols named columns that had gone, and nobody who looked for them in the code found them. Names
    /// with a dot are keys of a scene.
    #[test]
    fn what_the_book_calls_code_is_in_the_code() {
        let sources = sources();
        let schema = fs::read_to_string(root().join(generate::SCHEMA)).expect("the schema");
        let mut known = BTreeSet::new();
        keys(&serde_json::from_str(&schema).expect("a schema"), "", &mut known);
        let is_key = |name: &str| known.contains(name);
        for name in ["glossary.md", "theory/symbols.md"] {
            let page = fs::read_to_string(root().join("docs/src").join(name)).expect("a page");
            let named = column(&page, "code");
            assert!(named.len() > 20, "{name}: the column is gone");
            let lost: Vec<&String> = named
                .iter()
                .filter(
                    |name| if name.contains('.') || is_key(name) { !is_key(name) } else { !is_code(&sources, name) },
                )
                .collect();
            assert!(lost.is_empty(), "{name} names what is not in the code: {lost:?}");
        }
    }

    #[test]
    fn a_name_that_the_code_has_not_is_seen() {
        let source = |text: &str| vec![(PathBuf::from("a/b.rs"), text.to_owned())];
        let code = source("pub struct Chunk {\n    pub overlap: Column,\n}\nfn rows() {}\nuse super::overlaps;\n");
        for name in ["Chunk", "overlap", "rows", "Chunk::overlap", "b::rows"] {
            assert!(is_code(&code, name), "{name}");
        }
        for name in ["Chun", "lap", "row", "super", "Chunk::shear", "Pair::overlap"] {
            assert!(!is_code(&code, name), "{name}");
        }
        assert_eq!(column("| a | code |\n|---|---|\n| `x` | `y`, z `w` |\n\n`v`\n", "code"), ["y", "w"]);
    }
}
