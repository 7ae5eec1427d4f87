//! The least height that flows, and the one law that it makes of all flows, at the size and stiffness of Silbert et al. 2001.
//!
//! Pouliquen (1999): a layer that has come to rest on a slope has the height h_stop of that slope, and the mean speed of a flow is
//! u / sqrt(g cos h) = b h / h_stop - c for every height and slope.

use super::{Flow, Slope, World, bagnold, grows};
use crate::beds::line;
use crate::bench::{Rig, within};
use crate::case::Judged;
use crate::control::refused;
use crate::origin::{own, remembered};
use crate::{ensemble, keep};
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::ops::RangeInclusive;
use tsubu_frame::{Claim, State};

/// Length and width of the periodic world.
const SIZE: [f64; 2] = [20.0, 10.0];
/// Stiffness of the springs, in m g/d.
const STIFFNESS: f64 = 2e5;
/// Bases, each with beds of its own.
const DRAWS: RangeInclusive<u64> = 1..=3;
/// Layers that are brought to rest, and slopes on which they begin: a degree steeper than the published ones.
const STOPPED: [[f64; 2]; 5] = [[4.0, 26.5], [6.0, 25.0], [10.0, 23.5], [16.0, 22.0], [24.0, 21.0]];
/// The slope is lowered by so much [degrees] each time, and left for so long.
const LOWERED: f64 = 0.25;
const LEFT: f64 = 50.0;
/// Mean speed of what rests.
const RESTS: f64 = 1e-3;
/// Slope, layers, and speed of the surface at the beginning, of flows: 40 layers are 8,000 grains, as there. High flows take hundreds of
/// sqrt(d/g) to forget how fast they began, so these begin about as fast as flows of a smaller world were in the end.
const FLOWS: [[f64; 3]; 8] = [
    [22.0, 40.0, 6.2],
    [24.0, 40.0, 13.8],
    [26.0, 40.0, 23.0],
    [22.0, 20.0, 1.0],
    [24.0, 20.0, 3.9],
    [26.0, 20.0, 7.7],
    [24.0, 10.0, 1.5],
    [26.0, 10.0, 3.0],
];
/// From when to when flows are looked at.
const LOOKED: [f64; 2] = [80.0, 200.0];

/// Slope and layers of flows of wrong models.
const WRONG: [[f64; 2]; 4] = [[17.0, 12.0], [22.0, 12.0], [25.0, 12.0], [25.0, 24.0]];

/// What is said of these grains: slopes below which none flows and above which none rests [degrees], a height [d], and the rise of the law of flows.
const SOURCE: &str = "Weinhart et al. 2012, Granular Matter 14: 17.56 and 32.26 degrees, 3.84 d, 0.191";
const PUBLISHED: Stopping = Stopping { gentlest: 0.316_46, steepest: 0.631_06, height: 3.836 };
const RISE: f64 = 0.191;

/// Heights at which layers come to rest: h_stop = A (tan t2 - tan t) / (tan t - tan t1).
#[derive(Clone, Copy, Debug)]
struct Stopping {
    /// tan t1: no layer flows on a gentler slope, however high.
    gentlest: f64,
    /// tan t2: no layer rests on a steeper slope, however thin.
    steepest: f64,
    /// A, in diameters.
    height: f64,
}

impl Stopping {
    /// The curve through heights and slopes [degrees], by least squares of h tan t = t1 h - A tan t + A t2.
    fn through(rests: &[[f64; 2]]) -> Self {
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for &[high, degrees] in rests {
            let tangent = degrees.to_radians().tan();
            let row = DVec3::new(high, -tangent, 1.0);
            matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
            right += row * (high * tangent);
        }
        let [gentlest, height, product] = (matrix.inverse() * right).to_array();
        Self { gentlest, steepest: product / height, height }
    }

    /// Height [d] of what rests at a slope [degrees].
    fn height(&self, degrees: f64) -> f64 {
        let tangent = degrees.to_radians().tan();
        self.height * (self.steepest - tangent) / (tangent - self.gentlest)
    }

    /// Slope [degrees] at which a layer of a height [d] comes to rest.
    fn slope(&self, high: f64) -> f64 {
        ((self.height * self.steepest + self.gentlest * high) / (self.height + high)).atan().to_degrees()
    }
}

/// The slope [degrees] at which a layer comes to rest while its slope is lowered, or `lowest`.
fn stops(slope: &Slope<'_>, lowest: f64, perturbation: f64) -> Result<f64, String> {
    let mut rig = slope.rig(perturbation)?;
    let mut degrees = slope.degrees;
    loop {
        rig.until(rig.engine.time() + LEFT)?;
        let speeds = slope.look(&rig);
        if speeds.iter().map(|g| g[1]).sum::<f64>() < RESTS * speeds.len() as f64 {
            // It flowed on the slope before.
            return Ok(degrees + 0.5 * LOWERED);
        }
        if degrees <= lowest {
            return Ok(lowest);
        }
        degrees -= LOWERED;
        rig = turned(&rig, degrees)?;
    }
}

/// The same grains on another slope.
fn turned(rig: &Rig, degrees: f64) -> Result<Rig, String> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut state = State::default();
    rig.engine.save(&mut state);
    let mut plan = rig.plan.clone();
    plan.gravity = [sin, 0.0, -cos];
    let mut turned = Rig::of(plan, 1.0)?;
    turned.engine.load(&mut state).map_err(|e| e.to_string())?;
    Ok(turned)
}

/// Mean speed over sqrt(g cos h).
fn froude(flow: &Flow) -> f64 {
    flow.speed / (flow.degrees.to_radians().cos() * flow.thickness).sqrt()
}

/// The gates of the law of all flows: it is one straight line over the height in units of `unit`, which tells one for each slope.
fn one_law(by: &str, flows: &[Flow], unit: impl Fn(f64) -> f64) -> [Claim; 2] {
    let points: Vec<(f64, f64)> = flows.iter().map(|f| (f.thickness / unit(f.degrees), froude(f))).collect();
    let (rise, begin) = line(&points);
    let off = points.iter().map(|(high, froude)| (froude - begin - rise * high).abs()).fold(0.0, f64::max);
    let fastest = points.iter().map(|p| p.1).fold(0.0, f64::max);
    let same = own("Pouliquen 1999: one line for all heights and slopes");
    let name = |what: &str| format!("all flows, {by}: {what}");
    [
        Claim::judge(name("farthest from one line, over the fastest"), off / fastest, None, Some(0.1), same),
        within(name("rise of the line"), rise, RISE, 0.15 * RISE, remembered(SOURCE)),
    ]
}

/// What the gates refuse, in a small world: a layer at rest, a flow on a plane, and what slides on it without friction, as fast in a high
/// layer as in a low one; and a layer without friction, which does not come to rest.
fn wrong_flows(layer: f64) -> Result<[Claim; 4], String> {
    let world = World::new(bagnold::SIZE, bagnold::STIFFNESS, 1, 1.0)?;
    let flows = keep::members("flows of wrong models", &[0, 1, 2, 3], |number| {
        let [degrees, layers] = WRONG[number as usize];
        let flow = match number {
            0 => Slope::new(&world, degrees, layers, 1.0).flow([200.0, 220.0], 1.0),
            1 => bagnold::on_a_plane(&world, degrees, layers),
            _ => bagnold::slide(&world, degrees, layers),
        };
        Ok(flow?.numbers())
    })?;
    let mut flows = flows.into_iter().zip(WRONG).map(|(n, [degrees, layers])| Flow::from(degrees, layers, n));
    let mut next = || flows.next().ok_or("a flow is missing");
    let [still, smooth, low, high] = [next()?, next()?, next()?, next()?];
    let slippery = stops(&Slope { friction: 0.0, ..Slope::new(&world, 17.0, 6.0, 3.0) }, 16.0, 1.0)?;
    Ok([
        refused("chute, a slope below the angle of repose", &still.gates()[..1], 1),
        refused("chute, a base that is a plane", &smooth.gates(), 1),
        refused("chute, grains without friction on a plane", &[grows(&high, &low)], 1),
        refused("chute, a layer of grains without friction", &[gate_of_rest(6.0, slippery, layer)], 1),
    ])
}

/// What one base and the beds on it come to.
struct Draw {
    flows: Vec<Flow>,
    /// Slopes [degrees] at which the layers come to rest.
    rests: Vec<f64>,
}

/// All draws: the runs of all side by side.
fn draws(perturbation: f64) -> Result<Vec<Draw>, String> {
    let seeds: Vec<u64> = if keep::is_spoilt() { vec![1] } else { DRAWS.collect() };
    let worlds = seeds.par_iter().map(|&seed| World::new(SIZE, STIFFNESS, seed, perturbation));
    let worlds: Vec<World> = worlds.collect::<Result<_, _>>()?;
    // A run's number tells its draw, too.
    let numbers = |runs: usize| -> Vec<u64> { (0..(worlds.len() * runs) as u64).collect() };
    let flows = keep::members("flows", &numbers(FLOWS.len()), |number| {
        let world = &worlds[number as usize / FLOWS.len()];
        let [degrees, layers, start] = FLOWS[number as usize % FLOWS.len()];
        Ok(Slope::new(world, degrees, layers, start).flow(LOOKED, perturbation)?.numbers())
    })?;
    let rests = keep::members("layers that come to rest", &numbers(STOPPED.len()), |number| {
        let world = &worlds[number as usize / STOPPED.len()];
        let [layers, degrees] = STOPPED[number as usize % STOPPED.len()];
        Ok([stops(&Slope::new(world, degrees, layers, 3.0), 15.0, perturbation)?])
    })?;
    let draw = |(flows, rests): (&[[f64; 7]], &[[f64; 1]])| Draw {
        flows: flows.iter().zip(FLOWS).map(|(n, [degrees, layers, _])| Flow::from(degrees, layers, *n)).collect(),
        rests: rests.iter().map(|[degrees]| *degrees).collect(),
    };
    Ok(flows.chunks(FLOWS.len()).zip(rests.chunks(STOPPED.len())).map(draw).collect())
}

/// The gate of a layer that comes to rest: as high as published for its slope, in layers of the height `high`.
fn gate_of_rest(layers: f64, degrees: f64, high: f64) -> Claim {
    let name = format!("a layer of {layers}: slope at which it comes to rest, less the published one");
    within(name, degrees - PUBLISHED.slope(layers * high), 0.0, 0.75, remembered(SOURCE))
}

impl Draw {
    /// Height of a layer [d]. Grains are as dense at rest as in flow, but for a few hundredths.
    fn layer(&self) -> f64 {
        self.flows.iter().map(|f| f.thickness / f.layers).sum::<f64>() / self.flows.len() as f64
    }

    fn claims(&self) -> Vec<Claim> {
        let (flows, high) = (&self.flows, self.layer());
        let rests = || STOPPED.iter().zip(&self.rests);
        let found = Stopping::through(&rests().map(|(&[layers, _], &d)| [layers * high, d]).collect::<Vec<_>>());
        let mut claims: Vec<Claim> =
            rests().map(|(&[layers, _], &degrees)| gate_of_rest(layers, degrees, high)).collect();
        claims.extend(flows[..3].iter().flat_map(Flow::gates));
        claims.extend([grows(&flows[0], &flows[3]), grows(&flows[1], &flows[4]), grows(&flows[2], &flows[5])]);
        claims.extend(one_law("by heights found here", flows, |degrees| found.height(degrees)));
        claims.extend(one_law("by published heights", flows, |degrees| PUBLISHED.height(degrees)));
        claims.push(refused(
            "chute, heights in diameters in the law of flows",
            &one_law("by diameters", flows, |_| 1.0),
            2,
        ));
        claims
    }
}

/// V-36 at full size: where layers come to rest, and how flows go by it.
pub fn stopping(perturbation: f64) -> Judged {
    let draws = draws(perturbation)?;
    let all: Vec<Vec<Claim>> = draws.iter().map(Draw::claims).collect();
    let values: Vec<Vec<f64>> = all.iter().map(|claims| claims.iter().map(|claim| claim.value).collect()).collect();
    let seeds: Vec<u64> = DRAWS.take(draws.len()).collect();
    let first = all.into_iter().next().ok_or("no draw")?;
    let mut claims = ensemble::of_draws(first, &seeds, &values)?;
    claims.extend(wrong_flows(draws[0].layer())?);
    Ok(claims)
}
