//! Resolved scenes of studies: what follows from a value that a study varies must follow it in every case.
//!
//! With the mass of a grain written out, a resolved scene whose study varies the diameter would have grains of one mass and
//! many densities.

use crate::keys::{self, Key, Kind, Need};
use crate::node::Node;
use crate::plan::Plan;
use std::collections::BTreeMap;
use toml::{Table, Value};

/// Tables whose values others follow from.
const LEADING: [&str; 2] = ["particles", "materials"];

/// The studies that vary keys of a scene.
pub(crate) const STUDIES: [&str; 5] = ["response", "atlas", "design", "calibrate", "sweep"];

/// Those of them that may vary a key continuously.
pub(crate) const CONTINUOUS: [&str; 2] = ["design", "calibrate"];

/// What each study of a plan varies.
pub(crate) fn varied(plan: &Plan) -> impl Iterator<Item = (&'static str, &BTreeMap<String, Vec<Value>>)> {
    let studies = [
        plan.response.as_ref().map(|response| &response.vary),
        plan.atlas.as_ref().map(|atlas| &atlas.vary),
        plan.design.as_ref().map(|design| &design.vary),
        plan.calibrate.as_ref().map(|calibrate| &calibrate.vary),
        plan.sweep.as_ref().map(|sweep| &sweep.vary),
    ];
    STUDIES.into_iter().zip(studies).filter_map(|(study, vary)| Some((study, vary?)))
}

/// Leaves out what nobody typed and what follows from what a study of the plan varies.
pub(crate) fn leave_open(resolved: &mut Table, plan: &Plan, typed: &Node) {
    let leads = |path: &String| path.split('.').next().is_some_and(|first| LEADING.contains(&first));
    if varied(plan).flat_map(|(_, vary)| vary.keys()).any(leads) {
        for key in
            keys::SCENE.iter().filter(|key| !["output", "response", "atlas", "design", "calibrate"].contains(&key.name))
        {
            of_key(key, resolved, Some(typed));
        }
    }
}

fn of_table(keys: &'static [Key], resolved: &mut Table, typed: Option<&Node>) {
    for key in keys {
        of_key(key, resolved, typed);
    }
}

fn of_key(key: &'static Key, table: &mut Table, typed: Option<&Node>) {
    let below = |name: &str, typed: Option<&Node>| typed.and_then(|node| node.find(&[name])).cloned();
    let typed = below(key.name, typed);
    if typed.is_none() && follows(key) {
        table.remove(key.name);
        return;
    }
    let Some(value) = table.get_mut(key.name) else { return };
    let typed = typed.as_ref();
    match (key.kind, value) {
        (Kind::Table(keys), Value::Table(inner)) => of_table(keys, inner, typed),
        (Kind::Named(keys, _), Value::Table(named)) => {
            for (name, inner) in named.iter_mut().filter_map(|(name, value)| Some((name, value.as_table_mut()?))) {
                of_table(keys, inner, below(name, typed).as_ref());
            }
        }
        (Kind::Choice(variants), Value::Table(choice)) => {
            for variant in variants {
                if let Some(Value::Table(inner)) = choice.get_mut(variant.name) {
                    of_table(variant.keys, inner, below(variant.name, typed).as_ref());
                }
            }
        }
        _ => {}
    }
}

/// Whether a number follows from others that are written out, too. The height of a surface follows from a depth that is not.
fn follows(key: &Key) -> bool {
    let number = matches!(key.kind, Kind::Quantity(_) | Kind::Whole);
    number && matches!(key.need, Need::Derived(_)) && key.rivals.is_empty() && key.name != "surface"
}
