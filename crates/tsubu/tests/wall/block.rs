//! Contacts of meshes against shapes whose distance is known: a box from inside and outside, a plate with a hole.

use super::{Dice, block, contacts, mesh, still, touches};
use glam::DVec3;
use tsubu_scene::plan::Shape;

/// From inside a mesh box gives the contacts of six planes: one at a wall, two in an edge, three in a corner.
#[test]
fn inside_a_box_as_planes() {
    let boxed = still(mesh(&block(DVec3::new(-1.0, -1.5, 0.0), DVec3::new(1.0, 1.5, 2.5))));
    let planes = still(Shape::Box { width: 2.0, height: 2.5, depth: 3.0, floor_centre: [0.0; 3] });
    let mut dice = Dice::new(11);
    let mut seen = [0; 4];
    for _ in 0..3000 {
        let radius = 0.4;
        let half = DVec3::new(1.0, 1.5, 1.25) - 0.9 * radius;
        let centre = DVec3::Z * 1.25 + (dice.vector(1.6) * half).clamp(-half, half);
        let mut ours: Vec<_> = contacts(&boxed, centre, radius).iter().map(|t| t.nearest).collect();
        let mut theirs: Vec<_> = contacts(&planes, centre, radius).iter().map(|t| t.nearest).collect();
        assert_eq!(ours.len(), theirs.len(), "{centre}");
        seen[ours.len()] += 1;
        for list in [&mut ours, &mut theirs] {
            list.sort_by(|a, b| a.point.to_array().partial_cmp(&b.point.to_array()).unwrap());
        }
        for our in &ours {
            let same = |t: &&tsubu::wall::Nearest| {
                (t.distance - our.distance).abs() < 1e-14 && (t.normal - our.normal).length() < 1e-14
            };
            assert_eq!(theirs.iter().filter(same).count(), 1, "{our:?} {theirs:?}");
        }
    }
    assert!(seen.iter().all(|&n| n > 20), "nothing, wall, edge and corner are met: {seen:?}");
}

/// From outside a block is convex: one contact everywhere, at the exact distance, over faces, edges and corners.
#[test]
fn outside_a_block_one_contact() {
    let half = DVec3::new(0.5, 0.4, 0.3);
    let wall = still(mesh(&block(-half, half)));
    let mut dice = Dice::new(12);
    let mut seen = [0; 4];
    let mut naive = 0;
    for _ in 0..3000 {
        let centre = dice.vector(0.9);
        let nearest = centre.clamp(-half, half);
        let (distance, radius) = (nearest.distance(centre), 0.45);
        if !(1e-6..radius).contains(&distance) {
            continue;
        }
        let touching = contacts(&wall, centre, radius);
        // The far faces of a thin block can be reached through it; nothing is behind a surface.
        assert_eq!(touching.len(), 1, "{centre} {touching:?}");
        assert!((touching[0].nearest.distance - distance).abs() < 1e-13);
        assert!((touching[0].nearest.normal - (centre - nearest) / distance).length() < 1e-9);
        let outside = (centre.abs() - half).to_array().iter().filter(|x| **x > 0.0).count();
        seen[outside] += 1;
        naive += usize::from(touches(&wall, centre, radius).len() == 1);
    }
    assert!(seen[1..].iter().all(|&n| n > 100), "faces, edges, corners: {seen:?}");
    assert!(naive < 30, "without the rule the gate fails: {naive}");
}

/// A grain over a square hole is held by its four edges, though all belong to one plane; off the middle by fewer.
#[test]
fn hole_in_a_plate() {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let ring = |r: f64| [at(-r, -r), at(r, -r), at(r, r), at(-r, r)];
    let (inner, outer) = (ring(0.3), ring(1.0));
    let plate: Vec<[DVec3; 3]> = (0..4)
        .flat_map(|k| {
            let n = (k + 1) % 4;
            [[outer[k], outer[n], inner[n]], [outer[k], inner[n], inner[k]]]
        })
        .collect();
    let wall = still(mesh(&plate));
    let held = contacts(&wall, DVec3::new(0.0, 0.0, 0.35), 0.5);
    assert_eq!(held.len(), 4);
    for t in &held {
        assert!((t.nearest.distance - 0.3f64.hypot(0.35)).abs() < 1e-14);
        assert_eq!(wall.key(t.element), 0);
    }
    let sum: DVec3 = held.iter().map(|t| t.nearest.normal).sum();
    assert!(sum.with_z(0.0).length() < 1e-14);
    assert_eq!(contacts(&wall, DVec3::new(0.2, 0.0, 0.35), 0.5).len(), 3);
    assert_eq!(contacts(&wall, DVec3::new(0.2, 0.2, 0.43), 0.5).len(), 2);
    assert_eq!(contacts(&wall, DVec3::new(0.7, 0.0, 0.49), 0.5).len(), 1);
}

/// Faces of a block are patches of their own; those side by side share an edge or corner, opposite ones do not.
#[test]
fn patches_and_their_neighbours() {
    let wall = still(mesh(&block(DVec3::ZERO, DVec3::ONE)));
    let keys: Vec<u32> = (0..12).map(|e| wall.key(e)).collect();
    assert_eq!(keys, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
    for a in 0..6 {
        for b in 0..6 {
            let opposite = a / 2 == b / 2 && a != b;
            assert_eq!(wall.adjacent(a, b), !opposite, "{a} {b}");
        }
    }
}

/// A face that was cut more finely than its neighbour hangs together with it all the same.
#[test]
fn neighbours_across_t_junctions() {
    let at = DVec3::new;
    let floor = [[at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0)]];
    // A wall along the floor's edge x = 0 in three pieces; the middle one shares no corner with the floor.
    let piece = |a: f64, b: f64| [at(0.0, a, 0.0), at(0.0, b, 0.0), at(0.0, 0.5 * (a + b), 1.0)];
    let triangles = [floor[0], piece(0.0, 0.4), piece(0.4, 0.7), piece(0.7, 1.0)];
    let wall = still(mesh(&triangles));
    let keys: Vec<u32> = (0..4).map(|e| wall.key(e)).collect();
    assert!((1..4).all(|k| wall.adjacent(keys[0], keys[k])), "{keys:?}");
    // Rolling from the floor into the wall's foot: two contacts, both faces.
    let touching = contacts(&wall, at(0.25, 0.55, 0.28), 0.3);
    assert_eq!(touching.len(), 2, "{touching:?}");
}

/// Corners that differ in the last digits of single precision are one, and triangles that are lines are gone.
#[test]
fn cracks_are_welded() {
    let mut dice = Dice::new(13);
    let exact = block(DVec3::ZERO, DVec3::ONE);
    let mut rough: Vec<_> = exact.iter().map(|t| t.map(|p| p + dice.vector(3e-8))).collect();
    rough.push([DVec3::ZERO, DVec3::ZERO, DVec3::X]);
    rough.push([DVec3::ZERO, DVec3::X * 0.5, DVec3::X]);
    let wall = still(mesh(&rough));
    assert_eq!(wall.elements(), 12);
    assert!((0..12).all(|e| wall.key(e) == e / 2));
}
