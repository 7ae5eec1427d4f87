//! A frame as the page draws it: grains, walls and contacts as arrays.

use std::collections::HashMap;

#[cfg(feature = "server")]
use serde_json::json;
use tsubu_frame::{Frame, Kind, Values};

#[cfg(feature = "server")]
use crate::packet::Packet;
#[cfg(feature = "server")]
use crate::paint::{Paint, paints, range, values};

/// A frame in bytes, grains coloured by `colour`, with the vectors of the column `arrows` if it has them.
#[cfg(feature = "server")]
pub fn packet(frame: &Frame, colour: &str, arrows: &str) -> Vec<u8> {
    let shown = values(frame, colour).unwrap_or_default();
    let mut packet = Packet::default();
    for (name, _, numbers) in self::arrays(frame, true) {
        if WHOLE.contains(&name) {
            packet.integers(name, numbers.into_iter().map(|x| x as i64));
        } else {
            packet.reals(name, numbers);
        }
    }
    packet.reals("colour", shown.iter().copied());
    packet.reals("arrows", frame.vectors(Kind::Grain, arrows).as_flattened().iter().copied());
    let columns = paints(frame).into_iter().map(|Paint { name, unit }| json!({ "name": name, "unit": unit }));
    packet.seal(json!({
        "time": frame.time,
        "step": frame.step,
        "grains": frame.vectors(Kind::Grain, "position").len(),
        "columns": columns.collect::<Vec<_>>(),
        "range": range(&shown),
        "cell": frame.periodic(),
    }))
}

/// Grains whose outlines are drawn.
const OUTLINED: usize = 20_000;

/// The arrays of whole numbers.
#[cfg(feature = "server")]
const WHOLE: [&str; 2] = ["group", "id"];

/// Arrays that have a row for each grain.
pub const OF_GRAINS: [&str; 8] =
    ["position", "radius", "group", "id", "turned", "semi-axes", "exponents", "polyhedron"];

/// What is drawn of a frame: names, numbers a row (3 for vectors), and the numbers. Contacts are left out unless `bonds`.
pub fn arrays(frame: &Frame, bonds: bool) -> Vec<(&'static str, usize, Vec<f64>)> {
    let flat = |vectors: &[[f64; 3]]| vectors.as_flattened().to_vec();
    let whole = |name| frame.integers(Kind::Grain, name).iter().map(|x| *x as f64).collect::<Vec<_>>();
    let mut arrays = vec![
        ("position", 3, flat(frame.vectors(Kind::Grain, "position"))),
        ("radius", 1, radii(frame)),
        ("group", 1, whole("group")),
        ("id", 1, whole("id")),
    ];
    let [lines, triangles] = walls(frame);
    arrays.extend([("lines", 3, flat(&lines)), ("triangles", 3, flat(&triangles))]);
    arrays.push(("outlines", 3, flat(&outlines(frame))));
    arrays.extend(bodies(frame));
    if bonds {
        let (ends, forces) = contacts(frame);
        arrays.extend([("bonds", 3, flat(&ends)), ("forces", 1, forces)]);
    }
    arrays
}

/// Radii of grains; those without one are drawn small against all that is there.
fn radii(frame: &Frame) -> Vec<f64> {
    let position = frame.vectors(Kind::Grain, "position");
    let radius = frame.scalars(Kind::Grain, "radius");
    if radius.len() == position.len() {
        return radius.to_vec();
    }
    let reach = position.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |far, x| far.max(x.abs()));
    vec![if reach > 0.0 { 0.01 * reach } else { 1.0 }; position.len()]
}

/// Walls: pairs of points of lines, and corners of triangles.
fn walls(frame: &Frame) -> [Vec<[f64; 3]>; 2] {
    let corners = frame.vectors(Kind::Surface, "position");
    let faces = frame.integers(Kind::Surface, "face");
    let (mut lines, mut triangles) = (Vec::new(), Vec::new());
    let mut start = 0;
    for outline in frame.integers(Kind::Surface, "outline").chunk_by(|a, b| a == b) {
        let around = corners.get(start..start + outline.len()).unwrap_or_default();
        let solid = faces.get(start).is_some_and(|face| *face != 0);
        start += outline.len();
        match around {
            [first, rest @ ..] if solid => {
                rest.windows(2).for_each(|pair| triangles.extend([*first, pair[0], pair[1]]));
            }
            [first, .., last] => {
                around.windows(2).for_each(|pair| lines.extend(pair));
                if around.len() > 2 {
                    lines.extend([*last, *first]);
                }
            }
            _ => {}
        }
    }
    [lines, triangles]
}

/// Grains with outlines: pairs of points of lines. Of more than [`OUTLINED`] none: a line round each would hide what it goes round.
fn outlines(frame: &Frame) -> Vec<[f64; 3]> {
    let shapes = frame.integers(Kind::Grain, "shape");
    let corners = frame.vectors(Kind::Global, "corner");
    if shapes.len() > OUTLINED || corners.is_empty() {
        return Vec::new();
    }
    let mut round: HashMap<i64, Vec<[f64; 3]>> = HashMap::new();
    for (shape, corner) in frame.integers(Kind::Global, "shape of corner").iter().zip(corners) {
        round.entry(*shape).or_default().push(*corner);
    }
    let at = |centre: &[f64; 3], corner: &[f64; 3]| [0, 1, 2].map(|axis| centre[axis] + corner[axis]);
    let grains = frame.vectors(Kind::Grain, "position").iter().zip(shapes);
    let line = |(centre, shape): (&[f64; 3], &i64)| {
        let corners = round.get(shape).map_or(&[][..], Vec::as_slice);
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).flat_map(|(a, b)| [at(centre, a), at(centre, b)]).collect::<Vec<_>>()
    };
    grains.flat_map(line).collect()
}

/// Superellipsoids and polyhedra: how all grains are turned and what each is, a sphere three semi-axes; then the faces of all polyhedra of
/// diameter 1. Nothing where all grains are spheres.
fn bodies(frame: &Frame) -> Vec<(&'static str, usize, Vec<f64>)> {
    let (axes, number) = (frame.vectors(Kind::Grain, "semi-axes"), frame.integers(Kind::Grain, "polyhedron"));
    let turned = match frame.column(Kind::Grain, "orientation").map(|column| &column.values) {
        Some(Values::Quaternion(turned)) if !axes.is_empty() || !number.is_empty() => turned,
        _ => return Vec::new(),
    };
    let radius = radii(frame);
    let [profile, equator] = ["profile exponent", "equator exponent"].map(|name| frame.scalars(Kind::Grain, name));
    let of = |column: &[f64], i: usize| column.get(i).copied().unwrap_or(2.0);
    let rows = 0..turned.len().min(radius.len());
    let faces =
        frame.vectors(Kind::Global, "polyhedron normal").iter().zip(frame.scalars(Kind::Global, "polyhedron offset"));
    let whole = |numbers: &[i64]| numbers.iter().map(|x| *x as f64).collect::<Vec<_>>();
    vec![
        ("turned", 4, turned.iter().flat_map(|[w, x, y, z]| [*x, *y, *z, *w]).collect()),
        ("semi-axes", 3, rows.clone().flat_map(|i| axes.get(i).copied().unwrap_or([radius[i]; 3])).collect()),
        ("exponents", 2, rows.clone().flat_map(|i| [of(profile, i), of(equator, i)]).collect()),
        ("polyhedron", 1, rows.map(|i| number.get(i).map_or(-1.0, |number| *number as f64)).collect()),
        ("faces", 4, faces.flat_map(|([x, y, z], offset)| [*x, *y, *z, *offset]).collect()),
        ("face of", 1, whole(frame.integers(Kind::Global, "polyhedron of face"))),
        ("rounding", 1, frame.scalars(Kind::Global, "polyhedron rounding").to_vec()),
    ]
}

/// Contacts: two points and a force [N] each. A bond goes from middle to middle, or as far as the contact, where that is with a wall or
/// across a periodic end.
fn contacts(frame: &Frame) -> (Vec<[f64; 3]>, Vec<f64>) {
    let (place, force) = (frame.vectors(Kind::Contact, "position"), frame.vectors(Kind::Contact, "force"));
    let ends = ["first", "second"].map(|name| frame.integers(Kind::Contact, name));
    let (id, centre) = (frame.integers(Kind::Grain, "id"), frame.vectors(Kind::Grain, "position"));
    let radius = radii(frame);
    let rows: HashMap<i64, usize> = id.iter().enumerate().map(|(row, id)| (*id, row)).collect();
    let mut bonds = Vec::new();
    for (contact, at) in place.iter().enumerate() {
        for end in ends {
            let row = end.get(contact).and_then(|id| rows.get(id)).filter(|row| **row < centre.len());
            let near = row.filter(|row| distance(&centre[**row], at) < 1.5 * radius[**row]);
            bonds.push(near.map_or(*at, |row| centre[*row]));
        }
    }
    (bonds, force.iter().map(|f| f.iter().map(|c| c * c).sum::<f64>().sqrt()).collect())
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
