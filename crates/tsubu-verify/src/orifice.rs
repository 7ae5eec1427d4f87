//! Silos in space that empty through a round hole (V-31).

use super::beds::law;
use super::bench::{Rig, within};
use super::control::{refused, refused_number};
use super::outlet::{Fit, seeds};
use crate::case::Judged;
use crate::origin::{own, remembered};
use glam::DVec3;
use tsubu_frame::Claim;

/// From the opening of the hole to when the flow has become steady.
const STARTS: f64 = 4.0;
/// Grains a unit of volume.
const PACKED: f64 = 1.1;
/// Radius of the silo over the width of the hole.
const SILO: f64 = 1.25;
/// Mean volume of a grain: that of diameter 1 times 1 + 3 times the variance of the diameters.
const VOLUME: f64 = std::f64::consts::PI / 6.0 * 1.0225;
/// Not counted for the density next to the side, the floor and the surface.
const EDGE: f64 = 2.0;
/// Spans of equal numbers of grains in which the rate of one silo is measured.
const SPANS: usize = 6;

/// Widths of holes, and how many silos with each.
const HOLES: [(f64, u32); 5] = [(6.0, 3), (8.0, 1), (10.0, 1), (14.0, 1), (20.0, 1)];

/// What is in a silo.
#[derive(Clone, Copy)]
struct Bed {
    /// Mean diameter of its grains.
    grain: f64,
    /// Height at the begin and at the end of counting, over the width of the hole.
    heights: [f64; 2],
}

const HIGH: Bed = Bed { grain: 1.0, heights: [2.0, 1.2] };

impl Bed {
    /// Grains in a silo of this hole at the begin or at the end.
    fn count(&self, hole: f64, end: usize) -> usize {
        let area = std::f64::consts::PI * (SILO * hole).powi(2);
        (self.heights[end] * hole * area * PACKED / self.grain.powi(3)) as usize
    }
}

/// When a hole opens: the bed has come to rest. The larger the silo the higher grains fall from, and the time of a fall grows
/// with the root of the height.
fn opens(hole: f64) -> f64 {
    20.0 * (hole / HOLES[0].0).sqrt()
}

/// A flat-bottomed cylinder 2.5 holes wide. Its hole is closed by a plate that vanishes; grains below it vanish.
fn silo(hole: f64, bed: &Bed, seed: u64) -> Result<Rig, String> {
    let radius = SILO * hole;
    let text = format!(
        r#"
        title = "a silo that empties through a hole"
        dimension = 3
        seed = {seed}
        gravity = 1
        duration = 1000
        {law}
        [particles.grains]
        material = "grain"
        count = {count}
        size.uniform = {{ smallest = {smallest}, largest = {largest} }}
        mass = 1
        start.random.region = {{ low = [-{radius}, -{radius}, 0.1], high = [{radius}, {radius}, {top}] }}
        [walls.side]
        material = "grain"
        shape.cylinder = {{ point = [0, 0, -0.1], axis = "z", radius = {radius} }}
        [walls.floor]
        material = "grain"
        shape.cone = {{ radius = {half}, end-radius = {radius}, length = 0.001 }}
        [walls.plate]
        material = "grain"
        shape.plane.point = [0, 0, -0.03]
        until = {opens}
        [removal.below]
        behind = {{ point = [0, 0, -3], normal = [0, 0, 1] }}
        "#,
        law = law(5e3, 0.5, 0.5),
        count = bed.count(hole, 0),
        smallest = 0.85 * bed.grain,
        largest = 1.15 * bed.grain,
        // Random places fill a quarter of the room.
        top = 2.4 * bed.heights[0] * hole,
        half = 0.5 * hole,
        opens = opens(hole),
    );
    Rig::new(&text, 1.0)
}

/// A silo that has emptied.
struct Run {
    /// Grains a unit of volume in the bed at rest, away from walls, floor and surface.
    density: f64,
    /// Grains a unit of time in spans of equal numbers of grains, while the bed sinks.
    rates: Vec<f64>,
}

fn run(hole: f64, bed: &Bed, seed: u64) -> Result<Run, String> {
    let mut rig = silo(hole, bed, seed)?;
    rig.until(opens(hole))?;
    let density = density(&rig.vectors("position"), SILO * hole);
    rig.until(opens(hole) + STARTS)?;
    let (first, last) = (rig.engine.grains(), bed.count(hole, 1));
    let (mut count, mut time) = (first, rig.engine.time());
    let mut rates = Vec::new();
    for span in 1..=SPANS {
        let target = first.saturating_sub(first.saturating_sub(last) * span / SPANS);
        while rig.engine.grains() > target {
            if rig.engine.time() > 400.0 {
                return Err(format!("the hole of {hole} d is blocked"));
            }
            rig.steps(20)?;
        }
        rates.push((count - rig.engine.grains()) as f64 / (rig.engine.time() - time));
        (count, time) = (rig.engine.grains(), rig.engine.time());
    }
    Ok(Run { density, rates })
}

/// Grains a unit of volume, two diameters away from the side, the floor and the highest grain.
fn density(centres: &[DVec3], radius: f64) -> f64 {
    let top = centres.iter().map(|p| p.z).fold(0.0, f64::max);
    let inside = |p: &&DVec3| p.x.hypot(p.y) < radius - EDGE && p.z > EDGE && p.z < top - EDGE;
    let volume = std::f64::consts::PI * (radius - EDGE).powi(2) * (top - 2.0 * EDGE);
    centres.iter().filter(inside).count() as f64 / volume
}

/// The gates, for the right law and for wrong ones.
fn gates(fit: &Fit) -> [Claim; 2] {
    let source = remembered("Beverloo 1961: exponent 5/2, k between 1.2 and 2");
    [
        Claim::judge("hole: width k at which the flow would end, in diameters", fit.end, Some(1.2), Some(2.0), source),
        within("hole: exponent of (D - 1.4 d), 6 to 20 d", fit.exponent, 2.5, 0.1, source),
    ]
}

/// V-31, in space: rate^(2/5) is straight in the width of the hole, zero at k d, and does not know the height.
pub(super) fn beverloo(perturbation: f64) -> Judged {
    let (mut claims, points) = discharge(&HOLES, &HIGH, perturbation)?;
    let whole = gates(&Fit::of(&points, 2.5, 0.0));
    claims.push(refused_number("hole, the whole width without k d", &whole[1..], 1));
    let flat = gates(&Fit::of(&points, 1.5, 1.4));
    claims.push(refused_number("hole, the exponent 3/2 of slots", &flat[..1], 1));
    let (coarse, _) = discharge(&[(8.0, 1), (10.0, 1), (14.0, 1)], &Bed { grain: 1.5, ..HIGH }, 1.0)?;
    claims.push(refused("hole, grains half as large again, taken for those of diameter 1", &coarse, 2));
    let (empty, _) = discharge(&[(8.0, 1), (10.0, 1)], &Bed { heights: [1.0, 0.4], ..HIGH }, 1.0)?;
    claims.push(refused("hole, beds that run empty", &empty, 4));
    Ok(claims)
}

/// What is claimed of holes of so many widths, each with so many silos; and `[D, W]`, which the fits are made of.
fn discharge(holes: &[(f64, u32)], bed: &Bed, perturbation: f64) -> Result<(Vec<Claim>, Vec<[f64; 2]>), String> {
    let (mut points, mut claims, mut densities) = (Vec::new(), Vec::new(), Vec::new());
    for &(hole, silos) in holes {
        let all = seeds(1, silos).map(|seed| run(hole, bed, seed)).collect::<Result<Vec<_>, _>>()?;
        // Spans have equal numbers of grains, so it is times that are added.
        let half = |spans: std::ops::Range<usize>| {
            all.iter().flat_map(|run| &run.rates[spans.clone()]).map(|rate| 1.0 / rate).sum::<f64>()
        };
        let source = remembered("Beverloo 1961: the rate does not know the height");
        let name = format!("hole of {hole} d: rate of the lower over that of the higher half");
        claims.push(within(name, half(0..SPANS / 2) / half(SPANS / 2..SPANS), 1.0, 0.1, source));
        let density = all.iter().map(|run| run.density).sum::<f64>() / f64::from(silos);
        let source = own("beds of frictional spheres at rest: between loosest and closest random packing").after();
        let name = format!("hole of {hole} d: share of the volume that grains fill");
        claims.push(within(name, density * VOLUME, 0.6, 0.045, source));
        // W = C rho sqrt(g) (D - k d)^2.5 with the density of the bed at rest.
        let rate = (all.len() * SPANS) as f64 / half(0..SPANS);
        let source = remembered("Beverloo 1961: C about 0.58; a tenth either way is ours");
        let constant = rate / (density * (hole - 1.4).powf(2.5));
        claims.push(within(format!("hole of {hole} d: C, with k = 1.4"), constant, 0.58, 0.06, source));
        points.push([hole * perturbation, rate]);
        densities.push(density);
    }
    let fit = Fit::of(&points, 2.5, 1.4);
    claims.extend(gates(&fit));
    let density = densities.iter().sum::<f64>() / densities.len() as f64;
    let source = remembered("Beverloo 1961: C about 0.58; a tenth either way is ours");
    claims.push(within("hole: C, with the k of the fit", fit.constant / density, 0.58, 0.06, source));
    Ok((claims, points))
}
