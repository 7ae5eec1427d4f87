//! Void models of a bed that runs out: Litwiniszyn, and after Caram and Hong (spec of the review: ).
//!
//! The perturbation multiplies the probability that a void goes to the left.

use super::bench::within;
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::{closed_form, own, regression};
use std::ops::Range;
use tsubu::lattice::caram_hong::{CaramHong, Chances};
use tsubu::lattice::litwiniszyn::{Litwiniszyn, SPREAD, frequency};
use tsubu::lattice::sheet::{EMPTY, Layout, OUT, ROW_SPACING, Sheet, WALL};
use tsubu_frame::{Claim, Source};

const CLOSED: Source =
    closed_form("closed form: dP/dy = B d2P/dx2, B = a^2/(2b) (Nedderman and Tuzun 1978, after Litwiniszyn)");
const COLUMNS: usize = 63;
const MIDDLE: usize = 31;

/// A full bed over outlets in its lowest row.
fn bed(columns: usize, rows: usize, outlets: std::ops::RangeInclusive<usize>) -> Sheet {
    let mut sheet = Sheet::new(Layout::Triangular, columns, rows);
    sheet.cells[outlets].fill(OUT);
    sheet.fill(1, rows - 1, 0);
    sheet
}

/// Voids that pass the sites of a row: sum, mean place, variance of place, in spacings.
fn moments(passed: &[f64], sheet: &Sheet, row: usize) -> [f64; 3] {
    let sites = || (0..sheet.columns()).map(|c| sheet.index(c, row)).map(|s| (passed[s], sheet.point(s)[0]));
    let sum: f64 = sites().map(|(p, _)| p).sum();
    let mean = sites().map(|(p, x)| p * x).sum::<f64>() / sum;
    [sum, mean, sites().map(|(p, x)| p * (x - mean).powi(2)).sum::<f64>() / sum]
}

/// Slope of a straight line through points.
pub(super) fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let (above, below) = points
        .iter()
        .fold((0.0, 0.0), |(above, below), (x, y)| (above + (x - x0) * (y - y0), below + (x - x0).powi(2)));
    above / below
}

/// Growth of the variance with height over 2 B, and the mean place at the top of the rows looked at, from the outlet.
fn spreading(passed: &[f64], sheet: &Sheet) -> [f64; 2] {
    let rows: Vec<(f64, f64)> = (2..40).map(|row| (ROW_SPACING * row as f64, moments(passed, sheet, row)[2])).collect();
    [slope(&rows) / (2.0 * SPREAD), moments(passed, sheet, 40)[1] - MIDDLE as f64]
}

/// So many beds, of their own for every set.
fn beds(set: u64, count: u64) -> Range<u64> {
    count * set..count * (set + 1)
}

/// Where the voids of many beds passed; each bed gives `voids` of them.
fn litwiniszyn(sheet: &Sheet, left: f64, seeds: Range<u64>, voids: u64) -> Vec<f64> {
    let mut passed = vec![0.0; sheet.cells.len()];
    for seed in seeds {
        let mut model = Litwiniszyn::new(sheet.clone(), left, 1.0, seed);
        for _ in 0..voids {
            model.advance(&mut |site| passed[site] += 1.0);
        }
    }
    passed
}

/// The same after Caram and Hong.
fn caram_hong(sheet: &Sheet, chances: Chances, seeds: Range<u64>, voids: usize) -> Vec<f64> {
    let mut passed = vec![0.0; sheet.cells.len()];
    for seed in seeds {
        let mut model = CaramHong::new(sheet.clone(), chances, seed);
        let mut left = voids;
        while left > 0 {
            model.advance(&mut |site| {
                passed[site] += 1.0;
                left = left.saturating_sub(usize::from(sheet.column_and_row(site).1 == 1));
            });
        }
    }
    passed
}

/// Gates on how voids of a point outlet spread.
fn spread_gates(name: &str, passed: &[f64], sheet: &Sheet) -> Vec<Claim> {
    let [growth, mean] = spreading(passed, sheet);
    vec![
        within(format!("{name}: growth of the variance over 2 B"), growth, 1.0, 0.02, CLOSED),
        within(
            format!("{name}: mean place 40 rows up, spacings from the outlet"),
            mean,
            0.0,
            0.1,
            closed_form("symmetry"),
        ),
    ]
}

/// (a) spreading, (b) flux against height, (c) wide outlet, (d) reflecting walls, (e) discharge against fill height.
pub(super) fn litwiniszyn_case(perturbation: f64) -> Judged {
    ensemble::drawn("voids", 0..=4, |set| {
        let left = 0.5 * perturbation;
        let sheet = bed(COLUMNS, 102, MIDDLE..=MIDDLE);
        let passed = litwiniszyn(&sheet, left, beds(set, 150), 300);
        let mut claims = spread_gates("Litwiniszyn, voids", &passed, &sheet);
        claims.extend(spread_gates("Litwiniszyn, mean", &frequency(&sheet, left), &sheet));
        let even = |passed: &[f64]| {
            let flux = |row| moments(passed, &sheet, row)[0];
            let uneven = (1..40).map(|row| (flux(row) / flux(1) - 1.0).abs()).fold(0.0, f64::max);
            let name = "Litwiniszyn: flux at 40 heights less that at the outlet";
            within(name, uneven, 0.0, 1e-12, closed_form("no void is lost"))
        };
        claims.push(even(&passed));
        let mut leaking = sheet.clone();
        leaking.cells[sheet.index(MIDDLE + 5, 20)] = OUT;
        claims.push(refused(
            "a second outlet in the middle of the bed",
            &[even(&litwiniszyn(&leaking, left, beds(set, 5), 300))],
            1,
        ));
        claims.push(wide_outlet(left));
        claims.extend(walls_reflect(left));
        claims.extend(discharge(left));
        claims.push(refused(
            "a walk with probabilities 0.6 and 0.4",
            &spread_gates("", &frequency(&sheet, 0.6), &sheet),
            2,
        ));
        Ok(claims)
    })
}

/// (c) An outlet of width w: the difference of two error functions.
fn wide_outlet(left: f64) -> Claim {
    let sheet = bed(121, 82, 53..=67);
    let mean = frequency(&sheet, left);
    let (width, row) = (15.0, 60);
    let scale = (4.0 * SPREAD * ROW_SPACING * row as f64).sqrt();
    let closed = |x: f64| 0.5 * (libm::erf((x + 0.5 * width) / scale) - libm::erf((x - 0.5 * width) / scale));
    let sites = (1..120).map(|c| sheet.index(c, row));
    let off = sites.map(|s| (mean[s] - closed(sheet.point(s)[0] - 60.0)).abs()).fold(0.0, f64::max);
    within(
        "Litwiniszyn: outlet of 15 sites, distance from the error functions over the peak",
        off / closed(0.0),
        0.0,
        0.005,
        CLOSED,
    )
}

/// (d) Two walls: images. Walls mirror at the outermost sites, so that these see half of what comes.
fn walls_reflect(left: f64) -> Vec<Claim> {
    // Rows of 20 sites: the odd ones are shifted by half. The outlet is off the middle.
    let sheet = bed(22, 302, 8..=8);
    let mean = frequency(&sheet, left);
    let (low, high) = (1.0, 20.5);
    let variance = |row: usize| 2.0 * SPREAD * ROW_SPACING * row as f64;
    let gauss =
        |x: f64, row: usize| (-x * x / (2.0 * variance(row))).exp() / (std::f64::consts::TAU * variance(row)).sqrt();
    let images = |x: f64, row: usize| -> f64 {
        let period = 2.0 * (high - low);
        (-4..=4)
            .map(|k| f64::from(k) * period)
            .map(|shift| gauss(x - 8.0 + shift, row) + gauss(x + 8.0 - 2.0 * low + shift, row))
            .sum()
    };
    let worst = |row: usize| {
        let inner = (2..20).map(|c| sheet.index(c, row));
        inner.map(|s| (mean[s] / images(sheet.point(s)[0], row) - 1.0).abs()).fold(0.0, f64::max)
    };
    let source = closed_form("closed form: diffusion between mirrors, by images");
    let all = |mean: &[f64]| {
        let name = "Litwiniszyn: between walls, 300 rows up, all voids";
        within(name, moments(mean, &sheet, 300)[0], 1.0, 1e-12, closed_form("no void is lost"))
    };
    let mut leaking = sheet.clone();
    leaking.cells[sheet.index(12, 100)] = OUT;
    vec![
        within("Litwiniszyn: between walls, 150 rows up, worst site", worst(150), 0.0, 0.02, source),
        all(&mean),
        refused("a second outlet between the walls", &[all(&frequency(&leaking, left))], 1),
    ]
}

/// (e) Grains that leave in 100 steps from beds filled to different heights: not as water, that runs with sqrt(2 g h).
fn discharge(left: f64) -> Vec<Claim> {
    let left_after = |rows: usize| {
        let sheet = bed(COLUMNS, rows + 2, MIDDLE - 2..=MIDDLE + 2);
        let mut model = Litwiniszyn::new(sheet, left, 0.5, 1);
        let before = model.sheet.grains();
        (0..100).for_each(|_| model.advance(&mut |_| ()));
        (before - model.sheet.grains()) as f64
    };
    let gate = |ratio: f64| {
        within(
            "Litwiniszyn: discharge, bed of 160 rows over one of 40",
            ratio,
            1.0,
            0.01,
            own("the point of the model").after(),
        )
    };
    vec![
        gate(left_after(160) / left_after(40)),
        refused("a bed of 4 rows, which runs empty", &[gate(left_after(4) / left_after(40))], 1),
    ]
}

/// rare voids spread as R-1; dense ones do not; V-shaped depression, stable slope, shadow of an obstacle, voids kept.
pub(super) fn caram_hong_case(perturbation: f64) -> Judged {
    ensemble::drawn("voids", 0..=4, |set| {
        let left = 0.5 * perturbation;
        let sheet = bed(COLUMNS, 102, MIDDLE..=MIDDLE);
        let passed = caram_hong(&sheet, Chances { left, rate: 0.1 }, beds(set, 80), 300);
        let mut claims = spread_gates("after Caram and Hong, rare voids", &passed, &sheet);
        let leaning = caram_hong(&sheet, Chances { left: 0.65, rate: 0.1 }, beds(set, 40), 300);
        claims.push(refused("probabilities 0.65 and 0.35", &spread_gates("", &leaning, &sheet), 2));
        claims.extend(crowd(left, set));
        claims.extend(shadow(left, set));
        claims.extend(emptied(left, set + 1)?);
        Ok(claims)
    })
}

/// Variance of the flow over an outlet of 15 sites, over that of the error functions, with rare and with dense voids.
fn crowd(left: f64, set: u64) -> Vec<Claim> {
    let sheet = bed(125, 102, 55..=69);
    let row = 30;
    let closed = 2.0 * SPREAD * ROW_SPACING * row as f64 + (15.0 * 15.0 - 1.0) / 12.0;
    let share =
        |rate: f64| moments(&caram_hong(&sheet, Chances { left, rate }, beds(set, 10), 1500), &sheet, row)[2] / closed;
    let gate = |share| {
        let name = "after Caram and Hong: crowded voids, variance over that of free ones";
        Claim::judge(
            name,
            share,
            Some(1.2),
            Some(1.6),
            regression("regression value 1.37; voids that meet a void go aside"),
        )
    };
    let free = |share| {
        let name = "after Caram and Hong: rare voids of a wide outlet, variance over that of free ones";
        within(name, share, 1.0, 0.04, CLOSED)
    };
    let (rare, dense) = (share(0.01), share(1.0));
    vec![free(rare), gate(dense), refused("rare voids", &[gate(rare)], 1), refused("crowded voids", &[free(dense)], 1)]
}

/// Over a wall of 7 sites lies a triangle in which nothing moves; higher up the flow closes again, from the sides.
fn shadow(left: f64, set: u64) -> Vec<Claim> {
    let mut sheet = bed(COLUMNS, 102, MIDDLE - 9..=MIDDLE + 9);
    let wall = sheet.index(MIDDLE - 3, 10);
    sheet.cells[wall..wall + 7].fill(WALL);
    let triangle: Vec<usize> = (1..=6)
        .flat_map(|up| (0..sheet.columns()).map(move |c| (c, 10 + up)))
        .map(|(c, row)| sheet.index(c, row))
        .filter(|&s| {
            let [x, z] = sheet.point(s);
            (x - MIDDLE as f64).abs() <= 3.0 - (z / ROW_SPACING - 10.0) * 0.5 + 1e-9
        })
        .collect();
    let passed = caram_hong(&sheet, Chances { left, rate: 0.1 }, beds(set, 20), 1000);
    let in_triangle = |passed: &[f64]| triangle.iter().map(|&s| passed[s]).sum::<f64>();
    let free = caram_hong(&bed(COLUMNS, 102, MIDDLE - 9..=MIDDLE + 9), Chances { left, rate: 0.1 }, beds(set, 5), 1000);
    let centre = |passed: &[f64], row: usize| {
        let near = (MIDDLE - 1..=MIDDLE + 1).map(|c| passed[sheet.index(c, row)]).sum::<f64>();
        let whole = moments(passed, &sheet, row)[0];
        near / whole
    };
    let source =
        own("the flow closes over an obstacle: from none at its back to most of what passes without it").after();
    let gates = |passed: &[f64]| {
        let name = "after Caram and Hong: flow over the middle of a wall, 40 rows up over 8 rows up";
        [
            within(
                "after Caram and Hong: voids in the shadow of a wall",
                in_triangle(passed),
                0.0,
                0.0,
                closed_form("60 degrees, by the rule"),
            ),
            Claim::judge(name, centre(passed, 50) / centre(passed, 18), Some(2.0), None, source),
        ]
    };
    let mut claims = gates(&passed).to_vec();
    claims.push(refused("no wall", &gates(&free), 2));
    claims
}

/// A bed over an outlet until nothing runs any more; where `thief`, a grain is taken out of it that nobody counts. Gates on its slopes
/// and on what left it.
fn run_empty(left: f64, outlet: std::ops::RangeInclusive<usize>, thief: bool, seed: u64) -> Result<[Claim; 5], String> {
    let sheet = bed(COLUMNS, 42, outlet);
    let (grains, holes) = (sheet.grains(), sheet.sites(EMPTY).count());
    let mut model = CaramHong::new(sheet, Chances { left, rate: 1.0 }, seed);
    if thief {
        let taken = model.sheet.index(MIDDLE, 20);
        model.sheet.cells[taken] = EMPTY;
        model.count_anew();
    }
    let (mut gone, mut last) = (0, usize::MAX);
    let mut early = None;
    while gone != last {
        last = gone;
        let mut came = 0;
        for _ in 0..100 {
            model.advance(&mut |site| came += usize::from(model_row(site) == 1));
        }
        gone += came;
        early = early.or((gone >= 300).then(|| surface(&model.sheet)));
    }
    let early = early.ok_or("too few grains ran out")?;
    let end = surface(&model.sheet);
    let balance = (holes + gone) as f64 - model.sheet.sites(EMPTY).count() as f64;
    let lost = grains as f64 - (model.sheet.grains() + gone) as f64;
    let angle = |columns: std::ops::Range<usize>| {
        let points: Vec<_> = columns.map(|c| (c as f64, ROW_SPACING * end[c] as f64)).collect();
        slope(&points).atan().to_degrees()
    };
    let depth = early[MIDDLE - 20] as f64 - early[MIDDLE] as f64;
    let (v, side) = (own("a V over the outlet").after(), closed_form("slope of the lattice"));
    let conserved = closed_form("voids and grains are conserved");
    let name = |what: &str| format!("after Caram and Hong: {what}");
    Ok([
        Claim::judge(name("depth of the depression over the outlet, rows"), depth, Some(5.0), None, v),
        within(name("slope left of the outlet, degrees"), angle(12..MIDDLE - 3), -60.0, 2.0, side),
        within(name("slope right of the outlet, degrees"), angle(MIDDLE + 4..51), 60.0, 2.0, side),
        within(name("voids that came in or were there, less those there now"), balance, 0.0, 0.0, conserved),
        within(name("grains lost"), lost, 0.0, 0.0, conserved),
    ])
}

/// A bed that has run out: slopes of 60 degrees down to the outlet, none missing.
fn emptied(left: f64, seed: u64) -> Judged {
    let mut claims = run_empty(left, MIDDLE - 1..=MIDDLE + 1, false, seed)?.to_vec();
    let wide = run_empty(left, 1..=COLUMNS - 2, false, seed)?;
    claims.push(refused("an outlet as wide as the bed", &wide[..3], 3));
    let robbed = run_empty(left, MIDDLE - 1..=MIDDLE + 1, true, seed)?;
    claims.push(refused("a grain that is taken out of the bed", &robbed[3..], 2));
    Ok(claims)
}

/// Row of a site of the beds of [`COLUMNS`] columns.
fn model_row(site: usize) -> usize {
    site / COLUMNS
}

/// The highest row with a grain in every column.
fn surface(sheet: &Sheet) -> Vec<usize> {
    let top = |c: usize| (0..sheet.rows()).rev().find(|&r| sheet.cells[sheet.index(c, r)] >= 0).unwrap_or(0);
    (0..sheet.columns()).map(top).collect()
}
