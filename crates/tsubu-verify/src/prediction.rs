//! An atlas of a cavity, and what it says of three structures that were not used to make it.

use super::control::refused;
use crate::case::Judged;
use crate::origin::own;
use std::path::Path;
use tsubu::study::{atlas, predict, response};
use tsubu_frame::Claim;
use tsubu_scene::Scene;

const DAMPER: &str = include_str!("../../../scenes/damper.toml");
const OSCILLATOR: &str =
    "structure.oscillator = { mass = \"86 g\", stiffness = \"123.4 N/m\", damping = \"0.08 N s/m\" }";
const BASE: &str = "base.sine = { amplitude = \"0.5 mm\", frequency = \"5.7 Hz\" }";

/// Structure and drive in the stead of the leaf spring: a heavier one that is pushed; a box on a spring on a frame, with two coordinates;
/// a strip with the box at its tip, which tilts.
const STRUCTURES: [(&str, &str, &str); 3] = [
    (
        "a heavy structure, pushed",
        "structure.oscillator = { mass = \"250 g\", stiffness = \"360 N/m\", damping = \"0.1 N s/m\" }",
        "force.sine = { amplitude = \"0.15 N\", frequency = \"5.7 Hz\" }",
    ),
    (
        "two coordinates",
        "structure.matrices = { mass = [[\"120 g\", 0], [0, \"500 g\"]], damping = [[\"0.05 N s/m\", \"-0.05 N s/m\"], [\"-0.05 N s/m\", \"0.3 N s/m\"]], \
         stiffness = [[\"200 N/m\", \"-200 N/m\"], [\"-200 N/m\", \"2500 N/m\"]] }",
        "base.sine = { amplitude = \"0.4 mm\", frequency = \"5.7 Hz\" }",
    ),
    (
        "the tip of a strip",
        "structure.beam = { length = \"0.5 m\", section.rectangle = { width = \"60 mm\", height = \"3 mm\" }, young-modulus = \"16 GPa\", density = \"1900 kg/m^3\", damping-ratio = 0.01 }\ninterface.tip.along = \"0.5 m\"",
        BASE,
    ),
];

const ASKED: [&str; 6] = [
    "atlas.frequency=[\"5 Hz\", \"7 Hz\"]",
    "atlas.acceleration=[\"0.5 g\", \"3 g\"]",
    "response.frequency-ratio={ from = 0.9, to = 1.03 }",
    "response.peak-within=0.003",
    "response.measure-periods=20",
    "output.frame-interval=none",
];

fn scene(structure: &str, drive: &str, count: usize) -> Result<Scene, String> {
    let mut text = DAMPER.replace(OSCILLATOR, structure).replace(BASE, drive);
    if structure.contains("tip") {
        text = text.replace("host = \"leaf-spring\"\n", "host = \"leaf-spring\"\ninterface = \"tip\"\n");
        text = text.replace("depth = \"6 mm\" }", "depth = \"6 mm\", floor-centre = [\"0.5 m\", 0, 0] }");
    }
    let counts = [
        format!("particles.balls.count={count}"),
        format!("response.vary={{\"particles.balls.count\" = [{count}]}}"),
        format!("atlas.vary={{\"particles.balls.count\" = [{count}]}}"),
    ];
    let changes: Vec<String> = ASKED.iter().map(|text| (*text).to_owned()).chain(counts).collect();
    Scene::parse("damper.toml", &text, Path::new("."), &changes).map_err(|complaints| complaints.to_string())
}

/// How far a predicted peak is from the simulated one [m], over what is accepted: 5 % of it, or the half of the band, whichever is
/// kinder.
fn off(scene: &Scene, cavities: &[atlas::Cavity], simulated: f64) -> Result<f64, String> {
    let curve = predict::curves(scene, cavities).map_err(|error| error.to_string())?.swap_remove(0);
    let (_, predicted) = curve.peak().ok_or("no peak is predicted")?;
    let end = |end: usize| curve.rows.iter().map(|row| row.within[end]).fold(0.0, f64::max) / std::f64::consts::SQRT_2;
    let (low, high) = (end(0), end(1));
    let from_band = (simulated - 0.5 * (low + high)).abs() / (0.5 * (high - low));
    Ok(((predicted / simulated - 1.0).abs() / 0.05).min(from_band))
}

/// The box with 30 balls alone on a shaker, then the peaks of three structures that carry it.
pub(super) fn three_structures(_spoiler: f64) -> Judged {
    let known = |count| atlas::cavities(&scene(OSCILLATOR, BASE, count)?).map_err(|error| error.to_string());
    let (thirty, ten) = (known(30)?, known(10)?);
    let (mut claims, mut wrong) = (Vec::new(), Vec::new());
    for (name, structure, drive) in STRUCTURES {
        let scene = scene(structure, drive, 30)?;
        let found = response::curves(&scene).map_err(|error| error.to_string())?;
        let simulated = found[0].peak.ok_or("no peak is simulated")?.rms;
        let source = own("asked for before it was computed: the peak within 5 %, or within the stated band");
        let judge = |value: f64| {
            Claim::judge(
                format!("{name}: predicted peak against DEM, over what is accepted"),
                value,
                None,
                Some(1.0),
                source,
            )
        };
        claims.push(judge(off(&scene, &thirty, simulated)?));
        // What ten balls show, taken for thirty.
        let taken: Vec<_> =
            ten.iter().map(|cavity| atlas::Cavity { plan: thirty[0].plan.clone(), ..cavity.clone() }).collect();
        wrong.push(judge(off(&scene, &taken, simulated)?));
    }
    claims.push(refused("ten balls taken for thirty", &wrong, 3));
    Ok(claims)
}
