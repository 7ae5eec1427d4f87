//! Numbers of a state, each under a name of its own: one list serves for writing and for reading.

use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Numbers with the name of their section, below a prefix.
pub type Named<'a> = Vec<(&'static str, &'a mut [f64])>;

/// Writes every entry as the section `PREFIX.NAME`.
pub fn save(prefix: &str, entries: Named, state: &mut State) {
    for (name, values) in entries {
        state.put_real(&section(prefix, name), values.to_vec());
    }
}

/// Takes every entry back.
pub fn load(prefix: &str, entries: Named, state: &State) -> Result<(), MissingSection> {
    for (name, values) in entries {
        let section = section(prefix, name);
        let saved = state.real(&section)?;
        if saved.len() != values.len() {
            return Err(MissingSection { name: section, kind: "real" });
        }
        values.copy_from_slice(saved);
    }
    Ok(())
}

/// The section of an entry.
pub(crate) fn section(prefix: &str, name: &str) -> String {
    format!("{prefix}.{}", name.replace(' ', "-"))
}
