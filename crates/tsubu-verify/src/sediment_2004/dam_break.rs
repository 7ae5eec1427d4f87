//! A box of grains whose side vanishes: the slope that is left (figure 19).

use super::super::beds::line;
use super::super::bench::{Rig, scalars, within};
use super::super::control::refused;
use super::super::ensemble;
use super::{FORWARD, VERLET, Way, law, rig};
use crate::case::Judged;
use crate::origin::{own, printed};
use std::collections::BTreeMap;
use std::ops::Range;
use tsubu_frame::{Claim, Kind, Points, Source};

const SCENE: &str = include_str!("../../../../studies/sediment-2004/dam-break.toml");
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
    fn slope(&self, seed: u64, perturbation: f64) -> Result<f64, String> {
        let mut changes = law(DIAMETER, STIFFNESS, self.way);
        changes.push(format!("seed={seed}"));
        changes.push(format!("contact.rotation={}", self.rotation));
        changes.push(format!("materials.gravel.rolling-friction={}", self.rolling));
        if self.way.integrator == FORWARD {
            // Forward differences give contacts energy: now and then a grain is thrown deeper than a tenth into another.
            changes.push("dem.largest-overlap=0.2".to_owned());
        }
        let mut rig = rig(SCENE, &changes, perturbation)?;
        rig.until(END)?;
        Ok(slope(&rig))
    }

    /// Slopes of a set of fillings [degrees], by seed.
    fn slopes(&self, seeds: Range<u64>, perturbation: f64) -> Result<Vec<f64>, String> {
        seeds.map(|seed| self.slope(seed, perturbation)).collect()
    }
}

/// Median: with rotation locked one heap in ten does not fall at all.
fn median(slopes: &[f64]) -> f64 {
    let mut slopes = slopes.to_vec();
    slopes.sort_by(f64::total_cmp);
    0.5 * (slopes[(slopes.len() - 1) / 2] + slopes[slopes.len() / 2])
}

/// The slopes of several fillings, beside that of the paper.
fn shown(series: &str, slopes: &[f64], published: f64) -> Points {
    let at = |y: &dyn Fn(usize) -> f64| (0..slopes.len()).map(|k| [k as f64 + 1.0, y(k)]).collect::<Vec<_>>();
    Points {
        figure: "Figure 19: slope after a dam break".to_owned(),
        axes: ["filling [-]", "slope [deg]"].map(String::from),
        series: series.to_owned(),
        found: at(&|k| slopes[k]),
        published: at(&|_| published),
        ..Points::default()
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

/// Seeds of a set of fillings.
fn fillings(set: u64, count: u64) -> Range<u64> {
    count * set + 1..count * (set + 1) + 1
}

/// B-F19: slopes with rotation locked and free; and what the paper's integration has to do with it: the slope of locked grains hangs on
/// the steps in a contact, of which the paper says no more than that they are at least 10.
pub(in super::super) fn dam_break(perturbation: f64) -> Judged {
    ensemble::drawn("boxes", 0..=4, |set| {
        let source = printed("about 33 degrees locked, 18 free (Osada 2004, figure 19)");
        let differs =
            printed("about 33 degrees (Osada 2004, figure 19); not what the law gives, see the README of the study");
        let slopes = |what: Break| what.slopes(fillings(set, 10), perturbation);
        let (locked, free) = (slopes(Break::of(false))?, slopes(Break::of(true))?);
        let gate = |what: &str, slopes: &[f64], wanted: f64, source: Source<'_>| {
            let name = format!("dam break, {what}: slope in degrees, median of ten");
            within(name, median(slopes), wanted, 4.0, source).showing(shown(what, slopes, wanted))
        };
        let mut claims =
            vec![gate("rotation locked", &locked, 33.0, differs), gate("free rotation", &free, 18.0, source)];
        for steps in [14, 15, 16, 20] {
            let forward = slopes(Break { way: Way { integrator: FORWARD, steps }, ..Break::of(false) })?;
            let what = format!("rotation locked, forward differences with {steps} steps per contact");
            claims.push(gate(&what, &forward, 33.0, source.after()));
        }
        claims.push(refused("dam break, locked for free rotation", &[gate("", &locked, 18.0, source)], 1));
        claims.push(refused("dam break, free for locked rotation", &[gate("", &free, 33.0, source)], 1));
        Ok(claims)
    })
}

/// Sets from here on belong to no ensemble.
const OTHERS: u64 = 100;

/// B-F23: what the rolling friction (B13) does to the slope.
pub(in super::super) fn dam_break_rolling(perturbation: f64) -> Judged {
    ensemble::drawn("boxes", 0..=4, |set| {
        let mut claims = Vec::new();
        let mut slopes = Vec::new();
        let mut points = Points {
            figure: "Figure 23: rolling friction, free rotation".to_owned(),
            axes: ["f' [-]", "slope [deg]"].map(String::from),
            series: "median of five fillings".to_owned(),
            published: vec![[0.0, 33.0], [1.0, 33.0]],
            ..Points::default()
        };
        for rolling in [0.0, 0.25, 0.5, 1.0] {
            let found = median(&Break { rolling, ..Break::of(true) }.slopes(fillings(set, 5), perturbation)?);
            points.found.push([rolling, found]);
            slopes.push(found);
        }
        let source = own("rolling friction steepens the slope (Osada 2004, figure 23)").after();
        let name = "dam break, free rotation: slope with f' = 1 less that with 0, degrees";
        let steeper = |degrees| Claim::judge(name, degrees, Some(3.0), None, source);
        claims.push(steeper(slopes[3] - slopes[0]));
        let others = Break::of(true).slopes(fillings(set + OTHERS, 5), perturbation)?;
        claims.push(refused(
            "rolling friction left out, five other fillings",
            &[steeper(median(&others) - slopes[0])],
            1,
        ));
        let source = printed(
            "33 to 38 degrees, as of locked grains and gravel (Osada 2004); not reached, see the README of the study",
        );
        let most = slopes.iter().copied().fold(0.0, f64::max);
        let name = "dam break: steepest slope for f' up to 1, degrees";
        claims.push(Claim::judge(name, most, Some(33.0), Some(38.0), source).showing(points));
        Ok(claims)
    })
}
