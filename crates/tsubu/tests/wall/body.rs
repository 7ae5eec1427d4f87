//! Free rigid bodies against the theory of tops.

use glam::{DQuat, DVec3};
use std::f64::consts::PI;
use tsubu::partner::Hosts;
use tsubu::wall::{Body, Exchange, Wall};
use tsubu_frame::State;
use tsubu_scene::plan::{self, Shape};

const INERTIA: DVec3 = DVec3::new(1.0, 2.0, 3.5);

fn body(inertia: DVec3, spin: DVec3, gravity: DVec3) -> Body {
    let plan = plan::Body {
        mass: 2.0,
        inertia: inertia.to_array(),
        centre: [0.1, 0.2, 0.3],
        velocity: [1.0, -0.5, 2.0],
        spin: spin.to_array(),
    };
    Body::new(&plan, gravity)
}

fn free_step(body: &mut Body, dt: f64) {
    body.before(dt);
    body.after(DVec3::ZERO, DVec3::ZERO, dt);
}

/// Torque-free asymmetric body: energy and angular momentum stay within 1e-6 over 1e5 steps. Turning with the spin of
/// the beginning of the step (an exponential map of first order) does not.
#[test]
fn torque_free_body_keeps_its_energy() {
    let (spin, dt) = (DVec3::new(0.6, 1.1, 0.4), 1e-3);
    let mut body = body(INERTIA, spin, DVec3::ZERO);
    let (energy, momentum) = (body.kinetic().1, body.angular_momentum());
    let (mut naive, mut worst, mut naive_worst) = (DQuat::IDENTITY, 0.0f64, 0.0f64);
    for _ in 0..100_000 {
        free_step(&mut body, dt);
        worst = worst.max((body.kinetic().1 / energy - 1.0).abs());
        assert!((body.angular_momentum() - momentum).length() <= 1e-6 * momentum.length());
        let spin = naive * ((naive.conjugate() * momentum) / INERTIA);
        naive = (DQuat::from_scaled_axis(spin * dt) * naive).normalize();
        let own = naive.conjugate() * momentum;
        naive_worst = naive_worst.max((0.5 * own.dot(own / INERTIA) / energy - 1.0).abs());
    }
    assert!(worst < 1e-6, "{worst}");
    assert!(naive_worst > 1e-5, "the naive map passes the gate: {naive_worst}");
}

/// A body spinning about its middle axis flips; the time between flips is 2 K(k) / lambda (Landau and Lifshitz,
/// Mechanics, section 37).
#[test]
fn intermediate_axis_flips_in_time() {
    let [i1, i2, i3] = INERTIA.to_array();
    let (spin, dt) = (DVec3::new(0.01, 5.0, 0.02), 1e-4);
    let momentum = INERTIA * spin;
    let (energy2, momentum2) = (spin.dot(momentum), momentum.length_squared());
    let flip = |i1: f64, i2: f64, i3: f64| {
        // For L^2 > 2 E I2; otherwise axes 1 and 3 change places.
        let (i1, i3) = if momentum2 > energy2 * i2 { (i1, i3) } else { (i3, i1) };
        let lambda = ((i3 - i2) * (momentum2 - energy2 * i1) / (i1 * i2 * i3)).sqrt();
        let k2 = (i2 - i1) * (energy2 * i3 - momentum2) / ((i3 - i2) * (momentum2 - energy2 * i1));
        2.0 * complete_elliptic(k2) / lambda
    };
    let mut body = body(INERTIA, spin, DVec3::ZERO);
    let mut crossings = Vec::new();
    let mut last = 5.0;
    for step in 1..=200_000 {
        free_step(&mut body, dt);
        let own = (body.rotation().conjugate() * body.spin()).y;
        if own * last < 0.0 {
            crossings.push(dt * (f64::from(step) - own / (own - last)));
        }
        last = own;
    }
    assert!(crossings.len() >= 4, "{crossings:?}");
    let exact = flip(i1, i2, i3);
    for pair in crossings.windows(2) {
        assert!(((pair[1] - pair[0]) / exact - 1.0).abs() < 1e-6, "{} {exact}", pair[1] - pair[0]);
    }
    // Half a per cent more about the middle axis, and the same gate refuses.
    assert!((flip(i1, 1.005 * i2, i3) / exact - 1.0).abs() > 1e-4);
}

/// Complete elliptic integral of the first kind K(k), by the arithmetic-geometric mean.
fn complete_elliptic(k2: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k2).sqrt());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// A symmetric top's axis goes round L with L / I1.
#[test]
fn symmetric_top_precesses() {
    let inertia = DVec3::new(1.0, 1.0, 1.6);
    let dt = 1e-4;
    let mut body = body(inertia, DVec3::new(0.3, 0.0, 4.0), DVec3::ZERO);
    let momentum = body.angular_momentum();
    let rate = momentum.length() / inertia.x;
    let steps = 50_000;
    for _ in 0..steps {
        free_step(&mut body, dt);
    }
    let turned = DQuat::from_axis_angle(momentum.normalize(), rate * dt * f64::from(steps));
    assert!((body.rotation() * DVec3::Z - turned * DVec3::Z).length() < 1e-5);
}

/// Free fall is exact: velocity Verlet is, under a constant force.
#[test]
fn falls_as_it_should() {
    let gravity = DVec3::new(0.0, 0.0, -9.8);
    let mut body = body(INERTIA, DVec3::X, gravity);
    let energy = |b: &Body| b.kinetic().0 + b.potential();
    let opening = energy(&body);
    for _ in 0..1000 {
        free_step(&mut body, 1e-3);
    }
    let exact = DVec3::new(0.1, 0.2, 0.3) + DVec3::new(1.0, -0.5, 2.0) + 0.5 * gravity;
    assert!(body.centre().distance(exact) < 1e-12);
    assert!((energy(&body) - opening).abs() < 1e-11);
}

/// Hung by a spring off its centre: force and torque come at the same time levels, so the total energy is kept to
/// second order. A torque one step late is not.
#[test]
fn energy_under_force_and_torque() {
    const STIFFNESS: f64 = 400.0;
    let hook = DVec3::new(0.2, -0.1, 0.3);
    let miss = |dt: f64, late: bool| {
        let mut body = body(INERTIA * 0.05, DVec3::new(1.0, 3.0, -2.0), DVec3::new(0.0, 0.0, -9.8));
        let pull = |b: &Body| {
            let arm = b.rotation() * hook;
            let stretch = b.centre() + arm;
            (-STIFFNESS * stretch, arm.cross(-STIFFNESS * stretch), 0.5 * STIFFNESS * stretch.length_squared())
        };
        let total = |b: &Body| b.kinetic().0 + b.kinetic().1 + b.potential() + pull(b).2;
        let (force, mut torque, _) = pull(&body);
        body.start(force, torque);
        let opening = total(&body);
        let mut worst = 0.0f64;
        for _ in 0..(2.0 / dt) as usize {
            body.before(dt);
            let (force, now, _) = pull(&body);
            body.after(force, if late { torque } else { now }, dt);
            torque = now;
            worst = worst.max((total(&body) - opening).abs());
        }
        worst
    };
    let (coarse, fine) = (miss(1e-3, false), miss(5e-4, false));
    assert!(coarse < 5e-2, "{coarse}");
    assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
    assert!(miss(1e-3, true) > 10.0 * coarse, "a late torque passes the gate: {}", miss(1e-3, true));
}

#[test]
fn resumes_with_the_same_bits() {
    let go = |body: &mut Body, steps: u32| {
        for _ in 0..steps {
            body.before(1e-3);
            let push = DVec3::new(0.1, 0.2, 0.3) - body.centre();
            body.after(push, push.cross(DVec3::X), 1e-3);
        }
    };
    let new = || body(INERTIA, DVec3::ONE, DVec3::NEG_Z);
    let mut through = new();
    go(&mut through, 50);
    let mut state = State::default();
    through.save("wall.block", &mut state);
    let mut resumed = new();
    resumed.load("wall.block", &state).unwrap();
    go(&mut through, 50);
    go(&mut resumed, 50);
    assert_eq!(through, resumed);
}

/// A wall that is a body goes where the body goes, and its material has the body's velocity.
#[test]
fn wall_follows_its_body() {
    let shape = Shape::Sphere { centre: [0.1, 0.2, 0.3], radius: 0.5 };
    let mut plan = super::plan_wall(shape);
    plan.body = Some(plan::Body {
        mass: 2.0,
        inertia: INERTIA.to_array(),
        centre: [0.1, 0.2, 0.3],
        velocity: [1.0, 0.0, 0.5],
        spin: [0.5, 2.0, -1.0],
    });
    let hosts = Hosts::default();
    let mut wall = Wall::new("stone", &plan, 3, &hosts, DVec3::NEG_Z);
    let opening = wall.energy();
    let (point, dt) = (DVec3::new(0.4, 0.2, 0.7), 1e-4);
    let mut before = point;
    for step in 0..2000 {
        let expected = wall.velocity_at(before);
        wall.before(dt);
        wall.follow(0.0, &hosts);
        let now = wall.pose.to_world(point);
        let halfway = 0.5 * (expected + wall.velocity_at(now));
        assert!((now - before).distance(halfway * dt) < 1e-10, "{step}");
        assert_eq!(wall.after(DVec3::ZERO, DVec3::ZERO, dt), Exchange::default());
        before = now;
    }
    let energy = wall.energy();
    assert!((energy.0 + energy.1 - opening.0 - opening.1).abs() < 1e-7 * opening.0);
    // Fallen g t^2 / 2 = 0.02 m from 0.5 m/s upwards for 0.2 s.
    assert!((wall.pose.offset - DVec3::new(0.2, 0.0, 0.1 - 0.02)).length() < 1e-12);
    assert!((wall.nearest(0, wall.pose.origin() + DVec3::X).distance - 0.5).abs() < 1e-12);
}
