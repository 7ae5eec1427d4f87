//! Where two bodies touch.

use super::Turned;
use super::crossing::{CROWN, Edge, nearest};
use glam::DVec3;

/// A contact of two features.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Which features, see [`turned_feature`].
    pub feature: u32,
    /// The point of each core, from the centre of its body [m].
    pub points: [DVec3; 2],
    /// Overlap, below 0 where there is a gap [m].
    pub overlap: f64,
    /// Unit normal from the first to the second.
    pub normal: DVec3,
    /// How much the overlap grows as the points come nearer: 1, and a little less where edges cross that lie back.
    pub share: f64,
}

/// Marks an edge.
const EDGE: u32 = 0x8000;

/// The number of a feature of the first body in the upper half, of the second in the lower: of a corner its number from 1, of an edge that from [`EDGE`], 0 for the whole core.
fn feature(first: u32, second: u32) -> u32 {
    first << 16 | second
}

/// The same pair of features where both bodies have changed places.
pub fn turned_feature(feature: u32) -> u32 {
    feature.rotate_left(16)
}

/// Memory of a search.
#[derive(Clone, Debug, Default)]
pub struct Search {
    heights: Vec<f64>,
    edges: Vec<Edge>,
}

/// The face from which the other body is farthest, and how far.
struct Axis {
    face: usize,
    height: f64,
}

impl Turned<'_> {
    /// Which face of this body separates it most from another, `apart` [m] away; nothing where one does by more than `cut` [m].
    fn separating(&self, other: &Self, apart: DVec3, cut: f64) -> Option<Axis> {
        let mut axis = Axis { face: 0, height: f64::NEG_INFINITY };
        for face in 0..self.normals.len() {
            // The centre of the other is not below its corners.
            let centre = self.above(face, apart);
            if centre > axis.height {
                let height = centre + other.lowest(self.normals[face]);
                if height >= cut {
                    return None;
                }
                if height > axis.height {
                    axis = Axis { face, height };
                }
            }
        }
        Some(axis)
    }

    /// Appends the edges of which a part within `within` of their middle, over their length, is nearer than `margin` [m] to the end of the body along a direction.
    fn edges_towards(&self, n: DVec3, margin: f64, within: f64, heights: &mut Vec<f64>, edges: &mut Vec<Edge>) {
        heights.clear();
        heights.extend(self.corners().map(|(_, corner)| n.dot(corner)));
        let least = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - margin;
        for (number, [a, b]) in self.shape.edges.iter().enumerate() {
            let (p, q) = (heights[*a], heights[*b]);
            if 0.5 * (p + q) + within * (p - q).abs() >= least {
                let (a, b) = (self.corner(*a), self.corner(*b));
                let way = b - a;
                edges.push(Edge { number, middle: (a + b) * 0.5, way, squared: way.length_squared() });
            }
        }
    }
}

/// Appends where two bodies touch, or are nearer than `reach` [m]; the centre of the second is `apart` [m] from that of the first. In the order of features.
pub fn touch(bodies: [&Turned; 2], apart: DVec3, reach: f64, search: &mut Search, found: &mut Vec<Contact>) {
    let [a, b] = bodies;
    let radii = a.rounding + b.rounding;
    let cut = radii + reach;
    let Some(first) = a.separating(b, apart, cut) else { return };
    let Some(second) = b.separating(a, -apart, cut) else { return };
    if !a.normals.is_empty() {
        for (i, corner) in b.corners() {
            let point = apart + corner;
            if a.above(first.face, point) < cut
                && let Some((distance, away)) = a.distance(point, cut)
            {
                let points = [point - away * distance, corner];
                let feature = feature(0, i as u32 + 1);
                found.push(Contact { feature, points, overlap: radii - distance, normal: away, share: 1.0 });
            }
        }
    }
    if b.normals.is_empty() {
        return;
    }
    for (i, corner) in a.corners() {
        let point = corner - apart;
        if b.above(second.face, point) < cut
            && let Some((distance, away)) = b.distance(point, cut)
        {
            let points = [corner, point - away * distance];
            let feature = feature(i as u32 + 1, 0);
            found.push(Contact { feature, points, overlap: radii - distance, normal: -away, share: 1.0 });
        }
    }
    if a.shape.edges.is_empty() || b.shape.edges.is_empty() {
        return;
    }
    let (n, height) = if first.height > second.height {
        (a.normals[first.face], first.height)
    } else {
        (-b.normals[second.face], second.height)
    };
    crossings(bodies, apart, (n, height), (radii, cut), search, found);
}

/// Appends the edges that cross. `n` is a direction from the first to the second along which the cores are `height` [m] apart.
fn crossings(
    [a, b]: [&Turned; 2],
    apart: DVec3,
    (n, height): (DVec3, f64),
    (radii, cut): (f64, f64),
    search: &mut Search,
    found: &mut Vec<Contact>,
) {
    let Search { heights, edges } = search;
    // What is lower than this below the end of a body is too far from the other; and what lies back so far.
    let back = 8.0 * CROWN * radii * radii;
    let deepest = height.max(0.0);
    let within = ((cut * cut - deepest * deepest) / back).sqrt().min(0.5);
    edges.clear();
    a.edges_towards(n, cut - height, within, heights, edges);
    let count = edges.len();
    b.edges_towards(-n, cut - height, within, heights, edges);
    let (of_a, of_b) = edges.split_at_mut(count);
    for edge in of_b.iter_mut() {
        edge.middle += apart;
    }
    for p in of_a.iter() {
        for q in of_b.iter() {
            let (points, squared) = nearest(p, q, back);
            if squared >= cut * cut {
                continue;
            }
            let (way, distance) = (points[1] - points[0], squared.sqrt());
            let between = way.length();
            found.push(Contact {
                feature: feature(EDGE | p.number as u32, EDGE | q.number as u32),
                points: [points[0], points[1] - apart],
                overlap: radii - distance,
                normal: way / (between + f64::MIN_POSITIVE),
                share: between / distance,
            });
        }
    }
}
