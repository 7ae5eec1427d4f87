//! The checkpoint: one file of checked sections.
//!
//! Layout, all numbers little-endian:
//!
//! ```text
//! "TSUBU\r\n\x1a"                          8 bytes, so that a text transfer shows itself
//! format version                          u32
//! header: tsubu version, scene hash       each u32 length + UTF-8
//!         step, time, number of sections  u64, f64, u32
//! crc32 of everything so far              u32
//! per section: name                       u32 length + UTF-8
//!              kind, count, packed length u8, u64, u64
//!              payload                    zstd of f64 / i64 / UTF-8
//!              crc32 of this section      u32
//! "END." + crc32 of the whole file        4 bytes + u32
//! ```

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::FileError;
use crate::state::{Section, State};
use crate::whole::write_atomically;
use crc32fast::Hasher;

const MAGIC: &[u8; 8] = b"TSUBU\r\n\x1a";
const VERSION: u32 = 4;
const END: &[u8; 4] = b"END.";
/// Fast enough not to be felt beside the disk; higher levels gain little on floats.
const LEVEL: i32 = 1;

/// What a checkpoint says about itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// Version of the program that wrote it.
    pub tsubu_version: String,
    /// Hash of the scene, made by the caller; a resumed run compares it.
    pub scene_hash: String,
    /// Step number.
    pub step: u64,
    /// Simulated time [s].
    pub time: f64,
}

/// A checkpoint that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// No file, or the system would not read it.
    #[error("cannot read the checkpoint {}: {source}; start again without --resume", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Another kind of file.
    #[error("{} is not a tsubu checkpoint; remove it and start again without --resume", path.display())]
    NotOurs {
        /// The file.
        path: PathBuf,
    },
    /// Written in another format.
    #[error(
        "the checkpoint {} was written by tsubu {writer} in format {found}, this program reads format {VERSION}: \
         resume with the tsubu that wrote it, or start again without --resume",
        path.display()
    )]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// Format version found.
        found: u32,
        /// Version of the program that wrote it, as far as that can be read.
        writer: String,
    },
    /// It stops before its end marker.
    #[error("the checkpoint {} is cut short at byte {length}; remove it and start again without --resume", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Bytes there are.
        length: u64,
    },
    /// A checksum does not fit.
    #[error("the checkpoint {} was altered ({part} does not match its checksum); remove it and start again without --resume", path.display())]
    Altered {
        /// The file.
        path: PathBuf,
        /// Which part.
        part: String,
    },
}

/// Where a run folder keeps its checkpoint.
pub fn path(run_folder: &Path) -> PathBuf {
    run_folder.join("checkpoint").join("state.tsubu")
}

/// Writes the state as the run folder's checkpoint. The one before it stays until this one is whole on the disk.
pub fn write(run_folder: &Path, state: &State, header: &Header) -> Result<(), FileError> {
    write_atomically(&path(run_folder), |out| encode(state, header, out))
}

/// Removes the run folder's checkpoint, where there is one.
pub fn remove(run_folder: &Path) -> Result<(), FileError> {
    let path = path(run_folder);
    match std::fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => Err(FileError::Write { path, source }),
        _ => Ok(()),
    }
}

/// Reads a checkpoint file, section by section: it is never whole in memory beside the state.
pub fn read(path: &Path) -> Result<(Header, State<'static>), CheckpointError> {
    let open = || {
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        Ok(Input { file: BufReader::new(file), length, at: 0, part: Hasher::new(), whole: Hasher::new() })
    };
    open().map_err(Damage::Unreadable).and_then(|mut input| decode(&mut input)).map_err(|damage| damage.at(path))
}

/// Section by section, each packed into the file as it comes: how long that makes it is filled in afterwards, and checksums of parts make that of
/// the whole.
fn encode(state: &State, header: &Header, out: &mut BufWriter<File>) -> io::Result<()> {
    let mut part = MAGIC.to_vec();
    part.extend_from_slice(&VERSION.to_le_bytes());
    put_text(&mut part, &header.tsubu_version);
    put_text(&mut part, &header.scene_hash);
    part.extend_from_slice(&header.step.to_le_bytes());
    part.extend_from_slice(&header.time.to_bits().to_le_bytes());
    part.extend_from_slice(&(state.sections().count() as u32).to_le_bytes());
    let mut whole = Hasher::new();
    put_checked(&part, &Hasher::new(), &mut whole, out)?;
    for (name, section) in state.sections() {
        let (kind, count) = match section {
            Section::Real(v) => (0u8, v.len()),
            Section::Integer(_) | Section::Index(_) => (1, section.integers().len()),
            Section::Text(t) => (2, t.len()),
        };
        part.clear();
        put_text(&mut part, name);
        part.push(kind);
        part.extend_from_slice(&(count as u64).to_le_bytes());
        let begin = out.stream_position()?;
        out.seek_relative(part.len() as i64 + 8)?;
        let packed = Summed { crc: Hasher::new(), out: &mut *out };
        let crc = match section {
            Section::Real(v) => pack(v.iter().map(|x| x.to_bits().to_le_bytes()), packed),
            Section::Integer(_) | Section::Index(_) => pack(section.integers().map(i64::to_le_bytes), packed),
            Section::Text(t) => pack(t.bytes().map(|x| [x]), packed),
        }?;
        let length = out.stream_position()? - begin - part.len() as u64 - 8;
        part.extend_from_slice(&length.to_le_bytes());
        out.seek(SeekFrom::Start(begin))?;
        put_checked(&part, &crc, &mut whole, out)?;
    }
    whole.update(END);
    out.write_all(END)?;
    out.write_all(&whole.finalize().to_le_bytes())
}

/// Writes a part here, and at the end of the file the checksum of the part and of what follows it, which sums up to `rest`; `whole` goes on by
/// both and their checksum.
fn put_checked(part: &[u8], rest: &Hasher, whole: &mut Hasher, out: &mut BufWriter<File>) -> io::Result<()> {
    let mut both = Hasher::new();
    both.update(part);
    both.combine(rest);
    let sum = both.clone().finalize().to_le_bytes();
    whole.combine(&both);
    whole.update(&sum);
    out.write_all(part)?;
    out.seek(SeekFrom::End(0))?;
    out.write_all(&sum)
}

/// Values as packed bytes; gives their checksum.
fn pack<const N: usize>(mut values: impl Iterator<Item = [u8; N]>, out: Summed) -> io::Result<Hasher> {
    let mut packed = zstd::stream::write::Encoder::new(out, LEVEL)?;
    let mut some = Vec::with_capacity(4096);
    loop {
        some.extend(values.by_ref().take(4096));
        if some.is_empty() {
            return Ok(packed.finish()?.crc);
        }
        packed.write_all(some.as_flattened())?;
        some.clear();
    }
}

/// Writes on, and sums up what it writes.
struct Summed<'a> {
    crc: Hasher,
    out: &'a mut BufWriter<File>,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.crc.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn put_text(out: &mut Vec<u8>, text: &str) {
    out.extend_from_slice(&(text.len() as u32).to_le_bytes());
    out.extend_from_slice(text.as_bytes());
}

/// What is wrong with the bytes, before the file's name is known.
#[derive(Debug)]
enum Damage {
    Unreadable(io::Error),
    NotOurs,
    OtherFormat(u32, String),
    Truncated(u64),
    Altered(String),
}

impl Damage {
    fn at(self, path: &Path) -> CheckpointError {
        let path = path.to_owned();
        match self {
            Self::Unreadable(source) => CheckpointError::Unreadable { path, source },
            Self::NotOurs => CheckpointError::NotOurs { path },
            Self::OtherFormat(found, writer) => CheckpointError::OtherFormat { path, found, writer },
            Self::Truncated(length) => CheckpointError::Truncated { path, length },
            Self::Altered(part) => CheckpointError::Altered { path, part },
        }
    }
}

/// A file that is read from its begin to its end.
struct Input {
    file: BufReader<File>,
    length: u64,
    at: u64,
    /// Checksum of the part that is read, and of all parts before it.
    part: Hasher,
    whole: Hasher,
}

impl Input {
    fn take(&mut self, length: u64) -> Result<Vec<u8>, Damage> {
        if length > self.length - self.at {
            return Err(Damage::Truncated(self.length));
        }
        let mut bytes = vec![0; length as usize];
        self.file.read_exact(&mut bytes).map_err(Damage::Unreadable)?;
        self.part.update(&bytes);
        self.at += length;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        let mut array = [0; N];
        array.copy_from_slice(&self.take(N as u64)?);
        Ok(array)
    }

    fn u32(&mut self) -> Result<u32, Damage> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn u64(&mut self) -> Result<u64, Damage> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    fn text(&mut self) -> Result<String, Damage> {
        let length = self.u32()?;
        let bytes = self.take(u64::from(length))?;
        String::from_utf8(bytes).map_err(|_| Damage::Altered("a name".into()))
    }

    /// The part ends here, with its checksum.
    fn check(&mut self, part: impl FnOnce() -> String) -> Result<(), Damage> {
        let seen = self.part.clone().finalize();
        let same = seen == self.u32()?;
        self.whole.combine(&std::mem::take(&mut self.part));
        if same { Ok(()) } else { Err(Damage::Altered(part())) }
    }
}

fn decode(input: &mut Input) -> Result<(Header, State<'static>), Damage> {
    let magic = input.take(input.length.min(MAGIC.len() as u64))?;
    if magic.is_empty() || magic != MAGIC[..magic.len()] {
        return Err(Damage::NotOurs);
    }
    let version = input.u32()?;
    if version != VERSION {
        // All formats have begun alike so far; what is no name of a version is not shown.
        let plain = |text: &String| !text.is_empty() && text.len() < 40 && text.chars().all(|c| c.is_ascii_graphic());
        let writer = input.text().ok().filter(plain).unwrap_or_else(|| "of unknown version".to_owned());
        return Err(Damage::OtherFormat(version, writer));
    }
    match decode_rest(input) {
        // A length that was altered mostly points past the end. A file that is really cut short has no end marker.
        Err(Damage::Truncated(_)) if ends_with_marker(input) => Err(Damage::Altered("the file".into())),
        other => other,
    }
}

fn ends_with_marker(input: &mut Input) -> bool {
    let mut marker = [0; 4];
    let read = input.file.seek(SeekFrom::End(-8)).and_then(|_| input.file.read_exact(&mut marker));
    read.is_ok() && &marker == END
}

fn decode_rest(input: &mut Input) -> Result<(Header, State<'static>), Damage> {
    let header = Header {
        tsubu_version: input.text()?,
        scene_hash: input.text()?,
        step: input.u64()?,
        time: f64::from_bits(input.u64()?),
    };
    let sections = input.u32()?;
    input.check(|| "the header".into())?;
    let mut state = State::default();
    for _ in 0..sections {
        let name = input.text()?;
        let [kind] = input.array()?;
        let count = input.u64()?;
        let length = input.u64()?;
        let packed = input.take(length)?;
        input.check(|| format!("section `{name}`"))?;
        let section = unpack(kind, count, &packed).ok_or_else(|| Damage::Altered(format!("section `{name}`")))?;
        state.insert(name, section);
    }
    if &input.array::<4>()? != END {
        return Err(Damage::Altered("the end marker".into()));
    }
    input.whole.combine(&input.part);
    let sum = input.u32()?;
    if input.at != input.length {
        return Err(Damage::Altered("the end of the file".into()));
    }
    if sum != input.whole.clone().finalize() {
        return Err(Damage::Altered("the file".into()));
    }
    Ok((header, state))
}

/// Memory grows with what really comes out of the packed bytes, never with what `count` claims.
fn unpack(kind: u8, count: u64, packed: &[u8]) -> Option<Section<'static>> {
    let width = if kind == 2 { 1 } else { 8 };
    let expected = count.checked_mul(width)?;
    let mut plain = Vec::new();
    let unpacked = zstd::stream::read::Decoder::new(packed).ok()?;
    unpacked.take(expected.saturating_add(1)).read_to_end(&mut plain).ok()?;
    if plain.len() as u64 != expected {
        return None;
    }
    let words = || plain.as_chunks::<8>().0.iter();
    match kind {
        0 => Some(Section::Real(words().map(|b| f64::from_bits(u64::from_le_bytes(*b))).collect())),
        1 => Some(Section::Integer(words().map(|b| i64::from_le_bytes(*b)).collect())),
        2 => String::from_utf8(plain).ok().map(Section::Text),
        _ => None,
    }
}
