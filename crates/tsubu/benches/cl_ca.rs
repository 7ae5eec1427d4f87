//! Throughput of CL-CA: grains of 7 and 19 points in rows fall onto a floor, 1,000 to 1,000,000 of them.
//!
//! `cargo bench -p tsubu --bench cl_ca`; `RAYON_NUM_THREADS=1` for one core. An element is a grain that moves by one spacing.
//!
//! What was tried: every grain in its turn, ties drawn over the whole lattice: 2.4 million moves a second of 100,000 grains, where each
//! look misses the near caches. In strips of 64 columns: 2.9. Stencil and parity of a grain found once a turn instead of at every look:
//! 3.4. Thousand grains do 9.9 (one row of turns), ten thousand 7.8.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tsubu::clca::active::Active;
use tsubu::clca::bed::{Bed, GrainKind};
use tsubu::clca::order::Pull;
use tsubu::lattice::grid::Grid;
use tsubu::lattice::shape::Shape;

/// Grain-steps that are timed: from all falling to half of a thousand at rest.
const GRAIN_STEPS: usize = 10_000_000;

/// `count` grains in rows, small and large in turn, in a box about as wide as it is high.
fn bed(count: usize) -> Bed {
    let across = (count as f64).sqrt().ceil() as usize;
    let (columns, rows) = (6 * across + 16, 8 * across + 32);
    let mut grid = Grid::new(columns, rows);
    grid.paint_box(columns - 2, 1, rows - 2);
    let kind = |group: u32, radius: usize| GrainKind {
        group,
        shape: Shape::hexagon(radius),
        stencil: 0,
        orientations: 1,
        mass: 1.0,
        free: true,
    };
    let mut bed = Bed::new(grid, vec![kind(0, 1), kind(1, 2)], 1, 1);
    for number in 0..count {
        let (column, row) = (number % across, number / across);
        let cell = bed.grid.index(8 + 6 * column, 8 + 8 * row);
        bed.add((column + row) % 2, cell, number as u32);
    }
    bed
}

fn falling(c: &mut Criterion) {
    let mut group = c.benchmark_group("cl-ca");
    group.measurement_time(Duration::from_secs(3)).sample_size(10);
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let start = bed(count);
        let steps = (GRAIN_STEPS / count).clamp(10, 100);
        let run = |(mut bed, mut active): (Bed, Active)| {
            (0..steps).for_each(|_| _ = active.step(&mut bed, Pull::DOWN));
            bed.moves
        };
        group.throughput(Throughput::Elements(run((start.clone(), Active::default()))));
        group.bench_function(count.to_string(), |b| {
            b.iter_batched(|| (start.clone(), Active::default()), run, BatchSize::LargeInput);
        });
    }
    group.finish();
}

criterion_group!(benches, falling);
criterion_main!(benches);
