//! Single values: quantities, words, vectors, lists, names.

use super::Resolver;
use super::vector::vector_value;
use crate::complaint::Complaint;
use crate::keys::{Bound, Family, Key, Kind, Word};
use crate::node::{Node, Value};
use crate::plan::{READ_A_DENSITY, READ_A_FORCE};
use crate::suggest;
use crate::units::{self, ACCELERATION, ANGLE, Dimension, ENERGY_DENSITY, FORCE, NUMBER, SPIN};

/// Enough for any curve; guards against `step = 1e-12`.
const MOST_RATIOS: f64 = 10_000.0;
/// Where no step is given: steps are at most this long, and there are at least so many.
const COARSE: f64 = 0.04;
const FEW: f64 = 8.0;

impl Resolver<'_> {
    pub(super) fn leaf(&mut self, key: &'static Key, node: &Node) -> Option<toml::Value> {
        if let (Some(word), Value::Text(text)) = (key.word_instead(), &node.value)
            && text == word
        {
            return None;
        }
        match key.kind {
            Kind::Quantity(dimension) => self.ranged(key, node, dimension).map(toml::Value::Float),
            Kind::Whole => self.whole(key, node),
            Kind::Text => match &node.value {
                Value::Text(text) => Some(toml::Value::String(text.clone())),
                _ => self.wrong_kind(key, node, "text in quotes", None),
            },
            Kind::Flag => match node.value {
                Value::Flag(flag) => Some(toml::Value::Boolean(flag)),
                _ => self.wrong_kind(key, node, "true or false", None),
            },
            Kind::OneOf(words) => self.one_of(key, words, node),
            Kind::Vector(dimension) => self.vector(key, node, dimension).map(vector_value),
            Kind::Vectors(dimension) => {
                self.list(key, node, "a list of vectors", |me, item| me.vector(key, item, dimension).map(vector_value))
            }
            Kind::Turning(dimension) => self.turning(key, node, dimension).map(vector_value),
            Kind::Turnings(dimension) => {
                let what = if *dimension == SPIN { "a list of spins" } else { "a list of rotations" };
                self.list(key, node, what, |me, item| me.turning(key, item, dimension).map(vector_value))
            }
            Kind::Direction => self.direction(key, node, false).map(vector_value),
            Kind::Axis => self.direction(key, node, true).map(vector_value),
            Kind::Slope => match &node.value {
                Value::Text(text) if text.trim_end().ends_with('%') => {
                    self.ranged(key, node, &NUMBER).map(|tangent| toml::Value::Float(tangent.atan()))
                }
                _ => self.ranged(key, node, &ANGLE).map(toml::Value::Float),
            },
            Kind::Gravity => match node.value {
                Value::List(_) => self.vector(key, node, &ACCELERATION).map(vector_value),
                // Not -g: that would turn no gravity into a negative zero.
                _ => self.ranged(key, node, &ACCELERATION).map(|g| vector_value([0.0, 0.0, 0.0 - g])),
            },
            Kind::Quantities(dimension) => self.quantities(key, node, dimension),
            Kind::Ends(dimension) => self.ends(key, node, dimension),
            Kind::Cohesion => self.cohesion(key, node),
            Kind::Matrix(dimension) => self.matrix(key, node, dimension),
            Kind::Ratios => self.ratios(key, node),
            Kind::Name(family) => self.name(key, family, node),
            Kind::Wholes | Kind::SomeOf(_) | Kind::Names(_) => self.several(key, node),
            Kind::NamePair => self.name_pair(key, node),
            Kind::Vary => self.vary(key, node),
            // What is set is read with the stage in which it holds.
            Kind::Set => match &node.value {
                Value::Table(_) => node.plain(),
                _ => self.wrong_kind(key, node, "a table of scene keys", None),
            },
            Kind::Table(_) | Kind::Named(..) | Kind::Many(_) | Kind::Choice(_) | Kind::NamedChoice(..) => None,
        }
    }

    pub(super) fn wrong_kind(
        &mut self,
        key: &Key,
        node: &Node,
        needs: &str,
        example: Option<String>,
    ) -> Option<toml::Value> {
        let mut complaint = Complaint::new(format!("`{}` needs {needs}, not {}", key.name, node.kind()))
            .at(&node.place, format!("this is {}", node.kind()));
        if let Some(example) = example {
            complaint = complaint.hint(format!("for example {example}"));
        }
        self.complain(complaint);
        None
    }

    pub(super) fn quantity(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<f64> {
        let value = self.typed_quantity(key, node, dimension)?;
        // A coordinate may come out near zero; what has to be above zero is not rounding.
        let above_zero = key.range.low == Bound::Excluding(0.0) && value > 0.0;
        // Of a direction the length is not meant.
        let counts = !matches!(key.kind, Kind::Direction | Kind::Axis);
        if let Some(why) = dimension.absurd(value, above_zero).filter(|_| counts) {
            let told = format!("{value} {}", dimension.si);
            self.complain(
                Complaint::new(format!("`{}` cannot be meant: {} {why}", key.name, told.trim_end()))
                    .at(&node.place, format!("needs {} that something can have", dimension.name)),
            );
            return None;
        }
        Some(value)
    }

    fn typed_quantity(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<f64> {
        match &node.value {
            Value::Number(number) if number.is_finite() => Some(*number),
            Value::Whole(whole) => Some(*whole as f64),
            Value::Number(_) => {
                self.complain(
                    Complaint::new(format!("`{}` is not a finite number", key.name))
                        .at(&node.place, format!("needs {}", dimension.name)),
                );
                None
            }
            Value::Text(text) => match units::read(text, dimension) {
                Ok(value) => Some(value),
                Err(error) => {
                    let title = format!("`{}`: {}", key.name, error.title);
                    let word = key.word_instead().map(|word| format!("or the word \"{word}\""));
                    self.complain(Complaint::new(title).at(&node.place, error.label).hints(error.hints).hints(word));
                    None
                }
            },
            _ => {
                self.wrong_kind(key, node, dimension.name, Some(dimension.examples_text()));
                None
            }
        }
    }

    fn ranged(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<f64> {
        let value = self.quantity(key, node, dimension)?;
        self.in_range(key, node, value, dimension.name).then_some(value)
    }

    fn in_range(&mut self, key: &Key, node: &Node, value: f64, what: &str) -> bool {
        let inside = key.range.holds(value);
        if let (false, Some(words)) = (inside, key.range.words()) {
            self.complain(
                Complaint::new(format!("`{}` must be {words}", key.name))
                    .at(&node.place, format!("needs {what} {words}")),
            );
        }
        inside
    }

    pub(super) fn whole(&mut self, key: &Key, node: &Node) -> Option<toml::Value> {
        let Value::Whole(whole) = node.value else {
            if !matches!(node.value, Value::Number(_)) {
                return self.wrong_kind(key, node, "a whole number", Some("10, without quotes".to_string()));
            }
            self.complain(
                Complaint::new(format!("`{}` needs a whole number", key.name))
                    .at(&node.place, "has a point or too many digits"),
            );
            return None;
        };
        self.in_range(key, node, whole as f64, "a whole number").then_some(toml::Value::Integer(whole))
    }

    pub(super) fn one_of(&mut self, key: &Key, words: &'static [Word], node: &Node) -> Option<toml::Value> {
        let names = || words.iter().map(|word| word.name);
        let Value::Text(text) = &node.value else {
            return self.wrong_kind(key, node, &format!("one of {}", suggest::list(names())), None);
        };
        if names().any(|name| name == text) {
            return Some(toml::Value::String(text.clone()));
        }
        let mut complaint = Complaint::new(format!("unknown `{}`: `{text}`", key.name))
            .at(&node.place, "not one of the words known here");
        if let Some(near) = suggest::nearest(text, names()) {
            complaint = complaint.hint(format!("did you mean \"{near}\"?"));
        }
        let lines = words.iter().map(|word| format!("\"{}\": {}", word.name, word.about));
        self.complain(complaint.hints(lines));
        None
    }

    pub(super) fn list(
        &mut self,
        key: &Key,
        node: &Node,
        needs: &str,
        mut item: impl FnMut(&mut Self, &Node) -> Option<toml::Value>,
    ) -> Option<toml::Value> {
        let Value::List(nodes) = &node.value else {
            return self.wrong_kind(key, node, needs, None);
        };
        // Look at every item before giving up: all complaints at once.
        let values: Vec<Option<toml::Value>> = nodes.iter().map(|node| item(self, node)).collect();
        values.into_iter().collect::<Option<Vec<_>>>().map(toml::Value::Array)
    }

    fn quantities(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<toml::Value> {
        let needs = format!("a list; each entry is {}", dimension.name);
        self.list(key, node, &needs, |me, item| me.ranged(key, item, dimension).map(toml::Value::Float))
    }

    fn ends(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<toml::Value> {
        let list = self.list(key, node, "a list of two ends", |me, item| {
            me.ranged(key, item, dimension).map(toml::Value::Float)
        })?;
        let ends: Vec<f64> = list.as_array()?.iter().filter_map(toml::Value::as_float).collect();
        let label = match ends.as_slice() {
            [low, high] if low < high => return Some(list),
            [low, high] => format!("{high} {0} is not above {low} {0}", dimension.si),
            other => format!("entries in this list: {}", other.len()),
        };
        self.complain(
            Complaint::new(format!("`{}` needs two ends, the low one first", key.name))
                .at(&node.place, label)
                .hint(format!("for example {} = [\"1 {1}\", \"2 {1}\"]", key.name, dimension.si)),
        );
        None
    }

    /// Materials stand above the contact law in a scene, but what their cohesion is the law says.
    fn cohesion(&mut self, key: &Key, node: &Node) -> Option<toml::Value> {
        let pairs = match self.root.find(&["material-pair"]).map(|pairs| &pairs.value) {
            Some(Value::List(pairs)) => pairs.as_slice(),
            _ => &[],
        };
        let chosen = |kinds: &[&str]| {
            let says = |node: &Node| kinds.iter().any(|kind| node.find(&["contact", "cohesion", kind]).is_some());
            says(self.root) || pairs.iter().any(says)
        };
        let dimension = match (chosen(READ_A_FORCE), chosen(READ_A_DENSITY), &node.value) {
            (true, false, _) => &FORCE,
            (false, true, _) => &ENERGY_DENSITY,
            // Nobody reads it: either will do. Where both parts are chosen, who reads what is checked pair by pair.
            (_, _, Value::Text(text)) if units::read(text, &ENERGY_DENSITY).is_ok() => &ENERGY_DENSITY,
            _ => &FORCE,
        };
        self.ranged(key, node, dimension).map(toml::Value::Float)
    }

    fn matrix(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<toml::Value> {
        let rows = self.list(key, node, "a matrix, a list of rows", |me, row| me.quantities(key, row, dimension))?;
        let sizes: Vec<usize> = rows.as_array()?.iter().filter_map(toml::Value::as_array).map(Vec::len).collect();
        if sizes.is_empty() || sizes.iter().any(|size| *size != sizes.len()) {
            self.complain(
                Complaint::new(format!("`{}` is not a square matrix", key.name))
                    .at(&node.place, format!("rows: {}, their lengths: {sizes:?}", sizes.len())),
            );
            return None;
        }
        Some(rows)
    }

    fn ratios(&mut self, key: &Key, node: &Node) -> Option<toml::Value> {
        const FORM: &str = "a list of numbers, or { from = 0.85, to = 1.15 }, or with a `step`";
        let (values, place) = match &node.value {
            Value::List(_) => {
                let list = self.quantities(key, node, &NUMBER)?;
                (list.as_array()?.iter().filter_map(toml::Value::as_float).collect::<Vec<f64>>(), &node.place)
            }
            Value::Table(table) => {
                let mut ends = [0.0; 3];
                for (end, name) in ends.iter_mut().zip(["from", "to", "step"]) {
                    let entry = table.get(name);
                    if entry.is_none() && name == "step" {
                        continue;
                    }
                    let Some(entry) = entry else {
                        self.complain(
                            Complaint::new(format!("`{}` has no `{name}`", key.name))
                                .at(&node.place, format!("needs `{name}`"))
                                .hint(FORM),
                        );
                        return None;
                    };
                    *end = self.quantity(key, entry, &NUMBER)?;
                }
                if let Some(extra) =
                    table.entries.iter().find(|entry| !["from", "to", "step"].contains(&entry.key.as_str()))
                {
                    self.complain(
                        Complaint::new(format!("unknown key `{}` in `{}`", extra.key, key.name))
                            .at(&extra.place, "not a key here")
                            .hint("keys here: `from`, `to`, `step`"),
                    );
                    return None;
                }
                let [from, to, mut step] = ends;
                if table.get("step").is_none() && to > from {
                    step = (to - from) / ((to - from) / COARSE).ceil().max(FEW);
                }
                let steps = ((to - from) / step).round();
                if !(step > 0.0 && to >= from && steps < MOST_RATIOS) {
                    self.complain(
                        Complaint::new(format!("`{}` does not lead from {from} to {to}", key.name))
                            .at(&node.place, format!("with steps of {step}"))
                            .hint(format!("`step` must be above 0, `to` at least `from`, and there can be {MOST_RATIOS} values at most")),
                    );
                    return None;
                }
                // 0.85 + 7 * 0.01 is 0.9199999999999999; nobody means that.
                let tidy = |x: f64| format!("{x:.12e}").parse().unwrap_or(x);
                (
                    (0..=steps as usize)
                        .map(|i| tidy(from + i as f64 * step))
                        .filter(|x| *x <= to + 1e-9 * step)
                        .collect(),
                    &node.place,
                )
            }
            _ => return self.wrong_kind(key, node, FORM, None),
        };
        let rising = values.windows(2).all(|pair| pair[0] < pair[1]);
        if values.is_empty() || values[0] <= 0.0 || !rising {
            let label = if values.is_empty() {
                "the list is empty"
            } else {
                "numbers above 0, each larger than the one before"
            };
            self.complain(Complaint::new(format!("`{}` needs rising numbers above 0", key.name)).at(place, label));
            return None;
        }
        Some(toml::Value::Array(values.into_iter().map(toml::Value::Float).collect()))
    }

    pub(super) fn name(&mut self, key: &Key, family: Family, node: &Node) -> Option<toml::Value> {
        let Value::Text(text) = &node.value else {
            return self.wrong_kind(key, node, &format!("the name of a {} in quotes", family.noun()), None);
        };
        let known = self.names(family);
        if known.contains(&text.as_str()) {
            return Some(toml::Value::String(text.clone()));
        }
        let (noun, table) = (family.noun(), family.table());
        let mut complaint =
            Complaint::new(format!("unknown {noun} `{text}`")).at(&node.place, format!("not in [{table}]"));
        if let Some(near) = suggest::nearest(text, known.iter().copied()) {
            complaint = complaint.hint(format!("did you mean `{near}`?"));
        }
        let complaint = if known.is_empty() {
            complaint.hint(format!("this scene has no {table}: add [{table}.NAME]"))
        } else {
            complaint.hint(format!("{table} here: {}", suggest::list(known)))
        };
        self.complain(complaint);
        None
    }

    fn name_pair(&mut self, key: &Key, node: &Node) -> Option<toml::Value> {
        let names =
            self.list(key, node, "two material names in a list", |me, item| me.name(key, Family::Material, item))?;
        if names.as_array().is_some_and(|names| names.len() == 2) {
            return Some(names);
        }
        self.complain(
            Complaint::new(format!("`{}` needs two names", key.name)).at(&node.place, "[\"one\", \"other\"]"),
        );
        None
    }
}
