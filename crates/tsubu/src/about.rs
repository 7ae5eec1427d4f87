//! The text that a law, a force, a watch, a wall or a method has beside its code.

use std::fmt::Write as _;

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
