//! Sakaguchi, Murakami, Hasegawa and Kawai (2001): grains made of lattice points.
//!
//! The paper shows pictures and no numbers, so the claims are signs, order and shape. A perturbation other than 1 takes away
//! what each effect needs: the wall stays, the large grain is as small as the others, the walls are smooth, nothing is
//! poured or pushed.

use super::beds::line;
use super::bench::{Rig, at_least, between, refused};
use glam::DVec3;
use std::path::Path;
use std::time::Instant;
use tsubu::clca::bed::Bed;
use tsubu::clca::engine::ClCaEngine;
use tsubu::engine::{self, Engine};
use tsubu::lattice::grid::WALL as WALL_POINT;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu::view::{Contact, Contacts, Wants};
use tsubu_frame::{Claim, State};
use tsubu_scene::Scene;

const SOURCE: &str = "Sakaguchi et al. (2001), figures 9 to 11: pictures";

/// The scene of the collapse by a method, with changes; the wall on the right stays if `opened` is false.
fn collapsing(method: &str, opened: bool, changes: &[&str]) -> Result<Rig, String> {
    let text = include_str!("../../../scenes/collapse.toml");
    let method = format!("method={method}");
    let changes: Vec<String> = changes.iter().chain([&method.as_str()]).map(|change| (*change).to_owned()).collect();
    let scene = Scene::parse("collapse", text, Path::new("."), &changes).map_err(|c| c.to_string())?;
    let mut plan = scene.plan().clone();
    // Looks are taken here.
    plan.watch.clear();
    plan.claim.clear();
    if !opened && let Some(wall) = plan.walls.get_mut("right") {
        wall.until = None;
    }
    Rig::of(plan, 1.0)
}

/// Grains that are elsewhere after `time` [s] more.
fn moved(rig: &mut Rig, time: f64, least: f64) -> Result<f64, String> {
    let before = rig.vectors("position");
    rig.until(rig.engine.time() + time)?;
    let moved = before.iter().zip(rig.vectors("position")).filter(|(a, b)| a.distance(*b) > least);
    Ok(moved.count() as f64)
}

/// Where the wall stood [m].
const WALL: f64 = 86.6e-3;

/// Of grains at places: how many are beyond the place of the wall [m], the front [mm], and the slope of the surface from
/// there to the left [degrees].
pub(super) fn slope(grains: &[DVec3], wall: f64) -> (f64, f64, f64) {
    let outside = grains.iter().filter(|p| p.x > wall).count() as f64;
    let mut x: Vec<f64> = grains.iter().map(|p| p.x).collect();
    x.sort_by(f64::total_cmp);
    // The front is where 99 % of the grains are behind: single ones may roll on by DEM.
    let front = x[x.len() * 99 / 100];
    let bins = 30;
    let width = front / bins as f64;
    let mut surface = vec![f64::NEG_INFINITY; bins];
    for p in grains {
        let bin = (p.x / width) as usize;
        if bin < bins {
            surface[bin] = surface[bin].max(p.z);
        }
    }
    // A straight line through the lower and middle part of the right flank: the last 60 % of the way.
    let points: Vec<(f64, f64)> = (0..bins)
        .filter(|bin| bin * 10 >= bins * 4 && surface[*bin].is_finite())
        .map(|bin| ((bin as f64 + 0.5) * width, surface[bin]))
        .collect();
    (outside, 1e3 * front, -line(&points).0.atan().to_degrees())
}

/// C-F9 to F11: dropped, at rest, a side wall removed, at rest again.
pub(super) fn collapse(perturbation: f64) -> Result<Vec<Claim>, String> {
    let mut rig = collapsing("cl-ca", perturbation == 1.0, &[])?;
    rig.until(0.5)?;
    let mut claims = vec![between("initial: grains that still move", moved(&mut rig, 0.09, 1e-9)?, 0.0, 0.0, SOURCE)];
    rig.until(0.62)?;
    claims.push(at_least("middle: grains that move within 20 ms", moved(&mut rig, 0.02, 1e-9)?, 20.0, SOURCE));
    rig.until(1.4)?;
    claims.push(between("late: grains that still move", moved(&mut rig, 0.1, 1e-9)?, 0.0, 0.0, SOURCE));
    let (outside, front, angle) = slope(&rig.vectors("position"), WALL);
    claims.push(between("late: grains beyond the place of the wall", outside, 20.0, 270.0, SOURCE));
    claims.push(between("late: front mm", front, 100.0, 300.0, SOURCE));
    let lattice = "between nothing and the steepest side of the lattice, 60 degrees";
    claims.push(between("late: slope degrees", angle, 20.0, 60.0, lattice));
    let standing = {
        let mut rig = collapsing("cl-ca", false, &[])?;
        rig.until(1.4)?;
        slope(&rig.vectors("position"), WALL).0
    };
    claims.push(between("control, the wall stays: grains beyond it", standing, 0.0, 0.0, "nothing else lets them out"));
    Ok(claims)
}

/// C-F9 to F11 by CL-CA and by DEM, one after the other on one machine. Hexagons cannot turn, so their fair twins are discs
/// that do not turn; discs that roll, freely or with resistance, stand beside them.
pub(super) fn twin(perturbation: f64) -> Result<Vec<Claim>, String> {
    let run = |method: &str, changes: &[&str]| -> Result<_, String> {
        let mut rig = collapsing(method, perturbation == 1.0, changes)?;
        let begun = Instant::now();
        rig.until(1.6)?;
        Ok((slope(&rig.vectors("position"), WALL), begun.elapsed().as_secs_f64()))
    };
    let (lattice, quick) = run("cl-ca", &[])?;
    let (free, slow) = run("dem", &[])?;
    let (locked, _) = run("dem", &["contact.rotation=false"])?;
    let (rough, _) = run("dem", &["contact.rotation=false", "materials.aluminium.friction=0.5"])?;
    let (rolling, _) = run("dem", &["contact.rolling.epsd={}", "materials.aluminium.rolling-friction=0.2"])?;
    let source = "a hundredth of the time of its DEM twin, measured in one run";
    let fair = "the fair twin: DEM of discs of the same areas that do not turn; a quarter either way";
    let near = "the fair twin: DEM of discs of the same areas that do not turn; 10 degrees either way";
    let gates = |name: &str, of: (f64, f64, f64), twin: (f64, f64, f64)| {
        [
            between(format!("way of the front, {name}"), (of.1 - 1e3 * WALL) / (twin.1 - 1e3 * WALL), 0.8, 1.25, fair),
            between(format!("slope in degrees, {name}"), of.2 - twin.2, -10.0, 10.0, near),
        ]
    };
    let turns = "the more grains turn, the farther and flatter they run out (Osada 2004, figures 19 and 23)";
    let order = |more: &str, most: (f64, f64, f64), less: &str, least: (f64, f64, f64)| {
        let way = (most.1 - 1e3 * WALL) / (least.1 - 1e3 * WALL);
        [
            at_least(format!("way of the front, {more} over {less}"), way, 1.2, turns),
            at_least(format!("slope in degrees, {less} less {more}"), least.2 - most.2, 3.0, turns),
        ]
    };
    let mut claims = vec![at_least("time of DEM over that of CL-CA", slow / quick, 100.0, source)];
    claims.extend(gates("CL-CA against DEM without rotation", lattice, locked));
    claims.extend(gates("CL-CA against DEM without rotation, friction 0.5", lattice, rough));
    claims.push(refused("CL-CA against discs that roll freely", &gates("", lattice, free), 2));
    claims.extend(order("discs that roll freely", free, "discs with resistance", rolling));
    claims.extend(order("discs with resistance", rolling, "discs that do not turn", locked));
    claims.push(refused("discs that do not turn for free ones", &order("", locked, "", free), 2));
    Ok(claims)
}

/// The collapse of triangles that may turn by 60 degrees, against those that may not (C-7). DEM has no triangles; what turning
/// does to discs says [`twin`].
pub(super) fn turning(perturbation: f64) -> Result<Vec<Claim>, String> {
    // 6 and 21 points, for the 7 and 19 of the hexagons.
    const TRIANGLES: &str = "cl-ca.shapes={ small = { polygon = { corners = [[0, 0], [0, 4], [2, 2]] } }, \
                             large = { polygon = { corners = [[0, 0], [0, 10], [5, 5]] } } }";
    let run = |shapes: &[&str], turning: bool| -> Result<_, String> {
        let turning = format!("cl-ca.turning={}", turning && perturbation == 1.0);
        let mut rig = collapsing("cl-ca", true, &[shapes, &[turning.as_str()]].concat())?;
        rig.until(0.59)?;
        let height = rig.engine.centre_of_mass()[2];
        rig.until(1.4)?;
        let (_, front, slope) = slope(&rig.vectors("position"), WALL);
        Ok((height, front - 1e3 * WALL, slope))
    };
    let (stiff, turned) = (run(&[TRIANGLES], false)?, run(&[TRIANGLES], true)?);
    let (hexagons, same) = (run(&[], false)?, run(&[], true)?);
    let room = "grains that turn find room that others leave open";
    let closer = |name: &str, turned: f64, stiff: f64| between(name, turned / stiff, 0.5, 0.95, room);
    let pattern = "the lattice makes the slope, not whether grains turn: what comes out is close to what does not turn";
    Ok(vec![
        closer("height of the bed at rest, triangles that turn over those that do not", turned.0, stiff.0),
        refused("hexagons, which look alike when turned", &[closer("", same.0, hexagons.0)], 1),
        between(
            "way of the front, triangles that turn over those that do not",
            turned.1 / stiff.1,
            0.75,
            1.33,
            pattern,
        ),
        between(
            "slope in degrees, triangles that turn less those that do not",
            turned.2 - stiff.2,
            -10.0,
            10.0,
            pattern,
        ),
    ])
}

/// A box of hexagons and triangles, mixed so that they do not crystallise, shaken by gravity that points up for 20 steps.
fn shaken(more: &str, seed: u64, perturbation: f64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "shaken"
        method = "cl-ca"
        duration = 1e3
        seed = {seed}
        [materials.m]
        density = 2700
        young-modulus = 1e6
        [particles.hexagons]
        material = "m"
        count = 200
        diameter = 2.778e-3
        start.random.region = {{ low = [4e-3, 18e-3], high = [56e-3, 115e-3] }}
        [particles.triangles]
        material = "m"
        count = 200
        diameter = 1.819e-3
        start.random.region = {{ low = [4e-3, 18e-3], high = [56e-3, 115e-3] }}
        [walls.box]
        material = "m"
        shape.box = {{ width = 60.6e-3, height = 140e-3, depth = 5e-3, floor-centre = [30.3e-3, 0] }}
        [cl-ca]
        spacing = 1e-3
        shapes.triangles.points.at = [[0, 0], [0, 2], [1, 1]]
        {more}
        "#
    );
    Rig::new(&text, perturbation)
}

/// Steps of a cycle of shaking: gravity up, and down.
const CYCLE: [u64; 2] = [20, 200];

/// C-x1: how high a grain of some radius rises, and in how many cycles.
pub(super) fn rise(perturbation: f64) -> Result<Vec<Claim>, String> {
    const SEEDS: u64 = 3;
    const CYCLES: u64 = 200;
    let source = "the large grain rises, a grain as small as the others does not";
    let mut claims = Vec::new();
    let mut times = Vec::new();
    for radius in 1..=4 {
        let drawn = if perturbation == 1.0 { radius } else { 1 };
        let (mut height, mut time) = (0.0, 0.0);
        for seed in 1..=SEEDS {
            let more = format!(
                r#"
                gravity-switch = {{ up = {}, down = {} }}
                shapes.intruder.hexagon.radius = {drawn}
                [particles.intruder]
                material = "m"
                diameter = {:.6e}
                start.at.position = [[30e-3, 8e-3]]
                "#,
                CYCLE[0],
                CYCLE[1],
                1e-3 * tsubu::clca::shape::Shape::hexagon(drawn).diameter()
            );
            let mut rig = shaken(&more, seed, 1.0)?;
            let mut reached = CYCLES;
            let mut share = 0.0;
            for cycle in 0..CYCLES {
                rig.steps(CYCLE[0] + CYCLE[1])?;
                let places = rig.vectors("position");
                // Groups come in the order of their names: hexagons, then the intruder.
                let intruder = places[200].z;
                let mut others: Vec<f64> =
                    places.iter().enumerate().filter(|(id, _)| *id != 200).map(|(_, p)| p.z).collect();
                others.sort_by(f64::total_cmp);
                share = intruder / others[others.len() * 95 / 100];
                if share > 0.8 {
                    reached = reached.min(cycle);
                }
            }
            height += share / SEEDS as f64;
            time += reached as f64 / SEEDS as f64;
        }
        let name = format!("radius {radius}: height over that of the bed after {CYCLES} cycles");
        claims.push(match radius {
            1 => between(name, height, 0.0, 0.7, source),
            2 => between(name, height, 0.1, 1.1, source),
            _ => between(name, height, 0.75, 1.2, source),
        });
        times.push(time);
    }
    claims.push(at_least("cycles to the top, radius 2 over radius 4", times[1] / times[3], 1.5, source));
    claims.push(at_least("cycles to the top, radius 1 over radius 4", times[0] / times[3], 2.0, source));
    Ok(claims)
}

/// Mean rise per cycle [mm] in seven slices between the side walls, in the middle of the bed's height.
fn rolls(rough: bool) -> Result<[f64; 7], String> {
    const CYCLES: usize = 300;
    let heights = (0..24).map(|k| 3e-3 + 5e-3 * f64::from(k));
    let places = heights.flat_map(|z| [format!("[1.4e-3, {z:.4e}]"), format!("[58.4e-3, {z:.4e}]")]);
    let bumps = format!(
        "[particles.bumps]\nmaterial = \"m\"\ndiameter = 2.778e-3\nmotion.frozen = {{}}\nstart.at.position = [{}]\n",
        places.collect::<Vec<_>>().join(", ")
    );
    let more = ["gravity-switch = { up = 60, down = 200 }\n", if rough { &bumps } else { "" }].concat();
    let mut rig = shaken(&more, 1, 1.0)?;
    let first = if rough { 48 } else { 0 };
    let (mut sum, mut count) = ([0.0; 7], [0.0; 7]);
    let free = |rig: &Rig| -> Vec<DVec3> { rig.vectors("position").split_off(first) };
    // Bumps come first: groups are in the order of their names.
    for cycle in 0..CYCLES {
        let before = free(&rig);
        rig.steps(260)?;
        for (a, b) in before.iter().zip(free(&rig)) {
            let slice = (a.x / 60.7e-3 * 7.0) as usize;
            if cycle > CYCLES / 10 && (8e-3..28e-3).contains(&a.z) && slice < 7 {
                sum[slice] += 1e3 * (b.z - a.z);
                count[slice] += 1.0;
            }
        }
    }
    Ok(std::array::from_fn(|slice| if count[slice] > 0.0 { sum[slice] / count[slice] } else { 0.0 }))
}

/// C-x2: down along rough walls, up beside that; along smooth walls next to nothing.
pub(super) fn convection(perturbation: f64) -> Result<Vec<Claim>, String> {
    let source = "convection needs rough walls";
    let rough = rolls(perturbation == 1.0)?;
    let smooth = rolls(false)?;
    let outer = |v: &[f64; 7]| 0.5 * (v[0] + v[6]);
    let inner = |v: &[f64; 7]| 0.5 * (v[1] + v[5]);
    let strength = |v: &[f64; 7]| inner(v) - outer(v);
    Ok(vec![
        between("rough walls: rise at the walls mm a cycle", outer(&rough), -5.0, -0.05, source),
        between("rough walls: rise beside that mm a cycle", inner(&rough), 0.05, 5.0, source),
        between("smooth walls: strength of the roll mm a cycle", strength(&smooth), -0.1, 0.1, source),
        at_least("strength, rough over smooth", strength(&rough) / strength(&smooth).abs().max(0.02), 5.0, source),
    ])
}

/// C-x3: grains are poured; slopes of the heap, and how often each angle is met along its surface.
pub(super) fn pour(perturbation: f64) -> Result<Vec<Claim>, String> {
    let text = include_str!("../../../studies/cl-ca-2001/pour.toml");
    let mut plan = super::bench::plan(text)?;
    plan.watch.clear();
    if perturbation != 1.0 {
        plan.cl_ca.fall_height = Some(1e3);
        plan.duration = 0.1;
    }
    let duration = plan.duration;
    let mut rig = Rig::of(plan, 1.0)?;
    rig.until(duration - 0.2)?;
    let still = moved(&mut rig, 0.2, 1e-9)?;
    let grains = rig.vectors("position");
    let middle = grains.iter().map(|p| p.x).sum::<f64>() / grains.len().max(1) as f64;
    // The surface: the highest grain of every column of 3 mm.
    let width = 3e-3;
    let mut surface = std::collections::BTreeMap::new();
    for p in &grains {
        let column = ((p.x - middle) / width).floor() as i64;
        let top = surface.entry(column).or_insert(f64::NEG_INFINITY);
        *top = p.z.max(*top);
    }
    let flank = |side: i64| {
        let points: Vec<(f64, f64)> = surface
            .iter()
            .filter(|(column, top)| side * (2 * **column + 1) > 0 && **top > 4e-3)
            .map(|(column, top)| ((*column as f64 + 0.5) * width, *top))
            .collect();
        -(side as f64) * line(&points).0.atan().to_degrees()
    };
    let (left, right) = (flank(-1), flank(1));
    let tops: Vec<f64> = surface.values().copied().collect();
    let angles: Vec<f64> = tops.windows(4).map(|t| ((t[3] - t[0]) / (3.0 * width)).atan().abs().to_degrees()).collect();
    let source = "heaps of hexagons end between the lattice's 30 and 60 degrees";
    let gates = |left: f64, right: f64, angles: &[f64]| {
        let share = |of: &dyn Fn(f64) -> bool| {
            angles.iter().filter(|angle| of(**angle)).count() as f64 / angles.len().max(1) as f64
        };
        vec![
            between("left flank degrees", left, 30.0, 60.0, source),
            between("right flank degrees", right, 30.0, 60.0, source),
            between(
                "share of the surface at 25 to 62 degrees",
                share(&|angle| (25.0..62.0).contains(&angle)),
                0.6,
                1.0,
                source,
            ),
            between("share of the surface steeper than 62 degrees", share(&|angle| angle > 62.0), 0.0, 0.1, source),
        ]
    };
    let mut claims = vec![
        at_least("grains poured", grains.len() as f64, 600.0, "the scene"),
        between("grains that still move", still, 0.0, 0.0, "the scene"),
    ];
    claims.extend(gates(left, right, &angles));
    let any: Vec<f64> = (0..90).map(f64::from).collect();
    claims.push(refused(
        "flanks of 25 degrees, as of round grains, and a surface of every angle alike",
        &gates(25.0, 25.0, &any),
        4,
    ));
    Ok(claims)
}

/// C-6: what holds after every step, whatever the scene: the collapse under the active rule, the pushed plate under the passive
/// one. The perturbation takes a point away from a grain.
pub(super) fn invariants(perturbation: f64) -> Result<Vec<Claim>, String> {
    const STEPS: u64 = 400;
    let plate = super::bench::plan(include_str!("../../../studies/cl-ca-2001/plate.toml"))?;
    let scenes = [("active rule", collapsing("cl-ca", true, &[])?.plan, 0.6), ("passive rule", plate, PUSHED)];
    let source = "every step";
    let mut claims = Vec::new();
    for (name, plan, begin) in scenes {
        let owned = name == "active rule";
        let hosts = &mut Hosts::new(&plan.hosts);
        // From a little before the wall goes, or the plate meets the bed, on.
        let run = |threads: usize, hosts: &mut Hosts| -> Result<_, String> {
            let mut engine = ClCaEngine::new(&plan, hosts).map_err(|refusal| refusal.to_string())?;
            let mut ledger = Ledger::open(engine::energies(&engine, hosts), engine.momentum());
            let grains = engine.grains();
            let threads = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
            threads.install(|| {
                let before = (begin / engine.time_step()) as u64 - STEPS / 2;
                engine.advance(before, hosts, &mut ledger).map_err(|fault| fault.to_string())?;
                let mut broken = 0;
                for _ in 0..STEPS {
                    let before = engine.bed().grains.cell.clone();
                    engine.advance(1, hosts, &mut ledger).map_err(|fault| fault.to_string())?;
                    broken += u32::from(engine.bed().fault(owned, &before).is_some());
                }
                let mut state = State::default();
                engine.save(&mut state);
                Ok((engine, broken, grains, state.hash()))
            })
        };
        let (engine, broken, grains, hash) = run(1, hosts)?;
        let seven = run(7, hosts)?.3;
        let mut bed = engine.bed().clone();
        let cells = bed.grains.cell.clone();
        bed.grains.last.fill(None);
        let gate = |bed: &Bed, broken: u32| {
            let broken = broken + u32::from(bed.fault(owned, &cells).is_some());
            let what = "steps with a point shared or on a wall, or a grain lost or moved by more than one spacing";
            between(format!("{name}: of {STEPS}, {what}"), f64::from(broken), 0.0, 0.0, source)
        };
        let Some(free) = bed.present().find(|&grain| bed.kind(grain).free) else { return Err("no grain".to_owned()) };
        let mut wrong = bed.clone();
        wrong.grid.set(cells[free] as usize, WALL_POINT);
        claims.push(gate(if perturbation == 1.0 { &bed } else { &wrong }, broken));
        claims.push(refused("a wall where a grain is", &[gate(&wrong, 0)], 1));
        let lost = (grains - engine.grains()) as f64;
        claims.push(between(format!("{name}: grains lost"), lost, 0.0, 0.0, source));
        let same = f64::from(u8::from(hash == seven));
        claims.push(between(format!("{name}: same bits at 1 and 7 threads"), same, 1.0, 1.0, source));
    }
    Ok(claims)
}

/// When the plate has gone 1 mm into the bed of hexagons [s].
const PUSHED: f64 = 1.46;

/// C-x4: shared points of a bed into which a plate has been pushed by 1 mm: some grains carry, most of them below the plate.
pub(super) fn plate(perturbation: f64) -> Result<Vec<Claim>, String> {
    let pushed = |plate: bool| -> Result<_, String> {
        let mut plan = super::bench::plan(include_str!("../../../studies/cl-ca-2001/plate.toml"))?;
        if !plate {
            plan.particles.retain(|name, _| name != "plate");
            plan.cl_ca.rule = tsubu_scene::plan::ClCaRule::Passive;
        }
        let mut rig = Rig::of(plan, 1.0)?;
        // The plate comes down at 50 mm/s from 116 mm and meets the bed at 1.44 s: it has gone 1 mm into it.
        rig.until(PUSHED)?;
        let Network { loads, carry, under } = network(&rig, Contacts::Places);
        let source = "chain-like, not uniform";
        Ok([
            at_least("pairs that share points", loads.len() as f64, 20.0, source),
            at_least("spread of shared points over their mean", scatter(&loads), 0.3, source),
            between("share of grains that carry", carry, 0.02, 0.5, source),
            at_least("of those, share below the plate", under, 0.45, "the plate covers 30 of 80 mm: 0.37 if all alike"),
        ])
    };
    let mut claims = pushed(perturbation == 1.0)?.to_vec();
    claims.push(refused("no plate", &pushed(false)?, 4));
    Ok(claims)
}

/// What a bed hands on from grain to grain.
struct Network {
    /// Loads of pairs: forces [N], or shared points times the spacing [m].
    loads: Vec<f64>,
    /// Share of the grains with a load; of forces, one above their mean.
    carry: f64,
    /// Share of those that are below the plate.
    under: f64,
}

fn network(rig: &Rig, contacts: Contacts) -> Network {
    let view = rig.engine.view(Wants { contacts, ..Wants::GRAINS });
    let load = |contact: &Contact| match contacts {
        Contacts::Forces => -contact.force.dot(contact.normal),
        _ => contact.overlap,
    };
    let pairs: Vec<(usize, usize, f64)> = view
        .contacts
        .iter()
        .filter(|contact| !contact.wall && load(contact) > 0.0)
        .map(|contact| (contact.first, contact.second, load(contact)))
        .collect();
    let loads: Vec<f64> = pairs.iter().map(|pair| pair.2).collect();
    let least = if contacts == Contacts::Forces { loads.iter().sum::<f64>() / loads.len() as f64 } else { 0.0 };
    let mut carries = vec![false; view.len()];
    for (first, second, _) in pairs.iter().filter(|pair| pair.2 > least) {
        (carries[*first], carries[*second]) = (true, true);
    }
    let all = carries.iter().filter(|carries| **carries).count() as f64;
    let below = |grain: usize| (25e-3..55e-3).contains(&view.grains.position[grain].x);
    let under = (0..view.len()).filter(|&grain| carries[grain] && below(grain)).count() as f64;
    Network { loads, carry: all / view.len() as f64, under: under / all }
}

/// Standard deviation over mean.
fn scatter(loads: &[f64]) -> f64 {
    let n = loads.len() as f64;
    let mean = loads.iter().sum::<f64>() / n;
    (loads.iter().map(|load| (load - mean).powi(2)).sum::<f64>() / n).sqrt() / mean
}

/// C-x4 beside DEM: the forces of a bed of discs into which the same plate has been pushed as far.
pub(super) fn plate_twin(perturbation: f64) -> Result<Vec<Claim>, String> {
    let text = include_str!("../../../studies/cl-ca-2001/plate.toml");
    let at = |method: &str, time: Option<f64>, contacts: Contacts| -> Result<Network, String> {
        let changes = [format!("method={method}")];
        let scene = Scene::parse("plate", text, Path::new("."), &changes).map_err(|c| c.to_string())?;
        let mut plan = scene.plan().clone();
        if perturbation != 1.0 {
            plan.particles.retain(|name, _| name != "plate");
            plan.cl_ca.rule = tsubu_scene::plan::ClCaRule::Passive;
        }
        let mut rig = Rig::of(plan, 1.0)?;
        if let Some(time) = time {
            rig.until(time)?;
        } else {
            // A settled bed of discs is lower: 20 ms after the plate has met it.
            rig.until(0.3)?;
            while !met(&rig) && rig.engine.time() < 1.7 {
                rig.until(rig.engine.time() + 1e-3)?;
            }
            rig.until(rig.engine.time() + 0.02)?;
        }
        Ok(network(&rig, contacts))
    };
    let lattice = at("cl-ca", Some(PUSHED), Contacts::Places)?;
    let discs = at("dem", None, Contacts::Forces)?;
    let broad = "forces of a pushed bed spread about as far as their mean (Radjai et al. 1996; Mueth et al. 1998)";
    let strong = "forces above their mean run through chains, not through every grain (Radjai et al. 1996)";
    let twin = "the same plate, pushed 1 mm into discs by DEM; a third either way";
    let alike = |name: &str, spread: f64| between(name, spread / scatter(&discs.loads), 0.67, 1.5, twin);
    Ok(vec![
        between("DEM: spread of forces over their mean", scatter(&discs.loads), 0.6, 1.5, broad),
        between("DEM: share of grains with more than the mean force", discs.carry, 0.05, 0.9, strong),
        between("DEM: of those, share below the plate", discs.under, 0.37, 1.0, "0.37 if all alike"),
        alike("spread of loads, CL-CA over DEM", scatter(&lattice.loads)),
        refused("a network where all pairs carry alike", &[alike("", 0.0)], 1),
        between("share of grains that carry, CL-CA over DEM", lattice.carry / discs.carry, 0.67, 1.5, twin),
    ])
}

/// Whether a grain of the plate touches one of the bed.
fn met(rig: &Rig) -> bool {
    let view = rig.engine.view(Wants { contacts: Contacts::Places, ..Wants::GRAINS });
    let group = |grain: usize| view.grains.group[grain];
    view.contacts.iter().any(|c| !c.wall && c.overlap > 0.0 && group(c.first) != group(c.second))
}
