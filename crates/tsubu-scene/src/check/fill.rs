//! Grains that fill a box or a region: whether there is one, and whether it holds them.

use super::Parts;
use super::place::{Room, axes, millimetres};
use crate::complaint::{Complaint, Place};
use crate::plan::{Particles, Region, Shape, Start, Vector};

/// Share of the plane or of space that equal grains thrown together can fill, and a little more.
const DENSEST: [f64; 2] = [0.85, 0.64];
/// The same where each stays at the random place that it found (random sequential addition; Zhang and Torquato 2013).
const JAMMED: [f64; 2] = [0.547, 0.384];

/// Regions: sizes, and whether they hold their grains and lie in the world.
pub(super) fn regions(parts: &Parts<'_>, rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    for (name, group) in &parts.particles {
        let (variant, region) = match &group.start {
            Start::Rows { region: Some(region), .. } => ("rows", region),
            Start::Random { region: Some(region), .. } => ("random", region),
            Start::Stream { region, .. } => ("stream", region),
            _ => continue,
        };
        let path = ["particles", name.as_str(), "start", variant, "region"];
        if !has_size(parts, region, &path, complaints) {
            continue;
        }
        let place = parts.root.locate(&path);
        let size = [0, 1, 2].map(|axis| region.high[axis] - region.low[axis]);
        if let Some(complaint) = reaches_out(parts, rooms, region, name, &place) {
            complaints.push(complaint);
        } else if let Some(complaint) = too_many(parts, name, group, size, &place) {
            complaints.push(complaint);
        }
    }
}

/// Whether the region is larger than nothing along every axis that counts.
pub(super) fn has_size(parts: &Parts<'_>, region: &Region, path: &[&str], complaints: &mut Vec<Complaint>) -> bool {
    let flat = axes(parts.space()).iter().find(|(axis, ..)| region.low[*axis] >= region.high[*axis]);
    if let Some((axis, ..)) = flat {
        let [low, high] = [region.low[*axis], region.high[*axis]].map(millimetres);
        complaints.push(
            Complaint::new(format!("the region has no size along {}", ["x", "y", "z"][*axis]))
                .at(&parts.root.locate(&[path, &["high"]].concat()), format!("{high}, but `low` is {low}"))
                .hint("`low` is the corner with the smallest coordinates, `high` the one with the largest"),
        );
    }
    flat.is_none()
}

/// A region that cuts a wall puts grains into it. One wholly outside a box may be meant so.
fn reaches_out(parts: &Parts<'_>, rooms: &[Room<'_>], region: &Region, name: &str, place: &Place) -> Option<Complaint> {
    let ends = [parts.periodic.x, parts.periodic.y, parts.periodic.z];
    let beyond = axes(parts.space())
        .iter()
        .find(|(axis, ..)| ends[*axis].is_some_and(|[low, high]| region.low[*axis] < low || region.high[*axis] > high));
    if let Some((axis, ..)) = beyond {
        let axis = ["x", "y", "z"][*axis];
        return Some(
            Complaint::new(format!("the region of `{name}` reaches beyond the periodic world along {axis}"))
                .at(place, format!("must lie within the ends of periodic.{axis}")),
        );
    }
    for (wall_name, wall) in &parts.walls {
        // A moved plane is wherever its motion says; only still ones can be judged here.
        let still = wall.motion.is_none() && wall.host.is_none() && wall.rotation.is_none();
        let (true, Shape::Plane { point, normal }) = (still, &wall.shape) else { continue };
        let deepest = [0, 1, 2].map(|i| if normal[i] > 0.0 { region.low[i] } else { region.high[i] });
        let depth: f64 = (0..3).map(|i| (point[i] - deepest[i]) * normal[i]).sum();
        let size: f64 = (0..3).map(|i| (region.high[i] - region.low[i]) * normal[i].abs()).sum();
        if depth > 1e-9 * size {
            return Some(
                Complaint::new(format!("the region of `{name}` reaches behind the plane `{wall_name}`"))
                    .at(place, format!("reaches {} into it", millimetres(depth)))
                    .also(&parts.root.locate(&["walls", wall_name, "shape"]), "the plane"),
            );
        }
    }
    for room in rooms {
        let meets = axes(parts.space()).iter().all(|(axis, ..)| {
            let [low, high] = room.ends(*axis);
            region.low[*axis] < high && region.high[*axis] > low
        });
        let through = axes(parts.space()).iter().find_map(|(axis, low_side, high_side)| {
            let [low, high] = room.ends(*axis);
            // The same wall typed in other units may differ in the last digit.
            let slack = 1e-9 * (high - low);
            if region.low[*axis] < low - slack {
                Some((*low_side, low - region.low[*axis]))
            } else if region.high[*axis] > high + slack {
                Some((*high_side, region.high[*axis] - high))
            } else {
                None
            }
        });
        if let (true, Some((side, depth))) = (meets, through) {
            return Some(
                Complaint::new(format!("the region of `{name}` reaches out of the box `{}`", room.name))
                    .at(place, format!("reaches {} through the {side}", millimetres(depth)))
                    .also(&parts.root.locate(&["walls", room.name, "shape", "box"]), "the box"),
            );
        }
    }
    None
}

fn too_many(parts: &Parts<'_>, name: &str, group: &Particles, size: Vector, place: &Place) -> Option<Complaint> {
    let at = |key: &str| parts.root.locate(&["particles", name, key]);
    let room = Room { name: "", size, floor_centre: [0.0; 3] };
    let fits = fits(group, &room, parts.space());
    if fits < 1.0 && group.count > 0 {
        let largest = group.largest_diameter();
        return Some(
            Complaint::new(format!("not one grain of `{name}` fits into its region"))
                .at(place, format!("{} the grains are up to {} wide", sides(size, parts.space()), millimetres(largest)))
                .hint("is a unit missing?"),
        );
    }
    // A stream goes on when there is room again.
    if matches!(group.start, Start::Stream { .. }) || group.count as f64 <= fits {
        return None;
    }
    Some(
        Complaint::new(format!("{} grains of `{name}` do not fit into their region", group.count))
            .at(&at("count"), format!("{fits} fit{}", placed(group, &room, parts.space())))
            .also(place, "the region")
            .hint("take fewer or smaller grains, or a larger region"),
    )
}

fn sides(size: Vector, space: bool) -> String {
    let [width, depth, height] = size.map(millimetres);
    let depth = if space { format!(", {depth} deep") } else { String::new() };
    format!("{width} wide, {height} high{depth};")
}

/// Grains that fill a box need one, and it must hold them.
pub(super) fn capacity(parts: &Parts<'_>, rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    let fills_a_box = |start: &Start| {
        matches!(start, Start::Settled { .. } | Start::Rows { region: None, .. } | Start::Random { region: None, .. })
    };
    let filling: Vec<(&String, &Particles)> =
        parts.particles.iter().filter(|(_, group)| group.count > 0 && fills_a_box(&group.start)).collect();
    let room = match (filling.as_slice(), rooms) {
        ([], _) => return,
        (_, [room]) => room,
        ([(name, group), ..], []) => {
            let region = match group.start {
                Start::Settled { .. } => None,
                _ => Some("or give a `region` in `start`".to_string()),
            };
            complaints.push(
                Complaint::new(format!("there is no box for the grains `{name}` to start in"))
                    .at(&parts.root.locate(&["particles", name, "start"]), "needs a wall with `shape.box`")
                    .hint("add [walls.box] with shape.box = { width = \"60 mm\", height = \"96 mm\" }")
                    .hints(region)
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
            .at(&at("diameter"), format!("{} wide", millimetres(group.largest_diameter())))
            .also(&box_place, format!("{width} wide, {height} high{depth}"))
            .hint("is a unit missing?");
    }
    let title = if group.count as f64 > fits {
        format!("{} grains of `{name}` do not fit into the box `{}`", group.count, room.name)
    } else {
        format!("the groups of grains together do not fit into the box `{}`", room.name)
    };
    Complaint::new(title)
        .at(&at("count"), format!("{fits} fit{}", placed(group, room, parts.space())))
        .also(&box_place, "the box")
        .hint("take fewer or smaller grains, or a larger box")
}

/// In which way so many fit.
fn placed(group: &Particles, room: &Room<'_>, space: bool) -> String {
    match group.start {
        Start::Rows { spacing, .. } if spacing > 1.0 => format!(" at a spacing of {spacing} diameters"),
        Start::Random { .. } => {
            let jammed = thrown(group, room, space, JAMMED).max(1.0);
            format!(" however close they lie, and about {jammed} at random places")
        }
        _ => String::new(),
    }
}

/// How many grains of the group fill the room: in rows of the widest, or thrown in as densely as can be.
fn fits(group: &Particles, room: &Room<'_>, space: bool) -> f64 {
    let spacing = match group.start {
        Start::Rows { spacing, .. } => spacing,
        _ => 1.0,
    };
    let diameter = group.largest_diameter();
    let along = |length: f64| {
        let gaps = (length - diameter) / (spacing * diameter);
        // 60 mm over 6 mm is ten, whatever the last bit says.
        ((gaps + 1e-9).floor() + 1.0).max(0.0)
    };
    let [width, depth, height] = room.size;
    let rows = along(width) * along(height) * if space { along(depth) } else { 1.0 };
    if !matches!(group.start, Start::Random { .. }) || rows == 0.0 {
        return rows;
    }
    thrown(group, room, space, DENSEST).max(rows)
}

/// How many of the group fill such a share of the plane or of space.
fn thrown(group: &Particles, room: &Room<'_>, space: bool, share: [f64; 2]) -> f64 {
    let [width, depth, height] = room.size;
    let (own, all) = if space {
        (std::f64::consts::PI / 6.0 * group.diameter.powi(3), width * height * depth)
    } else {
        (std::f64::consts::PI / 4.0 * group.diameter.powi(2), width * height)
    };
    (share[usize::from(space)] * all / own).floor()
}
