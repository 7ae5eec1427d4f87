//! Nearest points against minimisation of the distance over the surface.

use super::{Dice, assert_consistent, contacts, mesh, still, touches};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tsubu::partner::Hosts;
use tsubu::wall::{Feature, Wall};
use tsubu_scene::plan::Shape;

/// Once round: no place is a border.
const ROUND: [f64; 2] = [0.0, TAU];

/// Smallest value of a function with one valley: a coarse look, then the golden section.
fn lowest(f: impl Fn(f64) -> f64, [low, high]: [f64; 2]) -> f64 {
    const CELLS: usize = 40;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let at = |i: usize| low + (high - low) * i as f64 / CELLS as f64;
    let best = (0..=CELLS).min_by(|&i, &j| f(at(i)).total_cmp(&f(at(j)))).unwrap();
    let (mut a, mut b) = (at(best) - (high - low) / CELLS as f64, at(best + 1));
    if [low, high] != ROUND {
        (a, b) = (a.max(low), b.min(high));
    }
    for _ in 0..50 {
        let (c, d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
        if f(c) < f(d) { b = d } else { a = c }
    }
    f(at(best)).min(f(0.5 * (a + b)))
}

/// Smallest distance from a point to a surface given by two parameters in a rectangle.
fn smallest(surface: impl Fn(f64, f64) -> DVec3, range: [[f64; 2]; 2], centre: DVec3) -> f64 {
    lowest(|u| lowest(|v| surface(u, v).distance(centre), range[1]), range[0])
}

fn axes(axis: DVec3) -> (DVec3, DVec3) {
    axis.any_orthonormal_pair()
}

/// A surface of revolution: radius straight from r0 to r1 along the axis.
fn turned(point: DVec3, axis: DVec3, radii: [f64; 2], length: f64) -> impl Fn(f64, f64) -> DVec3 {
    let (u, v) = axes(axis);
    move |s, angle| {
        let r = radii[0] + (radii[1] - radii[0]) * s / length;
        point + axis * s + (u * angle.cos() + v * angle.sin()) * r
    }
}

#[test]
fn cylinder_and_cone_with_rims_and_tips() {
    let mut dice = Dice::new(1);
    let mut seen = [0; 4];
    for case in 0..300 {
        let axis = dice.direction();
        let point = dice.vector(1.0);
        let length = dice.between(0.2, 2.0);
        let radii = match case % 3 {
            0 => [0.5; 2],
            1 => [dice.between(0.1, 1.0), dice.between(0.1, 1.0)],
            _ => [dice.between(0.1, 1.0), 0.0],
        };
        let centre = point + dice.vector(2.0);
        let wall = if case % 3 == 0 {
            let length = Some(length);
            still(Shape::Cylinder { point: point.to_array(), axis: axis.to_array(), radius: radii[0], length })
        } else {
            let [radius, end_radius] = radii;
            let (point, axis) = (point.to_array(), axis.to_array());
            still(Shape::Cone { point, axis, radius, end_radius, length })
        };
        let near = wall.nearest(0, centre);
        let brute = smallest(turned(point, axis, radii, length), [[0.0, length], ROUND], centre);
        assert!((near.distance - brute).abs() < 1e-7, "case {case}: {near:?} {brute}");
        assert_consistent(&near, centre, 1e-12);
        // The gate would see a surface without ends: its distance is smaller wherever a rim or tip is nearest.
        match near.feature {
            Feature::Face => seen[0] += 1,
            Feature::Edge(k) => seen[1 + usize::from(k)] += 1,
            Feature::Corner(_) => seen[3] += 1,
        }
        if case % 3 == 0 && near.feature != Feature::Face {
            let across = (centre - point).reject_from(axis).length();
            assert!((across - radii[0]).abs() < brute - 1e-6, "an endless cylinder passes the gate");
        }
    }
    assert!(seen.iter().all(|&n| n > 5), "every feature is met: {seen:?}");
}

/// The far side is nearest among the points opposite to the grain, and only there if nothing is in between.
#[test]
fn far_side_of_a_funnel() {
    let shape = Shape::Cone { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 0.2, end_radius: 1.0, length: 1.0 };
    let wall = still(shape);
    let inside = DVec3::new(0.05, 0.0, 0.45);
    let far = wall.nearest(1, inside);
    let opposite = |s: f64| DVec3::new(-0.2 - 0.8 * s, 0.0, s);
    let brute = lowest(|s| opposite(s).distance(inside), [0.0, 1.0]);
    assert!((far.distance - brute).abs() < 1e-9 && far.normal.x > 0.0, "{far:?}");
    assert!(wall.nearest(0, inside).distance < far.distance - 0.01);
    assert_consistent(&far, inside, 1e-12);
    let outside = DVec3::new(1.2, 0.0, 0.5);
    assert!(wall.nearest(1, outside).distance.is_infinite());
    // A ball on the mouth sees both rims.
    let above = DVec3::new(0.1, 0.0, 3.0);
    assert_eq!(wall.nearest(1, above).feature, Feature::Edge(1));
    assert!((wall.nearest(1, above).distance - 1.1f64.hypot(2.0)).abs() < 1e-12);
}

/// A grain that plugs a funnel is pushed back to the axis, without a jump on it.
#[test]
fn plugged_funnel_pushes_to_the_axis() {
    let shape = Shape::Cone { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 0.2, end_radius: 1.0, length: 1.0 };
    let wall = still(shape);
    let radius = 0.5;
    let side_force = |x: f64| -> f64 {
        let touching = contacts(&wall, DVec3::new(x, 0.0, 0.34), radius);
        assert_eq!(touching.len(), 2, "{x}");
        touching.iter().map(|t| (radius - t.nearest.distance) * t.nearest.normal.x).sum()
    };
    let slope = side_force(1e-3) / 1e-3;
    assert!(slope < -0.5, "{slope}");
    for x in [1e-9, 1e-6, 1e-4] {
        assert!((side_force(x) / x - slope).abs() < 1e-3, "{x}");
        // With the near side alone the force would jump at the axis.
        let near = wall.nearest(0, DVec3::new(x, 0.0, 0.34));
        assert!(((radius - near.distance) * near.normal.x / x - slope).abs() > 1.0);
    }
}

#[test]
fn shell_from_both_sides() {
    let mut dice = Dice::new(2);
    let wall = still(Shape::Sphere { centre: [0.1, -0.2, 0.3], radius: 0.7 });
    let middle = DVec3::new(0.1, -0.2, 0.3);
    for _ in 0..100 {
        let centre = middle + dice.vector(1.5);
        let surface = |b: f64, a: f64| middle + 0.7 * DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos());
        let brute = smallest(surface, [[0.0, PI], ROUND], centre);
        let near = wall.nearest(0, centre);
        assert!((near.distance - brute).abs() < 1e-7);
        assert_consistent(&near, centre, 1e-12);
    }
    assert!((wall.nearest(0, middle).distance - 0.7).abs() < 1e-15);
}

#[test]
fn triangle_with_all_features() {
    let mut dice = Dice::new(3);
    let mut seen = [0; 7];
    for _ in 0..600 {
        let t = [dice.vector(1.0), dice.vector(1.0), dice.vector(1.0)];
        let wall = still(mesh(&[t]));
        let centre = dice.vector(1.5);
        let near = wall.nearest(0, centre);
        // The unit square onto the triangle.
        let surface = |u: f64, v: f64| t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * ((1.0 - u) * v);
        let brute = smallest(surface, [[0.0, 1.0], [0.0, 1.0]], centre);
        assert!((near.distance - brute).abs() < 1e-7, "{near:?} {brute}");
        assert!(near.distance <= brute + 1e-12, "no point is nearer");
        assert_consistent(&near, centre, 1e-12);
        let plane = (centre - t[0]).dot((t[1] - t[0]).cross(t[2] - t[0]).normalize()).abs();
        let feature = match near.feature {
            Feature::Face => 0,
            Feature::Edge(k) => 1 + usize::from(k),
            Feature::Corner(k) => 4 + usize::from(k),
        };
        if feature > 0 {
            assert!(plane < near.distance, "the plane of the triangle passes the gate");
        }
        seen[feature] += 1;
    }
    assert!(seen.iter().all(|&n| n > 10), "every feature is met: {seen:?}");
}

/// The search of a mesh misses nothing and adds nothing.
#[test]
fn near_is_all_within_reach() {
    let mut dice = Dice::new(4);
    let corner = |dice: &mut Dice, at: DVec3| at + dice.vector(0.2);
    let triangles: Vec<[DVec3; 3]> = (0..700)
        .map(|_| {
            let at = dice.vector(1.0);
            [corner(&mut dice, at), corner(&mut dice, at), corner(&mut dice, at)]
        })
        .collect();
    let wall = still(mesh(&triangles));
    let mut found = Vec::new();
    for _ in 0..200 {
        let (centre, reach) = (dice.vector(1.2), dice.between(0.0, 0.5));
        wall.near(centre, reach, &mut found);
        let all: Vec<u32> = touches(&wall, centre, reach).iter().map(|t| t.element).collect();
        assert_eq!(found, all);
    }
}

/// In the plane every vector keeps y at an exact zero, also of a drum that turns.
#[test]
fn plane_keeps_y_zero() {
    use tsubu_scene::plan::{Rotation, Signal};
    let shapes = [
        Shape::Cylinder { point: [0.0; 3], axis: [0.0, 1.0, 0.0], radius: 1.0, length: Some(0.1) },
        Shape::Cylinder { point: [0.0; 3], axis: [0.6, 0.0, 0.8], radius: 0.3, length: Some(1.0) },
        Shape::Sphere { centre: [0.0; 3], radius: 1.0 },
        Shape::Box { width: 2.0, height: 2.0, depth: 1.0, floor_centre: [0.0; 3] },
    ];
    let mut dice = Dice::new(5);
    for shape in shapes {
        let mut plan = super::plan_wall(shape);
        let signal = Signal::Steady { rate: 2.0 };
        plan.rotation = Some(Rotation { centre: [0.3, 0.0, 0.1], axis: [0.0, 1.0, 0.0], signal });
        let mut wall = Wall::new("drum", &plan, 2, &Hosts::default(), DVec3::ZERO);
        wall.follow(0.7, &Hosts::default());
        for _ in 0..50 {
            let centre = dice.vector(1.5) * DVec3::new(1.0, 0.0, 1.0);
            for element in 0..wall.elements() as u32 {
                let near = wall.nearest(element, centre);
                let velocity = wall.velocity_at(near.point);
                for y in [near.normal.y, near.point.y, velocity.y] {
                    assert_eq!(y.abs().to_bits(), 0, "{near:?}");
                }
            }
        }
    }
}
