//! 42 grains fall into a box of fixed ones: who vibrates, and whether it is the integrator (figures 9, 10).

use super::super::control::refused;
use super::super::ensemble;
use super::{FORWARD, VERLET, Way, law, mass, rig};
use crate::case::Judged;
use crate::origin::{digitised, own, printed};
use tsubu_frame::{Claim, Ensemble, Points, Source};

const SCENE: &str = include_str!("../../../../studies/sediment-2004/settling.toml");
/// Diameter [m].
const DIAMETER: f64 = 2e-3;
/// Free grains.
const COUNT: usize = 42;
/// Time between two looks [s], and looks that count: 0.1 s.
const PAUSE: f64 = 0.01;
const LOOKS: usize = 10;
/// The last look, where the paper's figures end, and where all have been at rest for these looks since the time that it gives for 100 N/cm [s].
const END: f64 = 0.5;
const AT_REST: f64 = 0.125 + PAUSE * LOOKS as f64;
/// Root mean square of the change of height within a pause, over diameter, from which on a grain vibrates.
const VIBRATES: f64 = 1e-3;
/// Stiffnesses [N/m]: 1 and 100 N/cm.
const SOFT: f64 = 100.0;
const HARD: f64 = 1e4;

/// What the bed does in 0.1 s.
#[derive(Clone, Copy, Debug)]
struct Rest {
    /// Kinetic energy over that of a fall by one diameter.
    kinetic: f64,
    /// Share of the grains that vibrate.
    vibrating: f64,
}

/// Lets the grains fall, and looks until a time.
fn rest(stiffness: f64, way: Way, end: f64, seed: u64, perturbation: f64) -> Result<Rest, String> {
    let mut changes = law(DIAMETER, stiffness, way);
    changes.push(format!("seed={seed}"));
    let mut rig = rig(SCENE, &changes, perturbation)?;
    let first = rig.engine.grains() - COUNT;
    let mut heights: Vec<Vec<f64>> = Vec::new();
    let mut kinetic = 0.0;
    for look in 0..=LOOKS {
        rig.until(end - PAUSE * (LOOKS - look) as f64)?;
        let places = rig.vectors("position").split_off(first);
        kinetic += rig.engine.grain_energies().kinetic / (LOOKS + 1) as f64;
        heights.push(places.iter().map(|p| p.z / DIAMETER).collect());
    }
    let change = |i: usize| {
        let squares = heights.windows(2).map(|w| (w[1][i] - w[0][i]).powi(2));
        (squares.sum::<f64>() / LOOKS as f64).sqrt()
    };
    let vibrating = (0..COUNT).filter(|&i| change(i) > VIBRATES).count();
    Ok(Rest {
        kinetic: kinetic / (COUNT as f64 * mass(DIAMETER) * 9.8 * DIAMETER),
        vibrating: vibrating as f64 / COUNT as f64,
    })
}

/// The gates of a bed at rest.
fn at_rest(name: &str, kinetic: f64, vibrating: f64, source: Source<'_>) -> [Claim; 2] {
    [
        Claim::judge(format!("{name}: share that vibrates"), vibrating, None, Some(0.0), source),
        Claim::judge(format!("{name}: kinetic energy over m g d"), kinetic, None, Some(1e-6), source),
    ]
}

/// The gates of the worst of several ways to integrate. Hard grains are looked at when the paper has them at rest, soft ones, half of which
/// vibrate there by its integrator, at the end.
fn worst(stiffness: f64, ways: &[Way], name: &str, perturbation: f64) -> Result<[Claim; 2], String> {
    let (end, source) = if stiffness < HARD {
        (END, own("a damped bed comes to rest, whatever its stiffness"))
    } else {
        (AT_REST, printed("at 100 N/cm all are at rest at 0.125 s (Osada 2004, figure 10)"))
    };
    let (mut kinetic, mut vibrating) = (0.0f64, 0.0f64);
    let integrator = ways.first().map_or("", |way| way.integrator);
    let mut points = Points {
        figure: "Figures 9 and 10: motion left".to_owned(),
        axes: ["steps per contact [-]", "kinetic energy over m g d [-]"].map(String::from),
        log: true,
        series: format!("{} N/cm, {integrator}", stiffness / 100.0),
        ..Points::default()
    };
    for way in ways {
        let found = rest(stiffness, *way, end, 1, perturbation)?;
        (kinetic, vibrating) = (kinetic.max(found.kinetic), vibrating.max(found.vibrating));
        points.found.push([f64::from(way.steps), found.kinetic]);
    }
    let [shares, energy] =
        at_rest(&format!("42 grains, {} N/cm, {name}", stiffness / 100.0), kinetic, vibrating, source);
    Ok([shares, energy.showing(points)])
}

/// B-F9, B-F10: at rest when integrated well; by forward differences near the paper's least number of steps, not.
pub(in super::super) fn settling(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let some = |integrator, steps: &[u32]| steps.iter().map(|&steps| Way { integrator, steps }).collect::<Vec<_>>();
    for stiffness in [SOFT, HARD] {
        let all = [10, 12, 14, 20];
        claims.extend(worst(stiffness, &some(VERLET, &all), "velocity Verlet, 10 to 20 steps", perturbation)?);
        claims.extend(worst(
            stiffness,
            &some("symplectic-euler", &all),
            "symplectic Euler, 10 to 20 steps",
            perturbation,
        )?);
        claims.extend(worst(
            stiffness,
            &some(FORWARD, &[14, 20]),
            "forward differences, 14 and 20 steps",
            perturbation,
        )?);
    }
    let gains =
        own("forward differences gain energy below 13.9 steps per contact, dt > eta / k, at any stiffness").after();
    for stiffness in [SOFT, HARD] {
        let gates = worst(stiffness, &some(FORWARD, &[10]), "forward differences, 10 steps", perturbation)?;
        let shakes = Claim::judge(gates[0].name.clone(), gates[0].value, Some(0.5), None, gains);
        claims.push(Claim { points: gates[1].points.clone(), ..shakes });
        claims.push(refused(&format!("{} N/cm, forward differences, 10 steps", stiffness / 100.0), &gates, 2));
    }
    let near = Way { integrator: FORWARD, steps: 12 };
    let shares = |stiffness: f64| -> Result<Ensemble, String> {
        let of = format!("{} N/cm, 12 steps", stiffness / 100.0);
        let run = |seed| Ok([rest(stiffness, near, END, seed, perturbation)?.vibrating]);
        let [found] = ensemble::members(&of, 1..=5, run)?;
        Ok(found)
    };
    let way = "forward differences, 12 steps: share that vibrates";
    let gates = |soft: &Ensemble, hard: &Ensemble| {
        let half = digitised("about half vibrate at 1 N/cm (Osada 2004, figure 9)").after();
        let none = digitised("none vibrates at 100 N/cm, or not one in the mean (Osada 2004, figure 10)").after();
        [
            Claim::judge_ensemble(format!("42 grains, 1 N/cm, {way}"), soft.clone(), Some(0.35), Some(0.65), half),
            Claim::judge_ensemble(
                format!("42 grains, 100 N/cm, {way}"),
                hard.clone(),
                None,
                Some(1.0 / COUNT as f64),
                none,
            ),
        ]
    };
    let (soft, hard) = (shares(SOFT)?, shares(HARD)?);
    claims.extend(gates(&soft, &hard));
    claims.push(refused("soft grains and hard ones changed for each other", &gates(&hard, &soft), 2));
    Ok(claims)
}
