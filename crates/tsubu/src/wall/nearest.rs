//! Where a wall is nearest to a grain.

use glam::DVec3;

/// The part of an element on which the nearest point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Inside the surface.
    Face,
    /// On a border: edge k of a triangle goes from corner k to the next; rim 0 or 1 of a cylinder or cone.
    Edge(u8),
    /// A corner of a triangle, or the tip 0 or 1 of a cone.
    Corner(u8),
}

/// The nearest point of one element to a grain's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance of the centre from the surface [m]; planes are half-spaces, so theirs is negative behind them.
    pub distance: f64,
    /// Unit normal from the surface towards the centre (for planes: theirs).
    pub normal: DVec3,
    /// The nearest point [m].
    pub point: DVec3,
    /// Where on the element that is.
    pub feature: Feature,
}

impl Nearest {
    /// To a smooth place of a surface, whose normal is known better than a difference of points would tell:
    /// `signed` is the distance along `normal` [m].
    pub(super) fn face(centre: DVec3, normal: DVec3, signed: f64) -> Self {
        let point = centre - normal * signed;
        let normal = if signed < 0.0 { -normal } else { normal };
        Self { distance: signed.abs(), normal, point, feature: Feature::Face }
    }

    /// To a point of a border; `fallback` is the normal when the centre lies on that very point.
    pub(super) fn border(centre: DVec3, point: DVec3, fallback: DVec3, feature: Feature) -> Self {
        let away = centre - point;
        let distance = away.length();
        let normal = if distance > 0.0 { away / distance } else { fallback };
        Self { distance, normal, point, feature }
    }

    /// Nothing near: an element that does not face the grain.
    pub(super) fn nothing(centre: DVec3) -> Self {
        Self { distance: f64::INFINITY, normal: DVec3::Z, point: centre, feature: Feature::Face }
    }
}

/// One element of a wall that a grain touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Index of the element in its wall.
    pub element: u32,
    /// Where it is nearest.
    pub nearest: Nearest,
    /// Whether it is a contact of its own; see [`Wall::distinct`](super::Wall::distinct).
    pub(super) own: bool,
}

impl Touch {
    /// A touch that is not judged yet.
    pub fn new(element: u32, nearest: Nearest) -> Self {
        Self { element, nearest, own: true }
    }
}
