//! Walls: nearest points, contacts of meshes, poses, and walls that the grains move.

mod block;
mod body;
mod nearest;
mod pose;
mod seam;
mod section;
mod servo;
mod smooth;
mod travel;
mod turning;

use glam::DVec3;
use std::sync::Arc;
use tsubu::partner::Hosts;
use tsubu::wall::{Nearest, Touch, Wall};
use tsubu_scene::plan::{self, Shape, Vector};

/// Random numbers for tests (SplitMix64).
pub struct Dice(u64);

impl Dice {
    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Evenly in [0, 1).
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }

    /// Evenly in a cube around the origin.
    pub fn vector(&mut self, half: f64) -> DVec3 {
        DVec3::new(self.between(-half, half), self.between(-half, half), self.between(-half, half))
    }

    /// Evenly over all directions.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.vector(1.0);
            if (1e-3..1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}

/// A still wall of a shape in the plan's terms.
pub fn plan_wall(shape: Shape) -> plan::Wall {
    plan::Wall {
        material: "any".to_owned(),
        shape,
        interface: None,
        host: None,
        motion: None,
        rotation: None,
        servo: None,
        body: None,
        until: None,
    }
}

/// A wall in space without hosts or gravity.
pub fn wall(plan: &plan::Wall) -> Wall {
    Wall::new("wall", plan, 3, &Hosts::default(), DVec3::ZERO)
}

/// A still wall of a shape.
pub fn still(shape: Shape) -> Wall {
    wall(&plan_wall(shape))
}

/// A mesh from its triangles.
pub fn mesh(triangles: &[[DVec3; 3]]) -> Shape {
    let triangles: Vec<[Vector; 3]> = triangles.iter().map(|t| t.map(|p| p.to_array())).collect();
    Shape::Mesh {
        path: "test.stl".to_owned(),
        fingerprint: String::new(),
        scale: 1.0,
        shift: [0.0; 3],
        triangles: Arc::new(triangles),
    }
}

/// The twelve triangles of a box between two corners, outward normals.
pub fn block(low: DVec3, high: DVec3) -> Vec<[DVec3; 3]> {
    let corner = |k: usize| {
        let pick = |bit: usize, l: f64, h: f64| if k & bit == 0 { l } else { h };
        DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]);
    halves.map(|t| t.map(corner)).collect()
}

/// Every element within reach, judged by nobody.
pub fn touches(wall: &Wall, centre: DVec3, reach: f64) -> Vec<Touch> {
    let nearest = |e: u32| Touch::new(e, wall.nearest(e, centre));
    (0..wall.elements() as u32).map(nearest).filter(|t| t.nearest.distance < reach).collect()
}

/// The contacts of a grain, by the way the engine takes: candidates, then touches.
pub fn contacts(wall: &Wall, centre: DVec3, radius: f64) -> Vec<Touch> {
    let mut candidates = Vec::new();
    wall.near(centre, 1.1 * radius, &mut candidates);
    let mut contacts = Vec::new();
    wall.touching(&candidates, centre, radius, &mut contacts);
    contacts
}

/// Asserts that a nearest point fits together: on the surface at that distance, the normal from it to the centre.
pub fn assert_consistent(n: &Nearest, centre: DVec3, tolerance: f64) {
    assert!((n.normal.length() - 1.0).abs() < 1e-12, "{n:?}");
    assert!((n.point + n.normal * n.distance).distance(centre) < tolerance, "{n:?} {centre}");
}
