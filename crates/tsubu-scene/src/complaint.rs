//! Complaints: everything that is wrong with a scene, each with its place and a way out.
//!
//! They are collected, not thrown: a user who fixes a file wants to see all of it at once.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// A text that complaints can point into: the scene, one `--set`, or a CSV file.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// What the user calls it.
    pub name: String,
    pub text: String,
    /// Whether line numbers mean anything to the user; they do not for `--set`.
    pub numbered: bool,
}

/// A stretch of bytes in one of the sources.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    pub source: usize,
    pub start: usize,
    pub end: usize,
}

impl Place {
    pub fn new(source: usize, span: Range<usize>) -> Self {
        Self { source, start: span.start, end: span.end }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Complaint {
    title: String,
    place: Option<(Place, String)>,
    also: Vec<(Place, String)>,
    hints: Vec<String>,
}

impl Complaint {
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), place: None, also: Vec::new(), hints: Vec::new() }
    }

    /// Points at the offending text, with a few words under it.
    pub fn at(mut self, place: &Place, label: impl Into<String>) -> Self {
        self.place = Some((place.clone(), label.into()));
        self
    }

    /// Points at other text that has to do with it.
    pub fn also(mut self, place: &Place, label: impl Into<String>) -> Self {
        self.also.push((place.clone(), label.into()));
        self
    }

    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    pub fn hints(mut self, hints: impl IntoIterator<Item = String>) -> Self {
        self.hints.extend(hints);
        self
    }

    pub fn title(&self) -> &str {
        &self.title
    }
}

/// Everything that is wrong with a scene; never empty.
///
/// `Display` gives plain text; [`Complaints::render`] can colour it for a terminal.
#[derive(Clone)]
pub struct Complaints {
    sources: Vec<Source>,
    list: Vec<Complaint>,
}

/// A file of garbage has thousands of errors, and nobody reads past the first screens.
const SHOWN: usize = 40;

impl Complaints {
    pub(crate) fn new(sources: Vec<Source>, mut list: Vec<Complaint>) -> Self {
        // In the order of the text; what has no place comes last.
        list.sort_by_cached_key(|complaint| {
            (complaint.place.is_none(), complaint.place.as_ref().map(|(place, _)| place.clone()))
        });
        list.dedup();
        Self { sources, list }
    }

    /// How many there are; at least one.
    #[expect(clippy::len_without_is_empty, reason = "never empty: without complaints there is a scene")]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// The first line of each complaint, without place and hints.
    pub fn titles(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(Complaint::title)
    }

    /// The messages as a user should see them, with or without terminal colours.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() }.decor_style(DecorStyle::Ascii);
        let mut blocks: Vec<String> =
            self.list.iter().take(SHOWN).map(|complaint| self.render_one(&renderer, complaint)).collect();
        if self.list.len() > SHOWN {
            blocks.push(format!("... and {} more", self.list.len() - SHOWN));
        }
        if self.list.len() > 1 {
            blocks.push(format!("{} errors", self.list.len()));
        }
        blocks.join("\n\n")
    }

    fn render_one(&self, renderer: &Renderer, complaint: &Complaint) -> String {
        let Some((place, label)) = &complaint.place else {
            let title = Level::ERROR.primary_title(printable(&complaint.title));
            let hints = complaint.hints.iter().map(|hint| Level::HELP.with_name("hint").message(printable(hint)));
            return renderer.render(&[Group::with_title(title).elements(hints)]);
        };
        let mut group = Group::with_title(Level::ERROR.primary_title(printable(&complaint.title)));
        group = group.element(self.snippet(place, label, AnnotationKind::Primary));
        for (other, text) in &complaint.also {
            group = group.element(self.snippet(other, text, AnnotationKind::Context));
        }
        for hint in &complaint.hints {
            group = group.element(Level::HELP.with_name("hint").message(printable(hint)));
        }
        renderer.render(&[group])
    }

    fn snippet<'a>(
        &'a self,
        place: &Place,
        label: &str,
        kind: AnnotationKind,
    ) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
        let source = &self.sources[place.source.min(self.sources.len() - 1)];
        let cut = cut_out(&source.text, place.start..place.end);
        Snippet::source(cut.text)
            .path(source.name.as_str())
            .line_numbering(source.numbered)
            .line_start(cut.line)
            .annotation(kind.span(cut.span).label(printable(label)))
    }
}

impl fmt::Display for Complaints {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

/// The same as `Display`: the derived form would print whole source texts.
impl fmt::Debug for Complaints {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

impl std::error::Error for Complaints {}

/// Text from a file may hold control characters that would command the terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}

/// The lines around a span, ready to be printed.
struct Cut {
    text: String,
    line: usize,
    span: Range<usize>,
}

/// Only the first line of the span is shown: a wrong table of a hundred lines is known by its beginning.
fn cut_out(text: &str, span: Range<usize>) -> Cut {
    let floor = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = floor(span.start);
    let begin = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
    let line_end = begin + text[begin..line_end].trim_end_matches('\r').len();
    let start = start.min(line_end);
    let end = floor(span.end).clamp(start, line_end);
    let line = text[..begin].matches('\n').count() + 1;
    // A byte order mark is not seen by the user and must not shift the column.
    let begin = if text[begin..].starts_with('\u{feff}') { (begin + 3).min(start.max(begin)) } else { begin };
    // A line of a megabyte (one long list) would be copied for every complaint; what is near is enough.
    let from = floor(start.saturating_sub(2000)).max(begin);
    let until = floor(end.saturating_add(2000)).clamp(end, line_end);
    let shown: String = text[from..until].chars().map(tame).collect();
    let lead: usize = text[from..start].chars().map(|c| tame(c).len_utf8()).sum();
    let width: usize = text[start..end].chars().map(|c| tame(c).len_utf8()).sum();
    Cut { text: shown, line, span: lead..lead + width }
}

fn tame(c: char) -> char {
    match c {
        '\t' => ' ',
        c if c.is_control() => '\u{fffd}',
        c => c,
    }
}
