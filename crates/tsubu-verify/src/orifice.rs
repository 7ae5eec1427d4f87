//! Silos in space that empty through a round hole (V-31).

use super::beds::law;
use super::bench::{Rig, within};
use super::control::{refused, refused_number};
use super::ensemble;
use super::outlet::Fit;
use crate::case::Judged;
use crate::origin::{own, remembered};
use glam::DVec3;
use std::ops::RangeInclusive;
use tsubu_frame::Claim;

/// When the hole opens: the bed, which falls by some 25 diameters, has come to rest.
const OPENS: f64 = 16.0;
/// From the opening of the hole to when the flow has become steady.
const STARTS: f64 = 10.0;
/// How many grains are counted at each hole, in two halves, by Beverloo's law.
const COUNTED: f64 = 1500.0;
/// For how long they are counted at least.
const SHORTEST: f64 = 10.0;
/// Grains a unit of volume.
const PACKED: f64 = 1.1;
/// The silo is wider than the hole by so much: from there on its width does not matter (Mankoc et al. 2007).
const WIDER: f64 = 30.0;
/// Mean volume of a grain: that of diameter 1 times 1 + 3 times the variance of the diameters.
const VOLUME: f64 = std::f64::consts::PI / 6.0 * 1.0225;
/// Not counted for the density next to the side and the floor.
const EDGE: f64 = 2.0;

/// Widths of holes.
const HOLES: [f64; 4] = [6.0, 8.0, 10.0, 14.0];

/// Draws of all silos.
const DRAWS: RangeInclusive<u64> = 1..=4;

/// What is in a silo.
#[derive(Clone, Copy)]
struct Bed {
    /// Mean diameter of its grains.
    grain: f64,
    /// Depth when counting ends, over the width of the silo.
    depth: f64,
}

/// More than twice as deep as the widest hole is wide.
const DEEP: Bed = Bed { grain: 1.0, depth: 0.7 };

impl Bed {
    /// Grains in a silo of this hole at the begin: what is there in the end, and what flows out until then by Beverloo's law.
    fn count(&self, hole: f64) -> usize {
        let width = hole + WIDER;
        let rests = self.depth * width * std::f64::consts::FRAC_PI_4 * width * width;
        let flows = expected(hole) * (STARTS + counted(hole));
        ((rests + flows) * PACKED / self.grain.powi(3)) as usize
    }
}

/// Grains a unit of time through a hole, by Beverloo's law.
fn expected(hole: f64) -> f64 {
    0.6 * (hole - 1.4).powf(2.5)
}

/// How long grains are counted at a hole.
fn counted(hole: f64) -> f64 {
    (COUNTED / expected(hole)).max(SHORTEST)
}

/// A flat-bottomed cylinder. Its hole is closed by a plate that vanishes; grains below it vanish.
fn silo(hole: f64, bed: &Bed, seed: u64) -> Result<Rig, String> {
    let (radius, count) = (0.5 * (hole + WIDER), bed.count(hole));
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
        start.rows = {{ spacing = 1.02, jitter = 1, speed = 1, region.cylinder = {{ point = [0, 0, 0.1], radius = {radius}, length = {top} }} }}
        [walls.side]
        material = "grain"
        shape.cylinder = {{ point = [0, 0, -0.1], axis = "z", radius = {radius} }}
        [walls.floor]
        material = "grain"
        shape.cone = {{ radius = {half}, end-radius = {radius}, length = 0.001 }}
        [walls.plate]
        material = "grain"
        shape.plane.point = [0, 0, -0.03]
        until = {OPENS}
        [removal.below]
        behind = {{ point = [0, 0, -3], normal = [0, 0, 1] }}
        "#,
        law = law(2e3, 0.5, 0.5),
        smallest = 0.85 * bed.grain,
        largest = 1.15 * bed.grain,
        // Rows of the widest grains, with gaps at the side, fill half as much of the room as the bed.
        top = 10.0 + 2.4 * count as f64 * bed.grain.powi(3) / (PACKED * std::f64::consts::PI * radius * radius),
        half = 0.5 * hole,
    );
    Rig::new(&text, 1.0)
}

/// A silo that has emptied.
struct Run {
    /// Grains a unit of volume in the bed at rest, away from walls, floor and surface.
    density: f64,
    /// Grains a unit of time in each half of the time.
    rates: [f64; 2],
}

impl Run {
    fn rate(&self) -> f64 {
        0.5 * (self.rates[0] + self.rates[1])
    }
}

fn run(hole: f64, bed: &Bed, seed: u64) -> Result<Run, String> {
    let mut rig = silo(hole, bed, seed)?;
    rig.until(OPENS)?;
    let width = hole + WIDER;
    let density = density(&rig.vectors("position"), 0.5 * width, (bed.depth * width).max(2.0 * EDGE));
    rig.until(OPENS + STARTS)?;
    let mut rates = [0.0; 2];
    for rate in &mut rates {
        let (count, time) = (rig.engine.grains(), rig.engine.time());
        rig.until(time + 0.5 * counted(hole))?;
        *rate = (count - rig.engine.grains()) as f64 / (rig.engine.time() - time);
    }
    Ok(Run { density, rates })
}

/// Grains a unit of volume below a height, two diameters away from the side and the floor. A few still fly above the bed when it opens,
/// so the height is that which is left when counting ends.
fn density(centres: &[DVec3], radius: f64, height: f64) -> f64 {
    let inside = |p: &&DVec3| p.x.hypot(p.y) < radius - EDGE && p.z > EDGE && p.z < height;
    let volume = std::f64::consts::PI * (radius - EDGE).powi(2) * (height - EDGE);
    centres.iter().filter(inside).count() as f64 / volume
}

/// Logarithm of what a law of the width [d] leaves of the rates when its constant is the best one, at its farthest.
fn farthest(points: &[[f64; 2]], law: impl Fn(f64) -> f64) -> f64 {
    let left: Vec<f64> = points.iter().map(|[hole, rate]| (rate / law(*hole)).ln()).collect();
    let mean = left.iter().sum::<f64>() / left.len() as f64;
    left.iter().map(|left| (left - mean).abs()).fold(0.0, f64::max)
}

/// The gates of the widths of holes and the rates `[D, W]`, for the right law and for wrong ones.
fn gates(points: &[[f64; 2]], power: f64, short: f64) -> Vec<Claim> {
    let fit = Fit::of(points, power, short);
    let source = remembered("Beverloo 1961: exponent 5/2, k between 1.2 and 2");
    let mut gates = vec![
        Claim::judge("hole: width k at which the flow would end, in diameters", fit.end, Some(1.2), Some(2.0), source),
        within("hole: exponent of (D - 1.4 d), 6 to 14 d", fit.exponent, 2.5, 0.1, source),
    ];
    let source = own("a law of one constant is to meet each rate within 3 %");
    let mut fits = |name: &str, far: f64| {
        gates.push(Claim::judge(format!("hole: farthest rate from {name}"), far, None, Some(0.03), source));
    };
    fits("the law with the k of the fit", farthest(points, |hole| (hole - fit.end).max(0.0).powf(power)));
    fits("the law with k = 1.4", farthest(points, |hole| (hole - short).powf(power)));
    // Mankoc et al. 2007, remembered: (1 - e^(-0.051 (R - 1))/2) (R - 1)^2.5 with R = D/d.
    let thinner = |hole: f64| (1.0 - 0.5 * (-0.051 * (hole - 1.0)).exp()) * (hole - 1.0).powf(power);
    fits("the law of Mankoc et al. 2007", farthest(points, thinner));
    gates
}

/// The gate for a bed half as deep as one of this hole and rate.
fn half_as_deep([hole, rate]: [f64; 2], bed: &Bed, draw: u64) -> Result<Claim, String> {
    let half = run(hole, &Bed { depth: 0.5 * bed.depth, ..*bed }, draw)?;
    let source = remembered("Beverloo 1961: the rate does not know the depth");
    let name = format!("hole of {hole} d: rate of a bed half as deep over that of the other");
    Ok(within(name, half.rate() / rate, 1.0, 0.05, source))
}

/// V-31, in space: rate^(2/5) is straight in the width of the hole, zero at k d, and does not know the depth.
pub(super) fn beverloo(perturbation: f64) -> Judged {
    let mut claims = ensemble::drawn("silos", DRAWS, |draw| {
        let (mut claims, points) = discharge(&HOLES, &DEEP, draw, perturbation)?;
        claims.push(half_as_deep([HOLES[2], points[2][1]], &DEEP, draw)?);
        claims.push(refused_number("hole, the whole width without k d", &gates(&points, 2.5, 0.0), 2));
        claims.push(refused_number("hole, the exponent 3/2 of slots", &gates(&points, 1.5, 1.4), 3));
        Ok(claims)
    })?;
    let (coarse, _) = discharge(&HOLES[1..], &Bed { grain: 1.5, ..DEEP }, 1, 1.0)?;
    claims.push(refused("hole, grains half as large again, taken for those of diameter 1", &coarse, 2));
    let shallow = Bed { depth: 0.05, ..DEEP };
    let (mut empty, points) = discharge(&HOLES[1..], &shallow, 1, 1.0)?;
    empty.push(half_as_deep(points[1], &shallow, 1)?);
    claims.push(refused("hole, beds that run empty", &empty, 4));
    Ok(claims)
}

/// What is claimed of holes of so many widths; and `[D, W]`, which the fits are made of.
fn discharge(holes: &[f64], bed: &Bed, draw: u64, perturbation: f64) -> Result<(Vec<Claim>, Vec<[f64; 2]>), String> {
    let (mut points, mut claims, mut densities) = (Vec::new(), Vec::new(), Vec::new());
    for &hole in holes {
        let found = run(hole, bed, draw)?;
        let [earlier, later] = found.rates;
        let source = own("steady: Beverloo 1961, the rate does not know the depth");
        let name = format!("hole of {hole} d: rate of the later over that of the earlier half");
        claims.push(within(name, later / earlier, 1.0, 0.1, source));
        let source = own("beds of frictional spheres at rest: between loosest and closest random packing").after();
        let name = format!("hole of {hole} d: share of the volume that grains fill");
        claims.push(within(name, found.density * VOLUME, 0.6, 0.045, source));
        // W = C rho sqrt(g) (D - k d)^2.5 with the density of the bed at rest.
        let source = remembered("Beverloo 1961: C about 0.58; a tenth either way is ours");
        let constant = found.rate() / (found.density * (hole - 1.4).powf(2.5));
        claims.push(within(format!("hole of {hole} d: C, with k = 1.4"), constant, 0.58, 0.06, source));
        points.push([hole * perturbation, found.rate()]);
        densities.push(found.density);
    }
    claims.extend(gates(&points, 2.5, 1.4));
    let density = densities.iter().sum::<f64>() / densities.len() as f64;
    let source = remembered("Beverloo 1961: C about 0.58; a tenth either way is ours");
    let constant = Fit::of(&points, 2.5, 1.4).constant;
    claims.push(within("hole: C, with the k of the fit", constant / density, 0.58, 0.06, source));
    Ok((claims, points))
}
