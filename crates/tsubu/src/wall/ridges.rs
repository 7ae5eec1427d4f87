//! Sharp edges and corners of a mesh, which bodies with edges or round bodies touch as such.
//!
//! An edge of triangles is sharp towards the side from which nothing of its triangles is seen beside it; there the directions in which it is nearest fill an arc. Where
//! triangles go on in one plane that arc is empty, and so it is of no use towards a hollow. A corner is sharp where edges about it are.

use super::topology::edge;
use super::tree::Tree;
use super::triangle::Triangle;
use glam::DVec3;
use std::collections::BTreeMap;

/// Arcs below this are those of a plane [rad].
const FLAT: f64 = 1e-7;

/// A sharp edge, as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Ridge {
    /// Its ends [m].
    pub ends: [DVec3; 2],
    /// Unit vectors across it, from which the angles of its arc are told.
    pub across: [DVec3; 2],
    /// Angles between which it is nearest to a body, seen from it [rad].
    pub arc: [f64; 2],
    /// Patch of its first triangle.
    pub patch: u32,
}

impl Ridge {
    /// Unit direction in the middle of its arc.
    pub fn outward(&self) -> DVec3 {
        let (sin, cos) = (0.5 * (self.arc[0] + self.arc[1])).sin_cos();
        self.across[0] * cos + self.across[1] * sin
    }
}

/// A sharp corner, as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Where it is [m].
    pub point: DVec3,
    /// Unit directions to the corners around it.
    pub around: Vec<DVec3>,
    /// Unit direction away from what is around it.
    pub outward: DVec3,
    /// How sharp it is: 0 for a corner in a plane.
    pub sharp: f64,
    /// Patch of its first triangle.
    pub patch: u32,
}

/// All of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Ridges {
    /// Sharp edges.
    pub ridges: Vec<Ridge>,
    /// Sharp corners.
    pub tips: Vec<Tip>,
    /// Of each triangle the numbers of its sharp edges and corners.
    of_triangle: Vec<[Option<u32>; 6]>,
}

impl Ridges {
    /// Of triangles with their vertices and patches; corners nearer than `tolerance` are one [m].
    pub(super) fn new(
        triangles: &[Triangle],
        (vertices, patch): (&[[u32; 3]], &[u32]),
        tree: &Tree,
        tolerance: f64,
    ) -> Self {
        let mut sharing: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        let mut around: BTreeMap<u32, Vec<(u32, usize)>> = BTreeMap::new();
        for (t, v) in (0..).zip(vertices) {
            for k in 0..3 {
                sharing.entry(edge(v, k)).or_default().push(t);
                around.entry(v[k]).or_default().push((t, k));
            }
        }
        // What rests on a triangle that does not have it goes on there.
        let rests = |point: DVec3, owners: &dyn Fn(u32) -> bool| {
            let mut rests = false;
            tree.near(point, tolerance, |t| rests |= !owners(t) && triangles[t as usize].holds(point, tolerance));
            rests
        };
        let mut all = Self { of_triangle: vec![[None; 6]; triangles.len()], ..Self::default() };
        for (key, owners) in &sharing {
            let first = owners[0] as usize;
            let Some(k) = (0..3).find(|k| edge(&vertices[first], *k) == *key) else { continue };
            let ends = [triangles[first].corners[k], triangles[first].corners[(k + 1) % 3]];
            let middle = (ends[0] + ends[1]) * 0.5;
            if rests(middle, &|t| owners.contains(&t)) {
                continue;
            }
            let centres = owners.iter().map(|t| triangles[*t as usize].corners.iter().sum::<DVec3>() / 3.0);
            if let Some((across, arc)) = arc(ends, centres) {
                let number = all.ridges.len() as u32;
                all.ridges.push(Ridge { ends, across, arc, patch: patch[first] });
                for &t in owners {
                    let side = (0..3).find(|k| edge(&vertices[t as usize], *k) == *key).unwrap_or_default();
                    all.of_triangle[t as usize][side] = Some(number);
                }
            }
        }
        for owners in around.values() {
            let (first, k) = owners[0];
            let point = triangles[first as usize].corners[k];
            if rests(point, &|t| owners.iter().any(|(owner, _)| *owner == t)) {
                continue;
            }
            if let Some((around, away)) = tip(point, owners.iter().map(|(t, k)| (&triangles[*t as usize], *k))) {
                let number = all.tips.len() as u32;
                let (sharp, outward) = (away.length(), away.normalize());
                all.tips.push(Tip { point, around, outward, sharp, patch: patch[first as usize] });
                for &(t, k) in owners {
                    all.of_triangle[t as usize][3 + k] = Some(number);
                }
            }
        }
        all
    }

    /// Numbers of the sharp edges of some triangles, each once, ascending; and of their sharp corners.
    pub fn of(&self, triangles: &[u32], ridges: &mut Vec<u32>, tips: &mut Vec<u32>) {
        ridges.clear();
        tips.clear();
        for t in triangles {
            let of = &self.of_triangle[*t as usize];
            ridges.extend(of[..3].iter().flatten());
            tips.extend(of[3..].iter().flatten());
        }
        for list in [ridges, tips] {
            list.sort_unstable();
            list.dedup();
        }
    }
}

/// Directions across an edge, and the angles from them between which no triangle lies beside it; nothing where these have no width.
fn arc(ends: [DVec3; 2], centres: impl Iterator<Item = DVec3>) -> Option<([DVec3; 2], [f64; 2])> {
    let along = (ends[1] - ends[0]).normalize_or_zero();
    let mut intos = centres.map(|centre| {
        let into = centre - ends[0];
        (into - along * into.dot(along)).normalize_or_zero()
    });
    let u = -intos.next()?;
    let v = along.cross(u);
    let half = 0.5 * std::f64::consts::PI;
    let [mut low, mut high] = [-half, half];
    for into in intos {
        let angle = (-into.dot(v)).atan2(-into.dot(u));
        (low, high) = (low.max(angle - half), high.min(angle + half));
    }
    (high - low > FLAT).then_some(([u, v], [low, high]))
}

/// Directions around a corner, and the sum of those away from them; nothing where the corner is flat.
fn tip<'a>(point: DVec3, owners: impl Iterator<Item = (&'a Triangle, usize)>) -> Option<(Vec<DVec3>, DVec3)> {
    let (mut around, mut sum) = (Vec::new(), DVec3::ZERO);
    for (triangle, k) in owners {
        let [a, b] = [1, 2].map(|next| (triangle.corners[(k + next) % 3] - point).normalize_or_zero());
        // The mean direction of the wedge times its angle: however a plane is cut, its wedges cancel.
        sum += (a + b) * ((1.0 - a.dot(b)) / (1.0 + a.dot(b))).max(0.0).sqrt();
        for direction in [a, b] {
            if !around.iter().any(|other: &DVec3| other.distance_squared(direction) < FLAT * FLAT) {
                around.push(direction);
            }
        }
    }
    (sum.length() > FLAT).then_some((around, -sum))
}
