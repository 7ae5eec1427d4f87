//! Fields keep mass, their stress sums up to that of Love and Weber, and they obey the balance of momentum.

use super::{Ball, ball, column, near, on_wall, once, scalar, shaken, touching, view, watch};
use glam::DVec3;
use tsubu::view::Contact;

const ENDS: [Option<[f64; 2]>; 3] = [Some([0.0, 1.0]), None, None];

/// A field in the plane, periodic along x, whose points are half a width apart: sums over them are integrals of Gaussians
/// to the last digits. The second number is the area of a point.
const PLANE: (&str, f64) = (
    "coarse-grain = { kernel = \"gaussian\", width = 0.08, axes = [\"x\", \"z\"], points = [25, 75], \
     region = { low = [0, -1], high = [1, 2] } }",
    0.04 * 0.04,
);

/// The same in space.
const SPACE: (&str, f64) = (
    "coarse-grain = { kernel = \"gaussian\", width = 0.1, axes = [\"x\", \"y\", \"z\"], points = [16, 34, 34], \
     region = { low = [0, -1.0625, -1.0625], high = [1, 1.0625, 1.0625] } }",
    0.0625 * 0.0625 * 0.0625,
);

/// Grains anywhere in (0, 1) x (0, 1), some fast, one frozen, one beyond the periodic end.
fn grains(space: bool) -> Vec<Ball> {
    let mut balls: Vec<Ball> = (0..12)
        .map(|k| {
            let [x, y, z] = [0, 1, 2].map(|m| shaken(3 * k + m));
            let mut ball = if space { ball(x, 0.2 * y, 0.2 * z, 0.1) } else { ball(x, 0.0, z, 0.1) };
            ball.mass = 1.0 + shaken(50 + k);
            ball.velocity = DVec3::new(z - 0.5, 0.0, x);
            ball
        })
        .collect();
    (balls[2].at.x, balls[3].at.x) = (0.1, 1.02);
    balls[7].free = false;
    balls
}

/// Forces of any direction between grains 0-1, 2-3, ... (3 is across the end), on the frozen one, and on a wall.
fn pairs(balls: &[Ball]) -> Vec<Contact> {
    let mut contacts: Vec<Contact> = (0..balls.len() / 2)
        .map(|k| {
            let (first, second) = (2 * k, 2 * k + 1);
            let mut between = balls[second].at - balls[first].at;
            between.x -= between.x.round();
            let force = DVec3::new(shaken(k) - 0.5, 0.0, shaken(k + 20) - 0.7);
            let position = balls[first].at + 0.4 * between;
            Contact {
                first,
                second,
                wall: false,
                position,
                branch: between,
                force,
                normal: between.normalize(),
                overlap: 0.0,
            }
        })
        .collect();
    contacts.push(on_wall(balls, 5, DVec3::new(0.05, 0.0, -0.09), DVec3::new(0.3, 0.0, 0.8)));
    contacts
}

/// Sum of force times branch over the contacts, branches ending at what no force moves.
fn love_weber(balls: &[Ball], contacts: &[Contact]) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for c in contacts {
        let to_point = c.position - balls[c.first].at;
        let held = !c.wall && !balls[c.second].free;
        // In the pair 6-7 the second is frozen.
        let branch = if c.wall || held { to_point } else { c.branch };
        for (a, row) in sum.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                *entry += c.force[a] * branch[b];
            }
        }
    }
    sum
}

/// Worst relative miss of the integral of the contact stress against the sum over contacts.
fn stress_misses(
    balls: &[Ball],
    shown: &[Contact],
    meant: &[Contact],
    (text, cell): (&str, f64),
    letters: &str,
) -> f64 {
    let mut field = watch(if letters.len() == 3 { 3 } else { 2 }, text);
    let sample = once(&mut *field, &view(balls, shown.to_vec(), ENDS));
    let exact = love_weber(balls, meant);
    let scale = exact.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut worst = 0.0_f64;
    for (i, a) in letters.chars().enumerate() {
        for (j, b) in letters.chars().enumerate() {
            let integral: f64 = column(&*field, &sample, &format!("contact stress {a}{b}")).iter().sum::<f64>() * cell;
            let index = |k: usize| if letters.len() == 3 { k } else { 2 * k };
            worst = worst.max((integral - exact[index(i)][index(j)]).abs() / scale);
        }
    }
    worst
}

#[test]
fn the_integral_of_the_stress_is_that_of_love_and_weber() {
    for (space, field, letters) in [(false, PLANE, "xz"), (true, SPACE, "xyz")] {
        let balls = grains(space);
        let contacts = pairs(&balls);
        let miss = stress_misses(&balls, &contacts, &contacts, field, letters);
        assert!(miss < 1e-12, "{letters}: {miss:e}");
        // The control: a branch across the periodic end that goes through the world instead.
        let mut wrong = contacts.clone();
        wrong[1].branch = balls[3].at - balls[2].at;
        let across = (wrong[1].branch - contacts[1].branch).length();
        assert!(across > 0.5, "no contact across the end");
        let miss = stress_misses(&balls, &wrong, &contacts, field, letters);
        assert!(miss > 1e-3, "{letters}: {miss:e}");
    }
}

#[test]
fn fields_hold_all_the_mass_and_momentum_once() {
    for (space, (text, cell)) in [(false, PLANE), (true, SPACE)] {
        let balls = grains(space);
        let mut field = watch(if space { 3 } else { 2 }, text);
        let sample = once(&mut *field, &view(&balls, Vec::new(), ENDS));
        let density = column(&*field, &sample, "density");
        let mass: f64 = density.iter().sum::<f64>() * cell;
        let free = || balls.iter().filter(|b| b.free);
        let exact: f64 = free().map(|b| b.mass).sum();
        assert!(near(mass, exact, 1e-12), "{mass} {exact}");
        // The control: the frozen grain's mass is not in the field.
        assert!(!near(mass, exact + 1.0, 1e-2));
        let speed = column(&*field, &sample, "velocity z");
        let momentum: f64 =
            density.iter().zip(speed).filter(|(d, _)| **d > 0.0).map(|(d, v)| d * v).sum::<f64>() * cell;
        let exact: f64 = free().map(|b| b.mass * b.velocity.z).sum();
        assert!(near(momentum, exact, 1e-12), "{momentum} {exact}");
    }
}

/// Kinetic stress is that of the velocities about the mean: none in a common motion, m v^2 in two beams.
#[test]
fn only_fluctuations_make_kinetic_stress() {
    let text = "coarse-grain = { kernel = \"lucy\", width = 0.4, axes = [\"x\"], points = [5], region = { low = [0, 0], high = [1, 2] } }";
    let balls = |beams: f64| -> Vec<Ball> {
        let at = |k: usize| ball(k as f64 / 40.0, 0.0, 1.0, 0.01);
        let along = |k: usize| DVec3::new(0.0, 0.0, 3.0 + if k.is_multiple_of(2) { beams } else { -beams });
        (0..40).map(|k| Ball { velocity: along(k), ..at(k) }).collect()
    };
    let mut field = watch(2, text);
    let mut stress = |beams: f64| {
        let sample = once(&mut *field, &view(&balls(beams), Vec::new(), ENDS));
        let pick = |name: &str| column(&*field, &sample, name)[2];
        (pick("kinetic stress zz"), pick("granular temperature"), pick("density"))
    };
    assert!(stress(0.0).0.abs() < 1e-25);
    // 40 grains of 1 kg on 2 m^2: 20 kg/m^2, and half of v^2 for each of two directions.
    let (zz, temperature, density) = stress(0.5);
    assert!(near(density, 20.0, 1e-3) && near(zz, -5.0, 2e-3), "{density} {zz}");
    assert!(near(temperature, 0.125, 2e-3), "{temperature}");
    assert!(!near(temperature, 0.25, 0.1), "the control: not divided by the dimension");
}

/// A pile of three on a floor, at rest under gravity, and one pushed against a side wall: div(stress) + rho g + boundary
/// force vanishes at every point.
#[test]
fn momentum_balances_at_every_point() {
    let g = 10.0;
    let balls: Vec<Ball> = (0..3_usize).map(|k| ball(0.5 + 0.06 * k as f64, 0.0, 0.1 + 0.19 * k as f64, 0.1)).collect();
    let mut contacts = touching(&balls, [None; 3], 0.0);
    // The upper grains' weight goes down; what it pushes sideways is held by a wall.
    for (k, c) in contacts.iter_mut().enumerate() {
        c.force = DVec3::new(-1.0, 0.0, -g * (2 - k) as f64);
    }
    contacts.push(on_wall(&balls, 0, DVec3::new(0.0, 0.0, -0.1), DVec3::new(0.0, 0.0, 3.0 * g)));
    contacts.push(on_wall(&balls, 0, DVec3::new(-0.1, 0.0, 0.0), DVec3::new(1.0, 0.0, 0.0)));
    contacts.push(on_wall(&balls, 2, DVec3::new(0.1, 0.0, 0.0), DVec3::new(-1.0, 0.0, 0.0)));
    let n = 61;
    let text = format!(
        "coarse-grain = {{ kernel = \"gaussian\", width = 0.1, axes = [\"x\", \"z\"], points = [{n}, {n}], region = {{ low = [0, -0.2], high = [1.22, 1.02] }} }}"
    );
    let mut field = watch(2, &text);
    let sample = once(&mut *field, &view(&balls, contacts, [None; 3]));
    let get = |name: &str| column(&*field, &sample, name);
    let rho = get("density");
    let h = 0.02;
    // Derivative of sixth order along one axis.
    let slope = |f: &[f64], k: usize, step: usize| {
        let d = |m: usize| f[k + m * step] - f[k - m * step];
        (0.75 * d(1) - 0.15 * d(2) + d(3) / 60.0) / h
    };
    for (a, pull) in [("x", 0.0), ("z", -g)] {
        let (along_x, along_z) = (get(&format!("contact stress {a}x")), get(&format!("contact stress {a}z")));
        let boundary = get(&format!("boundary force {a}"));
        let inside = (3..n - 3).flat_map(|j| (3..n - 3).map(move |i| j * n + i));
        let miss = |with: f64| {
            let at = |k: usize| slope(&along_x, k, 1) + slope(&along_z, k, n) + rho[k] * pull + with * boundary[k];
            inside.clone().map(at).fold(0.0_f64, |most, x| most.max(x.abs()))
        };
        let scale = rho.iter().fold(0.0_f64, |most, r| most.max(r * g));
        assert!(miss(1.0) < 1e-4 * scale, "{a}: {:e} of {scale:e}", miss(1.0));
        // The control: without the force of the walls it does not.
        assert!(miss(0.0) > 1e-2 * scale, "{a}: {:e}", miss(0.0));
    }
}

#[test]
fn the_history_has_means_over_the_field() {
    let text = "coarse-grain = { width = 0.3, points = [50], region = { low = [0, -1], high = [1, 1] } }";
    let balls = [ball(0.5, 0.0, 0.0, 0.1)];
    let press = [DVec3::new(0.0, 0.0, 0.1), DVec3::new(0.0, 0.0, -0.1)].map(|arm| on_wall(&balls, 0, arm, -arm * 40.0));
    let mut field = watch(2, text);
    let sample = once(&mut *field, &view(&balls, press.to_vec(), [None; 3]));
    // 1 kg on 2 m^2; 2 contacts of 4 N over 0.1 m on 2 m^2, half of the trace.
    assert!(near(scalar(&*field, &sample, "mean density"), 0.5, 1e-4));
    let pressure = scalar(&*field, &sample, "mean pressure");
    assert!(near(pressure, 0.2, 1e-4), "{pressure}");
}
