//! VTK `PolyData` (`.vtp`): XML with raw appended binary data, for `ParaView` and anything built on VTK.
//!
//! One file per moment and kind: grains, contacts and cells are points with their columns as point data, walls are
//! closed lines and polygons. Units travel as VTK's own `UNITS_LABEL`, time and step as field data, so that a single file says
//! everything about itself.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;

use crate::FileError;
use crate::frame::{Column, Frame, Kind, Values};
use crate::whole::write_beside;

/// Kinds that have points, and the stem of the file of each.
pub const STEMS: [(Kind, &str); 4] =
    [(Kind::Grain, "grains"), (Kind::Contact, "contacts"), (Kind::Cell, "cells"), (Kind::Surface, "walls")];

/// Writes the columns of one kind; `false` if the frame has no `position` of that kind and so nothing was written.
pub fn write(path: &Path, frame: &Frame, kind: Kind) -> Result<bool, FileError> {
    let Some(Values::Vector(points)) = frame.column(kind, "position").map(|c| &c.values) else {
        return Ok(false);
    };
    let time = [frame.time];
    let step = [frame.step as i64];
    let surface = kind == Kind::Surface;
    let cells = if surface { surfaces(frame, points.len()) } else { Vec::new() };
    let count = |name: &str| cells.iter().find(|c| c.0 == name).map_or(0, |c| c.1.offsets.len());
    let mut blocks = Blocks::default();
    let mut head = String::from(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n<FieldData>\n",
    );
    blocks.reals(&mut head, "TimeValue", "s", &time, "NumberOfTuples=\"1\"");
    blocks.integers(&mut head, "step", "-", &step, "NumberOfTuples=\"1\"");
    for column in frame.of(Kind::Global) {
        let tuples = format!("NumberOfTuples=\"{}\"", column.values.len());
        blocks.column(&mut head, column, &tuples);
    }
    head.push_str("</FieldData>\n");
    let _ = writeln!(
        head,
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">",
        points.len(),
        if surface { 0 } else { points.len() },
        count("Lines"),
        count("Polys"),
    );
    head.push_str("<PointData>\n");
    for column in frame.of(kind) {
        if column.name != "position" && column.values.len() == points.len() {
            blocks.column(&mut head, column, "");
        }
    }
    head.push_str("</PointData>\n<Points>\n");
    blocks.vectors(&mut head, "position", "m", points, "");
    head.push_str("</Points>\n");
    if !surface {
        let rows = points.len() as i64;
        head.push_str("<Verts>\n");
        blocks.counted(&mut head, "connectivity", 0..rows);
        blocks.counted(&mut head, "offsets", 1..rows + 1);
        head.push_str("</Verts>\n");
    }
    for (name, cells) in &cells {
        let _ = writeln!(head, "<{name}>");
        blocks.integers(&mut head, "connectivity", "-", &cells.connectivity, "");
        blocks.integers(&mut head, "offsets", "-", &cells.offsets, "");
        let _ = writeln!(head, "</{name}>");
    }
    head.push_str("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    write_beside(path, |out| {
        out.write_all(head.as_bytes())?;
        blocks.write(out)?;
        out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    })?;
    Ok(true)
}

/// Points of one cell after the other, and where each ends.
#[derive(Default)]
struct Cells {
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
}

/// Closed lines and polygons: consecutive rows of equal `outline`. Lines go back to their first row.
fn surfaces(frame: &Frame, rows: usize) -> Vec<(&'static str, Cells)> {
    let zeros = vec![0; rows];
    let column = |name| match frame.integers(Kind::Surface, name) {
        v if v.len() == rows => v,
        _ => &zeros,
    };
    let (outline, face) = (column("outline"), column("face"));
    let (mut lines, mut polygons) = (Cells::default(), Cells::default());
    let mut start = 0;
    for group in outline.chunk_by(|a, b| a == b) {
        let solid = face[start] != 0;
        let cells = if solid { &mut polygons } else { &mut lines };
        cells.connectivity.extend((start..start + group.len()).map(|i| i as i64));
        if group.len() > 2 && !solid {
            cells.connectivity.push(start as i64);
        }
        cells.offsets.push(cells.connectivity.len() as i64);
        start += group.len();
    }
    vec![("Lines", lines), ("Polys", polygons)]
}

/// The data arrays, in the order of their XML elements.
#[derive(Default)]
struct Blocks<'a> {
    data: Vec<Data<'a>>,
    offset: u64,
}

enum Data<'a> {
    Reals(&'a [f64]),
    Vectors(&'a [[f64; 3]]),
    Quaternions(&'a [[f64; 4]]),
    Integers(&'a [i64]),
    Counted(Range<i64>),
}

impl Data<'_> {
    fn bytes(&self) -> u64 {
        8 * match self {
            Self::Reals(v) => v.len() as u64,
            Self::Vectors(v) => 3 * v.len() as u64,
            Self::Quaternions(v) => 4 * v.len() as u64,
            Self::Integers(v) => v.len() as u64,
            Self::Counted(range) => range.end.abs_diff(range.start),
        }
    }
}

impl<'a> Blocks<'a> {
    fn column(&mut self, head: &mut String, column: &'a Column, more: &str) {
        match &column.values {
            Values::Scalar(v) => self.reals(head, column.name, column.unit, v, more),
            Values::Vector(v) => self.vectors(head, column.name, column.unit, v, more),
            Values::Quaternion(v) => {
                let about = format!("type=\"Float64\" NumberOfComponents=\"4\" {more}");
                self.declare(head, column.name, column.unit, &about, Data::Quaternions(v));
            }
            Values::Integer(v) => self.integers(head, column.name, column.unit, v, more),
        }
    }

    fn reals(&mut self, head: &mut String, name: &str, unit: &str, v: &'a [f64], more: &str) {
        self.declare(head, name, unit, &format!("type=\"Float64\" {more}"), Data::Reals(v));
    }

    fn vectors(&mut self, head: &mut String, name: &str, unit: &str, v: &'a [[f64; 3]], more: &str) {
        let about = format!("type=\"Float64\" NumberOfComponents=\"3\" {more}");
        self.declare(head, name, unit, &about, Data::Vectors(v));
    }

    fn integers(&mut self, head: &mut String, name: &str, unit: &str, v: &'a [i64], more: &str) {
        self.declare(head, name, unit, &format!("type=\"Int64\" {more}"), Data::Integers(v));
    }

    fn counted(&mut self, head: &mut String, name: &str, numbers: Range<i64>) {
        self.declare(head, name, "-", "type=\"Int64\"", Data::Counted(numbers));
    }

    fn declare(&mut self, head: &mut String, name: &str, unit: &str, about: &str, data: Data<'a>) {
        let _ = write!(
            head,
            "<DataArray Name=\"{}\" {} format=\"appended\" offset=\"{}\"",
            escape(name),
            about.trim_end(),
            self.offset
        );
        if unit == "-" {
            head.push_str("/>\n");
        } else {
            let _ = writeln!(
                head,
                "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey></DataArray>",
                escape(unit)
            );
        }
        self.offset += 8 + data.bytes();
        self.data.push(data);
    }

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        for data in &self.data {
            out.write_all(&data.bytes().to_le_bytes())?;
            match data {
                Data::Reals(v) => v.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?,
                Data::Vectors(v) => {
                    v.iter().flatten().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
                }
                Data::Quaternions(v) => {
                    v.iter().flatten().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
                }
                Data::Integers(v) => v.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?,
                Data::Counted(range) => range.clone().try_for_each(|x| out.write_all(&x.to_le_bytes()))?,
            }
        }
        Ok(())
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
