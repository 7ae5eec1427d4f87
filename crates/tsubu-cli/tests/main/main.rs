//! The program as a user meets it: what it prints, how it exits, what it leaves behind.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop where it is")]

/// Messages about bad input of walls, files, boundaries and laws.
mod bad_input;
/// The same bits for any number of threads, and after a kill or Ctrl-C.
mod bits;
/// Lists, schema, completion, help: commands that run nothing.
mod commands;
/// Files beside a scene, in folders of results.
mod companions;
/// What a run folder holds.
mod folder;
/// Signals, locks, and intervals that would never end.
mod interrupts;
/// Runs of a study done apart, as a cluster does them.
mod launch;
mod live;
/// What is said when something is wrong.
mod messages;
/// The table of what works.
mod readme;
/// Every shipped scene runs and closes its books.
mod scenes;
/// Response, sweep, comparison, verification.
mod studies;
/// A place to work in, and small scenes.
mod support;
mod sweeps;
