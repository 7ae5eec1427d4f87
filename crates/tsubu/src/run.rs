//! One run: from a scene to a run folder.

mod error;
mod leader;
mod lost;
mod measured;
mod onlooker;
mod outputs;
mod resume;
mod rows;
mod simulation;
mod stages;
mod start;
mod steady;
mod told;
mod ways;

pub use error::RunError;
pub use leader::follow;
pub use onlooker::{Onlooker, Wish};
pub(crate) use outputs::formats;
pub(crate) use resume::what_differs;
pub use simulation::Simulation;
pub(crate) use told::judge;
pub(crate) use ways::one_of_many;
pub use ways::{run, run_on_ranks, run_seen};

use crate::engine::Engine;
use crate::interrupt::Watcher;
use crate::ledger::Ledger;
use crate::partner::Hosts;
use crate::watch::{Trigger, Watches};
use crate::{scene_files, shape_mesh};
use leader::Leader;
use lost::Lost;
use measured::Measured;
use outputs::Outputs;
use stages::Stages;
use start::Start;
use std::iter;
use std::path::Path;
use std::time::{Duration, Instant};
use tsubu_frame::{
    Advise, Existing, FileError, Frame, FrameWriter, Header, History, Mark, RunFolder, State, Status, Summary,
    checkpoint,
};
use tsubu_scene::{Plan, Scene};
use ways::Manner;

fn work(
    scene: &Scene,
    folder: &Path,
    existing: Existing,
    watcher: &Watcher,
    manner: Manner,
) -> Result<Summary, RunError> {
    let Manner { alone, onlooker, communicator } = manner;
    let resumed = existing == Existing::Resume;
    let scene = &if resumed { resume::scene(scene, folder) } else { scene.clone() };
    let plans = scene.plans();
    let plan = scene.plan();
    let Start { engine, hosts, ledger } = Start::of(scene, communicator.as_ref())?;
    let engine = Leader::of(engine, communicator);
    let last = engine.stage_begin().0 + steps(plan, &*engine)?;
    let mut run = Run {
        ledger,
        measured: Measured::new(&hosts),
        lost: Lost::new(&*engine),
        watches: Watches::new(plan, &*engine),
        scene_hash: scene_hash(&scene.steps_toml()),
        wall_before: 0.0,
        started: Instant::now(),
        last,
        alone,
        plan,
        stages: Stages::new(plans, &*engine, &hosts),
        first: engine.steps(),
        hosts,
        engine,
        onlooker,
        idle: Duration::ZERO,
    };
    // From here on there is something to lose.
    let _held = watcher.interrupt.hold();
    let (names, header) = (run.names(scene), run.columns()?);
    let folder = RunFolder::create(folder, existing, &names)?;
    run.stages.columns.clone_from(&header);
    run.find_places();
    let describe = |verdicts: &str| {
        folder.claim(&names)?;
        scene_files::write(&folder, scene)?;
        shape_mesh::write(&folder, scene)?;
        folder.write("check.txt", verdicts.as_bytes())
    };
    let outputs = if resumed {
        // All is looked at before anything is written.
        let mark = run.resume(scene, folder.path())?;
        let history = History::resume(&folder.file("history.csv"), &header, mark)?;
        run.watches.resume(folder.path())?;
        let mut frames = FrameWriter::resume(folder.path(), formats(run.plan), run.engine.time())?;
        describe(&run.stages.verdicts)?;
        frames.cut()?;
        Outputs { history, frames }
    } else {
        describe(&run.stages.verdicts)?;
        run.watches.create(&folder)?;
        let history = History::create(&folder.file("history.csv"), &header)?;
        Outputs { history, frames: FrameWriter::create(folder.path(), formats(plan)) }
    };
    run.go(&folder, outputs, watcher)
}

/// The number of steps of a run; one without any is refused.
pub(crate) fn steps(plan: &Plan, engine: &dyn Engine) -> Result<u64, RunError> {
    let (duration, dt) = (plan.duration, engine.time_step());
    match step_of(duration, dt) {
        0 => Err(RunError::NoStep { duration, dt }),
        steps => Ok(steps),
    }
}

/// Hash of a scene as text: what a checkpoint or a journal belongs to.
pub fn scene_hash(resolved: &str) -> String {
    let mut state = State::default();
    state.put_text("scene", resolved);
    state.hash()
}

/// Section of a checkpoint: how far `history.csv` had come.
const HISTORY: &str = "run.history";

/// A run in progress.
struct Run<'a> {
    plan: &'a Plan,
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
    measured: Measured,
    lost: Lost,
    watches: Watches,
    scene_hash: String,
    wall_before: f64,
    started: Instant,
    /// The step that this stage of it ends with.
    last: u64,
    alone: bool,
    stages: Stages<'a>,
    /// The step it begins with.
    first: u64,
    onlooker: Option<&'a dyn Onlooker>,
    /// How long it has stood still because an onlooker wished so.
    idle: Duration,
}

/// Checkpoints that come faster than this would take longer than what they save.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_millis(100);

impl Run<'_> {
    /// The files that it writes.
    fn names(&self, scene: &Scene) -> Vec<String> {
        let mut names = [scene_files::names(scene), shape_mesh::names(scene)].concat();
        names.extend(["check.txt", "summary.json", "history.csv", "checkpoint/state.tsubu"].map(str::to_owned));
        let pictures = self.stages.plans.iter().any(|plan| plan.output.frame_interval.is_some());
        names.extend(pictures.then(|| "frames/".to_owned()));
        names.extend(self.stages.plans.iter().flat_map(|plan| Watches::new(plan, &*self.engine).files()));
        names.sort();
        names.dedup();
        names
    }

    /// To the end, or to where a file cannot be written.
    fn go(&mut self, folder: &RunFolder, mut out: Outputs, watcher: &Watcher) -> Result<Summary, RunError> {
        self.stage_by_stage(folder, &mut out, watcher).map_err(|error| match error {
            RunError::File(error) => self.stopped(folder, &mut out, error),
            other => other,
        })
    }

    fn stage_by_stage(
        &mut self,
        folder: &RunFolder,
        out: &mut Outputs,
        watcher: &Watcher,
    ) -> Result<Summary, RunError> {
        loop {
            match self.stage(folder, out, watcher)? {
                Some(interrupted) => return Ok(interrupted),
                None if self.stages.is_last() => return self.finish(folder, out),
                None => {
                    self.next_stage(folder)?;
                    out.frames.set_formats(formats(self.plan));
                }
            }
        }
    }

    /// Leaves what finds room on a disk that may be full: rows, then what became of the run.
    fn stopped(&mut self, folder: &RunFolder, out: &mut Outputs, error: FileError) -> RunError {
        let error = RunError::Stopped { step: self.engine.steps(), time: self.engine.time(), error };
        let mut summary = self.summary(Status::Failed);
        summary.warnings.push(error.told());
        // A second error says nothing new.
        let _ = (out.history.flush(), self.watches.flush(), out.frames.flush(), Self::end(folder, &summary));
        error
    }

    /// What is written of this moment, part by part: the list of contacts is given back before grains are asked for.
    fn picture(&self) -> impl Iterator<Item = Frame> {
        let wanted = self.plan.output.contacts;
        let contacts = iter::once_with(move || if wanted { self.engine.contact_frame() } else { Frame::default() });
        contacts.chain(iter::once_with(|| self.engine.grain_frame(&self.hosts)))
    }

    /// One stage to its end; a summary where the run was interrupted before it.
    fn stage(&mut self, folder: &RunFolder, out: &mut Outputs, watcher: &Watcher) -> Result<Option<Summary>, RunError> {
        let output = &self.plan.output;
        let (begin, _) = self.engine.stage_begin();
        let clock = |interval: f64| Trigger::each(interval, self.engine.time_step()).beginning(begin);
        let (rows, saves) = (clock(output.history_interval), clock(output.checkpoint_interval));
        let pictures = output.frame_interval.map(clock);
        self.tell_stage();
        if self.engine.steps() == self.first {
            self.watches.look(&*self.engine, &self.hosts)?;
            out.history.append(&self.row())?;
            if pictures.is_some() {
                out.frames.write_parts(self.picture())?;
            }
        }
        let mut block = 1;
        let mut saved = Instant::now();
        while self.engine.steps() < self.last {
            let (now, last) = (self.engine.steps(), self.last);
            let next_picture = pictures.map_or(u64::MAX, |p| p.after(now));
            let (next_row, next_save, next_look) = (rows.after(now), saves.after(now), self.watches.next(now));
            let event = next_row.min(next_picture).min(next_save).min(next_look).min(last);
            // Who asks the run to stop is answered after another step, which is done to its end.
            let stop = watcher.interrupt.asked();
            let target = event.min(now + if stop { 1 } else { block });
            let seen = target == event || stop || self.onlooker.is_some();
            let begun = Instant::now();
            let (steps, hosts, ledger) = (target - now, &mut self.hosts, &mut self.ledger);
            let moved = if seen {
                self.engine.advance(steps, hosts, ledger)
            } else {
                self.engine.advance_unseen(steps, hosts, ledger)
            };
            if let Err(fault) = moved {
                self.sync(folder, out)?;
                let mut summary = self.summary(Status::Failed);
                summary.warnings.push(fault.told());
                Self::end(folder, &summary)?;
                return Err(fault.into());
            }
            // Short enough to answer Ctrl-C at once, long enough that nothing here is felt.
            block = if begun.elapsed().as_millis() < 20 { (2 * block).min(1 << 20) } else { (block / 2).max(1) };
            if target == next_look {
                self.watches.look(&*self.engine, &self.hosts)?;
            }
            if target == next_row || target == last {
                let row = self.row();
                out.history.append(&row)?;
                if self.over(&row) {
                    self.last = target;
                }
            }
            let last = self.last;
            if target == next_picture {
                out.frames.write_parts(self.picture())?;
            }
            let share = (target - begin) as f64 / (last - begin).max(1) as f64;
            let share = self.stages.share_done(share);
            self.be_seen(share, target == last, watcher.interrupt);
            let due = target == next_save && saved.elapsed() >= BETWEEN_CHECKPOINTS;
            let end = target == last && self.stages.is_last();
            if due || (end && self.alone) || (stop && !end) {
                self.save(folder, out)?;
                saved = Instant::now();
            }
            (watcher.progress)(share);
            if stop && !end {
                let summary = self.summary(Status::Interrupted);
                Self::end(folder, &summary)?;
                return Ok(Some(summary));
            }
        }
        Ok(None)
    }

    /// Leaves everything as a run that came to its end does.
    fn finish(&mut self, folder: &RunFolder, out: &mut Outputs) -> Result<Summary, RunError> {
        if self.alone {
            self.sync(folder, out)?;
        } else {
            out.history.flush()?;
            self.watches.flush()?;
            out.frames.flush()?;
        }
        let summary = self.summary(Status::Finished);
        folder.write_json("summary.json", &summary)?;
        if self.alone {
            folder.sync()?;
        } else {
            // One of many keeps none once it is done; that of an earlier moment would be taken for its end.
            checkpoint::remove(folder.path())?;
        }
        Ok(summary)
    }

    /// Waits until all that was written is on the disk.
    fn sync(&mut self, folder: &RunFolder, out: &mut Outputs) -> Result<Mark, FileError> {
        let mark = out.history.sync()?;
        self.watches.sync()?;
        out.frames.sync()?;
        folder.sync()?;
        Ok(mark)
    }

    fn end(folder: &RunFolder, summary: &Summary) -> Result<(), FileError> {
        folder.write_json("summary.json", summary)?;
        folder.sync()
    }

    fn save(&mut self, folder: &RunFolder, out: &mut Outputs) -> Result<(), FileError> {
        let mark = self.sync(folder, out)?;
        let mut state = self.state();
        self.measured.save(&mut state);
        self.lost.save(&mut state);
        self.watches.save(&mut state);
        self.stages.save(&mut state);
        state.put_real("run.wall-seconds", vec![self.wall_seconds()]);
        state.put_integer(HISTORY, mark.numbers());
        let header = Header {
            tsubu_version: crate::VERSION.to_owned(),
            scene_hash: self.scene_hash.clone(),
            step: self.engine.steps(),
            time: self.engine.time(),
        };
        checkpoint::write(folder.path(), &state, &header)
    }

    fn state(&self) -> State<'_> {
        let mut state = State::default();
        self.engine.save(&mut state);
        self.hosts.save(&mut state);
        self.ledger.save(&mut state);
        state
    }

    fn wall_seconds(&self) -> f64 {
        self.wall_before + self.started.elapsed().saturating_sub(self.idle).as_secs_f64()
    }
}

/// Number of the step that ends nearest to `time`.
fn step_of(time: f64, dt: f64) -> u64 {
    (time / dt).round() as u64
}
