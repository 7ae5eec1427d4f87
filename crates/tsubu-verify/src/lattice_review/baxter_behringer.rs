//! elongated grains in a hopper, after Baxter and Behringer.

use super::super::bench::within;
use super::super::control::refused;
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::lattice::direction::Direction;
use tsubu::lattice::gas::collide::{REST, SLOTS};
use tsubu::lattice::gas::elongated::Alignment;
use tsubu::lattice::gas::grains::{Grains, Habits};
use tsubu::random::{Purpose, words};
use tsubu_frame::{Claim, Source};

const SOURCE: Source = own("Baxter and Behringer 1990, from memory; rules after them").after();
const COLUMNS: usize = 60;
const ROWS: usize = 160;
/// Rows of the throat, and of the end of the slope.
const THROAT: usize = 40;
const SHOULDER: usize = 110;

/// Half the width of the hopper at a height [columns].
fn half_width(row: usize) -> f64 {
    match row {
        ..34 | SHOULDER.. => 28.0,
        34..THROAT => 6.0,
        _ => 6.0 + 22.0 * (row - THROAT) as f64 / (SHOULDER - THROAT) as f64,
    }
}

fn from_middle(column: usize) -> f64 {
    (column as f64 - 0.5 * (COLUMNS - 1) as f64).abs()
}

/// How a hopper is made.
#[derive(Clone, Copy)]
struct Make {
    /// Share of the walls' sites that send grains back.
    roughness: f64,
    /// Whether the throat is shut.
    shut: bool,
    /// Of its grains, and of what happens to them.
    seed: u64,
}

/// The hopper of the claims.
const HOPPER: Make = Make { roughness: 1.0, shut: false, seed: 1 };

/// A hopper; what falls out below comes in above. Two grains a site at first.
fn hopper(elongated: bool, Make { roughness, shut, seed }: Make) -> Grains {
    let habits = Habits { gravity: 0.2, dissipation: 0.3, roughness };
    let mut grains = Grains::new(COLUMNS, ROWS, [true, true], habits, seed);
    for column in 0..COLUMNS {
        for row in 0..ROWS {
            if from_middle(column) > half_width(row) || shut && row == 33 {
                grains.set_wall(column, row, Some(0));
            } else if row > THROAT {
                let drawn = words(seed, Purpose::Placement, (column * ROWS + row) as u32, 0);
                let there = |slot: &usize| drawn[slot % 4].rotate_left(5 * *slot as u32) < u32::MAX / 7 * 2;
                grains.set_site(column, row, (0..SLOTS).filter(there).map(|slot| 1 << slot).sum());
            }
        }
    }
    if elongated {
        grains.number();
        grains.elongate();
    }
    grains
}

/// What was seen in steps 400 to 1400.
#[derive(Default)]
struct Seen {
    /// Share of upright grains in the throat, and above the slope.
    throat: f64,
    above: f64,
    /// Shares of upright grains between the upright walls above the slope: within four columns of a wall, and in the middle.
    shoulder: [f64; 2],
    /// Mean speed down in the lower half of the slope: in the middle, and within three columns of the walls.
    middle: f64,
    corner: f64,
    /// Grains that pass the throat in a step.
    flow: f64,
    /// Sites in the end.
    sites: Vec<u8>,
}

fn run(alignment: Option<Alignment>, make: Make) -> Seen {
    let mut grains = hopper(alignment.is_some(), make);
    let (mut upright, mut speed, mut flow, mut looks) = ([[0.0; 2]; 2], [[0.0; 2]; 2], 0.0, 0.0);
    let mut sides = [[0.0; 2]; 2];
    let inside: Vec<(usize, usize)> = (0..COLUMNS).flat_map(|c| (0..ROWS).map(move |r| (c, r))).collect();
    while grains.steps() < 1400 {
        grains.step();
        if let Some(alignment) = alignment {
            grains.align(alignment);
        }
        if grains.steps() < 400 || !grains.steps().is_multiple_of(20) {
            continue;
        }
        looks += 1.0;
        for &(column, row) in inside.iter().filter(|(c, r)| !grains.is_wall(*c, *r)) {
            for slot in (0..SLOTS).filter(|slot| grains.site(column, row) >> slot & 1 == 1) {
                let down = if slot == REST { 0.0 } else { -0.5 * Direction::from_index(slot).k() as f64 };
                let zone = if (34..THROAT).contains(&row) { Some(0) } else { (row > SHOULDER).then_some(1) };
                let to_wall = half_width(row) - from_middle(column);
                if let (Some(zone), Some(axis)) = (zone, grains.axis(column, row, slot)) {
                    let beside = zone == 1 && to_wall < 4.0;
                    let apart = zone == 1 && from_middle(column) < 4.0;
                    let [walls, middle] = &mut sides;
                    for (sums, here) in [(&mut upright[zone], true), (walls, beside), (middle, apart)] {
                        if here {
                            sums[0] += f64::from(axis == 0);
                            sums[1] += 1.0;
                        }
                    }
                }
                if (34..THROAT).contains(&row) {
                    flow += down / (THROAT - 34) as f64;
                }
                if (50..75).contains(&row) && (to_wall < 3.0 || from_middle(column) < 3.0) {
                    let zone = usize::from(to_wall < 3.0);
                    speed[zone][0] += down;
                    speed[zone][1] += 1.0;
                }
            }
        }
    }
    let share = |pair: [f64; 2]| pair[0] / pair[1];
    let sites = inside.iter().map(|(c, r)| grains.site(*c, *r)).collect();
    let [throat, above] = upright.map(share);
    let [middle, corner] = speed.map(share);
    Seen { throat, above, shoulder: sides.map(share), middle, corner, flow: flow / looks, sites }
}

/// Grains that like to lie along their way stand upright where the hopper narrows; nothing else changes.
pub(crate) fn hopper_order(perturbation: f64) -> Judged {
    ensemble::drawn("hopper", 1..=3, |seed| {
        let hopper = Make { seed, ..HOPPER };
        // The perturbation heats the grains.
        let temperature = 1.0 / perturbation.powi(60);
        let with = run(Some(Alignment { neighbours: 0.5, way: 1.0, temperature }), hopper);
        let without = run(Some(Alignment { neighbours: 0.0, way: 0.0, temperature: 1.0 }), hopper);
        let round = run(None, hopper);
        let (smooth, shut) = (run(None, Make { roughness: 0.0, ..hopper }), run(None, Make { shut: true, ..hopper }));
        let gates = |seen: &Seen| {
            [
                Claim::judge("hopper: share of upright grains in the throat", seen.throat, Some(0.8), None, SOURCE),
                Claim::judge(
                    "hopper: that share less the one above the slope",
                    seen.throat - seen.above,
                    Some(0.05),
                    None,
                    SOURCE,
                ),
            ]
        };
        let alike = |seen: &Seen| {
            let differ = seen.sites.iter().zip(&round.sites).filter(|(a, b)| a != b).count();
            let source = closed_form("grains that are alike on all sides are those after Peng and Herrmann");
            [
                within(
                    "hopper: share of upright grains in the throat without alignment",
                    seen.throat,
                    1.0 / 3.0,
                    0.03,
                    closed_form("symmetry"),
                ),
                within("hopper: sites that differ from round grains", differ as f64, 0.0, 0.0, source),
            ]
        };
        let flow = |seen: &Seen| {
            Claim::judge("hopper: grains through the throat in a step", seen.flow, Some(1.0), None, SOURCE)
        };
        let slow = |seen: &Seen| {
            let name = "hopper: speed near the walls of the slope over that in the middle";
            Claim::judge(name, seen.corner / seen.middle, None, Some(0.6), SOURCE)
        };
        let mut claims = gates(&with).to_vec();
        claims.push(refused("no alignment", &gates(&without), 2));
        claims.extend(alike(&without));
        claims.push(refused("grains that align", &alike(&with)[..1], 1));
        claims.extend([flow(&with), slow(&with)]);
        claims.push(refused("smooth walls", &[slow(&smooth), alike(&smooth)[1].clone()], 2));
        claims.push(refused("a throat that is shut", &[flow(&shut)], 1));
        Ok(claims)
    })
}

/// Order was to grow near walls as well as along the slope.
pub(crate) fn hopper_walls(perturbation: f64) -> Judged {
    ensemble::drawn("walls of the hopper", 1..=3, |seed| {
        let hopper = Make { seed, ..HOPPER };
        let gate = |alignment: Alignment| {
            let [walls, middle] = run(Some(alignment), hopper).shoulder;
            let name = "hopper, above the slope: share of upright grains within four columns of the walls less that in the middle";
            Claim::judge(name, walls - middle, Some(0.1), None, SOURCE)
        };
        let temperature = 1.0 / perturbation.powi(60);
        Ok(vec![
            gate(Alignment { neighbours: 0.5, way: 1.0, temperature }),
            refused("no alignment", &[gate(Alignment { neighbours: 0.0, way: 0.0, temperature: 1.0 })], 1),
        ])
    })
}
