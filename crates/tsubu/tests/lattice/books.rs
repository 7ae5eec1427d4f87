//! Invariants of shaken runs under all options: every cell of one ball at most, closed books, the same bits.

use super::plans::{Run, coupled, plan, shaken};
use proptest::prelude::*;
use std::collections::BTreeSet;
use tsubu::engine::Engine;
use tsubu::lattice::damper::BoxPlace;
use tsubu_frame::State;
use tsubu_scene::plan::*;

fn hash(run: &Run) -> String {
    let mut state = State::default();
    run.engine.save(&mut state);
    run.hosts.save(&mut state);
    run.ledger.save(&mut state);
    state.hash()
}

fn options() -> impl Strategy<Value = Lattice> {
    let flags = proptest::array::uniform7(any::<bool>());
    let rest = (0.5..4.0_f64, 0..3_usize);
    (flags, rest).prop_map(|([unit, pairwise, scatter, reset, keep, resting, integer], (threshold, radius))| Lattice {
        mode: if resting { LatticeMode::Extended } else { LatticeMode::Literal },
        time_step: 1e-4,
        oblique_gravity: if unit { ObliqueGravity::Unit } else { ObliqueGravity::Projected },
        collision: if pairwise { Collision::Pairwise } else { Collision::Literal },
        rebound_scatter: scatter,
        reset_when_blocked: reset,
        keep_remainder: keep,
        resting_impulses: resting,
        resting_threshold: threshold,
        arithmetic: if integer { Arithmetic::Integer } else { Arithmetic::Fixed },
        head_room: 5,
        ball_radius: radius,
    })
}

fn inside_and_alone(run: &Run) {
    let damper = run.engine.damper();
    let BoxPlace { columns, rows, level, .. } = damper.place;
    let mut cells = BTreeSet::new();
    for i in 0..damper.balls() {
        let (column, row) = damper.seat(i);
        for [column, row] in damper.shape().seen_from(column, row - level) {
            let inside = (1..=columns as i64).contains(&column) && (0..rows as i64).contains(&row);
            assert!(inside, "ball {i} in column {column}, row {row}");
            assert!(cells.insert([column, row]), "two balls in column {column}, row {row}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever the options: balls inside the box and no two in a cell after every step; energy and momentum add up; the shortcut
    /// that skips balls for which nothing can have changed leaves every bit as it is.
    #[test]
    fn shaken_box_keeps_its_invariants(lattice in options(), count in 1_usize..70, seed in any::<u64>(),
                                      amplitude in 1e-3..24e-3_f64, frequency in 3.0..9.0_f64) {
        let mut plan = plan(count, lattice.mode);
        plan.lattice = lattice;
        plan.seed = seed;
        let plan = shaken(plan, amplitude, frequency);
        let mut run = Run::new(&plan);
        let mut slow = Run::new(&plan);
        slow.engine.look_everywhere(true);
        for step in 0..4000 {
            run.advance(1).expect("the motion is known beforehand, so there is room");
            inside_and_alone(&run);
            if step % 50 == 0 {
                let (energy, momentum) = run.residuals();
                prop_assert!(energy < 1e-9, "energy residual {energy} at step {step}");
                prop_assert!(momentum < 1e-9, "momentum residual {momentum} at step {step}");
            }
        }
        slow.advance(4000).expect("as before");
        prop_assert_eq!(hash(&run), hash(&slow));
    }
}

/// With the structure in the loop the energy residual is that of Runge-Kutta's work integrals.
#[test]
fn coupled_books_close() {
    for mode in [LatticeMode::Literal, LatticeMode::Extended] {
        for (reset, radius) in [(true, 0), (false, 0), (true, 2), (false, 1)] {
            let mut plan = coupled(plan(50, mode), 0.5e-3, 0.97);
            plan.lattice.reset_when_blocked = reset;
            (plan.lattice.ball_radius, plan.lattice.head_room) = (radius, 5 + 15 * radius);
            let mut run = Run::new(&plan);
            run.advance(20_000).expect("the box stays on its grid");
            let (energy, momentum) = run.residuals();
            assert!(energy < 1e-9 && momentum < 1e-9, "{mode:?} {reset} {radius}: {energy} {momentum}");
            let now = tsubu::engine::energies(&run.engine, &run.hosts);
            let mut wrong = run.ledger.clone();
            wrong.post(tsubu::ledger::Account::Collision, 1e-4 * now.total());
            assert!(wrong.residual_relative(&now).abs() > 1e-9, "the gate must notice a wrong row");
            // Action and reaction: what the hosts heard is what the box gave.
            let sum = run.ledger.host_impulse + run.ledger.wall_impulse[2];
            assert!(sum.abs() < 1e-9 * run.ledger.gravity_impulse[2].abs(), "{sum}");
        }
    }
}

/// Saved in the middle and loaded into a fresh engine, a run ends with the same bits.
#[test]
fn resumed_run_has_the_same_bits() {
    let extended = LatticeMode::Extended;
    for (mode, radius) in [(LatticeMode::Literal, 0), (extended, 0), (extended, 2)] {
        let mut plan = coupled(plan(50, mode), 0.5e-3, 0.97);
        plan.lattice.reset_when_blocked = mode == LatticeMode::Literal;
        (plan.lattice.ball_radius, plan.lattice.head_room) = (radius, 5 + 15 * radius);
        let mut whole = Run::new(&plan);
        whole.advance(30_000).expect("the box stays on its grid");
        let mut first = Run::new(&plan);
        first.advance(12_345).expect("as before");
        let mut state = State::default();
        first.engine.save(&mut state);
        first.hosts.save(&mut state);
        first.ledger.save(&mut state);
        let mut second = Run::new(&plan);
        second.engine.load(&mut state).expect("it was just saved");
        second.hosts.load(&state).expect("it was just saved");
        second.ledger = tsubu::ledger::Ledger::load(&state).expect("it was just saved");
        second.advance(30_000 - 12_345).expect("as before");
        assert_eq!(hash(&whole), hash(&second));
        second.advance(1).expect("as before");
        assert_ne!(hash(&whole), hash(&second), "the hash must notice one more step");
    }
}
