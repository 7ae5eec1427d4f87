//! Convex bodies with rounded edges, in space or in the plane y = 0: from corners or faces to what is within, and around.
//!
//! A body is drawn with sharp edges. Rolling a ball of the rounding radius inside it leaves the faces where they are and rounds edges and corners: what is left is
//! the core, the body with every face moved inwards by the radius, and all that is nearer to the core than that (the opening of Serra 1982; Alonso-Marroquin 2008).

mod measured;

pub(crate) use measured::measured;

use nalgebra::{Matrix3, Vector3};

/// Most corners that a body may have: contacts cost what their number says.
pub(crate) const MOST_CORNERS: usize = 64;
/// Most faces, twice as many as corners less four.
pub(crate) const MOST_FACES: usize = 124;

/// Lengths below this share of the size of a body are rounding.
const SAME: f64 = 1e-9;
/// Normals that differ by less are one.
const PARALLEL: f64 = 1e-7;

type Point = Vector3<f64>;

/// A plane: unit normal outwards, and its distance from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    pub normal: Point,
    pub offset: f64,
}

/// A face: its plane, and its corners the way round that is counter-clockwise from outside. In the plane a side with two.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Face {
    pub plane: Plane,
    pub corners: Vec<usize>,
}

/// A convex body with sharp edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Core {
    pub corners: Vec<Point>,
    pub faces: Vec<Face>,
}

/// Why corners are no body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Flaw {
    /// There are fewer than a body needs.
    Few(usize),
    /// All are in one plane, or on one line.
    Flat,
    /// Two are in one place.
    Twice(usize, usize),
    /// One lies within the body of the others, on a face or on an edge of it.
    Within(usize),
}

impl Plane {
    /// How far a point is above it.
    pub fn above(&self, point: &Point) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// The greatest distance of one of the points from their middle.
pub(crate) fn size(points: &[Point]) -> f64 {
    let middle = points.iter().sum::<Point>() / points.len().max(1) as f64;
    points.iter().map(|point| (point - middle).norm()).fold(0.0, f64::max)
}

/// A direction across another, to the left of it seen against y: outwards where corners go round counter-clockwise with x to the right and z up.
fn across(way: &Point) -> Point {
    Point::new(way.z, 0.0, -way.x)
}

/// The faces of the convex body that has these corners.
pub(crate) fn faces(corners: &[Point], space: bool) -> Result<Vec<Plane>, Flaw> {
    let needs = if space { 4 } else { 3 };
    if corners.len() < needs {
        return Err(Flaw::Few(corners.len()));
    }
    let tolerance = SAME * size(corners);
    for (j, b) in corners.iter().enumerate() {
        if let Some(i) = corners[..j].iter().position(|a| (a - b).norm() <= tolerance) {
            return Err(Flaw::Twice(i, j));
        }
    }
    let mut planes: Vec<Plane> = Vec::new();
    let mut flat = true;
    let mut consider = |normal: Point, at: &Point| {
        let length = normal.norm();
        if length <= tolerance * tolerance {
            return;
        }
        let normal = normal / length;
        let heights = || corners.iter().map(|corner| normal.dot(&(corner - at)));
        let (low, high) = (heights().fold(0.0, f64::min), heights().fold(0.0, f64::max));
        flat &= high - low <= 2.0 * tolerance;
        for (sign, out) in [(1.0, high), (-1.0, -low)] {
            let plane = Plane { normal: normal * sign, offset: sign * normal.dot(at) };
            let same = |other: &Plane| {
                (other.normal - plane.normal).norm() < PARALLEL
                    && (other.offset - plane.offset).abs() <= 4.0 * tolerance
            };
            if out <= tolerance && !planes.iter().any(same) {
                planes.push(plane);
            }
        }
    };
    for (k, c) in corners.iter().enumerate() {
        for (j, b) in corners[..k].iter().enumerate() {
            if space {
                corners[..j].iter().for_each(|a| consider((b - a).cross(&(c - a)), a));
            } else {
                consider(across(&(c - b)), b);
            }
        }
    }
    if flat {
        return Err(Flaw::Flat);
    }
    let on = |corner: &Point| planes.iter().filter(|plane| plane.above(corner) >= -4.0 * tolerance).count();
    match corners.iter().position(|corner| on(corner) < needs - 1) {
        Some(within) => Err(Flaw::Within(within)),
        None => Ok(planes),
    }
}

/// Of a polygon, a corner where the way from one to the next does not go round it.
pub(crate) fn crossing(corners: &[Point]) -> Option<usize> {
    let count = corners.len();
    let turn = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % count]);
        across(&(b - a)).dot(&(c - b))
    };
    let way = turn(0).signum();
    // A star turns one way all along, and more than once round.
    let middle = corners.iter().sum::<Point>() / count as f64;
    let angle = |k: usize| {
        let [a, b] = [0, 1].map(|i| corners[(k + i) % count] - middle);
        across(&a).dot(&b).atan2(a.dot(&b))
    };
    let round: f64 = (0..count).map(angle).sum();
    let once = (round.abs() - std::f64::consts::TAU).abs() < 1e-3;
    (0..count).find(|k| turn(*k) * way <= 0.0).map(|k| (k + 1) % count).or((!once).then_some(0))
}

/// What lies behind all planes moved inwards by `by`; `None` where nothing is left that has a volume.
pub(crate) fn core(planes: &[Plane], by: f64, space: bool) -> Option<Core> {
    let planes: Vec<Plane> = planes.iter().map(|plane| Plane { offset: plane.offset - by, ..*plane }).collect();
    let extent = planes.iter().map(|plane| plane.offset.abs()).fold(by, f64::max);
    let tolerance = SAME * extent;
    let mut corners: Vec<Point> = Vec::new();
    let mut consider = |three: [&Plane; 3]| {
        let rows = Matrix3::from_rows(&three.map(|plane| plane.normal.transpose()));
        if rows.determinant().abs() < PARALLEL {
            return;
        }
        let Some(inverse) = rows.try_inverse() else { return };
        let point = inverse * Point::from(three.map(|plane| plane.offset));
        let inside = planes.iter().all(|plane| plane.above(&point) <= tolerance);
        if inside && corners.iter().all(|corner| (corner - point).norm() > 8.0 * tolerance) {
            corners.push(point);
        }
    };
    let level = Plane { normal: Point::y(), offset: 0.0 };
    for (k, c) in planes.iter().enumerate() {
        for (j, b) in planes[..k].iter().enumerate() {
            if space {
                planes[..j].iter().for_each(|a| consider([a, b, c]));
            } else {
                consider([b, c, &level]);
            }
        }
    }
    let faces: Vec<Face> = planes.iter().filter_map(|plane| face(plane, &corners, tolerance, space)).collect();
    let (least, thick) = if space { (4, 8.0) } else { (3, 4.0) };
    let solid = faces.len() >= least
        && corners.len() >= least
        && planes.iter().all(|plane| corners.iter().any(|corner| plane.above(corner) < -thick * tolerance));
    solid.then_some(Core { corners, faces })
}

/// The corners on a plane in their order round it; `None` where they are no face.
fn face(plane: &Plane, corners: &[Point], tolerance: f64, space: bool) -> Option<Face> {
    let mut on: Vec<usize> =
        (0..corners.len()).filter(|i| plane.above(&corners[*i]).abs() <= 4.0 * tolerance).collect();
    if !space {
        let way = -across(&plane.normal);
        on.sort_by(|a, b| way.dot(&corners[*a]).total_cmp(&way.dot(&corners[*b])));
        return (on.len() == 2).then_some(Face { plane: *plane, corners: on });
    }
    if on.len() < 3 {
        return None;
    }
    let middle = on.iter().map(|i| corners[*i]).sum::<Point>() / on.len() as f64;
    round(&mut on, &plane.normal, |i| corners[i] - middle);
    Some(Face { plane: *plane, corners: on })
}

/// Sorts by the angle about an axis.
pub(crate) fn round(list: &mut [usize], axis: &Point, arm: impl Fn(usize) -> Point) {
    let Some(first) = list.first().map(|i| arm(*i)) else { return };
    let u = (first - axis * axis.dot(&first)).normalize();
    let v = axis.cross(&u);
    let angle = |i: &usize| {
        let arm = arm(*i);
        let angle = v.dot(&arm).atan2(u.dot(&arm));
        if angle < -1e-9 { angle + std::f64::consts::TAU } else { angle }
    };
    list.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
}

/// The largest rounding radius that leaves a core, to about a part in a million.
pub(crate) fn largest_rounding(planes: &[Plane], space: bool) -> f64 {
    let (mut low, mut high) = (0.0, planes.iter().map(|plane| plane.offset.abs()).fold(0.0, f64::max));
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if core(planes, middle, space).is_some() { low = middle } else { high = middle }
    }
    low
}

impl Core {
    /// Edges in space: their corners, and the normals of the two faces beside them.
    pub fn edges(&self) -> Vec<([usize; 2], [Point; 2])> {
        let mut edges: Vec<([usize; 2], [Point; 2])> = Vec::new();
        for (f, face) in self.faces.iter().enumerate().filter(|(_, face)| face.corners.len() > 2) {
            for (k, a) in face.corners.iter().enumerate() {
                let b = face.corners[(k + 1) % face.corners.len()];
                let back = |other: &Face| {
                    let count = other.corners.len();
                    (0..count).any(|i| (other.corners[i], other.corners[(i + 1) % count]) == (b, *a))
                };
                if let Some(other) = self.faces[..f].iter().find(|other| back(other)) {
                    edges.push(([*a, b], [face.plane.normal, other.plane.normal]));
                }
            }
        }
        edges
    }

    /// Moved, so that a point becomes the origin.
    pub fn about(mut self, centre: &Point) -> Self {
        self.corners.iter_mut().for_each(|corner| *corner -= centre);
        self.faces.iter_mut().for_each(|face| face.plane.offset -= face.plane.normal.dot(centre));
        self
    }
}
