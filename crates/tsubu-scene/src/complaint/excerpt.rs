//! The part of a text that a message shows.

use std::ops::Range;

/// A line of a megabyte (one long list) would be copied for every complaint; what is near is enough.
const NEAR: usize = 100;
/// Bytes of a span that are marked; more of a long text nobody reads.
const MARKED: usize = 100;

/// Some lines of a text, ready to be printed.
pub(super) struct Excerpt {
    pub text: String,
    /// The number of the first line.
    pub line: usize,
    /// The marked spans, in the excerpt.
    pub spans: Vec<Range<usize>>,
}

impl Excerpt {
    /// Puts a word in front of the first line.
    pub fn prepend(&mut self, word: &str) {
        self.text.insert_str(0, word);
        for span in &mut self.spans {
            *span = span.start + word.len()..span.end + word.len();
        }
    }
}

/// The lines from the first to the last of the spans, of which there is at least one.
///
/// Of each span only the first line is marked: a wrong table of a hundred lines is known by its beginning. Spans may be
/// anything; they are moved into the text and onto whole characters.
pub(super) fn cut_out(text: &str, spans: &[Range<usize>]) -> Excerpt {
    let floor = |at: usize| {
        let at = at.min(text.len());
        (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
    };
    let line_end = |at: usize| {
        let end = text[at..].find('\n').map_or(text.len(), |length| at + length);
        at + text[at..end].trim_end_matches('\r').len()
    };
    let marked: Vec<Range<usize>> = spans
        .iter()
        .map(|span| {
            let start = floor(span.start);
            start..floor(span.end.min(start.saturating_add(MARKED))).clamp(start, line_end(start))
        })
        .collect();
    let first = marked.iter().map(|span| span.start).min().unwrap_or(0);
    let last = marked.iter().map(|span| span.end).max().unwrap_or(0);
    let begin = text[..first].rfind('\n').map_or(0, |at| at + 1);
    let line = text[..begin].matches('\n').count() + 1;
    // A byte order mark is not seen by the user and must not shift the column.
    let mark = if begin == 0 && text.starts_with('\u{feff}') && first > 0 { '\u{feff}'.len_utf8() } else { 0 };
    let from = floor(first.saturating_sub(NEAR)).max(begin + mark);
    let until = floor(last.saturating_add(NEAR)).clamp(last, line_end(last));
    let tamed = |range: Range<usize>| text[range].chars().map(tame).collect::<String>();
    let spans = marked
        .iter()
        .map(|span| {
            let lead = tamed(from..span.start.max(from)).len();
            lead..lead + tamed(span.start.max(from)..span.end.max(from)).len()
        })
        .collect();
    Excerpt { text: tamed(from..until), line, spans }
}

/// Control characters would move the columns or command the terminal.
fn tame(c: char) -> char {
    match c {
        '\n' => '\n',
        '\t' | '\r' => ' ',
        c if c.is_control() => '\u{fffd}',
        c => c,
    }
}
