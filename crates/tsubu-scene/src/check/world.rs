//! The ends of the world: periodic axes, and regions where grains vanish.

use super::fill::has_size;
use super::place::millimetres;
use super::{Parts, named};
use crate::complaint::Complaint;
use crate::plan::{Removal, Shape};

/// Widths of the largest grain that a periodic world must have at least: with fewer a grain could touch another one and
/// its image at the same time, or itself.
const NARROWEST: f64 = 3.0;

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let largest = parts.particles.iter().map(|(name, group)| (group.largest_diameter(), name));
    let largest = largest.max_by(|a, b| a.0.total_cmp(&b.0));
    let ends = [("x", parts.periodic.x), ("y", parts.periodic.y), ("z", parts.periodic.z)];
    for (axis, [low, high]) in ends.into_iter().filter_map(|(axis, ends)| Some((axis, ends?))) {
        let place = parts.root.locate(&["periodic", axis]);
        if axis == "y" && !parts.space() {
            complaints.push(
                Complaint::new("the plane has no y to be periodic along")
                    .at(&place, "the scene has dimension 2")
                    .hint("leave it out, or set dimension = 3"),
            );
            continue;
        }
        if let Some((diameter, name)) = largest.filter(|(diameter, _)| high - low < NARROWEST * diameter) {
            complaints.push(
                Complaint::new(format!(
                    "the periodic world is too narrow along {axis}: grains would meet their images"
                ))
                .at(&place, format!("{} long", millimetres(high - low)))
                .also(&parts.root.locate(&["particles", name]), format!("grains up to {} wide", millimetres(diameter)))
                .hint(format!("make it at least {NARROWEST} diameters long")),
            );
        }
        if let Some((name, _)) = parts.walls.iter().find(|(_, wall)| matches!(wall.shape, Shape::Box { .. })) {
            complaints.push(
                Complaint::new(format!("the box `{name}` closes a world that is periodic along {axis}"))
                    .at(&parts.root.locate(&["walls", name, "shape"]), "has walls on all sides")
                    .also(&place, "periodic here")
                    .hint("use planes where the world ends, for example shape.plane = { normal = \"z\" } as a floor"),
            );
        }
    }
    removal(parts, complaints);
}

fn removal(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (name, removal) in named::<Removal>(parts.resolved, "removal") {
        if let Removal::Inside { region } = removal {
            has_size(parts, &region, &["removal", &name, "inside", "region"], complaints);
        }
    }
}
