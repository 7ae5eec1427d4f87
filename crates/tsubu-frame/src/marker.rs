//! The marker of a folder of results, `.tsubu`: who writes there now, and what tsubu has written there.
//!
//! A text file: a line that says what it is, then a line a name, each added before its file is written, so that a killed
//! program leaves nothing that is not known. A folder of snapshots or of runs has a slash behind its name. A file that people
//! edit, the scene, has the hash of each content that tsubu gave it behind its name, and is tsubu's as long as it has one of these.
//!
//! The file is locked as long as somebody writes into the folder. The system drops the lock when the program ends, however it ends.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Component, Path, PathBuf};

use crate::FileError;

/// Its name.
pub(crate) const NAME: &str = ".tsubu";

/// The marker of one folder, locked.
#[derive(Debug)]
pub(crate) struct Marker {
    path: PathBuf,
    file: File,
    names: BTreeMap<String, Vec<String>>,
}

impl Marker {
    /// Takes the marker of a folder that has one.
    pub fn find(folder: &Path) -> Result<Option<Self>, FileError> {
        let path = folder.join(NAME);
        match path.symlink_metadata() {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Ok(about) if about.is_symlink() => return Err(FileError::Link { path }),
            Ok(_) => {}
            Err(error) => return Err(FileError::read(&path)(error)),
        }
        let file = OpenOptions::new().read(true).append(true).open(&path).map_err(FileError::write(&path))?;
        Self::locked(path, file).map(Some)
    }

    /// Makes the marker of a folder that has none.
    pub fn make(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(NAME);
        let file = match OpenOptions::new().read(true).append(true).create_new(true).open(&path) {
            // Somebody has made it since the folder was looked at.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(FileError::Locked { path }),
            file => file.map_err(FileError::write(&path))?,
        };
        let mut marker = Self::locked(path, file)?;
        marker.head()?;
        Ok(marker)
    }

    fn locked(path: PathBuf, mut file: File) -> Result<Self, FileError> {
        // A file system that knows no locks keeps nobody from writing.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(FileError::Locked { path });
        }
        let mut text = String::new();
        file.read_to_string(&mut text).map_err(FileError::read(&path))?;
        let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
        // The last line may have been cut by a kill; its file was not written then.
        for line in text.split_inclusive('\n').skip(1).filter_map(|line| line.strip_suffix('\n')) {
            let (name, hash) = line.split_once('\t').unwrap_or((line, ""));
            // An altered list must not reach outside the folder.
            if Path::new(name).components().all(|part| matches!(part, Component::Normal(_))) {
                let hashes = names.entry(name.to_owned()).or_default();
                hashes.extend((!hash.is_empty()).then(|| hash.to_owned()));
            }
        }
        Ok(Self { path, file, names })
    }

    fn head(&mut self) -> Result<(), FileError> {
        self.append(&format!("tsubu {} has written these files; --overwrite removes them\n", env!("CARGO_PKG_VERSION")))
    }

    fn append(&mut self, lines: &str) -> Result<(), FileError> {
        self.file.write_all(lines.as_bytes()).map_err(FileError::write(&self.path))
    }

    /// What tsubu has written, with the hashes of what people edit.
    pub fn names(&self) -> impl Iterator<Item = (&str, &[String])> {
        self.names.iter().map(|(name, hashes)| (name.as_str(), hashes.as_slice()))
    }

    /// Adds what is going to be written; `hash` for what people edit.
    pub fn add(&mut self, name: &str, hash: Option<&str>) -> Result<(), FileError> {
        if name.contains(['\n', '\t']) {
            return Err(FileError::content(&self.path, format!("{name:?} cannot be the name of a file in it")));
        }
        let known = self.names.get(name).is_some_and(|hashes| hash.is_none_or(|hash| hashes.iter().any(|h| h == hash)));
        if known {
            return Ok(());
        }
        self.append(&hash.map_or_else(|| format!("{name}\n"), |hash| format!("{name}\t{hash}\n")))?;
        self.names.entry(name.to_owned()).or_default().extend(hash.map(str::to_owned));
        Ok(())
    }

    /// Forgets everything: the files are gone.
    pub fn clear(&mut self) -> Result<(), FileError> {
        self.names.clear();
        let empty = self.file.set_len(0).and_then(|()| self.file.seek(SeekFrom::Start(0)));
        empty.map_err(FileError::write(&self.path))?;
        self.head()
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// The hash of a content.
pub(crate) fn hash(content: &[u8]) -> String {
    blake3::hash(content).to_hex()[..16].to_owned()
}
