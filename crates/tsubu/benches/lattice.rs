//! Seconds of computing per simulated period of the damper automaton on the leaf spring of Komatsuzaki 2003 at 6 Hz, against the number
//! of balls, for both steps of Komatsuzaki (2003, fig. 12).
//!
//! `cargo bench -p tsubu --bench lattice`
//!
//! What was tried, and what it gave (N = 50, dt = 1e-4 s, ns a step; one core of a shared two-core machine, +-10 %):
//!
//! - the resting bed as one body (`resting.rs`) and looks ahead only where something can have changed (`stale`): the
//!   extended automaton costs 110-125 from N = 10 to 50, of which the structure takes 80;
//! - Runge-Kutta for one degree of freedom without heap vectors, one sine call a step and two rotations, no divisions, and
//!   small sets cleared word by word instead of by `memset`: empty box 210 -> 100;
//! - literal automaton in a jammed bed (box held below half a cell, fifty collisions a step): one Philox call a step mixed
//!   with the ball's number instead of one a rebound, and marking everybody at once in a crowd, take 940 to
//!   620. It stays the dearest state, because one-sided collisions keep the bed alive;
//! - balls of several cells: looks ahead became loops over cells, and the floor was asked by every ball where it had been by every column: 1.3
//!   to 1.5 times the time with one cell a ball. A set of who may be next to floor, ceiling or a ball at rest (`near`) brought it back to 0.85 to
//!   1.0 of the time before, and 1.1 in the jammed bed of the literal automaton.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::time::Duration;
use tsubu_scene::plan::LatticeMode;

#[path = "../tests/lattice/plans.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod plans;

fn period(c: &mut Criterion) {
    let mut group = c.benchmark_group("lattice period");
    group.measurement_time(Duration::from_secs(2)).sample_size(20);
    for mode in [LatticeMode::Literal, LatticeMode::Extended] {
        for step in [1e-4, 2e-5] {
            for count in [10, 20, 30, 40, 50] {
                let mut plan = plans::coupled(plans::plan(count, mode), 0.5e-3, 6.0 / 6.028_77);
                plan.lattice.time_step = step;
                plan.lattice.head_room = 8;
                let mut run = plans::Run::new(&plan);
                let steps = (1.0_f64 / 6.0 / step).round() as u64;
                // A swing that has settled, as in the measured part of a response.
                run.advance(20 * steps).expect("the box stays on its grid");
                let name = format!("{mode:?}, dt = {step:e} s");
                group.bench_function(BenchmarkId::new(name, count), |b| {
                    b.iter(|| run.advance(steps).expect("the box stays on its grid"));
                });
            }
        }
    }
    group.finish();
}

criterion_group!(benches, period);
criterion_main!(benches);
