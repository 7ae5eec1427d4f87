//! Every combination of the values that a study varies.

use crate::engine::OpenError;
use crate::run::RunError;
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
}

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
