//! One step, any state: signs, limits, finite numbers.

use super::{Numbers, Subject, stack};
use proptest::prelude::*;
use tsubu::contact::chunk::Chunk;
use tsubu_scene::plan::{Cohesion, Contact, Damping, MindlinForm, Rolling, Tangential, Twisting};

/// Random geometry and motion into all rows: overlaps of up to a tenth of the radius, a few beyond touch, some exactly zero.
fn fill(chunk: &mut Chunk, numbers: &mut Numbers, speed: f64) {
    for i in 0..chunk.rows() {
        let radius = 10f64.powf(numbers.between(-4.0, -1.0));
        let kind = numbers.between(0.0, 1.0);
        let overlap = radius * 10f64.powf(numbers.between(-12.0, -1.0));
        chunk.overlap[i] = if kind < 0.05 {
            0.0
        } else if kind < 0.2 {
            -overlap
        } else {
            overlap
        };
        chunk.effective_radius[i] = radius;
        chunk.effective_mass[i] = 1e4 * radius.powi(3) * numbers.between(0.5, 2.0);
        let normal = numbers.vector(1.0).normalize();
        let flat = |v: glam::DVec3| v - normal * v.dot(normal);
        Chunk::set(&mut chunk.normal, i, normal);
        chunk.closing[i] = numbers.between(-speed, speed);
        let still = if numbers.between(0.0, 1.0) < 0.1 { 0.0 } else { 1.0 };
        let slip = flat(numbers.vector(speed)) * still;
        Chunk::set(&mut chunk.slip, i, slip);
        let roll = flat(numbers.vector(speed / radius)) * still;
        Chunk::set(&mut chunk.roll, i, roll);
        chunk.twist[i] = numbers.between(-speed, speed) / radius * still;
    }
}

/// What is wrong with a row after a step of `dt`, whose history held `held` joules before; empty if nothing.
fn faults(subject: &Subject, chunk: &Chunk, i: usize, held: f64, dt: f64) -> String {
    let contact = &subject.contact;
    let force = chunk.normal_force[i];
    let tangential = Chunk::vector(&chunk.tangential_force, i);
    let torque = Chunk::vector(&chunk.torque, i);
    let mut faults = String::new();
    let mut ask = |good: bool, what: &str| {
        if !good {
            faults += what;
        }
    };
    let numbers = [force, tangential.length(), torque.length(), chunk.stored[i], chunk.damping_force[i]];
    let losses = [chunk.lost_normal[i], chunk.lost_sliding[i], chunk.lost_rolling[i]];
    let finite = numbers.iter().chain(&losses).all(|x| x.is_finite());
    ask(finite && chunk.history.iter().all(|column| column[i].is_finite()), "not finite; ");
    let cohesive = stack::attracts(contact);
    ask(force >= 0.0 || cohesive || contact.attraction, "pulls; ");
    let pull = chunk.pull_off[i];
    ask(pull == 0.0 || cohesive, "cohesion from nowhere; ");
    // Damping alone never pulls: the force stays above that of the elastic and adhesive parts, or above zero.
    let elastic = force - chunk.damping_force[i];
    ask(contact.attraction || force >= elastic.min(0.0) - 1e-12 * elastic.abs(), "damping pulls; ");
    let spring = if let Tangential::Spring { cohesion, .. } = contact.tangential { cohesion } else { 0.0 };
    let cone = subject.constants.friction * (force + pull).max(0.0) + spring;
    ask(tangential.length() <= cone * (1.0 + 1e-12), "outside the cone; ");
    let disc = chunk.contact_radius[i];
    let load = (force + pull).max(0.0);
    let normal = Chunk::vector(&chunk.normal, i);
    let (twisting, rolling) = (torque.dot(normal).abs(), (torque - normal * torque.dot(normal)).length());
    ask(twisting <= 0.2 * disc * load + 1e-9 * torque.length(), "twists too hard; ");
    // What has no spring may stop a motion within the step, and not turn it.
    let inertia = 0.4 * chunk.effective_mass[i] * chunk.effective_radius[i] * chunk.effective_radius[i];
    let slip = Chunk::vector(&chunk.slip, i).length();
    let gentle = |force: f64, mass: f64, speed: f64| force * dt <= 0.5 * mass * speed * (1.0 + 1e-9) + 1e-300;
    if matches!(contact.tangential, Tangential::Coulomb { .. }) {
        ask(gentle(tangential.length(), chunk.effective_mass[i], slip), "turns the slip; ");
    }
    let springless = [Rolling::Constant { smoothing_speed: 1e-3 }, Rolling::ContactWidth { smoothing_speed: 1e-3 }];
    if springless.contains(&contact.rolling) || matches!(contact.rolling, Rolling::Viscous { .. }) {
        let speed = Chunk::vector(&chunk.roll, i).length();
        ask(gentle(rolling - 1e-9 * torque.length(), inertia, speed), "turns the rolling; ");
    }
    if matches!(contact.twisting, Twisting::Sliding { .. }) {
        ask(gentle(twisting - 1e-9 * torque.length(), inertia, chunk.twist[i].abs()), "turns the twisting; ");
    }
    let arm = match contact.rolling {
        Rolling::ContactWidth { .. } => 8f64.sqrt() * disc,
        Rolling::Viscous { .. } => f64::INFINITY,
        _ => chunk.effective_radius[i],
    };
    ask(load == 0.0 || rolling <= 0.1 * arm * load + 1e-9 * torque.length(), "resists rolling too hard; ");
    ask(tangential.dot(normal).abs() <= 1e-9 * tangential.length(), "friction along the normal; ");
    // The secant form makes energy where a sheared contact is pressed; that is its known fault.
    let secant = matches!(contact.tangential, Tangential::Mindlin { form: MindlinForm::Secant, .. });
    let turn = Chunk::vector(&chunk.roll, i).length() + chunk.twist[i].abs();
    let noise = 1e-12 * (held.abs() + chunk.stored[i].abs()) / dt;
    // Thrown from one overlap to another, a bound contact of JKR can part where it is deep in its well.
    let thrown = matches!(contact.cohesion, Cohesion::Jkr {});
    ask(thrown || losses[0] >= -noise - 1e-12 * force.abs() * chunk.closing[i].abs(), "damping gives energy; ");
    ask(losses[1] >= -noise - 1e-12 * tangential.length() * slip || secant, "friction gives energy; ");
    ask(losses[2] >= -noise - 1e-12 * torque.length() * turn, "rolling gives energy; ");
    ask(chunk.stored[i] >= 0.0 || cohesive, "stores less than nothing; ");
    if disc == 0.0 {
        ask(force == 0.0 && tangential.length() == 0.0 && torque.length() == 0.0, "acts without touch; ");
    }
    faults
}

/// The first fault over some steps in a row, every second one at a new place and speed: where the speed has changed a spring is
/// stretched by the mean of both, and what a step takes from it tells less than what several do.
fn first_fault(subject: &Subject, seed: u64, speed: f64, dt: f64) -> String {
    let mut numbers = Numbers::new(seed);
    let mut chunk = subject.chunk(24);
    for step in 0..3 {
        fill(&mut chunk, &mut numbers, speed);
        subject.law.apply(&mut chunk, dt);
        let history = |chunk: &Chunk, i: usize| chunk.history.iter().map(|column| column[i]).collect::<Vec<_>>();
        let held: Vec<f64> = (0..chunk.rows()).map(|i| subject.law.held(&history(&chunk, i))).collect();
        subject.apply(&mut chunk, dt);
        for (i, held) in held.into_iter().enumerate() {
            let faults = faults(subject, &chunk, i, held, dt);
            if !faults.is_empty() {
                return format!("{:?}: step {step}, row {i}: {faults}", subject.contact);
            }
        }
    }
    String::new()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// Repels when pressed, damping does not pull, friction inside the cone, no part gives energy, nothing acts without touch;
    /// finite always, with any history, at any step.
    #[test]
    fn every_law_is_a_law(seed in 0u64..1 << 60, speed in -3.0f64..4.0, step in -9.0f64..-3.0) {
        for subject in stack::ALL.iter() {
            let fault = first_fault(subject, seed, 10f64.powf(speed), 10f64.powf(step));
            prop_assert!(fault.is_empty(), "{fault}");
        }
    }
}

/// A first touch: friction acts against the slip, rolling resistance against the rolling, and so on.
#[test]
fn a_first_touch_resists() {
    let mut numbers = Numbers::new(7);
    for subject in stack::ALL.iter() {
        let mut chunk = subject.chunk(24);
        fill(&mut chunk, &mut numbers, 1.0);
        subject.apply(&mut chunk, 1e-6);
        for i in 0..chunk.rows() {
            let slip = Chunk::vector(&chunk.slip, i).dot(Chunk::vector(&chunk.tangential_force, i));
            let torque = Chunk::vector(&chunk.torque, i);
            let roll = Chunk::vector(&chunk.roll, i).dot(torque);
            let twist = chunk.twist[i] * Chunk::vector(&chunk.normal, i).dot(torque);
            let noise = 1e-9 * torque.length() * chunk.twist[i].abs();
            assert!(slip <= 0.0 && roll <= noise && twist <= noise, "{:?}: {slip} {roll} {twist}", subject.contact);
        }
    }
}

/// The gates refuse laws that are wrong in one sign or one factor.
#[test]
fn spoiled_laws_are_refused() {
    type Spoil = fn(&mut Chunk);
    let spoils: [(&str, Spoil); 6] = [
        ("pulls", |c| c.normal_force.iter_mut().for_each(|f| *f = -*f)),
        ("outside the cone", |c| c.tangential_force.iter_mut().flat_map(|k| k.iter_mut()).for_each(|f| *f *= 1.01)),
        ("damping gives energy", |c| c.lost_normal.iter_mut().for_each(|f| *f = -*f)),
        ("rolling gives energy", |c| c.lost_rolling.iter_mut().for_each(|f| *f = -*f)),
        ("twists too hard", |c| c.torque.iter_mut().flat_map(|k| k.iter_mut()).for_each(|f| *f *= 1.1)),
        ("acts without touch", |c| c.normal_force.iter_mut().for_each(|f| *f += 1.0)),
    ];
    let contact = Contact {
        damping: Damping::Quarter {},
        tangential: stack::mindlin(MindlinForm::Incremental),
        rolling: Rolling::Constant { smoothing_speed: 1e-3 },
        twisting: Twisting::Sliding { smoothing_spin: 1e-3 },
        ..stack::hertz()
    };
    let good = stack::subject(&contact);
    assert_eq!(first_fault(&good, 1, 1.0, 1e-6), "");
    for (what, spoil) in spoils {
        let fault = first_fault(&good.spoiled(spoil), 1, 1.0, 1e-6);
        assert!(fault.contains(what), "{what}: {fault}");
    }
}

/// Without cohesion every law of cohesion is the law without it, to the bit.
#[test]
fn no_cohesion_is_no_cohesion() {
    let mut same = 0;
    for subject in stack::PAIRS.iter().filter(|s| !matches!(s.contact.cohesion, Cohesion::None {})) {
        let bare = stack::subject(&Contact { cohesion: Cohesion::None {}, ..subject.contact.clone() });
        let mut dry = subject.spoiled(|_| {});
        (dry.constants.surface_energy, dry.constants.cohesion) = (0.0, 0.0);
        let run = |subject: &Subject| {
            let (mut chunk, mut numbers) = (subject.chunk(128), Numbers::new(3));
            for _ in 0..3 {
                fill(&mut chunk, &mut numbers, 1.0);
                subject.apply(&mut chunk, 1e-6);
            }
            let columns = [&chunk.normal_force, &chunk.stored, &chunk.damping_force, &chunk.lost_normal];
            let more =
                chunk.tangential_force.iter().chain(&chunk.torque).chain([&chunk.lost_sliding, &chunk.lost_rolling]);
            columns.into_iter().chain(more).flat_map(|c| c[..128].iter().map(|x| x.to_bits())).collect::<Vec<_>>()
        };
        assert_eq!(run(&bare), run(&dry), "{:?}", subject.contact);
        // The control: a little surface energy is seen.
        (dry.constants.surface_energy, dry.constants.cohesion) = (1e-9, 1e-9);
        assert_ne!(run(&bare), run(&dry), "{:?}", subject.contact);
        same += 1;
    }
    assert!(same > 50, "{same}");
}
