//! Layers: equal slices of the height, and how much of each the grains leave to the water.

use super::Parcel;
use crate::state::sphere;
use glam::DVec3;
use multiversion::multiversion;

/// Smallest share that grains are taken to leave to the water: in the plane deep overlaps could leave less than nothing.
const LEAST: f64 = 0.1;

/// Equal layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Height z where they begin [m].
    pub bottom: f64,
    /// Thickness of one [m].
    pub thickness: f64,
    /// Plan area [m^2].
    pub area: f64,
    /// Share of every layer that is water [-].
    pub porosity: Vec<f64>,
}

impl Layers {
    /// Layers without grains.
    pub fn new(bottom: f64, top: f64, count: usize, area: f64) -> Self {
        Self { bottom, thickness: (top - bottom) / count as f64, area, porosity: vec![1.0; count] }
    }

    /// Number of layers.
    pub fn len(&self) -> usize {
        self.porosity.len()
    }

    /// Whether there are none; never so in a plan.
    pub fn is_empty(&self) -> bool {
        self.porosity.is_empty()
    }

    /// Height of the middle of layer `k` [m].
    pub fn middle(&self, k: usize) -> f64 {
        self.bottom + (k as f64 + 0.5) * self.thickness
    }

    /// Height where they end [m].
    pub fn top(&self) -> f64 {
        self.bottom + self.len() as f64 * self.thickness
    }

    /// Volume of water in layer `k` over the plan area [m].
    pub fn water(&self, k: usize) -> f64 {
        self.porosity[k] * self.thickness
    }

    /// Volume of water in all of them over the plan area [m].
    pub fn volume(&self) -> f64 {
        (0..self.len()).map(|k| self.water(k)).sum()
    }

    /// Finds for every grain of a parcel the two layers whose middles are below and above it, and the share of the upper one;
    /// beyond the outer middles the outer layer alone. What a grain reads with these shares it also gives back with them.
    pub(super) fn find(&self, parcel: &mut Parcel) {
        find(parcel, self.bottom, 1.0 / self.thickness, self.len() as f64 - 1.0);
    }

    /// The same of one height: the lower layer, and the share of the upper one.
    pub(crate) fn at(&self, height: f64) -> (usize, f64) {
        let (below, share) = place(height, self.bottom, 1.0 / self.thickness, self.len() as f64 - 1.0);
        (below as usize, share)
    }

    /// What grains leave to the water: one minus the volumes of the spheres, cut by the layers, over the volume of a layer.
    pub fn measure(&self, position: &[DVec3], radius: &[f64]) -> Vec<f64> {
        let mut filled = vec![0.0; self.len()];
        let per_height = 1.0 / self.thickness;
        for (p, r) in position.iter().zip(radius) {
            let (volume, per_radius) = (sphere::volume(*r), 1.0 / r);
            let under = |level: f64| sphere::below((level - p.z) * per_radius);
            let layer = |z: f64| ((z - self.bottom) * per_height).clamp(0.0, self.len() as f64) as usize;
            let (first, last) = (layer(p.z - r), layer(p.z + r).min(self.len() - 1));
            let mut below = under(self.bottom + first as f64 * self.thickness);
            for (k, filled) in filled.iter_mut().enumerate().take(last + 1).skip(first) {
                let next = under(self.bottom + (k + 1) as f64 * self.thickness);
                *filled += (next - below) * volume;
                below = next;
            }
        }
        let layer = self.area * self.thickness;
        filled.iter().map(|filled| (1.0 - filled / layer).max(LEAST)).collect()
    }
}

#[multiversion(targets = "simd")]
fn find(p: &mut Parcel, bottom: f64, per_height: f64, last: f64) {
    for i in 0..p.rows() {
        (p.layer[i], p.share[i]) = place(p.height[i], bottom, per_height, last);
    }
}

/// The lower layer and the share of the upper one.
#[inline(always)]
fn place(height: f64, bottom: f64, per_height: f64, last: f64) -> (i32, f64) {
    // 2^52: with it a whole number stands in the last bits; a cast would look for numbers that are out of range.
    const WHOLE: f64 = 4_503_599_627_370_496.0;
    let at = ((height - bottom) * per_height - 0.5).clamp(0.0, last);
    // There are two layers or more. What is no number becomes the highest here, so that it finds one.
    let below = at.min(last - 1.0).floor();
    ((below + WHOLE).to_bits() as i32, at - below)
}
