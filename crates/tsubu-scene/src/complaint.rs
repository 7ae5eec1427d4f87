//! Complaints: everything that is wrong with a scene, each with its place and a way out.
//!
//! They are collected, not thrown: a user who fixes a file wants to see all of it at once.

pub(crate) mod brief;
mod excerpt;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
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

    /// Points nowhere: what is wrong stands in no text.
    pub fn nowhere(self) -> Self {
        Self { place: None, also: Vec::new(), ..self }
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

    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref().map(|(place, _)| place)
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
        let title = Level::ERROR.primary_title(printable(&complaint.title));
        let mut group = Group::with_title(title);
        for snippet in self.snippets(complaint) {
            group = group.element(snippet);
        }
        for hint in &complaint.hints {
            group = group.element(Level::HELP.with_name("hint").message(printable(hint)));
        }
        let rendered = renderer.render(&[group]);
        // Without a snippet there is nothing for the bar between title and hints to lead to.
        if complaint.place.is_none() { rendered.replacen("\n |\n", "\n", 1) } else { rendered }
    }

    /// Places in the same text are shown together when they are near, each for itself otherwise.
    fn snippets<'a>(&'a self, complaint: &Complaint) -> Vec<Snippet<'a, Annotation<'a>>> {
        let Some((place, label)) = &complaint.place else { return Vec::new() };
        let mut together = vec![(place, label, AnnotationKind::Primary)];
        let mut apart = Vec::new();
        for (other, label) in &complaint.also {
            let near = other.source == place.source && other.start.abs_diff(place.start) < 4000;
            if near { &mut together } else { &mut apart }.push((other, label, AnnotationKind::Context));
        }
        let mut snippets = vec![self.snippet(&together)];
        snippets.extend(apart.iter().map(|one| self.snippet(std::slice::from_ref(one))));
        snippets
    }

    /// All marks are in the same text.
    fn snippet<'a>(&'a self, marks: &[(&Place, &String, AnnotationKind)]) -> Snippet<'a, Annotation<'a>> {
        let source = &self.sources[marks[0].0.source.min(self.sources.len() - 1)];
        let spans: Vec<Range<usize>> = marks.iter().map(|(place, ..)| place.start..place.end).collect();
        let mut cut = excerpt::cut_out(&source.text, &spans);
        if !source.numbered {
            cut.prepend(&format!("{} ", source.name));
        }
        let annotations =
            marks.iter().zip(cut.spans).map(|((_, label, kind), span)| kind.span(span).label(printable(label)));
        let snippet =
            Snippet::source(cut.text).line_numbering(source.numbered).line_start(cut.line).annotations(annotations);
        if source.numbered { snippet.path(printable(&source.name)) } else { snippet }
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

/// Text from a file may be long, and may hold control characters that would command the terminal.
fn printable(text: &str) -> String {
    brief::brief(text).chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}
