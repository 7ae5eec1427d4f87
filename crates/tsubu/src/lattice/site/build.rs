//! From a plan to a model on its ground: what is honoured, what is approximated and by how much, and what is refused.

use super::engine::{Scene, SiteEngine};
use super::ground::{Ground, Sites};
use super::pile::Stack;
use super::{Model, start};
use crate::engine::Refusal;
use crate::lattice::build::restitution;
use crate::lattice::caram_hong::{CaramHong, Chances};
use crate::lattice::gutt_haff::{Grain, LatticeGrains};
use crate::lattice::hemmingsson_herrmann::{Pile, Rule, Split};
use crate::lattice::litwiniszyn::Litwiniszyn;
use crate::lattice::remarks::Remarks;
use crate::lattice::savage::{Chute, Moves};
use crate::lattice::sheet::{Layout, OUT, ROW_SPACING};
use crate::lattice::stage;
use crate::partner::Hosts;
use crate::wall::Wall;
use glam::DVec3;
use tsubu_scene::plan::{self, Method, Plan, Region};

/// Share of a spacing that the fastest lattice grain flies in an automatic step.
const SHARE: f64 = 0.02;

/// The engine of a plan whose method is one of the models with one grain a site.
pub fn open(plan: &Plan, hosts: &Hosts) -> Result<SiteEngine, Refusal> {
    let mut remarks = Remarks::of(plan.method.name());
    let built = scene(plan, hosts, &mut remarks).map(|(scene, cells)| {
        let (model, dt) = model(plan, &scene, &cells, &mut remarks);
        remarks.watches(&plan.watch, plan, model.offers());
        (scene, model, dt)
    });
    match (built, remarks.refusal()) {
        (Some((scene, model, dt)), None) => Ok(SiteEngine::new(model, scene, dt, remarks.notes)),
        (_, refused) => Err(refused.unwrap_or(Refusal { method: plan.method.name(), notes: Vec::new() })),
    }
}

/// The scene, and what is on every site, grains by their numbers.
///
/// Takes the plan apart, every field by name, so that a new field does not compile until it has been decided on here.
fn scene(plan: &Plan, hosts: &Hosts, remarks: &mut Remarks) -> Option<(Scene, Vec<i32>)> {
    let Plan {
        title: _,
        method,
        dimension,
        seed: _,
        gravity,
        duration: _,
        speed_scale: _, // Only chooses DEM's step.
        materials: _,   // Restitution is read by `model`; friction and stiffness the remark below is about.
        material_pair: _,
        particles,
        walls,
        periodic,
        removal,
        water,
        hosts: _,
        contact: _,
        dem: _,
        lattice: _,
        cl_ca: _,
        litwiniszyn: _,
        after_caram_hong: _,
        after_savage: _,
        gutt_haff: _,
        after_hemmingsson_herrmann: _,
        response: _,
        sweep: _,
        watch: _, // Once the model is there.
        output: _,
        claim: _,
    } = plan;
    if *dimension != 2 {
        remarks.refuse("dimension", "the lattice lies in the plane; set `dimension = 2`, or use `method = \"dem\"`");
    }
    if water.is_some() {
        remarks.refuse("water", "grains of this lattice fall in air; use `method = \"dem\"`");
    }
    let slope = *method == Method::AfterSavage;
    if gravity[2] >= 0.0 || gravity[1] != 0.0 || (gravity[0] != 0.0 && !slope) {
        remarks.refuse("gravity", "the lattice has gravity along -z; set `gravity` to one number above 0");
    }
    if *periodic != plan::Periodic::default() && !slope {
        remarks.refuse("periodic", "the lattice has walls at its ends; use `method = \"after-savage\"` or \"dem\"");
    }
    for (name, wall) in walls {
        refuse_motion(name, wall, remarks);
    }
    for (name, group) in particles {
        if !matches!(group.motion, plan::GrainMotion::Free {}) {
            remarks
                .refuse(format!("particles.{name}.motion"), "all grains of this lattice are free; draw a wall instead");
        }
    }
    if remarks.refusal().is_some() {
        return None;
    }
    remarks.approximate("contact", law(*method));
    let spacing = spacing(plan, remarks)?;
    let walls: Vec<Wall> =
        walls.iter().map(|(name, wall)| Wall::new(name, wall, 2, hosts, DVec3::from_array(*gravity))).collect();
    let sites = match method {
        Method::GuttHaff => Sites::Upright,
        Method::AfterSavage => Sites::Level(Layout::Square),
        _ => Sites::Level(Layout::Triangular),
    };
    let mut region = stage::region(plan, &walls, 4.0 * spacing);
    if let (Some(region), Some([low, high])) = (&mut region, periodic.x) {
        (region.low[0], region.high[0]) = (low, high);
    }
    let ground = region.as_ref().and_then(|region: &Region| Ground::new(sites, region, spacing));
    let Some(ground) = ground else {
        let text = "nothing in the scene tells how large the lattice is, or it would have less than one site across or more than 1e8; draw a box around the grains";
        remarks.refuse("walls", text);
        return None;
    };
    let removal: Vec<_> = removal.values().cloned().collect();
    let (mut cells, owner) = ground.paint(&walls, &removal);
    start::place(plan, &ground, &mut cells, remarks);
    let each = |of: &dyn Fn(usize, &plan::Particles) -> f64| -> Vec<f64> {
        let groups = particles.values().enumerate();
        groups.flat_map(|(number, group)| vec![of(number, group); group.count]).collect()
    };
    let scene = Scene {
        mass: each(&|_, group| group.mass),
        diameter: each(&|_, group| group.diameter),
        group: each(&|number, _| number as f64).into_iter().map(|number| number as u32).collect(),
        gravity: DVec3::from_array(*gravity),
        ground,
        walls,
        owner,
        removal,
    };
    Some((scene, cells))
}

/// What the method makes of the contact law.
fn law(method: Method) -> &'static str {
    match method {
        Method::GuttHaff => {
            "contacts are collisions with the restitution of the first material; no friction, no stiffness"
        }
        Method::AfterHemmingssonHerrmann => {
            "contacts push as balance asks for, with the friction of the method's own table"
        }
        _ => "no forces: grains move where there is room, whatever their stiffness, restitution and friction",
    }
}

fn refuse_motion(name: &str, wall: &plan::Wall, remarks: &mut Remarks) {
    let plan::Wall { material: _, shape: _, host, motion, rotation, servo, body, until: _ } = wall;
    for (key, there) in [
        ("host", host.is_some()),
        ("motion", motion.is_some()),
        ("rotation", rotation.is_some()),
        ("servo", servo.is_some()),
        ("body", body.is_some()),
    ] {
        if there {
            let text = "walls of this lattice stand still, or vanish by `until`; use `method = \"cl-ca\"` or \"dem\"";
            remarks.refuse(format!("walls.{name}.{key}"), text);
        }
    }
}

/// Width of a site: the mean diameter of the grains [m].
fn spacing(plan: &Plan, remarks: &mut Remarks) -> Option<f64> {
    let (mut count, mut sum) = (0.0, 0.0);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for group in plan.particles.values() {
        let number = group.count as f64;
        count += number;
        sum += number * group.diameter;
        least = least.min(group.smallest_diameter());
        most = most.max(group.largest_diameter());
    }
    if count == 0.0 {
        remarks.refuse("particles", "there are no grains; their diameter is the width of a site");
        return None;
    }
    let mean = sum / count;
    if most > least * (1.0 + 1e-9) {
        let text =
            format!("a site holds one grain of any size; sites are as wide as the mean grain, {:.3} mm", 1e3 * mean);
        remarks.approximate("particles", text);
    }
    Some(mean)
}

/// The model of the plan's method, and its time step [s].
fn model(plan: &Plan, scene: &Scene, cells: &[i32], remarks: &mut Remarks) -> (Box<dyn Model>, f64) {
    let Scene { ground, mass, .. } = scene;
    let (spacing, gravity) = (ground.spacing, -scene.gravity.z);
    let fall = |height: f64| (2.0 * height / gravity).sqrt();
    let outlets = cells.contains(&OUT);
    match plan.method {
        Method::Litwiniszyn => {
            let plan::Voids { left, rate, time_step } = plan.litwiniszyn;
            remark_outlet(outlets, remarks);
            let model = Litwiniszyn::new(ground.sheet(cells), left, rate, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(ROW_SPACING * spacing)))
        }
        Method::AfterSavage => {
            let plan::Savage { down, diagonal, sideways, up, time_step } = plan.after_savage;
            let smallest = scene.diameter.iter().copied().fold(f64::INFINITY, f64::min);
            let sieve = scene.diameter.iter().map(|diameter| smallest / diameter).collect();
            let slope = scene.gravity.x / scene.gravity.length();
            let moves = Moves { down, diagonal, sideways, up };
            let wraps = plan.periodic.x.is_some();
            let model = Chute::new(ground.sheet(cells), sieve, moves, slope, wraps, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(spacing)))
        }
        Method::GuttHaff => {
            let (_, size) = ground.inside();
            let fastest = (2.0 * gravity * size.z).sqrt();
            let dt = plan.gutt_haff.time_step.unwrap_or(SHARE * spacing / fastest);
            (Box::new(lattice_grains(plan, scene, cells, dt)), dt)
        }
        Method::AfterHemmingssonHerrmann => {
            let plan::Heap { split, friction, arching } = plan.after_hemmingsson_herrmann;
            let split = match split {
                plan::Split::Balance => Split::Vector,
                plan::Split::Random => Split::Random,
            };
            let weight = mass.iter().map(|mass| mass * gravity).collect();
            let pile = Pile::new(ground.sheet(cells), Rule { split, friction, arching }, weight, plan.seed);
            let dt = plan.duration / pile.rows() as f64;
            remarks
                .approximate("duration", format!("a pile at rest knows no time: a step is a row, of {}", pile.rows()));
            (Box::new(Stack { pile, passed: Vec::new() }), dt)
        }
        // After Caram and Hong; other methods do not come here.
        _ => {
            let plan::Voids { left, rate, time_step } = plan.after_caram_hong;
            remark_outlet(outlets, remarks);
            let model = CaramHong::new(ground.sheet(cells), Chances { left, rate }, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(ROW_SPACING * spacing)))
        }
    }
}

fn remark_outlet(there: bool, remarks: &mut Remarks) {
    if !there {
        let text = "no site is an outlet, so no void comes in; remove grains where they shall leave";
        remarks.approximate("removal", text);
    }
}

/// Grains of all numbers on their nodes.
fn lattice_grains(plan: &Plan, scene: &Scene, cells: &[i32], dt: f64) -> LatticeGrains {
    let mut grains = vec![Grain::default(); scene.mass.len()];
    for (node, &cell) in cells.iter().enumerate() {
        if let Ok(number) = usize::try_from(cell) {
            grains[number].node = node;
        }
    }
    let own = plan.particles.values().next().map(|group| group.material.as_str()).unwrap_or_default();
    let wall = plan.walls.values().next().map_or(own, |wall| wall.material.as_str());
    let restitutions = [restitution(plan, own, own), restitution(plan, own, wall)];
    let gravity = -scene.gravity.z * dt * dt / scene.ground.spacing;
    let mut model = LatticeGrains::new(scene.ground.grid(cells), grains, gravity, restitutions, plan.seed);
    model.outlet = cells.iter().map(|&cell| cell == OUT).collect();
    model
}
