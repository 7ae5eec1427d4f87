//! Where two bodies touch.

use super::Turned;
use super::contact::{Contact, EDGE, feature};
use super::crossing::{CROWN, Crossing, Edge};
use glam::DVec3;

/// Memory of a search.
#[derive(Clone, Debug, Default)]
pub struct Search {
    heights: Vec<f64>,
    /// Edges with their numbers.
    edges: Vec<(u32, Edge)>,
}

/// The face from which the other body is farthest, and how far.
struct Axis {
    face: usize,
    height: f64,
}

/// How near features count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// Sum of the rounding radii [m].
    pub radii: f64,
    /// Gap up to which bodies may hold each other [m].
    pub reach: f64,
}

impl Cut {
    /// Of two bodies.
    #[inline]
    pub fn of([a, b]: [&Turned; 2], reach: f64) -> Self {
        Self { radii: a.rounding + b.rounding, reach }
    }

    /// How far cores may be apart [m].
    #[inline]
    pub fn distance(self) -> f64 {
        self.radii + self.reach
    }

    /// A corner of one body at the core of the other, as the feature tells, or how far it is from being a contact at least [m]. `find` tells the distance of a point from the core, and the direction from that.
    #[inline]
    pub fn corner(
        self,
        bodies: [&Turned; 2],
        apart: DVec3,
        feature: u32,
        find: impl FnOnce(&Turned, DVec3) -> Result<(f64, DVec3), f64>,
    ) -> Result<Contact, f64> {
        let [first, second] = [feature >> 16, feature & 0xffff];
        // Of the second at the core of the first, or the other way round.
        let core = usize::from(first > 0);
        let sign = [1.0, -1.0][core];
        let corner = bodies[1 - core].corner((first | second) as usize - 1);
        let point = corner + apart * sign;
        let (distance, away) = find(bodies[core], point)?;
        let mut points = [point - away * distance; 2];
        points[1 - core] = corner;
        Ok(Contact { feature, points, overlap: self.radii - distance, normal: away * sign, share: 1.0 })
    }

    /// Two edges; that of the second from the centre of the first.
    fn crossing(self, (i, p): &(u32, Edge), (j, q): &(u32, Edge), apart: DVec3) -> Option<Contact> {
        let crossing = Crossing::of(p, q, self.radii);
        let cut = self.distance();
        (crossing.squared < cut * cut).then(|| crossing.contact(feature(EDGE | i, EDGE | j), apart, self.radii))
    }
}

impl Turned<'_> {
    /// Which face of this body separates it most from another, `apart` [m] away; an error where one does by more than `cut` [m], with how far.
    fn separating(&self, other: &Self, apart: DVec3, cut: f64) -> Result<Axis, f64> {
        let mut axis = Axis { face: 0, height: f64::NEG_INFINITY };
        for face in 0..self.faces() {
            // The centre of the other is not below its corners.
            let centre = self.above(face, apart);
            if centre > axis.height {
                let height = centre + other.lowest(self.normal(face));
                if height >= cut {
                    return Err(height);
                }
                if height > axis.height {
                    axis = Axis { face, height };
                }
            }
        }
        Ok(axis)
    }

    /// The ends of one of its edges [m].
    #[inline]
    pub(super) fn ends_of_edge(&self, number: usize) -> [DVec3; 2] {
        let [a, b] = self.shape.edges[number];
        [self.corner(a), self.corner(b)]
    }

    /// One of its edges.
    #[inline]
    pub(super) fn edge(&self, number: usize) -> Edge {
        Edge::between(self.ends_of_edge(number))
    }

    /// Appends the edges of which a part within `within` of their middle, over their length, is nearer than `margin` [m] to the end of the body along a direction.
    fn edges_towards(&self, n: DVec3, margin: f64, within: f64, heights: &mut Vec<f64>, edges: &mut Vec<(u32, Edge)>) {
        heights.clear();
        heights.extend(self.corners().map(|(_, corner)| n.dot(corner)));
        let least = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - margin;
        for (number, [a, b]) in self.shape.edges.iter().enumerate() {
            let (p, q) = (heights[*a], heights[*b]);
            if 0.5 * (p + q) + within * (p - q).abs() >= least {
                edges.push((number as u32, self.edge(number)));
            }
        }
    }
}

/// Appends where two bodies touch, or are nearer than `reach` [m]; the centre of the second is `apart` [m] from that of the first. In the order of features. Returns how far the bodies are from
/// being so near at least [m].
pub fn touch(bodies: [&Turned; 2], apart: DVec3, reach: f64, search: &mut Search, found: &mut Vec<Contact>) -> f64 {
    let [a, b] = bodies;
    let limit = Cut::of(bodies, reach);
    let cut = limit.distance();
    let axes = a.separating(b, apart, cut).and_then(|first| Ok([first, b.separating(a, -apart, cut)?]));
    let [first, second] = match axes {
        Ok(axes) => axes,
        Err(height) => return height - cut,
    };
    let at = |face: usize, feature: u32| {
        limit.corner(bodies, apart, feature, |core, point| core.distance_from(&mut (face as u32), point, cut))
    };
    if a.faces() > 0 {
        for (i, corner) in b.corners() {
            if a.above(first.face, apart + corner) < cut {
                found.extend(at(first.face, feature(0, i as u32 + 1)));
            }
        }
    }
    if b.faces() == 0 {
        return 0.0;
    }
    for (i, corner) in a.corners() {
        if b.above(second.face, corner - apart) < cut {
            found.extend(at(second.face, feature(i as u32 + 1, 0)));
        }
    }
    if a.shape.edges.is_empty() || b.shape.edges.is_empty() {
        return 0.0;
    }
    let (n, height) = if first.height > second.height {
        (a.normal(first.face), first.height)
    } else {
        (-b.normal(second.face), second.height)
    };
    crossings(bodies, apart, (n, height), limit, search, found);
    0.0
}

/// Appends the edges that cross. `n` is a direction from the first to the second along which the cores are `height` [m] apart.
fn crossings(
    [a, b]: [&Turned; 2],
    apart: DVec3,
    (n, height): (DVec3, f64),
    limit: Cut,
    search: &mut Search,
    found: &mut Vec<Contact>,
) {
    let Search { heights, edges } = search;
    let cut = limit.distance();
    // What is lower than this below the end of a body is too far from the other; and what lies back so far.
    let back = 8.0 * CROWN * limit.radii * limit.radii;
    let deepest = height.max(0.0);
    let within = ((cut * cut - deepest * deepest) / back).sqrt().min(0.5);
    edges.clear();
    a.edges_towards(n, cut - height, within, heights, edges);
    let count = edges.len();
    b.edges_towards(-n, cut - height, within, heights, edges);
    let (of_a, of_b) = edges.split_at_mut(count);
    for (_, edge) in of_b.iter_mut() {
        edge.middle += apart;
    }
    for p in of_a.iter() {
        found.extend(of_b.iter().filter_map(|q| limit.crossing(p, q, apart)));
    }
}
