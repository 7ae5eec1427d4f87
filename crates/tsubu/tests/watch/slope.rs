//! Slopes and heaps whose surface is known.

use super::{Ball, ball, near, once, scalar, touching, view, watch};

/// Columns of grains of radius 0.05 whose tops follow `surface`.
fn columns(surface: impl Fn(f64) -> f64) -> Vec<Ball> {
    let column = |k: usize| {
        let x = (k as f64 + 0.5) / 10.0;
        let top = surface(x) - 0.05;
        let below = (top / 0.1).floor() as usize;
        (0..=below).map(move |n| ball(x, 0.0, top - 0.1 * n as f64, 0.05))
    };
    (0..20).flat_map(column).collect()
}

const TEXT: &str = "slope = { bins = 20, touching = false, region = { low = [0, 0], high = [2, 5] } }";

#[test]
fn an_even_slope() {
    let mut slope = watch(2, TEXT);
    let sample = once(&mut *slope, &view(&columns(|x| 0.5 + 0.4 * x), Vec::new(), [None; 3]));
    let angle = scalar(&*slope, &sample, "angle");
    assert!(near(angle, 0.4_f64.atan(), 1e-12), "{angle}");
    assert!(near(scalar(&*slope, &sample, "surface height"), 0.9, 1e-12));
    // The control: the same gate refuses a slope that is 1 % steeper.
    assert!(!near(angle, 0.404_f64.atan(), 1e-3));
}

#[test]
fn a_heap() {
    let mut slope = watch(2, TEXT);
    let heap = |x: f64| 1.2 - 0.6 * (x - 1.0).abs();
    let sample = once(&mut *slope, &view(&columns(heap), Vec::new(), [None; 3]));
    assert!(near(scalar(&*slope, &sample, "heap angle"), 0.6_f64.atan(), 1e-12));
    assert!(scalar(&*slope, &sample, "angle").abs() < 1e-12);
    // The control: a top that is elsewhere.
    let mut aside = watch(2, &TEXT.replace("bins = 20", "bins = 20, centre = 0.7"));
    let sample = once(&mut *aside, &view(&columns(heap), Vec::new(), [None; 3]));
    assert!(!near(scalar(&*aside, &sample, "heap angle"), 0.6_f64.atan(), 0.05));
}

/// The ends of the surface, where a wall holds it up, are outside the middle share.
#[test]
fn the_ends_do_not_count() {
    let bent = |x: f64| if (0.2..=1.8).contains(&x) { 0.5 + 0.4 * x } else { 1.0 };
    let angle = |text: &str| {
        let mut slope = watch(2, text);
        let sample = once(&mut *slope, &view(&columns(bent), Vec::new(), [None; 3]));
        scalar(&*slope, &sample, "angle")
    };
    assert!(near(angle(TEXT), 0.4_f64.atan(), 1e-12));
    assert!(!near(angle(&TEXT.replace("bins = 20", "bins = 20, share = 1")), 0.4_f64.atan(), 0.05));
}

#[test]
fn grains_in_flight_are_no_surface() {
    let mut balls = columns(|x| 0.5 + 0.4 * x);
    let contacts = touching(&balls, [None; 3], 1.0);
    balls.push(ball(0.5, 0.0, 4.0, 0.05));
    let shown = view(&balls, contacts, [None; 3]);
    let angle = |text: &str| {
        let mut slope = watch(2, text);
        let sample = once(&mut *slope, &shown);
        scalar(&*slope, &sample, "angle")
    };
    assert!(near(angle(&TEXT.replace("touching = false, ", "")), 0.4_f64.atan(), 1e-12));
    assert!(!near(angle(TEXT), 0.4_f64.atan(), 0.05), "the control: it counts if it is told to");
}

#[test]
fn an_empty_surface_has_no_slope() {
    let mut slope = watch(2, TEXT);
    let sample = once(&mut *slope, &view(&[], Vec::new(), [None; 3]));
    assert!(sample.scalars.iter().all(|x| x.is_nan()));
}
