//! Watches over workers: who panics, hangs, dies, or finds something wrong.

use crate::corpus;
use crate::kind::Kind;
use crate::limits::limited;
use crate::outcome::Outcome;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How long to go on, and where to keep what is found.
pub struct Options {
    /// Seed of all cases.
    pub seed: u64,
    /// The first case.
    pub from: u64,
    /// How many cases at most.
    pub cases: u64,
    /// How long at most.
    pub time: Duration,
    /// The folder for what is found.
    pub keep: PathBuf,
}

/// What came of the cases of a kind.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Cases judged.
    pub cases: u64,
    /// Those of them that were accepted.
    pub accepted: u64,
    /// How long it took [s].
    pub seconds: f64,
    /// What was found: the text without its numbers, how often, and the first case.
    pub found: BTreeMap<String, (u64, u64)>,
}

/// Judges cases of a kind until there are enough or the time is over.
pub fn fuzz(kind: Kind, options: &Options) -> io::Result<Tally> {
    let begun = Instant::now();
    let mut tally = Tally::default();
    let last = options.from.saturating_add(options.cases);
    let mut next = options.from;
    while next < last && begun.elapsed() < options.time {
        let words = ["work".to_owned(), options.seed.to_string(), next.to_string(), last.to_string()];
        let mut worker = Worker::start(kind, &words)?;
        while next < last && begun.elapsed() < options.time {
            match worker.next(kind.limit()) {
                Ok(outcome) => tally.accepted += u64::from(outcome == Outcome::Accepted),
                Err(text) => report(kind, options, &mut tally, next, &text)?,
            }
            tally.cases += 1;
            next += 1;
            if worker.lost {
                break;
            }
        }
    }
    tally.seconds = begun.elapsed().as_secs_f64();
    Ok(tally)
}

/// Tells and keeps the first case of each kind of trouble.
fn report(kind: Kind, options: &Options, tally: &mut Tally, number: u64, text: &str) -> io::Result<()> {
    let entry = tally.found.entry(signature(text)).or_insert((0, number));
    entry.0 += 1;
    if entry.0 > 1 {
        return Ok(());
    }
    let name = format!("{}-{number}", options.seed);
    let folder = corpus::keep(&options.keep, kind, &name, &kind.draw(options.seed, number))?;
    eprintln!("{} {number}: {text}\n  kept in {}", kind.name(), folder.display());
    Ok(())
}

/// The text without what differs from case to case.
fn signature(text: &str) -> String {
    let mut quoted = false;
    let plain = |c: char| {
        let tick = c == '`' || c == '"';
        quoted ^= tick;
        (!quoted && !c.is_ascii_digit()).then_some(c)
    };
    // Where a panic lies tells it from others.
    match text.split_once("panicked at ") {
        Some((_, rest)) => rest.lines().next().unwrap_or_default().to_owned(),
        None => text.lines().next().unwrap_or_default().chars().filter_map(plain).take(80).collect(),
    }
}

/// Judges a kept case.
pub fn replay(kind: Kind, folder: &Path) -> io::Result<Result<Outcome, String>> {
    let words = ["judge".to_owned(), folder.display().to_string()];
    Ok(Worker::start(kind, &words)?.next(kind.limit()))
}

/// A folder for a worker: in memory, where there is such a place, for a million small files.
fn scratch() -> io::Result<TempDir> {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir())
}

/// A worker and what it says.
struct Worker {
    child: Child,
    lines: Receiver<String>,
    errors: File,
    lost: bool,
    /// Where it works; it may not live to clean up itself.
    _folder: TempDir,
}

impl Worker {
    fn start(kind: Kind, words: &[String]) -> io::Result<Self> {
        let errors = tempfile::tempfile()?;
        let folder = scratch()?;
        let mut child = limited(std::env::current_exe()?)
            .args(&words[..1])
            .arg(kind.name())
            .arg(folder.path())
            .args(&words[1..])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(errors.try_clone()?)
            .spawn()?;
        let (send, lines) = mpsc::channel();
        if let Some(out) = child.stdout.take() {
            std::thread::spawn(move || {
                for line in BufReader::new(out).lines().map_while(Result::ok) {
                    if send.send(line).is_err() {
                        break;
                    }
                }
            });
        }
        Ok(Self { child, lines, errors, lost: false, _folder: folder })
    }

    /// What comes of the next case: what the worker says, or how it was lost.
    fn next(&mut self, limit: Duration) -> Result<Outcome, String> {
        let line = self.lines.recv_timeout(limit);
        self.lost = line.is_err();
        match line.as_deref() {
            Ok("accepted") => Ok(Outcome::Accepted),
            Ok("refused") => Ok(Outcome::Refused),
            Ok(line) => {
                let text = line.strip_prefix("found ").and_then(|text| serde_json::from_str(text).ok());
                Err(text.unwrap_or_else(|| line.to_owned()))
            }
            Err(RecvTimeoutError::Timeout) => Err(format!("no answer within {} s", limit.as_secs())),
            Err(RecvTimeoutError::Disconnected) => Err(self.last_words()),
        }
    }

    /// Why it died, as far as it could say.
    fn last_words(&mut self) -> String {
        let status = self.child.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let mut text = String::new();
        let read = self.errors.rewind().and_then(|()| self.errors.read_to_string(&mut text));
        let words = text.trim().lines().last().filter(|_| read.is_ok()).unwrap_or_default();
        format!("the program died ({status}): {words}")
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
