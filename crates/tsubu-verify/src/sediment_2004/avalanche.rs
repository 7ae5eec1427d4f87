//! Dry rock down a slope of 40 degrees, with long and with short contacts (figures 13 to 16).

use super::super::control::refused;
use super::super::ensemble;
use super::paths::Paths;
use super::{FORWARD, VERLET, Way, law, rig, stiffness_for};
use crate::case::Judged;
use crate::origin::{own, printed};
use tsubu_frame::{Claim, Points, Source};

const SCENE: &str = include_str!("../../../../studies/sediment-2004/avalanche.toml");
/// Diameter and length of the world [m].
const DIAMETER: f64 = 0.2;
const LENGTH: f64 = 20.0;
/// Grains of the bed, which come first.
const BED: usize = 100;
/// Looks at paths, within the last second of 10: a long contact apart, for short ones too. At every fifth the layers are counted.
const LOOKS: usize = 100;
const COUNTED: usize = 5;
/// Layers, a diameter thick each.
const LAYERS: usize = 8;

/// Solid fraction and mean speed [m/s] of every layer, and the paths of all grains.
struct Flow {
    fraction: [f64; LAYERS],
    speed: [f64; LAYERS],
    paths: Paths,
}

/// A slope of 20 degrees, on which the rock stays.
const GENTLE: &str = "gravity=[3.351797, -9.208988]";

/// A slope of 50 degrees, on which it flows with short contacts, too.
const STEEP: &str = "gravity=[7.507235, -6.299318]";

/// The avalanche of one contact time [s] in its tenth second.
fn flow(contact: f64, way: Way, seed: u64, perturbation: f64) -> Result<Flow, String> {
    flow_on(contact, way, &[], seed, perturbation)
}

/// The same with changes of the scene.
fn flow_on(contact: f64, way: Way, changes: &[&str], seed: u64, perturbation: f64) -> Result<Flow, String> {
    let mut all = law(DIAMETER, stiffness_for(DIAMETER, contact), way);
    all.push(format!("seed={seed}"));
    all.extend(changes.iter().map(|change| (*change).to_owned()));
    let mut rig = rig(SCENE, &all, perturbation)?;
    let (mut count, mut sum) = ([0.0; LAYERS], [0.0; LAYERS]);
    let mut places = Vec::with_capacity(LOOKS + 1);
    for look in 0..=LOOKS {
        rig.until(9.0 + look as f64 / LOOKS as f64)?;
        places.push(rig.vectors("position").split_off(BED));
        if look == 0 || look % COUNTED > 0 {
            continue;
        }
        for (p, v) in rig.vectors("position").iter().zip(rig.vectors("velocity")).skip(BED) {
            let layer = (p.z / DIAMETER).max(0.0) as usize;
            if layer < LAYERS {
                count[layer] += 1.0;
                sum[layer] += v.x;
            }
        }
    }
    let area = std::f64::consts::FRAC_PI_4 * DIAMETER / (LENGTH * (LOOKS / COUNTED) as f64);
    let mut speed = [0.0; LAYERS];
    for (speed, (sum, count)) in speed.iter_mut().zip(sum.iter().zip(&count)) {
        *speed = sum / count;
    }
    Ok(Flow { fraction: count.map(|n| n * area), speed, paths: Paths::of(&places, DIAMETER, LENGTH) })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// A profile of the speed, beside another.
fn shown(series: &str, found: &[f64], published: &[f64]) -> Points {
    let over = |speeds: &[f64]| speeds.iter().enumerate().map(|(k, speed)| [*speed, k as f64 + 0.5]).collect();
    Points {
        figure: "Figure 15: speed over the depth of the avalanche".to_owned(),
        axes: ["speed [m/s]", "height over diameter [-]"].map(String::from),
        series: series.to_owned(),
        found: over(found),
        published: over(published),
        ..Points::default()
    }
}

/// The paper's findings, as gates for a long and a short contact.
fn findings(name: &str, long: &Flow, short: &Flow, source: Source<'_>) -> Vec<Claim> {
    let difference: Vec<f64> = long.speed.iter().zip(short.speed).map(|(long, short)| long - short).collect();
    let least = difference.iter().copied().fold(f64::INFINITY, f64::min);
    let ratio = mean(&long.fraction) / mean(&short.fraction);
    // The paper's long contact is 1 m/s faster than the short one, over the whole depth.
    let faster = short.speed.map(|speed| speed + 1.0);
    let (long_shown, short_shown) =
        (shown(&format!("{name}, long"), &long.speed, &faster), shown(&format!("{name}, short"), &short.speed, &[]));
    let name = |what: &str| format!("avalanche, {name}: {what}");
    let zigzag = printed("small-step zig-zag paths and less distance with short contacts (Osada 2004, figure 16)");
    let more = |what: &str, ratio: f64, source| Claim::judge(name(what), ratio, Some(1.1), None, source);
    let (l, s) = (&long.paths, &short.paths);
    vec![
        more("turns up or down in a second, short over long contact", s.turns / l.turns, zigzag),
        more("mean bend within 0.01 s, short over long contact", s.bend / l.bend, zigzag.after()),
        more("path beyond the straight line, short over long contact", s.detour / l.detour, zigzag.after()),
        more("distance in a second, long over short contact", l.distance / s.distance, zigzag),
        Claim::judge(name("concentration, long over short contact"), ratio, Some(0.9), Some(1.1), source),
        Claim::judge(name("least difference of speed in a layer m/s"), least, Some(0.0), None, source),
        flows(name("speed with the short contact m/s"), short, source).showing(short_shown),
        Claim::judge(name("mean difference of speed m/s"), mean(&difference), Some(0.5), Some(2.0), source)
            .showing(long_shown),
    ]
}

/// The same, and that they refuse the contacts changed for each other.
fn findings_and_control(name: &str, long: &Flow, short: &Flow, source: Source<'_>) -> Vec<Claim> {
    let mut claims = findings(name, long, short, source);
    let changed = findings("", short, long, source);
    claims.push(refused(&format!("avalanche, {name}, changed for each other"), &changed, 1));
    claims
}

/// It flows.
fn flows(name: String, flow: &Flow, source: Source<'_>) -> Claim {
    Claim::judge(name, mean(&flow.speed), Some(1.0), None, source)
}

/// 0.01 s against a shorter contact, by the paper's integration and by a good one.
fn pair(shorter: f64, seed: u64, perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (way, source) in [
        (
            Way { integrator: FORWARD, steps: 15 },
            own("equal concentration, about 1 m/s faster with 0.01 s (Osada 2004, figures 13 to 16)").after(),
        ),
        (
            Way { integrator: VERLET, steps: 20 },
            own("the same; not what the law gives: grains with short contacts stand at 40 degrees, see the README of the study").after(),
        ),
    ] {
        let (long, short) = (flow(0.01, way, seed, perturbation)?, flow(shorter, way, seed, perturbation)?);
        let name = format!("{}, 0.01 s and {shorter} s", way.integrator);
        claims.extend(findings_and_control(&name, &long, &short, source));
        if way.integrator == FORWARD {
            let still = flow_on(0.003, way, &[GENTLE], seed, perturbation)?;
            let gate = flows("avalanche: speed with the short contact m/s".to_owned(), &still, source);
            claims.push(refused("rock on a slope of 20 degrees, contact of 0.003 s", &[gate], 1));
        }
    }
    Ok(claims)
}

/// B-F13 to B-F16 with a contact of 0.001 s for the shorter one, and what longer ones do.
pub(in super::super) fn avalanche(perturbation: f64) -> Judged {
    ensemble::drawn("avalanches", 1..=10, |seed| {
        let mut claims = pair(1e-3, seed, perturbation)?;
        let way = Way { integrator: VERLET, steps: 20 };
        let [long, short] = [0.01, 1e-3].map(|contact| flow_on(contact, way, &[STEEP], seed, perturbation));
        let name = format!("{} on 50 degrees, 0.01 s and 0.001 s", way.integrator);
        let source =
            own("equal concentration, about 1 m/s faster with 0.01 s (Osada 2004), where the law lets both flow");
        claims.extend(findings_and_control(&name, &long?, &short?, source.after()));
        let source = own("trend: the longer the contact, the faster (Osada 2004, figure 14)").after();
        let trend = |changes: &[&str]| -> Result<[Claim; 2], String> {
            let speed =
                |contact: f64| Ok::<_, String>(mean(&flow_on(contact, way, changes, seed, perturbation)?.speed));
            let speeds = [speed(0.03)?, speed(0.01)?, speed(0.003)?];
            Ok([(0, "0.03 s less 0.01 s"), (1, "0.01 s less 0.003 s")].map(|(i, contacts)| {
                let name = format!("avalanche, velocity-verlet: speed with a contact of {contacts} m/s");
                Claim::judge(name, speeds[i] - speeds[i + 1], Some(0.5), None, source)
            }))
        };
        claims.extend(trend(&[])?);
        claims.push(refused("rock on a slope of 20 degrees", &trend(&[GENTLE])?, 2));
        Ok(claims)
    })
}

/// The same with the paper's 0.0001 s: three million steps.
pub(in super::super) fn avalanche_stiff(perturbation: f64) -> Judged {
    ensemble::drawn("avalanches", 1..=5, |seed| pair(1e-4, seed, perturbation))
}
