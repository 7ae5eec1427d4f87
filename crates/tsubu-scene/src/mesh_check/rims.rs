//! Rims: the lines that the open edges of a mesh make.

use super::{NO_ENDS, length, wider};
use crate::plan::Vector;
use std::collections::BTreeMap;

/// Open edges that share corners make one rim.
pub(super) struct Rims {
    parent: Vec<usize>,
    /// Open edges at each corner.
    edges_at: Vec<usize>,
    /// Each open edge by a corner, and its ends.
    edges: Vec<(usize, [Vector; 2])>,
}

/// One of them.
pub(super) struct Rim {
    pub(super) edges: usize,
    /// Every corner has two edges.
    pub(super) closed: bool,
    ends: [Vector; 2],
    /// Its largest extent.
    pub(super) size: f64,
    /// The smaller of the two extents of a line that lies level, or nearly so: what is thicker does not pass.
    pub(super) width: f64,
}

impl Rims {
    pub(super) fn new(corners: usize) -> Self {
        Self { parent: (0..corners).collect(), edges_at: vec![0; corners], edges: Vec::new() }
    }

    fn root(&mut self, mut corner: usize) -> usize {
        while self.parent[corner] != corner {
            self.parent[corner] = self.parent[self.parent[corner]];
            corner = self.parent[corner];
        }
        corner
    }

    pub(super) fn join(&mut self, [a, b]: [usize; 2], edge: [Vector; 2]) {
        self.edges.push((a, edge));
        self.edges_at[a] += 1;
        self.edges_at[b] += 1;
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a] = b;
    }

    pub(super) fn all(&mut self) -> Vec<Rim> {
        let mut rims: BTreeMap<usize, Rim> = BTreeMap::new();
        for (corner, edge) in std::mem::take(&mut self.edges) {
            let root = self.root(corner);
            let rim = rims.entry(root).or_insert(Rim { edges: 0, closed: true, ends: NO_ENDS, size: 0.0, width: 0.0 });
            rim.edges += 1;
            rim.ends = edge.into_iter().fold(rim.ends, wider);
            let mut extents = length(rim.ends);
            extents.sort_by(f64::total_cmp);
            [_, rim.width, rim.size] = extents;
        }
        for corner in 0..self.parent.len() {
            let root = self.root(corner);
            if let Some(rim) = rims.get_mut(&root) {
                rim.closed &= self.edges_at[corner] == 2;
            }
        }
        rims.into_values().collect()
    }
}
