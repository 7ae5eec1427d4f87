//! What other machines on a host do to this one, which no load shows: the same run of the same program was half as fast at times.
//!
//! - **The far cache**, shared by all. It is seen in a walk through memory that the cache can just hold, every step of which
//!   waits for the one before: 20 ns a step on an AMD EPYC that is left alone, 60 to 140 where others fill it.
//! - **Where the cores are.** A host moves virtual cores about. Two that share a far cache hand a line of it to and fro in 50
//!   to 110 ns, two that do not (other core complexes, other sockets) in 320 to 410.

use std::hint::{black_box, spin_loop};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread::{available_parallelism, scope, sleep};
use std::time::{Duration, Instant};

/// Lines of the walk: 8 MiB, more than a core has for itself and less than most share.
const LINES: usize = 1 << 17;
const LAPS: u32 = 10;
const ROUND_TRIPS: u32 = 20_000;
/// A step of the walk so many times as long as the quickest tells of others.
const SLOW_STEP: f64 = 1.5;
/// A round trip so many times as long as the quickest tells of cores that are far from each other.
const FAR_CORES: f64 = 3.0;
/// The longest wait for one run.
const WAIT: Duration = Duration::from_secs(20);

/// One line of the cache: where the next one lies.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Line(u32);

/// What a look at the host found [ns].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// A step of the walk through the far cache.
    pub step: f64,
    /// A line of the cache to the other core and back.
    pub trip: f64,
}

/// The host, by what can be felt of it.
#[derive(Debug)]
pub struct Host {
    walk: Vec<Line>,
    quickest: Look,
    /// How much longer runs may be put off and repeated for its sake.
    pub patience: Duration,
}

impl Host {
    pub fn new() -> Self {
        let quickest = Look { step: f64::INFINITY, trip: f64::INFINITY };
        let mut host = Self { walk: walk(), quickest, patience: Duration::ZERO };
        for _ in 0..10 {
            host.look();
        }
        host
    }

    /// How quick it is now.
    pub fn look(&mut self) -> Look {
        self.lap();
        let begun = Instant::now();
        for _ in 0..LAPS {
            self.lap();
        }
        let step = nanoseconds(begun) / (f64::from(LAPS) * LINES as f64);
        let look = Look { step, trip: round_trip() };
        self.quickest.step = self.quickest.step.min(look.step);
        self.quickest.trip = self.quickest.trip.min(look.trip);
        look
    }

    fn lap(&self) {
        let mut line = 0;
        for _ in 0..LINES {
            line = self.walk[line].0 as usize;
        }
        black_box(line);
    }

    /// Whether a look tells of others, to who runs on so many cores.
    pub fn disturbed(&self, look: Look, cores: u32) -> bool {
        look.step > SLOW_STEP * self.quickest.step || cores > 1 && look.trip > FAR_CORES * self.quickest.trip
    }

    /// Waits a while for others to leave it alone, if there is patience; says how quick it is then.
    pub fn wait(&mut self, cores: u32) -> Look {
        let begun = Instant::now();
        loop {
            let look = self.look();
            if !self.disturbed(look, cores) || begun.elapsed() > WAIT.min(self.patience) {
                self.lose(begun.elapsed());
                return look;
            }
            sleep(Duration::from_millis(300));
        }
    }

    /// So much time went by for its sake.
    pub fn lose(&mut self, time: Duration) {
        self.patience = self.patience.saturating_sub(time);
    }
}

/// A congruence of full period (Hull and Dobell 1962) comes by every line once, in no order that a cache foresees.
fn walk() -> Vec<Line> {
    (0..LINES).map(|line| Line(((line * 0x9E35 + 0x6D2B) % LINES) as u32)).collect()
}

/// How long a line of the cache takes to another core and back [ns]. Two threads that never sleep are on two cores; where there
/// is but one core, 0.
fn round_trip() -> f64 {
    if available_parallelism().map_or(1, usize::from) < 2 {
        return 0.0;
    }
    let ball = &Ball(AtomicU32::new(0));
    let throw = |number: u32| ball.0.store(number, Ordering::Release);
    let catch = |number: u32| {
        while ball.0.load(Ordering::Acquire) != number {
            spin_loop();
        }
    };
    scope(|scope| {
        scope.spawn(move || {
            for trip in 0..ROUND_TRIPS {
                catch(2 * trip + 1);
                throw(2 * trip + 2);
            }
        });
        let mut begun = Instant::now();
        for trip in 0..ROUND_TRIPS {
            throw(2 * trip + 1);
            catch(2 * trip + 2);
            if trip == 0 {
                // The other thread is there.
                begun = Instant::now();
            }
        }
        nanoseconds(begun) / f64::from(ROUND_TRIPS - 1)
    })
}

/// On a line of the cache of its own.
#[derive(Debug)]
#[repr(align(128))]
struct Ball(AtomicU32);

fn nanoseconds(begun: Instant) -> f64 {
    begun.elapsed().as_secs_f64() * 1e9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_walk_comes_by_every_line() {
        let (walk, mut line, mut seen) = (walk(), 0, vec![false; LINES]);
        for _ in 0..LINES {
            seen[line] = true;
            line = walk[line].0 as usize;
        }
        assert!(line == 0 && seen.into_iter().all(|s| s));
    }

    #[test]
    fn others_are_told_from_the_quickest() {
        let host = Host { walk: Vec::new(), quickest: Look { step: 20.0, trip: 50.0 }, patience: Duration::ZERO };
        let disturbed = |step, trip, cores| host.disturbed(Look { step, trip }, cores);
        assert!(disturbed(31.0, 50.0, 1) && !disturbed(29.0, 149.0, 2));
        assert!(disturbed(20.0, 330.0, 2) && !disturbed(20.0, 330.0, 1));
    }
}
