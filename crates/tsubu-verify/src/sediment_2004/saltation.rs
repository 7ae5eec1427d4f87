//! Osada 2004: one grain leaps along a fixed bed (B-F6, B-F7, B-F20, B-F21), and what the torque of the water does to its spin.

use super::super::bench::{Rig, near};
use super::super::control::refused;
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own, printed, remembered};
use glam::DVec3;
use std::f64::consts::PI;
use std::ops::RangeInclusive;
use std::path::Path;
use tsubu::view::Wants;
use tsubu_frame::Claim;
use tsubu_scene::Scene;

/// Diameter [m] and mass [kg] of the grain.
pub(super) const D: f64 = 2e-3;
const MASS: f64 = 2650.0 * PI / 6.0 * D * D * D;
/// Left out at the begin [s], and hops that are recorded, as in the paper.
const DISCARD: f64 = 1.0;
const HOPS: usize = 30;
/// Hops of one draw, and the draws: 30 hops are too few to tell two stiffnesses apart.
const MANY: usize = 50;
pub(super) const DRAWS: RangeInclusive<u64> = 1..=10;
/// Steps in a contact.
const STEPS: f64 = 20.0;

/// What the hops of a run come to.
#[derive(Clone, Debug, Default)]
struct Leaps {
    /// Means of contact time [s], hop height and hop length [m], of the velocity along the bed [m/s].
    contact: f64,
    height: f64,
    length: f64,
    speed: f64,
    /// Highest hop [m].
    highest: f64,
    /// Mean of |w| d/2 [m/s], and the largest |w| [rad/s].
    rim: f64,
    fastest: f64,
    /// Impulse of friction over that of the normal force at impacts, from the change of velocity.
    resistance: f64,
}

/// Contact time of the undamped grain on a fixed one (B8) [s].
fn contact_seconds(mass: f64, stiffness: f64) -> f64 {
    PI * (mass / stiffness).sqrt()
}

/// The grain before its first leap; contacts of stiffness [N/m].
pub(super) fn leaping(stiffness: f64, changes: &[&str], perturbation: f64) -> Result<Rig, String> {
    let text = include_str!("../../../../studies/sediment-2004/saltation.toml");
    let dt = contact_seconds(MASS, stiffness) / STEPS;
    let mut all = vec![format!("contact.normal.hooke.stiffness={stiffness}"), format!("dem.time-step={dt:e}")];
    all.extend(changes.iter().map(|c| (*c).to_owned()));
    let scene = Scene::parse("saltation", text, Path::new("."), &all).map_err(|c| c.to_string())?;
    Rig::of(scene.plan().clone(), perturbation)
}

/// Place [m], velocity [m/s] and spin [rad/s] of the grain; spin counts as it rolls downstream.
pub(super) fn grain(rig: &Rig) -> (DVec3, DVec3, f64) {
    let view = rig.engine.view(Wants { spins: true, ..Wants::GRAINS });
    let i = (0..view.len()).find(|&i| view.free(i)).unwrap_or(0);
    (view.unwrapped(i), view.grains.velocity[i], view.grains.spin[i].y)
}

/// Lets the grain leap `hops` times after the begin; contacts of stiffness [N/m].
fn leaps(stiffness: f64, changes: &[&str], hops: usize, perturbation: f64) -> Result<Leaps, String> {
    let mut rig = leaping(stiffness, changes, perturbation)?;
    let dt = rig.engine.time_step();
    rig.until(DISCARD)?;
    let mut found = Leaps::default();
    // From the first end of a contact on: flights and contacts in turn.
    while rig.engine.contacts() > 0 {
        rig.steps(1)?;
    }
    while rig.engine.contacts() == 0 {
        rig.steps(1)?;
    }
    let (mut time, mut rims, mut steps) = (0.0, 0.0, 0u64);
    let (mut pushed, mut rubbed) = (0.0, 0.0);
    for _ in 0..hops {
        let (mut touching, before) = (0u64, grain(&rig).1);
        while rig.engine.contacts() > 0 {
            rig.steps(1)?;
            touching += 1;
        }
        let (take_off, velocity, _) = grain(&rig);
        let change: DVec3 = velocity - before;
        pushed += change.z;
        rubbed -= change.x;
        found.contact += touching as f64 * dt;
        let mut top = take_off.z;
        let mut flown = 0u64;
        let mut place = take_off;
        while rig.engine.contacts() == 0 {
            rig.steps(1)?;
            let (now, _, spin) = grain(&rig);
            place = now;
            top = top.max(now.z);
            rims += spin.abs() * 0.5 * D;
            found.fastest = found.fastest.max(spin.abs());
            flown += 1;
        }
        time += flown as f64 * dt;
        steps += flown;
        found.height += top - take_off.z;
        found.highest = found.highest.max(top - take_off.z);
        found.length += place.x - take_off.x;
        found.speed += place.x - take_off.x;
    }
    let n = hops as f64;
    found.speed /= time;
    found.rim = rims / steps as f64;
    found.resistance = rubbed / pushed;
    for mean in [&mut found.contact, &mut found.height, &mut found.length] {
        *mean /= n;
    }
    Ok(found)
}

/// Locked, with the contacts of the paper's figure 20.
const LOCKED: &[&str] = &["contact.rotation=false"];
/// Nine times as deep, which makes three times the shear velocity.
const DEEP: &[&str] = &["water.flow.log-law.depth=0.18"];
/// Impacts give hardly anything back.
const DEAD: &[&str] = &["materials.quartz.restitution=0.05"];
pub(super) const FREE: &[&str] = &["contact.rotation=true"];
pub(super) const IN_WATER: &[&str] = &["contact.rotation=true", "water.torque={finite-reynolds={}}"];

/// Where the grain begins in a draw: a few collisions on, paths that begin a hundredth of a diameter apart have nothing in common.
fn begins(draw: u64) -> String {
    format!("particles.grain.start.at.position=[['{} mm', '4 mm']]", 1.0 + 0.02 * (draw - 1) as f64)
}

/// Contact time of a stiffness [N/m], over that of the paper's equation.
fn contact_claim(stiffness: f64, found: &Leaps) -> Claim {
    let name = format!("leaping grain, k = {} N/cm: contact time over pi sqrt(m/k)", stiffness / 100.0);
    near(
        name,
        found.contact / contact_seconds(MASS, stiffness),
        1.0,
        0.1,
        closed_form("Osada et al. 2004, figure 6 and (B8): general agreement"),
    )
}

/// B-F6, B-F7: contact times follow the stiffness, hops do not while grains overlap little; published hops.
pub(in super::super) fn saltation(perturbation: f64) -> Judged {
    ensemble::drawn("leaping grains", DRAWS, |draw| {
        let begins = begins(draw);
        let run = |stiffness: f64, hops: usize, changes: &[&str]| {
            leaps(stiffness, &[LOCKED, changes, &[&begins]].concat(), hops, perturbation)
        };
        let mut claims = Vec::new();
        let [soft, paper, stiff] = [run(1e2, MANY, &[])?, run(1e4, MANY, &[])?, run(1e5, MANY, &[])?];
        claims.push(contact_claim(1e3, &run(1e3, HOPS, &[])?));
        claims.push(contact_claim(1e5, &stiff));
        claims.push(contact_claim(1e4, &paper));
        let source = printed("Osada et al. 2004: what counts is the impulse").after();
        let same = |what: &str, a: f64, b: f64| {
            near(format!("leaping grain, {what}, k = 1000 over 100 N/cm"), b / a, 1.0, 0.2, source)
        };
        claims.push(same("mean hop height", paper.height, stiff.height));
        claims.push(same("mean hop length", paper.length, stiff.length));
        let gates =
            [same("mean hop height", soft.height, stiff.height), same("mean hop length", soft.length, stiff.length)];
        claims.push(refused("contacts of 1 N/cm, in which the grain sinks between those of the bed", &gates, 2));
        claims.extend(measured(&paper));
        let torrent = run(1e4, HOPS, DEEP)?;
        claims.push(refused("a stream of three times the shear velocity", &measured(&torrent), 2));
        let dead = run(1e4, HOPS, DEAD)?;
        claims.push(refused("a grain that hardly rebounds", &measured(&dead), 1));
        Ok(claims)
    })
}

/// Hops as high, long and fast as measured ones.
fn measured(found: &Leaps) -> [Claim; 3] {
    let wanted = [
        ("mean hop height over d", found.height / D, 3.4),
        ("mean hop length over d", found.length / D, 36.8),
        ("mean speed [m/s]", found.speed, 0.741),
    ];
    wanted.map(|(what, value, wanted)| {
        let name = format!("leaping grain, Shields number 0.3: {what}");
        let source = remembered("Sklar and Dietrich 2004, of measured hops, a factor of 2");
        Claim::judge(name, value, Some(0.5 * wanted), Some(2.0 * wanted), source)
    })
}

/// B-F6 at its softest: in a contact of 1 ms the grain goes on by more than a third of a diameter, so that the bed's grain lets it go early.
pub(in super::super) fn softest(perturbation: f64) -> Judged {
    ensemble::drawn("leaping grains", DRAWS, |draw| {
        let begins = begins(draw);
        let run = |stiffness: f64| leaps(stiffness, &[LOCKED, &[&begins]].concat(), MANY, perturbation);
        let found = run(100.0)?;
        let source = own("why the contact ends early").after();
        let goes_on = |found: &Leaps| {
            let name = "leaping grain, k = 1 N/cm: way along the bed in a contact, over d";
            Claim::judge(name, found.contact * found.speed / D, Some(0.3), None, source)
        };
        let harder = refused("contacts of 100 N/cm", &[goes_on(&run(1e4)?)], 1);
        Ok(vec![contact_claim(100.0, &found), goes_on(&found), harder])
    })
}

/// What the spin does to the hops of one draw.
pub(super) fn spinning_of(draw: u64, perturbation: f64) -> Judged {
    let begins = begins(draw);
    let run = |hops: usize, changes: &[&[&str]]| {
        leaps(1e4, &[&changes.concat()[..], &[&begins]].concat(), hops, perturbation)
    };
    let [locked, free, wet] = [run(MANY, &[LOCKED])?, run(MANY, &[FREE])?, run(MANY, &[IN_WATER])?];
    let source = own("Osada et al. 2004, figures 20 and 21").after();
    let more = |what: &str, a: f64, b: f64| {
        Claim::judge(format!("leaping grain, {what}, free over locked"), b / a, Some(1.05), None, source)
    };
    let spins = |leaps: &Leaps| {
        near(
            "leaping grain, mean |w| d/2 over mean speed",
            leaps.rim / leaps.speed,
            1.0,
            0.2,
            own("rolling without slip; figure 21").after(),
        )
    };
    let frees = |locked: &Leaps, free: &Leaps| {
        [
            more("mean hop height", locked.height, free.height),
            more("mean hop length", locked.length, free.length),
            near(
                "leaping grain, friction over normal impulse at impacts, free over locked",
                free.resistance / locked.resistance,
                0.5,
                0.3,
                source,
            ),
        ]
    };
    let bounded = |found: &Leaps| {
        let name = "leaping grain, largest |w| d/2 [m/s]";
        let source = closed_form("not above the fastest water, at the surface");
        Claim::judge(name, found.fastest * 0.5 * D, None, Some(1.41), source)
    };
    let torque = |wet: &Leaps| {
        let name = "leaping grain, mean |w| d/2 with the torque of the water over without";
        let source = own("a spin lasts 0.04 s in water, less than a hop (Dennis et al. 1980)").after();
        Claim::judge(name, wet.rim / free.rim, None, Some(0.5), source)
    };
    let mut claims = frees(&locked, &free).to_vec();
    claims.extend([spins(&free), bounded(&free), torque(&wet)]);
    let still_locked = run(HOPS, &[LOCKED])?;
    claims.push(refused("locked grains for free ones", &frees(&locked, &still_locked), 3));
    let torrent = run(HOPS, &[FREE, DEEP])?;
    claims.push(refused("a stream of three times the shear velocity", &[bounded(&torrent)], 1));
    claims.push(refused("water without a torque", &[torque(&run(HOPS, &[FREE])?)], 1));
    claims.push(refused("grains in water that does not resist their spin, as spins of real ones", &[spins(&wet)], 1));
    Ok(claims)
}
