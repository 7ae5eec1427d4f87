//! Hosts: several degrees of freedom, matrices and modes.

use tsubu::engine::energies;
use tsubu::ledger::{Account, Ledger};
use tsubu::partner::{Host, Hosts};
use tsubu_scene::plan;

fn host(structure: plan::Structure, displacement: f64) -> Host {
    Host::new(&plan::Host {
        structure,
        direction: [0.0, 0.0, 1.0],
        interface: std::collections::BTreeMap::new(),
        at: None,
        copies: 1.0,
        base: None,
        force: None,
        dwell: None,
        displacement,
        velocity: 0.0,
    })
}

/// So many steps from time 0 by one of the integrators.
fn move_on(host: &mut Host, verlet: bool, dt: f64, steps: u32, ledger: &mut Ledger) {
    for step in 1..=steps {
        let time = dt * f64::from(step);
        if verlet {
            host.before(time, dt);
            host.after(time, dt, ledger);
        } else {
            host.runge_kutta(time - dt, dt, 0.0, ledger);
        }
    }
}

/// Two equal masses between three equal springs: frequencies sqrt(k/m) and sqrt(3 k/m), closed form.
#[test]
fn two_masses_have_their_two_frequencies() {
    let (m, k) = (2.0, 50.0);
    let chain = plan::Structure::Matrices {
        mass: vec![vec![m, 0.0], vec![0.0, m]],
        damping: vec![vec![0.0; 2]; 2],
        stiffness: vec![vec![2.0 * k, -k], vec![-k, 2.0 * k]],
        gyroscopic: None,
        speed: 0.0,
        coordinate: 1,
        participation: vec![1.0; 2],
    };
    let found = host(chain, 0.0).natural_frequencies();
    for (found, expected) in found.iter().zip([(k / m).sqrt(), (3.0 * k / m).sqrt()]) {
        assert!((found * std::f64::consts::TAU / expected - 1.0).abs() < 1e-12);
    }
}

/// The same structure as an oscillator and as its one mode moves the same, by both integrators, and its books close.
#[test]
fn one_mode_is_the_oscillator() {
    let (m, c, k) = (0.086_f64, 0.08_f64, 123.4_f64);
    let frequency = (k / m).sqrt() / std::f64::consts::TAU;
    let mode =
        plan::Mode { frequency, damping_ratio: c / (2.0 * (k * m).sqrt()), mass: m, shape: 1.0, participation: 1.0 };
    let oscillator = plan::Structure::Oscillator { mass: m, stiffness: k, damping: c, cubic_stiffness: 0.0 };
    let (mut a, mut b) = (host(oscillator.clone(), 0.01), host(plan::Structure::Modes { mode: vec![mode] }, 0.01));
    let mut rk = host(oscillator, 0.01);
    let mut ledger = Ledger::default();
    let opening: f64 = {
        let (kinetic, spring) = a.energy(0.0);
        kinetic + spring
    };
    let (mut ledger_b, mut ledger_rk) = (Ledger::default(), Ledger::default());
    let (dt, steps) = (1e-4, 20_000);
    for step in 1..=steps {
        let time = dt * f64::from(step);
        for (host, ledger) in [(&mut a, &mut ledger), (&mut b, &mut ledger_b)] {
            host.before(time, dt);
            host.after(time, dt, ledger);
        }
        rk.runge_kutta(time - dt, dt, 0.0, &mut ledger_rk);
    }
    // Damped free motion, closed form.
    let w0 = (k / m).sqrt();
    let zeta = c / (2.0 * (k * m).sqrt());
    let w = w0 * (1.0 - zeta * zeta).sqrt();
    let t = dt * f64::from(steps);
    let exact = 0.01 * (-zeta * w0 * t).exp() * ((w * t).cos() + zeta * w0 / w * (w * t).sin());
    assert!((a.displacement() - b.displacement()).abs() < 1e-12);
    assert!((rk.displacement() - exact).abs() < 1e-9, "{} {exact}", rk.displacement());
    assert!((a.displacement() - exact).abs() < 1e-5, "{} {exact}", a.displacement());
    for (host, ledger) in [(&a, &ledger), (&rk, &ledger_rk)] {
        let (kinetic, spring) = host.energy(t);
        let missing = kinetic + spring - opening + ledger.flow(Account::HostDamping);
        assert!(missing.abs() < 1e-5 * opening, "{missing:e} of {opening:e}");
    }
}

/// Two coupled masses ringing down: both integrators close their books, as dt^2 (the first spring energy is 1; a rule that
/// takes the power at the end of a step alone misses 1.9e-4 and is refused).
#[test]
fn books_of_two_masses_close_by_both_integrators() {
    let chain = plan::Structure::Matrices {
        mass: vec![vec![2.0, 0.0], vec![0.0, 1.0]],
        damping: vec![vec![0.6, -0.2], vec![-0.2, 0.4]],
        stiffness: vec![vec![100.0, -40.0], vec![-40.0, 60.0]],
        gyroscopic: None,
        speed: 0.0,
        coordinate: 1,
        participation: vec![1.0; 2],
    };
    for verlet in [true, false] {
        let mut host = host(chain.clone(), 0.1);
        let mut ledger = Ledger::default();
        let (kinetic, spring) = host.energy(0.0);
        let opening = kinetic + spring;
        let dt = 1e-3;
        // Short of a whole decay, so that the power at the two ends differs.
        move_on(&mut host, verlet, dt, 300, &mut ledger);
        let (kinetic, spring) = host.energy(0.3);
        let missing = kinetic + spring - opening + ledger.flow(Account::HostDamping);
        assert!(missing.abs() < 1e-5 * opening, "verlet {verlet}: {missing:e} of {opening:e}");
    }
}

/// A rigid symmetric rotor that tilts on its bearings, by the motion a = 0.3 m from its shaft: both tilts have the mass I_t / a^2, and its
/// spin W puts -W I_p / a^2 times the rate of one on the other. With z = q_0 + i q_1 that is I_t z'' - i W I_p z' + k a^2 z = 0, so that
/// it whirls at w with I_t w^2 -+ I_p W w - k a^2 = 0, forward and backward: Campbell's lines. Let go at z = z0 (1 + i) without a rate,
/// z = z0 (1 + i) (w_b exp(i w_f t) + w_f exp(-i w_b t)) / (w_f + w_b). Control: the lines of half the polar inertia are refused.
#[test]
fn a_rotor_whirls_on_campbells_lines() {
    let (transverse, polar, k) = (0.02 / 0.09, 0.03 / 0.09, 4e4);
    let lines = |polar: f64, speed: f64| {
        let root = ((polar * speed).powi(2) + 4.0 * transverse * k).sqrt();
        [root - polar * speed, root + polar * speed].map(|twice| twice / (2.0 * transverse))
    };
    for speed in [0.0, 50.0, 300.0, 2000.0] {
        let rotor = plan::Structure::Matrices {
            mass: vec![vec![transverse, 0.0], vec![0.0, transverse]],
            damping: vec![vec![0.0; 2]; 2],
            stiffness: vec![vec![k, 0.0], vec![0.0, k]],
            gyroscopic: Some(vec![vec![0.0, polar], vec![-polar, 0.0]]),
            speed,
            coordinate: 0,
            participation: vec![0.0; 2],
        };
        let found = host(rotor.clone(), 0.0).natural_frequencies().into_iter().map(|f| f * std::f64::consts::TAU);
        let misses = |polar: f64| {
            let pairs = found.clone().zip(lines(polar, speed));
            pairs.map(|(found, line)| (found / line - 1.0).abs()).fold(0.0, f64::max)
        };
        assert!(misses(polar) < 1e-9, "{speed}: {:e}", misses(polar));
        assert!(speed == 0.0 || misses(0.5 * polar) > 1e-2);
        let [backward, forward] = lines(polar, speed);
        for verlet in [true, false] {
            let mut host = host(rotor.clone(), 0.01);
            let mut ledger = Ledger::default();
            let (steps, dt) = (4000, 2.0 / (400.0 * forward));
            move_on(&mut host, verlet, dt, steps, &mut ledger);
            let t = dt * f64::from(steps);
            let [(sin_f, cos_f), (sin_b, cos_b)] = [(forward * t).sin_cos(), (backward * t).sin_cos()];
            let exact = 0.01 * (backward * (cos_f - sin_f) + forward * (cos_b + sin_b)) / (forward + backward);
            assert!(
                (host.displacement() - exact).abs() < 1e-4 * 0.01,
                "{speed} {verlet}: {} {exact}",
                host.displacement()
            );
            let (kinetic, spring) = host.energy(t);
            let opening = k * 1e-4;
            let missing = kinetic + spring - opening + ledger.flow(Account::HostDamping);
            assert!(missing.abs() < 1e-4 * opening, "{speed} {verlet}: {missing:e} of {opening:e}");
        }
    }
}

/// An oscillator on a shaken base, pushed as well, with as many balls between its floor and its ceiling, far from each other.
fn balls(number: usize, copies: f64) -> plan::Plan {
    let places: Vec<String> = (0..number).map(|index| format!("[{}, 0.004]", 0.5 * index as f64)).collect();
    let text = format!(
        r#"
method = "dem"
gravity = 9.81
duration = 1
[materials.steel]
young-modulus = "200 MPa"
poisson-ratio = 0.3
restitution = 1
friction = 0.3
[particles.balls]
material = "steel"
diameter = 0.006
mass = 0.01
start.at.position = [{}]
[walls.floor]
material = "steel"
host = "spring"
shape.plane.normal = "z"
[walls.ceiling]
material = "steel"
host = "spring"
shape.plane = {{ point = [0, 0.02], normal = "-z" }}
[hosts.spring]
structure.oscillator = {{ mass = 0.4, stiffness = 600, damping-ratio = 0.02, cubic-stiffness = 1e5 }}
base.sine = {{ amplitude = 0.001, frequency = 6 }}
force.sine = {{ amplitude = 0.5, frequency = 6 }}
copies = {copies}
"#,
        places.join(", ")
    );
    let scene = tsubu_scene::Scene::parse("scene.toml", &text, std::path::Path::new("."), &[]);
    scene.unwrap_or_else(|complaints| panic!("{complaints}")).plan().clone()
}

/// A ball of which a structure has four copies moves it as four balls do: leaps of 0.3 s within 1e-6. (Their rebound loses nothing: four
/// at once would not come back from one structure as asked, for each is told to rebound from it alone.) Its books hold. Control: one ball alone.
#[test]
fn copies_are_as_many_cavities() {
    let moved = |plan: &plan::Plan| {
        let mut hosts = Hosts::new(&plan.hosts);
        let mut engine = tsubu::methods::open(plan, &hosts).unwrap_or_else(|error| panic!("{error}"));
        let mut ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
        let steps = (0.3 / engine.time_step()) as u64;
        engine.advance(steps, &mut hosts, &mut ledger).unwrap_or_else(|fault| panic!("{fault}"));
        let residual = ledger.residual_relative(&energies(&*engine, &hosts));
        assert!(residual.abs() < 1e-3, "{residual:e}");
        [hosts.list[0].displacement(), engine.time_step()]
    };
    let [four, dt] = moved(&balls(4, 1.0));
    let [copied, _] = moved(&balls(1, 4.0));
    assert!((copied / four - 1.0).abs() < 1e-6, "{copied:e} {four:e}, {dt:e}");
    let [alone, _] = moved(&balls(1, 1.0));
    assert!((alone / four - 1.0).abs() > 0.01, "{alone:e} {four:e}");
}
