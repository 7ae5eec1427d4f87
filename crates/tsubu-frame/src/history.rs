//! The history of a run: one row per output time, appended as it goes.

use std::fs::{self, File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::FileError;
use crate::csv::{number, push_row, quoted};
use crate::folder::write_atomically;

/// Rows are kept back until this many bytes, so that a fine output interval does not become a stream of system calls.
const FLUSH_AT: usize = 1 << 16;

/// A CSV file that grows by whole rows. The first column is the time.
#[derive(Debug)]
pub struct History {
    path: PathBuf,
    file: File,
    columns: usize,
    waiting: String,
}

impl History {
    /// Starts a new file with its header.
    pub fn create<S: AsRef<str>>(path: &Path, header: &[S]) -> Result<Self, FileError> {
        let head = header_line(header);
        write_atomically(path, |out| out.write_all(head.as_bytes()))?;
        let file = OpenOptions::new().append(true).open(path).map_err(FileError::write(path))?;
        Ok(Self { path: path.to_owned(), file, columns: header.len(), waiting: String::new() })
    }

    /// Goes on with the file of an interrupted run, cut after its last row at or before `time`: the rows behind the
    /// checkpoint are computed again.
    pub fn resume<S: AsRef<str>>(path: &Path, header: &[S], time: f64) -> Result<Self, FileError> {
        if !path.exists() {
            return Self::create(path, header);
        }
        let content = fs::read(path).map_err(FileError::read(path))?;
        let text = String::from_utf8_lossy(&content);
        if !text.starts_with(&header_line(header)) {
            return Err(FileError::content(
                path,
                "its columns are not those of this run; start again without --resume",
            ));
        }
        let keep: usize = text
            .split_inclusive('\n')
            .enumerate()
            .take_while(|(i, line)| {
                let at = line.split(',').next().and_then(|t| t.trim().parse::<f64>().ok());
                *i == 0 || (line.ends_with('\n') && at.is_some_and(|t| t <= time))
            })
            .map(|(_, line)| line.len())
            .sum();
        let mut file = OpenOptions::new().read(true).write(true).open(path).map_err(FileError::write(path))?;
        file.set_len(keep as u64)
            .and_then(|()| file.seek(SeekFrom::End(0)))
            .and_then(|_| file.sync_all())
            .map_err(FileError::write(path))?;
        Ok(Self { path: path.to_owned(), file, columns: header.len(), waiting: String::new() })
    }

    /// Adds a row. Missing cells are left empty; surplus ones are an error in the caller and are dropped.
    pub fn append(&mut self, row: &[f64]) -> Result<(), FileError> {
        debug_assert_eq!(row.len(), self.columns, "a row of {}", self.path.display());
        let cells = (0..self.columns).map(|i| row.get(i).map_or_else(String::new, |x| number(*x)));
        push_row(&mut self.waiting, cells);
        if self.waiting.len() >= FLUSH_AT { self.flush() } else { Ok(()) }
    }

    /// Hands all rows to the system.
    pub fn flush(&mut self) -> Result<(), FileError> {
        let before = self.file.metadata().map_err(FileError::write(&self.path))?.len();
        if let Err(source) = self.file.write_all(self.waiting.as_bytes()) {
            // A full disk takes part of a row: give back the part, so that the file ends with a whole one.
            let _ = self.file.set_len(before);
            return Err(FileError::Write { path: self.path.clone(), source });
        }
        self.waiting.clear();
        Ok(())
    }

    /// Puts all rows on the disk. To be called before a checkpoint is written, or a crash of the machine could leave a
    /// checkpoint that is ahead of its history.
    pub fn sync(&mut self) -> Result<(), FileError> {
        self.flush()?;
        self.file.sync_data().map_err(FileError::write(&self.path))
    }
}

impl Drop for History {
    fn drop(&mut self) {
        // A run that stops on an error still keeps its last rows; a second error cannot be told from here.
        let _ = self.flush();
    }
}

fn header_line<S: AsRef<str>>(header: &[S]) -> String {
    let mut line = String::new();
    push_row(&mut line, header.iter().map(|h| quoted(h.as_ref())));
    line
}
