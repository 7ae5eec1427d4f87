//! Contacts of lattices: coordination, fabric, forces.

use super::{Ball, ball, column, near, on_wall, once, scalar, touching, view, watch};
use glam::DVec3;
use tsubu::view::Contact;

type PeriodicBounds = [Option<[f64; 2]>; 3];

/// Square lattice, four by four, the world repeating itself both ways.
fn square() -> (Vec<Ball>, PeriodicBounds) {
    let ends = [Some([0.0, 4.0]), None, Some([0.0, 4.0])];
    ((0..16_usize).map(|k| ball((k % 4) as f64 + 0.5, 0.0, (k / 4) as f64 + 0.5, 0.5)).collect(), ends)
}

/// Triangular lattice, the same.
fn triangular() -> (Vec<Ball>, PeriodicBounds) {
    let row = 0.75_f64.sqrt();
    let at = |k: usize| {
        let (i, j) = (k % 4, k / 4);
        ball(i as f64 + 0.5 * (j % 2) as f64, 0.0, row * j as f64, 0.5)
    };
    ((0..16).map(at).collect(), [Some([0.0, 4.0]), None, Some([0.0, 4.0 * row])])
}

/// A cube on another one that lies in the corner of a box: each pair of bodies is a contact however many corners touch, each side of the
/// box too. To count points would be seven contacts of the lower one.
#[test]
fn bodies_are_counted_and_not_their_corners() {
    let balls = [ball(0.0, 0.0, 0.5, 0.5), ball(0.0, 0.0, 1.5, 0.5)];
    let point = |second: usize, wall: bool, normal: DVec3| Contact {
        first: 0,
        second,
        wall,
        position: DVec3::ZERO,
        branch: normal,
        force: -normal,
        normal,
        overlap: 0.0,
    };
    // The way from centre to centre is summed anew for each corner.
    let up = [0.0, 1e-15, -1e-15].map(|off| Contact { branch: DVec3::new(off, 0.0, 1.0), ..point(1, false, DVec3::Z) });
    let floor = [point(0, true, DVec3::NEG_Z); 3];
    let contacts = [up.as_slice(), &floor, &[point(0, true, DVec3::X)]].concat();
    let mut coordination = watch(3, "coordination.fewest = 1");
    let sample = once(&mut *coordination, &view(&balls, contacts, [None; 3]));
    assert_eq!(scalar(&*coordination, &sample, "mean"), 2.0);
    assert_eq!(scalar(&*coordination, &sample, "contacts"), 3.0);
}

#[test]
fn lattices_have_their_numbers_of_contacts() {
    for ((balls, ends), z) in [(square(), 4.0), (triangular(), 6.0)] {
        let mut coordination = watch(2, "coordination = {}");
        let sample = once(&mut *coordination, &view(&balls, touching(&balls, ends, 1.0), ends));
        assert_eq!(sample.scalars, [z, z, 0.0, 16.0 * z / 2.0]);
        // The control: contacts across the ends forgotten.
        let sample = once(&mut *coordination, &view(&balls, touching(&balls, [None; 3], 1.0), ends));
        assert!(sample.scalars[0] < z - 0.5);
    }
}

/// A chain that hangs on the lattice is taken out link by link; a grain on its own is a rattler too.
#[test]
fn rattlers_are_taken_out_until_none_is_left() {
    let (mut balls, ends) = square();
    for at in [(4.5, 10.0), (4.5, 11.0), (4.5, 12.0), (8.0, 20.0)] {
        balls.push(ball(at.0, 0.0, at.1, 0.5));
    }
    let ends = [ends[0], None, None];
    let contacts = touching(&balls, ends, 1.0);
    let look = |text: &str| {
        let mut coordination = watch(2, text);
        let sample = once(&mut *coordination, &view(&balls, contacts.clone(), ends));
        sample.scalars
    };
    // Rows of the lattice close on themselves along x; along z they end: (8 * 4 + 8 * 3) / 16. The chain has 1, 2, 1.
    let all = look("coordination = {}");
    assert!(near(all[0], (56.0 + 4.0) / 20.0, 1e-12) && near(all[1], 3.5, 1e-12), "{all:?}");
    assert!(near(all[2], 0.2, 1e-12) && all[3] == 30.0);
    // With fewest = 4 rows peel off from both sides until nothing is left.
    let none = look("coordination.fewest = 4");
    assert!(none[1].is_nan() && none[2] == 1.0, "{none:?}");
    // The control: one round alone would leave the middle of the chain.
    assert!(!near(all[2], 3.0 / 20.0, 0.1));
}

#[test]
fn walls_and_held_grains_count_as_asked() {
    let mut balls = vec![ball(0.5, 0.0, 0.5, 0.5), ball(1.5, 0.0, 0.5, 0.5), ball(2.5, 0.0, 0.5, 0.5)];
    balls[2].free = false;
    let mut contacts = touching(&balls, [None; 3], 1.0);
    contacts.push(on_wall(&balls, 0, DVec3::new(0.0, 0.0, -0.5), DVec3::Z));
    let look = |text: &str| {
        let mut coordination = watch(2, text);
        once(&mut *coordination, &view(&balls, contacts.clone(), [None; 3])).scalars
    };
    assert_eq!(look("coordination = {}")[..1], [2.0]);
    assert_eq!(look("coordination.walls = false")[..1], [1.5]);
    let half = "coordination.region = { low = [0, 0], high = [1, 1] }";
    assert_eq!((look(half)[0], look(half)[3]), (2.0, 2.0));
}

#[test]
fn lattices_are_isotropic_and_a_column_is_not() {
    let fabric = |balls: &[Ball], ends: PeriodicBounds| {
        let mut fabric = watch(2, "fabric = {}");
        let sample = once(&mut *fabric, &view(balls, touching(balls, ends, 1.0), ends));
        ["fabric xx", "fabric xz", "fabric zz", "deviator"].map(|name| scalar(&*fabric, &sample, name))
    };
    for (balls, ends) in [square(), triangular()] {
        let [xx, xz, zz, deviator] = fabric(&balls, ends);
        assert!(near(xx, 0.5, 1e-12) && near(zz, 0.5, 1e-12), "{xx} {zz}");
        assert!(xz.abs() < 1e-12 && deviator < 1e-12);
        // The control: a lattice that is open above and below leans to x.
        assert!(fabric(&balls, [ends[0], None, None])[3] > 0.05);
    }
    // A column that leans by 30 degrees: F = n n.
    let lean: Vec<Ball> = (0..5_usize).map(|k| ball(0.5 * k as f64, 0.0, 0.75_f64.sqrt() * k as f64, 0.5)).collect();
    let [xx, xz, zz, deviator] = fabric(&lean, [None; 3]);
    assert!(near(xx, 0.25, 1e-9) && near(zz, 0.75, 1e-9) && near(deviator, 1.0, 1e-9), "{xx} {zz} {deviator}");
    assert!(near(xz, 0.25 * 3.0_f64.sqrt(), 1e-9));
    let mut watched = watch(2, "fabric = {}");
    let sample = once(&mut *watched, &view(&lean, touching(&lean, [None; 3], 1.0), [None; 3]));
    let along = ["principal direction x", "principal direction z"].map(|name| scalar(&*watched, &sample, name));
    assert!(near(along[0], 0.5, 1e-9) && near(along[1], 0.75_f64.sqrt(), 1e-9), "{along:?}");
}

/// In space: contacts along x and y alone have a fabric of (1/2, 1/2, 0), deviator 1/2.
#[test]
fn a_layer_in_space() {
    let balls: Vec<Ball> = (0..16_usize).map(|k| ball((k % 4) as f64 + 0.5, (k / 4) as f64 + 0.5, 0.0, 0.5)).collect();
    let ends = [Some([0.0, 4.0]), Some([0.0, 4.0]), None];
    let mut fabric = watch(3, "fabric = {}");
    let sample = once(&mut *fabric, &view(&balls, touching(&balls, ends, 1.0), ends));
    assert_eq!(sample.scalars.len(), 10);
    assert!(near(scalar(&*fabric, &sample, "deviator"), 0.5, 1e-12));
    assert!(scalar(&*fabric, &sample, "fabric zz").abs() < 1e-15);
}

/// Contacts whose forces are spaced as those of an exponential distribution.
fn exponential(beta: f64, below: f64) -> Vec<tsubu::view::Contact> {
    let balls = [ball(0.0, 0.0, 0.0, 0.5)];
    let n = 20_000;
    let force = |k: usize| below - (1.0 - (k as f64 + 0.5) / n as f64).ln() / beta;
    (0..n).map(|k| on_wall(&balls, 0, DVec3::new(0.0, 0.0, -0.5), DVec3::Z * 7.0 * force(k))).collect()
}

#[test]
fn an_exponential_tail_is_found() {
    let mut forces = watch(2, "forces = { walls = true, bins = 12, largest = 6 }");
    let balls = [ball(0.0, 0.0, 0.0, 0.5)];
    let sample = once(&mut *forces, &view(&balls, exponential(1.0, 0.0), [None; 3]));
    let get = |name: &str| scalar(&*forces, &sample, name);
    assert!(near(get("mean force"), 7.0, 1e-3) && near(get("tail exponent"), 1.0, 2e-3), "{sample:?}");
    assert!(near(get("chain share"), (-1.0_f64).exp(), 2e-3));
    assert!(near(get("chain load"), 2.0 * (-1.0_f64).exp(), 2e-3));
    let density = column(&*forces, &sample, "probability density");
    for (k, p) in density.iter().enumerate() {
        let [low, high] = [0.5 * k as f64, 0.5 * (k + 1) as f64];
        assert!((p - 2.0 * ((-low).exp() - (-high).exp())).abs() < 1e-3, "{k}: {p}");
    }
    // The control: forces that share an offset have another tail.
    let sample = once(&mut *forces, &view(&balls, exponential(1.0, 1.0), [None; 3]));
    assert!(near(scalar(&*forces, &sample, "tail exponent"), 2.0, 2e-3));
}

#[test]
fn equal_forces_make_no_chains() {
    let (balls, ends) = square();
    let mut forces = watch(2, "forces = {}");
    let sample = once(&mut *forces, &view(&balls, touching(&balls, ends, 2.0), ends));
    assert_eq!(sample.scalars[..3], [2.0, 0.0, 0.0]);
    assert!(sample.scalars[3].is_nan());
    let none = once(&mut *forces, &view(&balls, Vec::new(), ends));
    assert!(none.scalars[0].is_nan() && none.rows[0][1].is_nan());
}
