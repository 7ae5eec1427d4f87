//! What water sees of a grain.

use crate::state::sphere;
use tsubu_scene::plan::GrainShape;

/// A grain as water sees it: of any shape, the sphere of its volume, and how far it is from being one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Submerged {
    /// Radius of the sphere of its volume [m].
    pub radius: f64,
    /// Surface of that sphere over its own [-]; 1 of a sphere.
    pub sphericity: f64,
}

impl Submerged {
    /// A sphere of this radius [m].
    pub fn sphere(radius: f64) -> Self {
        Self { radius, sphericity: 1.0 }
    }

    /// A grain of that shape and diameter [m].
    pub fn of(shape: &GrainShape, diameter: f64) -> Self {
        shape.clump().map_or(Self::sphere(0.5 * diameter), |body| Self {
            radius: 0.5 * shape.nominal_diameter(diameter),
            sphericity: body.sphericity(),
        })
    }

    /// Its volume [m^3].
    pub fn volume(&self) -> f64 {
        sphere::volume(self.radius)
    }
}
