//! piles and avalanches, after Karolyi and Kertesz.

use super::super::control::refused;
use super::super::ensemble;
use super::fhp::slope;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::lattice::gas::pile::{Habits, Pile};
use tsubu::lattice::gas::sites::Sites;
use tsubu::lattice::grid::COLUMN_SPACING;
use tsubu::random::{Purpose, words};
use tsubu_frame::{Claim, Source};

const SOURCE: Source = own("Karolyi and Kertesz 1998, from memory; rules after them").after();

/// A table on which grains are dropped one by one, each when all are at rest, and how many fell off for each.
fn heap(friction: f64, half: usize, count: usize, seed: u64) -> (Pile, Vec<u64>) {
    let habits = Habits { gravity: 0.5, dissipation: 0.8, friction: vec![friction; 2] };
    let mut pile = Pile::new(Sites::new(2 * half + 1, 3 * half, [false, false]), habits, seed);
    (0..=2 * half).for_each(|column| pile.set_wall(column, 0));
    let mut fell = Vec::new();
    for _ in 0..count {
        let before = pile.removed.len();
        pile.drop_at(half, (pile.height(half) + 10).min(3 * half - 1), 0);
        settle(&mut pile);
        fell.push((pile.removed.len() - before) as u64);
    }
    (pile, fell)
}

/// Until all are at rest; a grain that nothing lets rest does not hold up the study.
fn settle(pile: &mut Pile) {
    let end = pile.steps() + 20_000;
    while pile.flying() > 0 && pile.steps() < end {
        pile.step();
    }
}

/// Mean slope of both sides, without foot and top [degrees].
fn angle(friction: f64, seed: u64) -> f64 {
    const HALF: usize = 60;
    let (mut sum, mut looks) = (0.0, 0.0);
    let (mut pile, _) = heap(friction, HALF, 8000, seed);
    for _ in 0..20 {
        for _ in 0..100 {
            pile.drop_at(HALF, (pile.height(HALF) + 10).min(3 * HALF - 1), 0);
            settle(&mut pile);
        }
        for side in [10..50, 2 * HALF - 50..2 * HALF - 10] {
            let x: Vec<f64> = side.clone().map(|c| c as f64 * COLUMN_SPACING).collect();
            let z: Vec<f64> = side.map(|c| pile.height(c) as f64 + 0.5 * (c % 2) as f64).collect();
            sum += slope(&x, &z).abs().atan().to_degrees();
            looks += 1.0;
        }
    }
    sum / looks
}

/// The slope is finite and grows with friction.
pub(crate) fn pile_angle(perturbation: f64) -> Judged {
    ensemble::drawn("slopes", 1..=8, |seed| {
        // The perturbation takes friction away.
        let angles = [0.02, 0.1, 0.2].map(|friction| angle(friction * perturbation.powi(60), seed));
        let gate = |name: &str, rise: f64| Claim::judge(name, rise, Some(4.0), None, SOURCE);
        let flat =
            |angle: f64| Claim::judge("pile: slope at friction 0.02 [degrees]", angle, Some(30.0), Some(40.0), SOURCE);
        let steep = |angle: f64| Claim::judge("pile: slope at friction 0.2 [degrees]", angle, None, Some(75.0), SOURCE);
        let mut claims = vec![flat(angles[0])];
        claims.push(gate("pile: rise of the slope from friction 0.02 to 0.1 [degrees]", angles[1] - angles[0]));
        claims.push(gate("pile: rise of the slope from friction 0.1 to 0.2 [degrees]", angles[2] - angles[1]));
        claims.push(steep(angles[2]));
        claims.push(refused("grains five times as rough", &[flat(angles[1])], 1));
        let again = angle(0.1 * perturbation.powi(60), seed);
        claims.push(refused(
            "the same friction twice",
            &[gate("pile: rise of the slope from friction 0.1 to 0.1 [degrees]", again - angles[1])],
            1,
        ));
        Ok(claims)
    })
}

/// Exponent of the share of drops after which at least so many grains fell off, between two sizes.
fn exponent(fell: &[f64], from: f64, to: f64) -> f64 {
    let share = |size: f64| fell.iter().filter(|&&f| f >= size).count() as f64 / fell.len() as f64;
    -(share(to).max(1e-9) / share(from)).ln() / (to / from).ln()
}

/// Avalanches over the edge have a largest size: their distribution falls ever more steeply.
pub(crate) fn pile_avalanches(perturbation: f64) -> Judged {
    ensemble::drawn("avalanches", 1..=8, |seed| {
        let (pile, fell) = heap(0.1 * perturbation, 60, 30_000, seed);
        let fell: Vec<f64> = fell.iter().map(|f| *f as f64).collect();
        let gates = |fell: &[f64]| {
            let steeper = exponent(fell, 64.0, 256.0) - exponent(fell, 1.0, 8.0);
            let mean = fell.iter().sum::<f64>() / fell.len() as f64;
            let largest = fell.iter().fold(0.0_f64, |most, f| most.max(*f)) / pile.grains() as f64;
            let scale = "pile: avalanches over the edge: exponent beyond 64 grains over that below 8, difference";
            let balance = "pile: grains that fall off for one that is dropped";
            vec![
                Claim::judge(scale, steeper, Some(1.0), None, SOURCE),
                Claim::judge(
                    "pile: largest of 22 000 avalanches over the pile",
                    largest,
                    Some(0.01),
                    Some(0.3),
                    SOURCE,
                ),
                Claim::judge(balance, mean, Some(0.9), Some(1.1), closed_form("a pile in balance")),
            ]
        };
        let mut claims = gates(&fell[8000..]);
        claims.push(refused("a pile that has not come to the edge yet", &gates(&fell[..2000]), 3));
        Ok(claims)
    })
}

/// Columns and rows of a silo.
const COLUMNS: usize = 80;
const ROWS: usize = 200;

/// A silo into which 4000 grains of two kinds were poured at the left.
fn silo(friction: [f64; 2], seed: u64) -> Pile {
    let habits = Habits { gravity: 0.5, dissipation: 0.8, friction: friction.to_vec() };
    let mut pile = Pile::new(Sites::new(COLUMNS, ROWS, [false, false]), habits, seed);
    (0..COLUMNS).for_each(|column| pile.set_wall(column, 0));
    (0..ROWS).for_each(|row| [0, COLUMNS - 1].into_iter().for_each(|column| pile.set_wall(column, row)));
    for grain in 0..4000 {
        let kind = words(seed, Purpose::Stream, grain, 0)[0] & 1;
        pile.drop_at(2, (pile.height(2) + 10).min(ROWS - 2), kind);
        settle(&mut pile);
    }
    pile
}

/// How much farther from the spout grains of kind 0 come to rest than those of kind 1 [columns].
fn farther(pile: &Pile) -> f64 {
    let mean = |kind: usize| {
        let sites = (0..COLUMNS).flat_map(|c| (0..ROWS).map(move |r| (c, r)));
        let (sum, count) = sites
            .filter(|(c, r)| pile.at_rest(*c, *r) == Some(kind))
            .fold((0.0, 0.0), |s, (c, _)| (s.0 + c as f64, s.1 + 1.0));
        sum / count
    };
    mean(0) - mean(1)
}

/// Poured at one side of a silo, smooth grains go farther than rough ones; equal ones do not part.
pub(crate) fn pile_segregation(perturbation: f64) -> Judged {
    ensemble::drawn("silo", 1..=8, |seed| {
        let rough = 0.02 + 0.38 * perturbation.powi(60);
        let gate = |name: &str, value: f64| Claim::judge(name, value, Some(4.0), None, SOURCE);
        let (equal, parted) = (farther(&silo([0.2; 2], seed)), farther(&silo([0.02, rough], seed)));
        let same = |value: f64| {
            Claim::judge("silo: the same for equal grains", value, Some(-2.0), Some(2.0), closed_form("symmetry"))
        };
        Ok(vec![
            gate("silo: smooth grains lie farther from the spout than rough ones [columns of 78]", parted),
            same(equal),
            refused("a smooth and a rough kind for equal ones", &[same(parted)], 1),
            refused(
                "grains of equal friction",
                &[gate("silo: smooth grains lie farther from the spout than rough ones [columns of 78]", equal)],
                1,
            ),
        ])
    })
}

/// Of neighbours at rest, how much more often those down the slope are of one kind than those straight above each other: layers
/// lie along the slope.
fn layered(kind: impl Fn(usize, usize) -> Option<usize>) -> f64 {
    let alike = |next: &dyn Fn(usize, usize) -> (usize, usize)| {
        let sites = (1..COLUMNS - 2).flat_map(|c| (1..ROWS - 1).map(move |r| (c, r)));
        let pairs = sites.filter_map(|(c, r)| {
            let (column, row) = next(c, r);
            Some((kind(c, r)?, kind(column, row)?))
        });
        let (same, all) = pairs.fold((0.0, 0.0), |(same, all), (a, b)| (same + f64::from(u8::from(a == b)), all + 1.0));
        same / all
    };
    // Odd columns stand half a site higher: the lower right neighbour.
    alike(&|c, r| (c + 1, r - (c + 1) % 2)) - alike(&|c, r| (c, r + 1))
}

/// Grains of two kinds were to part into layers, as real ones do when they are poured.
pub(crate) fn silo_layers(perturbation: f64) -> Judged {
    ensemble::drawn("layers", 1..=8, |seed| {
        let rough = 0.02 + 0.38 * perturbation.powi(60);
        let gate = |name: &str, value: f64| Claim::judge(name, value, Some(0.1), None, SOURCE);
        let at_rest = |pile: Pile| move |c: usize, r: usize| pile.at_rest(c, r);
        let drawn = |c: usize, r: usize| Some((r + c.div_ceil(2)) / 4 % 2);
        let mixed = |c: usize, r: usize| Some((words(seed, Purpose::Stream, (c * ROWS + r) as u32, 0)[0] & 1) as usize);
        let by_hand = |found: f64| {
            let name = "silo: the same where layers of four rows are drawn";
            Claim::judge(name, found, Some(0.1), None, own("by hand").after())
        };
        Ok(vec![
            gate(
                "silo: share of like neighbours down the slope less that of those above each other",
                layered(at_rest(silo([0.02, rough], seed))),
            ),
            by_hand(layered(drawn)),
            refused("kinds that are drawn at random", &[by_hand(layered(mixed))], 1),
            refused(
                "grains of equal friction",
                &[gate(
                    "silo: share of like neighbours down the slope less that of those above each other",
                    layered(at_rest(silo([0.2; 2], seed))),
                )],
                1,
            ),
        ])
    })
}
