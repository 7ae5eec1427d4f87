//! A case as files, so that it can be kept, looked at and judged again.

use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

/// Files by name, with `/` between folders. What each means is up to the kind of case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bundle(BTreeMap<String, Vec<u8>>);

impl Bundle {
    /// Adds or replaces a file.
    pub fn put(&mut self, name: impl Into<String>, content: impl Into<Vec<u8>>) {
        self.0.insert(name.into(), content.into());
    }

    /// The same with a file more.
    #[must_use]
    pub fn with(mut self, name: &str, content: impl Into<Vec<u8>>) -> Self {
        self.put(name, content);
        self
    }

    /// The bytes of a file.
    pub fn bytes(&self, name: &str) -> Option<&[u8]> {
        self.0.get(name).map(Vec::as_slice)
    }

    /// A file as text, without what is no text.
    pub fn text(&self, name: &str) -> Option<String> {
        self.bytes(name).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    /// Names of all files.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Keeps files by their names.
    pub fn retain(&mut self, keep: impl Fn(&str) -> bool) {
        self.0.retain(|name, _| keep(name));
    }

    /// What stands in a folder of the bundle.
    #[must_use]
    pub fn inside(&self, folder: &str) -> Self {
        let inner = |(name, bytes): (&String, &Vec<u8>)| {
            Some((name.strip_prefix(folder)?.strip_prefix('/')?.to_owned(), bytes.clone()))
        };
        Self(self.0.iter().filter_map(inner).collect())
    }

    /// Puts another bundle into a folder of this one.
    pub fn put_inside(&mut self, folder: &str, other: &Self) {
        for (name, bytes) in &other.0 {
            self.put(format!("{folder}/{name}"), bytes.clone());
        }
    }

    /// Writes every file into a folder, which is made.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        fs::create_dir_all(folder)?;
        for (name, bytes) in &self.0 {
            let path = folder.join(name);
            if name.contains('/') {
                fs::create_dir_all(path.parent().unwrap_or(folder))?;
            }
            fs::write(path, bytes)?;
        }
        Ok(())
    }

    /// Reads every file of a folder and of the folders in it.
    pub fn read(folder: &Path) -> io::Result<Self> {
        let mut bundle = Self::default();
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                bundle.put_inside(&name, &Self::read(&path)?);
            } else {
                bundle.put(name, fs::read(&path)?);
            }
        }
        Ok(bundle)
    }
}
