//! Counting: what passes a plane, how groups are mixed, where single grains are.

use super::{Ball, GROUPS, ball, near, once, plan, scalar, shaken, view, watch};
use glam::DVec3;
use std::path::Path;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::run::run;
use tsubu::view::View;
use tsubu::watch::open;
use tsubu_frame::{Existing, ResultValue, State};
use tsubu_scene::Scene;

const GRAVITY: &str = "gravity = 0\n";

/// Grains 0.1 apart that fall at 2 m/s through z = 0: 20 a second.
fn falling(time: f64, gone_below: f64) -> View<'static> {
    let grain = |k: usize| Ball {
        velocity: DVec3::new(0.0, 0.0, -2.0),
        mass: 0.5,
        ..ball(0.0, 0.0, 0.1 * k as f64 + 0.05 - 2.0 * time, 0.04)
    };
    let balls: Vec<Ball> = (0..400).map(grain).collect();
    let mut shown = view(&balls, Vec::new(), [None; 3]);
    let kept: Vec<usize> = (0..400).filter(|&k| balls[k].at.z >= gone_below).collect();
    let g = &mut shown.grains;
    g.id = kept.iter().map(|&k| k as u32).collect();
    let vectors = |of: fn(&Ball) -> DVec3| kept.iter().map(|&k| of(&balls[k])).collect::<Vec<_>>();
    let reals = |of: fn(&Ball) -> f64| kept.iter().map(|&k| of(&balls[k])).collect::<Vec<_>>();
    (g.position, g.velocity) = (vectors(|b| b.at).into(), vectors(|b| b.velocity).into());
    (g.mass, g.inverse_mass) = (reals(|b| b.mass).into(), reals(|b| 1.0 / b.mass).into());
    shown.time = time;
    shown
}

#[test]
fn a_steady_fall_is_counted_exactly() {
    // Seen on both sides of the plane; vanishing between two looks; far less often.
    for (gone_below, every) in [(-9.0, 0.01), (-0.01, 0.01), (-0.01, 0.13)] {
        let plan = plan(2, GRAVITY, "discharge = {}");
        let mut gate = open(&plan.watch["w"].measure, &plan);
        let mut rates = Vec::new();
        let looks = (2.6_f64 / every).round() as usize;
        for k in 0..=looks {
            let sample = once(&mut *gate, &falling(k as f64 * every, gone_below));
            let passed = (20.0 * k as f64 * every + 0.5).floor();
            assert_eq!(scalar(&*gate, &sample, "passed grains"), passed, "{gone_below} {every}, look {k}");
            assert!((scalar(&*gate, &sample, "passed mass") - 0.5 * passed).abs() < 1e-12);
            rates.push(scalar(&*gate, &sample, "rate"));
        }
        assert!(rates[0].is_nan());
        let mean = rates[1..].iter().sum::<f64>() / looks as f64;
        assert!(near(mean, 20.0, 1e-3), "{mean}");
        // The control: the same gate refuses 1 % more.
        assert!(!near(mean, 20.2, 1e-3));
    }
}

/// Ten grains pass, one each 10 ms: ten have passed, and not the 4.5 that had on the average over the looks. What is of the moment keeps its mean.
#[test]
fn what_has_been_so_far_is_told_by_its_last_value() {
    let list = |of: &dyn Fn(u32) -> String| (0..10).map(of).collect::<Vec<_>>().join(", ");
    let text = format!(
        "dimension = 2\nduration = '0.1 s'\ngravity = 0\n[materials.glass]\ndensity = 2500\nyoung-modulus = '10 MPa'\n[particles.beads]\n\
         material = 'glass'\ndiameter = '4 mm'\nstart.at = {{ position = [{}], velocity = [{}] }}\n[watch.gate]\ndischarge = {{}}\nevery = '5 ms'\n",
        list(&|k| format!("[0, '{} mm']", 5 + 10 * k)),
        list(&|_| "[0, -1]".to_owned())
    );
    let scene = Scene::parse("gate", &text, Path::new("."), &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
    let folder = tempfile::tempdir().expect("a folder");
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let summary = run(&scene, folder.path(), Existing::Overwrite, &watcher).expect("a run");
    let number = |name: &str| match summary.results.get(name) {
        Some(ResultValue::Number(value)) => *value,
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(number("gate passed grains"), 10.0);
    assert!(near(number("gate rate"), 100.0, 0.06) && number("gate rate final") != number("gate rate"));
}

/// A hopper that had arched gave a small rate in a sweep, and no word that it was blocked.
#[test]
fn an_outlet_that_nothing_passes_any_more_says_so() {
    let plan = plan(2, "gravity = 10\n", "discharge = {}");
    let fresh = || open(&plan.watch["w"].measure, &plan);
    let at = |time: f64, zs: &[f64]| {
        let balls: Vec<Ball> = zs.iter().map(|z| ball(0.0, 0.0, *z, 0.1)).collect();
        View { time, ..view(&balls, Vec::new(), [None; 3]) }
    };
    let remark = |looks: &[View]| {
        let mut gate = fresh();
        for look in looks {
            drop(gate.take(look));
        }
        let mut state = State::default();
        gate.save("w", &mut state);
        let mut again = fresh();
        again.load("w", &state).unwrap();
        assert_eq!(gate.remark(true), again.remark(true), "after a resume");
        // A lid that a later stage opens is no blocked outlet; one that has let grains pass is, in any stage.
        assert_eq!(gate.remark(false), gate.remark(true).filter(|said| said.contains("since")));
        gate.remark(true)
    };
    let begin = || at(0.0, &[1.0, 2.0]);
    let stuck = remark(&[begin(), at(1.0, &[-1.0, 2.0]), at(2.0, &[-9.0, 2.0])]).expect("remark");
    assert_eq!(stuck, "no grain has passed since t = 1 s and 1 is still before it: the outlet may be blocked");
    let shut = remark(&[begin(), at(2.0, &[1.0, 2.0])]).expect("remark");
    assert_eq!(shut, "no grain has passed and 2 are before it: the outlet may be blocked");
    assert_eq!(remark(&[begin(), at(1.0, &[1.0, 2.0]), at(1.1, &[-1.0, 2.0])]), None, "it flows");
    assert_eq!(remark(&[begin(), at(1.0, &[-1.0, -1.0]), at(9.0, &[-9.0, -9.0])]), None, "it is empty");
}

#[test]
fn who_comes_back_is_taken_off_and_who_appears_in_front_does_not_count() {
    let mut gate = watch(2, "discharge = { normal = \"x\" }");
    let mut passed = |xs: &[f64]| {
        let balls: Vec<Ball> = xs.iter().map(|x| ball(*x, 0.0, 0.0, 0.1)).collect();
        let sample = once(&mut *gate, &view(&balls, Vec::new(), [None; 3]));
        scalar(&*gate, &sample, "passed grains")
    };
    assert_eq!(passed(&[-1.0, -1.0]), 0.0);
    assert_eq!(passed(&[0.5, 0.1]), 2.0);
    assert_eq!(passed(&[0.5, -0.1]), 1.0);
    assert_eq!(passed(&[0.6, -0.1, 3.0]), 1.0);
}

#[test]
fn every_round_of_a_periodic_world_counts() {
    let mut gate = watch(2, "discharge = { normal = \"x\", point = [0.3, 0] }");
    let mut passed = |x: f64| {
        let mut shown = view(&[ball(x - x.floor(), 0.0, 0.0, 0.1)], Vec::new(), [Some([0.0, 1.0]), None, None]);
        shown.grains.unwrap_offset = vec![DVec3::new(x.floor(), 0.0, 0.0)].into();
        let sample = once(&mut *gate, &shown);
        scalar(&*gate, &sample, "passed grains")
    };
    assert_eq!([0.1, 0.4, 0.9, 1.2, 1.4, 4.4, -0.8].map(&mut passed), [0.0, 1.0, 1.0, 1.0, 2.0, 5.0, -1.0]);
}

#[test]
fn a_count_goes_on_after_a_checkpoint() {
    let plan = plan(2, GRAVITY, "discharge = {}");
    let fresh = || open(&plan.watch["w"].measure, &plan);
    let (mut whole, mut first, mut second) = (fresh(), fresh(), fresh());
    let look = |k: usize| falling(0.1 * k as f64, -0.1);
    (0..5).for_each(|k| drop((whole.take(&look(k)), first.take(&look(k)))));
    let mut state = State::default();
    first.save("watch.w", &mut state);
    second.load("watch.w", &state).unwrap();
    for k in 5..9 {
        assert_eq!(whole.take(&look(k)), second.take(&look(k)));
    }
    assert!(second.load("watch.other", &state).is_err());
    // The control: one that forgot.
    assert_ne!(whole.take(&look(9)), fresh().take(&look(9)));
}

/// Sixteen cells of 64 grains each; `group` says to which group a grain belongs.
fn lacey(group: impl Fn(usize, usize) -> u32) -> f64 {
    let plan = plan(2, GROUPS, "segregation.cell = 1");
    let mut mixing = open(&plan.watch["w"].measure, &plan);
    let balls: Vec<Ball> = (0..1024)
        .map(|k| {
            let (cell, n) = (k / 64, k % 64);
            let x = (cell % 4) as f64 + ((n % 8) as f64 + 0.5) / 8.0;
            let z = (cell / 4) as f64 + ((n / 8) as f64 + 0.5) / 8.0;
            Ball { group: group(cell, n), ..ball(x, 0.0, z, 0.05) }
        })
        .collect();
    let sample = once(&mut *mixing, &view(&balls, Vec::new(), [None; 3]));
    assert_eq!(scalar(&*mixing, &sample, "cells"), 16.0);
    scalar(&*mixing, &sample, "Lacey index")
}

#[test]
fn groups_apart_in_order_and_at_random() {
    assert!(lacey(|cell, _| u32::from(cell >= 8)).abs() < 1e-12, "apart");
    let order = lacey(|_, n| u32::from(n >= 32));
    assert!(near(order, 64.0 / 63.0, 1e-12), "{order}");
    let random = lacey(|cell, n| u32::from(shaken(64 * cell + n + (cell * n) % 7) > 0.5));
    assert!((random - 1.0).abs() < 0.05, "{random}");
    // The control: three quarters of the way is neither.
    let between = lacey(|cell, n| u32::from(if cell >= 8 { n >= 16 } else { n >= 48 }));
    assert!((0.5..0.95).contains(&between), "{between}");
}

/// An index of 1.006 looked like a mistake, as the index "lies between 0 and 1": random mixtures scatter about 1, and by how
/// much the text says. Cut at 1, their mean would lie below it.
#[test]
fn random_mixtures_lie_on_both_sides_of_one() {
    // A coin for each grain (splitmix64): `shaken` is spread more evenly than chance would have it.
    let coin = |k: usize| {
        let z = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) & 1) as u32
    };
    let of = |salt: usize| lacey(|cell, n| coin(1024 * salt + 64 * cell + n));
    let all: Vec<f64> = (0..60).map(of).collect();
    let mean = all.iter().sum::<f64>() / 60.0;
    let spread = (all.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / 59.0).sqrt();
    let told = (2.0_f64 / 16.0).sqrt() / 63.0;
    assert!((mean - 1.0).abs() < 3.0 * told / 60.0_f64.sqrt(), "{mean}");
    assert!(spread > 0.7 * told && spread < 1.3 * told, "{spread} for {told}");
    assert!(all.iter().filter(|m| **m > 1.0).count() > 15, "{all:?}");
}

#[test]
fn the_lighter_group_floats() {
    let plan = plan(2, GROUPS, "segregation.cell = 1");
    let mut mixing = open(&plan.watch["w"].measure, &plan);
    let balls = [
        Ball { mass: 3.0, ..ball(0.0, 0.0, 1.0, 0.1) },
        ball(0.0, 0.0, 3.0, 0.1),
        Ball { group: 1, ..ball(0.0, 0.0, 1.0, 0.1) },
    ];
    let sample = once(&mut *mixing, &view(&balls, Vec::new(), [None; 3]));
    assert!(near(scalar(&*mixing, &sample, "height difference"), 0.5, 1e-12));
    assert!(near(scalar(&*mixing, &sample, "share"), 2.0 / 3.0, 1e-12));
}

#[test]
fn tracks_go_on_across_ends_and_stop_with_the_grain() {
    let plan = plan(
        2,
        "[particles.a]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[0, 0], [2, 0], [4, 0]]\n",
        "track.ids = [2, 0]",
    );
    let mut track = open(&plan.watch["w"].measure, &plan);
    let mut shown = view(&[ball(0.1, 0.0, 0.2, 0.1), ball(0.3, 0.0, 0.4, 0.1)], Vec::new(), [None; 3]);
    shown.grains.unwrap_offset = vec![DVec3::new(5.0, 0.0, 0.0), DVec3::ZERO].into();
    let sample = once(&mut *track, &shown);
    assert_eq!(sample.rows, [[0.0, 5.1, 0.2, 0.0, 0.0, 0.0]]);
}
