//! Structures that move and turn in six directions, with grains in cavities that hang on them.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;
use tsubu::engine::{Engine, energies};
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_scene::plan::Structure;
use tsubu_scene::{Plan, Scene};

fn scene_in(folder: &Path, text: &str) -> Scene {
    Scene::parse("scene.toml", text, folder, &[]).unwrap_or_else(|complaints| panic!("{complaints}"))
}

fn plan(text: &str) -> Plan {
    scene_in(Path::new("."), text).plan().clone()
}

struct World {
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
}

impl World {
    fn new(plan: &Plan) -> Self {
        let hosts = Hosts::new(&plan.hosts);
        let engine = tsubu::methods::open(plan, &hosts).unwrap_or_else(|error| panic!("{error}"));
        let ledger = Ledger::open(energies(&*engine, &hosts), engine.momentum());
        Self { engine, hosts, ledger }
    }

    fn go(&mut self, steps: u64) {
        self.engine.advance(steps, &mut self.hosts, &mut self.ledger).unwrap_or_else(|fault| panic!("{fault}"));
    }

    fn residual(&self) -> f64 {
        self.ledger.residual_relative(&energies(&*self.engine, &self.hosts))
    }

    /// Mean time between rising zeros of the displacement about its mean [s].
    fn period(&mut self, duration: f64) -> f64 {
        let dt = self.engine.time_step();
        let values: Vec<f64> = (0..(duration / dt) as usize)
            .map(|_| {
                self.go(1);
                self.hosts.list[0].displacement()
            })
            .collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let rising = values.windows(2).enumerate().filter(|(_, w)| w[0] < mean && w[1] >= mean);
        let times: Vec<f64> = rising.map(|(i, w)| dt * (i as f64 + (mean - w[0]) / (w[1] - w[0]))).collect();
        (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
    }
}

/// A pendulum without grains, and a ball somewhere else so that there is a step.
const PENDULUM: &str = r#"
method = "dem"
gravity = "9.81 m/s^2"
duration = "1 s"
dem.time-step = "0.2 ms"
[materials.steel]
young-modulus = "10 MPa"
poisson-ratio = 0.3
restitution = 1
friction = 0
[particles.ball]
material = "steel"
diameter = "10 mm"
mass = "1 g"
motion.frozen = {}
start.at = { position = [[9, 0, 0]] }
[walls.cup]
material = "steel"
host = "swing"
shape.plane = { point = [0, 0, -1], normal = "z" }
[hosts.swing]
structure.pendulum = { mass = "2 kg", centre = "0.5 m", inertia = "0.6 kg m^2", arm = "0.5 m", angle = "120 deg" }
"#;

/// The period of a pendulum at 120 degrees is 2 pi sqrt(I / m g b) / agm(1, cos 60 deg), 37 % longer than that of small swings
/// (Gauss); the control, the small angle, is refused by the same gate.
#[test]
fn a_pendulum_swings_at_any_angle() {
    let expected = |angle: f64| {
        let (mut a, mut b) = (1.0, (0.5 * angle).cos());
        for _ in 0..10 {
            (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        }
        TAU * (0.6_f64 / (2.0 * 9.81 * 0.5)).sqrt() / a
    };
    let found = |degrees: &str| World::new(&plan(&PENDULUM.replace("120 deg", degrees))).period(20.0);
    let large = found("120 deg");
    assert!((large / expected(2.0 * PI / 3.0) - 1.0).abs() < 1e-4, "{large}");
    assert!((found("1 deg") / expected(2.0 * PI / 3.0) - 1.0).abs() > 0.2);
}

/// A ball in a smooth tube that turns freely without gravity: (I + m r^2) w and I w^2 / 2 + m (r'^2 + r^2 w^2) / 2 stay, so that the
/// ball flies outwards as in the turning frame, by the centrifugal force, while Coriolis force slows the tube. The paths from
/// the two laws (Runge-Kutta 4 at a tiny step) come back. Control: a tube that does not hear the ball turns at the same speed all along.
#[test]
fn a_ball_in_a_turning_tube_is_flung_out() {
    let text = PENDULUM
        .replace("motion.frozen = {}\nstart.at = { position = [[9, 0, 0]] }", "start.at = { position = [[0.1, 0, 0]], velocity = [[0, 0, -0.2]] }")
        .replace("gravity = \"9.81 m/s^2\"", "gravity = 0")
        .replace("mass = \"1 g\"", "mass = \"500 g\"")
        .replace("0.2 ms", "20 us")
        .replace("shape.plane = { point = [0, 0, -1], normal = \"z\" }", "shape.box = { width = \"2 m\", height = \"10.001 mm\", depth = \"10.001 mm\", floor-centre = [0, 0, \"-5.0005 mm\"] }")
        .replace("inertia = \"0.6 kg m^2\"", "inertia = \"0.01 kg m^2\"")
        .replace("mass = \"2 kg\", centre = \"0.5 m\"", "mass = \"2 kg\", centre = 0")
        .replace("arm = \"0.5 m\", angle = \"120 deg\" }", "arm = \"1 m\" }\nvelocity = \"2 m/s\"");
    let (inertia, mass) = (0.01, 0.5);
    let mut world = World::new(&plan(&text));
    let (mut r, mut rate, spin) = (0.1_f64, 0.0_f64, 2.0_f64);
    let momentum = (inertia + mass * r * r) * spin;
    let law = |r: f64| r * (momentum / (inertia + mass * r * r)).powi(2);
    let (dt, mut turned) = (1e-5, 0.0);
    for _ in 0..50_000 {
        let (k1, l1) = (rate, law(r));
        let (k2, l2) = (rate + 0.5 * dt * l1, law(r + 0.5 * dt * k1));
        let (k3, l3) = (rate + 0.5 * dt * l2, law(r + 0.5 * dt * k2));
        let (k4, l4) = (rate + dt * l3, law(r + dt * k3));
        turned += 0.5 * dt * momentum / (inertia + mass * r * r);
        r += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        rate += dt / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
        turned += 0.5 * dt * momentum / (inertia + mass * r * r);
    }
    world.go(25_000);
    let found = glam::DVec3::from_array(world.engine.centre_of_mass());
    assert!((found.length() / r - 1.0).abs() < 2e-3, "{found} {r}");
    assert!(r > 0.14, "the ball has hardly moved: {r}");
    let angle = world.hosts.list[0].displacement();
    assert!((angle / turned - 1.0).abs() < 2e-3, "{angle} {turned}");
    assert!((angle / (spin * 0.5) - 1.0).abs() > 0.1, "the tube did not hear the ball");
    assert!(world.residual().abs() < 1e-3, "{}", world.residual());
}

/// A cantilever with a box at a place along it, and one heavy ball squeezed in the box.
fn beam(along: f64, ball: &str) -> Plan {
    let sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let side = |(i, n): (usize, &[i32; 3])| {
        let [x, y, z] = n.map(|n| -4.995e-3 * f64::from(n));
        let point = format!("[{}, {y}, {z}]", along + x);
        format!(
            "[walls.side-{i}]\nmaterial = \"steel\"\nhost = \"arm\"\ninterface = \"place\"\nshape.plane = {{ point = {point}, normal = {n:?} }}\n"
        )
    };
    let cavity: String = sides.iter().enumerate().map(side).collect();
    let text = format!(
        r#"
method = "dem"
dimension = 3
gravity = 0
duration = "1 s"
dem.time-step = "2 us"
[materials.steel]
young-modulus = "20 GPa"
poisson-ratio = 0.3
restitution = 0.2
friction = 5
[particles.ball]
material = "steel"
diameter = "10 mm"
mass = "{ball}"
start.at = {{ position = [[{along}, 0, 0]] }}
{cavity}
[hosts.arm]
structure.beam = {{ length = "0.3 m", section.rectangle = {{ width = "20 mm", height = "10 mm" }}, young-modulus = "2 GPa", density = "2700 kg/m^3", damping-ratio = 0, modes = 3 }}
interface.place.along = {along}
velocity = "2 mm/s"
"#
    );
    plan(&text)
}

/// Natural frequencies of the modes of a host with a rigid ball at its interface: K x = w^2 (M + m T^T T + J R^T R) x.
fn with_a_ball(plan: &Plan, mass: f64, inertia: f64) -> Vec<f64> {
    let host = &plan.hosts["arm"];
    let Structure::Modes { mode } = &host.structure else { panic!("a beam becomes modes") };
    let place = &host.interface["place"];
    let n = mode.len();
    let square = |i: usize| mode[i].mass * (TAU * mode[i].frequency).powi(2);
    let product = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let m = DMatrix::from_fn(n, n, |i, j| {
        let added = mass * product(&place.translation[i], &place.translation[j])
            + inertia * product(&place.rotation[i], &place.rotation[j]);
        added + if i == j { mode[i].mass } else { 0.0 }
    });
    let k = DMatrix::from_diagonal(&DVector::from_fn(n, |i, _| square(i)));
    let l = m.cholesky().unwrap().l().try_inverse().unwrap();
    let mut found: Vec<f64> = (&l * k * l.transpose()).symmetric_eigenvalues().iter().map(|w| w.sqrt() / TAU).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// A frozen pile: a ball held tight in a cavity at the tip of a beam shifts its first mode as its mass and its moment of inertia do,
/// within 1e-3. The control leaves its mass out and is refused.
#[test]
fn a_frozen_pile_is_an_added_mass() {
    let plan = beam(0.3, "50 g");
    let plan = one_mode(plan, 0);
    let expected = with_a_ball(&plan, 0.05, 0.4 * 0.05 * 25e-6)[0];
    let mut world = World::new(&plan);
    let found = 1.0 / world.period(0.6);
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    assert!((found / with_a_ball(&plan, 0.0, 0.0)[0] - 1.0).abs() > 0.05);
}

/// In the second mode a heavy ball at the node, 0.7834 of the length, shifts the frequency by what its turning inertia does, below
/// 2e-3; at the tip by more than a tenth.
#[test]
fn a_cavity_at_a_node_does_nothing() {
    let shift = |along: f64| {
        let plan = one_mode(beam(along, "50 g"), 1);
        let bare = with_a_ball(&plan, 0.0, 0.0)[0];
        let with_ball = with_a_ball(&plan, 0.05, 0.4 * 0.05 * 25e-6)[0];
        let found = 1.0 / World::new(&plan).period(0.2);
        assert!((found / with_ball - 1.0).abs() < 1e-3, "{along}: {found} {with_ball}");
        (found / bare - 1.0).abs()
    };
    let (node, tip) = (shift(0.783_443 * 0.3), shift(0.3));
    assert!(node < 2e-3, "{node}");
    assert!(tip > 0.1, "{tip}");
}

/// Frequency [rad/s] at which the signal, under Hann's window, has its largest part, near to the one that is expected.
fn line(values: &[f64], dt: f64, expected: f64) -> f64 {
    let n = values.len() as f64;
    let part = |w: f64| {
        let sums = values.iter().enumerate().fold([0.0; 2], |[c, s], (i, value)| {
            let x = i as f64;
            let (sin, cos) = (w * dt * x).sin_cos();
            let weighed = value * (PI * x / n).sin().powi(2);
            [c + weighed * cos, s + weighed * sin]
        });
        sums[0].hypot(sums[1])
    };
    let (mut low, mut high) = (0.97 * expected, 1.03 * expected);
    while high - low > 1e-6 * expected {
        let third = (high - low) / 3.0;
        if part(low + third) < part(high - third) { low += third } else { high -= third }
    }
    0.5 * (low + high)
}

/// A rotor that tilts about a point of its shaft, with a cavity 0.2 m from there which does not spin with it, and a ball held tight in that: with m at
/// the place of the cavity the lines of Campbell's diagram are (M + m + J / a^2) w^2 -+ P W w - k = 0 (Genta 2005), within 1e-3 in both whirls. Controls: lines
/// without the ball, and without the spin.
#[test]
fn a_frozen_pile_shifts_campbells_lines() {
    let (mass, polar, k, ball, arm) = (0.2, 0.1, 3e4, 0.05, 0.2);
    let mut plan = beam(arm, "50 g");
    for speed in [300.0, 900.0] {
        let host = plan.hosts.get_mut("arm").unwrap();
        host.structure = Structure::Matrices {
            mass: vec![vec![mass, 0.0], vec![0.0, mass]],
            damping: vec![vec![0.0; 2]; 2],
            stiffness: vec![vec![k, 0.0], vec![0.0, k]],
            gyroscopic: Some(vec![vec![0.0, polar], vec![-polar, 0.0]]),
            speed,
            coordinate: 0,
            participation: vec![0.0; 2],
        };
        let place = host.interface.get_mut("place").unwrap();
        place.translation = vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
        place.rotation = vec![[0.0, -1.0 / arm, 0.0], [0.0, 0.0, 1.0 / arm]];
        let mut world = World::new(&plan);
        let stride = 200;
        let dt = stride as f64 * world.engine.time_step();
        let values: Vec<f64> = (0..2500)
            .map(|_| {
                world.go(stride);
                world.hosts.list[0].displacement()
            })
            .collect();
        let lines = |ball: f64, speed: f64| {
            let all = mass + ball * (1.0 + 0.4 * 25e-6 / (arm * arm));
            let root = ((polar * speed).powi(2) + 4.0 * all * k).sqrt();
            [root - polar * speed, root + polar * speed].map(|twice| twice / (2.0 * all))
        };
        for (expected, wrong) in lines(ball, speed).into_iter().zip(lines(0.0, speed).into_iter().zip(lines(ball, 0.0)))
        {
            let found = line(&values, dt, expected);
            assert!((found / expected - 1.0).abs() < 1e-3, "{speed}: {found} {expected}");
            assert!((found / wrong.0 - 1.0).abs() > 0.03 && (found / wrong.1 - 1.0).abs() > 0.1, "{speed}: {wrong:?}");
        }
    }
}

/// Of a plan only one mode of its host.
fn one_mode(mut plan: Plan, which: usize) -> Plan {
    let host = plan.hosts.get_mut("arm").unwrap();
    if let Structure::Modes { mode } = &mut host.structure {
        *mode = vec![mode[which].clone()];
    }
    let place = host.interface.get_mut("place").unwrap();
    (place.translation, place.rotation) = (vec![place.translation[which]], vec![place.rotation[which]]);
    plan
}

/// Two masses on three springs, by files of the Matrix Market, by the modes of these and by the table of their modes, which are known: frequencies
/// sqrt(k/m) and sqrt(3 k/m), vectors (1, 1) and (1, -1) over sqrt(2 m). All give the same motion of the same ball.
#[test]
fn a_table_of_modes_is_the_matrices_that_it_came_from() {
    let desk = tempfile::tempdir().unwrap();
    let (m, k) = (0.5_f64, 200.0_f64);
    let matrix = |diagonal: f64, other: f64| {
        format!("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 {diagonal}\n2 1 {other}\n2 2 {diagonal}\n")
    };
    let zeta = 0.02;
    // Damping with the modes of the structure, 2 zeta w in each.
    let (w1, w2) = ((k / m).sqrt(), (3.0 * k / m).sqrt());
    let (c1, c2) = (m * zeta * (w1 + w2), m * zeta * (w1 - w2));
    for (name, diagonal, other) in [("m.mtx", m, 0.0), ("k.mtx", 2.0 * k, -k), ("c.mtx", c1, c2)] {
        fs::write(desk.path().join(name), matrix(diagonal, other)).unwrap();
    }
    let phi = 1.0 / (2.0 * m * 1e-3).sqrt();
    let line = |w: f64, sign: f64| format!("{}, {zeta}, {phi:.17}, {:.17}\n", w / TAU, sign * phi);
    // As of a program that counts in tonnes.
    let table = format!(
        "frequency [Hz], damping ratio, one z [1/sqrt(t)], two z [1/sqrt(t)]\n{}{}",
        line(w1, 1.0),
        line(w2, -1.0)
    );
    fs::write(desk.path().join("modes.csv"), table).unwrap();
    let text = |structure: &str, one: &str, two: &str| {
        format!(
            r#"
method = "dem"
duration = "1 s"
dem.time-step = "20 us"
[materials.steel]
young-modulus = "100 MPa"
poisson-ratio = 0.3
restitution = 0.7
friction = 0.3
[particles.balls]
material = "steel"
diameter = "10 mm"
mass = "20 g"
start.at = {{ position = [[0, 0, 0.02], [0.015, 0, 0.03]] }}
[walls.cavity]
material = "steel"
host = "frame"
interface = "two"
shape.box = {{ width = "40 mm", height = "60 mm", depth = "10 mm" }}
[hosts.frame]
structure.{structure}
at = "one"
interface.one = {{ point = [1, 0, 0]{one} }}
interface.two = {{ point = [0, 0, 0]{two} }}
force.sine = {{ amplitude = "1 N", frequency = "3.5 Hz" }}
"#
        )
    };
    let run = |text: &str| {
        let mut world = World::new(scene_in(desk.path(), text).plan());
        (0..40)
            .map(|_| {
                world.go(1000);
                world.hosts.list[0].displacement()
            })
            .collect::<Vec<f64>>()
    };
    let files = r#"matrix-files = { mass = "m.mtx", damping = "c.mtx", stiffness = "k.mtx", units = "m-kg-s" }"#;
    let by_matrices =
        run(&text(files, ", translation = [[0, 0, 1], [0, 0, 0]]", ", translation = [[0, 0, 0], [0, 0, 1]]"));
    let by_modes = run(&text(r#"modal-table = { file = "modes.csv" }"#, "", ""));
    let files = r#"matrix-files = { mass = "m.mtx", stiffness = "k.mtx", units = "m-kg-s", damping-ratio = 0.02 }"#;
    let by_their_modes =
        run(&text(files, ", translation = [[0, 0, 1], [0, 0, 0]]", ", translation = [[0, 0, 0], [0, 0, 1]]"));
    let largest = by_matrices.iter().map(|z| z.abs()).fold(0.0, f64::max);
    assert!(largest > 5e-3, "{largest}");
    for ((a, b), c) in by_matrices.iter().zip(&by_modes).zip(&by_their_modes) {
        assert!((a - b).abs() < 1e-6 * largest && (c - b).abs() < 1e-6 * largest, "{a} {b} {c}");
    }
}
