//! Extended XYZ, one snapshot a file, for `OVITO`.

use std::path::Path;

use crate::FileError;
use crate::folder::write_atomically;
use crate::frame::{Frame, Kind, Values};

/// Writes the grains; columns that are absent are left out, `species` is the `material` index where there is one.
pub fn write(path: &Path, frame: &Frame) -> Result<(), FileError> {
    let vectors = |name| match frame.column(Kind::Grain, name).map(|c| &c.values) {
        Some(Values::Vector(v)) => Some(v.as_slice()),
        _ => None,
    };
    let integers = |name| match frame.column(Kind::Grain, name).map(|c| &c.values) {
        Some(Values::Integer(v)) => Some(v.as_slice()),
        _ => None,
    };
    let radius = match frame.column(Kind::Grain, "radius").map(|c| &c.values) {
        Some(Values::Scalar(v)) => Some(v.as_slice()),
        _ => None,
    };
    let position = vectors("position").unwrap_or_default();
    let velocity = vectors("velocity");
    let (id, material) = (integers("id"), integers("material"));
    let (low, size) = bounds(frame, position, radius);
    write_atomically(path, |out| {
        writeln!(out, "{}", position.len())?;
        write!(
            out,
            "Lattice=\"{:?} 0 0 0 {:?} 0 0 0 {:?}\" Origin=\"{:?} {:?} {:?}\" pbc=\"F F F\" \
             Properties=species:S:1:pos:R:3",
            size[0], size[1], size[2], low[0], low[1], low[2]
        )?;
        for (there, property) in
            [(velocity.is_some(), ":velo:R:3"), (radius.is_some(), ":radius:R:1"), (id.is_some(), ":id:I:1")]
        {
            out.write_all(if there { property.as_bytes() } else { b"" })?;
        }
        writeln!(out, " Time={:?} Step={}", frame.time, frame.step)?;
        for (i, [x, y, z]) in position.iter().enumerate() {
            match material.and_then(|m| m.get(i)) {
                Some(m) => write!(out, "M{m}")?,
                None => write!(out, "grain")?,
            }
            write!(out, " {x:?} {y:?} {z:?}")?;
            if let Some([u, v, w]) = velocity.and_then(|v| v.get(i)) {
                write!(out, " {u:?} {v:?} {w:?}")?;
            }
            if let Some(r) = radius.and_then(|r| r.get(i)) {
                write!(out, " {r:?}")?;
            }
            if let Some(id) = id.and_then(|id| id.get(i)) {
                write!(out, " {id}")?;
            }
            writeln!(out)?;
        }
        Ok(())
    })
}

/// The box of the walls and grains: `OVITO` wants one, and a cell of no size hides everything.
fn bounds(frame: &Frame, position: &[[f64; 3]], radius: Option<&[f64]>) -> ([f64; 3], [f64; 3]) {
    let walls = match frame.column(Kind::Surface, "position").map(|c| &c.values) {
        Some(Values::Vector(v)) => v.as_slice(),
        _ => &[],
    };
    let reach = |i: usize| radius.and_then(|r| r.get(i)).copied().unwrap_or_default();
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    let spheres = position.iter().enumerate().map(|(i, p)| (p, reach(i)));
    for (p, r) in spheres.chain(walls.iter().map(|p| (p, 0.0))) {
        for k in 0..3 {
            low[k] = low[k].min(p[k] - r);
            high[k] = high[k].max(p[k] + r);
        }
    }
    let mut size = [1.0; 3];
    for k in 0..3 {
        if low[k].is_finite() && high[k] > low[k] {
            size[k] = high[k] - low[k];
        } else {
            low[k] = 0.0;
        }
    }
    (low, size)
}
