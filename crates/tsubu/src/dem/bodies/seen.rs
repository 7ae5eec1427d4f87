//! How far bodies reach that are one piece and no spheres, for those who look on.

use super::Bodies;
use crate::state::sphere;
use crate::view::Shapes;
use glam::DVec3;

impl Shapes for Bodies {
    fn ends(&self, grain: usize, axis: usize) -> Option<[f64; 2]> {
        let along = DVec3::AXES[axis];
        if let Some(body) = self.polyhedron(grain) {
            return Some(body.ends(along));
        }
        let reach = self.outline(grain)?.support(along).point.dot(along);
        Some([-reach, reach])
    }

    /// Of a superellipsoid as of an ellipsoid that reaches as far.
    fn below(&self, grain: usize, axis: usize, height: f64) -> f64 {
        match (self.polyhedron(grain), self.ends(grain, axis)) {
            (Some(body), _) => body.below(DVec3::AXES[axis], height),
            (None, Some([_, reach])) => sphere::below(height / reach),
            (None, None) => f64::NAN,
        }
    }
}
