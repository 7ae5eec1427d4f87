//! How quick the cache is that the cores share with the rest of the host.
//!
//! What other machines on a host do to the cache they all share is seen in no load: the same run of the same program was half as
//! fast at times. It is seen in a walk through memory that the cache can just hold, every step of which waits for the one
//! before: 20 ns a step on an AMD EPYC that is left alone, 60 to 110 where others fill it.

use std::hint::black_box;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Lines of the walk: 8 MiB, more than a core has for itself and less than most share.
const LINES: usize = 1 << 17;
const LAPS: u32 = 10;
/// A step so many times as long as the quickest tells of others.
const SLOW: f64 = 1.5;
const PATIENCE: Duration = Duration::from_secs(20);

/// One line of the cache: where the next one lies.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Line(u32);

/// The walk.
#[derive(Debug)]
pub struct FarCache {
    lines: Vec<Line>,
    /// The quickest step so far [ns].
    quickest: f64,
}

impl FarCache {
    pub fn new() -> Self {
        // A congruence of full period (Hull and Dobell 1962) comes by every line once, in no order that a cache foresees.
        let next = |line: usize| (line * 0x9E35 + 0x6D2B) % LINES;
        let mut cache =
            Self { lines: (0..LINES).map(|line| Line(next(line) as u32)).collect(), quickest: f64::INFINITY };
        for _ in 0..10 {
            cache.step();
        }
        cache
    }

    /// How long a step takes now [ns].
    pub fn step(&mut self) -> f64 {
        self.lap();
        let begun = Instant::now();
        for _ in 0..LAPS {
            self.lap();
        }
        let step = begun.elapsed().as_secs_f64() * 1e9 / (f64::from(LAPS) * LINES as f64);
        self.quickest = self.quickest.min(step);
        step
    }

    fn lap(&self) {
        let mut line = 0;
        for _ in 0..LINES {
            line = self.lines[line].0 as usize;
        }
        black_box(line);
    }

    /// Whether a step of so many nanoseconds tells of others.
    pub fn slow(&self, step: f64) -> bool {
        step > SLOW * self.quickest
    }

    /// Waits a while for others to leave the cache alone; says how long a step takes then [ns].
    pub fn wait(&mut self) -> f64 {
        let begun = Instant::now();
        loop {
            let step = self.step();
            if !self.slow(step) || begun.elapsed() > PATIENCE {
                return step;
            }
            sleep(Duration::from_millis(300));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_walk_comes_by_every_line() {
        let cache = FarCache::new();
        let (mut line, mut seen) = (0, vec![false; LINES]);
        for _ in 0..LINES {
            seen[line] = true;
            line = cache.lines[line].0 as usize;
        }
        assert!(line == 0 && seen.into_iter().all(|s| s));
    }

    #[test]
    fn slow_is_told_from_the_quickest() {
        let cache = FarCache { lines: Vec::new(), quickest: 20.0 };
        assert!(cache.slow(31.0) && !cache.slow(29.0));
    }
}
