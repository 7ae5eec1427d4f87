//! A core of rock whose bonds have strengths that scatter by Weibull: the more they scatter the weaker is the core.

use crate::bench::{self, Rig};
use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::own;
use tsubu_frame::{Claim, Kind, Values};

/// The core that ships, pressed between two plates.
const SCENE: &str = include_str!("../../../scenes/rock-core.toml");
/// Weibull moduli of the strengths, from a wide scatter to next to none.
const MODULI: [f64; 4] = [1.5, 2.0, 4.0, 20.0];
/// Area of the core [m^2].
const AREA: f64 = 78.5e-6;
/// Time between looks, and until the last, by when each core has failed [s].
const LOOKS: [f64; 2] = [10e-6, 1.8e-3];
/// The lid among walls in contacts.
const LID: i64 = -2;

/// The largest stress on the lid [Pa].
fn strength(modulus: Option<f64>, seed: u64, perturbation: f64) -> Result<f64, String> {
    let mut plan = bench::plan(SCENE)?;
    plan.seed = seed;
    for bond in &mut plan.bond {
        bond.weibull_modulus = modulus;
    }
    let mut rig = Rig::of(plan, perturbation)?;
    let mut most: f64 = 0.0;
    for look in 1..=(LOOKS[1] / LOOKS[0]).round() as u32 {
        rig.until(f64::from(look) * LOOKS[0])?;
        let frame = rig.frame();
        let Some(Values::Integer(second)) = frame.column(Kind::Contact, "second").map(|column| &column.values) else {
            continue;
        };
        let forces = bench::vectors(&frame, Kind::Contact, "force");
        let on_lid = second.iter().zip(&forces).filter(|(second, _)| **second == LID);
        most = most.max(on_lid.map(|(_, force)| force.z.abs()).sum::<f64>() / AREA);
    }
    Ok(most)
}

/// Strength of a bundle of threads over the mean strength of a thread: Daniels 1945, (m e)^(-1/m) / Gamma(1 + 1/m).
fn bundle(modulus: f64) -> f64 {
    (modulus * std::f64::consts::E).powf(-1.0 / modulus) / libm::tgamma(1.0 + 1.0 / modulus)
}

/// A core with the scatter of a modulus, over one with less scatter.
fn weaker(modulus: f64, than: f64, ratio: f64) -> Claim {
    let name = format!("rock core, bonds of Weibull modulus {modulus}: strength over that with {than}");
    Claim::judge(name, ratio, None, Some(0.99), own("the more strengths scatter, the sooner a core cracks").after())
}

/// Strengths of cores with bonds of four scatters.
pub(super) fn core(perturbation: f64) -> Judged {
    ensemble::drawn("cores", 1..=5, |seed| {
        let mut strengths = [0.0; MODULI.len()];
        for (strength, modulus) in strengths.iter_mut().zip(MODULI) {
            *strength = self::strength(Some(modulus), seed, perturbation)?;
        }
        let steps = (0..MODULI.len() - 1).map(|k| (MODULI[k], MODULI[k + 1], strengths[k] / strengths[k + 1]));
        let mut claims: Vec<Claim> = steps.map(|(modulus, than, ratio)| weaker(modulus, than, ratio)).collect();
        let alike = strengths[MODULI.len() - 1];
        let [wide, narrow] = [MODULI[0], MODULI[MODULI.len() - 1]];
        let name = format!("rock core, bonds of Weibull modulus {wide}: strength over that with {narrow}");
        let source = own("between no loss and that of a bundle which shares its load evenly (Daniels 1945)").after();
        claims.push(Claim::judge(name, strengths[0] / alike, Some(bundle(wide) / bundle(narrow)), Some(1.0), source));
        let none = strength(None, seed, perturbation)? / alike;
        claims.push(refused("bonds of one strength for scattered ones", &[weaker(wide, narrow, none)], 1));
        Ok(claims)
    })
}
