//! A key: one line of the table of keys, and what it can say; and [`variants!`], which tells a family of choices once.

use crate::units::{self, Dimension};

/// One key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The key as typed.
    pub name: &'static str,
    /// What its value is.
    pub kind: Kind,
    /// What happens when it is absent.
    pub need: Need,
    /// Which numbers are allowed.
    pub range: Range,
    /// Keys that say the same thing another way: only one of them may be given. It may name itself.
    pub rivals: &'static [&'static str],
    /// Whether a stage of a run may change it, and all that is below it.
    pub may_change: bool,
    /// One sentence for people.
    pub about: &'static str,
}

/// What a value is.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number in SI units, or text with a unit.
    Quantity(&'static Dimension),
    /// A whole number.
    Whole,
    /// Free text.
    Text,
    /// `true` or `false`.
    Flag,
    /// A list of whole numbers.
    Wholes,
    /// One of a few words.
    OneOf(&'static [Word]),
    /// A list of some of a few words, each once.
    SomeOf(&'static [Word]),
    /// A position or velocity: [x, z] in the plane, [x, y, z] in space.
    Vector(&'static Dimension),
    /// A list of vectors.
    Vectors(&'static Dimension),
    /// Something that belongs to turning: in the plane a number (about y), in space a vector.
    Turning(&'static Dimension),
    /// A list of the same.
    Turnings(&'static Dimension),
    /// A unit vector: "x", "-z", or a vector of any length but zero.
    Direction,
    /// A direction that may be y in the plane too: an axis of turning, or of a cylinder seen from its end.
    Axis,
    /// Gravity: a number (downward) or a vector.
    Gravity,
    /// An angle, or its tangent in percent.
    Slope,
    /// A list of quantities.
    Quantities(&'static Dimension),
    /// Two quantities, the first below the second.
    Ends(&'static Dimension),
    /// The strength of attraction; whether a force or an energy density, the cohesion part of the scene says.
    Cohesion,
    /// A square matrix of quantities, row by row.
    Matrix(&'static Dimension),
    /// A rising list of positive numbers, or `{ from, to }` with or without a `step`.
    Ratios,
    /// The name of something defined elsewhere in the scene.
    Name(Family),
    /// A list of such names, each once.
    Names(Family),
    /// Two material names.
    NamePair,
    /// A table of keys.
    Table(&'static [Key]),
    /// Tables under names the user chooses; the text says what one of them is.
    Named(&'static [Key], &'static str),
    /// An array of tables.
    Many(&'static [Key]),
    /// Exactly one of several named tables.
    Choice(&'static [Variant]),
    /// Choices under names the user chooses; the text says what one of them is.
    NamedChoice(&'static [Variant], &'static str),
    /// Scene keys (quoted) with the lists of values they take.
    Vary,
    /// Scene keys with the value that each has from a stage on: a piece of a scene.
    Set,
}

impl Kind {
    /// What its numbers measure; nothing for a cohesion, which may be one of two.
    pub const fn dimension(self) -> Option<&'static Dimension> {
        Some(match self {
            Self::Quantity(dimension)
            | Self::Vector(dimension)
            | Self::Vectors(dimension)
            | Self::Quantities(dimension)
            | Self::Ends(dimension)
            | Self::Turning(dimension)
            | Self::Turnings(dimension)
            | Self::Matrix(dimension) => dimension,
            Self::Slope => &units::ANGLE,
            Self::Gravity => &units::ACCELERATION,
            _ => return None,
        })
    }
}

/// A word that a key can take.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// The word as typed.
    pub name: &'static str,
    /// One sentence for people.
    pub about: &'static str,
}

/// One of the tables of a choice.
#[derive(Clone, Copy, Debug)]
pub struct Variant {
    /// The name as typed.
    pub name: &'static str,
    /// One sentence for people.
    pub about: &'static str,
    /// Its own keys.
    pub keys: &'static [Key],
}

/// Things that are defined under a name and referred to by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// `[materials.NAME]`.
    Material,
    /// `[hosts.NAME]`.
    Host,
    /// `[particles.NAME]`.
    Group,
    /// `[walls.NAME]`.
    Wall,
}

impl Family {
    /// The table in which they are defined.
    pub const fn table(self) -> &'static str {
        match self {
            Self::Material => "materials",
            Self::Host => "hosts",
            Self::Group => "particles",
            Self::Wall => "walls",
        }
    }

    /// What one is called.
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Material => "material",
            Self::Host => "host",
            Self::Group => "group of grains",
            Self::Wall => "wall",
        }
    }
}

/// What happens when a key is absent.
#[derive(Clone, Copy, Debug)]
pub enum Need {
    /// It is an error.
    Required,
    /// Nothing: the scene does not have it.
    Optional,
    /// This is read instead, as if it had been typed.
    Default(&'static str),
    /// The same as typing this word: the value is found later, or there is none.
    Word(&'static str),
    /// The value follows from others, as the text says.
    Derived(&'static str),
    /// The same as `Derived`; typing the word leaves it out.
    DerivedOrWord(&'static str, &'static str),
}

/// Which numbers are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub low: Bound,
    /// Upper end.
    pub high: Bound,
}

/// One end of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// No end.
    Open,
    /// The number itself is allowed.
    Including(f64),
    /// The number itself is not allowed.
    Excluding(f64),
}

impl Range {
    /// Any finite number.
    pub const ANY: Self = Self { low: Bound::Open, high: Bound::Open };

    /// Whether the number is inside.
    pub fn holds(&self, x: f64) -> bool {
        let low = match self.low {
            Bound::Open => true,
            Bound::Including(low) => x >= low,
            Bound::Excluding(low) => x > low,
        };
        let high = match self.high {
            Bound::Open => true,
            Bound::Including(high) => x <= high,
            Bound::Excluding(high) => x < high,
        };
        low && high
    }

    /// The range in words, `None` when anything goes: "above 0 and at most 1".
    pub fn words(&self) -> Option<String> {
        let low = match self.low {
            Bound::Open => None,
            Bound::Including(low) => Some(format!("at least {low}")),
            Bound::Excluding(low) => Some(format!("above {low}")),
        };
        let high = match self.high {
            Bound::Open => None,
            Bound::Including(high) => Some(format!("at most {high}")),
            Bound::Excluding(high) => Some(format!("below {high}")),
        };
        match (low, high) {
            (Some(low), Some(high)) => Some(format!("{low} and {high}")),
            (one, None) | (None, one) => one,
        }
    }
}

impl Key {
    /// The word that can stand in place of a value.
    pub const fn word_instead(&self) -> Option<&'static str> {
        match self.need {
            Need::Word(word) | Need::DerivedOrWord(_, word) => Some(word),
            _ => None,
        }
    }

    /// A required key without limits.
    pub const fn new(name: &'static str, kind: Kind, about: &'static str) -> Self {
        Self { name, kind, need: Need::Required, range: Range::ANY, rivals: &[], may_change: false, about }
    }

    pub(crate) const fn default(self, toml: &'static str) -> Self {
        Self { need: Need::Default(toml), ..self }
    }

    pub(crate) const fn optional(self) -> Self {
        Self { need: Need::Optional, ..self }
    }

    pub(crate) const fn word(self, word: &'static str) -> Self {
        Self { need: Need::Word(word), ..self }
    }

    pub(crate) const fn derived(self, text: &'static str) -> Self {
        Self { need: Need::Derived(text), ..self }
    }

    pub(crate) const fn derived_or_word(self, text: &'static str, word: &'static str) -> Self {
        Self { need: Need::DerivedOrWord(text, word), ..self }
    }

    pub(crate) const fn may_change(self) -> Self {
        Self { may_change: true, ..self }
    }

    pub(crate) const fn rivals(self, rivals: &'static [&'static str]) -> Self {
        Self { rivals, ..self }
    }

    pub(crate) const fn above(self, low: f64) -> Self {
        Self { range: Range { low: Bound::Excluding(low), ..self.range }, ..self }
    }

    pub(crate) const fn at_least(self, low: f64) -> Self {
        Self { range: Range { low: Bound::Including(low), ..self.range }, ..self }
    }

    pub(crate) const fn below(self, high: f64) -> Self {
        Self { range: Range { high: Bound::Excluding(high), ..self.range }, ..self }
    }

    pub(crate) const fn at_most(self, high: f64) -> Self {
        Self { range: Range { high: Bound::Including(high), ..self.range }, ..self }
    }
}

/// The key of that name in a table.
pub(crate) fn find(keys: &'static [Key], name: &str) -> Option<&'static Key> {
    keys.iter().find(|key| key.name == name)
}

/// A family of choices, told once: the enum of the plan, and the rows of the table of keys, `CHOICES`.
///
/// A choice is its name in the plan, its name in a scene, one sentence, and its keys: field, type, row of the table. The field
/// has the name of its key, with `_` for `-`.
macro_rules! variants {
    ($(#[$doc:meta])* $family:ident {
        $($variant:ident $name:literal $about:literal {
            $($(#[$field_doc:meta])* $field:ident: $type:ty = $key:expr),* $(,)?
        })*
    }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(rename_all_fields = "kebab-case", deny_unknown_fields)]
        pub enum $family {
            $(
                #[doc = $about]
                #[serde(rename = $name)]
                $variant {
                    $($(#[$field_doc])* $field: $type),*
                }
            ),*
        }

        impl $family {
            /// What a scene may say.
            pub(crate) const CHOICES: &'static [$crate::key::Variant] = &[
                $($crate::key::Variant { name: $name, about: $about, keys: &[$($key),*] }),*
            ];

            /// Name in scene files.
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $name),*
                }
            }
        }
    };
}
pub(crate) use variants;
