//! VTK PolyData of grains, as tsubu and ParaView write them: points with their columns, in text or raw appended, not compressed. SI units.
//!
//! A file of bytes has no lines to point to. It is read into a dump, which has, and that is read like any other.

use crate::complaint::Complaint;
use roxmltree::{Document, Node};
use std::fmt::Write as _;

/// Where raw data begin.
const APPENDED: &[u8] = b"<AppendedData";

/// A column of a file, what it is called in a dump, and how many numbers a grain has in it.
const COLUMNS: [(&[&str], &str, usize); 7] = [
    (&["velocity", "velo", "v"], "vx vy vz", 3),
    (&["spin", "angular velocity", "omega"], "omegax omegay omegaz", 3),
    (&["radius"], "radius", 1),
    (&["diameter"], "diameter", 1),
    (&["mass"], "mass", 1),
    (&["density"], "density", 1),
    (&["id"], "id", 1),
];

/// The grains of a file as a dump; the complaint has yet to be placed.
pub(super) fn as_dump(name: &str, bytes: &[u8]) -> Result<String, Complaint> {
    let wrong = |why: &str| {
        Complaint::new(format!("cannot read grains from `{name}`: {why}"))
            .hint("tsubu writes such files into `frames/`; ParaView does with the data mode Ascii, or Appended without encoding and compressor")
    };
    let split = bytes.windows(APPENDED.len()).position(|part| part == APPENDED);
    let (head, raw) = match split {
        Some(at) => (&bytes[..at], raw(&bytes[at..]).ok_or_else(|| wrong("its appended data are not raw"))?),
        None => (bytes, &[][..]),
    };
    let head = std::str::from_utf8(head).map_err(|_| wrong("its head is no text"))?;
    let head = if split.is_some() { format!("{head}</VTKFile>") } else { head.to_owned() };
    let document = Document::parse(&head).map_err(|error| wrong(&format!("its XML is wrong: {error}")))?;
    let root = document.root_element();
    if root.attribute("type") != Some("PolyData") {
        return Err(wrong("it is no VTK PolyData"));
    }
    if root.attribute("compressor").is_some() {
        return Err(wrong("it is compressed"));
    }
    if root.attribute("byte_order") == Some("BigEndian") {
        return Err(wrong("its bytes are big-endian"));
    }
    let data = Data { raw, wide: root.attribute("header_type") == Some("UInt64") };
    let mut pieces = root.descendants().filter(|node| node.has_tag_name("Piece"));
    let told = pieces.next().and_then(|piece| piece.attribute("NumberOfPoints")?.parse::<usize>().ok());
    if pieces.next().is_some() {
        return Err(wrong("it has several pieces"));
    }
    let find = |tag: &str| root.descendants().find(|node| node.has_tag_name(tag));
    let places = find("Points").and_then(|points| arrays(points).next()).ok_or_else(|| wrong("it has no points"))?;
    let read = |array, width| data.numbers(array, width).map_err(|why| wrong(&why));
    let places = read(places, 3)?;
    let count = places.len() / 3;
    if told.is_some_and(|told| told != count) {
        return Err(wrong("it has another number of points than it says"));
    }
    let (mut names, mut columns) = (String::from("x y z"), vec![(places, 3)]);
    let arrays: Vec<Node<'_, '_>> = find("PointData").into_iter().flat_map(arrays).collect();
    let named = |wanted: &[&str]| {
        let is = |array: &&Node<'_, '_>| {
            array.attribute("Name").is_some_and(|n| wanted.contains(&n.to_lowercase().as_str()))
        };
        arrays.iter().find(is).copied()
    };
    for (wanted, name, width) in COLUMNS {
        let Some(array) = named(wanted) else { continue };
        columns.push((read(array, width)?, width));
        let _ = write!(names, " {name}");
    }
    // Spheres that were one body would fall apart.
    if let Some(bodies) = named(&["body"])
        && read(bodies, 1)?.iter().any(|body| *body >= 0.0)
    {
        return Err(wrong("it has spheres of clumps; `start-from` goes on from a run with them"));
    }
    // Types of a dump begin with 1, groups with 0.
    if let Some(groups) = named(&["group"]) {
        columns.push((read(groups, 1)?.into_iter().map(|group| group + 1.0).collect(), 1));
        names.push_str(" type");
    } else if let Some(types) = named(&["type"]) {
        columns.push((read(types, 1)?, 1));
        names.push_str(" type");
    }
    if columns.iter().any(|(column, width)| column.len() != width * count) {
        return Err(wrong("a column has another number of grains than there are points"));
    }
    let mut dump = format!("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{count}\nITEM: ATOMS {names}\n");
    for grain in 0..count {
        let cells = columns.iter().flat_map(|(column, width)| &column[grain * width..(grain + 1) * width]);
        for cell in cells {
            let _ = write!(dump, "{cell} ");
        }
        dump.push('\n');
    }
    Ok(dump)
}

fn arrays<'a, 'd>(section: Node<'a, 'd>) -> impl Iterator<Item = Node<'a, 'd>> {
    section.children().filter(|node| node.has_tag_name("DataArray"))
}

/// What stands behind the mark of raw appended data.
fn raw(bytes: &[u8]) -> Option<&[u8]> {
    let end = bytes.iter().position(|byte| *byte == b'>')?;
    let tag = std::str::from_utf8(&bytes[..end]).ok()?;
    let mark = end + bytes[end..].iter().position(|byte| *byte == b'_')?;
    tag.contains("encoding=\"raw\"").then_some(&bytes[mark + 1..])
}

/// The numbers of a file.
struct Data<'a> {
    raw: &'a [u8],
    /// Whether lengths are told by eight bytes, not four.
    wide: bool,
}

impl Data<'_> {
    /// The numbers of an array with so many columns; the error says why not.
    fn numbers(&self, array: Node<'_, '_>, width: usize) -> Result<Vec<f64>, String> {
        let name = array.attribute("Name").unwrap_or("Points");
        let told = array.attribute("NumberOfComponents").map_or(Ok(1), str::parse);
        if told != Ok(width) {
            return Err(format!("`{name}` has not {width} column(s)"));
        }
        let cut = || format!("`{name}` is cut short");
        match array.attribute("format") {
            Some("ascii") => {
                let text = array.text().unwrap_or_default().split_whitespace();
                text.map(|cell| cell.parse().map_err(|_| format!("`{cell}` in `{name}` is not a number"))).collect()
            }
            Some("appended") => {
                let offset = array.attribute("offset").and_then(|offset| offset.parse().ok()).ok_or_else(cut)?;
                let block = self.block(offset).ok_or_else(cut)?;
                let form = array.attribute("type").unwrap_or_default();
                words(form, block).ok_or_else(|| format!("`{name}` is of the type `{form}`, which is not read"))
            }
            form => Err(format!("`{name}` is written as `{}`", form.unwrap_or("?"))),
        }
    }

    /// A block of appended data: its length, then its bytes.
    fn block(&self, offset: usize) -> Option<&[u8]> {
        let rest = self.raw.get(offset..)?;
        let (length, rest) = if self.wide {
            let (length, rest) = rest.split_first_chunk::<8>()?;
            (u64::from_le_bytes(*length), rest)
        } else {
            let (length, rest) = rest.split_first_chunk::<4>()?;
            (u64::from(u32::from_le_bytes(*length)), rest)
        };
        rest.get(..usize::try_from(length).ok()?)
    }
}

/// Little-endian words of a type of VTK.
fn words(form: &str, block: &[u8]) -> Option<Vec<f64>> {
    fn each<const N: usize>(block: &[u8], read: fn([u8; N]) -> f64) -> Option<Vec<f64>> {
        let (words, rest) = block.as_chunks::<N>();
        rest.is_empty().then(|| words.iter().map(|word| read(*word)).collect())
    }
    match form {
        "Float64" => each(block, f64::from_le_bytes),
        "Float32" => each(block, |word| f64::from(f32::from_le_bytes(word))),
        "Int64" => each(block, |word| i64::from_le_bytes(word) as f64),
        "UInt64" => each(block, |word| u64::from_le_bytes(word) as f64),
        "Int32" => each(block, |word| f64::from(i32::from_le_bytes(word))),
        "UInt32" => each(block, |word| f64::from(u32::from_le_bytes(word))),
        "UInt8" => each(block, |word: [u8; 1]| f64::from(word[0])),
        _ => None,
    }
}
