//! Steps of the lattice gases beside a stream copy, on one core: how far from the memory's bandwidth they are.
//!
//! `cargo bench -p tsubu --bench lattice_gas`; results are kept in `benches/results/`.
//!
//! Bytes of a step are counted once for reading and once for writing: a bit for each slot of a site (6 in FHP-I, 7 else), and one
//! more that is read, of the walls. What is worked on twice in a cache is not counted. Both lattices hold 33 MiB or more in all
//! their planes or less than 1 MiB, so that one comes from memory and one from the nearest caches. The copy takes 256 MiB to
//! 256 MiB.
//!
//! What was tried for FHP-III, million sites a second (one core of a host busy with other work, best of many, one step a sweep):
//!
//! - functions and closures that are not forced into the pass are compiled without wide vectors: 1600; forced: 2600; arrays filled
//!   by loops instead of closures: 8500 in cache, 3500 from memory;
//! - planes one after the other: 28 streams at a time; eight words of every slot beside each other: 4 streams;
//! - collisions on eight words at a time: permutations, partial stores; in a loop over the words: a third faster (2026-11-22);
//! - two steps in one sweep, the second a column behind the first: a quarter to a third faster from memory (2026-11-22);
//! - a second lattice to write into: as many bytes again to be fetched; each column in its place, with a copy of the one before.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use tsubu::lattice::gas::collide::Rules;
use tsubu::lattice::gas::planes::Gas;

const COPIED: usize = 256 << 20;

fn steps(c: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    let mut group = c.benchmark_group("lattice gas");
    group.measurement_time(Duration::from_secs(3)).warm_up_time(Duration::from_millis(500)).sample_size(15);
    let from = vec![1_u64; COPIED / 8];
    let mut to = vec![0_u64; COPIED / 8];
    group.throughput(Throughput::Bytes(2 * COPIED as u64));
    group.bench_function("stream copy", |b| b.iter(|| black_box(&mut to).copy_from_slice(black_box(&from))));
    drop((from, to));
    for (rules, name, bits) in [(Rules::One, "FHP-I", 13), (Rules::Two, "FHP-II", 15), (Rules::Three, "FHP-III", 15)] {
        for (columns, rows) in [(512, 1024), (4096, 16_384)] {
            let mut gas = Gas::new(rules, columns, rows, [true, true], 1);
            gas.scatter(|_, _, _| 0.3);
            group.throughput(Throughput::Bytes((2 * columns * rows * bits / 8) as u64));
            group.bench_function(BenchmarkId::new(name, format!("{columns} x {rows}")), |b| {
                pool.install(|| b.iter(|| gas.steps_on(2)));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
