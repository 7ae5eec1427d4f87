//! Nothing that decides a bit may know how steps are shared out among calls: outputs, interrupts and the clock on the wall
//! decide that.
//!
//! A coupled stream once looked where the grains are after some of them had begun the next step, which they had not at the end of
//! a call; lattice models once posted the energy of grains that left as it was at the last call. Both gave other numbers when
//! output was written at other times, or the machine was busy.

use crate::dem::{open_text, run_text};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tsubu::engine::Engine;
use tsubu::ledger::Ledger;
use tsubu::partner::Hosts;
use tsubu_frame::State;
use tsubu_frame::state::Section;
use tsubu_scene::TEMPLATES;

type Opened = (Box<dyn Engine>, Hosts, Ledger);

fn state((engine, hosts, ledger): &Opened) -> State<'static> {
    let mut state = State::default();
    engine.save(&mut state);
    hosts.save(&mut state);
    ledger.save(&mut state);
    state.into_owned()
}

/// A way to do some steps: the lengths of the calls, after how many of them a fresh engine goes on from a checkpoint, and the
/// number of threads.
#[derive(Clone, Debug)]
struct Grouping {
    calls: Vec<u64>,
    cut: usize,
    threads: usize,
}

/// State after all steps, grouped in a way.
fn run(open: &(dyn Fn() -> Opened + Sync), grouping: &Grouping) -> State<'static> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(grouping.threads).build().unwrap();
    pool.install(|| {
        let mut opened = open();
        for (index, &steps) in grouping.calls.iter().enumerate() {
            if index == grouping.cut {
                let mut kept = state(&opened);
                opened = open();
                opened.0.load(&mut kept).unwrap();
                opened.1.load(&kept).unwrap();
                opened.2 = Ledger::load(&kept).unwrap();
            }
            let (engine, hosts, ledger) = &mut opened;
            engine.advance(steps, hosts, ledger).unwrap();
        }
        state(&opened)
    })
}

/// Names of the sections that are not the same, bit by bit.
fn differing(one: &State, other: &State) -> Vec<String> {
    let hash = |name: &str, section: &Section| {
        let mut state = State::default();
        state.insert(name.to_owned(), section.clone());
        state.hash()
    };
    let all =
        |state: &State| state.sections().map(|(name, s)| (name.to_owned(), hash(name, s))).collect::<BTreeMap<_, _>>();
    let (one, other) = (all(one), all(other));
    let names: BTreeSet<_> = one.keys().chain(other.keys()).collect();
    names.into_iter().filter(|name| one.get(*name) != other.get(*name)).cloned().collect()
}

/// Ways to do `total` steps: calls of very different lengths, single steps among them.
fn groupings(total: u64) -> impl Strategy<Value = Grouping> {
    let lengths = prop::collection::vec(prop_oneof![Just(1), 1..8u64, 1..total], 1..12);
    (lengths, 0..8usize, 1..4usize).prop_map(move |(lengths, cut, threads)| {
        let (mut calls, mut left) = (Vec::new(), total);
        for length in lengths.into_iter().chain([total]) {
            let length = length.min(left);
            calls.extend((length > 0).then_some(length));
            left -= length;
        }
        Grouping { calls, cut, threads }
    })
}

/// Holds drawn groupings against all steps in one call.
fn hold(name: &str, open: &(dyn Fn() -> Opened + Sync), total: u64, cases: u32) {
    let whole = Grouping { calls: vec![total], cut: usize::MAX, threads: 1 };
    let wanted = run(open, &whole);
    let begun = state(&open());
    assert_ne!(begun.hash(), wanted.hash(), "{name}: nothing happened");
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
    let done = runner.run(&groupings(total), |grouping| {
        let found = run(open, &grouping);
        let other = differing(&wanted, &found);
        prop_assert!(other.is_empty(), "{name}: {other:?} differ");
        Ok(())
    });
    done.unwrap_or_else(|error| panic!("{name}: {error}"));
}

mod patient {
    use super::*;

    /// Every shipped scene, for as many steps as take a moment.
    #[test]
    #[ignore = "half a minute: cargo xtask patient"]
    fn shipped_scenes() {
        for template in TEMPLATES {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
            let open = || run_text(template.text, std::path::Path::new(folder), &[]);
            let opened = open();
            // Enough for grains to touch, come and go and for gates to open in the small ones, and for a few looks of the water.
            let total = (200_000 / opened.0.grains().max(20) as u64).clamp(110, 1000);
            hold(template.name, &open, total, 2);
        }
    }
}

/// Scenes by other methods than their own.
#[test]
fn other_methods() {
    // Litwiniszyn's voids set out from sites that are outlets: one row further up there are some.
    let out = "removal.below.behind.point=[0,'1 mm']";
    for (template, method, change) in [
        ("voids", "litwiniszyn", out),
        ("voids", "after-caram-hong", out),
        ("collapse", "dem", "seed=1"),
        ("damper", "lattice", "seed=1"),
        ("shaken-box", "lattice", "seed=1"),
        // After a resume walls that had not moved in the last step stood where they were drawn.
        ("shaken-box", "cl-ca", "seed=1"),
    ] {
        let text = TEMPLATES.iter().find(|t| t.name == template).unwrap().text;
        hold(method, &|| open_text(text, &[&format!("method='{method}'"), change]), 230, 6);
    }
}

const BASE: &str = r#"
title = "drawn"
duration = "1 s"
gravity = [2, 0, -9.8]
speed-scale = "1 m/s"
[materials.sand]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
restitution = 0.5
friction = 0.5
rolling-friction = 0.1
surface-energy = 0.005
[particles.b-sand]
material = "sand"
count = 150
size.uniform = { smallest = "1.8 mm", largest = "2.2 mm" }
start.rows = { spacing = 1.02, jitter = 0.5, region = { low = [0, "2 mm"], high = ["40 mm", "60 mm"] } }
[walls.floor]
material = "sand"
shape.plane = { point = [0, 0], normal = "z" }
[periodic]
x = [0, "40 mm"]
[dem]
largest-overlap = 0.9
"#;

/// Features that go with each other in any number, a choice a row.
const FEATURES: &[&[&str]] = &[
    &["", "dem.integrator='symplectic-euler'"],
    &[
        "contact={tangential.mindlin={},rolling.epsd={}}",
        "contact={normal.hooke={stiffness='2e4 N/m'},tangential.spring={},rolling.constant={}}",
        "contact={cohesion.dmt={},tangential.mindlin={}}",
        "contact={tangential.none={}}",
    ],
    &["", "dem.orientation=true"],
    &["", "walls.floor.motion={direction='z',signal.sine={amplitude='0.5 mm',frequency='30 Hz'}}"],
    &[
        "",
        "walls.lid={material='sand',shape.plane={point=[0,'62 mm'],normal='-z'},until='4 ms'}",
        "walls.press={material='sand',shape.plane={point=[0,'64 mm'],normal='-z'},servo={direction='-z',force='2 N',mass='5 g'}}",
        "particles.c-rain={material='sand',count=60,diameter='2 mm',start.stream={region={low=[0,'70 mm'],high=['40 mm','80 mm']},rate='4000 1/s',velocity=[0,-1]}}",
    ],
    &["", "removal={corner={inside={region={low=[0,'4 mm'],high=['6 mm','8 mm']}}}}"],
    &[
        "",
        "particles.a-base={material='sand',count=20,diameter='2 mm',motion.frozen={},start.rows={spacing=1,jitter=0,region={low=[0,0],high=['40 mm','2 mm']}}}",
    ],
];

/// Kinds of water, and how it flows.
const WATER: &[&str] = &[
    "hindrance.richardson-zaki={},flow.coupled={bottom=0,top='60 mm'}",
    "flow.coupled={bottom=0,top='40 mm',lid='free'}",
    "flow.coupled={bottom=0,top='40 mm',lid='free',discharge='0.02 m^2/s'}",
    "flow.coupled={bottom=0,top='60 mm',discharge='0.02 m^2/s'},fluctuation={time='5 ms'}",
    "flow.coupled={bottom=0,top='60 mm',shear-velocity='0.1 m/s'},lift=['saffman-mei'],torque.finite-reynolds={}",
    "hindrance.richardson-zaki={},flow.column={bottom=0,top='60 mm',velocity='5 cm/s'}",
    "flow.log-law={shear-velocity='0.1 m/s',roughness='2 mm'},fluctuation={time='5 ms'}",
    "flow.table={height=[0,'60 mm'],velocity=[0,0.2]}",
    "surface='30 mm'",
];

/// A drawn scene, as changes of the base.
fn drawn() -> impl Strategy<Value = Vec<String>> {
    let picks: Vec<_> = FEATURES.iter().map(|choices| 0..choices.len()).collect();
    (picks, prop::option::of(0..WATER.len()), 0..1000u32).prop_map(|(picks, water, seed)| {
        let features = picks.iter().zip(FEATURES).map(|(pick, choices)| choices[*pick]);
        let mut changes: Vec<String> = features.filter(|f| !f.is_empty()).map(str::to_owned).collect();
        changes.extend(water.map(|k| format!("water={{drag.stokes-newton={{}},{}}}", WATER[k])));
        changes.push(format!("seed={seed}"));
        changes
    })
}

#[test]
fn drawn_scenes() {
    let mut runner = TestRunner::new(Config { cases: 24, failure_persistence: None, ..Config::default() });
    let done = runner.run(&(drawn(), groupings(260), groupings(260)), |(changes, first, second)| {
        let words: Vec<&str> = changes.iter().map(String::as_str).collect();
        let open = || run_text(BASE, Path::new("."), &words);
        let [first, second] = [run(&open, &first), run(&open, &second)];
        let other = differing(&first, &second);
        prop_assert!(other.is_empty(), "{other:?} differ");
        Ok(())
    });
    done.unwrap_or_else(|error| panic!("{error}"));
}
