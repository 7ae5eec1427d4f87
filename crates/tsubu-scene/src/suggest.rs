//! "Did you mean": the nearest of the words that would have been right.

/// Longer than any word that could be meant; a megabyte would be compared letter by letter.
const LONGEST: usize = 100;

/// The nearest candidate, when it is near enough that a slip of the hand explains the difference.
pub fn nearest<'a>(typed: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if typed.len() > LONGEST {
        return None;
    }
    // Habits from other formats: snake_case and capitals are never meant as such in a scene.
    let plain = typed.to_lowercase().replace(['_', ' '], "-");
    candidates
        .into_iter()
        .map(|candidate| (closeness(&plain, &candidate.to_lowercase()), candidate))
        .filter(|(score, _)| *score >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

fn closeness(typed: &str, candidate: &str) -> f64 {
    let edit = strsim::normalized_damerau_levenshtein(typed, candidate);
    // `amp` for `amplitude` and `shapes` for `shape`: half a word is a good pointer too.
    let part =
        typed.len() >= 3 && (candidate.starts_with(typed) || typed.starts_with(candidate) && candidate.len() >= 3);
    if part { edit.max(0.7) } else { edit }
}

/// More words than this nobody reads.
const LISTED: usize = 50;

/// A list for people: `a`, `b`, `c`.
pub(crate) fn list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let mut words = words.into_iter();
    let quoted: Vec<String> = words.by_ref().take(LISTED).map(|word| format!("`{word}`")).collect();
    let more = words.count();
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    quoted.join(", ") + &rest
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_are_mended_and_strangers_are_left_alone() {
        let keys = ["material", "count", "diameter", "mass", "start"];
        assert_eq!(nearest("diamter", keys), Some("diameter"));
        assert_eq!(nearest("Mass", keys), Some("mass"));
        assert_eq!(nearest("diam", keys), Some("diameter"));
        assert_eq!(nearest("viscosity", keys), None);
        assert_eq!(nearest("", keys), None);
    }
}
