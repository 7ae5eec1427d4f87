//! What of a heap of triangles belongs together: common corners, coplanar patches, and patches side by side.

use super::tree::Tree;
use super::triangle::Triangle;
use glam::DVec3;
use std::collections::BTreeMap;

/// Sine of the angle up to which neighbouring triangles are one plane [-].
const COPLANAR: f64 = 1e-6;

/// Corners, patches and neighbourhoods of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Topology {
    /// Vertex index of each corner of each triangle; equal where triangles share a corner.
    pub vertices: Vec<[u32; 3]>,
    /// Patch of each triangle: triangles that lie in one plane and hang together by edges.
    pub patch: Vec<u32>,
    /// Vertices on the border of each patch, sorted: those that other patches share.
    border: Vec<Vec<u32>>,
}

/// Moves corners that lie within `tolerance` onto one point and drops triangles that are then no more than a line.
/// Exporters that transform parts leave differences in the last digits; taken literally they would be cracks.
pub(super) fn weld(corners: &[[DVec3; 3]], tolerance: f64) -> (Vec<Triangle>, Vec<[u32; 3]>) {
    let mut welder = Welder { tolerance, points: Vec::new(), cells: BTreeMap::new() };
    let mut triangles = Vec::new();
    let mut vertices = Vec::new();
    for corners in corners {
        let index = corners.map(|p| welder.vertex(p));
        let triangle = Triangle::new(index.map(|v| welder.points[v as usize]));
        if triangle.height() > tolerance {
            triangles.push(triangle);
            vertices.push(index);
        }
    }
    (triangles, vertices)
}

struct Welder {
    tolerance: f64,
    points: Vec<DVec3>,
    cells: BTreeMap<[i64; 3], Vec<u32>>,
}

impl Welder {
    fn vertex(&mut self, point: DVec3) -> u32 {
        // Cells of twice the tolerance: whatever is near lies in the cells of the eight corners of a cube around it.
        let cell = |p: DVec3| (p / (2.0 * self.tolerance)).to_array().map(|x| x.floor() as i64);
        for corner in 0..8u8 {
            let sign = |bit: u8| if corner & bit == 0 { -1.0 } else { 1.0 };
            let around = cell(point + DVec3::new(sign(1), sign(2), sign(4)) * self.tolerance);
            let near = self.cells.get(&around).into_iter().flatten();
            let mut near = near.filter(|&&v| self.points[v as usize].distance(point) <= self.tolerance);
            if let Some(&vertex) = near.next() {
                return vertex;
            }
        }
        let vertex = self.points.len() as u32;
        self.cells.entry(cell(point)).or_default().push(vertex);
        self.points.push(point);
        vertex
    }
}

impl Topology {
    pub fn new(triangles: &[Triangle], vertices: Vec<[u32; 3]>, tree: &Tree, tolerance: f64) -> Self {
        let mut edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        for (t, v) in vertices.iter().enumerate() {
            for k in 0..3 {
                edges.entry(edge(v, k)).or_default().push(t as u32);
            }
        }
        let mut union = Union::new(triangles.len());
        for (&edge, sharing) in &edges {
            for (i, &a) in sharing.iter().enumerate() {
                for &b in &sharing[i + 1..] {
                    if continues(triangles, &vertices, edge, [a, b]) {
                        union.join(a, b);
                    }
                }
            }
        }
        let resting = resting_vertices(triangles, &vertices, &edges, tree, tolerance);
        for &(t, b, _) in &resting {
            let parallel = triangles[t as usize].normal.cross(triangles[b as usize].normal).length() < COPLANAR;
            if parallel && overlap_along_edge(&triangles[t as usize], &triangles[b as usize], tolerance) {
                union.join(t, b);
            }
        }
        let patch = union.numbered();
        let border = border(&vertices, &patch, &resting);
        Self { vertices, patch, border }
    }

    /// Whether two patches share an edge or a corner.
    pub fn adjacent(&self, a: u32, b: u32) -> bool {
        let (Some(a), Some(b)) = (self.border.get(a as usize), self.border.get(b as usize)) else { return false };
        let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
        short.iter().any(|v| long.binary_search(v).is_ok())
    }
}

/// An edge of a triangle by its two vertices, the lower first.
pub(super) fn edge(v: &[u32; 3], k: usize) -> [u32; 2] {
    let (a, b) = (v[k], v[(k + 1) % 3]);
    [a.min(b), a.max(b)]
}

/// Whether two triangles go on in one plane across their common edge, whichever way their corners run.
fn continues(triangles: &[Triangle], vertices: &[[u32; 3]], edge: [u32; 2], pair: [u32; 2]) -> bool {
    let [a, b] = pair.map(|t| &triangles[t as usize]);
    if a.normal.cross(b.normal).length() >= COPLANAR {
        return false;
    }
    // A sheet folded back onto itself is parallel too, but both third corners lie on the same side of the edge.
    let third = |t: u32| (0..3).find(|&k| !edge.contains(&vertices[t as usize][k]));
    let (Some(i), Some(j)) = (third(pair[0]), third(pair[1])) else { return false };
    let start = (0..3).find(|&k| vertices[pair[0] as usize][k] == edge[0]).map_or(DVec3::ZERO, |k| a.corners[k]);
    let end = (0..3).find(|&k| vertices[pair[0] as usize][k] == edge[1]).map_or(DVec3::ZERO, |k| a.corners[k]);
    let side = |p: DVec3| (end - start).cross(p - start).dot(a.normal);
    side(a.corners[i]) * side(b.corners[j]) < 0.0
}

/// Vertices of open edges that rest on an edge of a triangle they are no corner of (T-junctions): triangle that has the
/// vertex, triangle it rests on, vertex.
fn resting_vertices(
    triangles: &[Triangle],
    vertices: &[[u32; 3]],
    edges: &BTreeMap<[u32; 2], Vec<u32>>,
    tree: &Tree,
    tolerance: f64,
) -> Vec<(u32, u32, u32)> {
    let open = |t: u32| (0..3).any(|k| edges[&edge(&vertices[t as usize], k)].len() == 1);
    let mut resting = Vec::new();
    for (t, v) in vertices.iter().enumerate() {
        for k in 0..3 {
            if edges[&edge(v, k)].len() != 1 && edges[&edge(v, (k + 2) % 3)].len() != 1 {
                continue;
            }
            let place = triangles[t].corners[k];
            tree.near(place, tolerance, |other| {
                let strange = !vertices[other as usize].contains(&v[k]);
                if strange && open(other) && triangles[other as usize].holds(place, tolerance) {
                    resting.push((t as u32, other, v[k]));
                }
            });
        }
    }
    resting.sort_unstable();
    resting.dedup();
    resting
}

/// Whether two triangles lie side by side along pieces of their edges.
fn overlap_along_edge(a: &Triangle, b: &Triangle, tolerance: f64) -> bool {
    let sides = |t: &Triangle| [0, 1, 2].map(|k| (t.corners[k], t.corners[(k + 1) % 3], t.corners[(k + 2) % 3]));
    sides(a).iter().any(|&(p, q, inner_a)| {
        let along = (q - p).normalize_or_zero();
        let length = p.distance(q);
        sides(b).iter().any(|&(r, s, inner_b)| {
            let off_line = |x: DVec3| (x - p - along * (x - p).dot(along)).length() > tolerance;
            let (u, v) = ((r - p).dot(along), (s - p).dot(along));
            let common = u.max(v).min(length) - u.min(v).max(0.0);
            let side = |x: DVec3| along.cross(x - p).dot(a.normal);
            !off_line(r) && !off_line(s) && common > tolerance && side(inner_a) * side(inner_b) < 0.0
        })
    })
}

/// Per patch the vertices that other patches have too.
fn border(vertices: &[[u32; 3]], patch: &[u32], resting: &[(u32, u32, u32)]) -> Vec<Vec<u32>> {
    let corners = vertices.iter().zip(patch).flat_map(|(v, &p)| v.map(|v| (v, p)));
    let mut seen: Vec<(u32, u32)> = corners.chain(resting.iter().map(|r| (r.2, patch[r.1 as usize]))).collect();
    seen.sort_unstable();
    seen.dedup();
    let mut border = vec![Vec::new(); patch.iter().max().map_or(0, |&p| p as usize + 1)];
    for common in seen.chunk_by(|a, b| a.0 == b.0).filter(|c| c.len() > 1) {
        for &(vertex, patch) in common {
            border[patch as usize].push(vertex);
        }
    }
    border
}

/// Disjoint sets of triangles.
struct Union(Vec<u32>);

impl Union {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn root(&mut self, mut t: u32) -> u32 {
        while self.0[t as usize] != t {
            self.0[t as usize] = self.0[self.0[t as usize] as usize];
            t = self.0[t as usize];
        }
        t
    }

    /// The lower index leads, so that the numbers do not depend on the order in which edges are met.
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// Sets numbered from 0 in the order of their first triangles.
    fn numbered(mut self) -> Vec<u32> {
        let count = self.0.len() as u32;
        let roots: Vec<u32> = (0..count).map(|t| self.root(t)).collect();
        let mut next = 0;
        let mut number = vec![0; roots.len()];
        for t in 0..roots.len() {
            if roots[t] as usize == t {
                number[t] = next;
                next += 1;
            }
        }
        roots.iter().map(|&r| number[r as usize]).collect()
    }
}
