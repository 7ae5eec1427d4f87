//! The box of a scene for the automaton: what wall it is, who moves it, and how many cells it has.

use super::BallKind;
use crate::lattice::damper::BoxPlace;
use crate::lattice::grid::COLUMN_SPACING;
use crate::lattice::remarks::Remarks;
use std::collections::BTreeMap;
use tsubu_scene::plan::{self, Plan, Shape, Signal};

/// The box of the scene.
pub(super) struct Casing<'a> {
    pub(super) name: &'a str,
    pub(super) material: &'a str,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) floor_centre: plan::Vector,
    pub(super) host: Option<&'a str>,
    pub(super) motion: Option<&'a plan::Motion>,
}

/// The one wall, a box.
pub(super) fn casing<'a>(plan: &'a Plan, remarks: &mut Remarks) -> Option<Casing<'a>> {
    if plan.walls.len() != 1 {
        let names = plan.walls.keys().cloned().collect::<Vec<_>>().join(", ");
        remarks.refuse(
            "walls",
            format!(
                "the automaton needs exactly one wall, of shape `box`; there are {} ({names}); use `method = \"dem\"` for other walls",
                plan.walls.len()
            ),
        );
        return None;
    }
    let (name, wall) = plan.walls.iter().next()?;
    let plan::Wall { material, shape, host, interface, motion, rotation, servo, body, until } = wall;
    if until.is_some() {
        remarks.refuse(
            format!("walls.{name}.until"),
            "the automaton's balls live in a closed box; use `method = \"dem\"`",
        );
    }
    let swings = host.as_ref().and_then(|host| plan.hosts.get(host)).is_some_and(plan::Host::turns);
    for (key, there) in [
        ("host", swings),
        ("interface", interface.is_some()),
        ("rotation", rotation.is_some()),
        ("servo", servo.is_some()),
        ("body", body.is_some()),
    ] {
        if there {
            remarks.refuse(
                format!("walls.{name}.{key}"),
                "the automaton's box is moved up and down by `motion` or along the direction of a host; use `method = \"dem\"`",
            );
        }
    }
    match shape {
        Shape::Box { width, height, depth: _, floor_centre } => Some(Casing {
            name,
            material,
            width: *width,
            height: *height,
            floor_centre: *floor_centre,
            host: host.as_deref(),
            motion: motion.as_ref(),
        }),
        other => {
            let kind = match other {
                Shape::Plane { .. } => "plane",
                Shape::Cylinder { .. } => "cylinder",
                Shape::Cone { .. } => "cone",
                Shape::Sphere { .. } => "sphere",
                Shape::Box { .. } | Shape::Mesh { .. } => "mesh",
            };
            remarks.refuse(
                format!("walls.{name}.shape.{kind}"),
                "the automaton's balls live in a closed box; use `shape.box`, or `method = \"dem\"`",
            );
            None
        }
    }
}

/// Whoever moves the box must move it up and down.
pub(super) fn check_carrier(
    casing: &Casing,
    kind: &BallKind,
    hosts: &BTreeMap<String, plan::Host>,
    lattice: &plan::Lattice,
    remarks: &mut Remarks,
) {
    let vertical = |d: &plan::Vector| d[0] == 0.0 && d[1] == 0.0 && d[2].abs() == 1.0;
    let name = casing.name;
    if let Some(host_name) = casing.host
        && let Some(host) = hosts.get(host_name)
    {
        if !vertical(&host.direction) {
            remarks.refuse(
                format!("hosts.{host_name}.direction"),
                "the automaton's box moves up and down only; set it to [0, 1] or [0, -1], or use `method = \"dem\"`",
            );
        }
        let effective = crate::partner::Host::new(host).effective_mass();
        let balls = kind.count as f64 * kind.mass;
        if lattice.resting_impulses && balls >= effective {
            remarks.refuse(
                "lattice.resting-impulses",
                format!(
                    "the balls ({balls} kg) are not lighter than the structure ({effective} kg): passing their inertia one step late is unstable; use fewer balls, or `method = \"dem\"`"
                ),
            );
        }
    }
    let travels = |signal: &Signal| match signal {
        Signal::Steady { .. } => Some("steady"),
        Signal::Shock { .. } => Some("shock"),
        _ => None,
    };
    if let Some(kind) = casing.motion.and_then(|motion| travels(&motion.signal)) {
        remarks.refuse(
            format!("walls.{name}.motion.signal.{kind}"),
            "the automaton's box cannot travel for ever; use `signal.table`, or `method = \"dem\"`",
        );
    }
    if casing.motion.is_some_and(|m| !vertical(&m.direction)) {
        remarks.refuse(
            format!("walls.{name}.motion.direction"),
            "the automaton's box moves up and down only; set it to [0, 1] or [0, -1], or use `method = \"dem\"`",
        );
    }
}

/// Whole columns and rows for the box, and room for it to move.
pub(super) fn place(
    casing: &Casing,
    kind: &BallKind,
    spacing: f64,
    lattice: &plan::Lattice,
    remarks: &mut Remarks,
) -> BoxPlace {
    // Where a ball has one cell, as many balls are side by side as in the box.
    let single = lattice.ball_radius == 0;
    let column = if single { spacing } else { COLUMN_SPACING * spacing };
    let columns = (casing.width / column).round() as usize;
    let rows = (casing.height / spacing).round() as usize;
    let key = format!("walls.{}.shape.box", casing.name);
    if columns.min(rows) <= 2 * lattice.ball_radius {
        remarks.refuse(&key, format!("it is smaller than one ball of {:.4} mm", 1e3 * kind.diameter));
    }
    let width = columns as f64 * COLUMN_SPACING * spacing;
    if single || (width - casing.width).abs() > 1e-9 * spacing {
        remarks.approximate(
            format!("{key}.width"),
            format!(
                "{columns} columns of the lattice: {:.1} mm instead of {:.1} mm{}",
                1e3 * width,
                1e3 * casing.width,
                if single { " (the number of columns counts)" } else { "" },
            ),
        );
    }
    let height = rows as f64 * spacing;
    if (height - casing.height).abs() > 1e-9 * spacing {
        remarks.approximate(
            format!("{key}.height"),
            format!("{rows} rows of the lattice: {:.1} mm instead of {:.1} mm", 1e3 * height, 1e3 * casing.height),
        );
    }
    // A box that travels for ever is refused where it is looked at: no room is enough.
    let travel = casing.motion.map(|m| crate::check::peak(&m.signal)).filter(|far| far.is_finite()).unwrap_or(0.0);
    BoxPlace { columns, rows, head: lattice.head_room + (travel / spacing).ceil() as usize, level: 0 }
}
