//! Invariants of every step, and the same bits whoever computes.

use super::{BOX, Run, with_threads};
use proptest::prelude::*;
use tsubu::clca::bed::Bed;
use tsubu::engine::Engine;
use tsubu::lattice::grid::EMPTY;

/// A plate of driven discs comes down into a bed.
const PLATE: &str = r#"
title = "a plate is pushed into a bed"
method = "cl-ca"
duration = "1 s"
[materials.m]
density = "2700 kg/m^3"
young-modulus = "1 MPa"
[particles.bed]
material = "m"
count = 120
diameter = "2.8 mm"
start.settled = {}
[particles.plate]
material = "m"
diameter = "2.8 mm"
start.at.position = [["14 mm", "62 mm"], ["17 mm", "62 mm"], ["20 mm", "62 mm"], ["23 mm", "62 mm"], ["26 mm", "62 mm"]]
motion.driven = { direction = "-z", signal.steady.rate = "50 mm/s" }
[walls.box]
material = "m"
shape.box = { width = "40 mm", height = "80 mm", depth = "5 mm", floor-centre = ["20 mm", 0] }
[cl-ca]
spacing = "1 mm"
"#;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the shapes and drives: no point has two owners, grains keep their number and shape, no move is longer
    /// than one spacing, the books add up, and looking only at grains that may have room changes no bit.
    #[test]
    fn a_box_of_any_shapes_keeps_its_invariants(
        seed in 0_u64..1000, memory in 1_u32..33, turning in any::<bool>(), up in 1_u32..30, down in 1_u32..30,
        shaken in any::<bool>(), bend in 0_usize..4,
    ) {
        let shape = [
            "[[0, 0], [0, 2], [1, 3], [1, 5]]", "[[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]",
            "[[0, 0], [1, 1], [-1, 1], [0, 2], [0, 4]]", "[[0, 0]]",
        ][bend];
        let mut changes = vec![
            format!("seed={seed}"), format!("cl-ca.memory={memory}"), format!("cl-ca.turning={turning}"),
            format!("cl-ca.shapes.rods.points.at={shape}"),
        ];
        if shaken {
            changes.push(format!("cl-ca.gravity-switch={{ up = {up}, down = {down} }}"));
        }
        let mut run = Run::new(BOX, &changes);
        let mut slow = Run::new(BOX, &changes);
        slow.engine.look_everywhere(true);
        for _ in 0..150 {
            let before = run.cells();
            run.advance(1);
            slow.advance(1);
            prop_assert_eq!(run.engine.bed().fault(true, &before), None);
            prop_assert!(run.residual() < 1e-12, "residual {}", run.residual());
        }
        prop_assert_eq!(run.state().hash(), slow.state().hash());
    }
}

/// The gate above, which every step of a development build goes through, sees a point that a grain does not own any more, one
/// that nobody owns, and a grain that has jumped.
#[test]
fn a_broken_invariant_is_noticed() {
    let run = Run::new(BOX, &[]);
    let before = &run.engine.bed().grains.cell;
    let fault = |harm: &dyn Fn(&mut Bed)| {
        let mut bed = run.engine.bed().clone();
        harm(&mut bed);
        bed.fault(true, before).unwrap_or_default()
    };
    assert_eq!(fault(&|_| ()), "");
    let lost = fault(&|bed| bed.grid.set(before[0] as usize, EMPTY));
    assert!(lost.contains("a point of grain 0 belongs to"), "{lost}");
    let stray = fault(&|bed| {
        let free = (0..bed.grid.columns() * bed.grid.rows()).find(|&cell| bed.grid.at(cell) == EMPTY).unwrap();
        bed.grid.set(free, 0);
    });
    assert!(stray.contains("points are taken"), "{stray}");
    let jumped = fault(&|bed| bed.grains.cell[0] += 1);
    assert!(jumped.contains("grain 0 goes from"), "{jumped}");
}

#[test]
fn the_same_bits_at_any_number_of_threads_and_after_resume() {
    for text in [BOX, PLATE] {
        let whole = |threads| {
            with_threads(threads, || {
                let mut run = Run::new(text, &[]);
                run.advance(200);
                run.state().hash()
            })
        };
        let hash = whole(1);
        assert_eq!([whole(2), whole(7)], [hash.clone(), hash.clone()]);
        let mut first = Run::new(text, &[]);
        first.advance(77);
        let mut second = Run::new(text, &[]);
        second.engine.load(&mut first.state()).unwrap();
        second.ledger = tsubu::ledger::Ledger::load(&first.state()).unwrap();
        second.advance(123);
        assert_eq!(second.state().hash(), hash, "{text}");
    }
}

/// Where thousands move, they take their turns in strips of the lattice side by side: rods that reach across the borders too.
/// The same bits at any number of threads and with every grain looked at.
#[test]
fn thousands_take_turns_side_by_side() {
    let shapes = "shapes.small.points.at = [[0, 0]]\nshapes.rods.points.at = [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]";
    let text = BOX.replace("shapes.rods.points.at = [[0, 0], [0, 2], [0, 4], [0, 6]]", shapes);
    let wide = r#"{ low = [0, 0], high = ["400 mm", "120 mm"] }"#;
    let changes: Vec<String> = [
        r#"walls.box.shape.box.width="400 mm""#,
        r#"walls.box.shape.box.height="120 mm""#,
        r#"walls.box.shape.box.floor-centre=["200 mm", 0]"#,
        "particles.small.count=6000",
        r#"particles.small.diameter="1.05 mm""#,
        "particles.small.start.random.region=WIDE",
        "particles.rods.count=200",
        "particles.rods.start.random.region=WIDE",
        "cl-ca.turning=true",
    ]
    .map(|change| change.replace("WIDE", wide))
    .to_vec();
    let whole = |threads: usize, everywhere: bool| {
        with_threads(threads, || {
            let mut run = Run::new(&text, &changes);
            run.engine.look_everywhere(everywhere);
            let mut most = 0;
            for _ in 0..12 {
                run.advance(5);
                most = most.max(run.engine.bed().motion.iter().map(|m| m.moving).sum::<i64>());
            }
            assert!(run.residual() < 1e-12);
            (run.state().hash(), most)
        })
    };
    let (hash, most) = whole(1, false);
    assert!(most > 4200, "only {most} moved at once: strips were not needed");
    assert_eq!([whole(2, false).0, whole(7, false).0, whole(2, true).0], [hash.clone(), hash.clone(), hash]);
}

/// In a still box all comes to rest, and the lower half of the box is where the grains are.
#[test]
fn grains_fall_until_nobody_has_room() {
    let mut run = Run::new(BOX, &[]);
    let before = run.engine.centre_of_mass()[2];
    run.advance(600);
    let rest = run.cells();
    run.advance(50);
    assert_eq!(run.cells(), rest);
    assert!(run.engine.centre_of_mass()[2] < 0.5 * before);
}

/// The plate arrives at where it was told, grains make way, and some of them share points: those stand for forces. A
/// plate that does not move shares none.
#[test]
fn a_plate_pushes_grains_out_of_its_way() {
    let pushed = |rate: &str| {
        let mut run = Run::new(PLATE, &[format!("particles.plate.motion.driven.signal.steady.rate=\"{rate}\"")]);
        run.advance((0.9 / run.engine.time_step()) as u64);
        let shared: u32 = run.engine.pairs().iter().map(|pair| pair.points).sum();
        let bed = run.engine.bed();
        let plate = bed.present().find(|&grain| !bed.kind(grain).free).unwrap();
        (shared, bed.vector(bed.grains.cell[plate] as usize).k)
    };
    let (moving, still) = (pushed("50 mm/s"), pushed("0.001 mm/s"));
    assert!((moving.1 - still.1 + 90).abs() <= 2, "the plate went {} half spacings", still.1 - moving.1);
    assert!(moving.0 > 20 && still.0 == 0, "{moving:?} {still:?}");
}

/// A box that goes up and down takes its grains along: after whole periods nobody is lower than the first layer was.
#[test]
fn a_shaken_box_keeps_its_grains() {
    let motion = r#"walls.box.motion={ direction = "z", signal.sine = { amplitude = "6 mm", frequency = "10 Hz" } }"#;
    let changes = [motion.to_owned(), "particles.small.count=150".to_owned()];
    let mut run = Run::new(BOX, &changes);
    let lowest = |run: &Run| {
        let bed = run.engine.bed();
        bed.present().map(|i| bed.vector(bed.grains.cell[i] as usize).k).min().unwrap()
    };
    let first = lowest(&run);
    for period in 1..=12_u32 {
        run.advance((f64::from(period) * 0.1 / run.engine.time_step()).round() as u64 - run.engine.bed().step);
        assert!(lowest(&run) >= first - 4, "{} half spacings lower after {period} periods", first - lowest(&run));
    }
}
