//! Transport by a stream that the grains slow (V-57).

use super::bench::{Rig, refused};
use crate::state::sphere;
use crate::view::Wants;
use crate::water::Stream;
use tsubu_frame::Claim;

/// Diameter of the grains [m], and density over that of water.
const D: f64 = 3e-3;
const S: f64 = 2.65;
/// World along and across the stream, in diameters, and layers of grains in the bed.
const LONG: f64 = 24.0;
const WIDE: f64 = 6.0;
const DEEP: f64 = 5.0;
/// Looks begin and end [s].
const FROM: f64 = 1.5;
const UNTIL: f64 = 5.0;

/// How the water moves.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// In layers, by its mean velocity alone.
    Mean,
    /// In layers, with fluctuations of the strength 1 over the time of the depth of water.
    Turbulent,
    /// By the log law, whatever the grains do.
    Unslowed,
}

/// What a stream of a slope [rad] and a depth of water over its bed, in diameters, comes to: Shields number at the bed and the rate over sqrt((s-1) g d^3), both measured.
fn transport([slope, water]: [f64; 2], stream: Kind, spoiler: f64) -> Result<[f64; 2], String> {
    let height = (DEEP + water) * D;
    let coupled = format!("flow.coupled = {{ bottom = 0, top = {height} }}\nhindrance.richardson-zaki = {{}}");
    let flow = match stream {
        Kind::Mean => coupled,
        Kind::Turbulent => {
            let time = water * D / (15.0 * (9.8 * slope.sin() * water * D).sqrt());
            format!("{coupled}\nfluctuation.time = {time}")
        }
        // The log law over a bed that is not there would press on all grains alike.
        Kind::Unslowed => format!("flow.log-law = {{ depth = {height} }}"),
    };
    let text = format!(
        r#"
        dimension = 3
        slope = {slope}
        duration = 60
        speed-scale = "0.5 m/s"
        [materials.sand]
        young-modulus = "3 MPa"
        density = "2650 kg/m^3"
        restitution = 0.5
        friction = 0.4
        [particles.base]
        material = "sand"
        count = {base}
        diameter = {D}
        motion.frozen = {{}}
        start.rows = {{ spacing = 1, jitter = 0, region = {{ low = [0, 0, 0], high = [{length}, {width}, {D}] }} }}
        [particles.sand]
        material = "sand"
        count = {count}
        size.uniform = {{ smallest = {small}, largest = {large} }}
        start.rows = {{ spacing = 1.01, jitter = 1, region = {{ low = [0, 0, {D}], high = [{length}, {width}, {high}] }} }}
        [periodic]
        x = [0, {length}]
        y = [0, {width}]
        [water]
        drag.stokes-newton = {{}}
        {flow}
        [contact]
        tangential.mindlin = {{}}
        "#,
        base = LONG * WIDE,
        count = LONG * WIDE * DEEP,
        length = LONG * D,
        width = WIDE * D,
        small = 0.9 * D,
        large = 1.1 * D,
        high = height + 20.0 * D,
    );
    let mut rig = Rig::new(&text, spoiler)?;
    let area = LONG * WIDE * D * D;
    rig.until(FROM)?;
    let (mut rate, mut looks, mut time) = (0.0, 0.0, FROM);
    while time < UNTIL {
        time += 0.02;
        rig.until(time)?;
        let view = rig.engine.view(Wants::GRAINS);
        let free = (0..view.len()).filter(|&i| view.free(i));
        rate += free.map(|i| sphere::volume(view.grains.radius[i]) * view.grains.velocity[i].x).sum::<f64>() / area;
        looks += 1.0;
    }
    // The stress at the top of the bed is the weight of the water above it along the slope.
    let view = rig.engine.view(Wants::GRAINS);
    let top = match view.water.map(|water| &water.stream) {
        Some(Stream::Coupled(stream)) => {
            let bed = stream.layers.open.iter().rposition(|open| *open < 0.7).unwrap_or(0);
            stream.layers.bottom + (bed as f64 + 1.0) * stream.layers.thickness
        }
        _ => DEEP * D,
    };
    let shields = (height - top) * slope.sin() / ((S - 1.0) * D);
    Ok([shields, rate / looks / ((S - 1.0) * 9.8 * D.powi(3)).sqrt()])
}

/// V-57: rates within a factor of 2 of published ones.
pub(super) fn rates(spoiler: f64) -> Result<Vec<Claim>, String> {
    let published = |t: f64| (8.0 * (t - 0.047).powf(1.5), 3.97 * (t - 0.0495).powf(1.5));
    let source = "between half of Wong and Parker 2006 and twice Meyer-Peter and Mueller 1948 (V-57)";
    let gate = |[shields, rate]: [f64; 2], what: &str| {
        let (high, low) = published(shields);
        let name = format!("{what}, Shields number {shields:.3}: rate over sqrt((s-1) g d^3)");
        Claim::judge(name, rate, Some(0.5 * low), Some(2.0 * high), source)
    };
    let mut claims = Vec::new();
    for (kind, name) in [(Kind::Mean, "bedload, mean stream"), (Kind::Turbulent, "bedload, turbulent stream")] {
        for stream in [[0.025, 8.0], [0.06, 8.0], [0.06, 15.0]] {
            let found = transport(stream, kind, spoiler)?;
            claims.push(gate(found, name));
        }
    }
    let wrong = transport([0.06, 8.0], Kind::Unslowed, spoiler)?;
    claims.push(refused("a stream that grains do not slow, down to the bottom of the bed", &[gate(wrong, "")], 1));
    Ok(claims)
}
