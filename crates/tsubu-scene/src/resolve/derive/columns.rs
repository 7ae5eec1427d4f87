//! Columns of numbers over a time or a frequency: read from a file, or typed.

use super::super::table::Axis;
use super::{Derive, join, numbers};
use crate::complaint::{Complaint, Source};
use toml::Table;

impl Derive<'_> {
    /// What `read` makes of the text of a file, which is the source of that number; complaints point into the file.
    pub(super) fn filed<T>(
        &mut self,
        file: &str,
        path: &[&str],
        read: impl FnOnce(&str, usize) -> Result<T, Vec<Complaint>>,
    ) -> Option<T> {
        let path = [path, &["file"]].concat();
        let read = self.files.text(file, self.sources).and_then(|text| {
            read(&text, self.sources.len()).inspect_err(|_| {
                self.sources.push(Source { name: file.to_owned(), text, numbered: true });
            })
        });
        read.map_err(|wrong| self.file_is_wrong(wrong, &path)).ok()
    }

    /// Columns that are typed: with a number in each for every one of the first, which rises along the axis. Where neither they nor a file are there,
    /// `nothing` is complained about.
    pub(super) fn typed_columns<const N: usize>(
        &mut self,
        table: &Table,
        (path, keys): (&[&str], [&str; N]),
        axis: &Axis,
        nothing: Complaint,
    ) -> Option<[Vec<f64>; N]> {
        if !keys.iter().all(|key| self.typed(&[path, &[key]].concat())) {
            if !self.typed(&[path, &["file"]].concat()) {
                self.complain(nothing);
            }
            return None;
        }
        let columns: Vec<Vec<f64>> = keys.iter().map_while(|key| numbers(table, key)).collect();
        let columns: [Vec<f64>; N] = columns.try_into().ok()?;
        let complaints = self.complaints.len();
        let first = &columns[0];
        for (key, column) in keys.iter().zip(&columns).skip(1) {
            if first.is_empty() || column.len() != first.len() {
                let place = self.root.locate(&[path, &[key]].concat());
                self.complain(
                    Complaint::new(format!("`{}` needs a number for each {}", join(&path.join("."), key), axis.name()))
                        .at(&place, format!("{} for {} in `{}`", column.len(), first.len(), keys[0])),
                );
            }
        }
        if let Some(k) = first.windows(2).position(|pair| pair[0] >= pair[1]) {
            let place = self.root.locate(&[path, &[keys[0], &(k + 1).to_string()]].concat());
            let must = format!("must be {} than the one before", axis.more());
            self.complain(axis.falls(first[k + 1], first[k]).at(&place, must));
        }
        (self.complaints.len() == complaints).then_some(columns)
    }
}
