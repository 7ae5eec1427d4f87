//! A look at the speed of the machine.

use tsubu::bench::{Bench, BenchError, Row};
use tsubu::interrupt::{Interrupt, Watcher};

#[test]
fn a_short_look_measures_both_pieces_of_work_on_one_thread_and_all() {
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let bench = Bench::measure(1.0, &watcher).unwrap_or_else(|error| panic!("{error}"));
    for work in ["chute", "bed"] {
        let rows: Vec<&Row> = bench.rows.iter().filter(|row| row.work == work).collect();
        assert_eq!(rows.first().map(|row| (row.threads, row.scaling)), Some((1, 1.0)));
        assert_eq!(rows.last().map(|row| row.threads), Some(bench.cores));
        assert!(rows.iter().all(|row| row.particle_steps_per_second > 1e3 && row.particles > 2000));
    }
    let stopped = Interrupt::new();
    stopped.ask();
    let watcher = Watcher { interrupt: &stopped, progress: &|_| {} };
    assert!(matches!(Bench::measure(1.0, &watcher), Err(BenchError::Interrupted)));
}
