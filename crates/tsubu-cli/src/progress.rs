//! Progress: a bar on a terminal, a line now and then elsewhere, nothing when asked to be quiet.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use tsubu::check::human_time;

/// Shows how much is done.
pub struct Progress {
    bar: ProgressBar,
    started: Instant,
    pace: Mutex<Pace>,
    lines: Option<Mutex<Lines>>,
}

/// What was said so far where there is no terminal.
struct Lines {
    name: String,
    spoke: Instant,
    next: f64,
}

/// How long it will still take.
///
/// News come in bursts, when a case of many is done, and steps are not all as long; an estimate from the last of them jumps.
/// This one counts down, and is drawn towards what the pace since the beginning says.
#[derive(Default)]
struct Pace {
    /// Time and share of the first news: a resumed run does not begin at zero.
    first: Option<(f64, f64)>,
    /// When something was last said, and what.
    told: Option<(f64, f64)>,
}

impl Pace {
    /// Time left [s] after so many seconds, with this share done.
    fn left(&mut self, now: f64, done: f64) -> Option<f64> {
        let (begun, first) = *self.first.get_or_insert((now, done));
        // The first news says nothing about how fast this goes.
        if done <= first {
            return None;
        }
        let by_pace = (now - begun) * (1.0 - done) / (done - first);
        let left = match self.told {
            None => by_pace,
            Some((when, told)) => {
                let passed = now - when;
                let counted = (told - passed).max(0.0);
                // Within a tenth of what is left it follows a new pace.
                counted + (by_pace - counted) * (passed / (0.1 * by_pace + 1.0)).min(1.0)
            }
        };
        self.told = Some((now, left));
        Some(left)
    }
}

/// Parts of the bar; finer than any terminal is wide.
const WHOLE: u64 = 10_000;
/// Lines that come faster than this are noise in a log.
const PAUSE: Duration = Duration::from_secs(2);

impl Progress {
    /// Begins to show the progress of something called `name`.
    pub fn new(name: &str, quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        if quiet || !terminal {
            let now = Instant::now();
            let lines = Lines { name: name.to_owned(), spoke: now, next: 0.1 };
            return Self::with(ProgressBar::hidden(), (!quiet).then(|| Mutex::new(lines)));
        }
        let bar = ProgressBar::with_draw_target(Some(WHOLE), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  preparing, {elapsed}") {
            bar.set_style(style);
        }
        bar.set_message(name.to_owned());
        bar.enable_steady_tick(Duration::from_millis(100));
        Self::with(bar, None)
    }

    fn with(bar: ProgressBar, lines: Option<Mutex<Lines>>) -> Self {
        Self { bar, started: Instant::now(), pace: Mutex::default(), lines }
    }

    /// Told by whoever works: the share that is done, 0 to 1.
    pub fn set(&self, done: f64) {
        let now = self.started.elapsed().as_secs_f64();
        let left = self.pace.lock().ok().and_then(|mut pace| pace.left(now, done));
        let left = left.map(|left| format!("about {} left", human_time(left.max(1.0).round())));
        if let Some(lines) = &self.lines {
            if let Ok(mut lines) = lines.lock() {
                lines.set(done, left);
            }
            return;
        }
        if self.bar.position() == 0
            && let Ok(style) = ProgressStyle::with_template("{msg} [{wide_bar}] {percent:>3} % {prefix}")
        {
            self.bar.set_style(style.progress_chars("=> "));
        }
        self.bar.set_prefix(left.unwrap_or_default());
        self.bar.set_position((done * WHOLE as f64) as u64);
    }

    /// Does something that prints, with the bar out of the way.
    pub fn hide_while<T>(&self, work: impl FnOnce() -> T) -> T {
        self.bar.suspend(work)
    }

    /// Removes the bar, so that what is printed next begins on a clean line.
    pub fn end(&self) {
        self.bar.finish_and_clear();
    }
}

impl Lines {
    fn set(&mut self, done: f64, left: Option<String>) {
        if done < self.next || done >= 1.0 || self.spoke.elapsed() < PAUSE {
            return;
        }
        let left = left.map_or(String::new(), |left| format!(", {left}"));
        crate::output::tell(&format!("{}: {:.0} %{left}\n", self.name, 100.0 * done));
        self.spoke = Instant::now();
        self.next = (10.0 * done + 1e-9).floor() / 10.0 + 0.1;
    }
}

#[cfg(test)]
mod tests {
    use super::Pace;

    /// The remaining time jumped whenever a case of many was done, and at each of a run's slower stretches.
    #[test]
    fn the_remaining_time_counts_down_without_jumps() {
        // Cases of 8 and of 12 s by turns, told as they end; in between the same share again and again.
        let ends: Vec<f64> =
            (1..=20).map(|case| 10.0 * f64::from(case) + if case % 2 == 1 { -2.0 } else { 0.0 }).collect();
        let mut pace = Pace::default();
        assert_eq!(pace.left(0.0, 0.0), None);
        let mut last: Option<f64> = None;
        for tenth in 1..2000 {
            let now = 0.1 * f64::from(tenth);
            let done = ends.iter().filter(|end| **end <= now).count() as f64 / ends.len() as f64;
            let Some(left) = pace.left(now, done) else { continue };
            assert!(last.is_none_or(|last| (left - last).abs() < 1.0), "{now} s: {left} s after {last:?}");
            // Between the ends of cases, 10 s apart, nobody knows how much of them is done.
            let rest = 200.0 - now;
            assert!(now < 40.0 || (left - rest).abs() < 0.25 * rest + 10.0, "{now} s: {left} s");
            last = Some(left);
        }
    }

    /// What was done before a resume says nothing about how fast this goes.
    #[test]
    fn a_resumed_run_does_not_begin_at_zero() {
        let mut pace = Pace::default();
        assert_eq!(pace.left(5.0, 0.5), None);
        assert!(pace.left(15.0, 0.6).is_some_and(|left| (left - 40.0).abs() < 1e-9));
    }
}
