//! Rolling and twisting resistance, a contact at a time.

use super::{Subject, constants, stack};
use glam::DVec3;
use std::f64::consts::PI;
use tsubu::contact::Chunk;
use tsubu_scene::plan::{Contact, Damping, MindlinForm, Rolling, Twisting};

const RADIUS: f64 = 5e-3;
const STEP: f64 = 1e-5;

fn subject(rolling: Rolling) -> Subject {
    Subject::new(
        &Contact { rolling, tangential: stack::mindlin(MindlinForm::Incremental), ..stack::hertz() },
        constants(),
    )
}

/// A ball that rolls on a plane without slipping, 7/5 m r^2 against its torques, pressed down by its weight and driven by a
/// constant torque told as a share of mu_r r times its weight. Returns the spin and the angle turned after every step.
fn roll(mut act: impl FnMut(&mut Chunk), subject: &Subject, spin: f64, drive: f64, steps: usize) -> Vec<[f64; 2]> {
    let mass = 2500.0 * 4.0 / 3.0 * PI * RADIUS.powi(3);
    let (weight, inertia) = (9.81 * mass, 1.4 * mass * RADIUS * RADIUS);
    let mut chunk = subject.chunk(1);
    let stiffness = subject.pair(RADIUS, mass).stiffness;
    (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[2][0]) = (RADIUS, mass, -1.0);
    chunk.overlap[0] = (weight / stiffness).powf(2.0 / 3.0);
    let (mut spin, mut angle) = (spin, 0.0);
    (0..steps)
        .map(|_| {
            chunk.roll[1][0] = spin;
            act(&mut chunk);
            spin += (chunk.torque[1][0] + drive * 0.1 * RADIUS * weight) / inertia * STEP;
            angle += spin * STEP;
            [spin, angle]
        })
        .collect()
}

fn law(subject: &Subject) -> impl FnMut(&mut Chunk) {
    |chunk| subject.apply(chunk, STEP)
}

/// Residual rolling speed over the last fifth of a run, and whether it changed its sign there.
fn rest(run: &[[f64; 2]]) -> (f64, bool) {
    let tail = &run[run.len() * 4 / 5..];
    let most = tail.iter().map(|[w, _]| w.abs()).fold(0.0, f64::max);
    (most, tail.windows(2).any(|p| p[0][0] * p[1][0] < 0.0))
}

/// A rolling ball stops: with EPSD it comes to rest, without a dashpot it swings on, with a constant torque taken literally it
/// chatters about rest for ever (Ai 2011; verification.md V-23).
#[test]
fn a_rolling_ball_stops() {
    let epsd = subject(Rolling::Epsd { ratio: 2.25, damping_ratio: 0.3 });
    let run = roll(law(&epsd), &epsd, 5.0, 0.0, 200_000);
    assert!(rest(&run).0 < 1e-9, "{:?}", rest(&run));
    // It has rolled as far as the constant torque mu_r r N allows, 7/5 m r^2 w^2 / 2 = mu_r r N angle, but for the spring.
    let told = 0.7 * RADIUS * 25.0 / (0.1 * 9.81);
    assert!((run.last().unwrap()[1] / told - 1.0).abs() < 0.01, "{:?} {told}", run.last());

    let swinging = subject(Rolling::Epsd { ratio: 2.25, damping_ratio: 0.0 });
    assert!(rest(&roll(law(&swinging), &swinging, 5.0, 0.0, 200_000)).0 > 1e-3, "the control came to rest");
    let literal = |chunk: &mut Chunk| {
        epsd.apply(chunk, STEP);
        chunk.torque[1][0] = -0.1 * RADIUS * chunk.normal_force[0] * chunk.roll[1][0].signum();
    };
    let (speed, chatters) = rest(&roll(literal, &epsd, 5.0, 0.0, 200_000));
    assert!(speed > 1e-4 && chatters, "the literal constant torque came to rest: {speed:e}");
    // Limited so that no step turns the rolling, the constant torque and the contact width end quietly too.
    for rolling in [Rolling::Constant { smoothing_speed: 1e-6 }, Rolling::ContactWidth { smoothing_speed: 1e-6 }] {
        let limited = subject(rolling);
        let run = roll(law(&limited), &limited, 5.0, 0.0, 2_000_000);
        assert!(rest(&run).0 < 1e-9 && !rest(&run).1, "{:?}", rest(&run));
    }
}

/// On a slope below its limit EPSD holds and EPSD2 holds on average; constant torque creeps, viscous torque rolls; above the
/// limit nothing holds.
#[test]
fn a_ball_on_a_slope() {
    let distance = |rolling: Rolling, drive: f64| {
        let subject = subject(rolling);
        let run = roll(law(&subject), &subject, 0.0, drive, 100_000);
        run.last().unwrap()[1] - run[run.len() / 2][1]
    };
    let epsd = Rolling::Epsd { ratio: 2.25, damping_ratio: 0.3 };
    assert!(distance(epsd.clone(), 0.8).abs() < 1e-12);
    assert!(distance(Rolling::Epsd2 {}, 0.3).abs() < 1e-3);
    assert!(distance(Rolling::Spring { stiffness: 1e3, damping: 1.0 }, 0.8).abs() < 1e-9);
    // Creep at the share 0.8 of the smoothing speed.
    let creep = distance(Rolling::Constant { smoothing_speed: 1e-4 }, 0.8);
    assert!((creep / (0.8 * 1e-4 / RADIUS * 0.5) - 1.0).abs() < 0.01, "{creep:e}");
    // Viscous: C r w = 0.8, so w = 0.8 / (C r).
    let rolls = distance(Rolling::Viscous { coefficient: 10.0 }, 0.8);
    assert!((rolls / (0.8 / (10.0 * RADIUS) * 0.5) - 1.0).abs() < 0.05, "{rolls:e}");
    for rolling in [epsd, Rolling::Epsd2 {}, Rolling::Constant { smoothing_speed: 1e-4 }] {
        assert!(distance(rolling, 1.2) > 0.1);
    }
}

/// Spin-down of a ball whose contact does not slip back: w = w0 - 5 mu_r g t / (2 r) for 2/5 m r^2, here with 7/5
/// (verification.md V-22).
#[test]
fn spin_falls_steadily() {
    let constant = subject(Rolling::Constant { smoothing_speed: 1e-6 });
    let run = roll(law(&constant), &constant, 5.0, 0.0, 2000);
    let told = 5.0 - 0.1 * 9.81 / (1.4 * RADIUS) * 2000.0 * STEP;
    assert!((run.last().unwrap()[0] - told).abs() < 1e-9, "{:?} {told}", run.last());
}

/// One row of a contact between equal spheres of radius r.
fn row(subject: &Subject, overlap: f64) -> Box<Chunk> {
    let mut chunk = subject.chunk(1);
    (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[0][0], chunk.overlap[0]) =
        (0.5 * RADIUS, 1e-4, 1.0, overlap);
    chunk
}

/// Osada 2004: the energy lost per angle rolled is f N with f = f' b, b = 2 sqrt(r d) (verification.md V-24; spec B-6 item 10).
#[test]
fn contact_width_loses_f_n_per_angle() {
    let subject = subject(Rolling::ContactWidth { smoothing_speed: 1e-6 });
    let mut chunk = row(&subject, 1e-5);
    let (mut lost, mut angle) = (0.0, 0.0);
    for k in 0..1000 {
        let roll = DVec3::new(0.0, (f64::from(k) * 0.01).cos(), (f64::from(k) * 0.01).sin()) * 30.0;
        Chunk::set(&mut chunk.roll, 0, roll);
        subject.apply(&mut chunk, 1e-7);
        lost += chunk.lost_rolling[0] * 1e-7;
        angle += 30.0 * 1e-7;
    }
    let width = 2.0 * (RADIUS * 1e-5).sqrt();
    let told = 0.1 * width * chunk.normal_force[0];
    assert!((lost / angle / told - 1.0).abs() < 1e-12, "{} {told}", lost / angle);
    // The control: half the width of the disc of contact of Hertz, sqrt(R* d), on both sides.
    assert!((lost / angle / (0.1 * 2.0 * chunk.contact_radius[0] * chunk.normal_force[0]) - 1.0).abs() > 0.1);
}

/// LAMMPS's `rolling sds` (from its documentation), with its normal from the second to the first body: v = R (w_i - w_j) x n
/// in the sense that resists, F = -(k x + c v), torque on i R n x F.
#[test]
fn rolling_spring_is_that_of_lammps() {
    let (k, c) = (2e3, 0.05);
    let subject = subject(Rolling::Spring { stiffness: k, damping: c });
    let mut chunk = row(&subject, 1e-5);
    let (arm, normal, dt) = (0.5 * RADIUS, -DVec3::X, 1e-7);
    let (mut displacement, mut before) = (DVec3::ZERO, None);
    for step in 0..200 {
        let roll = DVec3::new(0.0, 0.3, -0.2 + 1e-3 * f64::from(step));
        Chunk::set(&mut chunk.roll, 0, roll);
        subject.apply(&mut chunk, dt);
        let velocity = arm * roll.cross(normal);
        // LAMMPS has the velocity of the half step here: the mean of both ends.
        displacement += 0.5 * (velocity + before.replace(velocity).unwrap_or(velocity)) * dt;
        let force = -(k * displacement + c * velocity);
        assert!(force.length() < 0.1 * chunk.normal_force[0], "it slides here");
        let torque = arm * normal.cross(force);
        assert!((Chunk::vector(&chunk.torque, 0) - torque).length() < 1e-12 * torque.length(), "{torque}");
        assert!(torque.dot(roll) < 0.0);
        // The control: the normal the other way round in one of the two products drives the rolling.
        assert!((Chunk::vector(&chunk.torque, 0) + torque).length() > torque.length());
    }
    // Sliding: the torque is mu_r R* N.
    Chunk::set(&mut chunk.roll, 0, DVec3::new(0.0, 3e4, 0.0));
    subject.apply(&mut chunk, dt);
    subject.apply(&mut chunk, dt);
    assert!((Chunk::vector(&chunk.torque, 0).length() / (0.1 * arm * chunk.normal_force[0]) - 1.0).abs() < 1e-12);
}

/// The damping ratio of EPSD on a plane: within the limit a swing shrinks by exp(-2 pi z / sqrt(1 - z^2)) each time.
#[test]
fn epsd_swings_with_its_damping_ratio() {
    for ratio in [0.05, 0.2] {
        let subject = subject(Rolling::Epsd { ratio: 2.25, damping_ratio: ratio });
        let run = roll(law(&subject), &subject, 1e-4, 0.0, 40_000);
        let higher = |w: &&[[f64; 2]]| w[1][0] > w[0][0] && w[1][0] >= w[2][0];
        let peaks: Vec<f64> = run.windows(3).filter(higher).map(|w| w[1][0]).collect();
        let told = |z: f64| (-2.0 * PI * z / (1.0 - z * z).sqrt()).exp();
        let found = peaks[1] / peaks[0];
        assert!((found / told(ratio) - 1.0).abs() < 0.03, "{found} {}", told(ratio));
        // The control: twice the damping, as for the inertia of a pair.
        assert!((found / told(2.0 * ratio) - 1.0).abs() > 0.03);
    }
}

/// Stiffnesses of the rolling springs: EPSD ratio k_n (mu_r R*)^2 with the secant k_n = f/d, EPSD2 k_t R*^2.
#[test]
fn rolling_stiffnesses_are_as_told() {
    for (rolling, epsd) in [(Rolling::Epsd { ratio: 2.25, damping_ratio: 0.0 }, true), (Rolling::Epsd2 {}, false)] {
        let subject = subject(rolling);
        let mut chunk = row(&subject, 1e-5);
        chunk.roll[1][0] = 1e-3;
        for _ in 0..10 {
            subject.apply(&mut chunk, 1e-7);
        }
        let arm = 0.5 * RADIUS;
        let shear = 8.0 * 0.06e9 * (arm * 1e-5_f64).sqrt();
        let secant = chunk.normal_force[0] / 1e-5;
        let told = if epsd { 2.25 * secant * (0.1 * arm).powi(2) } else { shear * arm * arm };
        assert!((-chunk.torque[1][0] / (told * 1e-9) - 1.0).abs() < 1e-9, "{} {told}", chunk.torque[1][0]);
    }
}

/// Twisting: 2/3 mu_t a N where it slides, and a spring of k_t a^2 / 2 before that (Marshall 2009).
#[test]
fn twisting_is_that_of_a_disc() {
    for twisting in [Twisting::Sliding { smoothing_spin: 1e-6 }, Twisting::Spring {}] {
        let spring = twisting == Twisting::Spring {};
        let (damping, tangential) = (Damping::Dashpot { coefficient: 0.5 }, stack::mindlin(MindlinForm::Incremental));
        let subject = Subject::new(&Contact { twisting, damping, tangential, ..stack::hertz() }, constants());
        let mut chunk = row(&subject, 1e-5);
        let disc = (0.5 * RADIUS * 1e-5_f64).sqrt();
        if spring {
            chunk.twist[0] = 1e-3;
            for _ in 0..10 {
                subject.apply(&mut chunk, 1e-7);
            }
            let told = 0.5 * 8.0 * 0.06e9 * disc.powi(3) * 1e-9;
            let dashpot = 0.5 * 0.5 * disc * disc * 1e-3;
            assert!((-chunk.torque[0][0] / (told + dashpot) - 1.0).abs() < 1e-9, "{} {told}", chunk.torque[0][0]);
            let history: Vec<f64> = chunk.history.iter().map(|column| column[0]).collect();
            assert!((subject.law.held(&history) / (0.5 * told * 1e-9) - 1.0).abs() < 1e-9);
        }
        chunk.twist[0] = 1e5;
        for _ in 0..10 {
            subject.apply(&mut chunk, 1e-7);
        }
        let told = 2.0 / 3.0 * 0.3 * disc * chunk.normal_force[0];
        assert!((-chunk.torque[0][0] / told - 1.0).abs() < 1e-9, "{} {told}", chunk.torque[0][0]);
        // The control: the torque of a ring, mu a N.
        assert!((-chunk.torque[0][0] / (1.5 * told) - 1.0).abs() > 0.1);
    }
}
