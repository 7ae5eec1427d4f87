//! A law does not know who looks at it: bodies changed, axes turned, frame turning.

use super::{Numbers, Subject, stack};
use glam::{DQuat, DVec3};
use tsubu::contact::chunk::{Chunk, Column};
use tsubu_scene::plan::{Contact, MindlinForm, Rolling};

/// One random state: overlap, closing, twist, normal, slip, roll.
fn state(numbers: &mut Numbers) -> ([f64; 3], [DVec3; 3]) {
    let normal = numbers.vector(1.0).normalize();
    let flat = |v: DVec3| v - normal * v.dot(normal);
    let scalars = [numbers.between(-1e-6, 2e-5), numbers.between(-1.0, 1.0), numbers.between(-300.0, 300.0)];
    (scalars, [normal, flat(numbers.vector(1.0)), flat(numbers.vector(300.0))])
}

fn set(chunk: &mut Chunk, i: usize, [overlap, closing, twist]: [f64; 3], [normal, slip, roll]: [DVec3; 3]) {
    (chunk.overlap[i], chunk.closing[i], chunk.twist[i]) = (overlap, closing, twist);
    (chunk.effective_radius[i], chunk.effective_mass[i]) = (1.5e-3, 1e-4);
    Chunk::set(&mut chunk.normal, i, normal);
    Chunk::set(&mut chunk.slip, i, slip);
    Chunk::set(&mut chunk.roll, i, roll);
}

fn history(chunk: &Chunk, i: usize) -> Vec<f64> {
    chunk.history.iter().map(|column: &Column| column[i]).collect()
}

/// Whether two chunks, which see the same contact from both bodies, agree to the bit.
fn agree_changed(subject: &Subject) -> bool {
    let (mut one, mut other) = (subject.chunk(4), subject.chunk(4));
    let mut numbers = Numbers::new(11);
    (0..4).all(|_| {
        for i in 0..4 {
            let (scalars, vectors) = state(&mut numbers);
            set(&mut one, i, scalars, vectors);
            set(&mut other, i, scalars, vectors.map(|v| -v));
        }
        subject.apply(&mut one, 1e-6);
        subject.apply(&mut other, 1e-6);
        (0..4).all(|i| {
            let mut turned = history(&one, i);
            subject.law.turned(&mut turned);
            turned == history(&other, i)
                && one.normal_force[i] == other.normal_force[i]
                && one.stored[i] == other.stored[i]
                && one.lost_sliding[i] == other.lost_sliding[i]
                && one.lost_rolling[i] == other.lost_rolling[i]
                && Chunk::vector(&one.tangential_force, i) == -Chunk::vector(&other.tangential_force, i)
                && Chunk::vector(&one.torque, i) == -Chunk::vector(&other.torque, i)
        })
    })
}

/// The second body feels the opposite of what the first feels, and a history can be handed over with the places changed.
#[test]
fn bodies_can_change_places() {
    for subject in stack::PAIRS.iter() {
        assert!(agree_changed(subject), "{:?}", subject.contact);
    }
    // The control: a force along an axis of the world is not felt the other way round by the other.
    let good = stack::subject(&stack::hertz());
    assert!(!agree_changed(&good.spoiled(|c| c.tangential_force[0].iter_mut().for_each(|f| *f += 1e-6))));
}

/// How far a law is from turning its results with its axes, against their size.
fn turns_with_axes(subject: &Subject) -> f64 {
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
    let (mut one, mut other) = (subject.chunk(4), subject.chunk(4));
    let (mut numbers, mut worst) = (Numbers::new(5), 0.0_f64);
    for _ in 0..4 {
        for i in 0..4 {
            let (scalars, vectors) = state(&mut numbers);
            set(&mut one, i, scalars, vectors);
            set(&mut other, i, scalars, vectors.map(|v| turn * v));
        }
        subject.apply(&mut one, 1e-6);
        subject.apply(&mut other, 1e-6);
        for i in 0..4 {
            for (a, b) in [(&one.tangential_force, &other.tangential_force), (&one.torque, &other.torque)] {
                let (a, b) = (Chunk::vector(a, i), Chunk::vector(b, i));
                worst = worst.max((turn * a - b).length() / a.length().max(1e-12));
            }
            worst = worst.max((one.stored[i] - other.stored[i]).abs() / one.stored[i].abs().max(1e-12));
        }
    }
    worst
}

#[test]
fn axes_do_not_matter() {
    for subject in stack::PAIRS.iter() {
        let miss = turns_with_axes(subject);
        assert!(miss < 1e-11, "{:?}: {miss:e}", subject.contact);
    }
    let good = stack::subject(&Contact { tangential: stack::mindlin(MindlinForm::Incremental), ..stack::hertz() });
    assert!(
        turns_with_axes(&good.spoiled(|c| c.tangential_force[0].iter_mut().for_each(|f| *f *= 1.0 + 1e-9))) > 1e-11
    );
}

/// Loads the springs of a contact with its normal along x, and then turns the whole frame by a radian about `axis` in steps of
/// `step`, nothing slipping in it. Returns by how much force and torque miss what turns with the frame, against their sizes.
fn turned_by_a_radian(subject: &Subject, axis: DVec3, step: f64) -> [f64; 2] {
    let mut chunk = subject.chunk(1);
    let still = [2e-5, 0.0, 0.0];
    set(&mut chunk, 0, [2e-5, 0.0, 100.0], [DVec3::X, DVec3::new(0.0, 3e-3, 0.0), DVec3::new(0.0, 0.0, 0.5)]);
    for _ in 0..100 {
        subject.apply(&mut chunk, 1e-6);
    }
    set(&mut chunk, 0, still, [DVec3::X, DVec3::ZERO, DVec3::ZERO]);
    subject.apply(&mut chunk, 1e-6);
    let before = [&chunk.tangential_force, &chunk.torque].map(|v| Chunk::vector(v, 0));
    let steps = (1.0 / step).round() as u32;
    let mut turn = DQuat::IDENTITY;
    for k in 1..=steps {
        turn = DQuat::from_axis_angle(axis, f64::from(k) / f64::from(steps));
        set(&mut chunk, 0, still, [turn * DVec3::X, DVec3::ZERO, DVec3::ZERO]);
        subject.apply(&mut chunk, 1e-6);
    }
    let after = [&chunk.tangential_force, &chunk.torque].map(|v| Chunk::vector(v, 0));
    [0, 1].map(|k| (turn * before[k] - after[k]).length() / before[k].length())
}

/// A contact that turns as a whole takes its springs along: exactly where the springs lie along or across the axis, and to the
/// order of the step otherwise.
#[test]
fn springs_turn_with_the_frame() {
    for rolling in [Rolling::Spring { stiffness: 1e4, damping: 0.0 }, Rolling::Epsd { ratio: 2.25, damping_ratio: 0.3 }]
    {
        for tangential in [MindlinForm::Incremental, MindlinForm::Secant].map(stack::mindlin) {
            let subject = stack::subject(&Contact { tangential, rolling: rolling.clone(), ..stack::hertz() });
            for axis in [DVec3::Y, DVec3::Z] {
                let [force, torque] = turned_by_a_radian(&subject, axis, 0.01);
                assert!(force < 1e-12 && torque < 1e-12, "{axis}: {force:e} {torque:e}");
            }
            let across = DVec3::new(0.0, 1.0, 1.0).normalize();
            let [coarse, fine] = [0.01, 0.001].map(|step| turned_by_a_radian(&subject, across, step)[0]);
            assert!(fine < 3e-4 && (coarse / fine - 10.0).abs() < 0.5, "{coarse:e} {fine:e}");
            // What parts say they do not do: a frame that turns about the normal leaves the springs behind.
            let [force, _] = turned_by_a_radian(&subject, DVec3::X, 0.01);
            assert!((force - 2.0 * 0.5_f64.sin()).abs() < 1e-9, "{force}");
        }
    }
}
