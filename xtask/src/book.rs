//! The book.

use crate::shell::{command, root, run, succeeds};

/// Builds it with mdBook; says so where that is not there.
pub fn book() -> Result<(), String> {
    if succeeds(command("mdbook", &["--version"])) {
        let folder = root().join("target/book");
        return run(command("mdbook", &["build", "docs", "--dest-dir", &folder.to_string_lossy()]));
    }
    eprintln!("\nSKIPPED: the book is not built, as there is no mdbook here (`cargo install mdbook`)");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::root;
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
}
