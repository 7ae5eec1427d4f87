//! Cases of data files: tables of signals, grains, meshes, whole ones and broken ones.
//!
//! A file is written in one of the many ways in which it may be, beside the same records written plainly, so that what
//! the scene makes of it is known whoever reads it.

mod damage;
mod grains;
mod mesh;
mod table;

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::reading::Expect;
use std::fmt::Write as _;

/// How a file can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// CSV of a signal or of grains.
    Csv,
    Xyz,
    /// LAMMPS data.
    Data,
    /// LAMMPS dump.
    Dump,
    /// VTK PolyData as text.
    Vtp,
    Obj,
    /// STL as text.
    Stl,
    BinaryStl,
}

/// A file in one of the ways in which it may be written, in a scene that reads it.
struct File {
    format: Format,
    name: &'static str,
    bytes: Vec<u8>,
    /// The scene; the name of its file stands as `FILE`.
    scene: String,
    /// The same records written plainly.
    plain: (&'static str, String),
    /// What must come of it.
    expect: Expect,
    /// The damage.
    change: &'static str,
}

impl File {
    fn bundle(&self) -> Bundle {
        let (name, text) = &self.plain;
        let scene = |name: &str| self.scene.replace("FILE", name);
        let before = Bundle::default().with("scene.toml", scene(name)).with(name, text.as_bytes());
        let after = Bundle::default().with("scene.toml", scene(self.name)).with(self.name, self.bytes.clone());
        self.expect.of(&format!("{:?}, {}", self.format, self.change), after, &before)
    }
}

/// A file, perhaps with one damage.
pub fn draw(draw: &mut Draw) -> Bundle {
    let mut file = match draw.below(4) {
        0 => table::draw(draw),
        1 => mesh::draw(draw),
        _ => grains::draw(draw),
    };
    if file.expect == Expect::Same && !draw.one_in(8) {
        damage::damage(draw, &mut file);
    }
    file.bundle()
}

/// A number of millionths, in a unit of so many millionths.
fn number(millionths: i64, unit: i64) -> String {
    format!("{}", millionths as f64 / unit as f64)
}

/// A unit in a header, written as it may be or as somebody could think that it may be.
fn header(draw: &mut Draw, name: &str, unit: &str) -> (String, Expect) {
    match draw.below(20) {
        0 => (format!("{name} ({unit})"), Expect::Same),
        1 => (format!("{name} [{unit}"), Expect::SameOrRefuse),
        2 => (format!("{name} {unit}]"), Expect::SameOrRefuse),
        3 => (format!("{name} / {unit}"), Expect::SameOrRefuse),
        4 => (format!("{name} {unit}"), Expect::SameOrRefuse),
        5 => (format!("{name} in {unit}"), Expect::SameOrRefuse),
        6 => (format!("{name} {{{unit}}}"), Expect::SameOrRefuse),
        7 => (format!("[{unit}] {name}"), Expect::SameOrRefuse),
        8 => (unit.to_owned(), Expect::SameOrRefuse),
        9 => (format!("{name}_{unit}"), Expect::SameOrRefuse),
        10 => (format!("{name} <{unit}>"), Expect::SameOrRefuse),
        11 => (format!("{name}[{unit}]"), Expect::Same),
        12 => (format!("\"{name} [{unit}]\""), Expect::Same),
        13 => (format!("{name} [ {unit} ]"), Expect::Same),
        _ => (format!("{name} [{unit}]"), Expect::Same),
    }
}

/// Lines of a text file, with what may stand between them.
fn lines(draw: &mut Draw, rows: impl IntoIterator<Item = String>, comment: Option<char>) -> Vec<u8> {
    let end = if draw.one_in(4) { "\r\n" } else { "\n" };
    let loose = draw.one_in(4);
    let mut text = String::new();
    for row in rows {
        match comment {
            Some(mark) if loose && draw.one_in(8) => drop(write!(text, "{mark} said beside{end}")),
            Some(_) if loose && draw.one_in(8) => text.push_str(end),
            _ => {}
        }
        let _ = write!(text, "{row}{end}");
    }
    text.into_bytes()
}
