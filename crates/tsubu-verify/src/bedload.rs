//! Transport by a stream that the grains slow (V-57).

use super::bench::Rig;
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::state::sphere;
use tsubu::view::Wants;
use tsubu::water::{FORMULAS, Stream};
use tsubu_frame::Claim;

/// Diameter of the grains [m], and density over that of water.
const D: f64 = 3e-3;
const S: f64 = 2.65;
/// World along and across the stream, in diameters, and layers of grains in the bed.
const LONG: f64 = 24.0;
const WIDE: f64 = 6.0;
const DEEP: f64 = 5.0;
/// When looks begin and end [s]. Grains that fall to the bed take its speed from the stream, and the slope gives it back within some
/// U/(g sin(slope)), 2 to 3 s: before, the bed feels less than the weight of the water.
const STEADY: [f64; 2] = [10.0, 16.0];
const EARLY: [f64; 2] = [1.0, 2.0];
/// Strength of turbulence over U* at a rough bed: 2.30, 1.63 and 1.27 along, across and up (Nezu and Nakagawa 1993).
const STRENGTH: f64 = 1.78;
const UPWARDS: f64 = 1.27;

/// How the water moves.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// In layers, by its mean velocity alone.
    Mean,
    /// In layers, with fluctuations as over a rough bed, for the time that the depth of water tells.
    Turbulent,
    /// By the log law, whatever the grains do.
    Unslowed,
}

/// What a stream comes to.
#[derive(Clone, Copy)]
struct Load {
    /// Stress on the bed over (s-1) rho g d.
    shields: f64,
    /// The same over the weight of the water along the slope.
    balance: f64,
    /// Rate over sqrt((s-1) g d^3).
    rate: f64,
}

/// What a stream of a slope [rad] and a depth of water over its bed, in diameters, comes to in a time.
fn transport(
    [slope, water]: [f64; 2],
    stream: Kind,
    [from, until]: [f64; 2],
    seed: u64,
    perturbation: f64,
) -> Result<Load, String> {
    let height = (DEEP + water) * D;
    let coupled = format!("flow.coupled = {{ bottom = 0, top = {height} }}\nhindrance.richardson-zaki = {{}}");
    let flow = match stream {
        Kind::Mean => coupled,
        Kind::Turbulent => {
            let time = 2.0 * water * D / (15.0 * UPWARDS.powi(2) * (9.8 * slope.sin() * water * D).sqrt());
            format!("{coupled}\nfluctuation = {{ strength = {STRENGTH}, directions = \"stream\", time = {time} }}")
        }
        // The log law over a bed that is not there would press on all grains alike.
        Kind::Unslowed => format!("flow.log-law = {{ depth = {height} }}"),
    };
    let text = format!(
        r#"
        dimension = 3
        seed = {seed}
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
    let mut rig = Rig::new(&text, perturbation)?;
    let area = LONG * WIDE * D * D;
    rig.until(from)?;
    let (mut rate, mut stress, mut weight, mut looks, mut time) = (0.0, 0.0, 0.0, 0.0, from);
    while time < until {
        time += 0.02;
        rig.until(time)?;
        let view = rig.engine.view(Wants::GRAINS);
        let free = (0..view.len()).filter(|&i| view.free(i));
        rate += free.map(|i| sphere::volume(view.grains.radius[i]) * view.grains.velocity[i].x).sum::<f64>() / area;
        looks += 1.0;
        if let Some(Stream::Coupled(stream)) = view.water.map(|water| &water.stream) {
            stress += stream.bed_stress();
            weight += 1000.0 * 9.8 * slope.sin() * stream.over_bed();
        } else {
            stress += 1000.0 * 9.8 * slope.sin() * water * D;
            weight = stress;
        }
    }
    Ok(Load {
        shields: stress / looks / ((S - 1.0) * 1000.0 * 9.8 * D),
        balance: stress / weight,
        rate: rate / looks / ((S - 1.0) * 9.8 * D.powi(3)).sqrt(),
    })
}

/// What is claimed of a stream: its rate is within a factor of 2 of each formula by itself, and it is steady. By the mean of five beds.
fn gates(name: &str, stream: [f64; 2], kind: Kind, span: [f64; 2], perturbation: f64) -> Judged {
    let [slope, water] = stream;
    let name = format!("bedload, {name}, slope {slope}, {water} d of water");
    let [balance, rates @ ..] = ensemble::members(&format!("{name}, from {} s", span[0]), 1..=5, |seed| {
        let load = transport(stream, kind, span, seed, perturbation)?;
        Ok([load.balance, load.rate / FORMULAS[0].rate(load.shields), load.rate / FORMULAS[1].rate(load.shields)])
    })?;
    let source = own("a factor of 2, as measured rates scatter about either formula").after();
    let steady = closed_form("momentum of a steady stream: what drives it arrives at the bed");
    let text = format!("{name}: stress at the bed over weight of the water along the slope");
    let mut claims = vec![Claim::judge_ensemble(text, balance, Some(0.95), Some(1.05), steady)];
    for (formula, rate) in FORMULAS.map(|formula| formula.source).into_iter().zip(rates) {
        let text = format!("{name}: rate over that of {formula}");
        claims.push(Claim::judge_ensemble(text, rate, Some(0.5), Some(2.0), source));
    }
    Ok(claims)
}

/// V-57: rates of steady streams beside published ones.
pub(super) fn rates(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (kind, name) in [(Kind::Mean, "mean stream"), (Kind::Turbulent, "turbulent stream")] {
        for stream in [[0.025, 8.0], [0.06, 8.0], [0.06, 15.0]] {
            claims.extend(gates(name, stream, kind, STEADY, perturbation)?);
        }
    }
    let early = gates("not steady yet", [0.025, 8.0], Kind::Turbulent, EARLY, perturbation)?;
    claims.push(refused("a stream that is not steady yet", &early[..1], 1));
    let wrong = gates("not slowed", [0.06, 8.0], Kind::Unslowed, STEADY, perturbation)?;
    claims.push(refused("a stream that grains do not slow, down to the bottom of the bed", &wrong, 2));
    Ok(claims)
}
