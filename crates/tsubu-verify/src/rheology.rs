//! Friction of a flow against its inertial number, in the plane (V-35).

use super::beds::{law, line, sampled};
use super::bench::{Rig, scalars, within};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{own, remembered};
use std::fmt::Write;
use tsubu_frame::{Claim, Kind};

/// Length of the periodic world.
const LENGTH: f64 = 20.0;
/// Discs above a unit of length of the base.
const LAYERS: f64 = 16.0;
/// Frozen discs of the base.
const BASE: usize = 16;
/// Not looked at next to the base and to the surface.
const EDGE: f64 = 3.0;
/// When flows have become steady, and until when they are looked at.
const LOOKED: [f64; 2] = [150.0, 300.0];
/// Slopes whose inertial numbers lie between 0.06 and 0.18 by the published law. On gentler ones so thin a layer comes to rest.
const SLOPES: [f64; 4] = [18.0, 20.0, 22.0, 24.0];

/// The published law: friction and share of the area at an inertial number.
fn published(inertial: f64) -> [f64; 2] {
    [0.25 + 1.1 * inertial, 0.81 - 0.3 * inertial]
}

/// What flows, and when it is looked at.
#[derive(Clone, Copy)]
struct Run {
    degrees: f64,
    friction: f64,
    /// Speed at the begin over about that of the steady flow.
    begins: f64,
    looked: [f64; 2],
    seed: u64,
}

impl Run {
    fn steady(degrees: f64, friction: f64, seed: u64) -> Self {
        Self { degrees, friction, begins: 1.0, looked: LOOKED, seed }
    }
}

/// Discs of the published study (a fifth larger or smaller, friction 0.4, restitution 0.1) on a row of frozen ones with gaps. They
/// begin with a profile like that which they will have.
fn slope(run: &Run, perturbation: f64) -> Result<Rig, String> {
    let Run { degrees, friction, begins, seed, .. } = *run;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut groups = String::new();
    let (sheets, high) = (4, LAYERS * 2.2 / 4.0);
    let inertial = (sin / cos - 0.25) / 1.1;
    for sheet in 0..sheets {
        let (low, middle) = (f64::from(sheet) * high + 0.6, (f64::from(sheet) + 0.5) / f64::from(sheets));
        let _ = write!(
            groups,
            r#"
            [particles.b-sheet-{sheet}]
            material = "grain"
            count = {count}
            size.uniform = {{ smallest = 0.8, largest = 1.2 }}
            mass = 1
            shape.disc.thickness = 1
            start.random = {{ velocity = [{along}, 0], speed = 0.3, region = {{ low = [0, {low}], high = [{LENGTH}, {top}] }} }}
            "#,
            count = (LENGTH * LAYERS / f64::from(sheets)) as u32,
            along = begins * 2.0 / 3.0 * inertial * LAYERS.powf(1.5) * (1.0 - (1.0 - middle).powf(1.5)),
            top = low + high,
        );
    }
    let base: Vec<String> = (0..BASE).map(|i| format!("[{}, 0]", LENGTH / BASE as f64 * (0.5 + i as f64))).collect();
    let text = format!(
        r#"
        title = "discs on a rough slope"
        seed = {seed}
        gravity = [{sin}, {down}]
        duration = 1000
        periodic.x = [0, {LENGTH}]
        {law}
        [particles.a-base]
        material = "grain"
        diameter = 1
        mass = 1
        shape.disc.thickness = 1
        motion.frozen = {{}}
        start.at.position = [{base}]
        {groups}
        [walls.bottom]
        material = "grain"
        shape.plane.point = [0, -0.5]
        "#,
        down = -cos,
        base = base.join(", "),
        law = law(5e3, friction, 0.1),
    );
    Rig::new(&text, perturbation)
}

/// What flows down one slope, in the middle of its layer.
struct Flow {
    degrees: f64,
    /// Shear rate times the root of mass over pressure, where the pressure is the weight above.
    inertial: f64,
    /// Share of the area that discs fill.
    filled: f64,
    /// Mean speed in the first half of the time over that of all.
    early: f64,
}

impl Flow {
    fn of(run: &Run, perturbation: f64) -> Result<Self, String> {
        let degrees = run.degrees;
        let mut rig = slope(run, perturbation)?;
        let radii = scalars(&rig.frame(), Kind::Grain, "radius");
        let samples = sampled(&mut rig, [run.looked[0], run.looked[1], 0.5], |rig| {
            let grains = rig.vectors("position").into_iter().zip(rig.vectors("velocity")).zip(&radii).skip(BASE);
            grains.map(|((p, v), r)| [p.z, v.x, *r]).collect::<Vec<_>>()
        })?;
        let speed = |part: &[Vec<[f64; 3]>]| {
            let all = || part.iter().flatten();
            all().map(|g| g[1]).sum::<f64>() / all().count() as f64
        };
        let all = || samples.iter().flatten();
        let top = 2.0 * all().map(|g| g[0]).sum::<f64>() / all().count() as f64 - EDGE;
        let slabs = ((top - EDGE) / 2.0) as usize;
        let thick = (top - EDGE) / slabs as f64;
        let times = samples.len() as f64;
        let (mut inertial, mut filled) = (0.0, 0.0);
        for slab in 0..slabs {
            let low = EDGE + thick * slab as f64;
            let inside: Vec<_> = all().filter(|g| g[0] >= low && g[0] < low + thick).collect();
            // The rate of shear is the slope of the speed in the slab.
            let rate = line(&inside.iter().map(|g| (g[0], g[1])).collect::<Vec<_>>()).0;
            // Discs have the mass (2 r)^2.
            let above = all().filter(|g| g[0] > low + 0.5 * thick);
            let weight = above.map(|g| 4.0 * g[2] * g[2]).sum::<f64>() / times;
            let pressure = weight * degrees.to_radians().cos() / LENGTH;
            inertial += rate / pressure.sqrt() / slabs as f64;
            let area = inside.iter().map(|g| std::f64::consts::PI * g[2] * g[2]).sum::<f64>() / times;
            filled += area / (thick * LENGTH) / slabs as f64;
        }
        let early = speed(&samples[..samples.len() / 2]) / speed(&samples);
        Ok(Self { degrees, inertial, filled, early })
    }

    /// Friction of the flow: the tangent of the slope, whatever the grains are.
    fn friction(&self) -> f64 {
        self.degrees.to_radians().tan()
    }

    /// The gates, for a flow that is right and for wrong ones.
    fn gates(&self) -> Vec<Claim> {
        let name = |what: &str| format!("discs at {} degrees: {what}", self.degrees);
        let source = remembered("da Cruz et al. 2005: mu = 0.25 + 1.1 I, share of the area 0.81 - 0.3 I");
        let [friction, filled] = published(self.inertial);
        let holds = remembered("where the law is said to hold");
        vec![
            Claim::judge(name("inertial number"), self.inertial, Some(0.001), Some(0.2), holds),
            within(name("friction less that of the law"), self.friction() - friction, 0.0, 0.03, source),
            within(name("share of the area less that of the law"), self.filled - filled, 0.0, 0.02, source),
            within(
                name("speed in the first half of the time over that of all"),
                self.early,
                1.0,
                0.1,
                own("steady").after(),
            ),
        ]
    }
}

/// The gates of the straight line through flows.
fn straight(flows: &[Flow]) -> [Claim; 2] {
    let (steep, rest) = line(&flows.iter().map(|f| (f.inertial, f.friction())).collect::<Vec<_>>());
    let source = remembered("da Cruz et al. 2005: mu = 0.25 + 1.1 I");
    [
        within("discs: friction at I = 0", rest, 0.25, 0.03, source),
        within("discs: rise of the friction with I", steep, 1.1, 0.25, source),
    ]
}

/// V-35: four slopes lie on the published straight lines, which are those of flows sheared under a constant pressure.
pub(super) fn friction(perturbation: f64) -> Judged {
    ensemble::drawn("slopes", 1..=5, |seed| {
        let flows = |runs: &[Run], perturbation: f64| {
            runs.iter().map(|run| Flow::of(run, perturbation)).collect::<Result<Vec<_>, _>>()
        };
        let all = flows(&SLOPES.map(|degrees| Run::steady(degrees, 0.4, seed)), perturbation)?;
        let mut claims: Vec<Claim> = all.iter().flat_map(Flow::gates).collect();
        claims.extend(straight(&all));
        let slippery = Flow::of(&Run::steady(20.0, 0.0, seed), perturbation)?;
        claims.push(refused("discs without friction, 20 degrees", &slippery.gates(), 1));
        let slippery = [10.0, 16.0].map(|degrees| Run { looked: [60.0, 120.0], ..Run::steady(degrees, 0.0, seed) });
        claims.push(refused("discs without friction", &straight(&flows(&slippery, 1.0)?)[..1], 1));
        let quickening =
            [20.0, 24.0].map(|degrees| Run { begins: 0.0, looked: [5.0, 25.0], ..Run::steady(degrees, 0.4, seed) });
        let quickening = flows(&quickening, 1.0)?;
        let gates = [quickening[0].gates()[3..].to_vec(), straight(&quickening)[1..].to_vec()].concat();
        claims.push(refused("discs that begin at rest, while they quicken", &gates, 2));
        Ok(claims)
    })
}
