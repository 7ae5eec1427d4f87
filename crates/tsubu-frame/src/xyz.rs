//! Extended XYZ, one snapshot a file, for `OVITO`.

use std::io::Write as _;
use std::path::Path;

use crate::FileError;
use crate::frame::{Frame, Kind, Values};
use crate::whole::write_beside;

/// Columns after species and position: name in the frame, property in the file.
const COLUMNS: [(&str, &str); 6] = [
    ("velocity", "velo:R:3"),
    ("radius", "radius:R:1"),
    ("id", "id:I:1"),
    ("spin", "omega:R:3"),
    ("mass", "mass:R:1"),
    ("orientation", "orientation:R:4"),
];

/// Writes the grains; columns that are absent are left out, `species` is the `group` where there is one.
pub fn write(path: &Path, frame: &Frame) -> Result<(), FileError> {
    let position = frame.vectors(Kind::Grain, "position");
    let group = frame.integers(Kind::Grain, "group");
    let there = |(name, property): (&str, &'static str)| {
        let values = &frame.column(Kind::Grain, name)?.values;
        (values.len() == position.len()).then_some((property, values))
    };
    let columns: Vec<(&str, &Values)> = COLUMNS.into_iter().filter_map(there).collect();
    let (low, size) = bounds(frame);
    let repeats = frame.periodic().map_or([0.0; 3], |periodic| periodic[2]);
    let [p, q, r] = repeats.map(|repeats| if repeats == 0.0 { "F" } else { "T" });
    write_beside(path, |out| {
        writeln!(out, "{}", position.len())?;
        write!(
            out,
            "Lattice=\"{:?} 0 0 0 {:?} 0 0 0 {:?}\" Origin=\"{:?} {:?} {:?}\" pbc=\"{p} {q} {r}\" \
             Properties=species:S:1:pos:R:3",
            size[0], size[1], size[2], low[0], low[1], low[2]
        )?;
        for (property, _) in &columns {
            write!(out, ":{property}")?;
        }
        writeln!(out, " Time={:?} Step={}", frame.time, frame.step)?;
        for (i, [x, y, z]) in position.iter().enumerate() {
            match group.get(i) {
                Some(g) => write!(out, "G{g} {x:?} {y:?} {z:?}")?,
                None => write!(out, "grain {x:?} {y:?} {z:?}")?,
            }
            for (_, values) in &columns {
                match values {
                    Values::Scalar(v) => write!(out, " {:?}", v[i])?,
                    Values::Vector(v) => write!(out, " {:?} {:?} {:?}", v[i][0], v[i][1], v[i][2])?,
                    // OVITO has the real part last.
                    Values::Quaternion(v) => write!(out, " {:?} {:?} {:?} {:?}", v[i][1], v[i][2], v[i][3], v[i][0])?,
                    Values::Integer(v) => write!(out, " {}", v[i])?,
                }
            }
            writeln!(out)?;
        }
        Ok(())
    })
}

/// Low corner and size of the box of walls and grains, and of the cell where the world repeats: readers want one, and a
/// cell of no size hides everything.
pub(crate) fn bounds(frame: &Frame) -> ([f64; 3], [f64; 3]) {
    let radius = frame.scalars(Kind::Grain, "radius");
    let reach = |i: usize| radius.get(i).copied().unwrap_or_default();
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    let spheres = frame.vectors(Kind::Grain, "position").iter().enumerate().map(|(i, p)| (p, reach(i)));
    for (p, r) in spheres.chain(frame.vectors(Kind::Surface, "position").iter().map(|p| (p, 0.0))) {
        for k in 0..3 {
            low[k] = low[k].min(p[k] - r);
            high[k] = high[k].max(p[k] + r);
        }
    }
    let periodic = frame.periodic().unwrap_or_default();
    let mut size = [1.0; 3];
    for k in 0..3 {
        if periodic[2][k] != 0.0 {
            (low[k], high[k]) = (periodic[0][k], periodic[1][k]);
        }
        if low[k].is_finite() && high[k] > low[k] {
            size[k] = high[k] - low[k];
        } else {
            low[k] = 0.0;
        }
    }
    (low, size)
}
