//! Going on with a run: what of a scene may change then, and what has changed.

use crate::complaint::{Complaints, brief};
use crate::scene::Scene;
use crate::stage;
use crate::write::text;
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};

/// What does not decide the steps of a run: when it ends, what is written down, what is claimed, where it stops as gone wrong,
/// and what other commands make of the scene.
const FREE: &[&str] = &[
    "title",
    "duration",
    "output",
    "claim",
    "response",
    "atlas",
    "design",
    "calibrate",
    "sweep",
    "dem.largest-overlap",
    "dem.energy-tolerance",
];

/// What another run may have otherwise that this one goes on from, beside what stages may change.
const OF_THE_RUN: &[&str] = &["stage", "start-from", "start-fingerprint", "start-at-zero", "dem.steps-per-contact"];

/// Intervals that follow the duration where nobody tells them.
const INTERVALS: [&str; 2] = ["history-interval", "checkpoint-interval"];

/// A key that has another value than before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Where it is, for example `materials.sand.friction`.
    pub key: String,
    /// Its value then, without the middle of what is long; nothing where there was none.
    pub before: Option<String>,
    /// Its value now, shortened likewise; nothing where there is none.
    pub now: Option<String>,
}

impl Scene {
    /// What decides the steps of a run, as text. A run can go on from the state of another where these are equal.
    pub fn steps_toml(&self) -> String {
        values(&self.resolved_toml(), FREE)
            .into_iter()
            .fold(String::new(), |text, (key, value)| text + &key + " = " + &value + "\n")
    }

    /// This scene with the intervals of an earlier one, `scene.toml` of a run folder, where nobody tells them now: a run that is
    /// to last longer writes down as often as before.
    pub fn going_on(&self, earlier: &str) -> Result<Self, Complaints> {
        let output = earlier.parse::<Table>().ok().and_then(|table| table.get("output").cloned());
        let changes: Vec<String> = INTERVALS
            .into_iter()
            .filter(|key| !self.tells(&["output", key]))
            .filter_map(|key| Some(format!("output.{key}={}", output.as_ref()?.get(key)?.as_float()?)))
            .collect();
        if changes.is_empty() { Ok(self.clone()) } else { self.changed(&changes) }
    }

    /// What is not as in an earlier scene and must be, for a run that starts from where another ended.
    pub fn obstacles(&self, earlier: &str) -> Vec<Difference> {
        let of_the_run = |key: &str| {
            OF_THE_RUN
                .iter()
                .any(|free| key.strip_prefix(free).is_some_and(|rest| rest.is_empty() || rest.starts_with('.')))
        };
        let differences = self.differences(earlier).into_iter();
        differences.filter(|found| !of_the_run(&found.key) && !stage::may_differ(&found.key)).collect()
    }

    /// What decides the steps and is not as in an earlier scene, `scene.toml` of a run folder.
    pub fn differences(&self, earlier: &str) -> Vec<Difference> {
        self.against(earlier, FREE)
    }

    /// All that is not as in an earlier scene, `scene.toml` of a folder of results.
    pub fn all_differences(&self, earlier: &str) -> Vec<Difference> {
        self.against(earlier, &[])
    }

    fn against(&self, earlier: &str, free: &[&str]) -> Vec<Difference> {
        let (before, now) = (values(earlier, free), values(&self.resolved_toml(), free));
        let keys: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
        let differs = keys.into_iter().filter(|key| before.get(*key) != now.get(*key));
        differs
            .map(|key| {
                let [before, now] = [&before, &now].map(|values| values.get(key).map(|value| brief::value(value)));
                Difference { key: key.clone(), before, now }
            })
            .collect()
    }
}

/// Every value of a resolved scene under its path, but for those that are free to differ.
fn values(resolved: &str, free: &[&str]) -> BTreeMap<String, String> {
    let mut values = BTreeMap::new();
    flatten(&resolved.parse().unwrap_or_default(), "", free, &mut values);
    values
}

fn flatten(table: &Table, path: &str, free: &[&str], values: &mut BTreeMap<String, String>) {
    for (key, value) in table {
        let here = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if free.contains(&here.as_str()) {
            continue;
        }
        match value {
            Value::Table(inner) if !inner.is_empty() => flatten(inner, &here, free, values),
            Value::Array(list) if list.iter().any(Value::is_table) => {
                for (index, inner) in list.iter().enumerate() {
                    let here = format!("{here}.{index}");
                    match inner {
                        Value::Table(inner) => flatten(inner, &here, free, values),
                        other => _ = values.insert(here, text(other, false)),
                    }
                }
            }
            other => _ = values.insert(here, text(other, false)),
        }
    }
}
