//! Tables of numbers and text as CSV: header cells are `name [unit]`, floats in their shortest exact form.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use crate::FileError;
use crate::whole::write_atomically;

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number; not-a-number is written `NaN`.
    Number(f64),
    /// Text.
    Text(String),
}

impl Cell {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Text(_) => None,
        }
    }
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl std::fmt::Display for Cell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(x) => f.write_str(&number(*x)),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// Rows under a header.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Header cells, `name [unit]`.
    pub header: Vec<String>,
    /// Rows, each as long as the header.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table.
    pub fn new<S: Into<String>>(header: impl IntoIterator<Item = S>) -> Self {
        Self { header: header.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Adds a row; a short one is filled with empty cells, so that a table always stays rectangular.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        let mut row: Vec<Cell> = row.into_iter().take(self.header.len()).collect();
        row.resize(self.header.len(), Cell::Text(String::new()));
        self.rows.push(row);
    }

    /// Index of the column with that header cell, or, failing that, with that name before its ` [unit]`.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|h| h == name).or_else(|| self.header.iter().position(|h| split_unit(h).0 == name))
    }

    /// A column's numbers; text and empty cells are not-a-number.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        let column = self.index(name)?;
        Some(self.rows.iter().map(|r| r[column].number().unwrap_or(f64::NAN)).collect())
    }

    /// A column's text; numbers are written out.
    pub fn texts(&self, name: &str) -> Option<Vec<String>> {
        let column = self.index(name)?;
        Some(self.rows.iter().map(|r| r[column].to_string()).collect())
    }

    /// The table as CSV text.
    pub fn to_csv(&self) -> String {
        let mut out = String::new();
        push_row(&mut out, self.header.iter().map(|h| quoted(h)));
        for row in &self.rows {
            push_row(
                &mut out,
                row.iter().map(|cell| match cell {
                    Cell::Number(x) => number(*x),
                    Cell::Text(text) => quoted(text),
                }),
            );
        }
        out
    }

    /// Writes the file, whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_atomically(path, |out| out.write_all(self.to_csv().as_bytes()))
    }

    /// Reads a file. Columns whose header ends in `[text]` stay text, others are numbers where they read as such.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let text = std::fs::read_to_string(path).map_err(FileError::read(path))?;
        Self::parse(&text).map_err(|reason| FileError::content(path, reason))
    }

    /// Reads CSV text. A last line without its end of line was being written and is left out.
    pub fn parse(text: &str) -> Result<Self, String> {
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let mut records = records(whole)?.into_iter();
        let header = records.next().ok_or("it has no header line")?;
        let is_text: Vec<bool> = header.iter().map(|h| split_unit(h).1 == Some("text")).collect();
        let mut rows = Vec::new();
        for (line, record) in records.enumerate() {
            if record.len() != header.len() {
                return Err(format!("row {} has {} cells, the header has {}", line + 1, record.len(), header.len()));
            }
            let cells = record.into_iter().zip(&is_text).map(|(cell, &keep)| match cell.parse() {
                Ok(x) if !keep => Cell::Number(x),
                _ => Cell::Text(cell),
            });
            rows.push(cells.collect());
        }
        Ok(Self { header, rows })
    }
}

/// `name [unit]` taken apart.
pub fn split_unit(header: &str) -> (&str, Option<&str>) {
    match header.strip_suffix(']').and_then(|h| h.rsplit_once(" [")) {
        Some((name, unit)) => (name, Some(unit)),
        None => (header, None),
    }
}

/// The shortest text that reads back as the same bits.
pub(crate) fn number(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

pub(crate) fn push_row(out: &mut String, cells: impl Iterator<Item = String>) {
    for (i, cell) in cells.enumerate() {
        // Writing to a String cannot fail.
        let _ = write!(out, "{}{cell}", if i == 0 { "" } else { "," });
    }
    out.push('\n');
}

/// RFC 4180: quoted cells may hold commas, doubled quotes and line ends.
fn records(text: &str) -> Result<Vec<Vec<String>>, String> {
    let mut records = Vec::new();
    let mut record = Vec::new();
    let mut cell = String::new();
    let mut in_quotes = false;
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if in_quotes && characters.peek() == Some(&'"') => {
                cell.push('"');
                characters.next();
            }
            '"' => in_quotes = !in_quotes,
            ',' if !in_quotes => record.push(std::mem::take(&mut cell)),
            '\n' if !in_quotes => {
                if cell.ends_with('\r') {
                    cell.pop();
                }
                record.push(std::mem::take(&mut cell));
                records.push(std::mem::take(&mut record));
            }
            other => cell.push(other),
        }
    }
    if in_quotes {
        return Err("a quoted cell is not closed".into());
    }
    Ok(records)
}
