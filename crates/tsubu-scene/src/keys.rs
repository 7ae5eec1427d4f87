//! The table of keys: everything a scene may say, with kind, default, range and one sentence.
//!
//! This registry is the only source for validation, unit conversion, defaults, the JSON Schema and the reference
//! page. A key that is not here does not exist; a key that is here is checked, converted, documented and offered in
//! an editor without another line of code.

mod bonds;
mod contact;
mod gases;
mod grains;
mod hosts;
mod methods;
mod signals;
mod sites;
mod stage;
mod study;
mod walls;
mod watch;
mod water;
mod world;

pub(crate) use grains::PARTICLES;
pub use world::SCENE;

pub(crate) use crate::key::find;
pub use crate::key::{Bound, Family, Key, Kind, Need, Range, Variant, Word};

/// Calls `visit` with the path and the keys of every table of the scene; user-chosen names appear as `NAME`.
pub(crate) fn walk(visit: &mut dyn FnMut(&str, &'static [Key])) {
    fn inner(path: &str, keys: &'static [Key], visit: &mut dyn FnMut(&str, &'static [Key])) {
        visit(path, keys);
        for key in keys {
            let here = if path.is_empty() { key.name.to_string() } else { format!("{path}.{}", key.name) };
            match key.kind {
                Kind::Table(keys) | Kind::Many(keys) => inner(&here, keys, visit),
                Kind::Named(keys, _) => inner(&format!("{here}.NAME"), keys, visit),
                Kind::Choice(variants) | Kind::NamedChoice(variants, _) => {
                    let here = if matches!(key.kind, Kind::Choice(_)) { here } else { format!("{here}.NAME") };
                    for variant in variants {
                        inner(&format!("{here}.{}", variant.name), variant.keys, visit);
                    }
                }
                _ => {}
            }
        }
    }
    inner("", SCENE, visit);
}

/// The tables in which a key of this name is at home, to help a user who typed it elsewhere.
pub(crate) fn homes(name: &str) -> Vec<String> {
    let mut homes = Vec::new();
    walk(&mut |path, keys| {
        // What a pair of materials says of its law is at home in the scene's.
        if find(keys, name).is_some() && !path.starts_with("material-pair.contact") {
            homes.push(if path.is_empty() { "the top of the file".to_string() } else { format!("[{path}]") });
        }
    });
    homes
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn every(check: &mut dyn FnMut(&str, &Key)) {
        walk(&mut |path, keys| {
            for key in keys {
                check(&format!("{path}.{}", key.name), key);
            }
        });
    }

    #[test]
    fn names_are_kebab_case_and_told_once() {
        walk(&mut |path, keys| {
            let mut seen = BTreeSet::new();
            for key in keys {
                assert!(key.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{path}.{}", key.name);
                assert!(seen.insert(key.name), "{path}.{} twice", key.name);
            }
        });
    }

    #[test]
    fn every_key_is_explained_in_one_sentence() {
        every(&mut |path, key| {
            assert!(!key.about.is_empty() && !key.about.ends_with('.'), "{path}: {}", key.about);
            assert!(!key.about.contains('\n') && !key.about.contains('|'), "{path}: {}", key.about);
        });
    }

    #[test]
    fn rivals_exist_and_name_each_other() {
        walk(&mut |path, keys| {
            for key in keys {
                for rival in key.rivals {
                    let other = find(keys, rival).unwrap_or_else(|| panic!("{path}.{}: no {rival}", key.name));
                    assert!(other.rivals.contains(&key.name), "{path}.{rival} does not name {}", key.name);
                }
            }
        });
    }

    /// `watch.grain.track.ids = [1000000000000000000]` passed every check and then did not fit into the plan, which was
    /// told as a mistake in tsubu. A whole number without two ends can do that.
    #[test]
    fn every_whole_number_has_two_ends() {
        every(&mut |path, key| {
            // Every whole number that TOML has is a seed.
            if matches!(key.kind, Kind::Whole | Kind::Wholes) && key.name != "seed" {
                let ends = [key.range.low, key.range.high];
                assert!(ends.iter().all(|end| matches!(end, Bound::Including(_))), "{path}");
                assert!(!key.range.holds(-1.0) && !key.range.holds(f64::from(u32::MAX)), "{path}");
            }
        });
    }
}
