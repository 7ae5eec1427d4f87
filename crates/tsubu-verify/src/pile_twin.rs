//! Forces in a pile, row by row and by DEM (spec of the review: R-5, point 5).
//!
//! First the very same pile: discs without friction in the rows of the automaton. Then a heap that was poured, beside a pile
//! of its slope. The perturbation multiplies what the grains of the automaton weigh below the middle.

use super::bench::{Rig, at_least, between, within};
use super::control::refused;
use super::ensemble;
use super::pile_stress::{BALANCE, base};
use crate::case::Judged;
use crate::origin::{closed_form, own};
use std::fmt::Write as _;
use tsubu::lattice::hemmingsson_herrmann::{Rule, Split};
use tsubu::lattice::sheet::{Layout, Sheet};
use tsubu::view::{Contacts, Wants};
use tsubu_frame::Claim;

/// Grains in the lowest row of the same pile.
const SIZE: usize = 20;
/// Diameter of its discs, and distance of those of the floor: a little more, so that neighbours in a row stay apart [m].
const DISC: [f64; 2] = [4e-3, 4.04e-3];

/// The same pile by DEM: loads of the lowest row over the weight of a grain, level and down.
fn same(friction: f64) -> Result<Vec<[f64; 2]>, String> {
    let [diameter, spacing] = DISC;
    let rise = (diameter * diameter - 0.25 * spacing * spacing).sqrt();
    let place = |row: usize, i: usize| {
        let x = (i as f64 + 0.5 * row as f64) * spacing;
        format!("[{x:.9}, {:.9}]", rise * row as f64)
    };
    let floor: Vec<String> = (0..=SIZE).map(|i| place(0, i)).collect();
    let pile: Vec<String> = (1..=SIZE).flat_map(|row| (0..=SIZE - row).map(move |i| place(row, i))).collect();
    let mut rig = Rig::new(
        &format!(
            r#"
            title = "a pile of discs in rows"
            duration = 0.2
            [materials.m]
            density = 2700
            young-modulus = 1e9
            restitution = 0.3
            friction = {friction}
            [particles.floor]
            material = "m"
            diameter = {diameter}
            motion.frozen = {{}}
            start.at.position = [{}]
            [particles.pile]
            material = "m"
            diameter = {diameter}
            start.at.position = [{}]
            "#,
            floor.join(", "),
            pile.join(", ")
        ),
        1.0,
    )?;
    rig.until(0.2)?;
    let weight = rig.plan.particles["pile"].mass * -rig.plan.gravity[2];
    let view = rig.engine.view(Wants { contacts: Contacts::Forces, ..Wants::GRAINS });
    // Grains are seen in some order; ids tell floor and rows apart, left to right.
    let id = |grain: usize| view.grains.id[grain] as usize;
    let mut loads = vec![[0.0; 2]; SIZE];
    for contact in &view.contacts {
        for (grain, other, sign) in [(contact.first, contact.second, 1.0), (contact.second, contact.first, -1.0)] {
            if id(other) <= SIZE && (SIZE + 1..=2 * SIZE).contains(&id(grain)) {
                let load = &mut loads[id(grain) - SIZE - 1];
                load[0] -= sign * contact.force.x / weight;
                load[1] += sign * contact.force.z / weight;
            }
        }
    }
    Ok(loads)
}

/// Gates on the lowest row of a pile without friction, whose contacts lean by a tangent.
fn flat(name: &str, loads: &[[f64; 2]], tangent: f64) -> Vec<Claim> {
    let size = loads.len() as f64;
    let source = closed_form("closed form, any lean: (N+1) w/2 down, (N+1-2i) w/2 times its tangent outwards");
    let down = loads.iter().map(|l| (l[1] / (0.5 * (size + 1.0)) - 1.0).abs()).fold(0.0, f64::max);
    let level = |i: usize, x: f64| (x + 0.5 * (size - 1.0 - 2.0 * i as f64) * tangent).abs() / (0.5 * size * tangent);
    let out = loads.iter().enumerate().map(|(i, l)| level(i, l[0])).fold(0.0, f64::max);
    vec![
        within(format!("{name}: load of base grains, worst"), down, 0.0, 0.01, source),
        within(format!("{name}: level force of base grains, worst, over the largest"), out, 0.0, 0.01, source),
    ]
}

/// What stands on a floor: places from the axis and loads of its grains in order from the left, places of all grains, each
/// with its weight, and heights.
struct Heap {
    floor: Vec<(f64, f64)>,
    grains: Vec<[f64; 3]>,
}

/// Bands of the half-width in which loads are summed.
const BANDS: usize = 5;

impl Heap {
    fn weight(&self) -> f64 {
        self.grains.iter().map(|g| g[2]).sum()
    }

    /// Mean of a quantity of the grains by weight.
    fn mean(&self, of: impl Fn(&[f64; 3]) -> f64) -> f64 {
        self.grains.iter().map(|g| g[2] * of(g)).sum::<f64>() / self.weight()
    }

    /// Half of the base of the triangle with the mean distance from the axis.
    fn half(&self) -> f64 {
        3.0 * self.mean(|g| g[0].abs())
    }

    /// Slope of that triangle.
    fn tangent(&self) -> f64 {
        self.mean(|g| g[1]) / self.mean(|g| g[0].abs())
    }

    /// Loads over the mean of nine neighbours, away from the foot.
    fn relative(&self) -> impl Iterator<Item = f64> {
        let near = self.floor.windows(9).filter(|nine| nine[4].0.abs() < 0.6 * self.half());
        near.map(|nine| nine[4].1 * 9.0 / nine.iter().map(|f| f.1).sum::<f64>())
    }
}

/// What heaps of one kind carry, all together.
struct Carried {
    /// Load on the floor over weight.
    total: f64,
    /// Load of the band round the axis over the weight straight above it.
    axis: f64,
    /// How far the load round the axis lies below the highest of a band, over the mean.
    dip: f64,
    /// Standard deviation of the loads over the mean of nine neighbours.
    spread: f64,
    /// Share of the loads below 0.5, 1 and 2 of it.
    below: [f64; 3],
}

impl Carried {
    fn of(heaps: &[Heap]) -> Self {
        let (mut loads, mut above, mut total) = ([0.0; BANDS], 0.0, 0.0);
        for heap in heaps {
            let band = |x: f64| (x.abs() / heap.half() * BANDS as f64) as usize;
            let share = 1.0 / (heap.weight() * heaps.len() as f64);
            for (x, load) in &heap.floor {
                total += load * share;
                if let Some(sum) = loads.get_mut(band(*x)) {
                    *sum += load * share;
                }
            }
            above += heap.grains.iter().filter(|g| band(g[0]) == 0).map(|g| g[2] * share).sum::<f64>();
        }
        let relative: Vec<f64> = heaps.iter().flat_map(Heap::relative).collect();
        let count = relative.len() as f64;
        let highest = loads.iter().copied().fold(0.0, f64::max);
        Self {
            total,
            axis: loads[0] / above,
            dip: (highest - loads[0]) * BANDS as f64,
            spread: (relative.iter().map(|x| (x - 1.0).powi(2)).sum::<f64>() / count).sqrt(),
            below: SHARES.map(|end| relative.iter().filter(|x| **x < end).count() as f64 / count),
        }
    }
}

const SHARES: [f64; 3] = [0.5, 1.0, 2.0];

/// A heap of discs poured onto a floor from above its middle, after some time [s]; it rests after 3.5.
fn poured(seed: u64, until: f64) -> Result<Heap, String> {
    let mut rig = Rig::new(
        &format!(
            r#"
            title = "a poured heap"
            duration = 3.5
            seed = {seed}
            [materials.m]
            density = 2700
            young-modulus = 2e7
            restitution = 0.3
            friction = 0.5
            rolling-friction = 0.2
            [particles.discs]
            material = "m"
            count = 600
            size.uniform = {{ smallest = 2.778e-3, largest = 4.577e-3 }}
            shape.disc.thickness = 0.006
            start.stream = {{ region = {{ low = [-0.008, 0.07], high = [0.008, 0.09] }}, rate = 250 }}
            [walls.floor]
            material = "m"
            shape.plane.point = [0, 0]
            [contact]
            rolling.epsd = {{}}
            "#
        ),
        1.0,
    )?;
    rig.until(until)?;
    let gravity = -rig.plan.gravity[2];
    let view = rig.engine.view(Wants { contacts: Contacts::Forces, ..Wants::GRAINS });
    let at = |grain: usize| view.grains.position[grain];
    let mass = |grain: usize| view.grains.mass[grain];
    let total: f64 = (0..view.len()).map(mass).sum();
    let axis = (0..view.len()).map(|grain| mass(grain) * at(grain).x).sum::<f64>() / total;
    let mut floor: Vec<(f64, f64)> = view
        .contacts
        .iter()
        .filter(|contact| contact.wall)
        .map(|contact| (contact.position.x - axis, contact.force.z))
        .collect();
    floor.sort_by(|a, b| a.0.total_cmp(&b.0));
    let lowest = (0..view.len()).map(|grain| at(grain).z).fold(f64::INFINITY, f64::min);
    let grains = (0..view.len()).map(|g| [at(g).x - axis, at(g).z - lowest, mass(g) * gravity]).collect();
    Ok(Heap { floor, grains })
}

/// A pile of a slope over `size` grains by the automaton.
fn piled(size: usize, tangent: f64, rule: Rule, seed: u64, perturbation: f64) -> Heap {
    let rows = (0.5 * size as f64 * tangent) as usize + 4;
    let mut sheet = Sheet::new(Layout::Triangular, size + 4, rows);
    let [first, low] = sheet.point(sheet.index(2, 1));
    let axis = first + 0.5 * (size as f64 - 1.0);
    let mut grains = Vec::new();
    for site in 0..sheet.cells.len() {
        let [x, z] = sheet.point(site);
        let inside = z >= low - 1e-9 && (x - axis).abs() < 0.5 * size as f64 - (z - low) / tangent;
        if inside && (1..rows - 1).contains(&sheet.column_and_row(site).1) {
            sheet.cells[site] = grains.len() as i32;
            grains.push([x - axis, z - low, 1.0]);
        }
    }
    let count = grains.len();
    grains[..count / 2].iter_mut().for_each(|grain| grain[2] = perturbation);
    let seats: Vec<f64> = grains.iter().filter(|grain| grain[1] < 0.1).map(|grain| grain[0]).collect();
    let loads = base(sheet, rule, seed, perturbation).0;
    Heap { floor: seats.into_iter().zip(loads).map(|(x, load)| (x, load[1])).collect(), grains }
}

/// Heaps by DEM that are looked at together.
const HEAPS: u64 = 5;

/// R-5, point 5: the automaton beside DEM.
pub(super) fn twin(perturbation: f64) -> Judged {
    ensemble::drawn("heaps", 0..=29, |set| {
        let tangent = 0.5 * DISC[1] / (DISC[0] * DISC[0] - 0.25 * DISC[1] * DISC[1]).sqrt();
        let mut claims = flat("the same pile by DEM", &same(0.0)?, tangent);
        claims.push(refused("discs that rub", &flat("", &same(0.5)?, tangent), 2));
        let falling = Carried::of(&[poured(HEAPS * set + 1, 1.5)?]).total;
        let poured = (1..=HEAPS).map(|heap| poured(HEAPS * set + heap, 3.5)).collect::<Result<Vec<Heap>, String>>()?;
        let slope = poured.iter().map(Heap::tangent).sum::<f64>() / poured.len() as f64;
        let size = poured.iter().map(|heap| heap.floor.len()).sum::<usize>() / poured.len();
        let dem = Carried::of(&poured);
        let by = |rule: Rule| {
            Carried::of(
                &(1..=50).map(|pile| piled(size, slope, rule, 50 * set + pile, perturbation)).collect::<Vec<_>>(),
            )
        };
        let balance = by(BALANCE);
        let arched = by(Rule { arching: 0.3, ..BALANCE });
        let random = by(Rule { split: Split::Random, ..BALANCE });
        let rests = |total: f64| {
            let source = closed_form("balance of forces: at rest");
            within("poured heap by DEM: base load over weight", total, 1.0, 0.01, source)
        };
        let carries = |total: f64| {
            within("pile of its slope: base load over weight", total, 1.0, 1e-9, closed_form("balance of forces"))
        };
        claims.extend([rests(dem.total), carries(balance.total)]);
        claims.push(refused("a heap that is still poured", &[rests(falling)], 1));
        let mut light = piled(size, slope, BALANCE, 1, 0.95);
        light.grains.iter_mut().for_each(|grain| grain[2] = 1.0);
        claims.push(refused(
            "grains of which half weigh 5 % less than they are said to",
            &[carries(Carried::of(&[light]).total)],
            1,
        ));
        let twin = own("five heaps of 600 discs poured by DEM; a third either way").after();
        let spread = |name: &str, of: &Carried| {
            between(format!("{name}: spread of base loads over that by DEM"), of.spread / dem.spread, 0.67, 1.5, twin)
        };
        let shares = |name: &str, of: &Carried| -> Vec<Claim> {
            let each = SHARES.iter().zip(of.below.iter().zip(dem.below));
            each.map(|(end, (share, dem))| {
                let mut text = name.to_owned();
                let _ = write!(text, ": share of base loads below {end} of their neighbours' mean, less that by DEM");
                within(
                    text,
                    share - dem,
                    0.0,
                    0.1,
                    own("five heaps of 600 discs poured by DEM; 0.1 either way").after(),
                )
            })
            .collect()
        };
        claims.extend(shares("random shares", &random));
        claims.push(spread("random shares", &random));
        claims.push(spread("arching 0.3", &arched));
        let mut wrong = shares("", &balance);
        wrong.push(spread("", &balance));
        claims.push(refused("a balance in which neighbours carry alike", &wrong, 2));
        let profile = |name: &str, of: &Carried| {
            [
                between(
                    format!("{name}: load round the axis over the weight above it, over the same by DEM"),
                    of.axis / dem.axis,
                    0.8,
                    1.25,
                    own("five heaps of 600 discs poured by DEM; a quarter either way").after(),
                ),
                within(
                    format!("{name}: dip over the mean load, less that by DEM"),
                    of.dip - dem.dip,
                    0.0,
                    0.2,
                    own("five heaps of 600 discs poured by DEM; 0.2 either way").after(),
                ),
            ]
        };
        claims.extend(profile("balance", &balance));
        claims.extend(profile("arching 0.3", &arched));
        let hollow = by(Rule { arching: 1.0, ..BALANCE });
        claims.push(refused("arching 1: every grain gives all it carries outwards", &profile("", &hollow), 1));
        claims.push(at_least(
            "poured heap by DEM: dip over the mean load",
            dem.dip,
            0.1,
            own("heaps of sand poured from a point have one (what the automata were made for)").after(),
        ));
        Ok(claims)
    })
}
