//! Throughput of the models with one grain a site, beside a copy of a long array in the same run.
//!
//! `cargo bench -p tsubu --bench sites`
//!
//! Elements are: bytes read and written (copy), sites (voids after Caram and Hong, chute), sites that voids pass
//! (Litwiniszyn), grains (lattice grains, pile). What a site or grain costs in memory at least: 1/4 byte read and written by
//! the voids after Caram and Hong (two bits a site; 4 bytes more where a grain moves), 4 by the chute, 80 a lattice grain, 40
//! a grain of the pile.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tsubu::lattice::caram_hong::{CaramHong, Chances};
use tsubu::lattice::grid::Grid;
use tsubu::lattice::gutt_haff::{Grain, LatticeGrains};
use tsubu::lattice::hemmingsson_herrmann::{Pile, Rule, Split};
use tsubu::lattice::litwiniszyn::Litwiniszyn;
use tsubu::lattice::savage::{Chute, Moves};
use tsubu::lattice::sheet::{Layout, OUT, Sheet};

/// A full bed; every `every`-th site of its lowest row is an outlet.
fn bed(layout: Layout, columns: usize, rows: usize, full: usize, every: usize) -> (Sheet, usize) {
    let mut sheet = Sheet::new(layout, columns, rows);
    for site in (every / 2..columns).step_by(every) {
        sheet.cells[site] = OUT;
    }
    let grains = sheet.fill(1, full, 0) as usize;
    (sheet, grains)
}

fn sites(c: &mut Criterion) {
    let mut group = c.benchmark_group("sites");
    group.measurement_time(Duration::from_secs(2)).sample_size(10);

    let from = vec![1.0_f64; 1 << 24];
    let mut to = vec![0.0_f64; 1 << 24];
    group.throughput(Throughput::Bytes(16 * from.len() as u64));
    group.bench_function("copy", |b| b.iter(|| to.copy_from_slice(&from)));

    let (sheet, _) = bed(Layout::Triangular, 2048, 1024, 1023, 64);
    for (name, rate) in [("caram-hong, rare voids", 0.01), ("caram-hong, dense voids", 1.0)] {
        let mut model = CaramHong::new(sheet.clone(), Chances { left: 0.5, rate }, 1);
        (0..400).for_each(|_| model.advance(&mut |_| ()));
        group.throughput(Throughput::Elements(20 * sheet.cells.len() as u64));
        group.bench_function(name, |b| {
            let step = |mut model: CaramHong| (0..20).for_each(|_| model.advance(&mut |_| ()));
            b.iter_batched(|| model.clone(), step, BatchSize::LargeInput);
        });
    }

    let model = Litwiniszyn::new(sheet.clone(), 0.5, 1.0, 1);
    let mut passed = 0;
    let mut first = model.clone();
    (0..20).for_each(|_| first.advance(&mut |_| passed += 1));
    group.throughput(Throughput::Elements(passed));
    group.bench_function("litwiniszyn", |b| {
        let step = |mut model: Litwiniszyn| (0..20).for_each(|_| model.advance(&mut |_| ()));
        b.iter_batched(|| model.clone(), step, BatchSize::LargeInput);
    });

    let (sheet, grains) = bed(Layout::Square, 1026, 80, 61, usize::MAX);
    let moves = Moves { down: 0.5, diagonal: 0.3, sideways: 0.6, up: 0.2 };
    let chute = Chute::new(sheet.clone(), vec![1.0; grains], moves, 0.4, true, 1);
    group.throughput(Throughput::Elements(20 * sheet.cells.len() as u64));
    group.bench_function("savage", |b| {
        b.iter_batched(|| chute.clone(), |mut chute| (0..20).for_each(|_| chute.advance()), BatchSize::LargeInput);
    });

    let mut grid = Grid::new(202, 202);
    grid.paint_box(200, 1, 200);
    let nodes = (1..=200).flat_map(|c| (1..=100).map(move |r| (c, r)));
    let balls: Vec<Grain> = nodes.map(|(c, r)| Grain { node: grid.index(c, r), ..Grain::default() }).collect();
    let model = LatticeGrains::new(grid, balls, 1e-4, [0.5; 2], 1);
    group.throughput(Throughput::Elements(20 * model.grains.len() as u64));
    group.bench_function("gutt-haff", |b| {
        let step = |mut model: LatticeGrains| (0..20).filter(|_| model.advance().is_err()).count();
        b.iter_batched(|| model.clone(), step, BatchSize::LargeInput);
    });

    let (sheet, grains) = bed(Layout::Triangular, 1026, 514, 513, usize::MAX);
    let rule = Rule { split: Split::Vector, friction: 0.3, arching: 0.0 };
    let pile = Pile::new(sheet, rule, vec![1.0; grains], 1);
    group.throughput(Throughput::Elements(grains as u64));
    group.bench_function("hemmingsson-herrmann", |b| {
        let sweep = |mut pile: Pile| (0..pile.rows()).for_each(|_| pile.advance(&mut |_| ()));
        b.iter_batched(|| pile.clone(), sweep, BatchSize::LargeInput);
    });
    group.finish();
}

criterion_group!(benches, sites);
criterion_main!(benches);
