//! State: what a checkpoint holds, as named sections of plain numbers.
//!
//! Engines, hosts and the ledger write themselves into a [`State`] and read themselves back; the hash of a run
//! (`state_hash`) is taken over the same sections, so a checkpoint that is complete and a hash that means something are
//! one and the same promise.

use std::borrow::Cow;
use std::collections::BTreeMap;

/// The numbers of one section. Floats and numbers of things are most of a state: they may lie where they are saved from.
#[derive(Clone, Debug, PartialEq)]
pub enum Section<'a> {
    /// 64-bit floats, kept bit by bit.
    Real(Cow<'a, [f64]>),
    /// 64-bit integers.
    Integer(Vec<i64>),
    /// Numbers of things. A checkpoint has them as integers, and gives them back so.
    Index(Cow<'a, [u32]>),
    /// Text.
    Text(String),
}

impl Section<'_> {
    /// The integers of a section, however wide it keeps them; none where it has floats or text.
    pub fn integers(&self) -> Box<dyn ExactSizeIterator<Item = i64> + '_> {
        match self {
            Self::Integer(v) => Box::new(v.iter().copied()),
            Self::Index(v) => Box::new(v.iter().map(|n| i64::from(*n))),
            Self::Real(_) | Self::Text(_) => Box::new(std::iter::empty()),
        }
    }
}

/// Named sections, in the order of their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State<'a> {
    sections: BTreeMap<String, Section<'a>>,
}

/// A section that is not there or not of the kind that was asked for.
#[derive(Debug, thiserror::Error)]
#[error("the checkpoint has no {kind} section `{name}`: it was written by another version or another scene")]
pub struct MissingSection {
    /// Name of the section.
    pub name: String,
    /// `real`, `integer` or `text`.
    pub kind: &'static str,
}

impl<'a> State<'a> {
    /// Stores floats.
    pub fn put_real(&mut self, name: &str, values: impl Into<Cow<'a, [f64]>>) {
        self.sections.insert(name.to_owned(), Section::Real(values.into()));
    }

    /// Stores integers.
    pub fn put_integer(&mut self, name: &str, values: impl Into<Vec<i64>>) {
        self.sections.insert(name.to_owned(), Section::Integer(values.into()));
    }

    /// Stores numbers of things.
    pub fn put_index(&mut self, name: &str, values: impl Into<Cow<'a, [u32]>>) {
        self.sections.insert(name.to_owned(), Section::Index(values.into()));
    }

    /// Stores text.
    pub fn put_text(&mut self, name: &str, text: impl Into<String>) {
        self.sections.insert(name.to_owned(), Section::Text(text.into()));
    }

    /// Floats of a section.
    pub fn real(&self, name: &str) -> Result<&[f64], MissingSection> {
        match self.sections.get(name) {
            Some(Section::Real(v)) => Ok(v),
            _ => Err(MissingSection { name: name.to_owned(), kind: "real" }),
        }
    }

    /// Floats of a section, which the state has no longer.
    pub fn take_real(&mut self, name: &str) -> Result<Vec<f64>, MissingSection> {
        match self.sections.remove(name) {
            Some(Section::Real(v)) => Ok(v.into_owned()),
            _ => Err(MissingSection { name: name.to_owned(), kind: "real" }),
        }
    }

    /// Integers of a section.
    pub fn integer(&self, name: &str) -> Result<&[i64], MissingSection> {
        match self.sections.get(name) {
            Some(Section::Integer(v)) => Ok(v),
            _ => Err(MissingSection { name: name.to_owned(), kind: "integer" }),
        }
    }

    /// Numbers of things of a section, which the state has no longer; integers that can be none are refused.
    pub fn take_index(&mut self, name: &str) -> Result<Vec<u32>, MissingSection> {
        let missing = || MissingSection { name: name.to_owned(), kind: "integer" };
        match self.sections.remove(name) {
            Some(Section::Index(v)) => Ok(v.into_owned()),
            Some(Section::Integer(v)) => v.into_iter().map(|n| u32::try_from(n).map_err(|_| missing())).collect(),
            _ => Err(missing()),
        }
    }

    /// Text of a section.
    pub fn text(&self, name: &str) -> Result<&str, MissingSection> {
        match self.sections.get(name) {
            Some(Section::Text(v)) => Ok(v),
            _ => Err(MissingSection { name: name.to_owned(), kind: "text" }),
        }
    }

    /// The sections in the order of their names.
    pub fn sections(&self) -> impl Iterator<Item = (&str, &Section<'a>)> {
        self.sections.iter().map(|(n, s)| (n.as_str(), s))
    }

    /// Adds or replaces a section.
    pub fn insert(&mut self, name: String, section: Section<'a>) {
        self.sections.insert(name, section);
    }

    /// The same with copies of what lies elsewhere.
    pub fn into_owned(self) -> State<'static> {
        let owned = |section| match section {
            Section::Real(v) => Section::Real(Cow::Owned(v.into_owned())),
            Section::Integer(v) => Section::Integer(v),
            Section::Index(v) => Section::Index(Cow::Owned(v.into_owned())),
            Section::Text(t) => Section::Text(t),
        };
        State { sections: self.sections.into_iter().map(|(name, section)| (name, owned(section))).collect() }
    }

    /// Hash of names, kinds and bits of every section, in hex.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        for (name, section) in self.sections() {
            hasher.update(name.as_bytes());
            match section {
                Section::Real(v) => {
                    hasher.update(b"\0r");
                    hasher.update(&(v.len() as u64).to_le_bytes());
                    for x in v.iter() {
                        hasher.update(&x.to_bits().to_le_bytes());
                    }
                }
                Section::Integer(_) | Section::Index(_) => {
                    let numbers = section.integers();
                    hasher.update(b"\0i");
                    hasher.update(&(numbers.len() as u64).to_le_bytes());
                    for x in numbers {
                        hasher.update(&x.to_le_bytes());
                    }
                }
                Section::Text(t) => {
                    hasher.update(b"\0t");
                    hasher.update(&(t.len() as u64).to_le_bytes());
                    hasher.update(t.as_bytes());
                }
            }
        }
        hasher.finalize().to_hex().as_str()[..32].to_owned()
    }
}
