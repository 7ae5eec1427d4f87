//! The lattice grain model of Gutt and Haff (spec of the review: R-4).
//!
//! The perturbation multiplies restitution.

use super::bench::{between, within};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::lattice::grid::Grid;
use tsubu::lattice::gutt_haff::{Grain, LatticeGrains};
use tsubu::random::{Purpose, unit, words};
use tsubu_frame::Claim;

const SPACING: f64 = 6e-3;
const GRAVITY: f64 = 10.0;

/// A box of so many columns and rows.
fn boxed(columns: usize, rows: usize) -> Grid {
    let mut grid = Grid::new(columns + 2, rows + 2);
    grid.paint_box(columns, 1, rows);
    grid
}

/// Gravity in spacings a step squared.
fn gravity(dt: f64) -> f64 {
    GRAVITY * dt * dt / SPACING
}

/// Height of a grain over row 0 [m].
fn height(model: &LatticeGrains, grain: usize) -> f64 {
    let grain = model.grains[grain];
    SPACING * (0.5 * model.grid.half_height(grain.node) as f64 + grain.offset[1])
}

/// Height and time of the apex after each of eight impacts of a ball dropped by 90 mm.
fn rebounds(column: usize, dt: f64, restitution: f64) -> Result<Vec<(f64, f64)>, String> {
    let grid = boxed(9, 30);
    let floor = SPACING * 0.5 * grid.half_height(grid.index(column, 1)) as f64;
    let ball = Grain { node: grid.index(column, 16), ..Grain::default() };
    let mut model = LatticeGrains::new(grid, vec![ball], gravity(dt), [restitution; 2], 1);
    let (mut apexes, mut best, mut rose) = (Vec::new(), (0.0, 0.0), false);
    while apexes.len() < 8 && model.step as f64 * dt < 2.0 {
        model.advance().map_err(|fast| format!("{fast:?}"))?;
        let rises = model.grains[0].velocity[1] > 0.0;
        let now = height(&model, 0) - floor;
        if rises && (!rose || now > best.0) {
            best = (now, model.step as f64 * dt);
        } else if rose && !rises {
            apexes.push(best);
        }
        rose = rises;
    }
    Ok(apexes)
}

/// Gates on the rebounds: heights e^(2k) of the drop within 4 %, times within 1 %.
fn drop_gates(name: &str, found: &[(f64, f64)]) -> Vec<Claim> {
    let (drop, e) = (0.09, 0.75_f64);
    let fall = (2.0 * drop / GRAVITY).sqrt();
    let mut claims = Vec::new();
    for k in 1..=8 {
        let (height, time) = found.get(k - 1).copied().unwrap_or((f64::NAN, f64::NAN));
        let closed = fall * (1.0 + 2.0 * (1..k as i32).map(|i| e.powi(i)).sum::<f64>() + e.powi(k as i32));
        let source = closed_form("closed form h e^(2k); Komatsuzaki 2003, figure 8, has four");
        let share = height / (drop * e.powi(2 * k as i32));
        claims.push(within(format!("{name}: apex {k} over closed form"), share, 1.0, 0.04, source));
        claims.push(within(format!("{name}: time of apex {k} over closed form"), time / closed, 1.0, 0.01, source));
    }
    claims
}

/// free fall, rebounds beyond the fourth, momentum.
pub(super) fn drop(perturbation: f64) -> Judged {
    let mut claims = drop_gates("lattice grain dropped on a low node", &rebounds(4, 1e-4, 0.75 * perturbation)?);
    claims.extend(drop_gates("lattice grain dropped on a high node", &rebounds(5, 1e-4, 0.75 * perturbation)?));
    claims.push(refused("restitution 0.7", &drop_gates("", &rebounds(4, 1e-4, 0.7)?), 8));
    let gate = |worst: f64| {
        let name = "lattice grain: free fall, worst distance from g t^2/2 in spacings";
        within(name, worst, 0.0, 1e-12, closed_form("closed form"))
    };
    claims.push(gate(free_fall(1.0)?));
    claims.push(refused("gravity 5 % too large", &[gate(free_fall(1.05)?)], 1));
    claims.push(gas(0.0, perturbation)?);
    claims.push(refused("a pull that the books do not know", &[gas(1e-9, perturbation)?], 1));
    Ok(claims)
}

/// 200 steps of flight under `heavier` gravity against g t^2 / 2: worst distance in spacings.
fn free_fall(heavier: f64) -> Result<f64, String> {
    let dt = 4e-4;
    let grid = boxed(5, 60);
    let start = SPACING * 0.5 * grid.half_height(grid.index(2, 58)) as f64;
    let ball = Grain { node: grid.index(2, 58), ..Grain::default() };
    let mut model = LatticeGrains::new(grid, vec![ball], heavier * gravity(dt), [0.5; 2], 1);
    let mut worst = 0.0_f64;
    for step in 1..=200 {
        model.advance().map_err(|fast| format!("{fast:?}"))?;
        let closed = start - 0.5 * GRAVITY * (f64::from(step) * dt).powi(2);
        worst = worst.max((height(&model, 0) - closed).abs() / SPACING);
    }
    Ok(worst)
}

/// Momentum of a gas in a box, what walls got counted, under a pull [spacings a step squared] that nobody counts.
fn gas(pull: f64, perturbation: f64) -> Result<Claim, String> {
    let grid = boxed(40, 40);
    let mut grains = Vec::new();
    for (number, node) in (5..36).flat_map(|c| (5..36).map(move |r| (c, r))).enumerate() {
        let coin = words(1, Purpose::Placement, number as u32, 0).map(|w| unit(w, 0));
        if coin[0] < 0.4 {
            grains.push(Grain {
                node: grid.index(node.0, node.1),
                velocity: [coin[1] - 0.4, coin[2] - 0.3],
                ..Grain::default()
            });
        }
    }
    let mut model = LatticeGrains::new(grid, grains, pull, [0.8 * perturbation; 2], 1);
    let before = model.momentum();
    let mut walls = [0.0; 2];
    for _ in 0..500 {
        model.advance().map_err(|fast| format!("{fast:?}"))?;
        for push in &model.pushes {
            walls[0] += push.impulse[0];
            walls[1] += push.impulse[1];
        }
    }
    let now = model.momentum();
    let off = (0..2).map(|k| now[k] + walls[k] - before[k]).fold(0.0, |most: f64, x| most.max(x.abs()));
    let name = "lattice grains: momentum that the books miss, masses times spacings a step";
    Ok(within(name, off, 0.0, 1e-11, closed_form("conserved")))
}

/// Load on the floor of a silo, and on all its walls, in rows of weight: the mean of the second half of a run under `heavier` gravity.
fn floor_load(columns: usize, rows: usize, heavier: f64, restitution: f64, seed: u64) -> Result<(f64, f64), String> {
    let grid = boxed(columns, rows + 10);
    let grains: Vec<Grain> = (1..=columns)
        .flat_map(|c| (1..=rows).map(move |r| (c, r)))
        .map(|(c, r)| Grain { node: grid.index(c, r), ..Grain::default() })
        .collect();
    let dt = 1e-4;
    let mut model = LatticeGrains::new(grid, grains, heavier * gravity(dt), [restitution; 2], seed);
    let steps = 12_000;
    let (mut floor, mut all) = (0.0, 0.0);
    for step in 0..steps {
        model.advance().map_err(|fast| format!("{fast:?}"))?;
        if step < steps / 2 {
            continue;
        }
        for push in &model.pushes {
            let column = model.grid.column_and_row(push.node).0;
            all -= push.impulse[1];
            floor -= if (1..=columns).contains(&column) { push.impulse[1] } else { 0.0 };
        }
    }
    let row = columns as f64 * gravity(dt) * f64::from(steps / 2);
    Ok((floor / row, all / row))
}

/// the load on the floor of a silo saturates, as Janssen has it; that of water does not.
pub(super) fn janssen(perturbation: f64) -> Judged {
    ensemble::drawn("silo", 1..=3, |seed| {
        let heights = [10, 20, 40];
        let loads = |columns: usize, heavier: f64| -> Result<Vec<(f64, f64)>, String> {
            heights.iter().map(|rows| floor_load(columns, *rows, heavier, 0.5 * perturbation, seed)).collect()
        };
        let source = own("Janssen 1895: the weight of what lies higher than a few widths goes to the walls").after();
        let gates = |loads: &[(f64, f64)]| {
            let name = |what: &str| format!("lattice grains in a silo: {what}");
            let all = loads[2].1 / 40.0;
            vec![
                within(name("all walls over weight, 40 rows"), all, 1.0, 0.01, closed_form("balance of forces")),
                between(name("floor load over weight, 10 rows"), loads[0].0 / 10.0, 0.55, 0.85, source),
                between(name("floor load at 40 rows over that at 20"), loads[2].0 / loads[1].0, 0.95, 1.15, source),
            ]
        };
        let mut claims = gates(&loads(10, 1.0)?);
        claims.push(refused("gravity 5 % too large", &gates(&loads(10, 1.05)?)[..1], 1));
        claims.push(refused("a silo as wide as it is high", &gates(&loads(60, 1.0)?)[1..], 2));
        Ok(claims)
    })
}
