//! Planes against a gas that is moved site by site, as the rules are told.

use super::Gas;
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::gas::bits::WIDE;
use crate::lattice::gas::chance::fair;
use crate::lattice::gas::collide::{REST, Rules, SLOTS, collide};
use crate::lattice::gas::step::MIRRORED;
use crate::random::Purpose;

/// A box with one smooth and three rough sides, or walls on two sides, or none.
fn filled(rules: Rules, columns: usize, rows: usize, periodic: [bool; 2]) -> Gas {
    let mut gas = Gas::new(rules, columns, rows, periodic, 9);
    for row in (0..rows).filter(|_| !periodic[0]) {
        gas.wall(0, row, Some(0));
        gas.wall(columns - 1, row, None);
    }
    for column in (0..columns).filter(|_| !periodic[1]) {
        gas.wall(column, 0, Some(1));
        gas.wall(column, rows - 1, None);
    }
    gas.scatter(|_, _, _| 0.4);
    gas
}

/// One step site by site, as the rules are told.
fn plain(gas: &Gas) -> Vec<u8> {
    let [columns, rows] = gas.size();
    let mut next = Vec::new();
    for column in 0..columns {
        for row in 0..rows {
            let half = 2 * row as i64 + column as i64 % 2;
            let mut n = [0_u64; SLOTS];
            for (slot, n) in n.iter_mut().enumerate() {
                let way = if slot == REST { Vector::default() } else { Direction::from_index(slot).times(1) };
                let wrap = |at: i64, size: usize, ends: bool| {
                    if ends { Some(at.rem_euclid(size as i64)) } else { (0..size as i64).contains(&at).then_some(at) }
                };
                let from = wrap(column as i64 - way.h, columns, gas.periodic[0]).and_then(|c| {
                    let row = (half - way.k - c % 2).div_euclid(2);
                    wrap(row, rows, gas.periodic[1]).map(|r| gas.site(c as usize, r as usize))
                });
                *n = u64::from(from.unwrap_or(0) >> slot & 1);
            }
            let pairs = gas.spec.blocks / 2;
            let place = column * pairs + row / (128 * WIDE);
            let word = row / 64;
            let turn = fair(9, Purpose::Turn, place as u32, gas.steps())[word / WIDE % 2].0[word % WIDE] >> (row % 64);
            let (at, bit) = (column * gas.spec.blocks * WIDE + word, row % 64);
            let smooth = (0..2).find(|&a: &usize| gas.smooth[a].get(at).is_some_and(|w| w >> bit & 1 == 1));
            let mut new = if gas.is_wall(column, row) { n } else { collide(gas.spec.rules, n, turn) };
            for (slot, new) in new.iter_mut().enumerate().filter(|(slot, _)| *slot != REST && gas.is_wall(column, row))
            {
                *new = n[smooth.map_or((slot + 3) % 6, |axis| MIRRORED[axis][slot])];
            }
            next.push((0..SLOTS).map(|slot| ((new[slot] & 1) as u8) << slot).sum());
        }
    }
    next
}

fn sites(gas: &Gas) -> Vec<u8> {
    let [columns, rows] = gas.size();
    (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))).map(|(c, r)| gas.site(c, r)).collect()
}

/// 64 sites at once do what one site after the other would do; particles are kept, and momentum where nothing stands in
/// the way. Of 1024 rows, which fill blocks to the last bit, the last took in from beyond the end whoever had ever been in the first:
/// such a gas grew denser, and shear waves in it decayed too fast.
#[test]
fn words_do_what_sites_do() {
    for rules in [Rules::One, Rules::Two, Rules::Three] {
        for (columns, rows, periodic) in [
            (6, 64, [true, true]),
            (40, 131, [true, true]),
            (2, 1024, [true, true]),
            (7, 90, [false, false]),
            (9, 1100, [false, true]),
        ] {
            let mut gas = filled(rules, columns, rows, periodic);
            let (mass, momentum) = (gas.mass(), gas.momentum());
            for _ in 0..4 {
                let wanted = plain(&gas);
                gas.step();
                assert!(sites(&gas) == wanted, "{rules:?} {columns} x {rows}");
                assert_eq!(gas.mass(), mass);
            }
            if periodic == [true, true] {
                assert_eq!(gas.momentum(), momentum);
            } else {
                assert_ne!(gas.momentum(), momentum);
            }
        }
    }
}

/// Two steps at once do what two steps do: over the borders of strips, at walls, at ends that meet and under a force.
#[test]
fn two_at_once_are_two() {
    for (columns, rows, periodic) in
        [(640, 2000, [true, true]), (637, 1100, [false, true]), (150, 90, [false, false]), (2, 64, [true, true])]
    {
        let mut gas = filled(Rules::Three, columns, rows, periodic);
        gas.push([0.01, -0.02]);
        let mut pushed = [Vector::default(); 2];
        let mut other = gas.clone();
        for _ in 0..3 {
            gas.steps_on(2);
            pushed[0] = pushed[0].plus(gas.pushed());
            for _ in 0..2 {
                other.step();
                pushed[1] = pushed[1].plus(other.pushed());
            }
            assert!(sites(&gas) == sites(&other), "{columns} x {rows}");
        }
        assert_eq!((pushed[0], gas.steps()), (pushed[1], other.steps()));
    }
}

/// The same bits for any number of threads: strips do not see each other.
#[test]
fn same_bits_on_any_number_of_threads() {
    let run = |threads: usize| {
        let mut gas = filled(Rules::Three, 640, 2000, [true, true]);
        gas.push([0.01, -0.02]);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| (0..10).for_each(|_| gas.step()));
        assert!(gas.sweep.strips() > 2);
        sites(&gas)
    };
    let one = run(1);
    assert!(one == run(2) && one == run(7));
}

/// What a force gives is what the momentum gains.
#[test]
fn pushes_are_counted() {
    let mut gas = filled(Rules::Two, 20, 200, [true, true]);
    gas.push([0.2, -0.1]);
    for _ in 0..5 {
        let before = gas.momentum();
        gas.step();
        assert_eq!(gas.momentum(), before.plus(gas.pushed()));
        assert!(gas.pushed().h > 0 && gas.pushed().k < 0);
    }
}
