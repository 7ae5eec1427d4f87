//! Beds of a few hundred grains in units of grain diameter, grain mass and gravity: what the long cases share.

use super::bench::Rig;
use glam::DVec3;

/// Materials and contact law of the chute of Silbert et al. 2001, with softer springs, in m g/d, than the 2e5 there.
pub(super) fn law(stiffness: f64, friction: f64, restitution: f64) -> String {
    format!(
        r"
        speed-scale = 1
        [materials.grain]
        young-modulus = 1e6
        restitution = {restitution}
        friction = {friction}
        [contact]
        normal.hooke.stiffness = {stiffness:e}
        damping.linear = {{}}
        tangential.spring.damping = 1
        [dem]
        largest-overlap = 0.3
        "
    )
}

/// Adds up samples taken every `pause` until `end`.
pub(super) fn sampled<T>(
    rig: &mut Rig,
    [begin, end, pause]: [f64; 3],
    mut take: impl FnMut(&Rig) -> T,
) -> Result<Vec<T>, String> {
    rig.until(begin)?;
    let mut samples = Vec::new();
    while rig.engine.time() < end {
        rig.until(rig.engine.time() + pause)?;
        samples.push(take(rig));
    }
    Ok(samples)
}

/// Centres of the grains from the number `first` on.
pub(super) fn centres(rig: &Rig, first: usize) -> Vec<DVec3> {
    rig.vectors("position").split_off(first)
}

/// Slope and intercept of the straight line through points.
pub(super) fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let (sx, sy) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let (mx, my) = (sx / n, sy / n);
    let (xy, xx) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + (p.0 - mx) * (p.1 - my), s.1 + (p.0 - mx).powi(2)));
    (xy / xx, my - mx * xy / xx)
}

/// Mean of independent values, and its standard error.
pub(super) fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}
