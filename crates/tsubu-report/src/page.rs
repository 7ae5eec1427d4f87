//! The report page: a [`Report`] is what it says, [`Report::to_html`] is one file that needs nothing else.

use std::fmt::Write as _;

use base64::Engine as _;

use crate::text::{self, escape, marked, plain};

/// How good or bad something is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Neither.
    #[default]
    Plain,
    /// As it should be.
    Good,
    /// To be looked at.
    Warning,
    /// Not as it should be.
    Bad,
}

impl Tone {
    fn class(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Good => "good",
            Self::Warning => "warning",
            Self::Bad => "bad",
        }
    }
}

/// A key number at the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Card {
    /// What it is.
    pub label: String,
    /// The number.
    pub value: String,
    /// Its unit, if any.
    pub unit: String,
    /// A short remark below.
    pub note: String,
    /// How good it is.
    pub tone: Tone,
}

/// A card in one line.
pub(crate) fn card(label: &str, value: String, unit: &str, note: String, tone: Tone) -> Card {
    Card { label: label.to_owned(), value, unit: unit.to_owned(), note, tone }
}

/// A table as it is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Header cells.
    pub header: Vec<String>,
    /// Rows with their tone; columns of numbers are set flush right by themselves.
    pub rows: Vec<(Tone, Vec<String>)>,
}

impl Grid {
    /// An empty table.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self { header: header.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn push<S: Into<String>>(&mut self, tone: Tone, row: impl IntoIterator<Item = S>) {
        self.rows.push((tone, row.into_iter().map(Into::into).collect()));
    }
}

/// A piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A remark that stands out.
    Note(Tone, String),
    /// A drawing (trusted SVG, made by this crate) with its caption.
    Drawing {
        /// The SVG.
        svg: String,
        /// What is seen.
        caption: String,
    },
    /// A picture in pixels.
    Picture {
        /// `image/png`, `image/gif`.
        media: &'static str,
        /// The file.
        bytes: Vec<u8>,
        /// What is seen.
        caption: String,
    },
    /// A page in the page: grains that can be turned and played.
    View {
        /// The document (trusted, made by `tsubu-view`).
        html: String,
        /// What is seen, and what is left out.
        caption: String,
    },
    /// A table.
    Table(Grid),
    /// Text as typed.
    Typed(String),
    /// Something to unfold.
    Folded {
        /// What shows when folded.
        summary: String,
        /// What is inside.
        inside: Vec<Block>,
    },
}

/// What is shown once it is unfolded.
pub(crate) fn folded(summary: &str, inside: Vec<Block>) -> Block {
    Block::Folded { summary: summary.to_owned(), inside }
}

/// A titled part of the page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Title.
    pub title: String,
    /// What stands in it.
    pub blocks: Vec<Block>,
}

/// What a report says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What kind of report: `Run`, `Frequency response`.
    pub kind: String,
    /// Title.
    pub title: String,
    /// The result in one sentence.
    pub headline: String,
    /// A word on how it went, with its tone.
    pub verdict: Option<(Tone, String)>,
    /// Key numbers.
    pub cards: Vec<Card>,
    /// The parts.
    pub sections: Vec<Section>,
    /// Versions and hashes, at the foot.
    pub versions: Vec<(String, String)>,
}

impl Report {
    /// Adds a section, unless it is empty.
    pub fn section(&mut self, title: impl Into<String>, blocks: Vec<Block>) {
        if !blocks.is_empty() {
            self.sections.push(Section { title: title.into(), blocks });
        }
    }

    /// The page: one file, nothing fetched; a view of grains runs its scripts inside a frame of its own.
    pub fn to_html(&self) -> String {
        let mut out = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"generator\" content=\"tsubu\">\n\
             <title>{} – {}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n<header>\n<p class=\"kind\">{}",
            escape(&self.title),
            escape(&self.kind),
            include_str!("page.css"),
            escape(&self.kind),
        );
        if let Some((tone, word)) = &self.verdict {
            let _ = write!(out, " <span class=\"badge {}\">{}</span>", tone.class(), escape(word));
        }
        let _ = write!(out, "</p>\n<h1>{}</h1>\n", escape(&self.title));
        if !self.headline.is_empty() {
            let _ = writeln!(out, "<p class=\"headline\">{}</p>", marked(&self.headline));
        }
        out.push_str("</header>\n");
        self.write_cards(&mut out);
        if self.sections.len() > 3 {
            out.push_str("<nav aria-label=\"Contents\">");
            for (i, section) in self.sections.iter().enumerate() {
                let _ = write!(out, "<a href=\"#s{i}\">{}</a>", escape(&section.title));
            }
            out.push_str("</nav>\n");
        }
        for (i, section) in self.sections.iter().enumerate() {
            let _ = writeln!(out, "<section id=\"s{i}\">\n<h2>{}</h2>", escape(&section.title));
            for block in &section.blocks {
                write_block(&mut out, block);
            }
            out.push_str("</section>\n");
        }
        out.push_str("<footer>\n");
        if !self.versions.is_empty() {
            out.push_str("<dl>");
            for (name, value) in &self.versions {
                let _ = write!(out, "<div><dt>{}</dt><dd>{}</dd></div>", escape(name), escape(value));
            }
            out.push_str("</dl>\n");
        }
        out.push_str("</footer>\n</main>\n</body>\n</html>\n");
        out
    }

    fn write_cards(&self, out: &mut String) {
        if self.cards.is_empty() {
            return;
        }
        out.push_str("<div class=\"cards\">\n");
        for card in &self.cards {
            let _ = write!(
                out,
                "<div class=\"card {}\"><div class=\"label\">{}</div><div class=\"value\">{}",
                card.tone.class(),
                escape(&card.label),
                escape(&card.value)
            );
            if !card.unit.is_empty() {
                let _ = write!(out, " <span class=\"unit\">{}</span>", escape(&card.unit));
            }
            out.push_str("</div>");
            if !card.note.is_empty() {
                let _ = write!(out, "<div class=\"remark\">{}</div>", marked(&card.note));
            }
            out.push_str("</div>\n");
        }
        out.push_str("</div>\n");
    }
}

fn write_block(out: &mut String, block: &Block) {
    let _ = match block {
        Block::Text(text) => writeln!(out, "<p>{}</p>", marked(text)),
        Block::Note(tone, text) => {
            writeln!(out, "<p class=\"note {}\">{}</p>", tone.class(), marked(text))
        }
        Block::Drawing { svg, caption } => {
            let label =
                svg.replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{}\" ", escape(&plain(caption))), 1);
            writeln!(out, "<figure>{label}{}</figure>", caption_html(caption))
        }
        Block::Picture { media, bytes, caption } => writeln!(
            out,
            "<figure><img alt=\"{}\" src=\"data:{media};base64,{}\">{}</figure>",
            escape(&plain(caption)),
            base64(bytes),
            caption_html(caption)
        ),
        // What is inside may run its scripts, and reach neither this page nor any other.
        Block::View { html, caption } => writeln!(
            out,
            "<figure class=\"view\"><iframe title=\"{}\" sandbox=\"allow-scripts allow-downloads\" srcdoc=\"{}\"></iframe>{}</figure>",
            escape(&plain(caption)),
            escape(html),
            caption_html(caption)
        ),
        Block::Table(grid) => {
            write_grid(out, grid);
            Ok(())
        }
        Block::Typed(text) => writeln!(out, "<pre>{}</pre>", escape(text)),
        Block::Folded { summary, inside } => {
            let _ = writeln!(out, "<details>\n<summary>{}</summary>", marked(summary));
            for block in inside {
                write_block(out, block);
            }
            writeln!(out, "</details>")
        }
    };
}

fn caption_html(caption: &str) -> String {
    if caption.is_empty() { String::new() } else { format!("<figcaption>{}</figcaption>", marked(caption)) }
}

fn write_grid(out: &mut String, grid: &Grid) {
    let columns = grid.header.len();
    let numeric: Vec<bool> = (0..columns)
        .map(|c| {
            let mut cells = grid.rows.iter().filter_map(|(_, r)| r.get(c)).filter(|t| !t.is_empty()).peekable();
            cells.peek().is_some() && cells.all(|t| is_number(t))
        })
        .collect();
    let class = |c: usize| if numeric[c] { " class=\"number\"" } else { "" };
    out.push_str("<div class=\"scroll\"><table>\n<thead><tr>");
    for (c, cell) in grid.header.iter().enumerate() {
        let _ = write!(out, "<th scope=\"col\"{}>{}</th>", class(c), header_html(cell));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for (tone, row) in &grid.rows {
        let _ = write!(out, "<tr class=\"{}\">", tone.class());
        for (c, cell) in row.iter().take(columns).enumerate() {
            let class = match class(c) {
                // A short label broken in two reads badly; a long text may wrap.
                "" if cell.chars().count() <= 34 => " class=\"whole\"",
                other => other,
            };
            let _ = write!(out, "<td{class}>{}</td>", marked(cell));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table></div>\n");
}

/// The unit is of less weight than the name; a column without one does not show `-`, one of text not `text`.
fn header_html(cell: &str) -> String {
    match tsubu_frame::csv::split_unit(cell) {
        (name, Some("-" | "text" | "SI") | None) => escape(name),
        (name, Some(unit)) => format!("{} <span class=\"unit\">{}</span>", escape(name), escape(&text::unit(unit))),
    }
}

fn is_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit() || "−-–∞≥≤".contains(c))
        && text.chars().all(|c| c.is_ascii_digit() || "−-–+.·eE∞%…≥≤ \u{202f}⁰¹²³⁴⁵⁶⁷⁸⁹⁻".contains(c))
}

pub(crate) fn base64(bytes: &[u8]) -> String {
    base64::engine::general_purpose::STANDARD.encode(bytes)
}
