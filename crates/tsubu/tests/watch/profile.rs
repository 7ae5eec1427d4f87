//! Slices: every grain's volume is in them once, means are those of the grains.

use super::{Ball, ball, column, near, once, scalar, shaken, touching, view, watch};
use glam::DVec3;
use std::f64::consts::PI;

#[test]
fn slices_share_out_all_the_volume() {
    let all = "quantities = [\"solid-fraction\", \"velocity\", \"granular-temperature\", \"coordination\"]";
    for (dimension, region, volume) in [
        (2, "low = [-2, -1], high = [2, 2]", PI * 0.09),
        (3, "low = [-2, -2, -1], high = [2, 2, 2]", 4.0 / 3.0 * PI * 0.027),
    ] {
        for bins in [1, 7, 40] {
            let mut profile =
                watch(dimension, &format!("profile = {{ bins = {bins}, {all}, region = {{ {region} }} }}"));
            let balls: Vec<Ball> = (0..5).map(|k| ball(shaken(k), 0.0, shaken(k + 9), 0.3)).collect();
            let sample = once(&mut *profile, &view(&balls, Vec::new(), [None; 3]));
            let slice = 3.0 / f64::from(bins) * if dimension == 2 { 4.0 } else { 16.0 };
            let filled: f64 = column(&*profile, &sample, "solid fraction").iter().sum::<f64>() * slice;
            assert!(near(filled, 5.0 * volume, 1e-12), "{dimension} {bins}: {filled}");
            let whole = scalar(&*profile, &sample, "solid fraction");
            assert!(near(whole * slice * f64::from(bins), filled, 1e-12));
        }
    }
}

/// A periodic axis: what sticks out at the top comes in at the bottom.
#[test]
fn slices_wrap() {
    let text = "profile = { bins = 10, region = { low = [0, 0], high = [1, 1] } }";
    let mut profile = watch(2, text);
    let ends = [None, None, Some([0.0, 1.0])];
    let balls = [ball(0.5, 0.0, 0.98, 0.1)];
    let mut low = |ends| {
        let sample = once(&mut *profile, &view(&balls, Vec::new(), ends));
        column(&*profile, &sample, "solid fraction")[0]
    };
    assert!(low(ends) > 0.1);
    assert_eq!(low([None; 3]), 0.0, "the control: a world that ends");
}

/// v = (3 z, 0): every slice has the speed of its middle and, about it, the temperature of uniform shear in a slice.
#[test]
fn shear_is_seen_as_it_is() {
    let balls: Vec<Ball> = (0..200_usize)
        .map(|k| {
            let z = (k as f64 + 0.5) / 200.0;
            Ball { velocity: DVec3::new(3.0 * z, 0.0, 0.0), ..ball(0.5, 0.0, z, 1e-5) }
        })
        .collect();
    let mut profile = watch(2, "profile = { bins = 4, region = { low = [0, 0], high = [1, 1] } }");
    let sample = once(&mut *profile, &view(&balls, Vec::new(), [None; 3]));
    let (z, v) = (column(&*profile, &sample, "z"), column(&*profile, &sample, "velocity x"));
    for (z, v) in z.iter().zip(&v) {
        assert!(near(*v, 3.0 * z, 1e-9), "{z}: {v}");
    }
    let temperature = column(&*profile, &sample, "granular temperature")[1];
    // (3 / 4)^2 / 12 for a uniform distribution of 50 values, over two directions.
    let exact = 0.5 * (0.75_f64.powi(2) / 12.0) * (1.0 - 1.0 / 2500.0);
    assert!(near(temperature, exact, 1e-9), "{temperature} {exact}");
    // The control: about the mean of the whole it would be far more.
    assert!(!near(temperature, 0.5 * 9.0 / 12.0, 0.5));
}

#[test]
fn coordination_is_that_of_the_lattice() {
    let ends = [Some([0.0, 4.0]), None, Some([0.0, 4.0])];
    let balls: Vec<Ball> = (0..16_usize).map(|k| ball((k % 4) as f64 + 0.5, 0.0, (k / 4) as f64 + 0.5, 0.5)).collect();
    let mut profile =
        watch(2, "profile = { bins = 3, quantities = [\"coordination\"], region = { low = [0, 0], high = [4, 4] } }");
    let sample = once(&mut *profile, &view(&balls, touching(&balls, ends, 1.0), ends));
    assert!(column(&*profile, &sample, "coordination").iter().all(|z| near(*z, 4.0, 1e-12)), "{sample:?}");
    let sample = once(&mut *profile, &view(&balls, touching(&balls, [None; 3], 1.0), ends));
    assert!(scalar(&*profile, &sample, "coordination") < 3.5, "the control: no contacts across the ends");
}

/// Large grains weigh more in the mean spin, as m r^2; frozen ones not at all.
#[test]
fn spins_are_weighed_by_inertia() {
    let region = "region = { low = [0, 0], high = [4, 4] }";
    let text = format!("profile = {{ bins = 2, quantities = [\"spin\"], {region} }}");
    let mut balls =
        [ball(1.0, 0.0, 1.0, 0.1), ball(2.0, 0.0, 1.0, 0.2), ball(3.0, 0.0, 1.0, 0.1), ball(1.0, 0.0, 3.0, 0.1)];
    (balls[1].mass, balls[2].free) = (8.0, false);
    let mut shown = view(&balls, Vec::new(), [None; 3]);
    shown.grains.spin = [3.0, -1.0, 100.0, 5.0].map(|w| DVec3::new(0.0, w, 0.0)).to_vec().into();
    let mut profile = watch(2, &text);
    assert!(profile.wants().spins);
    let sample = once(&mut *profile, &shown);
    let spins = column(&*profile, &sample, "spin y");
    let exact = (0.01 * 3.0 - 0.32) / (0.01 + 0.32);
    assert!(near(spins[0], exact, 1e-12) && near(spins[1], 5.0, 1e-12), "{spins:?}");
    assert!(!near(spins[0], 1.0, 0.1), "the control: not the plain mean");
    let mut space = watch(3, &text.replace("[0, 0]", "[0, -1, 0]").replace("[4, 4]", "[4, 1, 4]"));
    let sample = once(&mut *space, &shown);
    assert!(near(scalar(&*space, &sample, "spin y"), (0.01 * 8.0 - 0.32) / 0.34, 1e-12));
}
