//! A spherical shell, touched from inside and outside.

use super::Pose;
use super::nearest::Nearest;
use crate::about::About;
use glam::DVec3;

pub(crate) const SPHERE: About = About {
    key: "walls.NAME.shape.sphere",
    formula: "d = r - | |x - centre| - radius |",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], centre [m], radius [m]",
    limits: "A shell, touched from both sides; at its very centre the normal is z.",
    reference: "by definition",
};

/// Centre and radius of a spherical shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalShell {
    /// Centre [m].
    pub centre: DVec3,
    /// Radius [m].
    pub radius: f64,
}

impl SphericalShell {
    /// The point of the shell in the direction of the grain.
    pub(super) fn nearest(&self, centre: DVec3) -> Nearest {
        let away = centre - self.centre;
        let length = away.length();
        // At the very centre every direction is as good; z lies in the plane of 2-D scenes.
        let outward = if length > 0.0 { away / length } else { DVec3::Z };
        Nearest::face(centre, outward, length - self.radius)
    }

    /// How far the shell has moved [m]; turning about its own centre moves nothing.
    pub(super) fn travel(&self, pose: &Pose, reference: &Pose) -> f64 {
        pose.to_world(self.centre).distance(reference.to_world(self.centre))
    }
}
