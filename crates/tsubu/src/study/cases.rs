//! Every combination of the values that a study varies.

use crate::engine::OpenError;
use crate::methods;
use crate::partner::Hosts;
use crate::run::{RunError, scene_hash};
use crate::trial::unsettled;
use std::collections::BTreeMap;
use toml::Value;
use tsubu_frame::FileError;
use tsubu_scene::{Complaints, Plan, Scene};

/// Why a study of many cases has no result.
#[derive(Debug, thiserror::Error)]
pub enum CasesError {
    /// The scene does not say what the study needs, or a case of it is wrong.
    #[error("{0}")]
    Scene(String),
    /// What is in the folder was made of another scene, or by another version.
    #[error("{0}")]
    NotThisScene(String),
    /// A case of it cannot be read.
    #[error("{0}")]
    Complaints(Complaints),
    /// A case of it cannot be run.
    #[error(transparent)]
    Open(OpenError),
    /// A case went wrong.
    #[error("case `{case}`: {error}")]
    Run {
        /// Name of the case.
        case: String,
        /// What went wrong.
        error: RunError,
    },
    /// A file or folder.
    #[error(transparent)]
    File(#[from] FileError),
}

impl CasesError {
    /// Whether somebody else holds the folder.
    pub(super) fn is_locked(&self) -> bool {
        match self {
            Self::File(error) | Self::Run { error: RunError::File(error), .. } => error.is_locked(),
            _ => false,
        }
    }
}

/// One combination.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// `count = 30, friction = 0.6`: the last words of the keys with their values; empty when nothing varies.
    pub name: String,
    /// Keys and values.
    pub values: Vec<(String, Value)>,
}

impl Case {
    /// The scene of this case.
    pub fn scene(&self, scene: &Scene) -> Result<Scene, Complaints> {
        let changes: Vec<(&str, &Value)> = self.values.iter().map(|(path, value)| (path.as_str(), value)).collect();
        scene.with(&changes)
    }

    /// The name as a folder may have it, `count=30,friction=0.6`: the same case has the same folder, whatever stands beside it. A
    /// name that not every file system takes, or a shell would take apart, is altered, and has its hash behind it.
    pub fn folder(&self) -> String {
        if self.name.is_empty() {
            return "scene".to_owned();
        }
        let short = self.name.replace(" = ", "=").replace(", ", ",");
        let plain = |c: char| c.is_ascii_alphanumeric() || "-._=,+".contains(c);
        let tame: String = short.chars().map(|c| if plain(c) { c } else { '_' }).take(LONGEST).collect();
        if tame == short { tame } else { format!("{tame}-{}", &scene_hash(&self.name)[..8]) }
    }
}

/// Characters of a folder's name before its hash.
const LONGEST: usize = 80;

/// All combinations; the last key varies fastest.
pub fn cases(vary: &BTreeMap<String, Vec<Value>>) -> Vec<Case> {
    let mut all = vec![Vec::new()];
    for (path, values) in vary {
        all = all
            .into_iter()
            .flat_map(|case: Vec<(String, Value)>| {
                values.iter().map(move |value| {
                    let mut longer = case.clone();
                    longer.push((path.clone(), value.clone()));
                    longer
                })
            })
            .collect();
    }
    all.into_iter().map(|values| Case { name: name(&values), values }).collect()
}

/// What the scene means in each case.
pub(super) fn case_plans(scene: &Scene, list: &[Case]) -> Result<Vec<Plan>, CasesError> {
    list.iter().map(|case| Ok(case.scene(scene).map_err(CasesError::Complaints)?.plan().clone())).collect()
}

/// Says what a method has against one of these cases, so that it is said before the others have run, and nothing is left behind.
pub(super) fn open<'a>(all: impl IntoIterator<Item = (&'a Case, &'a Plan)>) -> Result<(), CasesError> {
    for (case, plan) in all {
        let open = methods::open(&unsettled(plan), &Hosts::new(&plan.hosts));
        open.map_err(|error| CasesError::Run { case: case.name.clone(), error: error.into() })?;
    }
    Ok(())
}

/// A value as a user typed it, texts without quotes.
pub(super) fn value_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// Keys are shortened to their last word as long as that tells them apart.
pub(super) fn name(values: &[(String, Value)]) -> String {
    let word = |path: &str| path.rsplit('.').next().unwrap_or(path).to_owned();
    let clash = |path: &str| values.iter().filter(|(other, _)| word(other) == word(path)).count() > 1;
    let parts: Vec<String> = values
        .iter()
        .map(|(path, value)| {
            let key = if clash(path) { path.clone() } else { word(path) };
            format!("{key} = {}", value_text(value))
        })
        .collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Folders were numbered: a value put before the others gave every case the folder of another.
    #[test]
    fn a_case_has_the_folder_of_what_is_in_it() {
        let folders = |text: &str| -> Vec<String> {
            let vary: BTreeMap<String, Vec<Value>> = toml::from_str(text).expect("a table of lists");
            cases(&vary).iter().map(Case::folder).collect()
        };
        let many = folders("\"a.count\" = [5, 10]\n\"b.friction\" = [0.5]");
        assert_eq!(many, ["count=5,friction=0.5", "count=10,friction=0.5"]);
        assert_eq!(folders("\"a.count\" = [10]\n\"b.friction\" = [0.5]")[0], many[1]);
        let odd = folders("\"a.b\" = [\"6 mm\", \"6_mm\", \"../6\", \"6:mm\"]");
        assert!(odd[0].starts_with("b=6_mm-") && odd[1] == "b=6_mm" && odd[0] != odd[3], "{odd:?}");
        assert!(odd.iter().all(|name| !name.contains(['/', ' ', ':'])), "{odd:?}");
        let long = folders(&format!("\"a.b\" = [\"{}\"]", "x".repeat(300)));
        assert!(long[0].len() < 100);
        assert_eq!(folders(""), ["scene"]);
    }
}
