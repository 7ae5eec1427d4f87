//! Luding's hysteretic law against its closed forms.

use super::impact::meet;
use super::two::Ball;
use super::{Numbers, Subject, constants, stack};
use glam::DVec3;
use tsubu::contact::chunk::Chunk;
use tsubu_scene::plan::{Contact, Normal};

const K1: f64 = 1e5;
const RATIO: f64 = 5.0;
const PHI: f64 = 0.05;
/// Effective radius of the passes [m].
const RADIUS: f64 = 1.5e-3;

fn law(adhesion_ratio: f64) -> Subject {
    let normal = Normal::Luding { stiffness: K1, unloading_ratio: RATIO, adhesion_ratio, plasticity_depth: PHI };
    Subject::new(&Contact { normal, ..stack::hertz() }, constants())
}

/// k2 and d0 of a dent, by the paper: k2 grows in proportion to the deepest overlap, up to D = K / (K - k1) 2 R* phi.
fn dent(depth: f64, radius: f64) -> [f64; 3] {
    let full = RATIO / (RATIO - 1.0) * 2.0 * radius * PHI;
    let depth = depth.min(full);
    let k2 = K1 * (1.0 + (RATIO - 1.0) * depth / full);
    [depth, k2, (1.0 - K1 / k2) * depth]
}

/// Presses and pulls slowly to the overlap `to`; gives the least force on the way, the work and the loss. Nothing may be stored
/// below zero, and nothing be won.
fn pass(subject: &Subject, chunk: &mut Chunk, to: f64, steps: u32) -> [f64; 3] {
    let (dt, from) = (1e-6, chunk.overlap[0]);
    let (mut least, mut work, mut lost) = (f64::INFINITY, 0.0, 0.0);
    for k in 1..=steps {
        let before = (chunk.overlap[0], chunk.normal_force[0]);
        chunk.overlap[0] = from + (to - from) * (f64::from(k) / f64::from(steps));
        (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[0][0]) = (RADIUS, 1e-4, 1.0);
        subject.apply(chunk, dt);
        assert!(chunk.stored[0] >= 0.0 && chunk.lost_normal[0] >= 0.0, "{before:?}");
        least = least.min(chunk.normal_force[0]);
        work += 0.5 * (before.1 + chunk.normal_force[0]) * (chunk.overlap[0] - before.0);
        lost += chunk.lost_normal[0] * dt;
    }
    [least, work, lost]
}

/// Without adhesion and dashpot an impact returns sqrt(k1/k2), k2 of the depth that it reaches; beyond D less is lost, as only the
/// way to D yields.
#[test]
fn an_impact_returns_the_root_of_the_stiffnesses() {
    let subject = law(0.0);
    let ball = Ball::new(RADIUS, 2500.0, DVec3::ZERO);
    let [full, ..] = dent(1.0, RADIUS);
    let fastest = full * (K1 / ball.mass).sqrt();
    for share in [0.05, 0.3, 0.9, 2.0] {
        let speed = share * fastest;
        let [depth, k2, rest] = dent(share * full, RADIUS);
        let lost = K1 * depth * rest / (ball.mass * speed * speed);
        let expected = (1.0 - lost).sqrt();
        if share <= 1.0 {
            assert!((expected / (K1 / k2).sqrt() - 1.0).abs() < 1e-12, "two closed forms, one law");
        }
        let (back, ..) = meet(&subject, ball, Ball::plane(), speed);
        assert!((back - expected).abs() < 1e-3, "{share}: {back} {expected}");
        // The control: one k2 for all depths, Walton and Braun's simpler law.
        assert!((back - RATIO.recip().sqrt()).abs() > 1e-2, "{share}: {back}");
    }
}

/// Pressed and torn off: the strongest pull is -kc d where the limbs cross, what is lost are the two triangles, the work is lost to
/// the last, and nothing of the dent is left.
#[test]
fn a_dent_is_torn_off_at_its_price() {
    for adhesion in [0.0, 0.3, 1.0, 8.0] {
        let (subject, kc) = (law(adhesion), adhesion * K1);
        for press in [1e-6, 3e-5, 1.5e-4, 5e-4] {
            let [depth, k2, rest] = dent(press, RADIUS);
            let mut chunk = subject.chunk(1);
            let loading = pass(&subject, &mut chunk, press, 4000);
            let yielding = 0.5 * K1 * depth * rest;
            assert!((loading[2] / yielding - 1.0).abs() < 1e-9, "{adhesion} {press:e}: {loading:?}");
            let tearing = pass(&subject, &mut chunk, 0.0, 40_000);
            let pull = kc * (k2 - K1) / (k2 + kc) * depth;
            assert!((tearing[0] + pull).abs() <= 1e-3 * pull, "{adhesion} {press:e}: {:e} {pull:e}", tearing[0]);
            let price = 0.5 * kc * k2 * rest * rest / (k2 + kc);
            assert!((tearing[2] - price).abs() <= 1e-9 * price, "{adhesion} {press:e}: {tearing:?}");
            let work = loading[1] + tearing[1];
            assert!((work / (yielding + price) - 1.0).abs() < 1e-4, "{adhesion} {press:e}: {work:e}");
            assert!(chunk.history.iter().all(|column| column[0] == 0.0) && chunk.stored[0] == 0.0);
            // The control: the pull of a dent whose k2 is K whatever its depth.
            let stiff = kc * (RATIO - 1.0) * K1 / (RATIO * K1 + kc) * depth;
            assert!(adhesion == 0.0 || depth < press || (tearing[0] + stiff).abs() > 1e-2 * pull, "{press:e}");
        }
    }
}

/// Let go and pressed again, also out of a dent that was torn half off: nothing is lost up to the depth of the dent, and the force
/// is the same on both ways.
#[test]
fn pressing_again_is_elastic() {
    let (subject, mut chunk) = (law(1.0), law(1.0).chunk(1));
    let press = 1e-4;
    pass(&subject, &mut chunk, press, 1000);
    let [_, k2, rest] = dent(press, RADIUS);
    let crossing = k2 * rest / (k2 + K1);
    // Down the elastic line and up again; then half of the way along the limb of the pull, and up to where that dent ends.
    for [low, high] in [[1.001 * crossing, press], [0.5 * crossing, chunk.overlap[0]]] {
        pass(&subject, &mut chunk, low, 1000);
        let high = high.min(chunk.history[0][0]);
        let (force, up) = (chunk.normal_force[0], pass(&subject, &mut chunk, high, 1000));
        assert!((chunk.normal_force[0] / (K1 * high) - 1.0).abs() < 1e-9, "back on the line of first loading");
        let down = pass(&subject, &mut chunk, low, 1000);
        assert_eq!([up[2], down[2]], [0.0, 0.0]);
        assert!((chunk.normal_force[0] - force).abs() < 1e-9 * K1 * press);
        assert!((up[1] + down[1]).abs() < 1e-9 * up[1].abs());
    }
}

/// Cycles of any kind: work = stored + lost, in every branch, to the coarseness of the passes.
#[test]
fn the_books_close_over_any_way() {
    let mut numbers = Numbers::new(11);
    let miss = |subject: &Subject, numbers: &mut Numbers| {
        let mut chunk = subject.chunk(1);
        let (mut work, mut lost, mut worst, mut most) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for _ in 0..40 {
            let [_, done, gone] = pass(subject, &mut chunk, numbers.between(0.0, 3e-4), 2000);
            (work, lost) = (work + done, lost + gone);
            most = most.max(chunk.stored[0]);
            worst = worst.max((work - lost - chunk.stored[0]).abs());
        }
        worst / (most + lost)
    };
    for adhesion in [0.0, 0.5, 4.0] {
        let found = miss(&law(adhesion), &mut numbers);
        assert!(found < 1e-4, "{adhesion}: {found:e}");
    }
    // The control: a law that loses a tenth less than it says.
    let less = law(0.5).spoiled(|c| c.lost_normal[0] *= 0.9);
    assert!(miss(&less, &mut numbers) > 1e-2);
}

/// The verdict on the time step hears of the stiffest spring, not of that of first loading.
#[test]
fn the_time_step_is_that_of_the_stiffest_spring() {
    for (adhesion, stiffest) in [(0.0, RATIO), (1.0, RATIO), (8.0, 8.0)] {
        let pair = law(adhesion).pair(RADIUS, 1e-4);
        let time = std::f64::consts::PI * (1e-4 / (stiffest * K1)).sqrt();
        assert!((pair.contact_time(0.5) / time - 1.0).abs() < 1e-12);
        assert!((pair.largest_overlap(0.5) / (0.5 * (1e-4 / K1).sqrt()) - 1.0).abs() < 1e-12);
    }
}
