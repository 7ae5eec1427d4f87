//! Which sites the grains begin on.
//!
//! `rows` fills its region from the lowest sites up, `settled` all that is free, with the groups mixed; `random` draws
//! sites in its region; `at` and `file` take the nearest site; `stream` lets grains of a gas in one by one.
//!
//! Where a site holds several grains there are as many layers of sites, one over the other; `rows` fills the first layer first.

use super::ground::Ground;
use crate::lattice::remarks::Remarks;
use crate::lattice::sheet::EMPTY;
use crate::random::{Purpose, words};
use glam::DVec3;
use tsubu_scene::plan::{Plan, Region, Start};

/// Grains that come in one by one.
#[derive(Clone, Debug)]
pub(super) struct GrainStream {
    /// Number of the first.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// Where they come in.
    pub sites: Vec<usize>,
    /// Grains per second.
    pub rate: f64,
    /// When the first comes [s].
    pub from: f64,
    /// How many have come.
    pub placed: usize,
}

/// Puts every grain of the plan onto a site; `cells` gets their numbers, layer after layer. `gas`: grains are those of a
/// lattice gas, which may come in later.
pub(super) fn place(
    plan: &Plan,
    ground: &Ground,
    cells: &mut [i32],
    gas: bool,
    remarks: &mut Remarks,
) -> Vec<GrainStream> {
    let mut first = 0;
    let mut settled: Vec<usize> = Vec::new();
    let mut streams = Vec::new();
    for (name, group) in &plan.particles {
        let numbers: Vec<usize> = (first..first + group.count).collect();
        let key = format!("particles.{name}.start");
        match &group.start {
            Start::At { position, velocity, spin } => {
                at(&format!("{key}.at"), position, &numbers, ground, cells, remarks);
                if !velocity.is_empty() || !spin.is_empty() {
                    remarks.approximate(format!("{key}.at"), "grains begin at rest and do not spin");
                }
            }
            Start::File { grains, .. } => {
                let key = format!("{key}.file");
                at(&key, &grains.position, &numbers, ground, cells, remarks);
                rest(&key, !grains.velocity.is_empty() || !grains.spin.is_empty(), gas, remarks);
            }
            Start::Stream { region, rate, velocity, speed, from } if gas => {
                let sites = sites(ground, &cells[..ground.len()], Some(region));
                if sites.is_empty() {
                    remarks.refuse(format!("{key}.stream.region"), "no free site of the lattice is in it; enlarge it");
                }
                if *speed != 0.0 || *velocity != [0.0; 3] {
                    let text = "grains come in straight down, one spacing a step";
                    remarks.approximate(format!("{key}.stream"), text);
                }
                streams.push(GrainStream { first, count: group.count, sites, rate: *rate, from: *from, placed: 0 });
            }
            Start::Stream { .. } => remarks.refuse(
                format!("{key}.stream"),
                "on this lattice all grains are there from the start; fill by `rows`, `settled` or `random`",
            ),
            Start::Settled { .. } => {
                let text = "the lowest sites are filled, groups mixed, instead of grains dropped";
                remarks.approximate(format!("{key}.settled"), text);
                settled.extend(numbers);
            }
            Start::Rows { region, speed, spacing: _, jitter: _ } => {
                let key = format!("{key}.rows");
                remarks.approximate(
                    &key,
                    "filled site by site from the lowest up: spacing is the lattice's, without jitter",
                );
                fill(&key, &numbers, sites(ground, cells, region.as_ref()), cells, remarks);
                rest(&format!("{key}.speed"), *speed != 0.0, gas, remarks);
            }
            Start::Random { region, velocity, speed } => {
                let mut free = sites(ground, cells, region.as_ref());
                free.sort_by_key(|&site| words(plan.seed, Purpose::Placement, site as u32, 1));
                fill(&format!("{key}.random"), &numbers, free, cells, remarks);
                rest(&format!("{key}.random"), *speed != 0.0 || *velocity != [0.0; 3], gas, remarks);
            }
        }
        first += group.count;
    }
    if !settled.is_empty() {
        settled.sort_by_key(|&number| words(plan.seed, Purpose::Placement, number as u32, 0));
        fill("particles", &settled, sites(ground, cells, None), cells, remarks);
    }
    streams
}

fn rest(key: &str, moves: bool, gas: bool, remarks: &mut Remarks) {
    if moves && gas {
        remarks.approximate(key, "grains of a gas begin at rest or at its one speed, where the rules tell");
    } else if moves {
        remarks.approximate(key, "grains begin at rest");
    }
}

/// Free sites of a region, layer by layer from the lowest up.
fn sites(ground: &Ground, cells: &[i32], region: Option<&Region>) -> Vec<usize> {
    let slack = 1e-6 * ground.spacing;
    let point = |s: usize| ground.point(s % ground.len());
    let inside = |p: DVec3| {
        region.is_none_or(|r| {
            let in_box =
                p.x > r.low[0] - slack && p.x < r.high[0] + slack && p.z > r.low[2] - slack && p.z < r.high[2] + slack;
            in_box && r.rounds(p.to_array(), -slack)
        })
    };
    let mut free: Vec<usize> = (0..cells.len()).filter(|&s| cells[s] == EMPTY && inside(point(s))).collect();
    free.sort_by(|&a, &b| {
        let (p, q) = (point(a), point(b));
        (a / ground.len()).cmp(&(b / ground.len())).then(p.z.total_cmp(&q.z)).then(p.x.total_cmp(&q.x))
    });
    free
}

/// Grains onto the first of some sites.
fn fill(key: &str, numbers: &[usize], sites: Vec<usize>, cells: &mut [i32], remarks: &mut Remarks) {
    if sites.len() < numbers.len() {
        let text = format!(
            "{} grains, but only {} free sites of the lattice; take fewer, or enlarge the region or the box",
            numbers.len(),
            sites.len()
        );
        remarks.refuse(key, text);
    }
    for (site, &number) in sites.into_iter().zip(numbers) {
        cells[site] = number as i32;
    }
}

/// Given places: the nearest sites.
fn at(key: &str, position: &[[f64; 3]], numbers: &[usize], ground: &Ground, cells: &mut [i32], remarks: &mut Remarks) {
    let mut farthest = 0.0_f64;
    for (index, (point, &number)) in position.iter().zip(numbers).enumerate() {
        let nearest = ground.nearest(DVec3::from_array(*point)).and_then(|(site, distance)| {
            let free = (site..cells.len()).step_by(ground.len()).find(|site| cells[*site] == EMPTY);
            free.map(|site| (site, distance))
        });
        match nearest {
            Some((site, distance)) => {
                cells[site] = number as i32;
                farthest = farthest.max(distance);
            }
            None => remarks.refuse(
                format!("{key}.position[{index}]"),
                "its nearest site is taken by a wall, an outlet or another grain; move it",
            ),
        }
    }
    if farthest > 1e-6 * ground.spacing {
        let text = format!("taken to the nearest site of the lattice, at most {:.3} mm away", 1e3 * farthest);
        remarks.approximate(format!("{key}.position"), text);
    }
}
