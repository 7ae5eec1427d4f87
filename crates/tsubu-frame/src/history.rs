//! The history of a run: one row per output time, appended as it goes.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crc32fast::Hasher;

use crate::FileError;
use crate::csv::{number, push_row, quoted};
use crate::whole::write_beside;

/// Rows are kept back until this many bytes, so that a fine output interval does not become a stream of system calls.
const FLUSH_AT: usize = 1 << 16;

/// How far a table had come at a checkpoint, which keeps this to know the table again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Its length.
    pub bytes: u64,
    /// Checksum of these bytes.
    pub checksum: u32,
}

impl Mark {
    /// As numbers of a checkpoint.
    pub fn numbers(self) -> Vec<i64> {
        vec![self.bytes as i64, i64::from(self.checksum)]
    }

    /// From there; `None` if they are none.
    pub fn from_numbers(numbers: &[i64]) -> Option<Self> {
        let &[bytes, checksum] = numbers else { return None };
        Some(Self { bytes: bytes.try_into().ok()?, checksum: checksum.try_into().ok()? })
    }

    /// Whether a file still begins with what was there at the checkpoint.
    pub fn check(self, path: &Path) -> Result<(), FileError> {
        let refuse = |reason: &str| {
            let hint = "put it back as it was, or start again with `--overwrite` in place of `--resume`";
            Err(FileError::Content { path: path.to_owned(), reason: reason.to_owned(), hint: Some(hint.into()) })
        };
        let file = match File::open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return refuse("it is not there, but the checkpoint goes on from its rows");
            }
            other => other.map_err(FileError::read(path))?,
        };
        let mut known = file.take(self.bytes);
        let (mut checksum, mut length, mut buffer) = (Hasher::new(), 0, vec![0; FLUSH_AT]);
        loop {
            let n = known.read(&mut buffer).map_err(FileError::read(path))?;
            if n == 0 {
                break;
            }
            checksum.update(&buffer[..n]);
            length += n as u64;
        }
        if length < self.bytes {
            return refuse("rows before the checkpoint are missing at its end");
        }
        if checksum.finalize() != self.checksum {
            return refuse("rows before the checkpoint have been changed");
        }
        Ok(())
    }
}

/// A CSV file that grows by whole rows. The first column is the time.
#[derive(Debug)]
pub struct History {
    path: PathBuf,
    file: File,
    columns: usize,
    waiting: String,
    bytes: u64,
    checksum: Hasher,
}

impl History {
    /// Starts a new file with its header.
    pub fn create<S: AsRef<str>>(path: &Path, header: &[S]) -> Result<Self, FileError> {
        let head = header_line(header);
        write_beside(path, |out| out.write_all(head.as_bytes()))?;
        let mark = Mark { bytes: head.len() as u64, checksum: crc32fast::hash(head.as_bytes()) };
        Self::at(path, header.len(), mark)
    }

    /// Goes on with the file of an interrupted run where it was at the checkpoint. Rows behind that are computed again: they go
    /// with the first new one.
    pub fn resume<S: AsRef<str>>(path: &Path, header: &[S], mark: Mark) -> Result<Self, FileError> {
        mark.check(path)?;
        let head = header_line(header);
        let mut begin = String::new();
        let read = File::open(path).and_then(|file| file.take(head.len() as u64).read_to_string(&mut begin));
        if read.is_err() || begin != head {
            return Err(FileError::content(
                path,
                "its columns are not those of this run; start again without --resume",
            ));
        }
        Self::at(path, header.len(), mark)
    }

    fn at(path: &Path, columns: usize, mark: Mark) -> Result<Self, FileError> {
        let file = OpenOptions::new().write(true).open(path).map_err(FileError::write(path))?;
        let checksum = Hasher::new_with_initial_len(mark.checksum, mark.bytes);
        Ok(Self { path: path.to_owned(), file, columns, waiting: String::new(), bytes: mark.bytes, checksum })
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
        let at = |file: &mut File, bytes: u64| file.set_len(bytes).and_then(|()| file.seek(SeekFrom::Start(bytes)));
        let rows = self.waiting.as_bytes();
        let written = at(&mut self.file, self.bytes).and_then(|_| self.file.write_all(rows));
        if let Err(source) = written {
            // A full disk takes part of a row: give back the part, so that the file ends with a whole one.
            let _ = at(&mut self.file, self.bytes);
            return Err(FileError::Write { path: self.path.clone(), source });
        }
        self.bytes += rows.len() as u64;
        self.checksum.update(rows);
        self.waiting.clear();
        Ok(())
    }

    /// Puts all rows on the disk, and says how far the file has come. To be called before a checkpoint is written, or a crash of
    /// the machine could leave a checkpoint that is ahead of its history.
    pub fn sync(&mut self) -> Result<Mark, FileError> {
        self.flush()?;
        self.file.sync_data().map_err(FileError::write(&self.path))?;
        Ok(Mark { bytes: self.bytes, checksum: self.checksum.clone().finalize() })
    }
}

impl Drop for History {
    fn drop(&mut self) {
        // A run that stops on an error still keeps its last rows; a second error cannot be told from here. Where nothing is waiting
        // nothing is cut: the run may have been refused.
        if !self.waiting.is_empty() {
            let _ = self.flush();
        }
    }
}

fn header_line<S: AsRef<str>>(header: &[S]) -> String {
    let mut line = String::new();
    push_row(&mut line, header.iter().map(|h| quoted(h.as_ref())));
    line
}
