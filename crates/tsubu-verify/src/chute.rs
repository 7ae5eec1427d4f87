//! Flow down a rough slope (V-35, V-36).

use super::beds::{centres, law, sampled};
use super::bench::{Rig, within};
use super::control::refused;
use crate::origin::{closed_form, own};
use glam::DVec3;
use std::fmt::Write;
use tsubu_frame::Claim;

/// Length and width of the periodic world, in diameters.
const LENGTH: f64 = 8.0;
const WIDE: f64 = 6.0;
/// Not looked at next to the base and to the surface.
const EDGE: f64 = 3.0;
/// Heights above its floor between which a bed at rest is cut to make the base: 1.2 diameters thick, as in Silbert et al.
const CUT: [f64; 2] = [2.5, 3.7];

/// Places of the frozen grains: cut out of a bed at rest, so dense that no grain gets in between. The highest are below 0.
fn base(perturbation: f64) -> Result<Vec<DVec3>, String> {
    let text = format!(
        r#"
        title = "the bed that a base is cut from"
        dimension = 3
        gravity = 1
        duration = 100
        periodic.x = [0, {LENGTH}]
        periodic.y = [0, {WIDE}]
        {law}
        [particles.bed]
        material = "grain"
        count = {count}
        diameter = 1
        mass = 1
        start.random.region = {{ low = [0, 0, 0], high = [{LENGTH}, {WIDE}, 20] }}
        [walls.bottom]
        material = "grain"
        shape.plane.point = [0, 0, 0]
        "#,
        law = law(5e3, 0.5, 0.88),
        count = (7.0 * LENGTH * WIDE) as u32,
    );
    let mut rig = Rig::new(&text, perturbation)?;
    rig.until(40.0)?;
    let inside = |p: &DVec3| (CUT[0]..CUT[1]).contains(&p.z);
    let around = |p: DVec3| DVec3::new(p.x.rem_euclid(LENGTH), p.y.rem_euclid(WIDE), p.z - CUT[1]);
    Ok(rig.vectors("position").into_iter().filter(inside).map(around).collect())
}

/// A layer of grains on a slope.
#[derive(Clone, Copy)]
struct Slope<'a> {
    degrees: f64,
    /// Grains above a unit of area.
    layers: f64,
    friction: f64,
    /// On frozen grains at these places, or on a plane where there are none.
    base: &'a [DVec3],
    /// Speed of the surface at the beginning; deeper grains begin more slowly.
    start: f64,
}

impl Slope<'_> {
    fn rig(&self, perturbation: f64) -> Result<Rig, String> {
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let mut groups = String::new();
        if !self.base.is_empty() {
            let places: Vec<String> = self.base.iter().map(|p| format!("[{}, {}, {}]", p.x, p.y, p.z)).collect();
            let _ = write!(
                groups,
                r#"
                [particles.a-base]
                material = "grain"
                diameter = 1
                mass = 1
                motion.frozen = {{}}
                start.at.position = [{}]
                "#,
                places.join(", "),
            );
        }
        // Four sheets, so that the layer begins with about the profile that it will have.
        let (sheets, high) = (4, self.layers * 2.2 / 4.0);
        for sheet in 0..sheets {
            // Above the highest of the frozen grains.
            let (low, middle) = (0.5 + f64::from(sheet) * high, (f64::from(sheet) + 0.5) / f64::from(sheets));
            let _ = write!(
                groups,
                r#"
                [particles.b-sheet-{sheet}]
                material = "grain"
                count = {count}
                diameter = 1
                mass = 1
                start.random = {{ velocity = [{along}, 0, 0], speed = 0.5, region = {{ low = [0, 0, {low}], high = [{LENGTH}, {WIDE}, {top}] }} }}
                "#,
                count = (LENGTH * WIDE * self.layers / f64::from(sheets)) as u32,
                along = self.start * (1.0 - (1.0 - middle).powf(1.5)),
                top = low + high,
            );
        }
        let text = format!(
            r#"
            title = "a layer of grains on a rough slope"
            dimension = 3
            gravity = [{sin}, 0, {down}]
            duration = 1000
            periodic.x = [0, {LENGTH}]
            periodic.y = [0, {WIDE}]
            {law}
            {groups}
            [walls.bottom]
            material = "grain"
            shape.plane.point = [0, 0, {bottom}]
            "#,
            down = -cos,
            bottom = if self.base.is_empty() { 0 } else { -2 },
            law = law(5e3, self.friction, 0.88),
        );
        Rig::new(&text, perturbation)
    }

    /// What it does in the span of time.
    fn flow(&self, span: [f64; 2], perturbation: f64) -> Result<Flow, String> {
        let mut rig = self.rig(perturbation)?;
        let base = self.base.len();
        let samples = sampled(&mut rig, [span[0], span[1], 0.5], |rig| {
            let speeds = rig.vectors("velocity").split_off(base);
            centres(rig, base).iter().zip(speeds).map(|(p, v)| [p.z, v.x]).collect::<Vec<_>>()
        })?;
        Ok(Flow { degrees: self.degrees, layers: self.layers, samples })
    }
}

/// Mean of what is true of a grain at one time.
fn mean(samples: &[Vec<[f64; 2]>], of: impl Fn(&[f64; 2]) -> f64) -> f64 {
    let count: usize = samples.iter().map(Vec::len).sum();
    samples.iter().flatten().map(of).sum::<f64>() / count as f64
}

/// Height and speed down the slope of every grain, at many times.
struct Flow {
    degrees: f64,
    layers: f64,
    samples: Vec<Vec<[f64; 2]>>,
}

impl Flow {
    fn all(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.samples.iter().flatten()
    }

    fn speed(&self) -> f64 {
        mean(&self.samples, |g| g[1])
    }

    /// Mean speed in the first half of the time.
    fn early(&self) -> f64 {
        mean(&self.samples[..self.samples.len() / 2], |g| g[1])
    }

    /// Height of the layer if all of it were as dense as its bulk: wherever the base begins.
    fn thickness(&self) -> f64 {
        let (low, high) = (EDGE, self.height() - EDGE);
        let bulk = self.between(low, high).0 / self.samples.len() as f64 / (high - low);
        self.layers * LENGTH * WIDE / bulk
    }

    /// Height of a layer of even density with the same centre of mass.
    fn height(&self) -> f64 {
        2.0 * mean(&self.samples, |g| g[0])
    }

    /// Number of grains and mean speed between two heights.
    fn between(&self, low: f64, high: f64) -> (f64, f64) {
        let (count, sum) = self
            .all()
            .filter(|g| g[0] >= low && g[0] < high)
            .fold((0.0, 0.0), |(count, sum), g| (count + 1.0, sum + g[1]));
        (count, sum / count)
    }

    /// Least and largest density of slabs one diameter thick, over their mean, away from base and surface.
    fn density(&self) -> [f64; 2] {
        let slabs = (self.height() - 2.0 * EDGE) as usize;
        let counts: Vec<f64> = (0..slabs).map(|k| self.between(EDGE + k as f64, EDGE + k as f64 + 1.0).0).collect();
        let mean = counts.iter().sum::<f64>() / slabs as f64;
        counts.into_iter().map(|n| n / mean).fold([f64::MAX, 0.0], |r, n| [r[0].min(n), r[1].max(n)])
    }

    /// Inertial number, shear rate times diameter over the root of pressure over density, in the upper half of the bulk over that
    /// in the lower. The pressure is the weight above.
    fn inertial_ratio(&self) -> f64 {
        let (low, high) = (EDGE, self.height() - EDGE);
        let middle = 0.5 * (low + high);
        let [lower, upper] = [[low, middle], [middle, high]].map(|[from, to]| {
            let third = (to - from) / 3.0;
            let rate = (self.between(to - third, to).1 - self.between(from, from + third).1) / (2.0 * third);
            let above = self.between(0.5 * (from + to), f64::MAX).0 / self.samples.len() as f64;
            let pressure = above * self.degrees.to_radians().cos() / (LENGTH * WIDE);
            rate / (pressure * std::f64::consts::PI / 6.0).sqrt()
        });
        upper / lower
    }

    /// The gates, for a flow that is right and for wrong ones.
    fn gates(&self) -> Vec<Claim> {
        let name = |what: &str| format!("chute at {} degrees: {what}", self.degrees);
        let source = own("Silbert et al. 2001: steady flow from 19.5 to 26 degrees").after();
        let top = self.between(self.height() - 1.0, f64::MAX).1;
        let profile = closed_form("Bagnold's profile: mean over surface speed is 3/5; 1/2 for linear, 1 for a plug");
        let bulk = own("constant density with depth, but for the layers next to base and surface").after();
        let [least, largest] = self.density();
        vec![
            Claim::judge(name("speed over sqrt(g d)"), self.speed(), Some(0.5), None, source),
            within(
                name("speed in the first half of the time over that of all"),
                self.early() / self.speed(),
                1.0,
                0.1,
                source,
            ),
            within(name("mean speed over surface speed"), self.speed() / top, 0.6, 0.06, profile),
            Claim::judge(name("least density of a slab"), least, Some(0.95), None, bulk),
            Claim::judge(name("largest density of a slab"), largest, None, Some(1.05), bulk),
            within(
                name("inertial number of the upper half of the bulk over the lower"),
                self.inertial_ratio(),
                1.0,
                0.1,
                own("mu(I): one slope, one inertial number at every depth").after(),
            ),
        ]
    }

    /// The gate for a layer at rest.
    fn rests(&self) -> Claim {
        let source = own("Silbert et al. 2001: flow from 19.5 to 26 degrees").after();
        within(format!("chute at {} degrees: speed", self.degrees), self.speed(), 0.0, 1e-3, source)
    }
}

/// The gate for a steeper flow, and a gentler one.
fn quicker(steep: &Flow, gentle: &Flow) -> Claim {
    let source = own("Silbert et al. 2001: flow from 19.5 to 26 degrees").after();
    let name = format!("chute: speed at {} over speed at {} degrees", steep.degrees, gentle.degrees);
    Claim::judge(name, steep.speed() / gentle.speed(), Some(1.2), None, source)
}

/// The gate for a higher flow, and a lower one.
fn grows(high: &Flow, low: &Flow) -> Claim {
    let source = closed_form("mean speed grows with height to the power 3/2; 1 for a plug, 2 for a viscous liquid");
    let exponent = (high.speed() / low.speed()).ln() / (high.thickness() / low.thickness()).ln();
    let name = format!(
        "chute at {} degrees: exponent of the height in the speed, {:.0} to {:.0} layers",
        high.degrees, low.layers, high.layers
    );
    within(name, exponent, 1.5, 0.25, source)
}

/// V-36: at rest below, steady flow of constant density with Bagnold's profile above the angle of repose.
pub(super) fn silbert(perturbation: f64) -> Result<Vec<Claim>, String> {
    let base = base(perturbation)?;
    let slope = |degrees: f64, layers: f64, start: f64| Slope { degrees, layers, friction: 0.5, base: &base, start };
    let still = slope(17.0, 12.0, 1.0).flow([200.0, 220.0], perturbation)?;
    let mut claims = vec![still.rests()];
    let gentle = slope(22.0, 24.0, 5.0).flow([250.0, 450.0], perturbation)?;
    let steep = slope(25.0, 24.0, 12.0).flow([250.0, 450.0], perturbation)?;
    claims.extend(gentle.gates());
    claims.extend(steep.gates());
    claims.push(quicker(&steep, &gentle));
    let thin = slope(25.0, 12.0, 5.0).flow([200.0, 400.0], perturbation)?;
    let thick = slope(25.0, 40.0, 25.0).flow([400.0, 600.0], perturbation)?;
    claims.extend([grows(&steep, &thin), grows(&thick, &steep)]);
    let name = "chute at 25 degrees, 40 layers: speed in the first half of the time over that of all";
    claims.push(within(name, thick.early() / thick.speed(), 1.0, 0.1, own("steady").after()));
    claims.push(refused("chute, a slope below the angle of repose", &still.gates()[..1], 1));
    let smooth = Slope { base: &[], ..slope(22.0, 12.0, 5.0) }.flow([50.0, 150.0], 1.0)?;
    claims.push(refused("chute, a base that is a plane", &smooth.gates(), 1));
    let slippery = Slope { friction: 0.0, ..slope(22.0, 12.0, 5.0) }.flow([50.0, 150.0], 1.0)?;
    claims.push(refused("chute, grains without friction", &slippery.gates(), 1));
    claims.push(refused("chute, grains without friction on a plane", &slides()?, 3));
    Ok(claims)
}

/// What nothing holds back: it slides at 17 degrees, at 25 hardly faster than at 22, and in a high layer as in a low one.
fn slides() -> Result<[Claim; 3], String> {
    let slide = |degrees: f64, layers: f64| {
        Slope { degrees, layers, friction: 0.0, base: &[], start: 5.0 }.flow([20.0, 60.0], 1.0)
    };
    let [below, gentle, steep] = [slide(17.0, 12.0)?, slide(22.0, 12.0)?, slide(25.0, 12.0)?];
    Ok([below.rests(), quicker(&steep, &gentle), grows(&slide(25.0, 24.0)?, &steep)])
}
