//! Silos in the plane that empty through a slot (V-31).

use super::beds::{law, line};
use super::bench::{Rig, within};
use super::control::{refused, refused_number};
use super::ensemble;
use crate::case::Judged;
use crate::origin::remembered;
use std::fmt::Write;
use std::ops::RangeInclusive;
use tsubu_frame::Claim;

/// When the slot opens: the bed has come to rest.
const OPENS: f64 = 20.0;
/// When the flow has become steady.
const STEADY: f64 = OPENS + 8.0;
/// Grains a unit of area.
const PACKED: f64 = 1.04;
/// Spans of equal numbers of grains in which the rate of one silo is measured.
const SPANS: usize = 6;

/// Width of a slot, and how many silos with it in a draw: the narrowest lets out the fewest grains and has two.
const SLOTS: [(f64, u32); 5] = [(6.0, 2), (8.0, 1), (10.0, 1), (14.0, 1), (20.0, 1)];

/// Draws of all silos.
const DRAWS: RangeInclusive<u64> = 1..=15;

/// Seeds of so many silos of a draw.
fn seeds(draw: u64, silos: u32) -> impl Iterator<Item = u64> {
    (0..u64::from(silos)).map(move |silo| 10 * (draw - 1) + silo + 1)
}

/// What is in a silo.
#[derive(Clone, Copy)]
struct Bed {
    /// Mean diameter of its grains.
    grain: f64,
    /// Height at the begin and at the end of counting: so many widths of the slot, and so many diameters more.
    heights: [[f64; 2]; 2],
}

/// Always higher than two slots, which the law asks for.
const HIGH: Bed = Bed { grain: 1.0, heights: [[4.0, 20.0], [2.0, 10.0]] };

impl Bed {
    /// Grains in a silo of this slot at the begin or at the end.
    fn count(&self, slot: f64, end: usize) -> usize {
        let [slots, more] = self.heights[end];
        (4.0 * slot * (slots * slot + more) * PACKED / self.grain.powi(2)) as usize
    }
}

/// A flat-bottomed silo, four slots wide. Its slot, between frozen grains, is closed by a plate that falls
/// away faster than grains do; grains below it vanish.
fn silo(slot: f64, bed: &Bed, seed: u64) -> Result<Rig, String> {
    let half = 2.0 * slot;
    let mut floor = String::new();
    for i in 0..(half - 0.5 * slot) as u32 {
        let x = 0.5 * slot + 0.5 + f64::from(i);
        let _ = write!(floor, "[{x}, 0], [-{x}, 0],");
    }
    let [slots, more] = bed.heights[0];
    let text = format!(
        r#"
        title = "a silo that empties through a slot"
        seed = {seed}
        gravity = 1
        duration = 1000
        {law}
        [particles.a-floor]
        material = "grain"
        diameter = 1
        mass = 1
        motion.frozen = {{}}
        start.at.position = [{floor}]
        [particles.b-grains]
        material = "grain"
        count = {count}
        size.uniform = {{ smallest = {smallest}, largest = {largest} }}
        mass = 1
        start.rows = {{ spacing = 1.01, jitter = 0.5, region = {{ low = [-{half}, 0.6], high = [{half}, {top}] }} }}
        [walls.plate]
        material = "grain"
        shape.plane.point = [0, -0.5]
        motion.signal.table = {{ time = [0, {OPENS}, {gone}], value = [0, 0, -200] }}
        [walls.left]
        material = "grain"
        shape.plane = {{ point = [-{half}, 0], normal = [1, 0] }}
        [walls.right]
        material = "grain"
        shape.plane = {{ point = [{half}, 0], normal = [-1, 0] }}
        [removal.below]
        behind = {{ point = [0, -5], normal = [0, 1] }}
        "#,
        law = law(5e3, 0.5, 0.5),
        count = bed.count(slot, 0),
        smallest = 0.85 * bed.grain,
        largest = 1.15 * bed.grain,
        top = 1.5 * (slots * slot + more) + 3.0,
        gone = OPENS + 5.0,
    );
    Rig::new(&text, 1.0)
}

/// Grains a unit of time in spans of equal numbers of grains, while the bed sinks.
fn rates(slot: f64, bed: &Bed, seed: u64) -> Result<Vec<f64>, String> {
    let mut rig = silo(slot, bed, seed)?;
    rig.until(STEADY)?;
    let (first, last) = (rig.engine.grains(), bed.count(slot, 1));
    let (mut count, mut time) = (first, rig.engine.time());
    let mut found = Vec::new();
    for span in 1..=SPANS {
        let target = first - first.saturating_sub(last) * span / SPANS;
        while rig.engine.grains() > target {
            if rig.engine.time() > 500.0 {
                return Err(format!("the slot of {slot} d is blocked"));
            }
            rig.steps(20)?;
        }
        found.push((count - rig.engine.grains()) as f64 / (rig.engine.time() - time));
        (count, time) = (rig.engine.grains(), rig.engine.time());
    }
    Ok(found)
}

/// What the law has to say of slots and rates: `[D, W]`.
pub(super) struct Fit {
    /// Width at which the flow would end, if rates go with the power `power` of the rest.
    pub end: f64,
    /// Exponent of (D - `short`).
    pub exponent: f64,
    /// Rate over (D - `end`)^`power`.
    pub constant: f64,
}

impl Fit {
    pub fn of(points: &[[f64; 2]], power: f64, short: f64) -> Self {
        let (slope, offset) = line(&points.iter().map(|[d, w]| (*d, w.powf(1.0 / power))).collect::<Vec<_>>());
        let exponent = line(&points.iter().map(|[d, w]| ((d - short).ln(), w.ln())).collect::<Vec<_>>()).0;
        Self { end: -offset / slope, exponent, constant: slope.powf(power) }
    }

    /// The gates, for the right law and for wrong ones.
    fn claims(&self) -> [Claim; 2] {
        let source = remembered("Beverloo 1961 in the plane, exponent 3/2");
        let name = "slot: width k at which the flow would end, in diameters";
        [
            Claim::judge(name, self.end, Some(1.2), Some(2.0), source),
            within("slot: exponent of (D - 1.4 d), 6 to 20 d", self.exponent, 1.5, 0.1, source),
        ]
    }
}

/// V-31, in the plane: rate^(2/3) is straight in the width of the slot, zero at k d, and does not know the height.
pub(super) fn beverloo(perturbation: f64) -> Judged {
    let mut claims = ensemble::drawn("silos", DRAWS, |draw| {
        let (mut claims, points) = discharge(&SLOTS, &HIGH, draw, perturbation)?;
        let whole = Fit::of(&points, 1.5, 0.0).claims();
        claims.push(refused_number("slot, the whole width without k d", &whole[1..], 1));
        let round = Fit::of(&points, 2.5, 1.4).claims();
        claims.push(refused_number("slot, the exponent 5/2 of round holes", &round[..1], 1));
        Ok(claims)
    })?;
    let wide = [(10.0, 1), (14.0, 1), (20.0, 1)];
    let (coarse, _) = discharge(&wide, &Bed { grain: 1.5, ..HIGH }, 1, 1.0)?;
    claims.push(refused("slot, grains half as large again", &coarse, 2));
    let shallow = Bed { grain: 1.0, heights: [[1.2, 0.0], [0.6, 0.0]] };
    let (empty, _) = discharge(&wide, &shallow, 1, 1.0)?;
    claims.push(refused("slot, beds that run empty", &empty, 4));
    Ok(claims)
}

/// What is claimed of slots of so many widths, each with so many silos of a draw; and `[D, W]`, which the fits are made of.
fn discharge(
    slots: &[(f64, u32)],
    bed: &Bed,
    draw: u64,
    perturbation: f64,
) -> Result<(Vec<Claim>, Vec<[f64; 2]>), String> {
    let (mut points, mut claims) = (Vec::new(), Vec::new());
    for &(slot, silos) in slots {
        let all = seeds(draw, silos).map(|seed| rates(slot, bed, seed)).collect::<Result<Vec<_>, _>>()?;
        // Spans have equal numbers of grains, so it is times that are added.
        let half = |spans: std::ops::Range<usize>| {
            all.iter().flat_map(|silo| &silo[spans.clone()]).map(|rate| 1.0 / rate).sum::<f64>()
        };
        let later = half(0..SPANS / 2) / half(SPANS / 2..SPANS);
        let source = remembered("Beverloo 1961: the rate does not know the height");
        claims.push(within(
            format!("slot of {slot} d: rate at half the height over rate before"),
            later,
            1.0,
            0.1,
            source,
        ));
        points.push([slot * perturbation, (all.len() * SPANS) as f64 / half(0..SPANS)]);
    }
    claims.extend(Fit::of(&points, 1.5, 1.4).claims());
    Ok((claims, points))
}
