//! Pairs that are near enough to touch before the list is made again.
//!
//! The list holds every pair whose gap is below the skin; it is good until some grain has moved half the skin. Pairs are
//! sorted, so that the touching ones among them are met in the same order whatever else is in the list. Above `SMALL`
//! grains a search also sorts the grains, so there the skin decides when their order changes, and with it the last bits.

use super::grid::Grid;
use crate::state::Grains;
use crate::wall::Plane;
use glam::DVec3;

/// Below this many grains all pairs are looked at: a grid would cost more than it saves, and nothing needs sorting.
const SMALL: usize = 96;

/// Candidate pairs, and where the grains were when they were found.
#[derive(Clone, Debug, Default)]
pub struct Candidates {
    /// Grain-grain pairs (first < second), sorted.
    pub pairs: Vec<[u32; 2]>,
    /// Grain-plane pairs, sorted.
    pub walls: Vec<[u32; 2]>,
    /// Positions at the time of the search.
    pub reference: Vec<DVec3>,
    /// Displacements of the planes at the time of the search.
    pub plane_reference: Vec<DVec3>,
    grid: Grid,
}

impl Candidates {
    /// Whether the list may miss a touching pair.
    pub fn stale(&self, grains: &Grains, planes: &[Plane], skin: f64) -> bool {
        let mut farthest: f64 = 0.0;
        let mut sum = 0.0;
        for (p, r) in grains.position.iter().zip(&self.reference) {
            let d = (*p - *r).length_squared();
            farthest = farthest.max(d);
            sum += d;
        }
        let farthest = farthest.sqrt();
        let planes_moved = planes
            .iter()
            .zip(&self.plane_reference)
            .map(|(plane, r)| (plane.displacement - *r).dot(plane.normal).abs())
            .fold(0.0, f64::max);
        // The sum catches what max() hides: a coordinate that is no longer a number.
        self.reference.len() != grains.len()
            || !sum.is_finite()
            || 2.0 * farthest > skin
            || farthest + planes_moved > skin
    }

    /// Whether grains should be put in the order of their cells before the search.
    pub fn sorts(grains: &Grains) -> bool {
        grains.len() > SMALL
    }

    /// The order of cells for the present positions.
    pub fn order(&mut self, grains: &Grains, reach: f64) -> &[u32] {
        self.grid.fill(&grains.position, reach);
        self.grid.order()
    }

    /// Makes the list for the present positions; `reach` is the largest diameter plus the skin.
    pub fn search(&mut self, grains: &Grains, planes: &[Plane], skin: f64, reach: f64) {
        self.reference.clone_from(&grains.position);
        self.plane_reference = planes.iter().map(|p| p.displacement).collect();
        self.list(grains, planes, skin, reach);
    }

    /// Makes the list again as it was made at the remembered positions: after a resume nothing may differ.
    pub fn list(&mut self, grains: &Grains, planes: &[Plane], skin: f64, reach: f64) {
        let Self { pairs, walls, reference, plane_reference, grid } = self;
        let position = &*reference;
        pairs.clear();
        let mut meet = |a: u32, b: u32| {
            let limit = grains.radius[a as usize] + grains.radius[b as usize] + skin;
            if position[a as usize].distance_squared(position[b as usize]) < limit * limit {
                pairs.push([a.min(b), a.max(b)]);
            }
        };
        if grains.len() > SMALL {
            grid.fill(position, reach);
            grid.pairs(meet);
            pairs.sort_unstable();
        } else {
            for a in 0..grains.len() as u32 {
                for b in a + 1..grains.len() as u32 {
                    meet(a, b);
                }
            }
        }
        walls.clear();
        for (i, p) in position.iter().enumerate() {
            for (k, (plane, displacement)) in planes.iter().zip(&*plane_reference).enumerate() {
                if (*p - plane.point - *displacement).dot(plane.normal) < grains.radius[i] + skin {
                    walls.push([i as u32, k as u32]);
                }
            }
        }
    }
}
