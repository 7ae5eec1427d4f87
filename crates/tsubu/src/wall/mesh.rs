//! Triangles from a file.

use super::Pose;
use super::nearest::Nearest;
use super::ridges::Ridges;
use super::section::{section, strips};
use super::topology::{Topology, edge, weld};
use super::tree::Tree;
use super::triangle::Triangle;
use crate::about::About;
use glam::DVec3;
use std::sync::OnceLock;

pub(crate) const MESH: About = About {
    key: "walls.NAME.shape.mesh",
    formula: "d = r - distance to the nearest points of the triangles; contacts with nearly one normal are one",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], corners [m] after `scale` and `shift`",
    limits: "Touched from both sides; in the plane the section with y = 0 counts. Corners nearer than 1e-7 of its size \
are one. Friction springs go on from triangle to triangle. Triangles without area are refused.",
    reference: "nearest point on a triangle: Ericson 2005, Real-Time Collision Detection, section 5.1.5",
};

/// Over the diagonal of the mesh: corners nearer than this are one. Rounding of single-precision files is 6e-8.
const WELD: f64 = 1e-7;

/// A surface of triangles, touched from both sides.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    pub(super) topology: Topology,
    /// Found when a body first asks for them: spheres never do.
    ridges: OnceLock<Ridges>,
    tree: Tree,
    /// Corners nearer than this are one [m].
    pub(super) tolerance: f64,
    /// Greatest distance of a corner from the centre of rotation [m].
    radius: f64,
    /// Whether no edge is open, so that there is an inside.
    pub(super) closed: bool,
    /// The section with the plane.
    lines: Vec<[DVec3; 2]>,
}

impl Mesh {
    /// Welds common corners, drops triangles that are lines, and prepares the search; `centre` is the centre of
    /// rotation.
    pub fn new(corners: &[[DVec3; 3]], centre: DVec3) -> Self {
        let all = || corners.iter().flatten();
        let low = all().fold(DVec3::INFINITY, |low, p| low.min(*p));
        let high = all().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
        let tolerance = if corners.is_empty() { 0.0 } else { WELD * low.distance(high) };
        let (triangles, vertices) = weld(corners, tolerance);
        let tree = Tree::new(&triangles);
        let closed = closed(&vertices);
        let topology = Topology::new(&triangles, vertices, &tree, tolerance);
        let radius = triangles.iter().flat_map(|t| t.corners).map(|p| p.distance(centre)).fold(0.0, f64::max);
        Self { triangles, topology, ridges: OnceLock::new(), tree, tolerance, radius, closed, lines: Vec::new() }
    }

    /// The section with the plane y = 0, for 2-D scenes.
    pub fn in_plane(corners: &[[DVec3; 3]], centre: DVec3) -> Self {
        Self::of_lines(section(corners), centre)
    }

    /// Of pieces of line in the plane y = 0, for 2-D scenes.
    pub(super) fn of_lines(lines: Vec<[DVec3; 2]>, centre: DVec3) -> Self {
        let longest = lines.iter().map(|[a, b]| a.distance(*b)).fold(0.0, f64::max);
        let mut mesh = Self::new(&strips(&lines, longest), centre);
        mesh.radius = lines.iter().flatten().map(|p| p.distance(centre)).fold(0.0, f64::max);
        mesh.lines = lines;
        mesh
    }

    /// Pieces of line by their ends, of the section with the plane; none in space.
    pub(super) fn lines(&self) -> Vec<Vec<DVec3>> {
        self.lines.iter().map(|line| line.to_vec()).collect()
    }

    /// The triangles that are left; their indices are the elements.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// Corners nearer than this are one [m].
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Its sharp edges and corners.
    pub fn ridges(&self) -> &Ridges {
        let Self { triangles, topology, tree, tolerance, .. } = self;
        self.ridges.get_or_init(|| Ridges::new(triangles, (&topology.vertices, &topology.patch), tree, *tolerance))
    }

    /// Adds the triangles within `reach` of a point to `out`.
    pub(super) fn near(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        self.tree.near(centre, reach, |t| {
            if self.triangles[t as usize].nearest(centre).distance < reach {
                out.push(t);
            }
        });
        out.sort_unstable();
    }

    /// How far along a direction from a point the mesh is crossed, in that direction's length; where triangles share an edge once.
    pub(super) fn crossings(&self, point: DVec3, way: DVec3) -> Vec<f64> {
        let mut found = Vec::new();
        self.tree.along(point, way, |t| found.extend(self.triangles[t as usize].crossing(point, way)));
        found.sort_unstable_by(f64::total_cmp);
        let apart = self.tolerance / way.length();
        found.dedup_by(|next, last| *next - *last <= apart);
        found
    }

    /// Corners of the box around it.
    pub(super) fn extent(&self) -> (DVec3, DVec3) {
        let corners = self.triangles.iter().flat_map(|t| t.corners);
        corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
    }

    pub(super) fn nearest(&self, element: u32, centre: DVec3) -> Nearest {
        self.triangles[element as usize].nearest(centre)
    }

    /// How far any point may have moved [m].
    pub(super) fn travel(&self, pose: &Pose, reference: &Pose) -> f64 {
        (pose.offset - reference.offset).length() + pose.turn_since(reference) * self.radius
    }
}

/// Whether every edge belongs to an even number of triangles.
fn closed(vertices: &[[u32; 3]]) -> bool {
    let mut edges: Vec<[u32; 2]> = vertices.iter().flat_map(|v| (0..3).map(|k| edge(v, k))).collect();
    edges.sort_unstable();
    !edges.is_empty() && edges.chunk_by(|a, b| a == b).all(|same| same.len() % 2 == 0)
}
