//! The same bits for any number of threads, and after a resume.

use super::{open, open_text};

/// 2,500 balls, enough for threads to be worth it, with friction springs, spin and rolling friction.
const MANY: &str = r#"
title = "many"
gravity = 10
duration = "1 s"
[materials.glass]
young-modulus = "10 MPa"
restitution = 0.6
friction = 0.5
rolling-friction = 0.05
[particles.balls]
material = "glass"
count = 2500
diameter = "2 mm"
mass = "0.01 g"
start.rows = { spacing = 1.05, jitter = 0.8, speed = 0.3 }
[walls.box]
material = "glass"
shape.box = { width = "110 mm", height = "200 mm" }
[contact]
rolling.constant = {}
[dem]
time-step = "1e-5 s"
"#;

fn hash(threads: usize, resume: bool) -> String {
    super::hash(|| open_text(MANY, &[]), [700, 800], threads, resume, |_, _, _| ()).0
}

#[test]
fn threads_and_resume_change_no_bit() {
    let one = hash(1, false);
    assert_eq!(one, hash(2, false));
    assert_eq!(one, hash(7, false));
    assert_eq!(one, hash(2, true));
}

/// Below 96 grains the skin is a matter of speed alone: positions agree bit by bit.
#[test]
fn the_skin_changes_no_bit_of_a_small_run() {
    let positions = |skin: &str| {
        let (mut engine, mut hosts, mut ledger) = open("shaken-box", &[skin]);
        engine.advance(40_000, &mut hosts, &mut ledger).unwrap();
        engine.frame(&hosts).columns
    };
    assert_eq!(positions("dem.skin=0.1"), positions("dem.skin=0.7"));
}
