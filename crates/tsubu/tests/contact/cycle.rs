//! Loading and unloading: no cycle gives energy, and what is not stored is lost.

use super::{Subject, stack};
use std::f64::consts::TAU;
use tsubu::contact::chunk::Chunk;
use tsubu_scene::plan::{Cohesion, Contact, Damping, MindlinForm, Tangential};

/// What a cycle did, by row.
#[derive(Clone, Copy, Debug, Default)]
struct Balance {
    /// Work taken from the motion [J].
    work: f64,
    /// Told as lost [J].
    lost: f64,
    /// Most energy stored on the way [J].
    most: f64,
    /// Largest work so far that was told neither as lost nor as stored [J].
    missing: f64,
    /// Told as stored at the end and not held by the history [J].
    left: f64,
}

/// Presses, shears, rolls and twists from no touch to no touch, side to side once within the push; rows differ in how far.
fn cycle(subject: &Subject, steps: u32) -> [Balance; 8] {
    let (mut balance, mut chunk) = ([Balance::default(); 8], subject.chunk(8));
    let (dt, reach) = (2e-4 / f64::from(steps), subject.law.reach(&subject.pair(1.5e-3, 1e-4)));
    for k in 0..steps {
        let angle = TAU * (f64::from(k) + 0.5) / f64::from(steps);
        let rate = TAU / (f64::from(steps) * dt);
        for i in 0..8 {
            // From apart, beyond what cohesion can hold, to a depth and back.
            let depth = 1e-6 * 4f64.powi((i / 2) as i32);
            let size = 0.5 * (depth + 2.0 * reach);
            chunk.overlap[i] = size * (1.0 - angle.cos()) - 2.0 * reach;
            chunk.closing[i] = size * rate * angle.sin();
            let width = depth * if i % 2 == 0 { 0.05 } else { 3.0 };
            let swing = width * rate * (angle + 0.3).cos();
            chunk.normal[0][i] = 1.0;
            chunk.slip[2][i] = swing;
            chunk.slip[1][i] = 0.2 * swing;
            chunk.roll[1][i] = swing / 1.5e-3;
            chunk.twist[i] = 3.0 * swing / 1.5e-3;
            (chunk.effective_radius[i], chunk.effective_mass[i]) = (1.5e-3, 1e-4);
        }
        subject.apply(&mut chunk, dt);
        for (i, b) in balance.iter_mut().enumerate() {
            let motions = [(&chunk.slip, &chunk.tangential_force), (&chunk.roll, &chunk.torque)];
            let [slip, roll] = motions.map(|(v, f)| Chunk::vector(v, i).dot(Chunk::vector(f, i)));
            let twist = chunk.twist[i] * chunk.torque[0][i];
            b.work += (chunk.normal_force[i] * chunk.closing[i] - slip - roll - twist) * dt;
            b.lost += (chunk.lost_normal[i] + chunk.lost_sliding[i] + chunk.lost_rolling[i]) * dt;
            b.most = b.most.max(chunk.stored[i].abs());
            b.missing = b.missing.max((b.work - b.lost - chunk.stored[i]).abs());
        }
    }
    for (i, b) in balance.iter_mut().enumerate() {
        // The contact opens: what its springs hold is lost, as in the engine.
        let history: Vec<f64> = chunk.history.iter().map(|column| column[i]).collect();
        b.lost += subject.law.held(&history);
        b.left = (chunk.stored[i] - subject.law.held(&history)).abs();
    }
    balance
}

/// Whether a cycle's books are in order: energy is not given, and work = lost, up to the coarseness of the steps.
fn fault(subject: &Subject, steps: u32) -> String {
    for (i, b) in cycle(subject, steps).into_iter().enumerate() {
        let scale = b.most + b.work.abs();
        let secant = matches!(subject.contact.tangential, Tangential::Mindlin { form: MindlinForm::Secant, .. });
        if b.work < -2e-3 * b.most && !secant {
            return format!("{:?}: row {i}: gave energy: {b:?}", subject.contact);
        }
        if (b.work - b.lost).abs() > 5e-3 * scale {
            return format!("{:?}: row {i}: work is not lost: {b:?}", subject.contact);
        }
        if b.left > 1e-2 * b.most {
            return format!("{:?}: row {i}: something is left: {b:?}", subject.contact);
        }
        if b.missing > 1e-2 * scale {
            return format!("{:?}: row {i}: work is missing: {b:?}", subject.contact);
        }
    }
    String::new()
}

#[test]
fn no_cycle_gives_energy_and_the_books_close() {
    for subject in stack::PAIRS.iter() {
        assert_eq!(fault(subject, 2000), "");
    }
}

/// The books close better with the step, to first order at least.
#[test]
fn the_books_close_with_the_step() {
    for cohesion in [Cohesion::None {}, Cohesion::Dmt {}, Cohesion::Jkr {}] {
        let contact = Contact {
            damping: Damping::Quarter {},
            tangential: stack::mindlin(MindlinForm::Incremental),
            cohesion,
            ..stack::hertz()
        };
        let subject = stack::subject(&contact);
        let miss = |steps| cycle(&subject, steps).iter().map(|b| (b.work - b.lost).abs() / b.most).fold(0.0, f64::max);
        let (coarse, fine) = (miss(1000), miss(8000));
        assert!(fine < 0.2 * coarse || fine < 1e-6, "{:?}: {coarse:e} {fine:e}", contact.cohesion);
    }
}

/// The gates refuse a law that loses less than it says, and one whose friction pushes.
#[test]
fn spoiled_books_are_refused() {
    let contact = Contact {
        damping: Damping::Quarter {},
        tangential: stack::mindlin(MindlinForm::Incremental),
        ..stack::hertz()
    };
    let good = stack::subject(&contact);
    let light: fn(&mut Chunk) = |c| c.stored.iter_mut().for_each(|s| *s *= 0.95);
    assert!(fault(&good.spoiled(light), 2000).contains("work is missing"));
    let less: fn(&mut Chunk) = |c| c.lost_normal.iter_mut().for_each(|l| *l *= 0.9);
    assert!(fault(&good.spoiled(less), 2000).contains("work is not lost"));
    let keep: fn(&mut Chunk) = |c| c.stored.iter_mut().for_each(|s| *s += 1e-6);
    assert!(fault(&good.spoiled(keep), 2000).contains("something is left"));
    let elastic = stack::subject(&Contact { damping: Damping::None {}, ..contact });
    let push: fn(&mut Chunk) = |c| c.tangential_force.iter_mut().flat_map(|k| k.iter_mut()).for_each(|f| *f = -*f);
    assert!(fault(&elastic.spoiled(push), 2000).contains("gave energy"));
}

/// The secant form does make energy: sheared when shallow, set free when deep. The incremental form does not.
#[test]
fn pressing_a_sheared_contact_makes_energy_in_the_secant_form_only() {
    let gain = |form| {
        let contact = Contact { tangential: stack::mindlin(form), ..stack::hertz() };
        let (subject, mut work) = (stack::subject(&contact), 0.0);
        let mut chunk = subject.chunk(1);
        (chunk.normal[0][0], chunk.effective_radius[0], chunk.effective_mass[0]) = (1.0, 1.5e-3, 1e-4);
        let steps = 1000;
        // Four strokes: shear at a depth of 1 um, press to 16 um, shear back, let go to 1 um.
        for stroke in 0..4 {
            for k in 0..steps {
                let part = (f64::from(k) + 0.5) / f64::from(steps);
                let dt = 1e-6;
                let depth = [1e-6, 1e-6 + 15e-6 * part, 16e-6, 16e-6 - 15e-6 * part][stroke];
                let closing = [0.0, 15e-6, 0.0, -15e-6][stroke] / (f64::from(steps) * dt);
                let slip = [1e-7, 0.0, -1e-7, 0.0][stroke] / (f64::from(steps) * dt);
                (chunk.overlap[0], chunk.closing[0], chunk.slip[2][0]) = (depth, closing, slip);
                subject.apply(&mut chunk, dt);
                work += (chunk.normal_force[0] * closing - chunk.tangential_force[2][0] * slip) * dt;
            }
        }
        // Against what the spring takes at the smaller depth, k_t x^2 / 2 with k_t = 8 G* sqrt(R* d).
        -work / (4.0 * 0.06e9 * (1.5e-3_f64 * 1e-6).sqrt() * 1e-14)
    };
    // The spring is four times as stiff at 16 um: it gives back four times what it took.
    assert!((gain(MindlinForm::Secant) - 3.0).abs() < 0.02, "{}", gain(MindlinForm::Secant));
    assert!(gain(MindlinForm::Incremental) < 0.0, "{}", gain(MindlinForm::Incremental));
}
