//! Bedload and run-out of grains whose ways are known.

use super::engines::done;
use super::{Ball, ball, column, near, on_wall, once, plan, scalar, shaken, touching, view, watch};
use glam::DVec3;
use std::f64::consts::PI;
use tsubu::view::View;
use tsubu::watch::{Watch, open};
use tsubu_frame::{ResultValue, State, Table};

/// A block of 10 x 4 grains of radius 0.05 that fills (0, 1) x (0, 0.4) and moves at `speed` along x.
fn block(speed: f64) -> Vec<Ball> {
    let at = |k: usize| ball(0.1 * (k % 10) as f64 + 0.05, 0.0, 0.1 * (k / 10) as f64 + 0.05, 0.05);
    (0..40).map(|k| Ball { velocity: DVec3::new(speed, 0.0, 0.0), ..at(k) }).collect()
}

fn at(balls: &[Ball], time: f64) -> View<'static> {
    let mut shown = view(balls, Vec::new(), [Some([0.0, 1.0]), None, None]);
    shown.time = time;
    shown
}

const REGION: &str = "region = { low = [0, 0], high = [1, 1] }";

/// q = phi h u: solid fraction pi/4, height 0.4.
#[test]
fn a_block_on_its_way_carries_its_height() {
    let mut load = watch(2, &format!("bedload = {{ {REGION} }}"));
    let sample = once(&mut *load, &at(&block(0.3), 0.0));
    let rate = scalar(&*load, &sample, "transport rate");
    let exact = PI / 4.0 * 0.4 * 0.3;
    assert!(near(rate, exact, 1e-12), "{rate} {exact}");
    assert!(near(scalar(&*load, &sample, "moving speed"), 0.3, 1e-12));
    assert_eq!(scalar(&*load, &sample, "moving grains"), 40.0);
    // As spheres in a bed as wide as they are: 2/3 of the discs.
    let mut spheres = watch(2, &format!("bedload = {{ width = 0.1, {REGION} }}"));
    let sample = once(&mut *spheres, &at(&block(0.3), 0.0));
    assert!(near(scalar(&*spheres, &sample, "transport rate"), exact / 1.5, 1e-12));
    // In space, over one grain's width.
    let space = "region = { low = [0, -0.05, 0], high = [1, 0.05, 1] }";
    let mut load = watch(3, &format!("bedload = {{ {space} }}"));
    let sample = once(&mut *load, &at(&block(0.3), 0.0));
    assert!(near(scalar(&*load, &sample, "transport rate"), exact / 1.5, 1e-12));
    // The controls: half the speed, and a frozen layer, carry less.
    assert!(!near(rate, PI / 4.0 * 0.4 * 0.15, 0.1));
    let mut frozen = block(0.3);
    frozen[..10].iter_mut().for_each(|ball| ball.free = false);
    let mut load = watch(2, &format!("bedload = {{ {REGION} }}"));
    let sample = once(&mut *load, &at(&frozen, 0.0));
    assert!(near(scalar(&*load, &sample, "transport rate"), 0.75 * exact, 1e-12));
}

/// Half of the grains are twice as large and move twice as fast; masses are told where there is a width to tell them over.
#[test]
fn transport_is_parted_by_size_and_weighed() {
    let mut balls = block(0.3);
    for ball in &mut balls[20..] {
        (ball.radius, ball.velocity.x, ball.mass) = (0.1, 0.6, 8.0);
    }
    let text = format!("bedload = {{ width = 0.2, sizes = [0.15], {REGION} }}");
    let mut load = watch(2, &text);
    let sample = once(&mut *load, &at(&balls, 0.0));
    let volume = |r: f64| 4.0 / 3.0 * PI * r.powi(3) / 0.2;
    let (fine, coarse) = (20.0 * volume(0.05) * 0.3, 20.0 * volume(0.1) * 0.6);
    assert!(near(scalar(&*load, &sample, "transport rate below 150 mm"), fine, 1e-12));
    assert!(near(scalar(&*load, &sample, "transport rate from 150 mm"), coarse, 1e-12));
    assert!(near(scalar(&*load, &sample, "transport rate"), fine + coarse, 1e-12));
    assert!(near(scalar(&*load, &sample, "mass rate"), (20.0 * 0.3 + 160.0 * 0.6) / 0.2, 1e-12));
    // Discs without a width have no mass per width.
    let load = watch(2, &format!("bedload = {{ {REGION} }}"));
    assert!(!load.scalars().iter().any(|name| name.starts_with("mass rate")));
}

#[test]
fn the_fluctuation_is_that_of_the_looks() {
    let mut load = watch(2, &format!("bedload = {{ {REGION} }}"));
    let speeds: Vec<f64> = (0..50).map(|k| 0.3 + 0.2 * (shaken(k) - 0.5)).collect();
    let unit = PI / 4.0 * 0.4;
    for (k, speed) in speeds.iter().enumerate() {
        let sample = once(&mut *load, &at(&block(*speed), 0.1 * k as f64));
        let so_far = &speeds[..=k];
        let mean = so_far.iter().sum::<f64>() / so_far.len() as f64;
        let variance = so_far.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / so_far.len() as f64;
        assert!(near(scalar(&*load, &sample, "mean transport rate"), unit * mean, 1e-12));
        let fluctuation = scalar(&*load, &sample, "fluctuation");
        assert!((fluctuation - unit * variance.sqrt()).abs() < 1e-12, "{k}: {fluctuation}");
    }
}

/// q / sqrt((s - 1) g d^3) of quartz in water; and of one group where two are there.
#[test]
fn the_einstein_number_is_of_the_grains_that_sink() {
    let groups = "gravity = 9.8\n[particles.sand]\nmaterial = \"glass\"\ndiameter = 0.1\nstart.at.position = [[0, 0]]\n\
                  [particles.lead]\nmaterial = \"lead\"\ndiameter = 0.2\nstart.at.position = [[5, 0]]\n\
                  [materials.lead]\nyoung-modulus = 1e7\ndensity = 11000\n";
    let number = |keys: &str| {
        let plan = plan(2, groups, &format!("bedload = {{ fluid-density = 1000, {keys} {REGION} }}"));
        let mut load = open(&plan.watch["w"].measure, &plan);
        // Groups are numbered by name.
        let sand: Vec<Ball> = block(0.3).into_iter().map(|ball| Ball { group: 1, ..ball }).collect();
        let sample = once(&mut *load, &at(&sand, 0.0));
        scalar(&*load, &sample, "Einstein number") / scalar(&*load, &sample, "transport rate")
    };
    let sand = 1.0 / (1.5 * 9.8 * 0.1f64.powi(3)).sqrt();
    assert!(near(number("group = \"sand\","), sand, 1e-12));
    assert!(!near(number(""), sand, 0.1), "the control: all groups together");
}

/// Started and stopped with the two speeds: one that rocks between them starts once.
#[test]
fn grains_start_and_stop_once() {
    let text = format!("bedload = {{ moving-speed = 0.1, resting-speed = 0.04, {REGION} }}");
    let counts = |text: &str, speeds: &[f64]| {
        let mut load = watch(2, text);
        let (mut started, mut stopped, mut rate) = (0.0, 0.0, 0.0);
        for (k, speed) in speeds.iter().enumerate() {
            let mut balls = block(0.0);
            balls[7].velocity.z = *speed;
            let sample = once(&mut *load, &at(&balls, 0.5 * k as f64));
            started += scalar(&*load, &sample, "started");
            stopped += scalar(&*load, &sample, "stopped");
            let entrainment = scalar(&*load, &sample, "entrainment");
            rate += if entrainment.is_nan() { 0.0 } else { 0.5 * entrainment };
        }
        assert!(near(rate, started, 1e-12) || started == 0.0, "{rate}: per 1 m and 0.5 s");
        (started, stopped)
    };
    assert_eq!(counts(&text, &[0.0, 0.12, 0.06, 0.12, 0.06, 0.03, 0.06, 0.09]), (1.0, 1.0));
    // The control: without the gap between the speeds it starts twice.
    let one = text.replace("0.04", "0.1");
    assert_eq!(counts(&one, &[0.0, 0.12, 0.06, 0.12, 0.06, 0.03, 0.06, 0.09]), (2.0, 2.0));
    // One that moves from the first look on has not started.
    assert_eq!(counts(&text, &[0.2, 0.2, 0.2]), (0.0, 0.0));
}

/// A pile of three on the floor that runs 1 to the right and 0.4 down, its first grain 0.5 further.
fn pile(share: f64) -> View<'static> {
    let mut balls = vec![ball(0.0, 0.0, 0.1, 0.1), ball(0.0, 0.0, 0.3, 0.1), ball(0.0, 0.0, 0.5, 0.1)];
    for (k, ball) in balls.iter_mut().enumerate() {
        ball.at += share * DVec3::new(1.0, 0.0, -0.4);
        ball.at.x += if k == 0 { 0.5 * share } else { 0.0 };
        ball.mass = 2.0;
    }
    let mut contacts = touching(&balls[1..], [None; 3], 1.0);
    for c in &mut contacts {
        (c.first, c.second, c.overlap) = (c.first + 1, c.second + 1, 1e-6);
    }
    let mut on_floor = on_wall(&balls, 0, DVec3::new(0.0, 0.0, -0.1), DVec3::Z);
    on_floor.overlap = 1e-6;
    contacts.push(on_floor);
    // One in flight, far ahead; it is light.
    balls.push(Ball { mass: 1e-3, ..ball(3.0, 0.0, 5.0, 0.1) });
    view(&balls, contacts, [None; 3])
}

#[test]
fn a_pile_runs_out() {
    let text = "run-out = { bins = 4, share = 0.9, region = { low = [0, -1], high = [2, 2] } }";
    let look = |text: &str, share: f64| {
        let mut out = watch(2, text);
        once(&mut *out, &pile(0.0));
        let sample = once(&mut *out, &pile(share));
        let get = |name: &str| scalar(&*out, &sample, name);
        let heights = column(&*out, &sample, "surface height");
        (["front", "run-out", "mass front", "travel", "fall", "travel angle", "deposit height"].map(get), heights)
    };
    let ([front, run_out, mass_front, travel, fall, angle, height], heights) = look(text, 1.0);
    assert!(near(front, 1.6, 1e-12) && near(run_out, 1.6 - 3.1, 1e-12), "{front} {run_out}");
    assert!(near(mass_front, 1.5, 1e-12), "{mass_front}: all but the light one");
    // The light one stays: a millionth more or less.
    let weight = 6.0 / 6.001;
    assert!(near(travel, weight * 3.5 / 3.0, 1e-9) && near(fall, weight * 0.4, 1e-9), "{travel} {fall}");
    assert!(near(angle, (0.4f64 / (3.5 / 3.0)).atan(), 1e-9), "{angle}");
    // Tops: 0.3 - 0.4 + 0.2 + 0.1 at x = 1, -0.4 + 0.2 at x = 1.5; the region begins at -1.
    assert!(near(height, 1.2, 1e-12), "{height}");
    assert!(heights[0].is_nan() && heights[1].is_nan() && near(heights[2], 0.2, 1e-9), "{heights:?}");
    assert!(near(heights[3], -0.2, 1e-9), "{heights:?}");
    // The other way it runs backwards, and the flying one is no front.
    let (backwards, _) = look(&text.replace("bins", "direction = \"-x\", bins"), 1.0);
    assert!(near(backwards[0], 0.9, 1e-12) && near(backwards[1], -1.0, 1e-12), "{backwards:?}");
    assert!(backwards[5].is_nan(), "no angle against the direction");
    // The control: half the way is refused by the same gate.
    assert!(!near(look(text, 0.5).0[0], 1.6, 0.1));
}

/// On gravity that is tilted by 30 degrees, what slides along x falls half of its way: the angle is that of the slope.
#[test]
fn a_tilted_world_has_its_travel_angle() {
    let angle = |gravity: &str| {
        let text = "run-out.region = { low = [0, -1], high = [2, 2] }";
        let plan = plan(2, &format!("gravity = {gravity}\n"), text);
        let mut out = open(&plan.watch["w"].measure, &plan);
        let slide = |x: f64| view(&[ball(x, 0.0, 0.1, 0.1)], Vec::new(), [None; 3]);
        once(&mut *out, &slide(0.0));
        let sample = once(&mut *out, &slide(1.5));
        ["travel angle", "travel", "fall"].map(|name| scalar(&*out, &sample, name))
    };
    let [tilted, travel, fall] = angle("[5, -8.660254037844386]");
    assert!(near(tilted, PI / 6.0, 1e-12) && near(travel, 1.5 * 0.75f64.sqrt(), 1e-12) && near(fall, 0.75, 1e-12));
    assert!(angle("10")[0].abs() < 1e-12, "the control: upright");
}

#[test]
fn both_go_on_after_a_checkpoint() {
    let looks: Vec<View> = (0..8)
        .map(|k| {
            let mut shown = pile(0.1 * f64::from(k));
            shown.time = f64::from(k);
            shown.grains.velocity.to_mut()[0].x = [0.0, 0.5][(k as usize / 2) % 2];
            shown
        })
        .collect();
    for text in
        ["bedload = { region = { low = [0, -1], high = [2, 2] } }", "run-out.region = { low = [0, -1], high = [2, 2] }"]
    {
        let fresh = || watch(2, text);
        let bits = |watch: &mut dyn Watch, k: usize| -> Vec<u64> {
            watch.take(&looks[k]).scalars.into_iter().map(f64::to_bits).collect()
        };
        let (mut whole, mut first, mut second, mut forgetful) = (fresh(), fresh(), fresh(), fresh());
        (0..3).for_each(|k| drop((bits(&mut *whole, k), bits(&mut *first, k))));
        let mut state = State::default();
        first.save("watch.w", &mut state);
        second.load("watch.w", &state).unwrap();
        let mut differs = false;
        for k in 3..8 {
            let seen = bits(&mut *whole, k);
            assert_eq!(seen, bits(&mut *second, k), "{text}, look {k}");
            differs |= seen != bits(&mut *forgetful, k);
        }
        assert!(differs, "the control: one that forgot");
        assert!(second.load("watch.other", &state).is_err());
    }
}

/// A disc that slides on a floor with friction: its travel angle needs no more than that it comes to rest, v^2 / 2 mu g.
#[test]
fn a_slider_runs_out_as_far_as_its_energy() {
    let text = r#"
gravity = 10
duration = "0.15 s"
[contact]
normal.hooke.stiffness = 1e4
tangential.spring = {}
rotation = false
[materials.quartz]
density = 2650
young-modulus = 1e9
friction = 0.5
restitution = 0.5
[particles.grain]
material = "quartz"
diameter = "2 mm"
start.at = { position = [[0, "1 mm"]], velocity = [[0.5, 0]] }
[walls.floor]
material = "quartz"
shape.plane = {}
[output]
history-interval = "10 ms"
[watch.w]
run-out = { direction = "x", region = { low = [0, 0], high = [1, 1] } }
[watch.load]
bedload = { width = "2 mm", region = { low = [0, 0], high = [1, 1] } }
"#;
    let folder = tempfile::tempdir().unwrap();
    let way = |changes: &[&str]| {
        let summary = done(text, changes, folder.path());
        match summary.results.get("w run-out final") {
            Some(ResultValue::Number(way)) => *way,
            other => panic!("{other:?}"),
        }
    };
    let exact = 0.25 / (2.0 * 0.5 * 10.0);
    let far = way(&[]);
    assert!(near(far, exact, 1e-2), "{far} {exact}");
    let history = Table::read(&folder.path().join("history.csv")).unwrap();
    let stopped = history.numbers("load stopped [-]").unwrap();
    assert_eq!(stopped.iter().filter(|s| **s > 0.0).count(), 1, "{stopped:?}");
    assert!(!near(way(&["materials.quartz.friction=0.6"]), exact, 1e-2), "the control: another friction");
}
