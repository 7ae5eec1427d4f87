//! Flow down a rough slope (V-35, V-36): Silbert et al. 2001.

mod bagnold;
mod stopping;

pub(super) use bagnold::bagnold;
pub(super) use stopping::stopping;

use super::beds::{centres, law, sampled};
use super::bench::{Rig, within};
use crate::origin::{closed_form, own};
use glam::DVec3;
use std::fmt::Write;
use tsubu_frame::Claim;

/// Not looked at next to the base and to the surface.
const EDGE: f64 = 3.0;
/// Heights above its floor between which a bed at rest is cut to make the base: 1.2 diameters thick, as in Silbert et al.
const CUT: [f64; 2] = [2.5, 3.7];

/// What the slopes of a case have in common.
struct World {
    /// Length and width of the periodic world, in diameters.
    size: [f64; 2],
    /// Stiffness of the springs, in m g/d.
    stiffness: f64,
    /// What its beds are drawn by.
    seed: u64,
    /// Places of the frozen grains: cut out of a bed at rest, so dense that no grain gets in between. The highest are below 0.
    base: Vec<DVec3>,
}

impl World {
    fn new(size: [f64; 2], stiffness: f64, seed: u64, perturbation: f64) -> Result<Self, String> {
        let [length, wide] = size;
        let text = format!(
            r#"
            title = "the bed that a base is cut from"
            seed = {seed}
            dimension = 3
            gravity = 1
            duration = 100
            periodic.x = [0, {length}]
            periodic.y = [0, {wide}]
            {law}
            [particles.bed]
            material = "grain"
            count = {count}
            diameter = 1
            mass = 1
            start.random.region = {{ low = [0, 0, 0], high = [{length}, {wide}, 20] }}
            [walls.bottom]
            material = "grain"
            shape.plane.point = [0, 0, 0]
            "#,
            law = law(stiffness, 0.5, 0.88),
            count = (7.0 * length * wide) as u32,
        );
        let mut rig = Rig::new(&text, perturbation)?;
        rig.until(40.0)?;
        let inside = |p: &DVec3| (CUT[0]..CUT[1]).contains(&p.z);
        let around = |p: DVec3| DVec3::new(p.x.rem_euclid(length), p.y.rem_euclid(wide), p.z - CUT[1]);
        let base = rig.vectors("position").into_iter().filter(inside).map(around).collect();
        Ok(Self { size, stiffness, seed, base })
    }

    fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }
}

/// A layer of grains on a slope.
#[derive(Clone, Copy)]
struct Slope<'a> {
    world: &'a World,
    degrees: f64,
    /// Grains above a unit of area.
    layers: f64,
    friction: f64,
    /// On the frozen grains; on a plane otherwise.
    rough: bool,
    /// Speed of the surface at the beginning; deeper grains begin more slowly.
    start: f64,
}

impl<'a> Slope<'a> {
    /// A layer of grains as rough as the base.
    fn new(world: &'a World, degrees: f64, layers: f64, start: f64) -> Self {
        Self { world, degrees, layers, friction: 0.5, rough: true, start }
    }

    /// Number of frozen grains, which come first.
    fn frozen(&self) -> usize {
        if self.rough { self.world.base.len() } else { 0 }
    }

    fn rig(&self, perturbation: f64) -> Result<Rig, String> {
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let [length, wide] = self.world.size;
        let mut groups = String::new();
        if self.rough {
            let places: Vec<String> = self.world.base.iter().map(|p| format!("[{}, {}, {}]", p.x, p.y, p.z)).collect();
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
                start.random = {{ velocity = [{along}, 0, 0], speed = 0.5, region = {{ low = [0, 0, {low}], high = [{length}, {wide}, {top}] }} }}
                "#,
                count = (self.world.area() * self.layers / f64::from(sheets)) as u32,
                along = self.start * (1.0 - (1.0 - middle).powf(1.5)),
                top = low + high,
            );
        }
        let text = format!(
            r#"
            title = "a layer of grains on a rough slope"
            seed = {seed}
            dimension = 3
            gravity = [{sin}, 0, {down}]
            duration = 1000
            periodic.x = [0, {length}]
            periodic.y = [0, {wide}]
            {law}
            {groups}
            [walls.bottom]
            material = "grain"
            shape.plane.point = [0, 0, {bottom}]
            "#,
            seed = self.world.seed,
            down = -cos,
            bottom = if self.rough { -2 } else { 0 },
            law = law(self.world.stiffness, self.friction, 0.88),
        );
        Rig::new(&text, perturbation)
    }

    /// Height and speed down the slope of every grain that is not frozen.
    fn look(&self, rig: &Rig) -> Vec<[f64; 2]> {
        let speeds = rig.vectors("velocity").split_off(self.frozen());
        centres(rig, self.frozen()).iter().zip(speeds).map(|(p, v)| [p.z, v.x]).collect()
    }

    /// What it does in the span of time.
    fn flow(&self, span: [f64; 2], perturbation: f64) -> Result<Flow, String> {
        let mut rig = self.rig(perturbation)?;
        let samples = sampled(&mut rig, [span[0], span[1], 0.5], |rig| self.look(rig))?;
        Ok(Flow::of(self, &Looks { samples }))
    }
}

/// What was looked at, many times.
struct Looks {
    samples: Vec<Vec<[f64; 2]>>,
}

impl Looks {
    /// Mean of what is true of a grain, in the first looks.
    fn mean(&self, first: usize, of: impl Fn(&[f64; 2]) -> f64) -> f64 {
        let samples = &self.samples[..first];
        let count: usize = samples.iter().map(Vec::len).sum();
        samples.iter().flatten().map(of).sum::<f64>() / count as f64
    }

    /// Number of grains and mean speed between two heights.
    fn between(&self, low: f64, high: f64) -> (f64, f64) {
        let all = self.samples.iter().flatten();
        let (count, sum) =
            all.filter(|g| g[0] >= low && g[0] < high).fold((0.0, 0.0), |(count, sum), g| (count + 1.0, sum + g[1]));
        (count, sum / count)
    }
}

/// A flow in the mean over time.
#[derive(Clone, Copy)]
struct Flow {
    degrees: f64,
    layers: f64,
    /// Mean speed.
    speed: f64,
    /// That in the first half of the time, over that of all.
    early: f64,
    /// Mean speed over that of the surface.
    profile: f64,
    /// Height of the layer if all of it were as dense as its bulk: wherever the base begins.
    thickness: f64,
    /// Least and largest density of slabs one diameter thick, over their mean, away from base and surface.
    density: [f64; 2],
    /// Inertial number, shear rate times diameter over the root of pressure over density, in the upper half of the bulk over that
    /// in the lower. The pressure is the weight above.
    inertial_ratio: f64,
}

impl Flow {
    fn of(slope: &Slope<'_>, looks: &Looks) -> Self {
        let (area, times) = (slope.world.area(), looks.samples.len() as f64);
        let speed = looks.mean(looks.samples.len(), |g| g[1]);
        // Height of a layer of even density with the same centre of mass.
        let height = 2.0 * looks.mean(looks.samples.len(), |g| g[0]);
        let (low, high) = (EDGE, height - EDGE);
        let bulk = looks.between(low, high).0 / times / (high - low);
        let slabs = (height - 2.0 * EDGE) as usize;
        let counts: Vec<f64> = (0..slabs).map(|k| looks.between(EDGE + k as f64, EDGE + k as f64 + 1.0).0).collect();
        let mean = counts.iter().sum::<f64>() / slabs as f64;
        let middle = 0.5 * (low + high);
        let [lower, upper] = [[low, middle], [middle, high]].map(|[from, to]| {
            let third = (to - from) / 3.0;
            let rate = (looks.between(to - third, to).1 - looks.between(from, from + third).1) / (2.0 * third);
            let above = looks.between(0.5 * (from + to), f64::MAX).0 / times;
            let pressure = above * slope.degrees.to_radians().cos() / area;
            rate / (pressure * std::f64::consts::PI / 6.0).sqrt()
        });
        Self {
            degrees: slope.degrees,
            layers: slope.layers,
            speed,
            early: looks.mean(looks.samples.len() / 2, |g| g[1]) / speed,
            profile: speed / looks.between(height - 1.0, f64::MAX).1,
            thickness: slope.layers * area / bulk,
            density: counts.into_iter().map(|n| n / mean).fold([f64::MAX, 0.0], |r, n| [r[0].min(n), r[1].max(n)]),
            inertial_ratio: upper / lower,
        }
    }

    /// The numbers that are measured.
    fn numbers(&self) -> [f64; 7] {
        let Self { speed, early, profile, thickness, density: [least, largest], inertial_ratio, .. } = *self;
        [speed, early, profile, thickness, least, largest, inertial_ratio]
    }

    /// The flow of a layer, of the numbers that were measured.
    fn from(degrees: f64, layers: f64, numbers: [f64; 7]) -> Self {
        let [speed, early, profile, thickness, least, largest, inertial_ratio] = numbers;
        Self { degrees, layers, speed, early, profile, thickness, density: [least, largest], inertial_ratio }
    }

    /// The gates, for a flow that is right and for wrong ones.
    fn gates(&self) -> Vec<Claim> {
        let name = |what: &str| format!("chute at {} degrees: {what}", self.degrees);
        let source = own("Silbert et al. 2001: steady flow from 19.5 to 26 degrees").after();
        let profile = closed_form("Bagnold's profile: mean over surface speed is 3/5; 1/2 for linear, 1 for a plug");
        let bulk = own("constant density with depth, but for the layers next to base and surface").after();
        let [least, largest] = self.density;
        vec![
            Claim::judge(name("speed over sqrt(g d)"), self.speed, Some(0.5), None, source),
            within(name("speed in the first half of the time over that of all"), self.early, 1.0, 0.1, source),
            within(name("mean speed over surface speed"), self.profile, 0.6, 0.06, profile),
            Claim::judge(name("least density of a slab"), least, Some(0.95), None, bulk),
            Claim::judge(name("largest density of a slab"), largest, None, Some(1.05), bulk),
            within(
                name("inertial number of the upper half of the bulk over the lower"),
                self.inertial_ratio,
                1.0,
                0.1,
                own("mu(I): one slope, one inertial number at every depth").after(),
            ),
        ]
    }

    /// The gate for a layer at rest.
    fn rests(&self) -> Claim {
        let source = own("Silbert et al. 2001: flow from 19.5 to 26 degrees").after();
        within(format!("chute at {} degrees: speed", self.degrees), self.speed, 0.0, 1e-3, source)
    }
}

/// The gate for a steeper flow, and a gentler one.
fn quicker(steep: &Flow, gentle: &Flow) -> Claim {
    let source = own("Silbert et al. 2001: flow from 19.5 to 26 degrees").after();
    let name = format!("chute: speed at {} over speed at {} degrees", steep.degrees, gentle.degrees);
    Claim::judge(name, steep.speed / gentle.speed, Some(1.2), None, source)
}

/// The gate for a higher flow, and a lower one.
fn grows(high: &Flow, low: &Flow) -> Claim {
    let source = closed_form("mean speed grows with height to the power 3/2; 1 for a plug, 2 for a viscous liquid");
    let exponent = (high.speed / low.speed).ln() / (high.thickness / low.thickness).ln();
    let name = format!(
        "chute at {} degrees: exponent of the height in the speed, {:.0} to {:.0} layers",
        high.degrees, low.layers, high.layers
    );
    within(name, exponent, 1.5, 0.25, source)
}
