//! C-x4: a plate pushed into a bed, and which grains carry it, beside DEM.

use super::super::bench::{self, Rig, at_least, between};
use super::super::control::{refused, refused_number};
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::own;
use std::path::Path;
use tsubu::view::{Contact, Contacts, Wants};
use tsubu_frame::Claim;
use tsubu_scene::Scene;

/// When the plate has gone 1 mm into the bed of hexagons [s].
pub(super) const PUSHED: f64 = 1.46;

/// C-x4: shared points of a bed into which a plate has been pushed by 1 mm: some grains carry, more of them below the plate than if all carried alike.
pub(in super::super) fn plate(perturbation: f64) -> Judged {
    ensemble::drawn("plate", 1..=10, |seed| {
        let pushed = |plate: bool| -> Result<_, String> {
            let mut plan = bench::plan(include_str!("../../../../studies/cl-ca-2001/plate.toml"))?;
            plan.seed = seed;
            if !plate {
                plan.particles.retain(|name, _| name != "plate");
                plan.cl_ca.rule = tsubu_scene::plan::ClCaRule::Passive;
            }
            let mut rig = Rig::of(plan, 1.0)?;
            // The plate comes down at 50 mm/s from 116 mm and meets the bed at 1.44 s: it has gone 1 mm into it.
            rig.until(PUSHED)?;
            let Network { loads, carry, under } = network(&rig, Contacts::Places);
            let source = own("chain-like, not uniform").after();
            Ok([
                at_least("pairs that share points", loads.len() as f64, 20.0, source),
                at_least("spread of shared points over their mean", scatter(&loads), 0.3, source),
                between("share of grains that carry", carry, 0.02, 0.5, source),
                at_least(
                    "of those, share below the plate",
                    under,
                    0.375,
                    own("more than grains that all carry alike: the plate covers 30 of 80 mm").after(),
                ),
            ])
        };
        let mut claims = pushed(perturbation == 1.0)?.to_vec();
        claims.push(refused("no plate", &pushed(false)?, 4));
        Ok(claims)
    })
}

/// What a bed hands on from grain to grain.
struct Network {
    /// Loads of pairs: forces [N], or shared points times the spacing [m].
    loads: Vec<f64>,
    /// Share of the grains with a load; of forces, one above their mean.
    carry: f64,
    /// Share of those that are below the plate.
    under: f64,
}

fn network(rig: &Rig, contacts: Contacts) -> Network {
    let view = rig.engine.view(Wants { contacts, ..Wants::GRAINS });
    let load = |contact: &Contact| match contacts {
        Contacts::Forces => -contact.force.dot(contact.normal),
        _ => contact.overlap,
    };
    let pairs: Vec<(usize, usize, f64)> = view
        .contacts
        .iter()
        .filter(|contact| !contact.wall && load(contact) > 0.0)
        .map(|contact| (contact.first, contact.second, load(contact)))
        .collect();
    let loads: Vec<f64> = pairs.iter().map(|pair| pair.2).collect();
    let least = if contacts == Contacts::Forces { loads.iter().sum::<f64>() / loads.len() as f64 } else { 0.0 };
    let mut carries = vec![false; view.len()];
    for (first, second, _) in pairs.iter().filter(|pair| pair.2 > least) {
        (carries[*first], carries[*second]) = (true, true);
    }
    let all = carries.iter().filter(|carries| **carries).count() as f64;
    let below = |grain: usize| (25e-3..55e-3).contains(&view.grains.position[grain].x);
    let under = (0..view.len()).filter(|&grain| carries[grain] && below(grain)).count() as f64;
    Network { loads, carry: all / view.len() as f64, under: under / all }
}

/// Standard deviation over mean.
fn scatter(loads: &[f64]) -> f64 {
    let n = loads.len() as f64;
    let mean = loads.iter().sum::<f64>() / n;
    (loads.iter().map(|load| (load - mean).powi(2)).sum::<f64>() / n).sqrt() / mean
}

/// The scene of the plate by a method, with changes; without a plate if `pressed` is false.
fn bed(method: &str, pressed: bool, changes: &[String]) -> Result<Rig, String> {
    let text = include_str!("../../../../studies/cl-ca-2001/plate.toml");
    let changes: Vec<String> = changes.iter().cloned().chain([format!("method={method}")]).collect();
    let scene = Scene::parse("plate", text, Path::new("."), &changes).map_err(|c| c.to_string())?;
    let mut plan = scene.plan().clone();
    if !pressed {
        plan.particles.retain(|name, _| name != "plate");
        plan.cl_ca.rule = tsubu_scene::plan::ClCaRule::Passive;
    }
    Rig::of(plan, 1.0)
}

/// The forces of a bed of discs into which the plate has been pushed for a time [s] since it met it, which is looked for from a time on:
/// a settled bed is lower than one of hexagons.
fn pushed_discs(pressed: bool, changes: &[String], from: f64, pushed: f64) -> Result<Network, String> {
    let mut rig = bed("dem", pressed, changes)?;
    rig.until(from)?;
    while !met(&rig) && rig.engine.time() < 1.7 {
        rig.until(rig.engine.time() + 1e-3)?;
    }
    rig.until(rig.engine.time() + pushed)?;
    Ok(network(&rig, Contacts::Forces))
}

/// What the forces in a bed of discs look like.
fn chains(discs: &Network) -> Vec<Claim> {
    let broad =
        own("forces of a pushed bed spread about as far as their mean (Radjai et al. 1996; Mueth et al. 1998)").after();
    let strong =
        own("forces above their mean run through chains, not through every grain (Radjai et al. 1996)").after();
    vec![
        between("DEM: spread of forces over their mean", scatter(&discs.loads), 0.6, 1.5, broad),
        between("DEM: share of grains with more than the mean force", discs.carry, 0.05, 0.9, strong),
        between("DEM: of those, share below the plate", discs.under, 0.37, 1.0, own("0.37 if all alike").after()),
    ]
}

/// C-x4 beside DEM: the forces of a bed of discs into which the same plate has been pushed as far.
pub(in super::super) fn plate_twin(perturbation: f64) -> Judged {
    ensemble::drawn("plate in discs", 1..=15, |seed| {
        let drawn = format!("seed={seed}");
        let pressed = perturbation == 1.0;
        let mut hexagons = bed("cl-ca", pressed, std::slice::from_ref(&drawn))?;
        hexagons.until(PUSHED)?;
        let lattice = network(&hexagons, Contacts::Places);
        // 1 mm at 50 mm/s.
        let discs = pushed_discs(pressed, std::slice::from_ref(&drawn), 0.3, 0.02)?;
        let twin = own("the same plate, pushed 1 mm into discs by DEM; a third either way").after();
        let alike = |name: &str, spread: f64| between(name, spread / scatter(&discs.loads), 0.67, 1.5, twin);
        let mut claims = chains(&discs);
        claims.extend([
            alike("spread of loads, CL-CA over DEM", scatter(&lattice.loads)),
            refused_number("a network where all pairs carry alike", &[alike("", 0.0)], 1),
            between("share of grains that carry, CL-CA over DEM", lattice.carry / discs.carry, 0.67, 1.5, twin),
        ]);
        let aside: Vec<String> = (0..9).map(|i| format!("['{} mm', '116 mm']", 2 + 3 * i)).collect();
        let aside = format!("particles.plate.start.at.position=[{}]", aside.join(", "));
        let beside = chains(&pushed_discs(true, &[aside, drawn.clone()], 0.3, 0.02)?);
        claims.push(refused("a plate at the side", &beside[2..], 1));
        let weightless = chains(&pushed_discs(true, &["gravity=0".to_owned(), drawn.clone()], 0.3, 0.02)?);
        claims.push(refused("discs without weight", &weightless[1..2], 1));
        let quick = "particles.plate.motion.driven.signal.steady.rate='1 m/s'".to_owned();
        let blow = chains(&pushed_discs(true, &[quick, drawn], 0.05, 0.0)?);
        claims.push(refused("a blow of 1 m/s", &blow[..1], 1));
        Ok(claims)
    })
}

/// Whether a grain of the plate touches one of the bed.
fn met(rig: &Rig) -> bool {
    let view = rig.engine.view(Wants { contacts: Contacts::Places, ..Wants::GRAINS });
    let group = |grain: usize| view.grains.group[grain];
    view.contacts.iter().any(|c| !c.wall && c.overlap > 0.0 && group(c.first) != group(c.second))
}
