//! Counting by group, by size and by time: mixing, residence, discharge by size.

use super::{Ball, ball, near, once, plan, scalar, view, watch};
use glam::DVec3;
use tsubu::view::View;
use tsubu::watch::{Sample, open};
use tsubu_frame::State;

fn groups(count: usize) -> String {
    let one = |k: usize| {
        format!("[particles.g{k}]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[{}, 0]]\n", 2 * k)
    };
    (0..count).map(one).collect()
}

/// Lacey and entropy index of nine cells of 60 grains each; `group` says to which of so many groups a grain belongs.
fn mixed(of: usize, more: &str, group: impl Fn(usize, usize) -> usize) -> [f64; 2] {
    let plan = plan(2, &groups(of), &format!("mixing = {{ cell = 1{more} }}"));
    let mut mixing = open(&plan.watch["w"].measure, &plan);
    let balls: Vec<Ball> = (0..540)
        .map(|k| {
            let (cell, n) = (k / 60, k % 60);
            let x = (cell % 3) as f64 + ((n % 10) as f64 + 0.5) / 10.0;
            let z = (cell / 3) as f64 + ((n / 10) as f64 + 0.5) / 6.0;
            Ball { group: group(cell, n) as u32, ..ball(x, 0.0, z, 0.01) }
        })
        .collect();
    let sample = once(&mut *mixing, &view(&balls, Vec::new(), [None; 3]));
    assert_eq!(scalar(&*mixing, &sample, "cells"), 9.0);
    ["Lacey index", "entropy index"].map(|name| scalar(&*mixing, &sample, name))
}

#[test]
fn three_groups_apart_in_order_and_between() {
    let apart = mixed(3, "", |cell, _| cell / 3);
    assert!(apart.iter().all(|index| index.abs() < 1e-12), "{apart:?}");
    let order = mixed(3, "", |_, n| n % 3);
    assert!(near(order[0], 60.0 / 59.0, 1e-12) && near(order[1], 1.0, 1e-12), "{order:?}");
    // Of three groups the first is spread over all cells, the others are apart.
    let between = mixed(3, "", |cell, n| if n % 2 == 0 { 0 } else { 1 + usize::from(cell >= 5) });
    assert!(between.iter().all(|index| (0.3..0.95).contains(index)), "{between:?}");
    // The control: whoever forgets the third group finds that the first two are mixed otherwise.
    let without =
        mixed(3, ", groups = [\"g0\", \"g1\"]", |cell, n| if n % 2 == 0 { 0 } else { 1 + usize::from(cell >= 5) });
    assert!((without[1] - between[1]).abs() > 0.05, "{without:?}, {between:?}");
}

/// For two groups the index is that of the watch that knows no more.
#[test]
fn two_groups_are_mixed_as_ever() {
    let group = |cell: usize, n: usize| usize::from(n % 7 < cell % 5);
    let [lacey, _] = mixed(2, "", group);
    let plan = plan(2, &groups(2), "segregation.cell = 1");
    let mut segregation = open(&plan.watch["w"].measure, &plan);
    let balls: Vec<Ball> = (0..540)
        .map(|k| {
            let (cell, n) = (k / 60, k % 60);
            Ball { group: group(cell, n) as u32, ..ball((cell % 3) as f64 + 0.5, 0.0, (cell / 3) as f64 + 0.5, 0.01) }
        })
        .collect();
    let sample = once(&mut *segregation, &view(&balls, Vec::new(), [None; 3]));
    let known = scalar(&*segregation, &sample, "Lacey index");
    assert!(near(lacey, known, 1e-12) && !near(lacey, 1.01 * known, 1e-3), "{lacey}, {known}");
}

/// A grain a second comes into a region of 2 m at 0.5 m/s: it stays 4 s. From the first second on one is inside that was there before.
fn passing(time: f64) -> View<'static> {
    let at = |k: usize| ball(0.5 * (time - k as f64), 0.0, 0.5, 0.1);
    let mut balls: Vec<Ball> = vec![ball(1.0, 0.0, 0.8, 0.1)];
    balls.extend((1..40).map(at));
    let mut shown = view(&balls, Vec::new(), [None; 3]);
    shown.time = time;
    if time > 20.0 {
        // The one that lay there is taken away, and counts as one that left.
        let g = &mut shown.grains;
        (g.id, g.position) = (g.id[1..].to_vec().into(), g.position[1..].to_vec().into());
        (g.velocity, g.radius) = (g.velocity[1..].to_vec().into(), g.radius[1..].to_vec().into());
        (g.mass, g.inverse_mass) = (g.mass[1..].to_vec().into(), g.inverse_mass[1..].to_vec().into());
        g.group = g.group[1..].to_vec().into();
    }
    shown
}

#[test]
fn grains_stay_as_long_as_they_need_to_pass() {
    let asked = "residence.region = { low = [0, 0], high = [2, 1] }";
    let mut residence = watch(2, asked);
    let mut last = Sample::default();
    let mut rows = Vec::new();
    for k in 0..=300 {
        last = residence.take(&passing(0.1 * f64::from(k)));
        rows.extend(last.rows.clone());
    }
    let told = |name: &str| scalar(&*residence, &last, name);
    // At 30 s grains 1 to 26 have left, and the one that lay there.
    assert_eq!((told("inside"), told("left")), (4.0, 27.0));
    assert!(near(told("residence time"), 4.0, 0.03), "{}", told("residence time"));
    assert!(told("residence time spread") < 0.1 && near(told("age"), 1.5, 0.1), "{}", told("age"));
    assert_eq!(rows.len(), 26, "the one that was there before has no residence time");
    // The control: counted from the first look, the mean would be longer.
    let with_the_first = (rows.iter().map(|row| row[2]).sum::<f64>() + 20.0) / 27.0;
    assert!(!near(with_the_first, 4.0, 0.03));
}

#[test]
fn residence_goes_on_from_a_checkpoint() {
    let asked = "residence.region = { low = [0, 0], high = [2, 1] }";
    let (mut whole, mut first, mut second) = (watch(2, asked), watch(2, asked), watch(2, asked));
    for k in 0..60 {
        assert_eq!(whole.take(&passing(0.2 * f64::from(k))).scalars.len(), 5);
        first.take(&passing(0.2 * f64::from(k)));
    }
    let mut state = State::default();
    first.save("w", &mut state);
    second.load("w", &state).unwrap();
    for k in 60..90 {
        assert_eq!(whole.take(&passing(0.2 * f64::from(k))), second.take(&passing(0.2 * f64::from(k))));
    }
    assert!(second.load("other", &state).is_err());
    // The control: one that forgot.
    assert_ne!(whole.take(&passing(18.0)), watch(2, asked).take(&passing(18.0)));
}

#[test]
fn what_passes_is_told_by_size() {
    let asked = "discharge.sizes = [\"4 mm\", \"8 mm\"]";
    let at = |z: f64| {
        // Diameters of 2, 4, 6 and 8 mm: an end belongs to the grains above.
        let balls: Vec<Ball> = (1..=4)
            .map(|k| Ball {
                mass: f64::from(k),
                velocity: DVec3::NEG_Z,
                ..ball(f64::from(k), 0.0, z, 1e-3 * f64::from(k))
            })
            .collect();
        view(&balls, Vec::new(), [None; 3])
    };
    let (mut whole, mut second) = (watch(2, asked), watch(2, asked));
    whole.take(&at(1.0));
    let mut state = State::default();
    whole.save("w", &mut state);
    second.load("w", &state).unwrap();
    let sample = whole.take(&at(-1.0));
    assert_eq!(sample.scalars, second.take(&at(-1.0)).scalars);
    let told = |name: &str| scalar(&*whole, &sample, name);
    assert_eq!(told("passed mass"), 10.0);
    let parts = ["below 4 mm", "4 mm to 8 mm", "from 8 mm"].map(|part| told(&format!("passed mass {part}")));
    assert_eq!(parts, [1.0, 5.0, 4.0]);
    assert_ne!(parts, [3.0, 3.0, 4.0], "an end that belongs to the grains below");
}
