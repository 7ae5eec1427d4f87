//! Kernels: how a grain is smeared out into a field, in one, two or three dimensions.
//!
//! A kernel phi(r) has the integral 1. A contact is smeared along its branch: the integral of phi(x - a - s b) over s from
//! 0 to 1, in closed form for both kernels.

use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use tsubu_scene::plan;

/// Widths after which nothing is left of a Gaussian: the mass beyond is below 1e-13 of the whole.
const GAUSS_REACH: f64 = 8.0;

/// Branches shorter than this, in widths, are summed at three points: the closed forms would subtract near equals.
const SHORT: f64 = 1e-4;

/// Nodes and weights of Gauss and Legendre on (0, 1).
const NODES: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// A kernel of some width in some number of dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    shape: plan::Kernel,
    width: f64,
    norm: f64,
}

impl Kernel {
    /// `width` [m]: standard deviation of the Gaussian, reach of Lucy's.
    pub fn new(shape: plan::Kernel, width: f64, dimensions: usize) -> Self {
        let norm = match (shape, dimensions) {
            (plan::Kernel::Gaussian, n) => (2.0 * PI * width * width).powf(-0.5 * n as f64),
            (plan::Kernel::Lucy, 1) => 1.25 / width,
            (plan::Kernel::Lucy, 2) => 5.0 / (PI * width * width),
            (plan::Kernel::Lucy, _) => 105.0 / (16.0 * PI * width.powi(3)),
        };
        Self { shape, width, norm }
    }

    /// Where it ends [m].
    pub fn reach(&self) -> f64 {
        match self.shape {
            plan::Kernel::Gaussian => GAUSS_REACH * self.width,
            plan::Kernel::Lucy => self.width,
        }
    }

    /// phi at a distance given by its square [m^2].
    #[inline]
    pub fn value(&self, squared: f64) -> f64 {
        let q2 = squared / (self.width * self.width);
        match self.shape {
            plan::Kernel::Gaussian if q2 > GAUSS_REACH * GAUSS_REACH => 0.0,
            plan::Kernel::Gaussian => self.norm * (-0.5 * q2).exp(),
            plan::Kernel::Lucy if q2 >= 1.0 => 0.0,
            plan::Kernel::Lucy => {
                let q = q2.sqrt();
                self.norm * (1.0 + 3.0 * q) * (1.0 - q).powi(3)
            }
        }
    }

    /// Mean of phi(x - s b) over s from 0 to 1: a point at `x` from the beginning of a branch `b` [m].
    pub fn line(&self, x: DVec3, b: DVec3) -> f64 {
        let length = b.length();
        if length < SHORT * self.width {
            return NODES.iter().map(|(s, weight)| weight * self.value((x - *s * b).length_squared())).sum();
        }
        let along = x.dot(b) / length;
        let apart = (x.length_squared() - along * along).max(0.0);
        match self.shape {
            plan::Kernel::Gaussian => {
                let w = self.width;
                let step = |u: f64| libm::erf(u / w * FRAC_1_SQRT_2);
                let across = (-0.5 * apart / (w * w)).exp();
                self.norm * across * w / length * (0.5 * PI).sqrt() * (step(along) - step(along - length))
            }
            plan::Kernel::Lucy => {
                let half = self.width * self.width - apart;
                if half <= 0.0 {
                    return 0.0;
                }
                let half = half.sqrt();
                let (from, to) = ((along - length).max(-half), along.min(half));
                if from >= to {
                    return 0.0;
                }
                self.norm * (lucy(apart, to, self.width) - lucy(apart, from, self.width)) / length
            }
        }
    }
}

/// Integral from 0 to t of 1 - 6 q^2 + 8 q^3 - 3 q^4 with q^2 = (apart + t^2) / c^2.
fn lucy(apart: f64, t: f64, c: f64) -> f64 {
    let r = (apart + t * t).sqrt();
    let second = apart * t + t.powi(3) / 3.0;
    let p = apart.sqrt();
    // On the line itself the logarithm is infinite, and its factor zero.
    let log = if p > 1e-9 * c { 0.375 * apart * apart * (t / p).asinh() } else { 0.0 };
    let third = 0.25 * t * r.powi(3) + 0.375 * apart * t * r + log;
    let fourth = apart * apart * t + 2.0 / 3.0 * apart * t.powi(3) + 0.2 * t.powi(5);
    t - 6.0 * second / c.powi(2) + 8.0 * third / c.powi(3) - 3.0 * fourth / c.powi(4)
}
