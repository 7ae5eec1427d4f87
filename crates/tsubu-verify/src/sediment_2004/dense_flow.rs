//! A dense flow in a steep flume (figure 17), and the concentration of Takahashi.

use super::super::bench::{Rig, within};
use super::super::control::{refused, refused_number};
use super::super::ensemble;
use super::rig;
use crate::case::Judged;
use crate::origin::{closed_form, own, printed, regression};
use glam::DVec3;
use tsubu::state::sphere;
use tsubu::view::Wants;
use tsubu_frame::{Claim, Source};

const SCENE: &str = include_str!("../../../../studies/sediment-2004/dense-flow.toml");
/// Diameter [m], and length of the world in diameters.
const D: f64 = 2.18e-3;
const LONG: f64 = 60.0;
/// Looks begin and end, and the time between two of them [s].
const FROM: f64 = 1.0;
const UNTIL: f64 = 2.0;
const PAUSE: f64 = 0.02;
/// Looks in which the path of a grain is followed: 0.2 s.
const FOLLOWED: usize = 10;
/// Layers, a diameter thick each.
const LAYERS: usize = 24;
/// The paper's stream, with a concentration of 0.3.
const DRIVEN: [&str; 3] = [
    "particles.b-sand.count=234",
    "water.flow={log-law={depth='1.48 cm',zero-level='1.635 mm'}}",
    "water.hindrance={none={}}",
];
/// The turbulence of a stream over a rough bed.
const TURBULENT: &str = "water.fluctuation={strength=1.78,directions='stream'}";
/// Speed of a layer over that of the fastest from which it flows.
const FLOWS: f64 = 0.05;

/// What a flow comes to.
struct Flow {
    /// Thickness of what flows [m].
    depth: f64,
    /// Solid fraction in all of it, and in its upper third.
    fraction: f64,
    upper: f64,
    /// Speed of the fastest layer [m/s].
    speed: f64,
    /// How far a grain of the upper half goes up and down in 0.2 s, over its diameter: median.
    zigzag: f64,
}

/// The flow of the scene with some keys changed.
fn flow(changes: &[&str], seed: u64, perturbation: f64) -> Result<Flow, String> {
    let drawn = format!("seed={seed}");
    let changes: Vec<String> = changes.iter().chain([&drawn.as_str()]).map(|c| (*c).to_owned()).collect();
    let mut rig = rig(SCENE, &changes, perturbation)?;
    rig.until(FROM)?;
    let (mut count, mut sum) = ([0.0; LAYERS], [0.0; LAYERS]);
    let mut places: Vec<Vec<DVec3>> = Vec::new();
    let mut surface = 0.0;
    let looks = ((UNTIL - FROM) / PAUSE).round() as usize;
    for look in 1..=looks {
        rig.until(FROM + look as f64 * PAUSE)?;
        let place = free(&rig, "position");
        for (p, v) in place.iter().zip(free(&rig, "velocity")) {
            let layer = ((p.z / D).max(0.0) as usize).min(LAYERS - 1);
            count[layer] += 1.0;
            sum[layer] += v.x;
        }
        places.push(place);
        surface += rig.engine.view(Wants::GRAINS).water.map_or(f64::NAN, tsubu::water::Water::surface) / looks as f64;
    }
    let speed: Vec<f64> = (0..LAYERS).map(|k| if count[k] > 0.0 { sum[k] / count[k] } else { 0.0 }).collect();
    // The highest layers may hold a grain now and then.
    let fastest = (0..LAYERS).filter(|k| count[*k] >= looks as f64).map(|k| speed[k]).fold(0.0, f64::max);
    let low = (0..LAYERS).find(|k| speed[*k] > FLOWS * fastest).unwrap_or(0) as f64 * D;
    let depth = surface - low;
    let fraction = |low: f64| {
        let inside = places.iter().flatten().filter(|p| (low..surface).contains(&p.z)).count();
        inside as f64 / looks as f64 * sphere::volume(0.5 * D) / (LONG * D * D * (surface - low))
    };
    Ok(Flow {
        depth,
        fraction: fraction(low),
        upper: fraction(surface - depth / 3.0),
        speed: fastest,
        zigzag: zigzag(&places, surface - 0.5 * depth),
    })
}

/// The grains that are not fixed, which come last.
fn free(rig: &Rig, column: &str) -> Vec<DVec3> {
    rig.vectors(column).split_off(LONG as usize)
}

/// Median range of heights over the diameter, of grains that are above a height when their path is begun.
fn zigzag(places: &[Vec<DVec3>], above: f64) -> f64 {
    let mut ranges = Vec::new();
    for path in places.chunks_exact(FOLLOWED) {
        for grain in (0..path[0].len()).filter(|i| path[0][*i].z > above) {
            let heights = path.iter().map(|place| place[grain].z);
            let (least, most) = heights.fold((f64::MAX, f64::MIN), |(a, b), z| (a.min(z), b.max(z)));
            ranges.push((most - least) / D);
        }
    }
    ranges.sort_by(f64::total_cmp);
    ranges.get(ranges.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Solid fraction at which a flow neither digs nor deposits: tan t/((s - 1)(tan f - tan t)) (Takahashi 1978).
fn takahashi(slope: f64, friction: f64) -> f64 {
    let slope = slope.to_radians().tan();
    slope / (1.65 * (friction.to_radians().tan() - slope))
}

/// B-F17: the paper's stream, which grains do not slow, and one that digs into its bed and is slowed.
pub(in super::super) fn dense_flow(perturbation: f64) -> Judged {
    ensemble::drawn("flows", 1..=5, |seed| {
        let fraction = printed("concentration near the surface about 0.3 (Osada 2004, figure 17)").after();
        let upper = |value: f64, what: &str, source: Source<'_>| {
            within(format!("dense flow, {what}: solid fraction in the upper third"), value, 0.3, 0.1, source)
        };
        let strong = |value: f64, what: &str| {
            let source =
                own("strong motion up and down (Osada 2004, figure 17); in layers it would be less than a diameter")
                    .after();
            let name = format!("dense flow, {what}: way up and down in 0.2 s, upper half, diameters");
            Claim::judge(name, value, Some(1.0), None, source)
        };
        let driven = flow(&DRIVEN, seed, perturbation)?;
        let driven_gently = flow(&[DRIVEN.as_slice(), &["slope='2 deg'"]].concat(), seed, perturbation)?;
        let coupled = flow(&[], seed, perturbation)?;
        let turbulent = flow(&[TURBULENT], seed, perturbation)?;
        let gentle = flow(&["slope='2 deg'", TURBULENT], seed, perturbation)?;
        let source = printed("depth of the flume test, 1.48 cm (Osada 2004)");
        let deep =
            |value: f64, what: &str| within(format!("dense flow, {what}: depth m"), value, 0.0148, 0.003, source);
        let equal = |value: f64, what: &str, friction: f64| {
            let name = format!("dense flow, {what}: solid fraction over Takahashi's for {friction} degrees");
            within(name, value / takahashi(15.2, friction), 1.0, 0.25, printed("Takahashi 1978: 0.324 at 15.2 degrees"))
        };
        let faster = |driven: &Flow| {
            let source = closed_form("grains slow a stream that hears of them");
            let name = "dense flow: speed in the log law over that of the coupled stream";
            Claim::judge(name, driven.speed / coupled.speed, Some(1.0), None, source)
        };
        let mut claims = vec![
            upper(driven.upper, "log law", regression("as many grains as make 0.3 in the paper's depth are put in")),
            strong(driven.zigzag, "log law"),
            upper(coupled.upper, "coupled", fraction),
            strong(coupled.zigzag, "coupled"),
            deep(coupled.depth, "coupled"),
            equal(coupled.fraction, "coupled", 38.0),
            upper(turbulent.upper, "coupled and turbulent", fraction),
            strong(turbulent.zigzag, "coupled and turbulent"),
            deep(turbulent.depth, "coupled and turbulent"),
            equal(turbulent.fraction, "coupled and turbulent", 38.0),
            faster(&driven),
        ];
        claims.push(refused("the log law of a slope of 2 degrees", &[faster(&driven_gently)], 1));
        let wrong = [
            upper(gentle.upper, "", fraction),
            strong(gentle.zigzag, ""),
            deep(gentle.depth, ""),
            equal(gentle.fraction, "", 38.0),
        ];
        claims.push(refused("a slope of 2 degrees", &wrong, 2));
        claims.push(refused_number(
            "Takahashi's fraction for a friction of 25 degrees",
            &[equal(turbulent.fraction, "", 25.0)],
            1,
        ));
        Ok(claims)
    })
}
