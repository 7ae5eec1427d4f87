//! Komatsuzaki, Sato, Iwata, Morishita 2003: every claim of the study, from its scenes.

mod cost;
mod shaken;

pub(super) use cost::figure_12;
pub(super) use shaken::figure_9;

use super::bench;
use crate::origin::{closed_form, own, printed};
use tsubu::study::response::{CaseResult, curves};
use tsubu_frame::{Claim, Source};
use tsubu_scene::Scene;

const FIGURE_3: &str = include_str!("../../../studies/damper-2003/fig3-dem.toml");
const FIGURE_3_EXTENDED: &str = include_str!("../../../studies/damper-2003/fig3-extended.toml");
const FIGURE_11: &str = include_str!("../../../studies/damper-2003/fig11-automaton.toml");

/// Peak heights of a single inelastic lump on the same structure: an order of magnitude, not the paper's data [m].
const LUMP: [(usize, f64); 3] = [(10, 9.58e-3), (30, 7.99e-3), (50, 7.73e-3)];

/// The cases of a response, with the contact law's constants multiplied by the perturbation.
fn respond(text: &str, changes: &[String], perturbation: f64) -> Result<Vec<CaseResult>, String> {
    let mut changes = changes.to_vec();
    changes.extend(bench::spoiled_materials(text, perturbation)?);
    let scene = Scene::parse("study scene", text, std::path::Path::new("."), &changes).map_err(|c| c.to_string())?;
    curves(&scene).map_err(|e| e.to_string())
}

/// Peak ratio and height of the case with this many grains.
fn peak(cases: &[CaseResult], count: usize) -> (f64, f64) {
    let case = cases.iter().find(|c| c.particles == count);
    case.and_then(|c| c.peak).map_or((f64::NAN, f64::NAN), |p| (p.ratio, p.rms))
}

/// What every DEM response must show: lower peaks with more balls, at the place of the added mass.
fn dem_claims(name: &str, cases: &[CaseResult], source: Source<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    for pair in [10, 30, 50].windows(2) {
        let ratio = peak(cases, pair[1]).1 / peak(cases, pair[0]).1;
        claims.push(Claim::judge(
            format!("{name}: peak with {} over peak with {}", pair[1], pair[0]),
            ratio,
            Some(0.0),
            Some(1.0),
            source,
        ));
    }
    for (count, lump) in LUMP {
        let (ratio, rms) = peak(cases, count);
        let limit = 1.0 / (1.0 + 0.2e-3 * count as f64 / 0.086_f64).sqrt();
        claims.push(Claim::judge(
            format!("{name}: peak frequency ratio with {count}"),
            ratio,
            Some(limit - 0.01),
            Some(limit + 0.01),
            closed_form("added-mass limit; the paper: lower with more balls"),
        ));
        claims.push(Claim::judge(
            format!("{name}: peak rms with {count} over that of an inelastic lump"),
            rms / lump,
            Some(0.8),
            Some(1.25),
            own("order of magnitude (a calculation of ours)").after(),
        ));
    }
    claims
}

/// A-F3a: literal DEM, wall friction 0.5.
pub(super) fn figure_3a(perturbation: f64) -> Result<Vec<Claim>, String> {
    let cases = respond(FIGURE_3, &["response.vary.\"materials.casing.friction\"=[0.5]".to_owned()], perturbation)?;
    Ok(dem_claims("DEM, wall friction 0.5", &cases, printed("figure 3a: more balls, lower peak")))
}

/// A-F3b: literal DEM, wall friction 0.6.
pub(super) fn figure_3b(perturbation: f64) -> Result<Vec<Claim>, String> {
    let cases = respond(FIGURE_3, &["response.vary.\"materials.casing.friction\"=[0.72]".to_owned()], perturbation)?;
    Ok(dem_claims("DEM, wall friction 0.6", &cases, printed("figure 3b: more balls, lower peak")))
}

/// A-F3 with rotation, tangential spring and constant restitution.
pub(super) fn figure_3_extended(perturbation: f64) -> Result<Vec<Claim>, String> {
    let cases = respond(FIGURE_3_EXTENDED, &[], perturbation)?;
    Ok(dem_claims("DEM, extended law", &cases, printed("figure 2 (experiment): more balls, lower peak")))
}

/// A-F11, literal: the peak falls and does not move down, which the authors name as the defect of their model.
pub(super) fn figure_11_literal(perturbation: f64) -> Result<Vec<Claim>, String> {
    let changes = ["response.vary.\"lattice.mode\"=[\"literal\"]".to_owned(), "response.seeds=20".to_owned()];
    let cases = respond(FIGURE_11, &changes, perturbation)?;
    let source =
        printed("figure 11: more balls, lower peak at a higher frequency (a defect of the model, says the paper)")
            .after();
    let mut claims = Vec::new();
    for pair in [0, 10, 30, 50].windows(2) {
        let (before, after) = (peak(&cases, pair[0]), peak(&cases, pair[1]));
        let name = format!("automaton, literal: peak with {} over peak with {}", pair[1], pair[0]);
        claims.push(Claim::judge(name, after.1 / before.1, Some(0.0), Some(1.0), source));
        // The frequency grid is 0.01 wide: a shift below half of it is none.
        let name = format!("automaton, literal: shift of the peak from {} to {}", pair[0], pair[1]);
        claims.push(Claim::judge(name, after.0 - before.0, Some(-0.005), None, source));
    }
    Ok(claims)
}

/// A-F11, extended: with resting impulses the shift has the sign of nature.
pub(super) fn figure_11_extended(perturbation: f64) -> Result<Vec<Claim>, String> {
    let extended = "response.vary.\"lattice.mode\"=[\"extended\"]".to_owned();
    let cases = respond(FIGURE_11, std::slice::from_ref(&extended), perturbation)?;
    let mut claims = Vec::new();
    let source = own("resting impulses bring the shift down").after();
    for pair in [0, 10, 30, 50].windows(2) {
        let (before, after) = (peak(&cases, pair[0]), peak(&cases, pair[1]));
        let name = format!("automaton, extended: peak with {} over peak with {}", pair[1], pair[0]);
        claims.push(Claim::judge(name, after.1 / before.1, Some(0.0), Some(1.0), source));
        let name = format!("automaton, extended: shift of the peak from {} to {}", pair[0], pair[1]);
        claims.push(Claim::judge(name, after.0 - before.0, None, Some(-0.001), source));
    }
    let small = [
        extended,
        "hosts.leaf-spring.base.sine.amplitude=0.05 mm".to_owned(),
        "response.seeds=1".to_owned(),
        "response.frequency-ratio={ from = 0.9, to = 1.04, step = 0.005 }".to_owned(),
    ];
    let cases = respond(FIGURE_11, &small, perturbation)?;
    for count in [10, 30, 50] {
        let limit = 1.0 / (1.0 + 0.2e-3 * f64::from(count) / 0.086_f64).sqrt();
        claims.push(Claim::judge(
            format!("automaton, extended, 0.05 mm: peak frequency ratio with {count}"),
            peak(&cases, count as usize).0,
            Some(limit - 0.01),
            Some(limit + 0.01),
            closed_form("added-mass limit at small amplitude"),
        ));
    }
    Ok(claims)
}
