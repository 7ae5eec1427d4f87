//! Silos in the plane: pressure (V-32) and discharge (V-31).

use super::beds::{centres, law, line, sampled};
use super::bench::{Rig, near, vectors, within};
use std::fmt::Write;
use tsubu_frame::{Claim, Kind, Values};

const WIDTH: f64 = 12.0;
const WALL_FRICTION: f64 = 0.5;

/// A column between two walls on a floor that sinks slowly, so that friction acts at its limit everywhere.
fn column(spoiler: f64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "a silo whose floor sinks"
        gravity = 1
        duration = 1000
        {law}
        [particles.grains]
        material = "grain"
        count = 840
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        start.rows = {{ spacing = 1.02, jitter = 0.5, region = {{ low = [0, 0], high = [{WIDTH}, 120] }} }}
        [walls.a-left]
        material = "grain"
        shape.plane.normal = [1, 0]
        [walls.b-right]
        material = "grain"
        shape.plane = {{ point = [{WIDTH}, 0], normal = [-1, 0] }}
        [walls.c-floor]
        material = "grain"
        shape.plane = {{}}
        motion = {{ direction = [0, 1], signal.steady.rate = -0.02 }}
        "#,
        law = law(WALL_FRICTION, 0.5),
    );
    Rig::new(&text, spoiler)
}

/// What is seen of the column at one time: height and mass of every grain; height, horizontal and vertical force of every
/// contact with a side wall.
type Seen = (Vec<(f64, f64)>, Vec<[f64; 3]>);

/// Depth below the surface, mean vertical stress there, and mean horizontal stress on the walls there.
type Level = [f64; 3];

fn stresses(samples: &[Seen], depths: &[f64]) -> Vec<Level> {
    let mut levels: Vec<Level> = depths.iter().map(|d| [*d, 0.0, 0.0]).collect();
    for (grains, contacts) in samples {
        let top = grains.iter().map(|g| g.0).fold(f64::MIN, f64::max);
        for level in &mut levels {
            let height = top - level[0];
            let weight: f64 = grains.iter().filter(|g| g.0 > height).map(|g| g.1).sum();
            let held: f64 = contacts.iter().filter(|c| c[0] > height).map(|c| c[2]).sum();
            let pressed: f64 = contacts.iter().filter(|c| (c[0] - height).abs() < 2.0).map(|c| c[1]).sum();
            level[1] += (weight - held) / WIDTH / samples.len() as f64;
            level[2] += pressed / 8.0 / samples.len() as f64;
        }
    }
    levels
}

/// Weight a unit of area, between 10 and 60 below the surface.
fn bulk(samples: &[Seen]) -> f64 {
    let one = |(grains, _): &Seen| {
        let top = grains.iter().map(|g| g.0).fold(f64::MIN, f64::max);
        let within = grains.iter().filter(|g| g.0 < top - 10.0 && g.0 > top - 60.0);
        within.map(|g| g.1).sum::<f64>() / (50.0 * WIDTH)
    };
    samples.iter().map(one).sum::<f64>() / samples.len() as f64
}

/// V-32: vertical stress follows Janssen's exponential, with one fitted length.
pub(super) fn janssen(spoiler: f64) -> Result<Vec<Claim>, String> {
    let mut rig = column(1.0)?;
    let masses = super::bench::scalars(&rig.frame(), Kind::Grain, "mass");
    let samples = sampled(&mut rig, [150.0, 300.0, 1.0], |rig| {
        let frame = rig.frame();
        let grains = centres(rig, 0).iter().zip(&masses).map(|(p, m)| (p.z, *m)).collect::<Vec<_>>();
        let (places, forces) = (vectors(&frame, Kind::Contact, "position"), vectors(&frame, Kind::Contact, "force"));
        let seconds = match frame.column(Kind::Contact, "second").map(|c| &c.values) {
            Some(Values::Integer(v)) => v.clone(),
            _ => Vec::new(),
        };
        let walls = seconds.iter().zip(places.iter().zip(&forces)).filter(|(s, _)| **s == -1 || **s == -2);
        (grains, walls.map(|(_, (p, f))| [p.z, f.x.abs(), f.z]).collect::<Vec<_>>())
    })?;
    let depths: Vec<f64> = (1..=12).map(|k| 5.0 * f64::from(k)).collect();
    let levels = stresses(&samples, &depths);
    let weight = bulk(&samples);
    // The one length of the exponential: least squares, by halving.
    let form = |depth: f64, length: f64| weight * length * (1.0 - (-depth / length).exp());
    let (mut low, mut high) = (1.0, 1e3);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        let miss: f64 = levels.iter().map(|l| form(l[0], middle) - l[1]).sum();
        if miss < 0.0 { low = middle } else { high = middle }
    }
    let fitted = WIDTH / (2.0 * WALL_FRICTION * low);
    let source = "Janssen 1895, K fitted (V-32)";
    let mut claims = vec![Claim::judge("Janssen: K, with friction at its limit", fitted, Some(0.3), Some(1.0), source)];
    for level in levels.iter().skip(1) {
        let closed = form(level[0], low * spoiler.powi(2));
        claims.push(near(format!("Janssen: vertical stress at depth {}", level[0]), level[1], closed, 0.05, source));
    }
    let measured = levels[4..].iter().map(|l| l[2] / l[1]).sum::<f64>() / (levels.len() - 4) as f64;
    let source = "not less than what is fitted: friction acts at its limit at most";
    claims.push(Claim::judge("Janssen: K measured at the walls", measured, Some(fitted), None, source));
    Ok(claims)
}

/// A flat-bottomed silo, 40 wide, whose slot opens between frozen grains; grains below it vanish.
fn outlet(slot: f64, spoiler: f64) -> Result<Rig, String> {
    let mut floor = String::new();
    for i in 0..(20.0 - 0.5 * slot) as u32 {
        let x = 0.5 * slot + 0.5 + f64::from(i);
        let _ = write!(floor, "[{x}, 0], [-{x}, 0],");
    }
    let text = format!(
        r#"
        title = "a silo that empties through a slot"
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
        count = 2400
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        start.rows = {{ spacing = 1.01, jitter = 0.5, region = {{ low = [-20, 0.6], high = [20, 90] }} }}
        [walls.left]
        material = "grain"
        shape.plane = {{ point = [-20, 0], normal = [1, 0] }}
        [walls.right]
        material = "grain"
        shape.plane = {{ point = [20, 0], normal = [-1, 0] }}
        [removal.below]
        behind = {{ point = [0, -5], normal = [0, 1] }}
        "#,
        law = law(0.5, 0.5),
    );
    Rig::new(&text, spoiler)
}

/// Grains a unit of time in the first and the second 400 grains, from the 200th on.
fn rates(slot: f64, spoiler: f64) -> Result<[f64; 2], String> {
    let mut rig = outlet(slot, spoiler)?;
    let all = rig.engine.grains();
    let mut times = Vec::new();
    for gone in [200, 600, 1000] {
        while all - rig.engine.grains() < gone && rig.engine.time() < 400.0 {
            rig.steps(20)?;
        }
        times.push((rig.engine.time(), (all - rig.engine.grains()) as f64));
    }
    let rate = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
    Ok([rate(times[0], times[1]), rate(times[1], times[2])])
}

/// V-31, in the plane: rate^(2/3) is straight in the width of the slot, zero at k d, and does not know the height.
pub(super) fn beverloo(spoiler: f64) -> Result<Vec<Claim>, String> {
    let source = "Beverloo 1961 in the plane, exponent 3/2 (V-31)";
    let (mut points, mut logs, mut claims) = (Vec::new(), Vec::new(), Vec::new());
    for slot in [6.0, 8.0, 10.0, 12.0] {
        let [first, second] = rates(slot, 1.0)?;
        claims.push(within(format!("slot of {slot} d: rate later over rate before"), second / first, 1.0, 0.1, source));
        points.push((slot * spoiler, (0.5 * (first + second)).powf(2.0 / 3.0)));
        logs.push((slot, 0.5 * (first + second)));
    }
    let (slope, offset) = line(&points);
    let k = -offset / slope;
    claims.push(Claim::judge(
        "slot: width k at which the flow would end, in diameters",
        k,
        Some(1.0),
        Some(2.0),
        source,
    ));
    let exponent = line(&logs.iter().map(|(d, w)| ((d - 1.4).ln(), w.ln())).collect::<Vec<_>>()).0;
    claims.push(within("slot: exponent of (D - 1.4 d)", exponent, 1.5, 0.1, source));
    Ok(claims)
}
