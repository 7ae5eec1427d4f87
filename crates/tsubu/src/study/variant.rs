//! What stands side by side in a comparison: methods, and variants of them.

use tsubu_frame::{Advise, Hint};
use tsubu_scene::plan::Method;

/// A column of a comparison: a method, and what of the scene is changed for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// Name of its column and of its folder.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Changes of the form `key.path=value`.
    pub changes: Vec<String>,
    /// Whether the comparison goes on without it where it refuses the scene.
    pub may_refuse: bool,
}

/// What a list of variants looks like.
const FORM: &str = "write METHOD, METHOD:KEY=VALUE or NAME=METHOD:KEY=VALUE with commas between, for example \
                    dem,locked=dem:contact.rotation=false; `all` is every method that can";

/// What a comparison writes beside the folders of its variants.
const OWN: [&str; 5] = ["compare.csv", "compare.json", "scene.toml", "report.html", "figures"];

/// A list that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct VariantError {
    message: String,
    hints: Vec<Hint>,
}

impl VariantError {
    fn new(message: String, hint: impl Into<Hint>) -> Self {
        Self { message, hints: vec![hint.into()] }
    }
}

impl Advise for VariantError {
    fn hints(&self) -> Vec<Hint> {
        self.hints.clone()
    }
}

impl Variant {
    /// Reads a list such as `dem,dem:contact.rotation=false,cl-ca`: methods with commas between, each with changes of the
    /// scene behind colons and, if wanted, a name and `=` in front. `all` stands for all methods that are not in the list;
    /// those may refuse. Commas and colons in brackets or quotes belong to a value.
    pub fn list(text: &str) -> Result<Vec<Self>, VariantError> {
        let items: Vec<&str> = split(text, ',').into_iter().map(str::trim).collect();
        let mut variants = Vec::new();
        for item in items.iter().filter(|item| **item != "all") {
            let variant = Self::one(item)?;
            if variants.iter().any(|known: &Self| known.name == variant.name) {
                return Err(VariantError::new(
                    format!("`{}` is named twice", variant.name),
                    "give a variant a name of its own: NAME=METHOD:KEY=VALUE",
                ));
            }
            variants.push(variant);
        }
        if items.contains(&"all") {
            let plain = |method: Method| variants.iter().any(|known| known.name == method.name());
            let others = Method::ALL.into_iter().filter(|method| !plain(*method));
            let others: Vec<Self> = others
                .map(|method| Self { name: method.name().to_owned(), method, changes: Vec::new(), may_refuse: true })
                .collect();
            variants.splice(0..0, others);
        }
        Ok(variants)
    }

    fn one(text: &str) -> Result<Self, VariantError> {
        let mut parts = split(text, ':').into_iter();
        let head = parts.next().unwrap_or_default();
        let (given, word) = head.split_once('=').map_or((None, head), |(name, method)| (Some(name), method));
        let Some(method) = Method::ALL.into_iter().find(|method| method.name() == word) else {
            let names = Method::ALL.map(Method::name).join(", ");
            let hints = vec![format!("methods: {names}").into(), FORM.into()];
            return Err(VariantError { message: format!("method `{word}` is unknown"), hints });
        };
        let changes: Vec<String> = parts.map(str::to_owned).collect();
        if let Some(change) = changes.iter().find(|change| !change.contains('=')) {
            let message = format!("`{text}`: `{change}` changes nothing, for it has no `=`");
            return Err(VariantError::new(message, FORM));
        }
        let name = match given {
            Some(name) if name.is_empty() || name != plain(name) || name.starts_with('.') => {
                return Err(VariantError::new(
                    format!("`{name}` cannot be the name of a column and a folder"),
                    "use letters, digits, `-`, `_` and `.`, not a dot first",
                ));
            }
            Some(name) if OWN.contains(&name) => {
                return Err(VariantError::new(
                    format!("`{name}` is the name of a file of the comparison itself"),
                    "choose another name",
                ));
            }
            Some(name) if Method::ALL.iter().any(|known| known.name() == name && *known != method) || name == "all" => {
                return Err(VariantError::new(
                    format!("`{name}` means something else than a variant of `{word}`"),
                    "choose another name",
                ));
            }
            Some(name) => name.to_owned(),
            None => plain(text),
        };
        Ok(Self { name, method, changes, may_refuse: false })
    }
}

/// The text fit for the name of a folder: what is not a letter, a digit or one of `.-_=` becomes a hyphen.
fn plain(text: &str) -> String {
    let fit = |c: char| if c.is_alphanumeric() || ".-_=".contains(c) { c } else { '-' };
    text.chars().map(fit).collect::<String>().trim_end_matches('-').to_owned()
}

/// The pieces of a text between separators that stand outside brackets and quotes.
fn split(text: &str, separator: char) -> Vec<&str> {
    let mut pieces = Vec::new();
    let (mut start, mut depth, mut quote) = (0, 0_i32, None);
    for (at, c) in text.char_indices() {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None => match c {
                '"' | '\'' => quote = Some(c),
                '[' | '{' => depth += 1,
                ']' | '}' => depth -= 1,
                _ if c == separator && depth == 0 => {
                    pieces.push(&text[start..at]);
                    start = at + c.len_utf8();
                }
                _ => {}
            },
        }
    }
    pieces.push(&text[start..]);
    pieces
}

#[cfg(test)]
mod tests {
    use super::Variant;
    use tsubu_scene::plan::Method;

    fn names(text: &str) -> Vec<String> {
        Variant::list(text).expect("a right list").into_iter().map(|variant| variant.name).collect()
    }

    #[test]
    fn methods_and_variants_are_read() {
        let list = "dem, locked=dem:contact.rotation=false,dem:a=[1,2]:b={x=\"y:z, w\"},cl-ca";
        let variants = Variant::list(list).expect("a right list");
        assert_eq!(names(list), ["dem", "locked", "dem-a=-1-2--b=-x=-y-z--w", "cl-ca"]);
        assert_eq!(variants[1].changes, ["contact.rotation=false"]);
        assert_eq!(variants[2].changes, ["a=[1,2]", "b={x=\"y:z, w\"}"]);
        assert!(variants.iter().all(|variant| !variant.may_refuse));
        assert_eq!(names("dem:contact.rotation=false"), ["dem-contact.rotation=false"]);
    }

    /// Those that `all` adds may refuse; one that is named may not.
    #[test]
    fn all_adds_what_is_not_named() {
        let variants = Variant::list("all,cl-ca,locked=dem:contact.rotation=false").expect("a right list");
        assert_eq!(variants.len(), Method::ALL.len() + 1);
        for variant in variants {
            assert_eq!(variant.may_refuse, !["cl-ca", "locked"].contains(&variant.name.as_str()), "{}", variant.name);
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, said) in [
            ("sph", "method `sph` is unknown"),
            ("", "method `` is unknown"),
            ("dem,dem", "`dem` is named twice"),
            ("dem:contact.rotation", "`contact.rotation` changes nothing"),
            ("../x=dem", "`../x` cannot be the name"),
            ("=dem", "`` cannot be the name"),
            ("cl-ca=dem", "`cl-ca` means something else"),
        ] {
            let error = Variant::list(text).expect_err(text).to_string();
            assert!(error.starts_with(said) || error.contains(said), "{text}: {error}");
        }
    }
}
