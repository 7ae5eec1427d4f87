//! A box of grains whose side vanishes: the slope that is left (figure 19).

use super::super::beds::line;
use super::super::bench::{Rig, refused, scalars, within};
use super::{FORWARD, VERLET, Way, law, rig};
use std::collections::BTreeMap;
use tsubu_frame::{Claim, Kind};

const SCENE: &str = include_str!("../../../../../../studies/sediment-2004/dam-break.toml");
/// Mean diameter [m], stiffness [N/m], place of the back wall [m], and when everything has come to rest [s].
const DIAMETER: f64 = 2e-3;
const STIFFNESS: f64 = 1e3;
const BACK: f64 = -40e-3;
const END: f64 = 1.4;
/// Grains of the floor, which come first.
const FLOOR: usize = 120;
/// Middle share of the free surface that the line is laid through.
const SHARE: f64 = 0.6;
/// Height below which a column is a single layer, over diameter.
const LAYER: f64 = 1.5;

/// A dam break in one of the ways that are compared.
#[derive(Clone, Copy)]
struct Break {
    rotation: bool,
    /// f' of (B13).
    rolling: f64,
    way: Way,
}

impl Break {
    fn of(rotation: bool) -> Self {
        Self { rotation, rolling: 0.0, way: Way { integrator: VERLET, steps: 20 } }
    }

    /// Slope that is left [degrees].
    fn slope(&self, seed: u32, spoiler: f64) -> Result<f64, String> {
        let mut changes = law(DIAMETER, STIFFNESS, self.way);
        changes.push(format!("seed={seed}"));
        changes.push(format!("contact.rotation={}", self.rotation));
        changes.push(format!("materials.gravel.rolling-friction={}", self.rolling));
        let mut rig = rig(SCENE, &changes, spoiler)?;
        rig.until(END)?;
        Ok(slope(&rig))
    }

    /// Median over seeds [degrees]: with rotation locked one heap in ten does not fall at all.
    fn median(&self, seeds: u32, spoiler: f64) -> Result<f64, String> {
        let slopes: Result<Vec<f64>, String> = (1..=seeds).map(|seed| self.slope(seed, spoiler)).collect();
        let mut slopes = slopes?;
        slopes.sort_by(f64::total_cmp);
        Ok(0.5 * (slopes[(slopes.len() - 1) / 2] + slopes[slopes.len() / 2]))
    }
}

/// Slope of the line by least squares through the middle of the free surface: the highest point of every column a
/// diameter wide, from the back wall to where the heap is no more than a single layer.
fn slope(rig: &Rig) -> f64 {
    let radii = scalars(&rig.frame(), Kind::Grain, "radius");
    let mut columns: BTreeMap<i64, f64> = BTreeMap::new();
    for (p, r) in rig.vectors("position").iter().zip(&radii).skip(FLOOR) {
        let column = ((p.x - BACK) / DIAMETER).floor() as i64;
        let top = columns.entry(column).or_insert(f64::MIN);
        *top = top.max((p.z + r) / DIAMETER);
    }
    let single = |k: &i64| columns.get(k).is_none_or(|top| *top < LAYER);
    let last = columns.keys().copied().max().unwrap_or(0);
    let length = (0..=last + 1).find(single).unwrap_or(last) as f64;
    let middle = columns.iter().map(|(k, top)| (*k as f64 + 0.5, *top));
    let middle: Vec<(f64, f64)> = middle.filter(|(x, _)| (x - 0.5 * length).abs() <= 0.5 * SHARE * length).collect();
    -line(&middle).0.atan().to_degrees()
}

/// B-F19: slopes with rotation locked and free; and what the paper's integration has to do with it.
pub(in super::super) fn dam_break(spoiler: f64) -> Result<Vec<Claim>, String> {
    let source = "about 33 degrees locked, 18 free (Osada 2004, figure 19)";
    let differs = "about 33 degrees (Osada 2004, figure 19); not what the law gives, see the README of the study";
    let locked = Break::of(false).median(10, spoiler)?;
    let free = Break::of(true).median(10, spoiler)?;
    let forward = Break { way: Way { integrator: FORWARD, steps: 14 }, ..Break::of(false) }.median(10, spoiler)?;
    let name = |what: &str| format!("dam break, {what}: slope in degrees, median of ten");
    let free_gate = |value| within(name("free rotation"), value, 18.0, 4.0, source);
    Ok(vec![
        within(name("rotation locked"), locked, 33.0, 4.0, differs),
        free_gate(free),
        within(name("rotation locked, forward differences with 14 steps per contact"), forward, 33.0, 4.0, source),
        refused("dam break, locked for free rotation", &[free_gate(locked)], 1),
    ])
}

/// B-F23: what the rolling friction (B13) does to the slope.
pub(in super::super) fn dam_break_rolling(spoiler: f64) -> Result<Vec<Claim>, String> {
    let mut claims = Vec::new();
    let mut slopes = Vec::new();
    for rolling in [0.0, 0.25, 0.5, 1.0] {
        slopes.push(Break { rolling, ..Break::of(true) }.median(5, spoiler)?);
    }
    let source = "rolling friction steepens the slope (Osada 2004, figure 23)";
    let name = "dam break, free rotation: slope with f' = 1 less that with 0, degrees";
    let steeper = |degrees| Claim::judge(name, degrees, Some(3.0), None, source);
    claims.push(steeper(slopes[3] - slopes[0]));
    claims.push(refused("rolling friction left out", &[steeper(0.0)], 1));
    let source =
        "33 to 38 degrees, as of locked grains and gravel (Osada 2004); not reached, see the README of the study";
    let most = slopes.iter().copied().fold(0.0, f64::max);
    claims.push(Claim::judge(
        "dam break: steepest slope for f' up to 1, degrees",
        most,
        Some(33.0),
        Some(38.0),
        source,
    ));
    Ok(claims)
}
