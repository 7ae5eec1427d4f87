//! Flow down a rough slope (V-35, V-36).

use super::beds::{centres, law, sampled};
use super::bench::{Rig, within};
use std::fmt::Write;
use tsubu_frame::Claim;

/// Length and width of the periodic world, in diameters.
const LENGTH: [f64; 2] = [8.0, 5.0];
const LAYERS: f64 = 12.0;

/// A layer of grains on a base of frozen ones.
fn slope(degrees: f64, spoiler: f64) -> Result<Rig, String> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut base = String::new();
    for i in 0..8 {
        for j in 0..5 {
            // Rough: heights spread over half a diameter.
            let height = f64::from((i * 7 + j * 3 + i * j) % 5) / 10.0;
            let _ = write!(base, "[{}, {}, {height}],", f64::from(i) + 0.5, f64::from(j) + 0.5);
        }
    }
    let count = LENGTH[0] * LENGTH[1] * LAYERS;
    let text = format!(
        r#"
        title = "a layer of grains on a rough slope"
        dimension = 3
        gravity = [{sin}, 0, {down}]
        duration = 1000
        periodic.x = [0, 8]
        periodic.y = [0, 5]
        {law}
        [particles.a-base]
        material = "grain"
        diameter = 1
        mass = 1
        motion.frozen = {{}}
        start.at.position = [{base}]
        [particles.b-layer]
        material = "grain"
        count = {count}
        diameter = 1
        mass = 1
        start.rows = {{ spacing = 1.05, jitter = 0.5, speed = 0.5, region = {{ low = [0, 0, 1.5], high = [8, 5, 30] }} }}
        "#,
        down = -cos,
        law = law(0.5, 0.88),
    );
    Rig::new(&text, spoiler)
}

/// What a layer does in the long run.
struct Flow {
    /// Mean speed down the slope.
    speed: f64,
    /// The same in the first half of the time it was looked at.
    early: f64,
    /// Speed at the surface.
    surface: f64,
    /// Least and largest number of grains a layer, over the mean, within the bulk.
    density: [f64; 2],
}

fn flow(degrees: f64, span: [f64; 2], spoiler: f64) -> Result<Flow, String> {
    let mut rig = slope(degrees, spoiler)?;
    let base = 40;
    let samples = sampled(&mut rig, [span[0], span[1], 0.5], |rig| {
        (centres(rig, base), rig.vectors("velocity").split_off(base))
    })?;
    let count = samples.first().map_or(1, |s| s.0.len()) as f64;
    let mean = |part: &[(Vec<glam::DVec3>, Vec<glam::DVec3>)]| {
        part.iter().flat_map(|s| &s.1).map(|v| v.x).sum::<f64>() / (part.len() as f64 * count)
    };
    let all: Vec<(f64, f64)> = samples.iter().flat_map(|(p, v)| p.iter().zip(v).map(|(p, v)| (p.z, v.x))).collect();
    let mut heights: Vec<f64> = all.iter().map(|x| x.0).collect();
    heights.sort_by(f64::total_cmp);
    let at = |share: f64| heights[((heights.len() - 1) as f64 * share) as usize];
    let (low, high) = (at(0.2), at(0.8));
    let mut layers = [0.0; 4];
    for z in heights.iter().filter(|z| **z >= low && **z < high) {
        layers[(((z - low) / (high - low) * 4.0) as usize).min(3)] += 4.0;
    }
    let bulk = layers.iter().sum::<f64>() / 4.0;
    let top: Vec<f64> = all.iter().filter(|x| x.0 > at(0.93)).map(|x| x.1).collect();
    Ok(Flow {
        speed: mean(&samples),
        early: mean(&samples[..samples.len() / 2]),
        surface: top.iter().sum::<f64>() / top.len() as f64,
        density: layers.map(|n| n / bulk).into_iter().fold([f64::MAX, 0.0], |r, n| [r[0].min(n), r[1].max(n)]),
    })
}

/// V-36: at rest below, steady flow of constant density with Bagnold's profile above the angle of repose.
pub(super) fn silbert(spoiler: f64) -> Result<Vec<Claim>, String> {
    let source = "Silbert et al. 2001: flow from 19.5 to 26 degrees (V-36)";
    let still = flow(17.0, [150.0, 170.0], spoiler)?;
    let mut claims = vec![within("chute at 17 degrees: speed", still.speed, 0.0, 1e-3, source)];
    let mut speeds = Vec::new();
    for degrees in [22.0, 25.0] {
        let flow = flow(degrees, [250.0, 400.0], spoiler)?;
        let name = |what: &str| format!("chute at {degrees} degrees: {what}");
        claims.push(Claim::judge(name("speed over sqrt(g d)"), flow.speed, Some(0.5), None, source));
        claims.push(within(
            name("speed in the first half of the time over that of all"),
            flow.early / flow.speed,
            1.0,
            0.1,
            source,
        ));
        let profile = "Bagnold's profile: mean over surface speed is 3/5; 1/2 for linear, 1 for a plug (V-35)";
        claims.push(within(name("mean speed over surface speed"), flow.speed / flow.surface, 0.6, 0.06, profile));
        let bulk = "constant density with depth (V-36)";
        claims.push(Claim::judge(name("least density of a layer"), flow.density[0], Some(0.95), None, bulk));
        claims.push(Claim::judge(name("largest density of a layer"), flow.density[1], None, Some(1.05), bulk));
        speeds.push(flow.speed);
    }
    let name = "chute: speed at 25 over speed at 22 degrees";
    claims.push(Claim::judge(name, speeds[1] / speeds[0], Some(1.2), None, source));
    Ok(claims)
}
