//! Meshes in 2-D scenes: their section with the plane y = 0.

use super::{Dice, block, contacts, mesh, plan_wall};
use glam::DVec3;
use tsubu::partner::Hosts;
use tsubu::wall::Wall;
use tsubu_scene::plan::Shape;

fn flat(shape: Shape) -> Wall {
    Wall::new("flat", &plan_wall(shape), 2, &Hosts::default(), DVec3::ZERO)
}

/// A block is a rectangle, whether the plane cuts it through the middle or it only begins there; y stays an exact zero.
#[test]
fn block_is_a_rectangle() {
    for [low, high] in [[-0.3, 0.5], [0.0, 1.0], [-1.0, 0.0]] {
        let wall = flat(mesh(&block(DVec3::new(-0.5, low, -0.2), DVec3::new(0.5, high, 0.2))));
        assert_eq!(wall.outline().lines.len(), if low == -0.3 { 8 } else { 4 });
        let half = DVec3::new(0.5, 0.0, 0.2);
        let mut dice = Dice::new(51);
        for _ in 0..1000 {
            let centre = dice.vector(0.8).with_y(0.0);
            let nearest = centre.clamp(-half, half);
            let distance = nearest.distance(centre);
            if !(1e-6..0.3).contains(&distance) {
                continue;
            }
            let touching = contacts(&wall, centre, 0.3);
            assert_eq!(touching.len(), 1, "{centre}");
            let near = touching[0].nearest;
            assert!((near.distance - distance).abs() < 1e-14);
            assert!((near.normal - (centre - nearest) / distance).length() < 1e-9);
            assert_eq!((near.normal.y.to_bits(), near.point.y.to_bits()), (0, 0));
        }
    }
}

/// An oblique plane is met by its line in the plane; as a surface in space it would be nearer.
#[test]
fn oblique_plane() {
    let at = DVec3::new;
    let (a, b, c, d) = (at(-1.0, -1.0, -0.5), at(1.0, -1.0, -0.5), at(1.0, 1.0, 0.5), at(-1.0, 1.0, 0.5));
    let triangles = [[a, b, c], [a, c, d]];
    let centre = at(0.1, 0.0, 0.3);
    let line = contacts(&flat(mesh(&triangles)), centre, 0.4);
    assert_eq!(line.len(), 1);
    assert!((line[0].nearest.distance - 0.3).abs() < 1e-15 && line[0].nearest.normal == DVec3::Z);
    let surface = contacts(&super::still(mesh(&triangles)), centre, 0.4);
    assert!((surface[0].nearest.distance - 0.3 * 0.8f64.sqrt()).abs() < 1e-15);
}

/// History finds its way from line to line.
#[test]
fn neighbouring_lines() {
    let wall = flat(mesh(&block(DVec3::new(-0.5, 0.0, -0.2), DVec3::new(0.5, 1.0, 0.2))));
    let keys: Vec<u32> = (0..wall.elements() as u32).map(|e| wall.key(e)).collect();
    assert_eq!(keys, [0, 0, 1, 1, 2, 2, 3, 3]);
    let neighbours = |a: u32| (0..4).filter(|&b| b != a && wall.adjacent(a, b)).count();
    assert!((0..4).all(|a| neighbours(a) == 2));
}
