//! A bed at rest between periodic sides: stress carries the weight, the floor has all of it.

use super::{column, near, scalar};
use crate::dem::open_text;
use std::path::Path;
use tsubu::view::Wants;
use tsubu::watch::open;
use tsubu_scene::Scene;

const BED: &str = r#"
title = "a bed at rest"
gravity = "10 m/s^2"
duration = "1 s"
periodic.x = ["-25 mm", "25 mm"]
[materials.soft]
young-modulus = "5 MPa"
restitution = 0.5
friction = 0.5
density = "2500 kg/m^3"
[particles.grains]
material = "soft"
count = 180
size.uniform = { smallest = "4 mm", largest = "5 mm" }
shape.disc.thickness = "5 mm"
start.random.region = { low = ["-25 mm", 0], high = ["25 mm", "150 mm"] }
[walls.floor]
material = "soft"
shape.plane = {}
[watch.w]
coarse-grain = { kernel = "gaussian", width = "2 mm", points = [200], region = { low = ["-25 mm", 0], high = ["25 mm", "100 mm"] } }
[watch.load]
wall-load = { wall = "floor", area = "250 mm^2" }
"#;

#[test]
fn stress_grows_with_the_weight_above() {
    let (mut engine, mut hosts, mut ledger) = open_text(BED, &[]);
    let steps = (4.0 / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let kinetic = engine.grain_energies().kinetic;
    assert!(kinetic < 1e-9, "{kinetic:e} J: not at rest");
    let scene = Scene::parse("bed", BED, Path::new("."), &[]).unwrap();
    let plan = scene.plan();
    let mut field = open(&plan.watch["w"].measure, plan);
    let sample = field.take(&engine.view(Wants::CONTACTS));
    let [z, rho, stress] = ["z", "density", "contact stress zz"].map(|name| column(&*field, &sample, name));
    let h = z[1] - z[0];
    // From above the reach of the floor to below the surface, over stretches of 10 mm.
    let (first, stretch) = (32, 20);
    let top = (0..z.len()).rfind(|&k| rho[k] > 0.5 * rho[100]).unwrap() - 20;
    assert!(top > first + stretch, "the bed is too low: {}", z[top]);
    let worst = |share: f64| {
        let miss = |k: usize| {
            let inner: f64 = rho[k + 1..k + stretch].iter().sum();
            let weight = 10.0 * h * (inner + 0.5 * (rho[k] + rho[k + stretch]));
            (share * (stress[k + stretch] - stress[k]) / weight - 1.0).abs()
        };
        (first..top - stretch).map(miss).fold(0.0, f64::max)
    };
    assert!(worst(1.0) < 0.01, "{}", worst(1.0));
    // The control: every contact counted for one of its grains alone.
    assert!(worst(0.5) > 0.01);
    // All of the weight: at the floor's end of the field, and on the floor.
    let weight: f64 = engine.view(Wants::GRAINS).grains.mass.iter().sum::<f64>() * 10.0;
    let mut load = open(&plan.watch["load"].measure, plan);
    let sample = load.take(&engine.view(Wants::WALLS));
    let force = scalar(&*load, &sample, "force z");
    assert!(near(force, -weight, 1e-4), "{force} {weight}");
    assert!(near(scalar(&*load, &sample, "pressure"), weight / 250e-6, 1e-4));
    // The control: the same gate refuses a grain too few.
    assert!(!near(force, -weight * 179.0 / 180.0, 1e-4));
}
