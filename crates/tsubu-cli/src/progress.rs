//! Progress: a bar on a terminal, a line now and then elsewhere, nothing when asked to be quiet.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use tsubu::check::human_time;

/// Shows how much is done.
pub struct Progress {
    bar: ProgressBar,
    lines: Option<Mutex<Lines>>,
}

/// What was said so far where there is no terminal.
struct Lines {
    name: String,
    started: Instant,
    spoke: Instant,
    /// Share that was done when the first news came: a resumed run does not begin at zero.
    first: Option<f64>,
    next: f64,
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
            let lines = Lines { name: name.to_owned(), started: now, spoke: now, first: None, next: 0.1 };
            return Self { bar: ProgressBar::hidden(), lines: (!quiet).then(|| Mutex::new(lines)) };
        }
        let bar = ProgressBar::with_draw_target(Some(WHOLE), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  preparing, {elapsed}") {
            bar.set_style(style);
        }
        bar.set_message(name.to_owned());
        bar.enable_steady_tick(Duration::from_millis(100));
        Self { bar, lines: None }
    }

    /// Told by whoever works: the share that is done, 0 to 1.
    pub fn set(&self, done: f64) {
        if let Some(lines) = &self.lines {
            if let Ok(mut lines) = lines.lock() {
                lines.set(done);
            }
            return;
        }
        if self.bar.position() == 0 {
            if let Ok(style) = ProgressStyle::with_template("{msg} [{wide_bar}] {percent:>3} %, {eta} left") {
                self.bar.set_style(style.progress_chars("=> "));
            }
            // What was done before a resume says nothing about how fast this goes.
            self.bar.set_position((done * WHOLE as f64) as u64);
            self.bar.reset_eta();
        }
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
    fn set(&mut self, done: f64) {
        let first = *self.first.get_or_insert(done);
        if done < self.next || done >= 1.0 || self.spoke.elapsed() < PAUSE {
            return;
        }
        // The first news says nothing about how fast this goes.
        let left = (done > first).then(|| self.started.elapsed().as_secs_f64() * (1.0 - done) / (done - first));
        let left = left.map_or(String::new(), |left| format!(", about {} left", human_time(left.max(1.0).round())));
        crate::output::tell(&format!("{}: {:.0} %{left}\n", self.name, 100.0 * done));
        self.spoke = Instant::now();
        self.next = (10.0 * done + 1e-9).floor() / 10.0 + 0.1;
    }
}
