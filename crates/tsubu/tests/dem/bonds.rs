//! Bonds by their outcome: beams that bend as beams do, and break where they must.

use super::{hash, missing, open_text};
use std::f64::consts::PI;
use tsubu::engine::Engine;
use tsubu::ledger::Account;
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu_frame::Kind;

const RADIUS: f64 = 1e-3;
const LENGTH: f64 = 2.0 * RADIUS;
const YOUNG: f64 = 1e8;
const POISSON: f64 = 0.25;
/// Of grains of 2500 kg/m^3.
const MASS: f64 = 2500.0 * 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS;

/// A row of touching grains of 2 mm along x, the first one held, bonded by beams as thick as they are.
fn cantilever(links: usize, velocity: impl Fn(f64) -> f64, bond: &str) -> String {
    let places: Vec<String> = (1..=links).map(|k| format!("[{}, 0, 0]", k as f64 * LENGTH)).collect();
    let velocities: Vec<String> =
        (1..=links).map(|k| format!("[0, 0, {:e}]", velocity(k as f64 / links as f64))).collect();
    format!(
        "dimension = 3\nduration = '10 s'\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n\
         [contact]\nnormal.hertz = {{}}\n\
         [particles.held]\nmaterial = 'rock'\ndiameter = '2 mm'\nmotion.frozen = {{}}\nstart.at.position = [[0, 0, 0]]\n\
         [particles.free]\nmaterial = 'rock'\ndiameter = '2 mm'\n\
         start.at = {{ position = [{}], velocity = [{}] }}\n\
         [[bond]]\nyoung-modulus = {YOUNG}\npoisson-ratio = {POISSON}\n{bond}\n",
        places.join(", "),
        velocities.join(", "),
    )
}

fn vectors(engine: &dyn Engine, name: &str) -> Vec<[f64; 3]> {
    engine.frame(&Hosts::default()).vectors(Kind::Grain, name).to_vec()
}

fn bonds(engine: &dyn Engine) -> (usize, u64) {
    let view = engine.view(Wants::GRAINS);
    (view.bonds.len(), view.broken_bonds)
}

/// Bodies that lie farther apart than the `gap` are not bonded, and `check` says so; with a wider gap they are.
#[test]
fn bodies_too_far_apart_are_told() {
    let text = cantilever(1, |_| 0.0, "gap = 0.1")
        .replace("position = [[2e", "position = [[2.8e")
        .replace("[0.002,", "[0.0028,");
    let (engine, ..) = open_text(&text, &[]);
    assert_eq!(bonds(&*engine), (0, 0));
    let told = |engine: &dyn Engine| {
        engine.notes().iter().any(|note| note.key.starts_with("bond.") && note.text.contains("holds nothing"))
    };
    assert!(told(&*engine), "{:?}", engine.notes());
    let (engine, ..) = open_text(&text.replace("gap = 0.1", "gap = 0.9"), &[]);
    assert!(bonds(&*engine) == (1, 0) && !told(&*engine), "{:?}", engine.notes());
}

/// A cantilever of five grains sags by its weight. Timoshenko: a load P at x bends the tip by P x^2 (3 L - x) / (6 E I) and shears it by
/// P x / (K G A), K = 6 (1 + p) / (7 + 6 p). Without the shear, as Euler and Bernoulli have it, it would be 2 % stiffer: the gate refuses it.
#[test]
fn a_cantilever_sags_as_timoshenko_says() {
    let text = cantilever(5, |_| 0.0, "damping = 0.5");
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &["gravity=0.5"]);
    assert_eq!(bonds(&*engine), (5, 0));
    engine.advance(400_000, &mut hosts, &mut ledger).unwrap();
    let sag = -vectors(&*engine, "position")[4][2];
    let (area, moment) = (PI * RADIUS * RADIUS, 0.25 * PI * RADIUS.powi(4));
    let shear = 0.5 * YOUNG / (1.0 + POISSON) * 6.0 * (1.0 + POISSON) / (7.0 + 6.0 * POISSON);
    let whole = 5.0 * LENGTH;
    let (mut bent, mut sheared) = (0.0, 0.0);
    for x in (1..=5).map(|k| f64::from(k) * LENGTH) {
        bent += MASS * 0.5 * x * x * (3.0 * whole - x) / (6.0 * YOUNG * moment);
        sheared += MASS * 0.5 * x / (shear * area);
    }
    assert!((sag / (bent + sheared) - 1.0).abs() < 1e-4, "{sag} {bent} {sheared}");
    assert!((sag / bent - 1.0).abs() > 0.01, "{sag} {bent}");
    assert!(missing(&*engine, &hosts, &ledger) < 1e-3);
}

/// A cantilever of 20 grains, set in motion, sways at 1.875^2 / (2 pi L^2) sqrt(E I a / m): each grain is the mass of a length a of beam around it, so
/// L ends half a length beyond the last. With L up to the last centre it would be 5 % faster, and the gate refuses it.
#[test]
fn a_cantilever_sways_at_the_frequency_of_a_beam() {
    let text = cantilever(20, |x| 1e-3 * x * x, "");
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &["gravity=0"]);
    let frequency = |length: f64| {
        let moment = 0.25 * PI * RADIUS.powi(4);
        1.875_104_f64.powi(2) / (2.0 * PI * length * length) * (YOUNG * moment * LENGTH / MASS).sqrt()
    };
    let expected = frequency(20.5 * LENGTH);
    let dt = engine.time_step();
    let look = (1.0 / expected / dt / 50.0) as u64;
    // Upward crossings of the tip through its place of rest.
    let (mut before, mut crossings, mut step) = (1.0, Vec::new(), 0);
    while crossings.len() < 11 {
        engine.advance(look, &mut hosts, &mut ledger).unwrap();
        step += look;
        let now = vectors(&*engine, "position")[19][2];
        if before < 0.0 && now >= 0.0 {
            crossings.push((step as f64 - look as f64 * now / (now - before)) * dt);
        }
        before = now;
    }
    let found = 10.0 / (crossings[10] - crossings[0]);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
    assert!((found / frequency(20.0 * LENGTH) - 1.0).abs() > 0.03, "{found}");
    assert!(missing(&*engine, &hosts, &ledger) < 1e-3);
}

/// Four grains in space, bonded in a chain with a kink, that fly, spin and bend through large angles.
const TUMBLING: &str = "dimension = 3\nduration = '1 s'\ngravity = 0\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n\
     [contact]\nnormal.hertz = {}\n[particles.free]\nmaterial = 'rock'\ndiameter = '2 mm'\nstart.at = { position = [[0, 0, 0], [0.002, 0, 0], \
     [0.003, 0.0018, 0], [0.003, 0.0028, 0.0018]], velocity = [[0, 0, 3], [0, -2, 0], [1, 0, 1], [0, 1, -3]] }\n[[bond]]\nyoung-modulus = '10 MPa'\nradius = 0.7\ngap = 0.1\n";

/// Momentum and angular momentum about the origin, of grains that are no pieces of bodies.
fn momenta(engine: &dyn Engine) -> [f64; 6] {
    let [x, v, w] = ["position", "velocity", "spin"].map(|name| vectors(engine, name));
    let mut sum = [0.0; 6];
    for i in 0..x.len() {
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            sum[k] += MASS * v[i][k];
            sum[3 + k] += MASS * (x[i][a] * v[i][b] - x[i][b] * v[i][a]) + 0.4 * MASS * RADIUS * RADIUS * w[i][k];
        }
    }
    sum
}

/// Force and torques are derivatives of one energy: momentum and angular momentum stay to rounding, the energy to second order in the step.
/// With torques alone that would turn the pair and no couple of forces against them, angular momentum would be another in the first bending.
#[test]
fn energy_and_angular_momentum_hold_at_large_angles() {
    let drift = |step: f64| {
        let (mut engine, mut hosts, mut ledger) = open_text(TUMBLING, &[&format!("dem.time-step={step}")]);
        assert_eq!(bonds(&*engine), (3, 0));
        let before = momenta(&*engine);
        let total = engine.grain_energies().total();
        let (mut most, mut stored) = (0.0_f64, 0.0_f64);
        for _ in 0..200 {
            engine.advance((5e-5 / step) as u64, &mut hosts, &mut ledger).unwrap();
            let energies = engine.grain_energies();
            most = most.max((energies.total() / total - 1.0).abs());
            stored = stored.max(energies.bonds / total);
        }
        assert!(stored > 0.1, "they bend: {stored}");
        let after = momenta(&*engine);
        for k in 0..6 {
            let scale = if k < 3 { MASS } else { MASS * LENGTH };
            assert!((after[k] - before[k]).abs() < 1e-11 * scale, "{k}: {before:?} {after:?}");
        }
        most
    };
    let (coarse, fine) = (drift(5e-7), drift(2.5e-7));
    assert!(fine < 1e-3 && (3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
}

/// Two grains fly apart: the bond stretches by v sqrt(m* / k), k = E A / a, and breaks if k times that over A is more than it can carry. What it held
/// then, strength^2 A a / (2 E), is set free.
#[test]
fn a_bond_breaks_at_its_strength_and_its_energy_is_told() {
    let area = PI * RADIUS * RADIUS;
    let stiffness = YOUNG * area / LENGTH;
    let speed = 0.2;
    let tension = stiffness * speed * (0.5 * MASS / stiffness).sqrt() / area;
    let run = |share: f64| {
        let text = format!(
            "dimension = 3\nduration = '1 s'\ngravity = 0\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n\
             [contact]\nnormal.hertz = {{}}\n[particles.free]\nmaterial = 'rock'\ndiameter = '2 mm'\nstart.at = {{ position = [[0, 0, 0], \
             [0.002, 0, 0]], velocity = [[-0.1, 0, 0], [0.1, 0, 0]] }}\n[[bond]]\nyoung-modulus = {YOUNG}\ntensile-strength = {}\n",
            share * tension
        );
        let (mut engine, mut hosts, mut ledger) = open_text(&text, &["dem.time-step='0.03 us'"]);
        engine.advance(7000, &mut hosts, &mut ledger).unwrap();
        // Verlet's energy swings by (w dt)^2 / 8 of it: 3e-6.
        assert!(missing(&*engine, &hosts, &ledger) < 1e-5);
        (bonds(&*engine), ledger.flow(Account::Bonds))
    };
    assert_eq!(run(1.01), ((1, 0), 0.0));
    let (held, freed) = run(0.9);
    assert_eq!(held, (0, 1));
    let stored = (0.9 * tension).powi(2) * area * LENGTH / (2.0 * YOUNG);
    assert!((freed / stored - 1.0).abs() < 0.01, "{freed} {stored}");
}

/// Grains that are still pressed together when their bond breaks by shear meet by their contact, and the books hold.
#[test]
fn a_contact_takes_over_from_a_broken_bond() {
    let text = "dimension = 3\nduration = '1 s'\ngravity = 0\n[materials.rock]\nyoung-modulus = '10 MPa'\ndensity = '2500 kg/m^3'\nrestitution = 1\n\
         [contact]\nnormal.hertz = {}\n[particles.free]\nmaterial = 'rock'\ndiameter = '2 mm'\nstart.at = { position = [[0, 0, 0], [0.002, 0, 0]], \
         velocity = [[0.2, 0.3, 0], [-0.2, -0.3, 0]] }\n[[bond]]\nyoung-modulus = '10 MPa'\nshear-strength = '6 kPa'\n";
    let (mut engine, mut hosts, mut ledger) = open_text(text, &["dem.time-step='0.5 us'"]);
    let breaks = (0..1000).any(|_| {
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
        bonds(&*engine) == (0, 1)
    });
    assert!(breaks && engine.contacts() == 1, "the contact holds them now");
    assert!(engine.grain_energies().elastic > 0.0);
    engine.advance(4000, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.contacts(), 0);
    assert!(missing(&*engine, &hosts, &ledger) < 1e-3, "{}", missing(&*engine, &hosts, &ledger));
}

/// Chains of so many bonds side by side, one end held and the other pulled at such a rate that twice the mean strength comes after 4 ms.
fn pulled(chains: u32, links: usize, scatter: &str) -> String {
    let at = |x: usize| {
        let places: Vec<String> =
            (0..chains).map(|k| format!("[{}, {}]", x as f64 * LENGTH, f64::from(k) * 3.0 * LENGTH)).collect();
        places.join(", ")
    };
    let between: Vec<String> = (1..links).map(at).collect();
    let group = |name: &str, motion: &str, places: &str| {
        format!("[particles.{name}]\nmaterial = 'rock'\ndiameter = '2 mm'\n{motion}\nstart.at.position = [{places}]\n")
    };
    // Mean strength over E is 1e-3.
    let rate = 0.5 * links as f64 * LENGTH;
    let pull = format!("motion.driven = {{ direction = 'x', signal.steady.rate = {rate} }}");
    // Somebody must be free to move.
    let free = if links > 1 { between.join(", ") } else { "[-1, 0]".to_owned() };
    "duration = '1 s'\ngravity = 0\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n[contact]\nnormal.hertz = {}\n".to_owned()
        + &group("a-held", "motion.frozen = {}", &at(0))
        + &group("b-free", "", &free)
        + &group("c-pulled", &pull, &at(links))
        + &format!("[[bond]]\nyoung-modulus = {YOUNG}\ndamping = 0.5\ntensile-strength = {}\n{scatter}\n", 1e-3 * YOUNG)
}

/// 150 chains of n bonds each, pulled until their first bond breaks. The weakest of n breaks: in the mean strength n^(-1/m) by Weibull, for m = 3 half
/// of one bond's with eight. Without scatter a chain would be as strong as a bond: the gate refuses it.
#[test]
fn a_long_chain_is_as_weak_as_weibull_says() {
    let mean = |links: usize, scatter: &str| {
        let text = pulled(150, links, scatter);
        let (mut engine, mut hosts, mut ledger) = open_text(&text, &["dem.time-step='2 us'"]);
        let mut strength = vec![0.0; 150];
        let mut all = bonds(&*engine).0;
        assert_eq!(all, 150 * links);
        let mut time = 0.0;
        while strength.contains(&0.0) {
            engine.advance(5, &mut hosts, &mut ledger).unwrap();
            time += 1e-5;
            let view = engine.view(Wants::GRAINS);
            if view.bonds.len() == all {
                continue;
            }
            all = view.bonds.len();
            let mut left = vec![0; 150];
            for bond in &view.bonds {
                left[(view.grains.position[bond[0] as usize].z / (3.0 * LENGTH)).round() as usize] += 1;
            }
            for (strength, left) in strength.iter_mut().zip(left) {
                if *strength == 0.0 && left < links {
                    *strength = 0.5 * time / 1e-3;
                }
            }
        }
        strength.iter().sum::<f64>() / 150.0
    };
    let (whole, weakest) = (mean(2, "weibull-modulus = 3"), mean(8, "weibull-modulus = 3"));
    // Spread of one of the strengths 0.36 of the mean: 3 % in the mean of 150.
    let gate = |strength: f64, links: f64| (strength * links.powf(1.0 / 3.0) - 1.0).abs() < 0.09;
    assert!(gate(whole, 2.0) && gate(weakest, 8.0), "{whole} {weakest}");
    let alike = mean(8, "");
    assert!((alike - 1.0).abs() < 0.05 && !gate(alike, 8.0), "{alike}");
}

/// 1,500 chains of two bonds side by side, stretched alike: with Weibull's scatter of modulus m such a bundle carries at most (m e)^(-1/m) / Gamma(1 + 1/m)
/// of the mean strength of its chains (Daniels 1945), 2^(-1/m) of a bond's, for those that hold on are the fewer the larger the stretch. The sample scatters
/// by 2 %. Without scatter it would carry all: the gate refuses it.
#[test]
fn a_bundle_is_as_weak_as_daniels_says() {
    let strength = |scatter: &str| {
        let (mut engine, mut hosts, mut ledger) = open_text(&pulled(1500, 2, scatter), &["dem.time-step='2 us'"]);
        let mut most: f64 = 0.0;
        for step in 1..=1200 {
            engine.advance(1, &mut hosts, &mut ledger).unwrap();
            let stretch = 0.5 * 2e-6 * f64::from(step) / 1e-3;
            // Of a chain that breaks one bond goes.
            let (left, broken) = bonds(&*engine);
            assert_eq!(left as u64 + broken, 3000);
            most = most.max(stretch * (1.0 - broken as f64 / 1500.0));
        }
        most
    };
    let gate = |found: f64, m: f64| {
        let bundle = (m * std::f64::consts::E).powf(-1.0 / m) / libm::tgamma(1.0 + 1.0 / m);
        (found / (bundle * 2.0_f64.powf(-1.0 / m)) - 1.0).abs() < 0.06
    };
    let (wide, narrow) = (strength("weibull-modulus = 1.5"), strength("weibull-modulus = 6"));
    assert!(gate(wide, 1.5) && gate(narrow, 6.0), "{wide} {narrow}");
    let alike = strength("");
    assert!((alike - 1.0).abs() < 0.02 && !gate(alike, 1.5) && !gate(alike, 6.0), "{alike}");
}

/// A block of 1,200 bonded grains that falls onto a floor, and breaks.
const BLOCK: &str = "duration = '1 s'\n[materials.rock]\nyoung-modulus = '10 MPa'\ndensity = '2500 kg/m^3'\n[contact]\nnormal.hertz = {}\n\
     [particles.block]\nmaterial = 'rock'\ncount = 1200\ndiameter = '2 mm'\nstart.rows = { spacing = 1.001, jitter = 0 }\n\
     [walls.box]\nmaterial = 'rock'\nshape.box = { width = '81 mm', height = '200 mm' }\n\
     [[bond]]\nyoung-modulus = '10 MPa'\ndamping = 0.1\ntensile-strength = '10 kPa'\nshear-strength = '10 kPa'\nweibull-modulus = 4\n\
     [dem]\ntime-step = '5 us'\n";

#[test]
fn other_methods_have_no_bonds() {
    let scene = tsubu_scene::Scene::parse("test", BLOCK, std::path::Path::new("."), &["method=cl-ca".to_owned()]);
    let plan = scene.unwrap_or_else(|wrong| panic!("{wrong}"));
    let refused = tsubu::methods::open(plan.plan(), &Hosts::default()).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("bond: nothing holds its grains together; `dem` computes bonds"), "{refused}");
}

#[test]
fn a_block_breaks_by_the_same_bits() {
    let run = |threads: usize, resume: bool| {
        let look = |engine: &dyn Engine, hosts: &Hosts, ledger: &tsubu::ledger::Ledger| {
            (bonds(engine), missing(engine, hosts, ledger))
        };
        hash(|| open_text(BLOCK, &["gravity=500"]), [900, 900], threads, resume, look)
    };
    let (bits, ((hold, broken), lost)) = run(1, false);
    assert!(hold > 1000 && broken > 100, "{hold} {broken}");
    assert!(lost < 1e-3, "{lost}");
    assert_eq!(bits, run(2, false).0);
    assert_eq!(bits, run(7, false).0);
    assert_eq!(bits, run(2, true).0);
}

/// A bonded pair that swings across a periodic end does what it does elsewhere; in the plane nothing leaves it, to the bit.
#[test]
fn a_bond_reaches_across_a_periodic_end_and_stays_in_the_plane() {
    let run = |x: f64| {
        let text = format!(
            "duration = '1 s'\ngravity = 0\nperiodic.x = [0, 0.03125]\n[materials.rock]\nyoung-modulus = '1 GPa'\ndensity = '2500 kg/m^3'\n\
             [contact]\nnormal.hertz = {{}}\n[particles.free]\nmaterial = 'rock'\ndiameter = '2 mm'\nstart.at = {{ position = [[{x}, 0], [{}, 0]], \
             velocity = [[0.1, 1], [0, -1]] }}\n[[bond]]\nyoung-modulus = '10 MPa'\ngap = 0.05\n",
            (x + 0.002) % 0.03125
        );
        let (mut engine, mut hosts, mut ledger) = open_text(&text, &["dem.time-step='1 us'"]);
        assert_eq!(bonds(&*engine), (1, 0));
        engine.advance(3000, &mut hosts, &mut ledger).unwrap();
        let spin = vectors(&*engine, "spin");
        let place = vectors(&*engine, "position");
        assert!(spin.iter().all(|w| w[0] == 0.0 && w[2] == 0.0) && place.iter().all(|x| x[1] == 0.0));
        [place[0][2], place[1][2], spin[0][1], spin[1][1]]
    };
    let (inside, across) = (run(0.01), run(0.0305));
    for (a, b) in inside.iter().zip(across) {
        assert!((a - b).abs() < 1e-9 * a.abs().max(1e-3), "{inside:?} {across:?}");
    }
}
