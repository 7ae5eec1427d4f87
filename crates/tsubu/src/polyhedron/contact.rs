//! A contact of two bodies, and the features of theirs that touch.

use glam::DVec3;

/// A contact of two features.
#[derive(Clone, Copy, Debug, Default)]
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
pub(super) const EDGE: u32 = 0x8000;

/// The number of a feature of the first body in the upper half, of the second in the lower: of a corner its number from 1, of an edge that from [`EDGE`], 0 for the whole core.
pub(super) fn feature(first: u32, second: u32) -> u32 {
    first << 16 | second
}

/// The same pair of features where both bodies have changed places.
pub fn turned_feature(feature: u32) -> u32 {
    feature.rotate_left(16)
}

/// The numbers of two edges that are a pair of features; `None`: it is a corner and a core.
#[inline]
pub(super) fn edges_of(feature: u32) -> Option<[usize; 2]> {
    (feature & EDGE > 0).then(|| [feature >> 16, feature & 0xffff].map(|edge| (edge ^ EDGE) as usize))
}
