//! What the things are that a scene can ask for by name: parts of contact laws, forces of the water, watches, walls, methods.
//!
//! Each has one text. Its sentence and its keys stand in the table of keys; formula, symbols, limits and source stand
//! beside the code that does it, as an [`About`]. Here the two come together, for `tsubu explain` and for the book.

use crate::{clca, contact, dem, lattice, wall, watch, water};
use std::fmt::Write as _;
use tsubu_scene::Choice;

/// What a thing is beyond its sentence in the table of keys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct About {
    /// Its path in a scene: `contact.normal.hertz`.
    pub key: &'static str,
    /// The formula; of a watch what it gives, with units.
    pub formula: &'static str,
    /// Symbols with units; empty where the formula has them.
    pub symbols: &'static str,
    /// Where it stops being right.
    pub limits: &'static str,
    /// Author, year, equation.
    pub reference: &'static str,
}

impl About {
    /// Its sections, as `(heading, text)`; those that say nothing are left out.
    pub fn sections(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let all =
            [("formula", self.formula), ("symbols", self.symbols), ("limits", self.limits), ("source", self.reference)];
        all.into_iter().filter(|(_, text)| !text.is_empty())
    }

    /// All of it as text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (heading, section) in self.sections() {
            let _ = match heading {
                "formula" => write!(text, "{section}"),
                _ => write!(text, "\n{heading}: {section}"),
            };
        }
        text
    }
}

/// A kind of things.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Parts of contact laws.
    Contact,
    /// Forces of the water, and how it flows.
    Water,
    /// Watches.
    Watch,
    /// Shapes of walls, and who moves them.
    Wall,
    /// Methods.
    Method,
}

impl Kind {
    /// All of them, in the order of the book.
    pub const ALL: [Self; 5] = [Self::Contact, Self::Water, Self::Watch, Self::Wall, Self::Method];

    /// Its heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Contact => "Parts of contact laws",
            Self::Water => "Forces and flows of the water",
            Self::Watch => "Watches",
            Self::Wall => "Walls",
            Self::Method => "Methods",
        }
    }

    /// Where its things stand in a scene: tables of choices, lists of words, and tables that may be there.
    fn homes(self) -> &'static [&'static str] {
        match self {
            Self::Contact => &[
                "contact.normal",
                "contact.damping",
                "contact.tangential",
                "contact.tangential.mindlin.form",
                "contact.rolling",
                "contact.twisting",
                "contact.cohesion",
                "contact.film",
            ],
            Self::Water => &[
                "water.drag",
                "water.hindrance",
                "water.lift",
                "water.torque",
                "water.buoyancy",
                "water.flow",
                "water",
            ],
            Self::Watch => &["watch.NAME"],
            Self::Wall => &["walls.NAME.shape", "walls.NAME"],
            Self::Method => &["method"],
        }
    }

    /// What is said of its things beside the code.
    fn abouts(self) -> Vec<&'static About> {
        match self {
            Self::Contact => contact::ABOUT.to_vec(),
            Self::Water => water::ABOUT.to_vec(),
            Self::Watch => watch::ABOUT.to_vec(),
            Self::Wall => wall::ABOUT.to_vec(),
            Self::Method => [&[&dem::ABOUT, &clca::ABOUT], lattice::ABOUT].concat(),
        }
    }

    /// Its things, home by home, in the order of the table of keys.
    pub fn entries(self) -> Vec<Entry> {
        let abouts = self.abouts();
        let place = |choice: &Choice| self.homes().iter().position(|home| *home == choice.home());
        let mut choices = tsubu_scene::choices();
        choices.retain(|choice| place(choice).is_some());
        choices.sort_by_key(place);
        // `contact.tangential.mindlin` and the form that it has unless told are one thing.
        choices.retain(|choice| choice.path != "contact.tangential.mindlin.form.incremental");
        let entry = |choice: Choice| Entry {
            kind: self,
            about: abouts.iter().find(|about| about.key == choice.path).copied(),
            choice,
        };
        choices.into_iter().map(entry).collect()
    }
}

/// A thing with all that is known of it.
#[derive(Clone, Debug)]
pub struct Entry {
    /// What it is one of.
    pub kind: Kind,
    /// Its path, its sentence and its keys.
    pub choice: Choice,
    /// Formula, symbols, limits and source; `none` has none.
    pub about: Option<&'static About>,
}

impl Entry {
    /// Whether somebody who types `name` means it: the last word of its path, or more of it.
    pub fn is_called(&self, name: &str) -> bool {
        let path = &self.choice.path;
        let short = path.replace(".NAME", "");
        [path, &short]
            .into_iter()
            .any(|path| path.strip_suffix(name).is_some_and(|rest| rest.is_empty() || rest.ends_with('.')))
    }
}

/// Everything that can be explained.
pub fn entries() -> Vec<Entry> {
    Kind::ALL.into_iter().flat_map(Kind::entries).collect()
}

/// A page of the book.
pub fn page(kind: Kind) -> String {
    let mut page = format!(
        "# {}\n\n<!-- Generated by `cargo xtask gen` from the table of keys and the texts beside the code; do not edit. -->\n\n\
         Each of these is also told by `tsubu explain NAME`.\n",
        kind.title()
    );
    let mut home = String::new();
    for entry in kind.entries() {
        if entry.choice.home() != home {
            entry.choice.home().clone_into(&mut home);
            let _ = write!(page, "\n## `{home}`\n");
        }
        let _ = write!(page, "\n### `{}`\n\n{}.\n", entry.choice.typed(), entry.choice.sentence());
        let Some(about) = entry.about else { continue };
        let _ = write!(page, "\n```text\n{}\n```\n", about.formula);
        for (heading, text) in about.sections().skip(1) {
            let _ = write!(page, "\n- *{heading}*: {}", text.replace('*', r"\*").replace('<', r"\<"));
        }
        page.push('\n');
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// A law was told in four places and its formula differed between them; a watch could have had no text at all.
    #[test]
    fn every_choice_is_explained_and_every_explanation_has_its_choice() {
        for kind in Kind::ALL {
            let entries = kind.entries();
            let told: BTreeSet<&str> = entries.iter().filter_map(|e| e.about).map(|about| about.key).collect();
            let written: BTreeSet<&str> = kind.abouts().iter().map(|about| about.key).collect();
            assert_eq!(written.difference(&told).collect::<Vec<_>>(), Vec::<&&str>::new(), "no such key in a scene");
            assert_eq!(kind.abouts().len(), written.len(), "{kind:?}: two texts for one thing");
            for entry in entries {
                assert_eq!(entry.about.is_none(), entry.choice.name() == "none", "{} has no text", entry.choice.path);
            }
            for home in kind.homes() {
                assert!(kind.entries().iter().any(|entry| entry.choice.home() == *home), "nothing is at `{home}`");
            }
        }
    }

    #[test]
    fn every_text_is_whole() {
        for entry in entries() {
            let Some(about) = entry.about else { continue };
            for text in [about.formula, about.limits, about.reference] {
                assert!(!text.is_empty(), "{}: a section is empty", about.key);
            }
            assert!(about.symbols.contains('[') || about.formula.contains('['), "{}: symbols without units", about.key);
            assert!(!about.text().contains('—') && !about.text().contains("```"), "{}", about.key);
        }
    }

    #[test]
    fn a_thing_is_found_by_what_it_is_called() {
        let called = |name: &str| -> Vec<String> {
            entries().into_iter().filter(|e| e.is_called(name)).map(|e| e.choice.path).collect()
        };
        assert_eq!(called("hertz"), ["contact.normal.hertz"]);
        assert_eq!(called("tangential.spring"), ["contact.tangential.spring"]);
        assert_eq!(called("spring").len(), 3);
        assert_eq!(called("watch.slope"), ["watch.NAME.slope"]);
        assert_eq!(called("walls.NAME.shape.box"), ["walls.NAME.shape.box"]);
        assert!(called("ertz").is_empty() && called("").is_empty());
    }
}
