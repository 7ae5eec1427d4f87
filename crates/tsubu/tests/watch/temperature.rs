//! Granular temperature: that of velocities whose spread is known, whatever the grains do together.

use super::{Ball, GROUPS, ball, near, once, plan, scalar, shaken, view, watch};
use glam::DVec3;
use tsubu::watch::open;

/// Pairs that move against each other, all carried along together: about their mean they move at 3 m/s along x and 4 m/s along z.
fn carried(together: DVec3) -> Vec<Ball> {
    let apart = DVec3::new(3.0, 0.0, 4.0);
    (0..40_usize)
        .map(|k| {
            let own = if k % 2 == 0 { apart } else { -apart };
            Ball { velocity: together + own, ..ball(shaken(k), 0.0, shaken(k + 7), 0.01) }
        })
        .collect()
}

#[test]
fn it_is_the_fluctuation_and_not_the_motion() {
    for (dimension, exact) in [(2, 12.5), (3, 25.0 / 3.0)] {
        let mut temperature = watch(dimension, "granular-temperature = {}");
        let sample = once(&mut *temperature, &view(&carried(DVec3::new(1e3, 0.0, -1e3)), Vec::new(), [None; 3]));
        let told = |name: &str| scalar(&*temperature, &sample, name);
        assert!(near(told("granular temperature"), exact, 1e-12), "{dimension}: {sample:?}");
        assert!(near(told("temperature x"), 9.0, 1e-12) && near(told("temperature z"), 16.0, 1e-12), "{sample:?}");
        assert!(near(told("velocity x"), 1e3, 1e-12) && near(told("velocity z"), -1e3, 1e-12), "{sample:?}");
        // The control: about zero it would be the square of the speed.
        assert!(!near(told("granular temperature"), 2e6 / f64::from(dimension), 0.5));
    }
}

/// A light grain and a heavy one: the mean and the squares are by mass, so that with the mass they give the kinetic energy.
#[test]
fn heavy_grains_count_for_more() {
    let velocity = |x: f64| DVec3::new(x, 0.0, 0.0);
    let balls = [
        Ball { velocity: velocity(4.0), mass: 1.0, ..ball(0.0, 0.0, 0.0, 0.1) },
        Ball { velocity: velocity(0.0), mass: 3.0, ..ball(1.0, 0.0, 0.0, 0.1) },
    ];
    let mut temperature = watch(2, "granular-temperature = {}");
    let sample = once(&mut *temperature, &view(&balls, Vec::new(), [None; 3]));
    // V = 1 m/s; (1 x 3^2 + 3 x 1^2) / 4 along x, nothing along z.
    assert_eq!(sample.scalars, [1.5, 3.0, 0.0, 1.0, 0.0]);
    let kinetic: f64 = balls.iter().map(|b| 0.5 * b.mass * b.velocity.length_squared()).sum();
    assert_eq!(kinetic, 0.5 * 4.0 * (2.0 * sample.scalars[0] + sample.scalars[3].powi(2)));
}

#[test]
fn others_do_not_count() {
    let more = format!("gravity = 0\n{GROUPS}");
    let asked = "granular-temperature = { group = \"b\", region = { low = [0, 0], high = [1, 1] } }";
    let plan = plan(2, &more, asked);
    let mut temperature = open(&plan.watch["w"].measure, &plan);
    let mut balls: Vec<Ball> = carried(DVec3::ZERO).into_iter().map(|own| Ball { group: 1, ..own }).collect();
    let fast = Ball { velocity: DVec3::new(99.0, 0.0, 0.0), ..ball(0.5, 0.0, 0.5, 0.01) };
    // Of the other group; outside; driven.
    let driven = Ball { group: 1, free: false, ..fast };
    balls.extend([fast, Ball { group: 1, at: DVec3::new(2.0, 0.0, 0.5), ..fast }, driven]);
    let told = once(&mut *temperature, &view(&balls, Vec::new(), [None; 3])).scalars[0];
    assert!(near(told, 12.5, 1e-12), "{told}");
    // The control: had any of them counted, it would be warmer.
    balls.push(Ball { group: 1, ..fast });
    assert!(once(&mut *temperature, &view(&balls, Vec::new(), [None; 3])).scalars[0] > 20.0);
    // Of no grains there is none, of one it is zero.
    let none = once(&mut *temperature, &view(&[fast], Vec::new(), [None; 3])).scalars;
    assert!(none.iter().all(|x| x.is_nan()), "{none:?}");
    let one = once(&mut *temperature, &view(&[Ball { group: 1, ..fast }], Vec::new(), [None; 3])).scalars;
    assert_eq!(one[..3], [0.0; 3]);
}
