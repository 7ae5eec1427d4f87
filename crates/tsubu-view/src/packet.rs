//! What goes over the wire for a frame: a head in JSON that says what follows, then plain numbers of 4 bytes, little-endian.
//!
//! The head is preceded by its length (4 bytes) and padded with blanks to a multiple of 4, so that a browser can lay its arrays over
//! the numbers without copying them.

use serde_json::{Value, json};

/// A packet in the making.
#[derive(Default)]
pub struct Packet {
    arrays: Vec<Value>,
    bytes: Vec<u8>,
}

impl Packet {
    /// Adds real numbers, in single precision.
    pub fn reals(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        self.add(name, "f32", values.into_iter().map(|x| (x as f32).to_le_bytes()));
    }

    /// Adds whole numbers.
    pub fn integers(&mut self, name: &str, values: impl IntoIterator<Item = i64>) {
        self.add(name, "i32", values.into_iter().map(|x| (x as i32).to_le_bytes()));
    }

    fn add(&mut self, name: &str, kind: &str, words: impl Iterator<Item = [u8; 4]>) {
        let before = self.bytes.len();
        words.for_each(|word| self.bytes.extend(word));
        self.arrays.push(json!({ "name": name, "type": kind, "length": (self.bytes.len() - before) / 4 }));
    }

    /// The whole, behind a head that says `about` too.
    pub fn seal(self, mut about: Value) -> Vec<u8> {
        about["arrays"] = self.arrays.into();
        let mut head = about.to_string();
        head.extend(std::iter::repeat_n(' ', head.len().next_multiple_of(4) - head.len()));
        let mut whole = Vec::with_capacity(4 + head.len() + self.bytes.len());
        whole.extend((head.len() as u32).to_le_bytes());
        whole.extend(head.as_bytes());
        whole.extend(self.bytes);
        whole
    }
}
