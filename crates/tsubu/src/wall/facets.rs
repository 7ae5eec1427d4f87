//! Curved walls as meshes: bodies that are no spheres touch the rims of meshes alone.

use super::Wall;
use super::frustum::Frustum;
use super::mesh::Mesh;
use super::outline::{circle, globe, section, skin};
use super::shell::SphericalShell;
use super::surface::Surface;
use glam::DVec3;
use std::f64::consts::PI;

/// Facets round a circle, at least and at most.
const FACETS: [f64; 2] = [24.0, 720.0];

/// What has become of a curved wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faceted {
    /// Facets round a circle.
    pub facets: usize,
    /// How far they are from the curved surface, at most [m]; 0 where it is straight lines in the plane.
    pub off: f64,
}

impl Wall {
    /// Puts a mesh in the place of a cylinder, cone or sphere, off by no more than `off` [m] where 24 to 720 facets allow: of radius R with n
    /// facets by R (1 - cos(pi/n)) / 2, edges outside and middles inside. Pictures keep the curved one. `None`: it is not curved.
    pub fn facet(&mut self, off: f64) -> Option<Faceted> {
        let centre = self.pose.centre;
        let (mesh, facets, off) = match &self.surface {
            Surface::Frustum(frustum) => {
                let radius = frustum.radius[0].max(frustum.radius[1]);
                let straight = self.in_plane && frustum.axis.y.abs() < 0.5;
                let (facets, share) = if straight { (facets(radius, off).0, 0.0) } else { facets(radius, off) };
                let grown = Frustum { radius: frustum.radius.map(|r| r * (1.0 + share)), ..*frustum };
                let mesh = if self.in_plane {
                    of_outlines(&section(&grown, facets), centre)
                } else {
                    Mesh::new(&skin(&grown, facets), centre)
                };
                (mesh, facets, share * radius)
            }
            Surface::Shell(shell) => {
                let (facets, share) = facets(shell.radius, off);
                let grown = SphericalShell { radius: shell.radius * (1.0 + share), ..*shell };
                let mesh = if self.in_plane {
                    of_outlines(&[circle(grown.centre, grown.radius, facets)], centre)
                } else {
                    Mesh::new(&globe(&grown, facets), centre)
                };
                (mesh, facets, share * shell.radius)
            }
            Surface::HalfSpaces { .. } | Surface::Mesh(_) => return None,
        };
        self.surface = Surface::Mesh(mesh);
        Some(Faceted { facets, off })
    }
}

/// How many facets go round a circle of a `radius` [m] to be off by no more than `off` [m], and the share of the radius by which they are.
fn facets(radius: f64, off: f64) -> (usize, f64) {
    // Half as many go from pole to pole: an even number.
    let half = 0.5 * PI / (1.0 - 2.0 * off / radius).clamp(-1.0, 1.0).acos();
    let facets = (2.0 * half.ceil()).clamp(FACETS[0], FACETS[1]);
    (facets as usize, 0.5 * (1.0 - (PI / facets).cos()))
}

/// Of closed lines in the plane; two corners are one piece of line.
fn of_outlines(outlines: &[Vec<DVec3>], centre: DVec3) -> Mesh {
    let pieces = |line: &Vec<DVec3>| {
        let count = if line.len() > 2 { line.len() } else { 1 };
        (0..count).map(|k| [line[k], line[(k + 1) % line.len()]]).collect::<Vec<_>>()
    };
    Mesh::of_lines(outlines.iter().flat_map(pieces).collect(), centre)
}
