//! Lattice gases from their scenes: the same as the bare rules, nobody lost, exact momentum, the same bits on any threads.

use super::methods::{Run, plan, refused};
use proptest::prelude::*;
use tsubu::engine;
use tsubu::lattice::gas::collide::{Rules, SLOTS};
use tsubu::lattice::gas::planes::Gas;
use tsubu::partner::Hosts;
use tsubu_frame::State;
use tsubu_scene::plan::{FhpRules, GasWalls, Method, Plan, Rotation, Signal};

const CHANNEL: &str = include_str!("../../../../scenes/gas-channel.toml");
const SCENES: [&str; 4] = [
    CHANNEL,
    include_str!("../../../../scenes/gas-pipe.toml"),
    include_str!("../../../../scenes/elongated-hopper.toml"),
    include_str!("../../../../scenes/poured-silo.toml"),
];

const METHODS: [Method; 4] =
    [Method::Fhp, Method::AfterPengHerrmann, Method::AfterBaxterBehringer, Method::AfterKarolyiKertesz];

/// Sites and slots that are taken.
fn taken(state: &State) -> Vec<i64> {
    let mut places = state.integer("gas.places").unwrap().to_vec();
    places.sort_unstable();
    places
}

/// The same of a bare gas.
fn filled(gas: &Gas) -> Vec<i64> {
    let [columns, rows] = gas.size();
    let places = (0..columns * rows).flat_map(|site| {
        let state = gas.site(site / rows, site % rows);
        (0..SLOTS).filter(move |slot| state >> slot & 1 == 1).map(move |slot| (site * SLOTS + slot) as i64)
    });
    places.collect()
}

/// A box of 40 columns and 60 rows that repeats itself both ways, without gravity.
fn endless(rules: FhpRules) -> Plan {
    let mut plan = plan(CHANNEL);
    plan.walls.clear();
    plan.gravity = [0.0; 3];
    plan.periodic.x = Some([-0.017_32, 0.017_32]);
    plan.periodic.z = Some([0.0, 0.06]);
    plan.fhp.rules = rules;
    plan.fhp.time_step = Some(1e-3);
    plan.particles.get_mut("gas").unwrap().count = 3000;
    plan
}

/// From a scene the gas does what the bare gas does, bit by bit, and keeps its momentum exactly.
#[test]
fn a_scene_is_the_bare_gas() {
    for (word, rules) in [(FhpRules::One, Rules::One), (FhpRules::Two, Rules::Two), (FhpRules::Three, Rules::Three)] {
        let mut run = Run::new(&endless(word));
        let first = taken(&run.state());
        let bare = |seed: u64| {
            let mut gas = Gas::new(rules, 40, 60, [true, true], seed);
            for site in first.chunk_by(|a, b| a / SLOTS as i64 == b / SLOTS as i64) {
                let at = site[0] as usize / SLOTS;
                gas.set_site(at / 60, at % 60, site.iter().map(|place| 1 << (place % SLOTS as i64)).sum());
            }
            assert_eq!(gas.mass(), 3000);
            gas
        };
        // The control has other chances.
        let (mut gas, mut other) = (bare(1), bare(2));
        let momentum = run.engine.momentum();
        for _ in 0..30 {
            run.steps(1);
            gas.step();
            other.step();
            assert_eq!(taken(&run.state()), filled(&gas), "{rules:?}");
            let now = run.engine.momentum();
            let largest = 3000.0 * 1e-6;
            assert!((0..3).all(|axis| (now[axis] - momentum[axis]).abs() < 1e-12 * largest), "{now:?} {momentum:?}");
        }
        assert_ne!(taken(&run.state()), filled(&other), "{rules:?}");
    }
}

/// The same bits on any number of threads.
#[test]
fn gases_on_any_number_of_threads() {
    for text in SCENES {
        let plan = plan(text);
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut run = Run::new(&plan);
                run.steps(60);
                run.state().hash()
            })
        };
        let one = run(1);
        assert!(one == run(2) && one == run(7), "{}", plan.title);
    }
}

/// A scene with a lump in its middle, open or closed at its sides.
fn scene(method: Method, ends: [bool; 2], lump: bool, count: usize) -> Plan {
    let wall = |name: &str, point: [f64; 2], normal: &str| {
        format!("[walls.{name}]\nmaterial = \"m\"\nshape.plane = {{ point = {point:?}, normal = \"{normal}\" }}\n")
    };
    let mut text = format!(
        "title = \"t\"\nmethod = \"{}\"\nduration = 1\n[materials.m]\nyoung-modulus = 1e7\nfriction = 0.2\n\
         [particles.g]\nmaterial = \"m\"\ndiameter = 1e-3\nmass = 1e-6\ncount = {count}\n\
         start.random.region = {{ low = [0.001, 0.001], high = [0.019, 0.029] }}\n",
        method.name()
    );
    if lump {
        text += "[walls.lump]\nmaterial = \"m\"\nshape.sphere = { centre = [0.01, 0.005], radius = 0.003 }\n";
    }
    if !ends[0] {
        text += &(wall("left", [0.0, 0.0], "x") + &wall("right", [0.02, 0.0], "-x"));
    }
    if !ends[1] {
        text += &(wall("floor", [0.0, 0.0], "z") + &wall("lid", [0.0, 0.03], "-z"));
    }
    text += "[periodic]\n";
    for (line, _) in ["x = [0, 0.02]\n", "z = [0, 0.03]\n"].into_iter().zip(ends).filter(|(_, end)| *end) {
        text += line;
    }
    plan(&text)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Whatever the walls and the rules, nobody is lost or in two places, the books close, and a run that is broken off goes
    /// on with the same bits.
    #[test]
    fn gases_keep_their_invariants(
        kind in 0_usize..4, x: bool, z: bool, lump: bool, smooth in 0.0..=1.0_f64, gravity in 0.01..=1.0_f64,
        dissipation in 0.0..=1.0_f64, count in 1_usize..400, rules in 0_usize..3, seed in any::<u32>(),
    ) {
        let method = METHODS[kind];
        let mut plan = scene(method, [x, z && kind != 3], lump, count);
        plan.seed = u64::from(seed);
        plan.fhp.rules = [FhpRules::One, FhpRules::Two, FhpRules::Three][rules];
        plan.fhp.gravity = 0.1 * gravity;
        if smooth < 0.5 {
            plan.fhp.walls = GasWalls::Smooth;
        }
        for (own, rough, loss) in [
            (&mut plan.after_peng_herrmann.gravity, &mut plan.after_peng_herrmann.roughness,
             &mut plan.after_peng_herrmann.dissipation),
            (&mut plan.after_baxter_behringer.gravity, &mut plan.after_baxter_behringer.roughness,
             &mut plan.after_baxter_behringer.dissipation),
        ] {
            (*own, *rough, *loss) = (gravity, smooth, dissipation);
        }
        (plan.after_karolyi_kertesz.gravity, plan.after_karolyi_kertesz.dissipation) = (gravity, dissipation);
        let mut run = Run::new(&plan);
        for _ in 0..40 {
            run.steps(1);
            prop_assert_eq!(run.engine.grains(), count);
        }
        let half = run.state();
        run.steps(20);
        let residual = run.ledger.residual(&engine::energies(&*run.engine, &Hosts::new(&plan.hosts)));
        prop_assert!(residual.abs() < 1e-12 * count as f64, "{}", residual);
        let missing = run.ledger.momentum_residual(run.engine.momentum());
        prop_assert!(missing.iter().all(|p| p.abs() < 1e-15 * count as f64), "{:?}", missing);
        let mut again = Run::new(&plan);
        again.engine.load(&mut half.clone()).unwrap();
        prop_assert_eq!(again.state().hash(), half.hash());
        again.steps(20);
        prop_assert_eq!(again.state().hash(), run.state().hash());
    }
}

/// What the books of a grain that falls through the ends of a pipe say is what gravity gives: it goes on falling.
#[test]
fn falling_through_ends_is_falling() {
    let mut plan = plan(SCENES[1]);
    plan.after_peng_herrmann.dissipation = 0.0;
    plan.after_peng_herrmann.roughness = 0.0;
    let mut run = Run::new(&plan);
    let start = run.engine.grain_energies().potential;
    run.steps(1000);
    let weight = 9.8 * run.engine.grains() as f64 * plan.particles["sand"].mass;
    let fallen = (start - run.engine.grain_energies().potential) / weight;
    // Almost all fly straight down most of the time.
    assert!((0.3..1.0).contains(&fallen), "{fallen} m of 1000 spacings, 1 m");
}

/// A gate that goes lets grains out, and they vanish where the scene removes them.
#[test]
fn gases_leave_by_gates_and_outlets() {
    for method in METHODS {
        let mut plan = scene(method, [false, false], false, 200);
        plan.walls.get_mut("floor").unwrap().until = Some(0.05);
        plan.removal = toml::from_str("below.behind = { point = [0, 0, -0.001], normal = [0, 0, 1] }").unwrap();
        let mut run = Run::new(&plan);
        let step = run.engine.time_step();
        run.steps((0.049 / step) as u64);
        assert_eq!(run.engine.grains(), 200, "{}", method.name());
        run.steps((0.5 / step) as u64);
        let left = run.engine.grains();
        assert!(left < 100, "{}: {left} left", method.name());
        let residual = run.ledger.residual(&engine::energies(&*run.engine, &Hosts::new(&plan.hosts)));
        assert!(residual.abs() < 1e-12, "{}: {residual}", method.name());
    }
}

/// Grains of a stream come in one by one, and the books know of them.
#[test]
fn streams_come_into_gases() {
    let mut run = Run::new(&plan(SCENES[3]));
    assert_eq!(run.engine.grains(), 0);
    let step = run.engine.time_step();
    run.steps((5.0 / step) as u64);
    assert!((112..=124).contains(&run.engine.grains()), "{}", run.engine.grains());
}

/// What gases cannot do is refused by name, with what to do.
#[test]
fn gases_refuse_what_they_cannot_do() {
    let space = refused(|p| p.dimension = 3, CHANNEL);
    assert!(space.contains("dimension") && space.contains("`method = \"dem\"`"), "{space}");
    let timeless = refused(|p| p.gravity = [0.0; 3], CHANNEL);
    assert!(timeless.contains("fhp.time-step") && timeless.contains("without gravity"), "{timeless}");
    let tilted = refused(|p| p.gravity = [1.0, 0.0, -9.0], SCENES[1]);
    assert!(tilted.contains("gravity") && tilted.contains("along -z"), "{tilted}");
    let endless = refused(|p| p.periodic.z = Some([0.0, 0.3]), SCENES[3]);
    assert!(endless.contains("periodic") && endless.contains("`fhp`"), "{endless}");
    let many = refused(|p| p.particles.get_mut("gas").unwrap().count = 1_000_000, CHANNEL);
    assert!(many.contains("particles.gas.start.random") && many.contains("free sites"), "{many}");
    let rough = refused(|p| p.materials.get_mut("rough").unwrap().friction = 1.5, SCENES[3]);
    assert!(rough.contains("materials.rough.friction") && rough.contains("at most 1"), "{rough}");
    let driven = refused(|p| p.walls.get_mut("left").unwrap().rotation = Some(turning()), CHANNEL);
    assert!(driven.contains("walls.left.rotation"), "{driven}");
}

fn turning() -> Rotation {
    let signal = Signal::Steady { rate: 1.0 };
    Rotation { centre: [0.0; 3], axis: [0.0, 1.0, 0.0], signal }
}
