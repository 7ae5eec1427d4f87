//! Values with a direction: vectors, axes, spins.

use super::Resolver;
use crate::complaint::Complaint;
use crate::keys::Key;
use crate::node::{Node, Value};
use crate::units::{Dimension, NUMBER, SPIN};

impl Resolver<'_> {
    /// Two entries [x, z] in the plane, three in space; y is there but zero in the plane.
    pub(super) fn vector(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<[f64; 3]> {
        let form = if self.dimension == Some(3) { "[x, y, z]" } else { "[x, z]" };
        if matches!(&node.value, Value::Text(text) if text == "origin") {
            return Some([0.0; 3]);
        }
        let Value::List(items) = &node.value else {
            self.wrong_kind(key, node, &format!("a vector {form}"), None);
            return None;
        };
        let entries: Vec<Option<f64>> = items.iter().map(|item| self.quantity(key, item, dimension)).collect();
        let entries: Vec<f64> = entries.into_iter().collect::<Option<_>>()?;
        let complaint = match (entries.as_slice(), self.dimension) {
            (&[x, z], Some(2) | None) => return Some([x, 0.0, z]),
            (&[x, y, z], Some(3) | None) => return Some([x, y, z]),
            (&[x, y, z], _) if y == 0.0 => return Some([x, y, z]),
            ([_, y, _], _) => Complaint::new(format!("`{}` leaves the plane", key.name))
                .at(&node.place, format!("y is {y}, but the scene has dimension 2"))
                .hint("write [x, z], or set dimension = 3"),
            ([_, _], _) => Complaint::new(format!("`{}` needs three entries in space", key.name))
                .at(&node.place, "two entries, but the scene has dimension 3")
                .hint("write [x, y, z], or set dimension = 2"),
            (other, _) => Complaint::new(format!("`{}` needs a vector {form}", key.name))
                .at(&node.place, format!("this list has {} entries", other.len())),
        };
        self.complain(complaint);
        None
    }

    /// About y in the plane, any way in space.
    pub(super) fn turning(&mut self, key: &Key, node: &Node, dimension: &Dimension) -> Option<[f64; 3]> {
        let Value::List(items) = &node.value else {
            if self.dimension == Some(3) {
                let example = if *dimension == SPIN { "[0, 10, 0]" } else { "[2e-5, 2e-5, 1e-5]" };
                self.wrong_kind(key, node, "a vector [x, y, z] in space", Some(example.to_string()));
                return None;
            }
            return self.quantity(key, node, dimension).map(|about_y| [0.0, about_y, 0.0]);
        };
        let entries: Vec<Option<f64>> = items.iter().map(|item| self.quantity(key, item, dimension)).collect();
        let entries: Vec<f64> = entries.into_iter().collect::<Option<_>>()?;
        match (entries.as_slice(), self.dimension) {
            (&[x, y, z], Some(3) | None) => Some([x, y, z]),
            (&[x, y, z], _) if x == 0.0 && z == 0.0 => Some([x, y, z]),
            _ => {
                self.complain(
                    Complaint::new(format!("`{}` does not fit the dimension of the scene", key.name))
                        .at(&node.place, format!("not {}", dimension.name))
                        .hint("in the plane it is a number (about y), in space a vector [x, y, z]"),
                );
                None
            }
        }
    }

    /// `axis`: whether it may leave the plane.
    pub(super) fn direction(&mut self, key: &Key, node: &Node, axis: bool) -> Option<[f64; 3]> {
        let flat = self.dimension == Some(2);
        if let Value::Text(text) = &node.value {
            let (sign, letter) = match text.strip_prefix(['-', '+']) {
                Some(letter) => (if text.starts_with('-') { -1.0 } else { 1.0 }, letter),
                None => (1.0, text.as_str()),
            };
            match letter {
                "x" => return Some([sign, 0.0, 0.0]),
                "y" if !flat || axis => return Some([0.0, sign, 0.0]),
                "z" => return Some([0.0, 0.0, sign]),
                _ => {}
            }
            let axes =
                if flat && !axis { "\"x\", \"-x\", \"z\", \"-z\"" } else { "\"x\", \"y\", \"z\" with or without -" };
            self.complain(
                Complaint::new(format!("`{}`: `{text}` is not a direction", key.name))
                    .at(&node.place, "not an axis here")
                    .hint(format!("write {axes} or a vector")),
            );
            return None;
        }
        let vector = if axis { self.any_vector(key, node)? } else { self.vector(key, node, &NUMBER)? };
        let largest = vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        if largest == 0.0 {
            self.complain(
                Complaint::new(format!("`{}` has no direction", key.name)).at(&node.place, "all entries are 0"),
            );
            return None;
        }
        // Scaled first, so that squares of tiny and huge entries neither vanish nor overflow.
        let scaled = vector.map(|x| x / largest);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        // A unit vector is kept as it is: dividing once more would move its last bit on every round trip.
        if (length * largest - 1.0).abs() < 1e-12 { Some(vector) } else { Some(scaled.map(|x| x / length)) }
    }

    /// A vector that need not stay in the plane: two entries mean y = 0 there.
    fn any_vector(&mut self, key: &Key, node: &Node) -> Option<[f64; 3]> {
        let known = self.dimension;
        if matches!(&node.value, Value::List(items) if items.len() == 3) {
            self.dimension = Some(3);
        }
        let vector = self.vector(key, node, &NUMBER);
        self.dimension = known;
        vector
    }
}

pub(super) fn vector_value(vector: [f64; 3]) -> toml::Value {
    toml::Value::Array(vector.into_iter().map(toml::Value::Float).collect())
}
