//! Numbers of a state, each under a name of its own: one list serves for writing and for reading.

use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Numbers with the name of their section, below a prefix.
pub type Named<'a> = Vec<(&'static str, &'a mut [f64])>;

/// How the names of entries begin that are written only where they are not zero: a run that nobody acts on from outside has the
/// checkpoint and the hash that it would have without them.
const WHERE_USED: &str = "outside";

/// Writes every entry as the section `PREFIX.NAME`.
pub fn save(prefix: &str, entries: Named, state: &mut State) {
    let used = |name: &str, values: &[f64]| !name.starts_with(WHERE_USED) || values.iter().any(|value| *value != 0.0);
    for (name, values) in entries.into_iter().filter(|(name, values)| used(name, values)) {
        state.put_real(&section(prefix, name), values.to_vec());
    }
}

/// Takes every entry back.
pub fn load(prefix: &str, entries: Named, state: &State) -> Result<(), MissingSection> {
    for (name, values) in entries {
        let section = section(prefix, name);
        let saved = match state.real(&section) {
            Err(_) if name.starts_with(WHERE_USED) => {
                values.fill(0.0);
                continue;
            }
            saved => saved?,
        };
        if saved.len() != values.len() {
            return Err(MissingSection { name: section, kind: "real" });
        }
        values.copy_from_slice(saved);
    }
    Ok(())
}

fn section(prefix: &str, name: &str) -> String {
    format!("{prefix}.{}", name.replace(' ', "-"))
}
