//! Reads the `.vtp` files that this crate writes back into a [`Frame`].
//!
//! It knows the one layout of the `vtp` module (raw appended, 64-bit little-endian) and refuses anything else with
//! a message; other VTK files are VTK's business.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Mutex;

use crate::FileError;
use crate::frame::{Column, Frame, Kind, Values};
use crate::vtp::STEMS;

/// Reads `grains_NNNNNN.vtp` and the contacts, cells and walls of the same moment beside it.
pub fn read_frame(path: &Path) -> Result<Frame, FileError> {
    let mut frame = Frame::default();
    read_into(path, Kind::Grain, &mut frame)?;
    let number = path.file_name().and_then(|n| n.to_str()).and_then(|n| n.strip_prefix("grains"));
    if let Some(number) = number {
        for (kind, stem) in STEMS.into_iter().filter(|(kind, _)| *kind != Kind::Grain) {
            let beside = path.with_file_name(format!("{stem}{number}"));
            if beside.exists() {
                read_into(&beside, kind, &mut frame)?;
            }
        }
    }
    Ok(frame)
}

fn read_into(path: &Path, kind: Kind, frame: &mut Frame) -> Result<(), FileError> {
    let bytes = std::fs::read(path).map_err(FileError::read(path))?;
    parse(&bytes, kind, frame).map_err(|reason| FileError::content(path, reason))
}

/// Reads the bytes of a file, taking its points as rows of `kind`.
pub fn parse(bytes: &[u8], kind: Kind, frame: &mut Frame) -> Result<(), String> {
    const MARK: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
    let split = bytes
        .windows(MARK.len())
        .position(|w| w == MARK)
        .ok_or("it has no raw appended data: it was not written by tsubu, or is cut short")?;
    let head = std::str::from_utf8(&bytes[..split]).map_err(|_| "its XML is not UTF-8")?;
    let data = &bytes[split + MARK.len()..];
    if !head.contains("header_type=\"UInt64\"") || !head.contains("byte_order=\"LittleEndian\"") {
        return Err("its data are not 64-bit little-endian".into());
    }
    let mut section = "";
    // Whether the last array has become a column: times, steps and what is known already have units too.
    let mut added = false;
    for tag in head.split('<').skip(1) {
        let name = tag.split([' ', '>', '/']).next().unwrap_or_default();
        match name {
            "FieldData" | "PointData" | "Points" | "Verts" | "Lines" | "Polys" => section = name,
            "DataArray" => added = array(tag, section, kind, data, frame)?,
            "InformationKey" if added => {
                let label = tag.split_once('>').map_or("", |(_, text)| text);
                if let Some(last) = frame.columns.last_mut() {
                    last.unit = interned(&unescape(label));
                }
            }
            _ => {}
        }
    }
    if frame.column(kind, "position").is_none() {
        return Err("it has no points".into());
    }
    Ok(())
}

/// Takes an array, and says whether it has become a column.
fn array(tag: &str, section: &str, kind: Kind, data: &[u8], frame: &mut Frame) -> Result<bool, String> {
    if matches!(section, "Verts" | "Lines" | "Polys") {
        return Ok(false);
    }
    let name = unescape(attribute(tag, "Name").ok_or("an array has no name")?);
    let values = values(tag, data).ok_or_else(|| format!("array `{name}` is cut short or not ours"))?;
    let kind = if section == "FieldData" { Kind::Global } else { kind };
    match (&values, name.as_str()) {
        (Values::Scalar(v), "TimeValue") if kind == Kind::Global => {
            frame.time = v.first().copied().unwrap_or_default();
        }
        (Values::Integer(v), "step") if kind == Kind::Global => {
            frame.step = v.first().copied().unwrap_or_default() as u64;
        }
        // The global columns stand in every file of a moment; once is enough.
        _ if frame.column(kind, &name).is_some() => {}
        _ => {
            frame.columns.push(Column { name: interned(&name), unit: "-", kind, values });
            return Ok(true);
        }
    }
    Ok(false)
}

fn values(tag: &str, data: &[u8]) -> Option<Values> {
    let offset: usize = attribute(tag, "offset")?.parse().ok()?;
    let block = data.get(offset..)?;
    let (length, block) = block.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let words = block.get(..length)?.as_chunks::<8>().0;
    if words.len() * 8 != length {
        return None;
    }
    let reals = || words.iter().map(|b| f64::from_le_bytes(*b));
    match (attribute(tag, "type")?, attribute(tag, "NumberOfComponents")) {
        ("Float64", None) => Some(Values::Scalar(reals().collect())),
        ("Float64", Some("3")) => {
            let flat: Vec<f64> = reals().collect();
            let (vectors, rest) = flat.as_chunks::<3>();
            rest.is_empty().then(|| Values::Vector(vectors.to_vec()))
        }
        ("Float64", Some("4")) => {
            let flat: Vec<f64> = reals().collect();
            let (quaternions, rest) = flat.as_chunks::<4>();
            rest.is_empty().then(|| Values::Quaternion(quaternions.to_vec()))
        }
        ("Int64", None) => Some(Values::Integer(words.iter().map(|b| i64::from_le_bytes(*b)).collect())),
        _ => None,
    }
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let (_, after) = tag.split_once(&format!(" {name}=\""))?;
    after.split_once('"').map(|(value, _)| value)
}

fn unescape(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

/// Column names are `&'static str`; the few that files bring along are kept for good, each once.
fn interned(text: &str) -> &'static str {
    static KNOWN: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(name) = known.get(text) {
        return name;
    }
    let name: &'static str = Box::leak(text.to_owned().into_boxed_str());
    known.insert(name);
    name
}
