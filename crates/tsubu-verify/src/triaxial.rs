//! Triaxial tests of spheres: strength and stiffness, with friction and without, where spheres spin and where they do not.

use super::beds::line;
use super::bench::spoiled_materials;
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{own, printed, remembered};
use std::f64::consts::PI;
use std::path::Path;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::watch::{self, Watch};
use tsubu_frame::{Claim, Ensemble};
use tsubu_scene::{Plan, Scene};

const TEST: &str = include_str!("../../../studies/triaxial-spheres/triaxial.toml");
/// Axial strain from which on the sample flows at one stress; over how much of it the stress of the peak is a mean.
const FLOWS: f64 = 0.2;
const PEAK: f64 = 0.008;
/// Share of the first, slow stage after which the lid's start has died away.
const STARTED: f64 = 0.2;

/// What a look at the sample sees: mean and deviator stress [Pa], axial strain.
#[derive(Clone, Copy)]
struct Seen {
    mean: f64,
    deviator: f64,
    axial: f64,
}

/// A test on its way.
struct Sample {
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
}

impl Sample {
    fn new(plan: &Plan) -> Result<Self, String> {
        let hosts = Hosts::new(&plan.hosts);
        let engine = methods::open(plan, &hosts).map_err(|error| error.to_string())?;
        let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
        Ok(Self { engine, hosts, ledger })
    }

    /// What a watch of a plan tells now, by the names of its columns.
    fn look(&self, watch: &mut dyn Watch, names: &[&str]) -> Vec<f64> {
        let told = watch.take(&self.engine.view(watch.wants())).scalars;
        let columns = watch.scalars();
        let value = |name: &&str| columns.iter().position(|column| column.starts_with(*name)).map(|at| told[at]);
        names.iter().map(|name| value(name).unwrap_or(f64::NAN)).collect()
    }

    fn seen(&self, path: &mut dyn Watch) -> Seen {
        let told = self.look(path, &["mean stress", "deviator stress", "axial strain"]);
        Seen { mean: told[0], deviator: told[1], axial: told[2] }
    }

    /// Goes through a stage until it is over, or `over` says so; gives every look.
    fn go(&mut self, plan: &Plan, over: impl Fn(&Self, &Seen) -> bool) -> Result<Vec<Seen>, String> {
        let sample = &plan.watch["sample"];
        let mut path = watch::open(&sample.measure, plan);
        let pause = (sample.every.unwrap_or(0.0) / self.engine.time_step()).ceil().max(1.0) as u64;
        let looks = (plan.duration / self.engine.time_step()) as u64 / pause;
        let mut all = vec![self.seen(&mut *path)];
        for _ in 0..looks {
            self.engine.advance(pause, &mut self.hosts, &mut self.ledger).map_err(|error| error.to_string())?;
            let seen = self.seen(&mut *path);
            all.push(seen);
            if over(self, &seen) {
                break;
            }
        }
        Ok(all)
    }

    /// Whether the sample is at rest under the pressure.
    fn at_rest(&self, seen: &Seen) -> bool {
        let kinetic = engine::energies(&*self.engine, &self.hosts).kinetic;
        seen.mean > 98e3 && kinetic < 1e-10 * self.engine.grains() as f64
    }
}

/// The friction angle of the mean stresses of some looks [degrees].
fn angle(looks: &[Seen]) -> f64 {
    let (p, q) = looks.iter().fold((0.0, 0.0), |sum, seen| (sum.0 + seen.mean, sum.1 + seen.deviator));
    (q / (2.0 * p + q / 3.0)).asin().to_degrees()
}

/// Young's modulus of equal spheres with Hertz' and Mindlin's contacts that do not slip, if all move as the strain says: each has `z`
/// contacts and they fill the share `filled` under the pressure `p` (Walton 1987).
fn effective_medium(z: f64, filled: f64, p: f64, [young, nu]: [f64; 2]) -> f64 {
    let shear = young / (2.0 * (1.0 + nu));
    let common = (z * filled * shear / (PI * (1.0 - nu))).powi(2) * p;
    let bulk = (common / 18.0).cbrt();
    let rigidity = (5.0 - 4.0 * nu) / (5.0 * (2.0 - nu)) * (1.5 * common).cbrt();
    9.0 * bulk * rigidity / (3.0 * bulk + rigidity)
}

/// One test: friction angle at critical state and how much higher that of the peak is [degrees], Young's modulus over that of the
/// effective medium.
fn test(friction: f64, spin: bool, seed: u64, perturbation: f64) -> Result<[f64; 3], String> {
    let mut changes = vec![
        format!("seed={seed}"),
        format!("stage.1.set.materials.grain.friction={}", friction * perturbation),
        format!("contact.rotation={spin}"),
        // Grains that cannot roll away are pressed deep.
        format!("dem.largest-overlap={}", if spin { 0.1 } else { 1.0 }),
    ];
    changes.extend(spoiled_materials(TEST, perturbation)?);
    let scene = Scene::parse("study scene", TEST, Path::new("."), &changes).map_err(|wrong| wrong.to_string())?;
    let [compress, begin, shear] = scene.plans() else { return Err("three stages".to_owned()) };
    let mut sample = Sample::new(compress)?;
    let pressed = sample.go(compress, Sample::at_rest)?;
    if !pressed.last().is_some_and(|seen| sample.at_rest(seen)) {
        return Err("the sample does not come to rest".to_owned());
    }
    let contacts = sample.look(&mut *watch::open(&begin.watch["contacts"].measure, begin), &["mean"]);
    let voids = sample.look(&mut *watch::open(&begin.watch["sample"].measure, begin), &["mean stress", "porosity"]);
    let medium = effective_medium(contacts[0], 1.0 - voids[1], voids[0], [1e9, 0.3]);
    sample.engine.change([compress, begin], &sample.hosts).map_err(|error| error.to_string())?;
    let slow = sample.go(begin, |_, _| false)?;
    let from = (STARTED * slow.len() as f64) as usize;
    let stiffness = line(&slow[from..].iter().map(|seen| (seen.axial, seen.deviator)).collect::<Vec<_>>()).0;
    sample.engine.change([begin, shear], &sample.hosts).map_err(|error| error.to_string())?;
    let looks = sample.go(shear, |_, _| false)?;
    let flows = looks.iter().position(|seen| seen.axial > FLOWS).unwrap_or(looks.len());
    let critical = angle(&looks[flows..]);
    let about = |middle: &Seen| -> Vec<Seen> {
        looks.iter().filter(|seen| (seen.axial - middle.axial).abs() < 0.5 * PEAK).copied().collect()
    };
    let peak = looks.iter().step_by(10).map(|seen| angle(&about(seen))).fold(f64::MIN, f64::max);
    Ok([critical, peak - critical, stiffness / medium])
}

/// Tests with some seeds.
fn tests(of: &str, friction: f64, spin: bool, seeds: u64, perturbation: f64) -> Result<[Ensemble; 3], String> {
    ensemble::members(of, 1..=seeds, |seed| test(friction, spin, seed, perturbation))
}

/// The gates of spheres with a friction of a half, for those that are right and for wrong ones.
fn gates(of: &str, [critical, peak, stiffness]: &[Ensemble; 3]) -> Vec<Claim> {
    let strength =
        remembered("spheres with a friction of 0.5 by DEM: 19 to 24 degrees (Thornton 2000 and later)").after();
    let swells = own("a dense sample has a peak").after();
    let bound =
        own("at most 1: a strain that is alike everywhere is the stiffest (Walton 1987); at least 0.5: ours").after();
    let name = |what: &str| format!("{of}: {what}");
    vec![
        Claim::judge_ensemble(
            name("friction angle at critical state"),
            critical.clone(),
            Some(19.0),
            Some(24.0),
            strength,
        ),
        Claim::judge_ensemble(name("friction angle of the peak less that"), peak.clone(), Some(3.0), None, swells),
        Claim::judge_ensemble(
            name("Young's modulus over effective medium"),
            stiffness.clone(),
            Some(0.5),
            Some(1.0),
            bound,
        ),
    ]
}

/// The gate of spheres that slide freely.
fn sliding(of: &str, critical: &Ensemble) -> Claim {
    let source =
        remembered("Peyneau and Roux 2008: 5.76 degrees in simple shear, in the limit of large and slow samples");
    Claim::judge_ensemble(
        format!("{of}: friction angle of what slides freely"),
        critical.clone(),
        Some(4.5),
        Some(7.0),
        source,
    )
}

/// How much of what a friction of a half adds to the angle another half adds again.
fn saturation(of: &str, [free, half, whole]: [&Ensemble; 3]) -> Claim {
    let added = half.members.iter().zip(&free.members).zip(&whole.members);
    let more = added.map(|((half, free), whole)| (whole - half) / (half - free)).collect();
    let source =
        printed("Goncu and Luding 2013, abstract: the stress ratio rises with friction from above 0 and saturates")
            .after();
    let name = format!("{of}: added by a friction of 1 over what 0.5 adds");
    Claim::judge_ensemble(name, ensemble::of(&half.seeds, more), None, Some(0.35), source)
}

/// Strength and stiffness beside what is published.
pub(super) fn spheres(perturbation: f64) -> Judged {
    let half = tests("friction 0.5", 0.5, true, 5, perturbation)?;
    let free = tests("without friction", 0.0, true, 5, perturbation)?;
    let whole = tests("friction 1", 1.0, true, 5, perturbation)?;
    let locked = tests("locked, friction 0.5", 0.5, false, 3, perturbation)?;
    let locked_whole = tests("locked, friction 1", 1.0, false, 3, perturbation)?;
    let mut claims = gates("spheres, friction 0.5", &half);
    claims.push(sliding("spheres without friction", &free[0]));
    claims.push(saturation("spheres", [&free[0], &half[0], &whole[0]]));
    claims.push(refused("spheres without friction", &gates("wrong spheres", &free), 3));
    claims.push(refused("spheres with friction", &[sliding("wrong spheres", &half[0])], 1));
    // What slides freely does not spin up either.
    let of = "spheres that do not spin";
    let mut wrong = gates(of, &locked);
    wrong.push(saturation(of, [&free[0], &locked[0], &locked_whole[0]]));
    claims.push(refused(of, &wrong, 2));
    Ok(claims)
}
