//! Segregation under vertical shaking (V-38).

use super::beds::law;
use super::bench::{Rig, within};
use tsubu_frame::Claim;

/// A periodic bed on a shaken floor, one grain of its own size at the bottom.
fn bed(size: f64, seed: u32) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "one large grain in a shaken bed"
        seed = {seed}
        gravity = 1
        duration = 2000
        periodic.x = [0, 16]
        {law}
        [particles.a-single]
        material = "grain"
        diameter = {size}
        mass = {mass}
        start.at.position = [[8, {height}]]
        [particles.b-bed]
        material = "grain"
        count = 220
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        start.random.region = {{ low = [0, {above}], high = [16, 40] }}
        [walls.floor]
        material = "grain"
        shape.plane = {{}}
        motion = {{ direction = [0, 1], signal.sine = {{ amplitude = 0.5, frequency = 0.3898 }} }}
        "#,
        mass = size * size * size,
        height = 0.5 * size + 0.01,
        above = size + 0.02,
        law = law(0.3, 0.5),
    );
    Rig::new(&text, 1.0)
}

/// Height of the single grain's centre over that of the mean of the bed, in the mean over the last 40 of 200 shakes.
fn rises(size: f64, seed: u32) -> Result<f64, String> {
    let mut rig = bed(size, seed)?;
    let period = 1.0 / 0.3898;
    let samples = super::beds::sampled(&mut rig, [160.0 * period, 200.0 * period, period], |rig| {
        let z = super::beds::centres(rig, 0);
        let bed = z[1..].iter().map(|p| p.z).sum::<f64>() / (z.len() - 1) as f64;
        z[0].z / bed
    })?;
    Ok(samples.iter().sum::<f64>() / samples.len() as f64)
}

/// V-38: a grain of four diameters comes to the top at 3 g; one of the size of the others does not on average.
pub(super) fn brazil_nut(spoiler: f64) -> Result<Vec<Claim>, String> {
    let source = "Rosato et al. 1987 and many since: large grains rise; equal ones have no reason to (V-38)";
    // The wrong variant takes the control's size for the large one.
    let size = if spoiler == 1.0 { 4.0 } else { 1.0 };
    let mut claims = Vec::new();
    for seed in 1..=3 {
        let name = format!("shaken bed, seed {seed}: height of a grain of 4 diameters over the bed's mean");
        claims.push(Claim::judge(name, rises(size, seed)?, Some(1.4), None, source));
    }
    let control = (1..=6).map(|seed| rises(1.0, seed)).sum::<Result<f64, String>>()? / 6.0;
    let name = "shaken bed, six seeds: mean height of a grain of 1 diameter over the bed's mean";
    claims.push(within(name, control, 1.0, 0.4, source));
    Ok(claims)
}
