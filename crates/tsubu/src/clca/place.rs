//! Where grains of lattice points begin.

use super::active::Active;
use super::bed::Bed;
use super::order::Pull;
use crate::lattice::grid::EMPTY;
use crate::lattice::remarks::Remarks;
use crate::lattice::stage::Stage;
use crate::random::{Purpose, words};
use glam::DVec3;
use tsubu_scene::plan::{Plan, Region, Shape, Start};

/// Attempts to find a free place for one grain before giving up.
const ATTEMPTS: u64 = 20_000;

/// Why a round region is refused.
const BOXES: &str = "grains of lattice points begin in boxes; give `low` and `high`, or use `method = \"dem\"`";

/// A grain to be placed: its number in the plan and its kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grain {
    pub id: u32,
    pub kind: usize,
}

/// Puts the grains of all groups that are there at time 0 onto the lattice; `grains` has those of every group.
pub(super) fn place(plan: &Plan, stage: &Stage, grains: &[Vec<Grain>], bed: &mut Bed, remarks: &mut Remarks) {
    let casing = plan.walls.values().find_map(|wall| match wall.shape {
        Shape::Box { width, height, floor_centre: [x, _, z], .. } => {
            Some(Region::of_box([x - 0.5 * width, 0.0, z], [x + 0.5 * width, 0.0, z + height]))
        }
        _ => None,
    });
    // Those at random places come last, the largest first: they look for room among all others.
    let random = |start: &Start| matches!(start, Start::Random { .. });
    let mut later: Vec<(Grain, Region, String)> = Vec::new();
    let mut settle = false;
    // Those with places of their own come first: rows make room for them.
    let placed = |start: &Start| matches!(start, Start::At { .. } | Start::File { .. });
    let mut groups: Vec<_> = plan.particles.iter().zip(grains).collect();
    groups.sort_by_key(|((_, group), _)| !placed(&group.start));
    for ((name, group), own) in groups {
        let key = format!("particles.{name}.start");
        let region = match &group.start {
            Start::Rows { region, .. } | Start::Random { region, .. } => region.clone().or_else(|| casing.clone()),
            Start::Settled { .. } => casing.clone(),
            _ => None,
        };
        match (&group.start, region) {
            (Start::At { position, .. }, _) => at(&key, position, own, stage, bed, remarks),
            (Start::File { grains, .. }, _) => at(&key, &grains.position, own, stage, bed, remarks),
            (Start::Stream { region, .. }, _) if region.is_round() => {
                remarks.refuse(format!("{key}.stream.region"), BOXES);
            }
            (Start::Stream { .. }, _) => {}
            (_, Some(region)) if region.is_round() => remarks.refuse(key, BOXES),
            (_, None) => remarks.refuse(
                key,
                "needs a wall with `shape.box` to be placed in, or a `region`; or give positions with `start.at`",
            ),
            (start, Some(region)) if random(start) => {
                later.extend(own.iter().map(|&grain| (grain, region.clone(), key.clone())));
            }
            (start, Some(region)) => {
                rows(&key, own, &region, stage, bed, remarks);
                settle |= matches!(start, Start::Settled { .. });
            }
        }
    }
    let points = |bed: &Bed, kind: usize| bed.kinds[kind].shape.points().len();
    later.sort_by_key(|(grain, ..)| (std::cmp::Reverse(points(bed, grain.kind)), grain.id));
    for (grain, region, key) in later {
        let Some(cell) = somewhere(bed, grain, &region, stage, Purpose::Placement, 0, ATTEMPTS) else {
            remarks.refuse(
                key,
                format!(
                    "no room for grain {} of {} without overlap, after {ATTEMPTS} attempts; enlarge the region, or use `start.rows`",
                    grain.id,
                    bed.len()
                ),
            );
            return;
        };
        bed.add(grain.kind, cell, grain.id);
    }
    if settle {
        let mut active = Active::default();
        while active.step(bed, Pull::DOWN) > 0 {}
        bed.begin();
    }
}

/// A random cell in a region where a grain fits.
pub(super) fn somewhere(
    bed: &Bed,
    grain: Grain,
    region: &Region,
    stage: &Stage,
    purpose: Purpose,
    look: u64,
    attempts: u64,
) -> Option<usize> {
    let (low, high) = (DVec3::from_array(region.low), DVec3::from_array(region.high));
    (0..attempts).find_map(|attempt| {
        let w = words(bed.seed, purpose, grain.id, look * attempts + attempt);
        let draw = |word: u32| f64::from(word) / f64::from(u32::MAX);
        let point = low + (high - low) * DVec3::new(draw(w[0]), 0.0, draw(w[1]));
        let cell = stage.cell(&bed.grid, point)?;
        bed.fits(grain.kind, cell).then_some(cell)
    })
}

/// Given places: the nearest cells.
fn at(key: &str, position: &[[f64; 3]], own: &[Grain], stage: &Stage, bed: &mut Bed, remarks: &mut Remarks) {
    let mut farthest = 0.0_f64;
    for (index, (point, grain)) in position.iter().zip(own).enumerate() {
        let point = DVec3::from_array(*point);
        let cell = stage.cell(&bed.grid, point).filter(|&cell| bed.fits(grain.kind, cell));
        let Some(cell) = cell else {
            remarks.refuse(
                format!("{key}.at.position[{index}]"),
                "its nearest lattice point has no room: it overlaps a wall or another grain there; move it, or choose a smaller `cl-ca.spacing`",
            );
            continue;
        };
        farthest = farthest.max((stage.position(bed.vector(cell)) - point).length());
        bed.add(grain.kind, cell, grain.id);
    }
    if farthest > 1e-6 * stage.spacing {
        remarks.approximate(
            format!("{key}.at.position"),
            format!("taken to the nearest lattice point, at most {:.3} mm away", 1e3 * farthest),
        );
    }
}

/// Rows from the floor of a region up, a spacing or two between grains, drawn for each.
fn rows(key: &str, own: &[Grain], region: &Region, stage: &Stage, bed: &mut Bed, remarks: &mut Remarks) {
    let Some(kind) = own.first().map(|grain| grain.kind) else { return };
    let ends = |of: fn(&crate::lattice::direction::Vector) -> i64| {
        let values = || bed.kinds[kind].shape.points().iter().map(of);
        values().max().unwrap_or(0) - values().min().unwrap_or(0)
    };
    let (wide, high) = (ends(|p| p.h) as usize + 2, ends(|p| p.k) as usize / 2 + 2);
    let corner = |point: [f64; 3]| {
        let at = stage.vector(DVec3::from_array(point) - stage.origin);
        let inside = |value: i64, end: usize| usize::try_from(value).unwrap_or(0).min(end - 1);
        (inside(at.h, bed.grid.columns()), inside(at.k.div_euclid(2), bed.grid.rows()))
    };
    let ((left, bottom), (right, top)) = (corner(region.low), corner(region.high));
    let mut waiting = own.iter();
    let mut next = waiting.next();
    let mut row = bottom;
    while row <= top && next.is_some() {
        let mut column = left;
        let mut any = false;
        while let Some(grain) = next.filter(|_| column <= right) {
            let draw = words(bed.seed, Purpose::Placement, grain.id, 0);
            let cell = bed.grid.index(column, row);
            if bed.grid.at(cell) == EMPTY && bed.fits(grain.kind, cell) {
                bed.add(grain.kind, cell, grain.id);
                any = true;
                next = waiting.next();
                column += wide + (draw[0] & 1) as usize;
            } else {
                column += 1;
            }
        }
        row += if any { high } else { 1 };
    }
    if next.is_some() {
        remarks.refuse(
            key,
            format!("{} of {} grains find no room; enlarge the box or the region", waiting.len() + 1, own.len()),
        );
    }
}
