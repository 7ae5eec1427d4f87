//! A run that goes on in this program: what of it is kept in memory for those who look.
//!
//! The run gives moments away and goes on; it waits for no page. Frames cost it at most [`SHARE`] of its time, and no more come than
//! an eye can follow.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tsubu_frame::csv::{Cell, Table};
use tsubu_frame::{Frame, Summary};

use crate::ring::Ring;

/// The share of its time that a run gives for being looked at: one over this number.
const SHARE: u32 = 80;

/// Frames do not follow one another faster than this.
const FASTEST: Duration = Duration::from_millis(50);

/// How often a frame is kept while nobody looks.
const UNSEEN: Duration = Duration::from_secs(1);

/// A page that has asked for nothing for so long is gone. Browsers let pages that are not seen ask once a minute.
const GONE: Duration = Duration::from_secs(70);

/// Rows of the history that are kept; beyond, every second goes.
const ROWS: usize = 2000;

/// A run that goes on, as pages see it.
pub struct Live {
    name: String,
    method: String,
    dimension: u32,
    groups: Vec<String>,
    stop: Box<dyn Fn() + Send + Sync>,
    paused: AtomicBool,
    contacts: AtomicBool,
    seen: Mutex<Seen>,
}

/// What is known of the run.
#[derive(Default)]
struct Seen {
    ring: Ring,
    due: Option<Instant>,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    /// Every how many rows are kept, and how many came.
    stride: usize,
    came: usize,
    stages: Vec<String>,
    verdict: String,
    /// Simulated time [s], steps, share done.
    now: (f64, u64, f64),
    /// How it ended, in a word and a sentence.
    end: Option<(&'static str, String)>,
    summary: Option<Summary>,
    pages: HashMap<String, Instant>,
}

impl Live {
    /// A run under a name. `stop` asks it to write a checkpoint and to end.
    pub fn new(name: String, method: &str, dimension: u32, stop: Box<dyn Fn() + Send + Sync>) -> Self {
        let groups = Vec::new();
        let method = method.to_owned();
        let (paused, contacts) = (AtomicBool::new(false), AtomicBool::new(false));
        Self { name, method, dimension, groups, stop, paused, contacts, seen: Mutex::default() }
    }

    /// The same, with the names of the groups of grains in the order of their numbers.
    #[must_use]
    pub fn with_groups(self, groups: Vec<String>) -> Self {
        Self { groups, ..self }
    }

    fn seen(&self) -> MutexGuard<'_, Seen> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Told by the run: a stage begins, with its number and name, and what `check` says of all so far.
    pub fn stage(&self, number: usize, name: &str, verdict: &str) {
        let mut seen = self.seen();
        seen.stages.resize(number, String::new());
        seen.stages.push(name.to_owned());
        verdict.clone_into(&mut seen.verdict);
    }

    /// Told by the run: a row of the history.
    pub fn row(&self, columns: &[String], row: &[f64]) {
        let mut seen = self.seen();
        if seen.columns.len() != columns.len() {
            (seen.columns, seen.stride) = (columns.to_vec(), 1);
        }
        if seen.came.is_multiple_of(seen.stride) {
            seen.rows.push(row.to_vec());
        }
        seen.came += 1;
        if seen.rows.len() > ROWS {
            let mut place = 0;
            seen.rows.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            seen.stride *= 2;
        }
    }

    /// Told by the run: simulated time [s], steps, and the share that is done.
    pub fn moved(&self, time: f64, steps: u64, share: f64) {
        self.seen().now = (time, steps, share);
    }

    /// Whether a frame is wanted now; with contacts, if `Some(true)`.
    pub fn wish(&self) -> Option<bool> {
        let due = self.seen().due.is_none_or(|due| due <= Instant::now());
        due.then(|| self.contacts.load(Ordering::Relaxed))
    }

    /// A frame, and how long the run has worked for it. The same moment is kept once.
    pub fn frame(&self, frame: Frame, cost: Duration) {
        let now = Instant::now();
        let mut seen = self.seen();
        let looked = seen.pages.values().any(|when| now - *when < Duration::from_secs(5));
        let pause = (SHARE * cost).max(if looked { FASTEST } else { UNSEEN });
        seen.due = Some(now + pause);
        if seen.ring.last().is_none_or(|last| last.step < frame.step) {
            seen.ring.push(frame);
        }
    }

    /// Whether somebody wants the run to stand still.
    pub fn paused(&self) -> bool {
        self.paused.load(Ordering::Relaxed)
    }

    /// Told when the run is at its end: a word (`finished`, `interrupted`, `failed`), what to do next, and its summary.
    pub fn end(&self, word: &'static str, told: String, summary: Option<Summary>) {
        let mut seen = self.seen();
        (seen.end, seen.summary) = (Some((word, told)), summary);
    }

    /// Whether a page is open that may want something.
    pub fn is_looked_at(&self) -> bool {
        self.seen().pages.values().any(|when| when.elapsed() < GONE)
    }

    /// What a page asks for with a word; whether there is such a word.
    pub(crate) fn command(&self, word: &str) -> bool {
        match word {
            "pause" => self.paused.store(true, Ordering::Relaxed),
            "go-on" => self.paused.store(false, Ordering::Relaxed),
            "stop" => (self.stop)(),
            _ => return false,
        }
        true
    }

    /// A page is there, or says that it wants nothing more.
    pub(crate) fn page(&self, page: &str, stays: bool) {
        let mut seen = self.seen();
        seen.pages.retain(|_, when| when.elapsed() < GONE);
        if stays && (seen.pages.len() < 1000 || seen.pages.contains_key(page)) {
            // A page that has just come wants to see something now.
            if seen.pages.insert(page.to_owned(), Instant::now()).is_none() {
                seen.due = None;
            }
        } else {
            seen.pages.remove(page);
        }
    }

    /// Whether pages want to see contacts; frames have them from the next on.
    pub(crate) fn want_contacts(&self, wanted: bool) {
        if wanted && !self.contacts.swap(true, Ordering::Relaxed) {
            self.seen().due = None;
        }
    }

    /// What there is, as JSON.
    pub(crate) fn about(&self) -> Value {
        let seen = self.seen();
        let paused = self.paused();
        let (status, told) = match &seen.end {
            Some((word, told)) => (*word, told.clone()),
            None if paused => ("paused", String::new()),
            None => ("running", String::new()),
        };
        let (now, steps, share) = seen.now;
        let (numbers, times): (Vec<_>, Vec<_>) = seen.ring.moments().into_iter().unzip();
        json!({
            "name": self.name,
            "live": true,
            "times": times,
            "numbers": numbers,
            "status": status,
            "told": told,
            "dimension": self.dimension,
            "groups": self.groups,
            "method": self.method,
            "stages": seen.stages.iter().filter(|name| !name.is_empty()).collect::<Vec<_>>(),
            "verdict": seen.verdict,
            "now": now,
            "steps": steps,
            "share": share,
            "claims": seen.summary.as_ref().map(|summary| &summary.claims),
        })
    }

    /// The rows of the history so far.
    pub(crate) fn history(&self) -> Option<Vec<u8>> {
        let (header, rows) = {
            let seen = self.seen();
            (seen.columns.clone(), seen.rows.clone())
        };
        let rows = rows.into_iter().map(|row| row.into_iter().map(Cell::from).collect()).collect();
        (!header.is_empty()).then(|| Table { header, rows }.to_csv().into_bytes())
    }

    /// Numbers and times [s] of the frames that are there.
    pub(crate) fn moments(&self) -> Vec<(usize, f64)> {
        self.seen().ring.moments()
    }

    /// A frame by its number.
    pub(crate) fn at(&self, number: usize) -> Option<Arc<Frame>> {
        self.seen().ring.get(number)
    }
}
