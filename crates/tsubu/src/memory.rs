//! How much memory a scene takes, and whether there is as much.

use crate::engine::Refusal;
use std::fs;
use tsubu_scene::plan::{Method, Plan, Shape};

/// Bytes that a triangle of a mesh takes with its place in the search, its neighbours, and the file that it came from.
const TRIANGLE: f64 = 800.0;

/// Bytes that a run takes at most, grains that are yet to come and meshes included; `places`: sites of the lattice.
///
/// Meshes of 200,000 and 2,000,000 triangles took 840 and 740 bytes each. Measured for DEM: beds of 1,000 to 1,000,000 spheres with friction springs, whole program with its checkpoints; a bed that
/// has yet to settle will have two contacts a grain. For lattices: 1000 grains on a million sites, the whole program.
pub(crate) fn of(plan: &Plan, places: usize) -> f64 {
    let grains = plan.numbered() as f64;
    let places = places as f64;
    meshes(plan)
        + match plan.method {
            Method::Dem => 12e6 + 1000.0 * grains,
            Method::Lattice => 8e6 + 1000.0 * grains,
            Method::ClCa => 8e6 + 240.0 * grains + 9.0 * places,
            // Seven slots a site, before and after a step, with a number each.
            Method::Fhp | Method::AfterPengHerrmann | Method::AfterBaxterBehringer => {
                8e6 + 240.0 * grains + 120.0 * places
            }
            Method::AfterHemmingssonHerrmann => 8e6 + 300.0 * grains + 46.0 * places,
            Method::Litwiniszyn
            | Method::AfterCaramHong
            | Method::AfterSavage
            | Method::GuttHaff
            | Method::AfterKarolyiKertesz => 8e6 + 240.0 * grains + 29.0 * places,
        }
}

/// Bytes that each of several ranks takes, the first and another.
///
/// Every rank has the columns of all grains; lists, contacts and what these remember are with the rank that has the block. The first makes checkpoints and pictures
/// with all contacts, too. Measured with a quarter of a million to ten million spheres on two ranks, 1.3 to 1.5 contacts each.
pub(crate) fn on_ranks(plan: &Plan, ranks: usize) -> [f64; 2] {
    let grains = plan.numbered() as f64;
    let other = 25e6 + meshes(plan) + (280.0 + 440.0 / ranks as f64) * grains;
    [other + 100.0 * grains, other]
}

fn meshes(plan: &Plan) -> f64 {
    let of_wall = |shape: &Shape| match shape {
        Shape::Mesh { triangles, .. } => TRIANGLE * triangles.len() as f64,
        _ => 0.0,
    };
    plan.walls.values().map(|wall| of_wall(&wall.shape)).sum()
}

/// Refuses a scene that takes more than there is, before any of it is taken.
pub(crate) fn refuse_more_than_there_is(plan: &Plan, places: usize) -> Result<(), Refusal> {
    let needed = of(plan, places);
    let Some((free, whose)) = free().filter(|(free, _)| needed > *free) else { return Ok(()) };
    let grains = plan.numbered();
    let what = if places > 0 { format!("{grains} grains on {places} places") } else { format!("{grains} grains") };
    let text = format!(
        "{what} take about {} of memory, more than the {} that {whose}; take fewer, or another machine",
        human_memory(needed),
        human_memory(free)
    );
    Err(Refusal::of(plan.method.name(), "particles", text))
}

/// How many bytes this process can still take, and what bounds them; `None` where the system does not tell.
fn free() -> Option<(f64, &'static str)> {
    [
        (machine(), "the machine has free"),
        (group(), "the system leaves to this group of processes"),
        (process(), "the limit of this process (`ulimit -v`) leaves"),
    ]
    .into_iter()
    .filter_map(|(bytes, whose)| Some((bytes?, whose)))
    .min_by(|a, b| a.0.total_cmp(&b.0))
}

fn machine() -> Option<f64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let kilobytes =
        |name: &str| text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next()?.parse().ok());
    let (free, swap): (f64, f64) = (kilobytes("MemAvailable:")?, kilobytes("SwapFree:").unwrap_or(0.0));
    Some(1024.0 * (free + swap))
}

/// The limit of the control group that the process is in.
fn group() -> Option<f64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    let path = groups.lines().find_map(|line| line.strip_prefix("0::"))?;
    let number =
        |name: &str| fs::read_to_string(format!("/sys/fs/cgroup{path}/{name}")).ok()?.trim().parse::<f64>().ok();
    Some(number("memory.max")? - number("memory.current")?)
}

/// What the limit of the address space leaves.
fn process() -> Option<f64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let limit: f64 = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space")?.split_whitespace().next()?.parse().ok())?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let taken: f64 =
        status.lines().find_map(|line| line.strip_prefix("VmSize:")?.split_whitespace().next()?.parse().ok())?;
    Some(limit - 1024.0 * taken)
}

/// An amount of memory in the unit that suits it.
pub(crate) fn human_memory(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.1} MB", bytes / 1e6) } else { format!("{:.2} GB", bytes / 1e9) }
}
