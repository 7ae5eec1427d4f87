//! Leaping grains and a dam break in space, which the paper has in the plane, against measurements.

use super::super::bench::{Rig, near};
use super::super::control::refused;
use super::super::ensemble;
use super::{contact_seconds, rig};
use crate::case::Judged;
use crate::origin::{closed_form, printed, remembered};
use tsubu::watch::{self, Watch};
use tsubu_frame::Claim;
use tsubu_scene::TEMPLATES;

/// A scene of the program with some keys changed, at time 0.
fn template(name: &str, changes: &[&str], perturbation: f64) -> Result<Rig, String> {
    let text = TEMPLATES.iter().find(|template| template.name == name).map_or("", |template| template.text);
    rig(text, &changes.iter().map(|change| (*change).to_owned()).collect::<Vec<_>>(), perturbation)
}

/// A watch of the scene.
fn watch(rig: &Rig, name: &str) -> Box<dyn Watch> {
    watch::open(&rig.plan.watch[name].measure, &rig.plan)
}

/// One of its numbers, at a look of this moment.
fn number(rig: &Rig, watch: &mut dyn Watch, name: &str) -> f64 {
    let sample = watch.take(&rig.engine.view(watch.wants()));
    let found = watch.scalars().iter().position(|scalar| scalar.starts_with(name));
    found.map_or(f64::NAN, |place| sample.scalars[place])
}

/// Means over the hops after the first half second: height and length [m], velocity along the bed [m/s], contact time [s].
fn hops(changes: &[&str], perturbation: f64) -> Result<[f64; 4], String> {
    let mut rig = template("saltation-space", changes, perturbation)?;
    let mut hops = watch(&rig, "hops");
    let mut load = watch(&rig, "grains");
    rig.until(rig.plan.watch["hops"].from)?;
    let (mut speeds, mut looks) = (0.0, 0.0);
    while rig.engine.time() < rig.plan.duration {
        if rig.engine.steps().is_multiple_of(1000) {
            speeds += number(&rig, &mut *load, "moving speed");
            looks += 1.0;
        }
        rig.steps(1)?;
        hops.take(&rig.engine.view(hops.wants()));
    }
    let [height, length, contact] =
        ["mean height", "mean length", "mean contact time"].map(|name| number(&rig, &mut *hops, name));
    Ok([height, length, speeds / looks, contact])
}

/// V-58 in space: hops as high, long and fast as measured ones, to a factor of 2; contact times as in figure 6.
pub(in super::super) fn saltation_space(perturbation: f64) -> Judged {
    ensemble::drawn("leaping grains", 1..=3, |seed| {
        const D: f64 = 2e-3;
        let drawn = format!("seed={seed}");
        let gates = |found: [f64; 4]| {
            let wanted = [
                ("hop height over d", found[0] / D, 3.4),
                ("hop length over d", found[1] / D, 36.8),
                ("speed [m/s]", found[2], 0.741),
            ];
            wanted.map(|(what, value, wanted)| {
                let name = format!("leaping grains in space, Shields number 0.3: mean {what}");
                let source = remembered("Sklar and Dietrich 2004, of measured hops, a factor of 2");
                Claim::judge(name, value, Some(0.5 * wanted), Some(2.0 * wanted), source)
            })
        };
        let found = hops(&[&drawn], perturbation)?;
        let mut claims = gates(found).to_vec();
        let contact = |found: [f64; 4]| {
            let name = "leaping grains in space: contact time over pi sqrt(m/k)";
            let source = closed_form("Osada et al. 2004, figure 6 and (B8): general agreement");
            near(name, found[3] / contact_seconds(D, 1e4), 1.0, 0.1, source)
        };
        claims.push(contact(found));
        let faster = [
            "water.flow.log-law={shear-velocity=0.3,roughness=0.002,zero-level=-0.0005}",
            "water.surface=0.0195",
            &drawn,
        ];
        claims.push(refused("a stream three times as fast", &gates(hops(&faster, perturbation)?), 2));
        let dead = ["materials.quartz.restitution=0.05", &drawn];
        claims.push(refused("grains that hardly rebound", &gates(hops(&dead, perturbation)?), 1));
        let softer = hops(&["contact.normal.hooke.stiffness=5e3", "duration=1.5", &drawn], perturbation)?;
        claims.push(refused("half the stiffness", &[contact(softer)], 1));
        Ok(claims)
    })
}

/// Height of a bed of so many grains when its gate vanishes, and how far 99 % of its mass have come out in the end [m].
fn run_out(count: u32, changes: &[&str], perturbation: f64) -> Result<[f64; 2], String> {
    let count = format!("particles.gravel.count={count}");
    let mut rig = template("dam-break-space", &[&[count.as_str()], changes].concat(), perturbation)?;
    rig.until(0.29)?;
    let mut surface = watch(&rig, "surface");
    let height = number(&rig, &mut *surface, "surface height");
    rig.until(rig.plan.duration)?;
    let mut way = watch(&rig, "way");
    Ok([height, number(&rig, &mut *way, "mass front")])
}

/// Run-out of a dam break in space: in proportion to the height before, and how far.
pub(in super::super) fn dam_break_space(perturbation: f64) -> Judged {
    ensemble::drawn("fillings", 1..=5, |seed| {
        let drawn = format!("seed={seed}");
        let gates = |low: [f64; 2], high: [f64; 2]| {
            let power = (high[1] / low[1]).ln() / (high[0] / low[0]).ln();
            [
                Claim::judge(
                    "dam break in space: run-out over height before",
                    low[1] / low[0],
                    Some(0.6),
                    Some(2.4),
                    printed(
                        "1.2 for sand (Lube, Huppert, Sparks and Freundt 2005), a factor of 2: the constant is the material's",
                    ),
                ),
                Claim::judge(
                    "dam break in space: power of the height that the run-out goes with",
                    power,
                    Some(0.7),
                    Some(1.2),
                    printed("1 (Lube et al. 2005), 0.9 +- 0.1 (Balmforth and Kerswell 2005); 0.1 more for one filling"),
                ),
            ]
        };
        let mut claims =
            gates(run_out(1200, &[&drawn], perturbation)?, run_out(1800, &[&drawn], perturbation)?).to_vec();
        let locked = ["contact.rotation=false", "contact.rolling={none={}}", &drawn];
        let wrong = gates(run_out(1200, &locked, perturbation)?, run_out(1800, &locked, perturbation)?);
        claims.push(refused("grains that cannot turn", &wrong, 2));
        Ok(claims)
    })
}
