//! LAMMPS dump files, one snapshot a file, for `read_dump` and `rerun` of LAMMPS, and for `OVITO`.
//!
//! Numbers of atoms begin with 1, as LAMMPS wants it: an atom is the grain of the number below. The type of an atom is
//! the number of its group and begins with 1 too.

use std::io::Write as _;
use std::path::Path;

use crate::FileError;
use crate::frame::{Frame, Kind};
use crate::whole::write_beside;
use crate::xyz::bounds;

/// Writes the grains; what a frame does not hold is 0.
pub fn write(path: &Path, frame: &Frame) -> Result<(), FileError> {
    let vectors = |name| frame.vectors(Kind::Grain, name);
    let scalars = |name| frame.scalars(Kind::Grain, name);
    let (position, velocity, spin) = (vectors("position"), vectors("velocity"), vectors("spin"));
    let (radius, mass) = (scalars("radius"), scalars("mass"));
    let (id, group) = (frame.integers(Kind::Grain, "id"), frame.integers(Kind::Grain, "group"));
    let (low, size) = bounds(frame);
    let repeats = frame.periodic().map_or([0.0; 3], |periodic| periodic[2]);
    let border = repeats.map(|repeats| if repeats == 0.0 { "ff" } else { "pp" });
    write_beside(path, |out| {
        writeln!(out, "ITEM: UNITS\nsi\nITEM: TIME\n{:?}\nITEM: TIMESTEP\n{}", frame.time, frame.step)?;
        writeln!(out, "ITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}", position.len(), border.join(" "))?;
        for (low, size) in low.iter().zip(&size) {
            writeln!(out, "{low:?} {:?}", low + size)?;
        }
        writeln!(out, "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius mass")?;
        for (i, [x, y, z]) in position.iter().enumerate() {
            let number = |column: &[i64]| column.get(i).copied();
            let vector = |column: &[[f64; 3]]| column.get(i).copied().unwrap_or_default();
            let scalar = |column: &[f64]| column.get(i).copied().unwrap_or_default();
            let ([u, v, w], [a, b, c]) = (vector(velocity), vector(spin));
            let (id, kind) = (number(id).unwrap_or(i as i64) + 1, number(group).unwrap_or_default() + 1);
            let (radius, mass) = (scalar(radius), scalar(mass));
            writeln!(out, "{id} {kind} {x:?} {y:?} {z:?} {u:?} {v:?} {w:?} {a:?} {b:?} {c:?} {radius:?} {mass:?}")?;
        }
        Ok(())
    })
}
