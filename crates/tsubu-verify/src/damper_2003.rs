//! Komatsuzaki, Sato, Iwata, Morishita 2003: every claim of the study, from its scenes.

mod automaton;
mod cost;
mod shaken;

pub(super) use automaton::{figure_11_extended, figure_11_literal, hexagons};
pub(super) use cost::figure_12;
pub(super) use shaken::figure_9;

use super::control::refused;
use super::{bench, ensemble};
use crate::case::Judged;
use crate::origin::{closed_form, own, printed};
use std::ops::RangeInclusive;
use tsubu::study::response::{CaseResult, curves};
use tsubu_frame::{Claim, Ensemble, Points, Source};
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

/// What every response must show: lower peaks with more balls, at the place of the added mass.
fn response_claims(name: &str, cases: &[CaseResult], lumps: &[(usize, f64)], source: Source<'_>) -> Vec<Claim> {
    let mut claims = Vec::new();
    let counts: Vec<usize> = lumps.iter().map(|(count, _)| *count).collect();
    for pair in counts.windows(2) {
        let ratio = peak(cases, pair[1]).1 / peak(cases, pair[0]).1;
        claims.push(Claim::judge(
            format!("{name}: peak with {} over peak with {}", pair[1], pair[0]),
            ratio,
            Some(0.0),
            Some(1.0),
            source,
        ));
    }
    for &(count, lump) in lumps {
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

/// Balls three times as heavy, on a floor that they never leave, are an added mass that damps nothing: the peak is elsewhere, higher
/// than that of a lump that hits the box, and highest with the most balls.
fn heavy(text: &str, changes: &[&str]) -> Result<Claim, String> {
    let heavier = [
        "particles.balls.mass='0.6 g'",
        "gravity='100 m/s^2'",
        "response.frequency-ratio={ from = 0.89, to = 0.98, step = 0.01 }",
        "response.vary={ \"particles.balls.count\" = [10, 30] }",
    ];
    let changes: Vec<String> = changes.iter().chain(&heavier).map(|&change| change.to_owned()).collect();
    let cases = respond(text, &changes, 1.0)?;
    let gates = response_claims("", &cases, &LUMP[..2], printed("more balls, lower peak"));
    Ok(refused("balls three times as heavy that never leave the floor", &gates, 5))
}

/// Fillings of the box that a response is drawn from.
const FILLINGS: RangeInclusive<u64> = 1..=5;

/// The same of all fillings, and that heavy balls do not show it.
fn of_fillings(name: &str, text: &str, changes: &[&str], source: Source<'_>, perturbation: f64) -> Judged {
    let mut claims = ensemble::drawn("fillings", FILLINGS, |seed| {
        let drawn = format!("seed={seed}");
        let changes: Vec<String> = changes.iter().chain(&[drawn.as_str()]).map(|&change| change.to_owned()).collect();
        Ok(response_claims(name, &respond(text, &changes, perturbation)?, &LUMP, source))
    })?;
    claims.push(heavy(text, changes)?);
    Ok(claims)
}

/// A-F3a: literal DEM, wall friction 0.5.
pub(super) fn figure_3a(perturbation: f64) -> Judged {
    let source = printed("figure 3a: more balls, lower peak");
    let changes = ["response.vary.\"materials.casing.friction\"=[0.5]"];
    of_fillings("DEM, wall friction 0.5", FIGURE_3, &changes, source, perturbation)
}

/// A-F3b: literal DEM, wall friction 0.6, of which the paper says that it is nearer to the experiment than 0.5.
pub(super) fn figure_3b(perturbation: f64) -> Judged {
    let source = printed("figure 3b: more balls, lower peak");
    let changes = ["response.vary.\"materials.casing.friction\"=[0.72]"];
    let mut claims = of_fillings("DEM, wall friction 0.6", FIGURE_3, &changes, source, perturbation)?;
    claims.extend(told_apart(perturbation)?);
    Ok(claims)
}

/// Of two curves that cannot be told apart none is nearer to a third. The peaks of five fillings, with 0.6 over with 0.5; a figure shows
/// 1 %.
fn told_apart(perturbation: f64) -> Judged {
    const COUNTS: [usize; 3] = [10, 30, 50];
    let ratios: [Ensemble; 3] = ensemble::members("peaks with wall friction 0.6 over 0.5", FILLINGS, |seed| {
        let peaks = |friction: f64| {
            let changes = [
                format!("response.vary.\"materials.casing.friction\"=[{friction}]"),
                "response.frequency-ratio={ from = 0.9, to = 1.03, step = 0.01 }".to_owned(),
                format!("seed={seed}"),
            ];
            let cases = respond(FIGURE_3, &changes, perturbation)?;
            Ok::<_, String>(COUNTS.map(|count| peak(&cases, count).1))
        };
        let (rough, smooth) = (peaks(0.72)?, peaks(0.5)?);
        Ok(std::array::from_fn(|i| rough[i] / smooth[i]))
    })?;
    let mean = |ratio: &Ensemble| ratio.members.iter().sum::<f64>() / ratio.members.len() as f64;
    let points = Points {
        figure: "Figure 3b: what wall friction does to the peak".to_owned(),
        axes: ["balls [-]", "peak with friction 0.6 over 0.5 [-]"].map(String::from),
        series: "DEM, mean of five fillings".to_owned(),
        found: COUNTS.iter().zip(&ratios).map(|(count, ratio)| [*count as f64, mean(ratio)]).collect(),
        ..Points::default()
    };
    let source =
        own("figure 3b: 0.6 is nearer to the experiment than 0.5, so that the two must differ by what a figure shows")
            .after();
    let claims = COUNTS.into_iter().zip(ratios).map(|(count, ratio)| {
        let name = format!("DEM, {count} balls: peak with wall friction 0.6 over that with 0.5");
        Claim::judge_ensemble(name, ratio, None, Some(0.99), source).showing(points.clone())
    });
    Ok(claims.collect())
}

/// A-F3 with rotation, tangential spring and constant restitution.
pub(super) fn figure_3_extended(perturbation: f64) -> Judged {
    let source = printed("figure 2 (experiment): more balls, lower peak");
    of_fillings("DEM, extended law", FIGURE_3_EXTENDED, &[], source, perturbation)
}
