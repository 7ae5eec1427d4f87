//! Grains that are superellipsoids.

use super::clumps::HEAD;
use std::f64::consts::PI;
use std::path::Path;
use tsubu_scene::Scene;
use tsubu_scene::plan::Clump;

fn read(shape: &str, changes: &[&str]) -> Result<Scene, String> {
    let text = format!("{HEAD}{shape}\n");
    let mut changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    if !changes.iter().any(|change| change.starts_with("dimension")) {
        changes.push("dimension=3".to_owned());
    }
    Scene::parse("scene.toml", &text, Path::new("."), &changes).map_err(|complaints| complaints.to_string())
}

fn body(shape: &str) -> Clump {
    let scene = read(&format!("shape.superellipsoid = {shape}"), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let group = &scene.plan().particles["rods"];
    let body = group.shape.clump().expect("a body");
    assert!((group.mass / (2500.0 * body.volume * 0.004_f64.powi(3)) - 1.0).abs() < 1e-12);
    let again = Scene::parse("scene.toml", &scene.resolved_toml(), Path::new("."), &[]).expect("the same scene");
    assert_eq!(again.plan().particles["rods"], *group);
    body
}

/// Of spheroids the surface has a closed form: flat ones 2 pi a^2 (1 + (1 - e^2)/e artanh e), long ones 2 pi a^2 (1 + c/(a e) asin e).
#[test]
fn sphericity_is_that_of_closed_forms() {
    let sphericity = |volume: f64, surface: f64| (36.0 * PI * volume * volume).cbrt() / surface;
    let near = |shape: &str, told: f64, within: f64| {
        let found = body(shape).sphericity();
        assert!((found / told - 1.0).abs() < within, "{shape} {found} {told}");
    };
    near("{ semi-axes = [1, 1, 1] }", 1.0, 1e-9);
    let (c, e) = (0.25_f64, (1.0 - 0.0625_f64).sqrt());
    let flat = 2.0 * PI * (1.0 + (1.0 - e * e) / e * e.atanh());
    near("{ semi-axes = [1, 1, 0.25] }", sphericity(4.0 / 3.0 * PI * c, flat), 1e-4);
    let (c, e) = (3.0_f64, (1.0 - 1.0 / 9.0_f64).sqrt());
    let long = 2.0 * PI * (1.0 + c / e * e.asin());
    near("{ semi-axes = [1, 1, 3] }", sphericity(4.0 / 3.0 * PI * c, long), 1e-4);
    // A body of revolution, of slices of cones: r^8 + z^8 = 1.
    let profile = |k: u32| {
        let (sin, cos) = (f64::from(k) / 20_000.0 * std::f64::consts::FRAC_PI_2).sin_cos();
        (cos.powf(0.25), sin.powf(0.25))
    };
    let cones = (0..20_000).map(|k| (profile(k), profile(k + 1)));
    let surface: f64 = cones.map(|((r, z), (s, w))| 2.0 * PI * (r + s) * (r - s).hypot(w - z)).sum();
    let drum = "{ semi-axes = [1, 1, 1], exponents = [8, 2] }";
    let unit = body(drum).superellipsoid.expect("a superellipsoid").semi_axes[0];
    near(drum, sphericity(body(drum).volume / unit.powi(3), surface), 1e-4);
}

/// An ellipsoid has 4/3 pi a b c and (b^2 + c^2) / 5, in any unit; of bodies nearer to boxes a sum over cells says how much.
#[test]
fn volume_and_moments_are_those_of_the_body() {
    for unit in [1.0, 1e-3] {
        let [a, b, c] = [0.5, 1.0 / 3.0, 0.25];
        let found = body(&format!("{{ semi-axes = [{}, {}, {}] }}", 3.0 * unit, 2.0 * unit, 1.5 * unit));
        let moments = [(b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0];
        assert!((found.volume / (4.0 / 3.0 * PI * a * b * c) - 1.0).abs() < 1e-12, "{}", found.volume);
        assert!(found.moments.iter().zip(moments).all(|(found, told)| (found / told - 1.0).abs() < 1e-12));
    }
    let found = body("{ semi-axes = [3, 2, 1.5], exponents = [5, 3] }");
    let shape = found.superellipsoid.expect("a superellipsoid");
    let [a, b, c] = shape.semi_axes;
    let (cells, mut sums, mut reach) = (120, [0.0_f64; 4], 0.0_f64);
    for k in 0..cells * cells * cells {
        let at = |k: usize| (k as f64 + 0.5) / cells as f64;
        let [x, y, z] = [at(k % cells), at(k / cells % cells), at(k / cells / cells)];
        if (x.powi(3) + y.powi(3)).powf(5.0 / 3.0) + z.powi(5) < 1.0 {
            let squares = [a * a * x * x, b * b * y * y, c * c * z * z];
            let more = [1.0, squares[1] + squares[2], squares[0] + squares[2], squares[0] + squares[1]];
            (0..4).for_each(|k| sums[k] += more[k]);
            reach = reach.max(squares.iter().sum::<f64>());
        }
    }
    let volume = 8.0 * a * b * c * sums[0] / (cells as f64).powi(3);
    assert!((found.volume / volume - 1.0).abs() < 2e-3, "{} {volume}", found.volume);
    for k in 0..3 {
        assert!((found.moments[k] / (sums[k + 1] / sums[0]) - 1.0).abs() < 2e-3, "{:?} {sums:?}", found.moments);
    }
    assert!((reach.sqrt() / 0.5 - 1.0).abs() < 0.01, "a sphere of diameter 1 just holds it: {reach}");
    // Taken for an ellipsoid it would be lighter by a fifth.
    assert!(4.0 / 3.0 * PI * a * b * c / volume < 0.85);
}

/// The smallest mass that a body shows is at most its own, and that of a long one is much less.
#[test]
fn long_bodies_give_way_by_turning() {
    let [round, long, flat] =
        ["[1, 1, 1]", "[4, 1, 1]", "[2, 2, 1]"].map(|axes| body(&format!("{{ semi-axes = {axes} }}")).lightness());
    assert!((round - 1.0).abs() < 1e-9 && flat > 1.2 && long > flat, "{round} {flat} {long}");
    // Of a spheroid the lever (a^2 - c^2) nx nz / h has its greatest a - c, where the moment about y is (a^2 + c^2) / 5.
    assert!((long / (1.0 + 9.0 * 5.0 / 17.0) - 1.0).abs() < 0.01, "{long}");
}

#[test]
fn superellipsoids_that_cannot_be() {
    let seed = "shape.superellipsoid = { semi-axes = [3, 2, 1.5] }";
    let wrong = [
        read(&seed.replace("1.5", "0"), &[]),
        read(&seed.replace("1.5", "0.2"), &[]),
        read(&seed.replace("1.5] }", "1.5], exponents = [2] }"), &[]),
        read(&seed.replace("1.5] }", "1.5], exponents = [2, 9] }"), &[]),
        read(&seed.replace("1.5] }", "1.5], exponents = [1.5, 2] }"), &[]),
        read(seed, &["dimension=2"]),
        read(&format!("{seed}\nmotion.frozen = {{}}"), &[]),
        read(seed, &["water.density=1000", "water.viscosity=1e-3"]),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
}
