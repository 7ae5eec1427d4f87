//! Faces of a box of planes that a pressure pushes: each is as large as the planes around it leave it.

use super::{Mover, Surface, Wall};
use glam::DVec3;
use tsubu_scene::Plan;
use tsubu_scene::plan::box_of_planes;

/// The box that planes along the axes make in space: the numbers of the walls at the ends of each axis.
#[derive(Clone, Debug, Default)]
pub struct Faces(Vec<(usize, [usize; 2])>);

impl Faces {
    /// Those of a plan; none where no servo asks for them.
    pub fn new(plan: &Plan) -> Self {
        let asked = plan.walls.values().any(|wall| wall.servo.as_ref().is_some_and(|servo| servo.pressure.is_some()));
        let planes = asked.then(|| box_of_planes(&plan.walls, plan.dimension == 3));
        Self(planes.flatten().unwrap_or_default())
    }

    /// Tells servos how large their faces are now.
    pub fn measure(&self, walls: &mut [Wall]) {
        let mut size = DVec3::ONE;
        for (axis, [low, high]) in &self.0 {
            size[*axis] = height(&walls[*high], *axis) - height(&walls[*low], *axis);
        }
        let volume = size.element_product();
        for (axis, ends) in &self.0 {
            for end in ends {
                if let Mover::Servo(servo) = &mut walls[*end].mover {
                    servo.cover(volume / size[*axis]);
                }
            }
        }
    }
}

/// Where a plane cuts the axis that it is at right angles to [m].
fn height(wall: &Wall, axis: usize) -> f64 {
    match &wall.surface {
        Surface::HalfSpaces { planes, .. } => wall.pose.to_world(planes[0].point)[axis],
        _ => 0.0,
    }
}
