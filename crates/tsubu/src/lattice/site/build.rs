//! From a plan to a model on its ground: what is honoured, what is approximated and by how much, and what is refused.

use super::engine::{Scene, SiteEngine};
use super::ground::{Ground, Sites};
use super::pile::Stack;
use super::rule::{GasRule, SiteRule};
use super::{Model, gas, start};
use crate::engine::Refusal;
use crate::lattice::build::restitution;
use crate::lattice::caram_hong::{CaramHong, Chances};
use crate::lattice::gutt_haff::{Grain, LatticeGrains};
use crate::lattice::hemmingsson_herrmann::{Pile, Rule, Split};
use crate::lattice::litwiniszyn::Litwiniszyn;
use crate::lattice::reach::{self, Ways};
use crate::lattice::remarks::{Pull, Remarks, World};
use crate::lattice::savage::{Chute, Moves};
use crate::lattice::sheet::{Layout, OUT, ROW_SPACING, WALL};
use crate::lattice::stage;
use crate::memory::refuse_more_than_there_is;
use crate::partner::Hosts;
use crate::wall::Wall;
use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_scene::plan::{self, Plan, Region, Removal};

/// Share of a spacing that the fastest lattice grain flies in an automatic step.
const SHARE: f64 = 0.02;

/// The engine of a plan whose method is one of the models with grains on sites.
pub fn open(plan: &Plan, rule: SiteRule, hosts: &Hosts) -> Result<SiteEngine, Refusal> {
    let mut remarks = Remarks::of(plan.method.name());
    let built = scene(plan, rule, hosts, &mut remarks).map(|(scene, cells)| {
        let (model, dt) = model(plan, rule, &scene, &cells, &mut remarks);
        remarks.watches(&plan.watch, plan, model.offers());
        (scene, model, dt)
    });
    match (built, remarks.refusal()) {
        (Some((scene, model, dt)), None) => Ok(SiteEngine::new(model, scene, dt, step_key(plan, rule), remarks.notes)),
        (_, refused) => Err(refused.unwrap_or(Refusal { method: plan.method.name(), notes: Vec::new() })),
    }
}

/// The scene, and what is on every site, grains by their numbers.
///
/// Takes the plan apart, every field by name, so that a new field does not compile until it has been decided on here.
fn scene(plan: &Plan, rule: SiteRule, hosts: &Hosts, remarks: &mut Remarks) -> Option<(Scene, Vec<i32>)> {
    let Plan {
        title: _,
        method: _,    // By `rule`.
        dimension: _, // As periodic and water: read by `Remarks::world`.
        seed,
        gravity,
        duration: _,
        speed_scale: _, // Only chooses DEM's step.
        materials: _,   // Restitution is read by `model`, friction by piles; the remark below is about the others.
        material_pair: _,
        particles,
        walls,
        periodic,
        removal,
        water: _,
        hosts: _,
        contact: _,
        bond: _,
        dem: _,
        lattice: _,
        cl_ca: _,
        litwiniszyn: _,
        after_caram_hong: _,
        after_savage: _,
        gutt_haff: _,
        after_hemmingsson_herrmann: _,
        fhp: _,
        after_peng_herrmann: _,
        after_baxter_behringer: _,
        after_karolyi_kertesz: _,
        response: _,
        atlas: _,
        design: _,
        calibrate: _,
        sweep: _,
        watch: _, // Once the model is there.
        output: _,
        start_from: _, // Of the run, as its stages.
        start_fingerprint: _,
        start_at_zero: _,
        stage: _,
        claim: _,
    } = plan;
    remarks.world(plan, world(rule));
    for (name, wall) in walls {
        refuse_motion(name, wall, remarks);
    }
    for (name, _) in particles.iter().filter(|(_, group)| !matches!(group.motion, plan::GrainMotion::Free {})) {
        remarks.refuse(format!("particles.{name}.motion"), "all grains of this lattice are free; draw a wall instead");
    }
    if remarks.refusal().is_some() {
        return None;
    }
    remarks.approximate("contact", law(rule));
    let spacing = spacing(plan, rule, remarks)?;
    let walls: Vec<Wall> =
        walls.iter().map(|(name, wall)| Wall::new(name, wall, 2, hosts, DVec3::from_array(*gravity))).collect();
    let mut region = stage::region(plan, &walls, 4.0 * spacing);
    for (axis, ends) in [(0, periodic.x), (2, periodic.z)] {
        if let (Some(region), Some([low, high])) = (&mut region, ends) {
            (region.low[axis], region.high[axis]) = (low, high);
        }
    }
    let gas = if let SiteRule::Gas(gas) = rule { Some(gas) } else { None };
    let repeats = if gas.is_some() { [periodic.x.is_some(), periodic.z.is_some()] } else { [false; 2] };
    let ground = region.as_ref().and_then(|region: &Region| Ground::repeating(sites(rule), region, spacing, repeats));
    let Some(ground) = ground else {
        let text = "nothing in the scene tells how large the lattice is, or it would have less than one site across or more than 1e8; draw a box around the grains";
        remarks.refuse("walls", text);
        return None;
    };
    remark_ends(plan, &ground, remarks);
    if let Err(refusal) = refuse_more_than_there_is(plan, ground.len()) {
        remarks.notes.extend(refusal.notes);
        return None;
    }
    let regions: Vec<_> = removal.values().cloned().collect();
    let (painted, owner) = ground.paint(&walls, &regions);
    let mut cells = painted.repeat(gas.map_or(1, |gas| gas::layers(plan, gas)));
    let streams = start::place(plan, &ground, &mut cells, gas.is_some(), remarks);
    remark_removal(removal, &ground, &walls, &cells, &streams, remarks);
    let each = |of: &dyn Fn(usize, &plan::Particles) -> f64| -> Vec<f64> {
        particles.values().enumerate().flat_map(|(number, group)| vec![of(number, group); group.count]).collect()
    };
    let scene = Scene {
        mass: masses(rule, each(&|_, group| group.mass), remarks),
        diameter: each(&|_, group| group.diameter),
        group: each(&|number, _| number as f64).into_iter().map(|number| number as u32).collect(),
        gravity: DVec3::from_array(*gravity),
        ground,
        walls,
        owner,
        removal: regions,
        streams,
        seed: *seed,
    };
    Some((scene, cells))
}

/// Masses of the grains [kg]: collisions of Gutt and Haff's are those of equals, so that all of them have the mean mass.
fn masses(rule: SiteRule, each: Vec<f64>, remarks: &mut Remarks) -> Vec<f64> {
    let mean = each.iter().sum::<f64>() / each.len().max(1) as f64;
    if rule != SiteRule::GuttHaff || each.iter().all(|mass| (mass - mean).abs() <= 1e-9 * mean) {
        return each;
    }
    remarks.approximate(
        "particles",
        format!("collisions are those of equal grains: all have the mean mass, {mean:.3e} kg"),
    );
    vec![mean; each.len()]
}

/// How the sites of a method lie.
fn sites(rule: SiteRule) -> Sites {
    match rule {
        SiteRule::Gas(_) | SiteRule::GuttHaff => Sites::Upright,
        SiteRule::Savage => Sites::Level(Layout::Square),
        SiteRule::Litwiniszyn | SiteRule::CaramHong | SiteRule::HemmingssonHerrmann => Sites::Level(Layout::Triangular),
    }
}

/// The key that says how long a step is; a pile at rest has a step for every row.
fn step_key(plan: &Plan, rule: SiteRule) -> String {
    if rule == SiteRule::HemmingssonHerrmann {
        "duration".to_owned()
    } else {
        format!("{}.time-step", plan.method.name())
    }
}

/// What the lattice of a method has room for.
fn world(rule: SiteRule) -> World {
    let (gravity, periodic) = match rule {
        SiteRule::Savage => (Pull::Leaning, [true, false]),
        SiteRule::Gas(GasRule::Fhp) => (Pull::Anywhere, [true; 2]),
        SiteRule::Gas(GasRule::PengHerrmann | GasRule::BaxterBehringer) => (Pull::DownOrNone, [true; 2]),
        SiteRule::Gas(GasRule::KarolyiKertesz) => (Pull::Down, [true, false]),
        SiteRule::Litwiniszyn | SiteRule::CaramHong | SiteRule::GuttHaff | SiteRule::HemmingssonHerrmann => {
            (Pull::Down, [false; 2])
        }
    };
    World { noun: "grains of this lattice", gravity, periodic }
}

/// Says where the ends of a world that repeats itself are moved to a whole number of sites.
fn remark_ends(plan: &Plan, ground: &Ground, remarks: &mut Remarks) {
    let [x, _, z] = ground.ends();
    for (axis, typed, ends) in [("x", plan.periodic.x, x), ("z", plan.periodic.z, z)] {
        if let (Some([low, high]), Some([first, last])) = (typed, ends) {
            let (typed, real) = (high - low, last - first);
            if (typed - real).abs() > 1e-6 * typed {
                let text = format!("a whole number of sites: {:.4} mm instead of {:.4} mm", 1e3 * real, 1e3 * typed);
                remarks.approximate(format!("periodic.{axis}"), text);
            }
        }
    }
}

/// Says which outlets no grain can come to, walls that vanish put aside.
fn remark_removal(
    removal: &BTreeMap<String, Removal>,
    ground: &Ground,
    walls: &[Wall],
    cells: &[i32],
    streams: &[start::GrainStream],
    remarks: &mut Remarks,
) {
    let staying: Vec<Wall> = walls.iter().filter(|wall| wall.until.is_none()).cloned().collect();
    let free = if removal.is_empty() { Vec::new() } else { ground.paint(&staying, &[]).0 };
    let ways = Ways {
        sites: ground.sites,
        size: [ground.columns, ground.rows],
        periodic: ground.periodic,
        open: &|column, row| free[ground.index(column, row)] != WALL,
        point: &|column, row| ground.point(ground.index(column, row)),
        spacing: ground.spacing,
    };
    let grains = (0..cells.len()).filter(|site| cells[*site] >= 0);
    let begin = grains.chain(streams.iter().flat_map(|stream| stream.sites.iter().copied()));
    reach::remark(removal, &ways, begin.map(|site| ground.column_and_row(site % ground.len())), remarks);
}

/// What the method makes of the contact law.
fn law(rule: SiteRule) -> &'static str {
    match rule {
        SiteRule::GuttHaff => {
            "contacts are collisions with the restitution of the first material; no friction, no stiffness"
        }
        SiteRule::HemmingssonHerrmann => {
            "contacts push as balance asks for, with the friction of the method's own table"
        }
        SiteRule::Gas(GasRule::Fhp) => "no forces: particles fly at one speed, and turn where they meet, without loss",
        SiteRule::Gas(GasRule::PengHerrmann | GasRule::BaxterBehringer) => {
            "no forces: grains fly at one speed or rest; what they lose the method's own table says"
        }
        SiteRule::Gas(GasRule::KarolyiKertesz) => {
            "no forces: the friction of a material is the probability that a grain of it stops when it slides, or holds when it is hit"
        }
        SiteRule::Litwiniszyn | SiteRule::CaramHong | SiteRule::Savage => {
            "no forces: grains move where there is room, whatever their stiffness, restitution and friction"
        }
    }
}

fn refuse_motion(name: &str, wall: &plan::Wall, remarks: &mut Remarks) {
    let plan::Wall { material: _, shape: _, host, interface: _, motion, rotation, servo, body, until: _ } = wall;
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
fn spacing(plan: &Plan, rule: SiteRule, remarks: &mut Remarks) -> Option<f64> {
    let (mut count, mut sum) = (0.0, 0.0);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (name, group) in &plan.particles {
        let number = group.count as f64;
        count += number;
        sum += number * group.diameter;
        let [small, large] = [group.smallest_diameter(), group.largest_diameter()];
        (least, most) = (least.min(small), most.max(large));
        if large > small * (1.0 + 1e-9) {
            let text = "all grains of this group get its mean diameter and mass; make a group for each size";
            remarks.approximate(format!("particles.{name}.size"), text);
        }
    }
    if count == 0.0 {
        remarks.refuse("particles", "there are no grains; their diameter is the width of a site");
        return None;
    }
    let typed = if let SiteRule::Gas(gas) = rule { gas::spacing(plan, gas) } else { None };
    let mean = typed.unwrap_or(sum / count);
    if matches!(rule, SiteRule::Gas(_)) {
        if most > least * (1.0 + 1e-9) {
            remarks
                .approximate("particles", "grains of a gas are alike, whatever their sizes; groups may differ in mass");
        }
        return Some(mean);
    }
    if most > least * (1.0 + 1e-9) {
        let text =
            format!("a site holds one grain of any size; sites are as wide as the mean grain, {:.3} mm", 1e3 * mean);
        remarks.approximate("particles", text);
    }
    Some(mean)
}

/// The model of the plan's method, and its time step [s].
fn model(plan: &Plan, rule: SiteRule, scene: &Scene, cells: &[i32], remarks: &mut Remarks) -> (Box<dyn Model>, f64) {
    let Scene { ground, mass, .. } = scene;
    let (spacing, gravity) = (ground.spacing, -scene.gravity.z);
    let fall = |height: f64| (2.0 * height / gravity).sqrt();
    // What a gate stands on may become an outlet.
    let gate = plan.walls.values().any(|wall| wall.until.is_some());
    let outlets = cells.contains(&OUT) || (gate && !plan.removal.is_empty());
    match rule {
        SiteRule::Litwiniszyn => {
            let plan::Voids { left, rate, time_step } = plan.litwiniszyn;
            remark_outlet(outlets, remarks);
            let model = Litwiniszyn::new(ground.sheet(cells), left, rate, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(ROW_SPACING * spacing)))
        }
        SiteRule::Savage => {
            let plan::Savage { down, diagonal, sideways, up, time_step } = plan.after_savage;
            if up > down + diagonal {
                let text = format!(
                    "{up} is more than `down` and `diagonal` together, {:.3}: grains would rise",
                    down + diagonal
                );
                remarks.refuse("after-savage.up", text);
            }
            let smallest = scene.diameter.iter().copied().fold(f64::INFINITY, f64::min);
            let sieve = scene.diameter.iter().map(|diameter| smallest / diameter).collect();
            let slope = scene.gravity.x / scene.gravity.length();
            let moves = Moves { down, diagonal, sideways, up };
            let wraps = plan.periodic.x.is_some();
            let model = Chute::new(ground.sheet(cells), sieve, moves, slope, wraps, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(spacing)))
        }
        SiteRule::GuttHaff => {
            let (_, size) = ground.inside();
            let fastest = (2.0 * gravity * size.z).sqrt();
            let dt = plan.gutt_haff.time_step.unwrap_or(SHARE * spacing / fastest);
            (Box::new(lattice_grains(plan, scene, cells, dt)), dt)
        }
        SiteRule::HemmingssonHerrmann => {
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
        SiteRule::CaramHong => {
            let plan::Voids { left, rate, time_step } = plan.after_caram_hong;
            remark_outlet(outlets, remarks);
            let model = CaramHong::new(ground.sheet(cells), Chances { left, rate }, plan.seed);
            (Box::new(model), time_step.unwrap_or_else(|| fall(ROW_SPACING * spacing)))
        }
        SiteRule::Gas(gas) => gas::model(plan, gas, scene, cells, remarks),
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
