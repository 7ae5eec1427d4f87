//! Where grains begin: overlaps, grains outside their box, more grains than fit.

use super::Parts;
use crate::complaint::{Complaint, Place};
use crate::plan::{Host, Particles, Shape, Signal, Start, Structure, Vector, Wall};

/// Overlap over diameter that a start may have: settled positions written by a program touch a little.
const OVERLAP: f64 = 1e-3;
/// One wrong unit makes every grain overlap; a few complaints are enough to see it.
const MOST_COMPLAINTS: usize = 4;

/// A grain with a given place.
struct Grain<'a> {
    group: &'a str,
    index: usize,
    diameter: f64,
    position: Vector,
}

impl Grain<'_> {
    fn place(&self, parts: &Parts<'_>) -> Place {
        parts.root.locate(&["particles", self.group, "start", "at", "position", &self.index.to_string()])
    }
}

/// A box wall, displaced as it is at time 0.
struct Room<'a> {
    name: &'a str,
    size: Vector,
    floor_centre: Vector,
}

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let mut grains = Vec::new();
    for (name, group) in &parts.particles {
        let Start::At { position, velocity, spin } = &group.start else { continue };
        for (key, list) in [("velocity", velocity), ("spin", spin)] {
            if !list.is_empty() && list.len() != position.len() {
                complaints.push(
                    Complaint::new(format!("`{key}` needs one entry for each position"))
                        .at(
                            &parts.root.locate(&["particles", name, "start", "at", key]),
                            format!("{} entries for {} positions", list.len(), position.len()),
                        )
                        .hint("leave it out for grains at rest"),
                );
            }
        }
        let placed = position.iter().enumerate();
        grains.extend(placed.map(|(index, position)| Grain {
            group: name,
            index,
            diameter: group.diameter,
            position: *position,
        }));
    }
    let rooms: Vec<Room<'_>> = parts.walls.iter().filter_map(|(name, wall)| room(parts, name, wall)).collect();
    outside(parts, &grains, &rooms, complaints);
    overlaps(parts, &mut grains, complaints);
    if !parts.incomplete {
        capacity(parts, &rooms, complaints);
    }
}

fn room<'a>(parts: &Parts<'_>, name: &'a str, wall: &Wall) -> Option<Room<'a>> {
    let Shape::Box { width, height, depth, mut floor_centre } = wall.shape else { return None };
    let (direction, displacement) = if let Some(motion) = &wall.motion {
        (motion.direction, signal_at_start(&motion.signal))
    } else if let Some(host) = wall.host.as_ref().and_then(|host| parts.hosts.get(host)) {
        (host.direction, host_at_start(host))
    } else {
        ([0.0; 3], 0.0)
    };
    for (x, d) in floor_centre.iter_mut().zip(direction) {
        *x += d * displacement;
    }
    Some(Room { name, size: [width, depth, height], floor_centre })
}

fn signal_at_start(signal: &Signal) -> f64 {
    match signal {
        Signal::Sine { amplitude, phase, .. } => amplitude * phase.sin(),
        Signal::Table { value, .. } => value.first().copied().unwrap_or(0.0),
        Signal::SineSweep { .. } | Signal::Impact { .. } | Signal::Steady { .. } => 0.0,
    }
}

fn host_at_start(host: &Host) -> f64 {
    match &host.structure {
        Structure::Oscillator { .. } | Structure::Matrices { .. } => host.displacement,
        Structure::Modes { mode } => mode.iter().map(|mode| mode.shape * host.displacement).sum(),
    }
}

fn outside(parts: &Parts<'_>, grains: &[Grain<'_>], rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    // x, y, z; y is not looked at in the plane.
    let axes: &[(usize, &str, &str)] = if parts.space() {
        &[(0, "left", "right"), (1, "front", "back"), (2, "floor", "ceiling")]
    } else {
        &[(0, "left", "right"), (2, "floor", "ceiling")]
    };
    let mut found = 0;
    for grain in grains {
        for room in rooms {
            let wrong = axes.iter().find_map(|&(axis, low_side, high_side)| {
                let below = if axis == 2 { 0.0 } else { room.size[axis] / 2.0 };
                let low = room.floor_centre[axis] - below + grain.diameter / 2.0;
                let high = room.floor_centre[axis] - below + room.size[axis] - grain.diameter / 2.0;
                let slack = OVERLAP * grain.diameter;
                let x = grain.position[axis];
                if x < low - slack {
                    Some((low_side, low - x))
                } else if x > high + slack {
                    Some((high_side, x - high))
                } else {
                    None
                }
            });
            let Some((side, depth)) = wrong else { continue };
            found += 1;
            if found <= MOST_COMPLAINTS {
                complaints.push(
                    Complaint::new(format!(
                        "grain {} of `{}` begins outside the box `{}`",
                        grain.index, grain.group, room.name
                    ))
                    .at(&grain.place(parts), format!("reaches {} through the {side}", millimetres(depth)))
                    .hint("positions are centres; x runs to the right, z up"),
                );
            }
        }
        if let Some((name, depth)) = behind_plane(parts, grain) {
            found += 1;
            if found <= MOST_COMPLAINTS {
                complaints.push(
                    Complaint::new(format!(
                        "grain {} of `{}` begins behind the plane `{name}`",
                        grain.index, grain.group
                    ))
                    .at(&grain.place(parts), format!("reaches {} into it", millimetres(depth))),
                );
            }
        }
    }
}

fn behind_plane<'a>(parts: &'a Parts<'_>, grain: &Grain<'_>) -> Option<(&'a str, f64)> {
    parts.walls.iter().find_map(|(name, wall)| {
        let Shape::Plane { point, normal } = wall.shape else { return None };
        let distance: f64 = (0..3).map(|i| (grain.position[i] - point[i]) * normal[i]).sum();
        let depth = grain.diameter / 2.0 - distance;
        // A moved plane is wherever its motion says; only still planes can be judged here.
        let still = wall.motion.is_none() && wall.host.is_none();
        (still && depth > OVERLAP * grain.diameter).then_some((name.as_str(), depth))
    })
}

/// Sweeps along the longer of x and z, so that a column of grains is as quick as a row.
fn overlaps(parts: &Parts<'_>, grains: &mut [Grain<'_>], complaints: &mut Vec<Complaint>) {
    let extent = |axis: usize| {
        let values = || grains.iter().map(|grain| grain.position[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let axis = if extent(0) >= extent(2) { 0 } else { 2 };
    let largest = grains.iter().map(|grain| grain.diameter).fold(0.0, f64::max);
    grains.sort_by(|a, b| a.position[axis].total_cmp(&b.position[axis]));
    let mut found = 0;
    for (i, a) in grains.iter().enumerate() {
        for b in grains[i + 1..].iter().take_while(|b| b.position[axis] - a.position[axis] < largest) {
            let distance = (0..3).map(|k| (a.position[k] - b.position[k]).powi(2)).sum::<f64>().sqrt();
            let reach = 0.5 * (a.diameter + b.diameter);
            let overlap = (reach - distance) / reach;
            if overlap <= OVERLAP {
                continue;
            }
            found += 1;
            if found > MOST_COMPLAINTS {
                return;
            }
            let (first, second) = if (a.group, a.index) <= (b.group, b.index) { (a, b) } else { (b, a) };
            complaints.push(
                Complaint::new(format!("{} overlap at the start by {overlap:.3} diameters", both(first, second)))
                    .at(
                        &second.place(parts),
                        format!(
                            "{} between the centres, the diameter is {}",
                            millimetres(distance),
                            millimetres(reach)
                        ),
                    )
                    .also(&first.place(parts), "the other grain")
                    .hint(format!("move one of them; up to {OVERLAP} diameters would be let through")),
            );
        }
    }
}

fn both(first: &Grain<'_>, second: &Grain<'_>) -> String {
    if first.group == second.group {
        format!("grains {} and {} of `{}`", first.index, second.index, first.group)
    } else {
        format!("grains {} of `{}` and {} of `{}`", first.index, first.group, second.index, second.group)
    }
}

/// Grains that fill a box need one, and it must hold them.
fn capacity(parts: &Parts<'_>, rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    let filling: Vec<(&String, &Particles)> =
        parts.particles.iter().filter(|(_, group)| group.count > 0 && fills_a_box(&group.start)).collect();
    let room = match (filling.as_slice(), rooms) {
        ([], _) => return,
        (_, [room]) => room,
        ([(name, _), ..], []) => {
            complaints.push(
                Complaint::new(format!("there is no box for the grains `{name}` to start in"))
                    .at(&parts.root.locate(&["particles", name, "start"]), "needs a wall with `shape.box`")
                    .hint("add [walls.box] with shape.box = { width = \"60 mm\", height = \"96 mm\" }")
                    .hint("or give their places: start.at = { position = [[0, 0.003]] }"),
            );
            return;
        }
        ([(name, _), ..], [_, second, ..]) => {
            complaints.push(
                Complaint::new(format!(
                    "there are {} boxes, so it is not clear where the grains `{name}` start",
                    rooms.len()
                ))
                .at(&parts.root.locate(&["walls", second.name]), "another box")
                .hint("keep one box, or give the places of the grains with start.at"),
            );
            return;
        }
    };
    let mut filled = 0.0;
    for (name, group) in filling {
        let fits = fits(group, room, parts.space());
        filled += group.count as f64 / fits.max(f64::MIN_POSITIVE);
        if filled > 1.0 + 1e-9 {
            complaints.push(overfull(parts, room, name, group, fits));
            return;
        }
    }
}

fn overfull(parts: &Parts<'_>, room: &Room<'_>, name: &str, group: &Particles, fits: f64) -> Complaint {
    let box_place = parts.root.locate(&["walls", room.name, "shape", "box"]);
    let at = |key: &str| parts.root.locate(&["particles", name, key]);
    if fits == 0.0 {
        let [width, depth, height] = room.size.map(millimetres);
        let depth = if parts.space() { format!(", {depth} deep") } else { String::new() };
        return Complaint::new(format!("not one grain of `{name}` fits into the box `{}`", room.name))
            .at(&at("diameter"), format!("{} wide", millimetres(group.diameter)))
            .also(&box_place, format!("{width} wide, {height} high{depth}"))
            .hint("is a unit missing?");
    }
    let title = if group.count as f64 > fits {
        format!("{} grains of `{name}` do not fit into the box `{}`", group.count, room.name)
    } else {
        format!("the groups of grains together do not fit into the box `{}`", room.name)
    };
    let spaced = match group.start {
        Start::Rows { spacing, .. } if spacing > 1.0 => format!(" at a spacing of {spacing} diameters"),
        _ => String::new(),
    };
    Complaint::new(title)
        .at(&at("count"), format!("{fits} fit{spaced}"))
        .also(&box_place, "the box")
        .hint("take fewer or smaller grains, or a larger box")
}

/// How many grains of the group fill the box in rows.
fn fits(group: &Particles, room: &Room<'_>, space: bool) -> f64 {
    let spacing = match group.start {
        Start::Rows { spacing, .. } => spacing,
        _ => 1.0,
    };
    let along = |length: f64| {
        let gaps = (length - group.diameter) / (spacing * group.diameter);
        // 60 mm over 6 mm is ten, whatever the last bit says.
        (gaps + 1e-9).floor() + 1.0
    };
    let depth = if space { along(room.size[1]).max(0.0) } else { 1.0 };
    along(room.size[0]).max(0.0) * along(room.size[2]).max(0.0) * depth
}

fn millimetres(length: f64) -> String {
    let rounded: f64 = format!("{:.3e}", length * 1e3).parse().unwrap_or(length * 1e3);
    format!("{rounded} mm")
}

const fn fills_a_box(start: &Start) -> bool {
    matches!(start, Start::Settled { .. } | Start::Rows { region: None, .. } | Start::Random { region: None, .. })
}
