//! Resolved scenes of studies: what follows from a value that a study varies must follow it in every case.
//!
//! With the mass of a grain written out, a resolved scene whose study varies the diameter would have grains of one mass and
//! many densities.

use crate::keys::{self, Key, Kind, Need};
use crate::node::Node;
use crate::plan::Plan;
use toml::{Table, Value};

/// Tables whose values others follow from.
const LEADING: [&str; 2] = ["particles", "materials"];

/// Leaves out what nobody typed and what follows from what a study of the plan varies.
pub(crate) fn leave_open(resolved: &mut Table, plan: &Plan, typed: &Node) {
    let response = plan.response.iter().flat_map(|response| response.vary.keys());
    let sweep = plan.sweep.iter().flat_map(|sweep| sweep.vary.keys());
    let leads = |path: &String| path.split('.').next().is_some_and(|first| LEADING.contains(&first));
    if response.chain(sweep).any(leads) {
        for key in keys::SCENE.iter().filter(|key| !["output", "response"].contains(&key.name)) {
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
