//! What a scene can ask for by name: the tables of choices, the words of lists, the tables that may be there.

use crate::keys::{self, Family, Key, Kind, Need};
use crate::reference;

/// One of them.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Where it stands: `contact.normal.hertz`; names of one's own are `NAME`.
    pub path: String,
    /// One sentence, without its full stop.
    pub about: &'static str,
    /// Its own keys.
    pub keys: &'static [Key],
    /// How it is typed.
    form: Form,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    /// A table.
    Table,
    /// A word.
    Word,
    /// A word in a list.
    Listed,
    /// The name of something that the scene defines elsewhere.
    Named,
}

/// A key of a choice, in words.
#[derive(Clone, Debug)]
pub struct KeyText {
    /// The key as typed.
    pub name: &'static str,
    /// What its value is, with unit and range.
    pub value: String,
    /// What is read where it is not given.
    pub default: String,
    /// One sentence, without its full stop.
    pub about: &'static str,
}

impl Choice {
    /// What it is called.
    pub fn name(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or_default()
    }

    /// The path of the key that offers it.
    pub fn home(&self) -> &str {
        self.path.rsplit_once('.').map_or("", |(home, _)| home)
    }

    /// What it is, without a full stop; words are told in the middle of a sentence elsewhere.
    pub fn sentence(&self) -> String {
        let mut letters = self.about.chars();
        letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
    }

    /// How it is typed in a scene.
    pub fn typed(&self) -> String {
        match self.form {
            Form::Table => format!("[{}]", self.path),
            Form::Word => format!("{} = \"{}\"", self.home(), self.name()),
            Form::Named => format!("{} = \"NAME\"", self.path),
            Form::Listed => format!("{} = [\"{}\"]", self.home(), self.name()),
        }
    }

    /// Its keys in words.
    pub fn key_texts(&self) -> impl Iterator<Item = KeyText> {
        let plain = |text: String| text.replace('`', "");
        self.keys.iter().map(move |key| KeyText {
            name: key.name,
            value: plain(reference::value(key)) + &key.range.words().map(|w| format!(", {w}")).unwrap_or_default(),
            default: plain(reference::default(key)),
            about: key.about,
        })
    }
}

/// All of them, in the order of the table of keys. What a pair of materials can have of its own is the scene's.
pub fn choices() -> Vec<Choice> {
    let mut choices = Vec::new();
    keys::walk(&mut |path, keys| {
        if path.starts_with("material-pair") {
            return;
        }
        for key in keys {
            let here = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
            let one = |path: String, about, keys, form| Choice { path, about, keys, form };
            let of = |name: &str| format!("{here}.{name}");
            match key.kind {
                Kind::Choice(variants) => {
                    choices.extend(variants.iter().map(|v| one(of(v.name), v.about, v.keys, Form::Table)));
                }
                Kind::OneOf(words) => choices.extend(words.iter().map(|w| one(of(w.name), w.about, &[], Form::Word))),
                Kind::SomeOf(words) => {
                    choices.extend(words.iter().map(|w| one(of(w.name), w.about, &[], Form::Listed)));
                }
                // Who moves a wall: its tables do, or a host, which is told by its name.
                Kind::Name(Family::Host) if matches!(key.need, Need::Optional) => {
                    choices.push(one(here, key.about, &[], Form::Named));
                }
                Kind::Table(keys) if matches!(key.need, Need::Optional) => {
                    choices.push(one(here, key.about, keys, Form::Table));
                }
                _ => {}
            }
        }
    });
    choices
}

#[cfg(test)]
mod tests {
    use super::choices;

    #[test]
    fn choices_are_told_as_they_are_typed() {
        let typed = |path: &str| choices().into_iter().find(|c| c.path == path).map(|c| c.typed());
        assert_eq!(typed("contact.normal.hertz").as_deref(), Some("[contact.normal.hertz]"));
        assert_eq!(typed("method.dem").as_deref(), Some("method = \"dem\""));
        assert_eq!(typed("water.lift.magnus").as_deref(), Some("water.lift = [\"magnus\"]"));
        assert_eq!(typed("walls.NAME.host").as_deref(), Some("walls.NAME.host = \"NAME\""));
        assert_eq!(typed("watch.NAME.slope").as_deref(), Some("[watch.NAME.slope]"));
    }

    #[test]
    fn keys_are_told_with_unit_range_and_default() {
        let all = choices();
        let hooke = all.iter().find(|c| c.path == "contact.normal.hooke").expect("a normal force");
        let told = hooke.key_texts().next().expect("a key");
        assert_eq!(
            (told.name, told.value.as_str(), told.default.as_str()),
            ("stiffness", "stiffness [N/m], above 0", "required")
        );
    }
}
