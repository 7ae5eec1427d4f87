//! What a lattice model has to say about a scene: what it approximates, and what it cannot do.

use crate::engine::{Note, Refusal, Verdict};
use crate::view::Wants;
use std::collections::BTreeMap;
use tsubu_scene::plan::{Plan, Watch};

/// Collects remarks; a refused entry refuses the run.
#[derive(Debug)]
pub struct Remarks {
    method: &'static str,
    /// All remarks so far.
    pub notes: Vec<Note>,
}

impl Remarks {
    /// No remarks yet of the method of that name.
    pub fn of(method: &'static str) -> Self {
        Self { method, notes: Vec::new() }
    }

    /// The method cannot honour this; the text says why and what to do.
    pub fn refuse(&mut self, key: impl Into<String>, text: impl Into<String>) {
        self.notes.push(Note { key: key.into(), verdict: Verdict::Refused, text: text.into() });
    }

    /// The method does something near it; the text says what.
    pub fn approximate(&mut self, key: impl Into<String>, text: impl Into<String>) {
        self.notes.push(Note { key: key.into(), verdict: Verdict::Approximated, text: text.into() });
    }

    /// Watches that want to see what the method does not have.
    pub fn watches(&mut self, watches: &BTreeMap<String, Watch>, plan: &Plan, offered: Wants) {
        for (name, watch) in watches {
            let kind = watch.measure.name();
            let key = format!("watch.{name}.{kind}");
            let way_out = match kind {
                "slope" => "set `touching = false`",
                "profile" => "leave `coordination` out of its quantities",
                _ => "leave this watch out",
            };
            let wants = crate::watch::open(&watch.measure, plan).wants();
            match wants.missing(offered) {
                None => {}
                Some("spins") => self.approximate(key, "the automaton knows no spin; it is given as zero"),
                Some(what) => self.refuse(
                    key,
                    format!(
                        "it looks at {what}, which the automaton does not have; {way_out}, or use `method = \"dem\"`"
                    ),
                ),
            }
        }
    }

    /// The refusal, if anything was refused.
    pub fn refusal(&self) -> Option<Refusal> {
        let notes: Vec<Note> = self.notes.iter().filter(|n| n.verdict == Verdict::Refused).cloned().collect();
        (!notes.is_empty()).then_some(Refusal { method: self.method, notes })
    }
}
