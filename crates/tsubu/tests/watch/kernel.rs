//! Kernels have the integral 1, and closed forms along branches agree with sums over points of them.

use super::shaken;
use glam::DVec3;
use std::f64::consts::PI;
use tsubu::watch::kernel::Kernel;
use tsubu_scene::plan;

const BOTH: [plan::Kernel; 2] = [plan::Kernel::Gaussian, plan::Kernel::Lucy];

/// Mean of a function over (0, 1) by Simpson's rule.
fn mean(f: impl Fn(f64) -> f64) -> f64 {
    let n = 4000;
    let weight = |k: usize| {
        if k == 0 || k == n {
            1.0
        } else if k.is_multiple_of(2) {
            2.0
        } else {
            4.0
        }
    };
    (0..=n).map(|k| weight(k) * f(k as f64 / n as f64)).sum::<f64>() / (3.0 * n as f64)
}

#[test]
fn the_integral_is_one_in_any_dimension() {
    for shape in BOTH {
        for dimensions in 1..=3 {
            let kernel = Kernel::new(shape, 0.7, dimensions);
            let integral = |from: usize| {
                let shell = |r: f64| [2.0, 2.0 * PI * r, 4.0 * PI * r * r][from - 1];
                let reach = kernel.reach();
                reach * mean(|s| shell(s * reach) * kernel.value((s * reach).powi(2)))
            };
            let whole = integral(dimensions);
            assert!((whole - 1.0).abs() < 1e-11, "{shape:?} {dimensions}: {whole}");
            // The control: shells of another dimension.
            assert!((integral(dimensions % 3 + 1) - 1.0).abs() > 0.1);
        }
    }
}

#[test]
fn branches_are_integrated_in_closed_form() {
    for shape in BOTH {
        let kernel = Kernel::new(shape, 0.7, 2);
        let mut by_middle = 0.0_f64;
        for k in 0..60 {
            let [a, b, c] = [0, 1, 2].map(|m| shaken(3 * k + m));
            let x = DVec3::new(a - 0.3, 0.0, b - 0.2);
            // From long branches down to those that are almost points.
            let branch = DVec3::new(c, 0.0, a - c) * 10f64.powi(-(k as i32 % 6));
            let closed = kernel.line(x, branch);
            let summed = mean(|s| kernel.value((x - s * branch).length_squared()));
            assert!((closed - summed).abs() < 2e-10 * kernel.value(0.0), "{shape:?} {k}: {closed} {summed}");
            let middle = kernel.value((x - 0.5 * branch).length_squared());
            by_middle = by_middle.max((middle - summed).abs() / kernel.value(0.0));
        }
        // The control: the value at the middle will not do.
        assert!(by_middle > 0.05, "{by_middle}");
    }
}

#[test]
fn a_branch_through_the_point_itself_has_no_singularity() {
    let kernel = Kernel::new(plan::Kernel::Lucy, 1.0, 3);
    let branch = DVec3::new(0.0, 0.0, 1.2);
    for t in [0.0, 0.3, 0.6, 1.2] {
        let closed = kernel.line(DVec3::new(0.0, 0.0, t), branch);
        let summed = mean(|s| kernel.value((t - 1.2 * s).powi(2)));
        assert!((closed - summed).abs() < 1e-9 * kernel.value(0.0), "{t}: {closed} {summed}");
    }
}
