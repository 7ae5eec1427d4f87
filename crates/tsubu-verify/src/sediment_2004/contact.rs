//! A grain that meets a fixed one: contact time, with damping, and overlap (figures 4, 5, 8, 11, 12).

use super::super::bench::{Rig, near, within};
use super::super::control::{refused, refused_number};
use super::{DAMPING_RATIO, DENSITY, contact_seconds, dashpot, mass, stiffness_for};
use crate::case::Judged;
use crate::origin::{closed_form, printed};
use std::f64::consts::PI;
use tsubu_frame::{Claim, Points};

/// Newtons a metre in a newton a centimetre.
const N_PER_CM: f64 = 100.0;
/// Stiffnesses of table B-7.1 [N/cm], and the diameters of the laboratory [cm].
const STIFFNESSES: [f64; 6] = [0.01, 0.1, 1.0, 10.0, 100.0, 1000.0];
const DIAMETERS: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];
/// The rock of figure 12: diameter [cm], stiffnesses [N/cm].
const ROCK: (f64, [f64; 4]) = (20.0, [1e2, 1e4, 1e6, 1e8]);
/// Impact speed that the statement "overlap 0.01 d at 100 N/cm for 0.2 cm" implies [m/s].
const SPEED: f64 = 0.600;
/// Steps of a contact: positions between two steps are known, so this is for the phase of the oscillation alone.
const STEPS: f64 = 1000.0;

/// A grain that flies onto a fixed one of its own size, without gravity.
struct Impact {
    diameter: f64,
    stiffness: f64,
    speed: f64,
    /// Dashpot [N.s/m], and whether it may pull.
    dashpot: f64,
    tension: bool,
}

/// What was seen of it.
struct Seen {
    /// From first to last overlap [s].
    overlapping: f64,
    /// From first overlap until the force is zero [s].
    pushing: f64,
    /// Deepest overlap over diameter.
    overlap: f64,
    /// Speed after over speed before.
    restitution: f64,
}

impl Impact {
    fn undamped(diameter: f64, stiffness: f64, speed: f64) -> Self {
        Self { diameter, stiffness, speed, dashpot: 0.0, tension: false }
    }

    fn seen(&self, perturbation: f64) -> Result<Seen, String> {
        let Self { diameter: d, stiffness, speed, dashpot, tension } = self;
        let dt = contact_seconds(*d, *stiffness) / STEPS;
        let gap = 1.5 * speed * dt;
        let text = format!(
            r#"
            title = "a grain meets a fixed one"
            gravity = 0
            duration = {duration:e}
            speed-scale = {speed:e}
            [materials.quartz]
            young-modulus = 1e9
            density = {DENSITY}
            [particles.a-fixed]
            material = "quartz"
            diameter = {d:e}
            motion.frozen = {{}}
            start.at.position = [[0, 0]]
            [particles.b-free]
            material = "quartz"
            diameter = {d:e}
            start.at = {{ position = [[0, {height:e}]], velocity = [[0, -{speed:e}]] }}
            [contact]
            normal.hooke.stiffness = {stiffness:e}
            damping.dashpot.coefficient = {dashpot:e}
            attraction = {tension}
            tangential.none = {{}}
            rotation = false
            [dem]
            time-step = {dt:e}
            largest-overlap = 1
            "#,
            duration = 10.0 * STEPS * dt,
            height = d + gap,
        );
        let mut rig = Rig::new(&text, perturbation)?;
        let height = |rig: &Rig| rig.vector("position", 1).z - d;
        let (mut lowest, mut forces) = (0.0f64, Vec::new());
        let last = (10.0 * STEPS) as u64;
        while height(&rig) > 0.0 || rig.engine.steps() < 2 {
            rig.steps(1)?;
        }
        while height(&rig) <= 0.0 && rig.engine.steps() < last {
            lowest = lowest.min(height(&rig));
            forces.push((rig.engine.time(), rig.vector("contact force", 1).z));
            rig.steps(1)?;
        }
        let after = rig.vector("velocity", 1).z;
        // Before and after it flies straight.
        let begin = gap / speed;
        let end = rig.engine.time() - height(&rig) / after;
        Ok(Seen {
            overlapping: end - begin,
            pushing: zero(&forces).map_or(end, |t| t.min(end)) - begin,
            overlap: -lowest / d,
            restitution: after / speed,
        })
    }
}

/// Where the line through the last two forces that push meets zero.
fn zero(forces: &[(f64, f64)]) -> Option<f64> {
    let pushing: Vec<&(f64, f64)> = forces.iter().take_while(|(_, f)| *f > 0.0).collect();
    let [.., a, b] = pushing[..] else { return None };
    Some(b.0 + b.1 * (b.0 - a.0) / (a.1 - b.1))
}

/// Largest relative deviation of what was found from what is published, at the same places.
fn deviation(points: &Points) -> f64 {
    let pairs = points.found.iter().zip(&points.published);
    pairs.map(|(found, wanted)| (found[1] / wanted[1] - 1.0).abs()).fold(0.0, f64::max)
}

/// Contact times over stiffnesses [N/cm], beside the closed form for a `share` of the mass.
fn times(diameter: f64, stiffnesses: &[f64], share: f64, perturbation: f64) -> Result<Points, String> {
    let mut points = Points {
        figure: "Figures 4 and 12: contact time".to_owned(),
        axes: ["stiffness [N/cm]", "contact time [s]"].map(String::from),
        log: true,
        series: format!("{} cm", 100.0 * diameter),
        ..Points::default()
    };
    for k in stiffnesses {
        let stiffness = k * N_PER_CM;
        // An overlap of 1 % of the diameter.
        let speed = 0.01 * diameter * PI / contact_seconds(diameter, stiffness);
        points.found.push([*k, Impact::undamped(diameter, stiffness, speed).seen(perturbation)?.overlapping]);
        points.published.push([*k, share.sqrt() * contact_seconds(diameter, stiffness)]);
    }
    Ok(points)
}

/// B-F4, B-F12: contact times are half a natural period.
pub(in super::super) fn contact_time(perturbation: f64) -> Judged {
    let source = closed_form("t = pi sqrt(m/k) (Osada 2004, equation 8; figures 4, 12)");
    let claim = |d: f64, k: &[f64], share: f64| {
        let name = format!(
            "contact time, {d} cm, {} to {:e} N/cm: largest relative deviation from half a period",
            k[0],
            k[k.len() - 1]
        );
        let points = times(0.01 * d, k, share, perturbation)?;
        Ok::<_, String>(Claim::judge(name, deviation(&points), None, Some(1e-3), source).showing(points))
    };
    let mut claims = Vec::new();
    for d in DIAMETERS {
        claims.push(claim(d, &STIFFNESSES, 1.0)?);
    }
    claims.push(claim(ROCK.0, &ROCK.1, 1.0)?);
    let quoted = [(0.2, 0.01, 0.01), (0.2, 100.0, 1e-4)];
    for (d, k, seconds) in quoted {
        let speed = 0.01 * 0.01 * d * PI / contact_seconds(0.01 * d, k * N_PER_CM);
        let found = Impact::undamped(0.01 * d, k * N_PER_CM, speed).seen(perturbation)?.overlapping;
        let name = format!("contact time of {d} cm at {k} N/cm s");
        // Printed with one digit.
        claims.push(Claim::judge(
            name,
            found,
            Some(0.95 * seconds),
            Some(1.05 * seconds),
            printed("Osada 2004, printed"),
        ));
    }
    claims.push(refused_number(
        "contact time of a pair that is free on both sides",
        &[claim(0.2, &STIFFNESSES, 0.5)?],
        1,
    ));
    Ok(claims)
}

/// B-F5: damping hardly changes the contact time.
pub(in super::super) fn damped(perturbation: f64) -> Judged {
    let (d, k) = (2e-3, 100.0 * N_PER_CM);
    let free = contact_seconds(d, k);
    let z = DAMPING_RATIO;
    let root = (1.0 - z * z).sqrt();
    // Where k x + c x' = 0 for the first time.
    let cut = PI - 2.0 * z.asin();
    let impact = |dashpot: f64, tension: bool| {
        Impact { diameter: d, stiffness: k, speed: 0.1, dashpot, tension }.seen(perturbation)
    };
    let (pulls, pushes) = (impact(dashpot(d, k), true)?, impact(dashpot(d, k), false)?);
    let source = closed_form("damped oscillation, e = 0.7, z = 0.1128 (Osada 2004, figure 5)");
    let name = |what: &str| format!("damped contact, 0.2 cm: {what}");
    let gates = |pulls: &Seen, pushes: &Seen| {
        vec![
            near(name("time over undamped, tension allowed"), pulls.overlapping / free, 1.0 / root, 1e-3, source),
            near(
                name("time until the force is zero over undamped, no tension"),
                pushes.pushing / free,
                cut / PI / root,
                1e-3,
                source,
            ),
            near(name("restitution, tension allowed"), pulls.restitution, 0.7, 1e-3, source),
            near(name("restitution, no tension"), pushes.restitution, (-z / root * cut).exp(), 1e-3, source),
        ]
    };
    let mut claims = gates(&pulls, &pushes);
    claims.push(refused("tension and none changed for each other", &gates(&pushes, &pulls), 2));
    Ok(claims)
}

/// B-F8, B-F11: overlap against stiffness, and the band of stiffness that the paper draws from it.
pub(in super::super) fn overlap(perturbation: f64) -> Judged {
    let law = closed_form("v sqrt(m/k) / d at 0.600 m/s (Osada 2004, figures 8, 11)");
    let impact = |d: f64, k: f64| Impact::undamped(d, k, SPEED).seen(perturbation);
    let of = |d: f64, k: f64| Ok::<_, String>(impact(d, k)?.overlap);
    let mut claims = Vec::new();
    for d in DIAMETERS.map(|d| 0.01 * d) {
        let mut points = Points {
            figure: "Figures 8 and 11: largest overlap at 0.6 m/s".to_owned(),
            axes: ["stiffness [N/cm]", "overlap over diameter [-]"].map(String::from),
            log: true,
            series: format!("{} cm", 100.0 * d),
            ..Points::default()
        };
        for k in (0..12).map(|i| 10f64.powf(0.5 * f64::from(i))) {
            let stiffness = k * N_PER_CM;
            points.found.push([k, of(d, stiffness)?]);
            points.published.push([k, SPEED * (mass(d) / stiffness).sqrt() / d]);
        }
        let name = format!("overlap over diameter, {} cm, 1 to 3e5 N/cm: largest relative deviation", 100.0 * d);
        claims.push(Claim::judge(name, deviation(&points), None, Some(1e-3), law).showing(points));
    }
    let edges =
        closed_form("overlap / d = v sqrt(m/k) / d, v = 0.600 m/s of the band of Osada 2004, figures 11 and 12");
    let (mut ratios, mut softer) = (Vec::new(), Vec::new());
    for (d, k) in DIAMETERS.map(|d| 0.01 * d).into_iter().zip([25.0, 50.0, 100.0, 250.0, 500.0]) {
        let (soft, hard) = (impact(d, k * N_PER_CM)?, impact(d, 100.0 * k * N_PER_CM)?);
        let name = |k: f64| format!("band edge, {} cm at {k} N/cm: overlap over diameter", 100.0 * d);
        claims.push(near(name(k), soft.overlap, 0.01, 2e-3, edges));
        claims.push(near(name(100.0 * k), hard.overlap, 0.001, 2e-3, edges));
        ratios.push(soft.overlapping / hard.overlapping);
        softer.push(soft.overlapping / impact(d, 95.0 * k * N_PER_CM)?.overlapping);
    }
    // The paper: 0.001 < overlap / d < 0.01, and contact times of 0.01 s and 0.0001 s, both inside for 20 cm.
    let d = 0.2;
    let [long, middle, short] = [1e-2, 1e-3, 1e-4].map(|contact| of(d, stiffness_for(d, contact)));
    let (long, middle, short) = (long?, middle?, short?);
    let one = closed_form("overlap / d = v t / (pi d): a band of ten in overlap is a band of ten in contact time");
    let edges = |ratios: &[f64]| {
        let name = "band: contact time at one edge over that at the other";
        // The one that is farthest off.
        let off = |ratio: &&f64| (*ratio - 10.0).abs();
        let worst = ratios.iter().max_by(|a, b| off(a).total_cmp(&off(b))).copied().unwrap_or(f64::NAN);
        within(name, worst, 10.0, 1e-3, one)
    };
    let both = |ratio: f64| {
        let name = "band: overlap at 0.01 s over overlap at 0.0001 s, 20 cm; the band holds 10";
        within(name, ratio, 100.0, 0.2, one)
    };
    claims.push(edges(&ratios));
    claims.push(refused("a hard edge 5 % too soft", &[edges(&softer)], 1));
    claims.push(both(long / short));
    claims.push(refused("a short contact of 0.001 s, which the band holds beside 0.01 s", &[both(long / middle)], 1));
    Ok(claims)
}
