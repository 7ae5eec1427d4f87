//! Where grains begin: overlaps, and grains outside their box, behind a plane, in a shell or beyond the world.

use super::overlap::{self, Grain};
use super::{Parts, shell};
use crate::complaint::{Complaint, Place};
use crate::grain_file::How;
use crate::plan::{GrainMotion, Host, Shape, Signal, Start, Structure, Vector, Wall};

/// Overlap over diameter that a start may have: settled positions written by a program touch a little.
const OVERLAP: f64 = 1e-3;
/// The same for files: other codes write beds that lie under load.
const OVERLAP_IN_FILES: f64 = 0.05;
/// One wrong unit makes every grain overlap; a few complaints are enough to see it.
const MOST_COMPLAINTS: usize = 4;

impl Grain<'_> {
    fn place(&self, parts: &Parts<'_>) -> Place {
        let start = ["particles", self.group, "start"];
        match self.line {
            None => parts.root.locate(&[&start[..], &["at", "position", &self.index.to_string()]].concat()),
            Some(_) => parts.root.locate(&[&start[..], &["file", "path"]].concat()),
        }
    }

    /// What stands under the place: the line of the file if the place cannot tell.
    fn label(&self, text: String) -> String {
        match self.line {
            None => text,
            Some(line) => format!("line {line}: {text}"),
        }
    }

    /// How much of its diameter it may be in something else.
    const fn slack(&self) -> f64 {
        if self.line.is_some() { OVERLAP_IN_FILES } else { OVERLAP }
    }
}

/// A box wall, displaced as it is at time 0.
pub(super) struct Room<'a> {
    pub name: &'a str,
    pub size: Vector,
    pub floor_centre: Vector,
}

impl Room<'_> {
    /// The ends along an axis.
    pub fn ends(&self, axis: usize) -> [f64; 2] {
        let below = if axis == 2 { 0.0 } else { self.size[axis] / 2.0 };
        let low = self.floor_centre[axis] - below;
        [low, low + self.size[axis]]
    }
}

/// x, y, z and what a box has at their ends; y is not looked at in the plane.
pub(super) const fn axes(space: bool) -> &'static [(usize, &'static str, &'static str)] {
    if space {
        &[(0, "left", "right"), (1, "front", "back"), (2, "floor", "ceiling")]
    } else {
        &[(0, "left", "right"), (2, "floor", "ceiling")]
    }
}

pub(super) fn check(parts: &Parts<'_>, rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    let mut grains = Vec::new();
    for (name, group) in &parts.particles {
        let held = !matches!(group.motion, GrainMotion::Free {});
        match &group.start {
            Start::At { position, velocity, spin } => {
                lengths(parts, name, position, [("velocity", velocity), ("spin", spin)], complaints);
                grains.extend(position.iter().enumerate().map(|(index, position)| Grain {
                    group: name,
                    index,
                    line: None,
                    diameter: group.shape.sure(group.diameter),
                    position: *position,
                    held,
                }));
            }
            Start::File { path, kind, grains: table, .. } => {
                let read = parts.files.known_grains(path, How { space: parts.space(), kind: *kind });
                let lines = read.map(|read| read.lines.as_slice()).unwrap_or_default();
                grains.extend(table.position.iter().zip(lines).enumerate().map(|(index, (position, line))| Grain {
                    group: name,
                    index,
                    line: Some(*line),
                    diameter: group.shape.sure(table.diameter.get(index).copied().unwrap_or(group.diameter)),
                    position: *position,
                    held,
                }));
            }
            _ => {}
        }
    }
    outside(parts, &grains, rooms, complaints);
    overlaps(parts, &grains, complaints);
}

fn lengths(
    parts: &Parts<'_>,
    name: &str,
    position: &[Vector],
    lists: [(&str, &Vec<Vector>); 2],
    complaints: &mut Vec<Complaint>,
) {
    for (key, list) in lists {
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
}

/// The boxes of the scene.
pub(super) fn rooms<'a>(parts: &'a Parts<'_>) -> Vec<Room<'a>> {
    parts.walls.iter().filter_map(|(name, wall)| room(parts, name, wall)).collect()
}

fn room<'a>(parts: &Parts<'_>, name: &'a str, wall: &Wall) -> Option<Room<'a>> {
    let Shape::Box { width, height, depth, mut floor_centre } = wall.shape else { return None };
    let (direction, displacement) = if let Some(motion) = &wall.motion {
        (motion.direction, signal_at_start(&motion.signal))
    } else if let Some(host) = wall.host.as_ref().and_then(|host| parts.hosts.get(host)) {
        match wall.interface.as_ref().and_then(|interface| host.interface.get(interface)) {
            Some(interface) => {
                let sum = |axis: usize| interface.translation.iter().map(|t| t[axis] * host.displacement).sum();
                ([0, 1, 2].map(sum), 1.0)
            }
            None => (host.direction, host_at_start(host)),
        }
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
        Signal::Sines { amplitude, phase, offset, .. } => {
            offset + amplitude.iter().zip(phase).map(|(amplitude, phase)| amplitude * phase.sin()).sum::<f64>()
        }
        Signal::SineSweep { .. } | Signal::Impact { .. } | Signal::Shock { .. } | Signal::Steady { .. } => 0.0,
    }
}

fn host_at_start(host: &Host) -> f64 {
    match &host.structure {
        Structure::Oscillator { .. } | Structure::Matrices { .. } => host.displacement,
        Structure::Pendulum { .. } => 0.0,
        Structure::Shaker {} => host.base.as_ref().map_or(0.0, signal_at_start),
        Structure::Modes { mode } => mode.iter().map(|mode| mode.shape * host.displacement).sum(),
    }
}

fn outside(parts: &Parts<'_>, grains: &[Grain<'_>], rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    let mut found = 0;
    for grain in grains {
        let mut complain = |title: String, label: String, hint: Option<&str>| {
            found += 1;
            if found <= MOST_COMPLAINTS {
                let complaint = Complaint::new(format!("grain {} of `{}` {title}", grain.index, grain.group))
                    .at(&grain.place(parts), grain.label(label));
                complaints.push(complaint.hints(hint.map(str::to_string)));
            }
        };
        if let Some((axis, beyond)) = beyond_the_world(parts, grain) {
            let label = format!("{} beyond the end", millimetres(beyond));
            let hint =
                "grains begin within the ends of [periodic]; later they leave at one end and come in at the other";
            complain(format!("begins outside the periodic world along {axis}"), label, Some(hint));
        }
        // Held grains may be anywhere: glued to a floor, built into a wall.
        if grain.held {
            continue;
        }
        for room in rooms {
            if let Some((side, depth)) = through_a_side(grain, room, parts.space()) {
                let label = format!("reaches {} through the {side}", millimetres(depth));
                let hint = "positions are centres; x runs to the right, z up";
                complain(format!("begins outside the box `{}`", room.name), label, Some(hint));
            }
        }
        for (name, wall) in &parts.walls {
            // A moved wall is wherever its motion says; only still ones can be judged here.
            if wall.motion.is_some() || wall.host.is_some() || wall.rotation.is_some() {
                continue;
            }
            if let Shape::Plane { point, normal } = wall.shape {
                let distance: f64 = (0..3).map(|i| (grain.position[i] - point[i]) * normal[i]).sum();
                let depth = grain.diameter / 2.0 - distance;
                if depth > grain.slack() * grain.diameter {
                    let label = format!("reaches {} into it", millimetres(depth));
                    complain(format!("begins behind the plane `{name}`"), label, None);
                }
            } else if let Some(distance) = shell::distance(&wall.shape, grain.position) {
                let depth = grain.diameter / 2.0 - distance;
                if depth > grain.slack() * grain.diameter {
                    let label = format!("reaches {} through it", millimetres(depth));
                    let hint = "the wall is a thin shell: grains may be inside or outside";
                    complain(format!("begins in the wall `{name}`"), label, Some(hint));
                }
            }
        }
    }
}

fn through_a_side(grain: &Grain<'_>, room: &Room<'_>, space: bool) -> Option<(&'static str, f64)> {
    axes(space).iter().find_map(|&(axis, low_side, high_side)| {
        let [low, high] = room.ends(axis);
        let (low, high) = (low + grain.diameter / 2.0, high - grain.diameter / 2.0);
        let slack = grain.slack() * grain.diameter;
        let x = grain.position[axis];
        if x < low - slack {
            Some((low_side, low - x))
        } else if x > high + slack {
            Some((high_side, x - high))
        } else {
            None
        }
    })
}

fn beyond_the_world(parts: &Parts<'_>, grain: &Grain<'_>) -> Option<(&'static str, f64)> {
    let ends = [("x", parts.periodic.x), ("y", parts.periodic.y), ("z", parts.periodic.z)];
    ends.into_iter().zip(grain.position).find_map(|((axis, ends), x)| {
        let [low, high] = ends?;
        let beyond = (low - x).max(x - high);
        (beyond > 0.0).then_some((axis, beyond))
    })
}

fn overlaps(parts: &Parts<'_>, grains: &[Grain<'_>], complaints: &mut Vec<Complaint>) {
    let mut found = 0;
    overlap::pairs(grains, &parts.periodic, &mut |a, b, distance| {
        let [first, second] = [&grains[a.min(b)], &grains[a.max(b)]];
        let reach = 0.5 * (first.diameter + second.diameter);
        let overlap = (reach - distance) / reach;
        let allowed = first.slack().max(second.slack());
        if overlap <= allowed {
            return true;
        }
        found += 1;
        let label = format!("{} between the centres, the diameter is {}", millimetres(distance), millimetres(reach));
        let mut complaint =
            Complaint::new(format!("{} overlap at the start by {overlap:.3} diameters", both(first, second)))
                .at(&second.place(parts), second.label(label));
        if first.place(parts) != second.place(parts) {
            complaint = complaint.also(&first.place(parts), first.label("the other grain".to_string()));
        }
        complaints.push(complaint.hint(format!("move one of them; up to {allowed} diameters would be let through")));
        found < MOST_COMPLAINTS
    });
}

fn both(first: &Grain<'_>, second: &Grain<'_>) -> String {
    if first.group == second.group {
        format!("grains {} and {} of `{}`", first.index, second.index, first.group)
    } else {
        format!("grains {} of `{}` and {} of `{}`", first.index, first.group, second.index, second.group)
    }
}

pub(super) fn millimetres(length: f64) -> String {
    let rounded: f64 = format!("{:.3e}", length * 1e3).parse().unwrap_or(length * 1e3);
    format!("{rounded} mm")
}
