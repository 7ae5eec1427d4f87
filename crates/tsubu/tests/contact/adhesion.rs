//! Adhesion against closed forms.

use super::{Subject, constants, stack};
use std::f64::consts::PI;
use tsubu::contact::Chunk;
use tsubu::contact::pair::Constants;
use tsubu_scene::plan::{Cohesion, Contact, Damping, Tangential};

const RADIUS: f64 = 1.5e-3;
const YOUNG: f64 = 1e7;
const GAMMA: f64 = 0.05;

fn sticky(cohesion: Cohesion, surface_energy: f64) -> Subject {
    let cohesion_constant = if matches!(cohesion, Cohesion::Sjkr {}) { 5e4 } else { 0.005 };
    let constants = Constants { effective_modulus: YOUNG, surface_energy, cohesion: cohesion_constant, ..constants() };
    Subject::new(&Contact { cohesion, ..stack::hertz() }, constants)
}

/// JKR as in verification.md 3.5: force and overlap for a radius of contact.
fn jkr(a: f64) -> (f64, f64) {
    let force = 4.0 * YOUNG * a.powi(3) / (3.0 * RADIUS) - 2.0 * PI * a * a * (4.0 * GAMMA * YOUNG / (PI * a)).sqrt();
    (force, a * a / RADIUS - 2.0 * (PI * GAMMA * a / YOUNG).sqrt())
}

/// Radius of contact at which JKR's force is least, found by search.
fn parting() -> f64 {
    let (mut low, mut high) = (1e-7, 1e-3);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
        if jkr(a).0 < jkr(b).0 { high = b } else { low = a }
    }
    0.5 * (low + high)
}

/// Presses and pulls slowly through the overlaps from `from` to `to`; for each: overlap, force, stored energy, energy lost so far.
fn pass(subject: &Subject, chunk: &mut Chunk, from: f64, to: f64, steps: u32) -> Vec<[f64; 4]> {
    let (dt, mut lost) = (1e-6, 0.0);
    (1..=steps)
        .map(|k| {
            chunk.overlap[0] = from + (to - from) * f64::from(k) / f64::from(steps);
            (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[0][0]) = (RADIUS, 1e-4, 1.0);
            subject.apply(chunk, dt);
            lost += chunk.lost_normal[0] * dt;
            [chunk.overlap[0], chunk.normal_force[0], chunk.stored[0], lost]
        })
        .collect()
}

/// Pull-off forces: 4 pi gamma R* (DMT), 3 pi gamma R* (JKR), gamma the energy of one face (verification.md V-08).
#[test]
fn pull_off_forces() {
    for (cohesion, factor) in [(Cohesion::Dmt {}, 4.0), (Cohesion::Jkr {}, 3.0)] {
        let subject = sticky(cohesion.clone(), GAMMA);
        let mut chunk = subject.chunk(1);
        let reach = subject.law.reach(&subject.pair(RADIUS, 1e-4));
        pass(&subject, &mut chunk, -2.0 * reach - 1e-9, 1e-6, 10);
        let pull = pass(&subject, &mut chunk, 1e-6, -1.5 * reach - 1e-12, 200_000);
        let least = pull.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
        assert!((-least / (factor * PI * GAMMA * RADIUS) - 1.0).abs() < 1e-3, "{cohesion:?}: {least:e}");
        // The control: gamma mistaken for the work of adhesion, the usual factor of 2.
        assert!((-least / (factor * PI * 0.5 * GAMMA * RADIUS) - 1.0).abs() > 1e-3);
        assert_eq!(pull.last().unwrap()[1], 0.0);
    }
}

/// JKR against its own equations: nothing before touch, eight ninths of the pull-off force at touch, the curve through pressing
/// and pulling, parting at the tensile limit and not before, the work of parting, and nothing again until touch.
#[test]
fn jkr_follows_its_curve_and_parts_at_its_limit() {
    let subject = sticky(Cohesion::Jkr {}, GAMMA);
    let mut chunk = subject.chunk(1);
    let apart = parting();
    let (limit, reach) = (jkr(apart).1, subject.law.reach(&subject.pair(RADIUS, 1e-4)));
    assert!((reach / -limit - 1.0).abs() < 1e-6, "{reach:e} {limit:e}");
    let pull_off = 3.0 * PI * GAMMA * RADIUS;

    let before = pass(&subject, &mut chunk, limit, -1e-12, 100);
    assert!(before.iter().all(|row| row[1..] == [0.0; 3]), "acts before touch");
    let touch = pass(&subject, &mut chunk, 0.0, 0.0, 1)[0];
    assert!((touch[1] / (-8.0 / 9.0 * pull_off) - 1.0).abs() < 1e-9, "{touch:?}");

    // The curve, by the radius of contact that the row reports and by the one that belongs to its force.
    let mut rows = pass(&subject, &mut chunk, 0.0, 2e-5, 500);
    rows.extend(pass(&subject, &mut chunk, 2e-5, 0.999 * limit, 500));
    for [overlap, force, ..] in &rows {
        let (mut low, mut high) = (apart, 1e-3);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if jkr(middle).1 < *overlap { low = middle } else { high = middle }
        }
        let told = jkr(low).0;
        assert!((force - told).abs() < 1e-9 * pull_off + 1e-9 * told.abs(), "{overlap:e}: {force:e} {told:e}");
    }
    assert!((chunk.contact_radius[0] / apart - 1.0).abs() < 0.05);

    // Stored energy is the work of the force along the way, and nothing of it is left at the limit.
    let mut worst = 0.0_f64;
    let mut work = rows[0][2];
    for pair in rows.windows(2) {
        work += 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]);
        worst = worst.max((pair[1][2] - work).abs());
    }
    let most = rows.iter().map(|row| row[2].abs()).fold(0.0, f64::max);
    assert!(worst < 1e-4 * most, "{worst:e} of {most:e}");
    let history: Vec<f64> = chunk.history.iter().map(|column| column[0]).collect();
    let left = rows.last().unwrap()[2];
    assert!(left.abs() < 1e-2 * pull_off * reach, "{left:e}");
    assert_eq!(left.to_bits(), subject.law.held(&history).to_bits());

    // Beyond the limit the bodies have parted, and stay so until they touch again.
    let after = pass(&subject, &mut chunk, 1.001 * limit, 1.001 * limit, 1)[0];
    assert_eq!(after[1], 0.0, "still holds");
    assert!(chunk.contact_radius[0] == 0.0 && chunk.pull_off[0] == 0.0);
    assert!(pass(&subject, &mut chunk, 0.999 * limit, -1e-12, 10).iter().all(|row| row[1] == 0.0), "holds again");
    assert!(pass(&subject, &mut chunk, 1e-9, 1e-9, 1)[0][1] < 0.0);
}

/// What a contact of JKR loses over touch and parting is the area between its two ways: the work of pulling from touch to the
/// limit, taken here from the curve alone.
#[test]
fn jkr_loses_the_area_of_its_loop() {
    let (subject, limit) = (sticky(Cohesion::Jkr {}, GAMMA), parting());
    let area = {
        // From the radius at the limit to that at d = 0, F dd by the midpoint rule in the radius.
        let (mut low, mut high) = (limit, 1e-3);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if jkr(middle).1 < 0.0 { low = middle } else { high = middle }
        }
        let steps = 20_000;
        let radius = |k: f64| limit + (low - limit) * k / f64::from(steps);
        (0..steps)
            .map(|k| {
                let k = f64::from(k);
                -jkr(radius(k + 0.5)).0 * (jkr(radius(k + 1.0)).1 - jkr(radius(k)).1)
            })
            .sum::<f64>()
    };
    let mut chunk = subject.chunk(1);
    let reach = -jkr(limit).1;
    let inward = pass(&subject, &mut chunk, -2.0 * reach, 1e-6, 1000).last().unwrap()[3];
    let outward = pass(&subject, &mut chunk, 1e-6, -2.0 * reach, 100_000).last().unwrap()[3];
    assert!(((inward + outward) / area - 1.0).abs() < 1e-3, "{inward:e} + {outward:e} for {area:e}");
    // The control: gamma mistaken for the work of adhesion; the area goes as its power 5/3.
    let wrong = sticky(Cohesion::Jkr {}, 0.5 * GAMMA);
    let lost = pass(&wrong, &mut wrong.chunk(1), -2.0 * reach, 1e-6, 1000).last().unwrap()[3];
    assert!((lost / area - 1.0).abs() > 1e-3);
}

/// The cut of the damping leaves a cohesive pull as it is: damping neither adds to it nor hides it.
#[test]
fn damping_does_not_add_to_a_pull() {
    let damping = Damping::Quarter {};
    let pulled = Contact { cohesion: Cohesion::Dmt {}, damping, ..stack::hertz() };
    let subject = Subject::new(&pulled, Constants { effective_modulus: YOUNG, surface_energy: GAMMA, ..constants() });
    let mut chunk = subject.chunk(3);
    for i in 0..3 {
        (chunk.effective_radius[i], chunk.effective_mass[i], chunk.normal[0][i], chunk.overlap[i]) =
            (RADIUS, 1e-4, 1.0, 1e-9);
        chunk.closing[i] = [-1.0, 0.0, 1.0][i];
    }
    subject.apply(&mut chunk, 1e-6);
    let [parting, still, closing] = [0, 1, 2].map(|i| chunk.normal_force[i]);
    assert!(still < 0.0 && parting == still && closing > still, "{parting:e} {still:e} {closing:e}");
    assert!(chunk.lost_normal[0] == 0.0 && chunk.lost_normal[2] > 0.0);
}

/// Friction under adhesion carries the pull-off force too: at no external force, mu 2 F_c (Thornton 1991); under the simple
/// attractions, mu times the attraction.
#[test]
fn friction_sees_the_pull_off_force() {
    let touching = 2.0 * PI * GAMMA * RADIUS;
    for (cohesion, load) in [
        (Cohesion::Dmt {}, 4.0 * touching),
        (Cohesion::Jkr {}, 3.0 * touching),
        (Cohesion::Constant {}, 0.005),
        // C 2 pi R* d where k d^(3/2) is the same: d = (C 2 pi R* / k)^2.
        (Cohesion::Sjkr {}, (5e4 * 2.0 * PI * RADIUS).powi(3) / (4.0 / 3.0 * YOUNG * RADIUS.sqrt()).powi(2)),
    ] {
        let mut subject = sticky(cohesion, GAMMA);
        let tangential = Tangential::Coulomb { smoothing_speed: 1e-3 };
        subject = Subject::new(&Contact { tangential, ..subject.contact }, subject.constants);
        let mut chunk = subject.chunk(1);
        (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[0][0], chunk.slip[1][0]) =
            (RADIUS, 1e-4, 1.0, 1.0);
        // The overlap without external force, by halving.
        let (mut low, mut high) = (1e-7, 1e-4);
        for _ in 0..100 {
            chunk.overlap[0] = 0.5 * (low + high);
            subject.apply(&mut chunk, 1e-9);
            if chunk.normal_force[0] < 0.0 { low = chunk.overlap[0] } else { high = chunk.overlap[0] }
        }
        assert!((-chunk.tangential_force[1][0] / (0.5 * load) - 1.0).abs() < 1e-6, "{}", chunk.tangential_force[1][0]);
    }
}

/// A contact whose damping pulls carries no friction; or, where the scene asks for it, mu times the size of the pull, against
/// the motion.
#[test]
fn friction_of_a_pull_is_as_asked() {
    for (pulled_friction, share) in [(false, 0.0), (true, 1.0)] {
        let contact = Contact {
            damping: Damping::Quarter {},
            attraction: true,
            tangential: Tangential::Coulomb { smoothing_speed: 1e-3 },
            pulled_friction,
            ..stack::hertz()
        };
        let subject = Subject::new(&contact, sticky(Cohesion::None {}, 0.0).constants);
        let mut chunk = subject.chunk(1);
        (chunk.effective_radius[0], chunk.effective_mass[0], chunk.normal[0][0]) = (RADIUS, 1e-4, 1.0);
        (chunk.overlap[0], chunk.closing[0], chunk.slip[1][0]) = (1e-6, -1.0, 1.0);
        subject.apply(&mut chunk, 1e-9);
        let (normal, tangential) = (chunk.normal_force[0], chunk.tangential_force[1][0]);
        assert!(normal < 0.0, "{normal}");
        assert!(
            (tangential - share * subject.constants.friction * normal).abs() < 1e-12 * -normal,
            "{tangential} {normal}"
        );
    }
}

/// The area and the constant kinds: forces as told, energy their integral.
#[test]
fn simple_attractions_are_as_told() {
    for cohesion in [Cohesion::Sjkr {}, Cohesion::Constant {}, Cohesion::Dmt {}] {
        let [with, without] = [cohesion.clone(), Cohesion::None {}].map(|c| sticky(c, GAMMA));
        let (mut a, mut b) = (with.chunk(1), without.chunk(1));
        let (mut work, mut last) = (0.0, [0.0; 4]);
        let rows = pass(&with, &mut a, 0.0, 1e-5, 10_000).into_iter().zip(pass(&without, &mut b, 0.0, 1e-5, 10_000));
        for (with, without) in rows {
            let force = match cohesion {
                Cohesion::Sjkr {} => 5e4 * 2.0 * PI * RADIUS * with[0],
                Cohesion::Constant {} => 0.005,
                _ => 4.0 * PI * GAMMA * RADIUS,
            };
            assert!((without[1] - with[1] - force).abs() < 1e-12 * (force + without[1]), "{cohesion:?}");
            work += with[1] * (with[0] - last[0]);
            last = with;
        }
        assert!((work / last[2] - 1.0).abs() < 1e-3, "{cohesion:?}: {work:e} {:e}", last[2]);
    }
}
