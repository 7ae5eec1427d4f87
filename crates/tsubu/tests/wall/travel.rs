//! The bound on how far a wall has moved is one, and not a lazy one.

use super::{Dice, block, mesh, plan_wall};
use glam::{DQuat, DVec3};
use tsubu::partner::Hosts;
use tsubu::wall::{Pose, Wall};
use tsubu_scene::plan::{Rotation, Shape, Signal};

fn shapes() -> Vec<Shape> {
    let axis = DVec3::new(0.3, 0.5, -0.8).normalize().to_array();
    vec![
        Shape::Plane { point: [0.1, 0.2, 0.3], normal: axis },
        Shape::Box { width: 2.0, height: 1.5, depth: 1.0, floor_centre: [0.1, 0.0, -0.7] },
        Shape::Cylinder { point: [0.3, 0.0, 0.2], axis, radius: 0.4, length: None },
        Shape::Cylinder { point: [0.3, 0.0, 0.2], axis, radius: 0.4, length: Some(1.3) },
        Shape::Cone { point: [0.3, 0.0, 0.2], axis, radius: 0.4, end_radius: 0.0, length: 0.8 },
        Shape::Sphere { centre: [0.2, 0.2, 0.2], radius: 0.6 },
        mesh(&block(DVec3::ZERO, DVec3::ONE)),
    ]
}

fn turning(shape: Shape, axis: DVec3) -> Wall {
    let mut plan = plan_wall(shape);
    let signal = Signal::Steady { rate: 1.0 };
    plan.rotation = Some(Rotation { centre: [0.5, -0.2, 0.1], axis: axis.to_array(), signal });
    super::wall(&plan)
}

fn shifted(pose: Pose, dice: &mut Dice, size: f64) -> Pose {
    let rotation = DQuat::from_axis_angle(dice.direction(), dice.between(0.0, size)) * pose.rotation;
    Pose { offset: pose.offset + dice.vector(size), rotation, ..pose }
}

/// No distance of a point near the wall changes by more than the bound, and often by a good part of it.
#[test]
fn no_distance_changes_by_more() {
    let mut dice = Dice::new(31);
    for (k, shape) in shapes().into_iter().enumerate() {
        let mut wall = turning(shape, DVec3::Y);
        let mut fullest = 0.0f64;
        for _ in 0..300 {
            let reference = shifted(Pose::at_rest(wall.pose.centre), &mut dice, 1.0);
            let now = shifted(reference, &mut dice, 0.02);
            let points: Vec<DVec3> = (0..40).map(|_| reference.to_world(dice.vector(0.5))).collect();
            let extent = points.iter().map(|p| p.distance(reference.origin())).fold(0.0, f64::max);
            let elements = if matches!(k, 2..5) { 1 } else { wall.elements() as u32 };
            let distances = |wall: &Wall| -> Vec<f64> {
                points.iter().flat_map(|p| (0..elements).map(|e| wall.nearest(e, *p).distance)).collect()
            };
            wall.pose = reference;
            let before = distances(&wall);
            wall.pose = now;
            let after = distances(&wall);
            let bound = wall.travel_bound(&reference, extent);
            let change = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(change <= bound * (1.0 + 1e-12), "shape {k}: {change} {bound}");
            fullest = fullest.max(change / bound);
        }
        assert!(fullest > 0.5, "shape {k}: the bound is too wide: {fullest}");
    }
}

/// A drum that turns about its axis, and a plane that glides along itself, have not moved.
#[test]
fn gliding_is_not_moving() {
    let hosts = Hosts::default();
    let axis = DVec3::Y;
    let mut drum = turning(
        Shape::Cylinder { point: [0.5, -1.0, 0.1], axis: axis.to_array(), radius: 0.4, length: Some(2.0) },
        axis,
    );
    let reference = drum.pose;
    drum.follow(1000.3, &hosts);
    assert!(drum.travel_bound(&reference, f64::INFINITY) < 1e-12);
    let mut floor = super::still(Shape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    let reference = floor.pose;
    floor.pose.offset = DVec3::new(3.0, 4.0, 0.0);
    assert_eq!(floor.travel_bound(&reference, f64::INFINITY), 0.0);
    floor.pose.offset.z = 0.25;
    assert_eq!(floor.travel_bound(&reference, f64::INFINITY), 0.25);
    floor.pose.rotation = DQuat::from_rotation_x(0.1);
    assert_eq!(floor.travel_bound(&reference, f64::INFINITY), f64::INFINITY);
}
