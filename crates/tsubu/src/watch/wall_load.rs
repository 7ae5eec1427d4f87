//! Force and torque on a wall.

use super::{Axes, LETTERS, Sample, Watch, axes};
use crate::about::About;
use crate::view::{View, WallLoad, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.wall-load",
    formula: "\
What the grains do to a wall, from the forces of the last step.
force x, z        sum of the contact forces on it                                           [N]
torque y          their torque; in space all three entries                                  [N.m]
force x, z        with `face`: on that face of a box alone, and no torque                   [N]
pressure          force along `direction` over `area`, if these are given                   [Pa]
The torque is about the origin of the wall's pose: the centre of mass of a free body, the centre of rotation of a turning
wall, else the origin of the scene moved along with the wall.",
    symbols: "",
    limits: "The pressure is a mean over the area that is given, whatever part of it grains touch; a direction stays as \
it is when the wall turns. Momentary values of stiff contacts are rough: take means.",
    reference: "by definition",
};

/// Reads a wall's load.
#[derive(Clone, Debug)]
pub(super) struct Load {
    /// Number of the wall.
    wall: usize,
    /// Inward normal of the only face of a box that counts.
    face: Option<DVec3>,
    /// Area and direction of the pressure.
    pressed: Option<(f64, DVec3)>,
    axes: Axes,
}

pub(super) fn open(asked: &watch::WallLoad, plan: &Plan) -> Load {
    let watch::WallLoad { wall, face, area, direction } = asked;
    Load {
        face: face.map(|face| DVec3::from_array(face.normal())),
        wall: plan.walls.keys().position(|name| name == wall).unwrap_or(0),
        pressed: area.zip(*direction).map(|(area, along)| (area, DVec3::from_array(along))),
        axes: axes(plan),
    }
}

/// Names of the forces and torques on a wall.
pub(super) fn names(axes: Axes) -> Vec<String> {
    let turns: Axes = if axes.len() == 3 { axes } else { &[1] };
    let forces = axes.iter().map(|&a| format!("force {} [N]", LETTERS[a]));
    forces.chain(turns.iter().map(|&a| format!("torque {} [N.m]", LETTERS[a]))).collect()
}

/// Their values.
pub(super) fn values(load: &WallLoad, axes: Axes) -> Vec<f64> {
    let turns: Axes = if axes.len() == 3 { axes } else { &[1] };
    axes.iter().map(|&a| load.force[a]).chain(turns.iter().map(|&a| load.torque[a])).collect()
}

/// Force of the grains on the face of a box with an inward normal: of the contacts whose normals point at it.
fn on_face(view: &View, wall: usize, inward: DVec3) -> DVec3 {
    let on = view.contacts.iter().filter(|c| c.wall && c.second == wall && c.normal.dot(inward) < -0.5);
    -on.map(|c| c.force).sum::<DVec3>()
}

impl Watch for Load {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        if self.face.is_some() { Wants::CONTACTS } else { Wants::WALLS }
    }

    fn scalars(&self) -> Vec<String> {
        let mut names = names(self.axes);
        if self.face.is_some() {
            names.truncate(self.axes.len());
        }
        names.extend(self.pressed.map(|_| "pressure [Pa]".to_owned()));
        names
    }

    fn take(&mut self, view: &View) -> Sample {
        let load = match self.face {
            Some(inward) => WallLoad { force: on_face(view, self.wall, inward), ..WallLoad::default() },
            None => view.walls.get(self.wall).copied().unwrap_or_default(),
        };
        let mut scalars = values(&load, self.axes);
        if self.face.is_some() {
            scalars.truncate(self.axes.len());
        }
        scalars.extend(self.pressed.map(|(area, direction)| load.force.dot(direction) / area));
        Sample { scalars, rows: Vec::new() }
    }
}
