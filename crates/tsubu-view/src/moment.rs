//! A frame as the page draws it: grains, walls and contacts as arrays.

use std::collections::HashMap;

use serde_json::json;
use tsubu_frame::{Frame, Kind};

use crate::packet::Packet;
use crate::paint::{Paint, paints, range, values};

/// A frame in bytes, grains coloured by `colour`.
pub fn packet(frame: &Frame, colour: &str) -> Vec<u8> {
    let position = frame.vectors(Kind::Grain, "position");
    let shown = values(frame, colour).unwrap_or_default();
    let mut packet = Packet::default();
    packet.vectors("position", position);
    packet.reals("radius", radii(frame));
    packet.reals("colour", shown.iter().copied());
    packet.integers("group", frame.integers(Kind::Grain, "group").iter().copied());
    packet.integers("id", frame.integers(Kind::Grain, "id").iter().copied());
    add_walls(frame, &mut packet);
    add_contacts(frame, &mut packet);
    let columns = paints(frame).into_iter().map(|Paint { name, unit }| json!({ "name": name, "unit": unit }));
    packet.seal(json!({
        "time": frame.time,
        "step": frame.step,
        "grains": position.len(),
        "columns": columns.collect::<Vec<_>>(),
        "range": range(&shown),
        "cell": frame.periodic(),
    }))
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
fn add_walls(frame: &Frame, packet: &mut Packet) {
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
                rest.windows(2).for_each(|pair| triangles.extend([first, &pair[0], &pair[1]]));
            }
            [first, .., last] => {
                around.windows(2).for_each(|pair| lines.extend(pair));
                if around.len() > 2 {
                    lines.extend([last, first]);
                }
            }
            _ => {}
        }
    }
    packet.vectors("lines", lines);
    packet.vectors("triangles", triangles);
}

/// Contacts: two points and a force [N] each. A bond goes from middle to middle, or as far as the contact, where that is with a wall or
/// across a periodic end.
fn add_contacts(frame: &Frame, packet: &mut Packet) {
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
            bonds.push(near.map_or(at, |row| &centre[*row]));
        }
    }
    packet.vectors("bonds", bonds);
    packet.reals("forces", force.iter().map(|f| f.iter().map(|c| c * c).sum::<f64>().sqrt()));
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
