//! Moving walls: a moved mesh is a moved point of view, and velocities are derivatives of places.

use super::{Dice, block, contacts, mesh, plan_wall, still};
use glam::{DQuat, DVec3};
use tsubu::partner::Hosts;
use tsubu::wall::Wall;
use tsubu_scene::plan::{Motion, Rotation, Shape, Signal};

/// A block that swings along a direction and turns about an axis which is carried along.
fn moving(shape: Shape) -> Wall {
    let mut plan = plan_wall(shape);
    let signal = Signal::Sine { amplitude: 0.3, frequency: 1.5, phase: 0.4 };
    plan.motion = Some(Motion { direction: [0.0, 0.6, 0.8], signal });
    let axis = DVec3::new(1.0, -2.0, 0.5).normalize().to_array();
    plan.rotation = Some(Rotation { centre: [0.4, 0.1, -0.2], axis, signal: Signal::Steady { rate: 3.0 } });
    super::wall(&plan)
}

fn hollow() -> Vec<[DVec3; 3]> {
    // A block with a bite: convex and concave edges.
    let mut all = block(DVec3::ZERO, DVec3::ONE);
    all.extend(block(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.8, 0.8, 1.5)));
    all
}

#[test]
fn moving_the_mesh_is_moving_the_point_of_view() {
    let still = still(mesh(&hollow()));
    let mut moved = moving(mesh(&hollow()));
    moved.follow(0.37, &Hosts::default());
    let pose = moved.pose;
    let mut dice = Dice::new(21);
    for _ in 0..2000 {
        let own = DVec3::splat(0.5) + dice.vector(1.2);
        let ours = contacts(&moved, pose.to_world(own), 0.25);
        let theirs = contacts(&still, own, 0.25);
        assert_eq!(ours.len(), theirs.len(), "{own}");
        for (a, b) in ours.iter().zip(&theirs) {
            assert_eq!(moved.key(a.element), still.key(b.element));
            assert!((a.nearest.distance - b.nearest.distance).abs() < 1e-14);
            assert!((a.nearest.normal - pose.rotation * b.nearest.normal).length() < 1e-11);
            assert!(a.nearest.point.distance(pose.to_world(b.nearest.point)) < 1e-14);
        }
    }
}

/// The velocity of a material point is the derivative of its place; with the spin turned round it is not.
#[test]
fn velocity_is_the_derivative_of_the_place() {
    let hosts = Hosts::default();
    let mut wall = moving(mesh(&hollow()));
    let point = DVec3::new(0.7, -0.3, 0.9);
    for time in [0.1, 0.5, 2.3] {
        let h = 1e-6;
        let mut place = |t: f64| {
            wall.follow(t, &hosts);
            wall.pose.to_world(point)
        };
        let derivative = (place(time + h) - place(time - h)) / (2.0 * h);
        let here = place(time);
        assert!(wall.velocity_at(here).distance(derivative) < 1e-8);
        let mut wrong = wall.pose;
        wrong.spin = -wrong.spin;
        assert!(wrong.velocity_at(here).distance(derivative) > 1.0);
        assert!(wall.pose.to_own(here).distance(point) < 1e-15 * 8.0);
    }
}

/// A wall that never turns gives planes the bits of a bare displacement.
#[test]
fn shifted_plane_keeps_its_bits() {
    let mut plan = plan_wall(Shape::Plane { point: [0.1, 0.2, 0.3], normal: [0.0, 0.6, 0.8] });
    let signal = Signal::Sine { amplitude: 0.024, frequency: 6.0, phase: 0.0 };
    plan.motion = Some(Motion { direction: [0.0, 0.0, 1.0], signal });
    let mut wall = super::wall(&plan);
    wall.follow(0.013, &Hosts::default());
    let p = DVec3::new(0.7, 0.8, 0.9);
    let bare = (p - wall.pose.offset - DVec3::new(0.1, 0.2, 0.3)).dot(DVec3::new(0.0, 0.6, 0.8));
    assert_eq!(wall.nearest(0, p).distance.to_bits(), bare.to_bits());
}

/// Places written into a checkpoint come back bit by bit.
#[test]
fn pose_as_numbers() {
    let mut wall = moving(mesh(&hollow()));
    wall.follow(0.61, &Hosts::default());
    let mut pose = wall.pose;
    let place = pose.place();
    (pose.offset, pose.rotation) = (DVec3::ZERO, DQuat::IDENTITY);
    pose.set_place(place);
    assert_eq!(pose, wall.pose);
}

/// What is drawn is what is touched: corners of outlines lie on the surface, wherever the wall has gone.
#[test]
fn outlines_lie_on_the_surface() {
    let axis = [0.0, 0.6, 0.8];
    let shapes = [
        Shape::Box { width: 2.0, height: 1.5, depth: 1.0, floor_centre: [0.1, 0.0, -0.7] },
        Shape::Cylinder { point: [0.3, 0.0, 0.2], axis, radius: 0.4, length: Some(1.3) },
        Shape::Cylinder { point: [0.3, 0.0, 0.2], axis, radius: 0.4, length: None },
        Shape::Cone { point: [0.3, 0.0, 0.2], axis, radius: 0.4, end_radius: 0.0, length: 0.8 },
        Shape::Sphere { centre: [0.2, 0.2, 0.2], radius: 0.6 },
        mesh(&hollow()),
    ];
    for shape in shapes {
        let mut wall = moving(shape);
        wall.follow(0.37, &Hosts::default());
        let outline = wall.outline();
        let corners: Vec<DVec3> =
            outline.lines.iter().flatten().chain(outline.triangles.iter().flatten()).copied().collect();
        assert!(corners.len() >= 4);
        for corner in corners {
            let distances = (0..wall.elements() as u32).map(|e| wall.nearest(e, corner).distance.abs());
            assert!(distances.fold(f64::INFINITY, f64::min) < 1e-12);
        }
    }
}
