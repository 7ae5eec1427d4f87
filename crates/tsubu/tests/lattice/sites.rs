//! Models with one grain a site, on random ground with random walls and outlets: nobody twice on a site, nobody lost but
//! through an outlet, every move to a neighbour.

use proptest::prelude::*;
use tsubu::lattice::caram_hong::{CaramHong, Chances};
use tsubu::lattice::direction::Direction;
use tsubu::lattice::grid::Grid;
use tsubu::lattice::gutt_haff::{Grain, LatticeGrains};
use tsubu::lattice::litwiniszyn::Litwiniszyn;
use tsubu::lattice::savage::{Chute, Moves};
use tsubu::lattice::sheet::{EMPTY, Layout, OUT, Sheet, WALL};

/// A sheet with walls and grains strewn over it, and outlets in its lowest row.
fn strewn(layout: Layout, columns: usize, rows: usize, coins: &[u8], full: u8) -> Sheet {
    let mut sheet = Sheet::new(layout, columns, rows);
    let mut grain = 0;
    for site in 0..sheet.cells.len() {
        let coin = coins[site % coins.len()];
        if sheet.cells[site] == EMPTY {
            sheet.cells[site] = match coin {
                0..10 => WALL,
                _ if coin % 100 < full => {
                    grain += 1;
                    grain - 1
                }
                _ => EMPTY,
            };
        } else if sheet.column_and_row(site).1 == 0 && coin < 85 {
            sheet.cells[site] = OUT;
        }
    }
    sheet
}

/// Where every grain is; `None`: gone. Panics if one is on two sites.
fn seats(sheet: &Sheet, count: usize) -> Vec<Option<usize>> {
    let mut seats = vec![None; count];
    for (site, &cell) in sheet.cells.iter().enumerate() {
        if let Ok(grain) = usize::try_from(cell) {
            assert!(seats[grain].replace(site).is_none(), "grain {grain} on two sites");
        }
    }
    seats
}

/// Grains move by at most `reach` spacings, walls stay, and whoever is gone was next to an outlet.
fn moved(before: &Sheet, after: &Sheet, count: usize, reach: f64, wrap: f64) {
    for (grain, (from, to)) in seats(before, count).into_iter().zip(seats(after, count)).enumerate() {
        let Some(from) = from else {
            assert!(to.is_none(), "grain {grain} came back");
            continue;
        };
        let [x, z] = before.point(from);
        let far = |site: usize| {
            let [u, v] = before.point(site);
            let dx = (u - x).abs();
            dx.min(wrap - dx).hypot(v - z)
        };
        match to {
            Some(to) => assert!(far(to) < reach + 1e-9, "grain {grain} moved by {}", far(to)),
            None => assert!(before.sites(OUT).any(|out| far(out) < reach + 1e-9), "grain {grain} vanished"),
        }
    }
    for content in [WALL, OUT] {
        assert!(before.sites(content).eq(after.sites(content)), "walls or outlets moved");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn voids_after_caram_and_hong_keep_their_invariants(
        columns in 4_usize..140, rows in 4_usize..20, coins in proptest::collection::vec(any::<u8>(), 97..300),
        full in 20_u8..100, left in 0.0..=1.0_f64, rate in 0.0..=1.0_f64, seed in any::<u64>(),
    ) {
        let sheet = strewn(Layout::Triangular, columns, rows, &coins, full);
        let count = sheet.grains();
        let mut model = CaramHong::new(sheet, Chances { left, rate }, seed);
        for _ in 0..30 {
            let before = model.sheet.clone();
            let mut arrived = 0;
            model.advance(&mut |_| arrived += 1);
            moved(&before, &model.sheet, count, 1.0, f64::INFINITY);
            let fell = seats(&before, count).iter().zip(seats(&model.sheet, count)).filter(|(a, b)| **a != *b).count();
            prop_assert_eq!(fell, arrived);
        }
    }

    #[test]
    fn walks_of_voids_keep_their_invariants(
        columns in 4_usize..60, rows in 4_usize..40, coins in proptest::collection::vec(any::<u8>(), 97..300),
        full in 20_u8..100, left in 0.0..=1.0_f64, seed in any::<u64>(),
    ) {
        let mut sheet = strewn(Layout::Triangular, columns, rows, &coins, full);
        // One outlet: each grain moves once at most while a void walks.
        let outs: Vec<usize> = sheet.sites(OUT).skip(1).collect();
        for site in outs {
            sheet.cells[site] = WALL;
        }
        let count = sheet.grains();
        let mut model = Litwiniszyn::new(sheet, left, 1.0, seed);
        for _ in 0..30 {
            let before = model.sheet.clone();
            model.advance(&mut |_| ());
            moved(&before, &model.sheet, count, 1.0, f64::INFINITY);
        }
    }

    #[test]
    fn chutes_after_savage_keep_their_invariants(
        columns in 4_usize..40, rows in 4_usize..20, coins in proptest::collection::vec(any::<u8>(), 97..300),
        full in 20_u8..100, chances in proptest::array::uniform4(0.0..=1.0_f64), slope in -1.0..=1.0_f64,
        wraps in any::<bool>(), seed in any::<u64>(),
    ) {
        // Columns that wrap must be even, or neighbours across the seam would be of one parity.
        let columns = columns / 2 * 2;
        let sheet = strewn(Layout::Square, columns, rows, &coins, full);
        let count = sheet.grains();
        let [down, diagonal, sideways, up] = chances;
        let sieve = (0..count).map(|grain| if grain % 2 == 0 { 1.0 } else { 0.5 }).collect();
        let mut model = Chute::new(sheet, sieve, Moves { down, diagonal, sideways, up }, slope, wraps, seed);
        let wrap = if wraps { columns as f64 - 2.0 } else { f64::INFINITY };
        for _ in 0..30 {
            let before = model.sheet.clone();
            model.advance();
            moved(&before, &model.sheet, count, 2.0_f64.sqrt(), wrap);
        }
    }

    #[test]
    fn lattice_grains_keep_their_invariants(
        columns in 2_usize..20, rows in 2_usize..20, coins in proptest::collection::vec(any::<u8>(), 97..300),
        full in 5_u8..100, restitution in 0.0..=1.0_f64, speed in 0.0..0.4_f64, gravity in 0.0..1e-4_f64,
        seed in any::<u64>(),
    ) {
        let mut grid = Grid::new(columns + 2, rows + 2);
        grid.paint_box(columns, 1, rows);
        let mut grains = Vec::new();
        for (n, (column, row)) in (1..=columns).flat_map(|c| (1..=rows).map(move |r| (c, r))).enumerate() {
            let coin = f64::from(coins[n % coins.len()]);
            if coin < 2.55 * f64::from(full) {
                let velocity = [speed * (coin / 128.0 - 1.0), speed * (0.5 - coin / 256.0)];
                grains.push(Grain { node: grid.index(column, row), velocity, ..Grain::default() });
            }
        }
        let mut model = LatticeGrains::new(grid, grains, gravity, [restitution; 2], seed);
        for _ in 0..30 {
            let before = model.clone();
            model.advance().unwrap();
            let now = model.momentum();
            let then = before.momentum();
            let walls = model.pushes.iter().fold([0.0, 0.0], |s, p| [s[0] + p.impulse[0], s[1] + p.impulse[1]]);
            let weight = gravity * model.grains.len() as f64;
            prop_assert!((now[0] + walls[0] - then[0]).abs() < 1e-10);
            prop_assert!((now[1] + walls[1] + weight - then[1]).abs() < 1e-10);
            for (number, (old, new)) in before.grains.iter().zip(&model.grains).enumerate() {
                prop_assert_eq!(model.grid.at(new.node), number as i32);
                let column = model.grid.column_and_row(old.node).0;
                let near = Direction::ALL.map(|d| model.grid.neighbour(old.node, column, d));
                prop_assert!(old.node == new.node || near.contains(&new.node));
            }
            let taken = (0..(columns + 2) * (rows + 2)).filter(|&cell| model.grid.at(cell) >= 0).count();
            prop_assert_eq!(taken, model.grains.len());
        }
    }
}
