//! Silos in the plane: pressure (V-32).

use super::beds::{centres, law, sampled};
use super::bench::{Rig, near, scalars, vectors};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use std::ops::RangeInclusive;
use tsubu_frame::{Claim, Kind, Values};

const WIDTH: f64 = 12.0;
/// Less than that of grains on grains, so that grains slide on the walls and do not roll along them.
const WALL_FRICTION: f64 = 0.3;
/// Draws, and silos in each: stresses of single ones scatter by a tenth.
const DRAWS: RangeInclusive<u64> = 1..=12;
const SILOS: u64 = 5;
/// When the bed is at rest and the floor begins to sink; how fast it sinks.
const RESTS: f64 = 30.0;
const SINKS: f64 = 0.05;
/// How far it has sunk when the column is looked at, first and last: at the walls grains roll before they slide, for two
/// diameters or so.
const SUNK: [f64; 2] = [2.5, 4.5];

/// A column between two walls on a floor that sinks slowly, so that friction at the walls acts upward and at its limit.
fn column(friction: f64, seed: u64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "a silo whose floor sinks"
        seed = {seed}
        gravity = 1
        duration = 1000
        {law}
        [materials.wall]
        young-modulus = 1e6
        restitution = 0.5
        [[material-pair]]
        between = ["grain", "wall"]
        friction = {friction}
        [particles.grains]
        material = "grain"
        count = 940
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        start.rows = {{ spacing = 1.02, jitter = 0.5, region = {{ low = [0, 0], high = [{WIDTH}, 160] }} }}
        [walls.a-left]
        material = "wall"
        shape.plane.normal = [1, 0]
        [walls.b-right]
        material = "wall"
        shape.plane = {{ point = [{WIDTH}, 0], normal = [-1, 0] }}
        [walls.c-floor]
        material = "grain"
        shape.plane = {{}}
        motion.signal.table = {{ time = [0, {RESTS}, {end}], value = [0, 0, -{sunk}] }}
        "#,
        law = law(5e3, 0.5, 0.5),
        end = RESTS + 1000.0,
        sunk = 1000.0 * SINKS,
    );
    Rig::new(&text, 1.0)
}

/// A column at one time: height and mass of every grain, from the top down; height, pressure and upward friction of every
/// contact with a side wall.
struct Seen {
    grains: Vec<(f64, f64)>,
    walls: Vec<[f64; 3]>,
}

impl Seen {
    fn of(rig: &Rig, masses: &[f64]) -> Self {
        let frame = rig.frame();
        let mut grains: Vec<_> = centres(rig, 0).iter().zip(masses).map(|(p, m)| (p.z, *m)).collect();
        grains.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (places, forces) = (vectors(&frame, Kind::Contact, "position"), vectors(&frame, Kind::Contact, "force"));
        let seconds = match frame.column(Kind::Contact, "second").map(|c| &c.values) {
            Some(Values::Integer(v)) => v.clone(),
            _ => Vec::new(),
        };
        let walls = seconds.iter().zip(places.iter().zip(&forces)).filter(|(s, _)| **s == -1 || **s == -2);
        Self { grains, walls: walls.map(|(_, (p, f))| [p.z, f.x.abs(), f.z]).collect() }
    }

    /// Weight a unit of area, away from top and floor.
    fn bulk(&self) -> f64 {
        let (from, to) = (self.grains.len() / 6, self.grains.len() * 5 / 6);
        let weight: f64 = self.grains[from..to].iter().map(|g| g.1).sum();
        weight / (WIDTH * (self.grains[from].0 - self.grains[to].0))
    }

    /// Height above which there is a weight.
    fn height(&self, weight: f64) -> f64 {
        let mut above = 0.0;
        for (height, mass) in &self.grains {
            above += mass;
            if above >= weight {
                return *height;
            }
        }
        f64::NEG_INFINITY
    }
}

/// Means over many columns at one depth. The depth is that of the weight above: an uneven surface and loose places do not
/// shift it.
struct Level {
    depth: f64,
    /// Vertical stress, of what the walls do not carry.
    vertical: f64,
    /// Pressure on the walls, and friction there, within 2.5 of that depth.
    pressure: f64,
    friction: f64,
}

fn levels(columns: &[Seen], weight: f64) -> Vec<Level> {
    let share = 1.0 / columns.len() as f64;
    let one = |depth: f64| {
        let mut level = Level { depth, vertical: 0.0, pressure: 0.0, friction: 0.0 };
        for seen in columns {
            let height = seen.height(weight * depth * WIDTH);
            let carried: f64 = seen.walls.iter().filter(|c| c[0] > height).map(|c| c[2]).sum();
            level.vertical += share * (weight * depth - carried / WIDTH);
            for wall in seen.walls.iter().filter(|c| (c[0] - height).abs() < 2.5) {
                level.pressure += share * wall[1] / 10.0;
                level.friction += share * wall[2] / 10.0;
            }
        }
        level
    };
    (2..=12).map(|k| one(5.0 * f64::from(k))).collect()
}

/// The one length of the exponential: the misses add up to nothing.
fn length(levels: &[Level], weight: f64) -> f64 {
    let (mut low, mut high) = (1.0, 1e4);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        let miss: f64 = levels.iter().map(|l| form(weight, l.depth, middle) - l.vertical).sum();
        if miss < 0.0 { low = middle } else { high = middle }
    }
    low
}

fn form(weight: f64, depth: f64, length: f64) -> f64 {
    weight * length * (1.0 - (-depth / length).exp())
}

/// The gates, for columns that are right and for wrong ones.
fn gates(columns: &[Seen], perturbation: f64) -> Vec<Claim> {
    let weight = columns.iter().map(Seen::bulk).sum::<f64>() / columns.len() as f64;
    let levels = levels(columns, weight);
    let length = length(&levels, weight);
    let fitted = WIDTH / (2.0 * WALL_FRICTION * length);
    let source = own("Janssen 1895, K fitted").after();
    let mut claims = vec![Claim::judge("Janssen: K, fitted", fitted, Some(0.3), Some(1.0), source)];
    for level in &levels {
        let closed = form(weight, level.depth, length * perturbation.powi(2));
        let name = format!("Janssen: vertical stress over that of the exponential, at depth {}", level.depth);
        claims.push(near(name, level.vertical / closed, 1.0, 0.05, source));
    }
    let sum = |of: fn(&Level) -> f64| levels.iter().map(of).sum::<f64>();
    let source = own("Janssen's assumption: friction at the walls is at its limit").after();
    let limit = sum(|l| l.friction) / (WALL_FRICTION * sum(|l| l.pressure));
    claims.push(Claim::judge("Janssen: friction at the walls over its limit", limit, Some(0.9), None, source));
    let measured = sum(|l| l.pressure) / sum(|l| l.vertical);
    let source = own("Janssen's assumption: one K, of the pressure and of the exponential").after();
    claims.push(near("Janssen: K measured at the walls over K fitted", measured / fitted, 1.0, 0.1, source));
    let source = closed_form("the exponential knows K and friction by their product alone").after();
    let name = "Janssen: friction over its limit, times K measured over K fitted";
    claims.push(near(name, limit * measured / fitted, 1.0, 0.05, source));
    claims
}

/// Columns seen at rest, and while the floor sinks, once friction has turned upward.
fn columns(friction: f64, seed: u64) -> Result<[Vec<Seen>; 2], String> {
    let mut rig = column(friction, seed)?;
    let masses = scalars(&rig.frame(), Kind::Grain, "mass");
    let rest = sampled(&mut rig, [RESTS - 2.0, RESTS, 1.0], |rig| Seen::of(rig, &masses))?;
    let [begin, end] = SUNK.map(|sunk| RESTS + sunk / SINKS);
    let sinking = sampled(&mut rig, [begin, end, 1.0], |rig| Seen::of(rig, &masses))?;
    Ok([rest, sinking])
}

/// V-32: vertical stress follows Janssen's exponential, with one fitted length.
pub(super) fn janssen(perturbation: f64) -> Judged {
    let mut claims = ensemble::drawn("silos", DRAWS, |draw| {
        let (mut rest, mut sinking) = (Vec::new(), Vec::new());
        for silo in 1..=SILOS {
            let [still, moved] = columns(WALL_FRICTION, SILOS * (draw - 1) + silo)?;
            rest.extend(still);
            sinking.extend(moved);
        }
        let mut claims = gates(&sinking, perturbation);
        claims.push(refused("Janssen, a floor that has not sunk yet", &gates(&rest, 1.0), 3));
        Ok(claims)
    })?;
    let [_, smooth] = columns(0.0, 1)?;
    claims.push(refused("Janssen, walls without friction", &gates(&smooth, 1.0), 3));
    Ok(claims)
}
