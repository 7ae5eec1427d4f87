//! Text files of rows: lines with their numbers, cells with their places.

use crate::complaint::{Complaint, Place};
use std::str::Utf8Error;

/// A file of the wrong format is wrong in every line; a few are enough to see it.
pub(crate) const MOST_COMPLAINTS: usize = 5;

/// A line without the blanks around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    pub text: &'a str,
    /// Where it begins in the file, in bytes.
    pub begin: usize,
    /// Counted from 1.
    pub number: u32,
}

/// A cell of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<'a> {
    pub text: &'a str,
    pub begin: usize,
}

/// Every line of a text, blank ones too.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut begin = 0;
    let mut number = 0;
    text.split_inclusive('\n').map(move |raw| {
        let text = raw.trim_start_matches('\u{feff}').trim();
        let line = Line { text, begin: begin + offset(raw, text), number: number + 1 };
        begin += raw.len();
        number += 1;
        line
    })
}

impl<'a> Line<'a> {
    pub fn place(&self, source: usize) -> Place {
        Place::new(source, self.begin..self.begin + self.text.len())
    }

    /// The line up to a mark of comments.
    pub fn before(&self, mark: char) -> Self {
        let text = self.text.split(mark).next().unwrap_or_default().trim_end();
        Self { text, ..*self }
    }

    /// The line behind the marks of comments that it begins with.
    pub fn behind(&self, mark: char) -> Self {
        let text = self.text.trim_start_matches(mark).trim_start();
        Self { text, begin: self.begin + offset(self.text, text), ..*self }
    }

    /// What separates the cells: a sign if there is one, otherwise blanks.
    pub fn separator(&self) -> Option<char> {
        [';', '\t', ','].into_iter().find(|separator| self.text.contains(*separator))
    }

    pub fn cells(&self, separator: Option<char>) -> impl Iterator<Item = Cell<'a>> + use<'a> {
        let whole = self.text;
        let begin = self.begin;
        // Aligned columns have runs of blanks between them; two commas have an empty cell.
        let parts = whole.split(move |c: char| separator.map_or(c.is_whitespace(), |separator| c == separator));
        parts
            .map(str::trim)
            .filter(move |part| separator.is_some() || !part.is_empty())
            .map(move |text| Cell { text, begin: begin + offset(whole, text) })
    }
}

impl Cell<'_> {
    pub fn place(&self, source: usize) -> Place {
        Place::new(source, self.begin..self.begin + self.text.len())
    }
}

/// Where a part of a text begins in it.
fn offset(whole: &str, part: &str) -> usize {
    (part.as_ptr() as usize).saturating_sub(whole.as_ptr() as usize).min(whole.len())
}

/// The complaint about the first byte that is no text, in a source that shows it as one character.
pub(crate) fn no_text(bytes: &[u8], error: &Utf8Error, source: usize) -> Complaint {
    let at = error.valid_up_to();
    let byte = bytes.get(at).copied().unwrap_or_default();
    // What is before the byte is the same in both texts; the byte has become a character of three.
    Complaint::new("the file is not UTF-8 text")
        .at(&Place::new(source, at..at + 3), format!("the byte 0x{byte:02x} is no character"))
        .hint("save it as UTF-8; was another file meant?")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_know_their_place() {
        let text = "\u{feff}a\r\n\n  1.5   -2 # end\nx;; y\n";
        let all: Vec<Line<'_>> = lines(text).collect();
        assert_eq!(all.iter().map(|line| line.number).collect::<Vec<_>>(), [1, 2, 3, 4]);
        let cells: Vec<Cell<'_>> = all[2].before('#').cells(None).collect();
        assert_eq!(cells.iter().map(|cell| cell.text).collect::<Vec<_>>(), ["1.5", "-2"]);
        for cell in cells {
            assert_eq!(&text[cell.begin..cell.begin + cell.text.len()], cell.text);
        }
        assert_eq!(all[3].separator(), Some(';'));
        assert_eq!(all[3].cells(Some(';')).map(|cell| cell.text).collect::<Vec<_>>(), ["x", "", "y"]);
        assert_eq!(&text[all[0].begin..=all[0].begin], "a");
    }
}
