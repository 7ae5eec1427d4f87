//! One run: from a scene to a run folder.

use crate::check;
use crate::engine::{self, Engine, Fault, OpenError};
use crate::ledger::{Account, Ledger, Stocks};
use crate::partner::Hosts;
use crate::scene_files;
use crate::watch::Watches;
use crate::watch::means::Means;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{
    CheckpointError, Claim, Existing, FileError, Formats, FrameWriter, Header, History, ResultValue, RunFolder, State,
    Status, Summary, checkpoint,
};
use tsubu_scene::{Plan, Scene};

/// Whoever started the run: may stop it, wants to see it move.
pub struct Watcher<'a> {
    /// Set it and the run writes a checkpoint and stops.
    pub interrupted: &'a AtomicBool,
    /// Called now and then with the share that is done, 0 to 1.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The scene cannot be run by this method, or its grains would not settle; nothing was written.
    #[error(transparent)]
    Open(OpenError),
    /// A file or folder.
    #[error(transparent)]
    File(#[from] FileError),
    /// A checkpoint that cannot be gone on from.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A checkpoint of another scene, or of another version.
    #[error("{0}\nhint: run without `--resume` into another folder, or with `--overwrite`")]
    NotThisScene(String),
    /// The run went wrong; what was computed so far is in the folder.
    #[error("{0}")]
    Fault(#[from] Fault),
}

impl From<OpenError> for RunError {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Running(fault) => Self::Fault(fault),
            other => Self::Open(other),
        }
    }
}

impl From<MissingSection> for RunError {
    fn from(error: MissingSection) -> Self {
        Self::NotThisScene(error.to_string())
    }
}

/// Runs a scene to its end, or until it is interrupted, into `folder`.
pub fn run(scene: &Scene, folder: &Path, existing: Existing, watcher: &Watcher) -> Result<Summary, RunError> {
    let plan = scene.plan();
    let hosts = Hosts::new(&plan.hosts);
    let engine = engine::open(plan, &hosts)?;
    let folder = RunFolder::create(folder, existing)?;
    let mut run = Run {
        ledger: Ledger::open(engine::stocks(&*engine, &hosts), engine.momentum()),
        measured: Measured::new(&hosts),
        watches: Watches::new(plan, &*engine),
        scene_hash: scene_hash(&scene.steps_toml()),
        wall_before: 0.0,
        started: Instant::now(),
        plan,
        hosts,
        engine,
    };
    let header = run.header();
    let verdict = check::verdict(plan, &run.hosts, &*run.engine);
    let describe = || {
        scene_files::write(&folder, scene)?;
        folder.write("check.txt", verdict.to_string().as_bytes())
    };
    let (history, frames) = if existing == Existing::Resume {
        run.resume(folder.path())?;
        // A run may go on longer than it was meant to.
        describe()?;
        let time = run.engine.time();
        let history = History::resume(&folder.file("history.csv"), &header, time)?;
        run.watches.resume(folder.path(), time)?;
        (history, FrameWriter::resume(folder.path(), formats(plan), time)?)
    } else {
        describe()?;
        run.watches.create(folder.path())?;
        (History::create(&folder.file("history.csv"), &header)?, FrameWriter::create(folder.path(), formats(plan))?)
    };
    run.go(&folder, history, frames, watcher)
}

/// What frames are written in beside VTK.
pub(crate) const fn formats(plan: &Plan) -> Formats {
    Formats { xyz: plan.output.xyz, lammps: plan.output.lammps }
}

/// Hash of a scene as text: what a checkpoint or a journal belongs to.
pub fn scene_hash(resolved: &str) -> String {
    let mut state = State::default();
    state.put_text("scene", resolved);
    state.hash()
}

/// A run in progress.
struct Run<'a> {
    plan: &'a Plan,
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
    measured: Measured,
    watches: Watches,
    scene_hash: String,
    wall_before: f64,
    started: Instant,
}

impl Run<'_> {
    fn go(
        &mut self,
        folder: &RunFolder,
        mut history: History,
        mut frames: FrameWriter,
        watcher: &Watcher,
    ) -> Result<Summary, RunError> {
        let output = &self.plan.output;
        let last = step_of(self.plan.duration, self.engine.time_step());
        let clock = |interval: f64| Clock { interval, dt: self.engine.time_step() };
        let rows = clock(output.history_interval);
        let pictures = output.frame_interval.map(clock);
        let saves = clock(output.checkpoint_interval);
        let resumed = self.engine.steps() > 0;
        if !resumed {
            self.watches.look(&*self.engine)?;
            history.append(&self.row())?;
            if pictures.is_some() {
                frames.write(&self.engine.frame(&self.hosts))?;
            }
        }
        let mut block = 16;
        while self.engine.steps() < last {
            let now = self.engine.steps();
            let next_picture = pictures.map_or(u64::MAX, |p| p.next(now));
            let (next_row, next_save, next_look) = (rows.next(now), saves.next(now), self.watches.next(now));
            let target = next_row.min(next_picture).min(next_save).min(next_look).min(last).min(now + block);
            let begun = Instant::now();
            if let Err(fault) = self.engine.advance(target - now, &mut self.hosts, &mut self.ledger) {
                history.sync()?;
                self.watches.sync()?;
                let mut summary = self.summary(Status::Failed);
                summary.warnings.push(fault.to_string());
                summary.write(&folder.file("summary.json"))?;
                return Err(fault.into());
            }
            // Short enough to answer Ctrl-C at once, long enough that nothing here is felt.
            block = if begun.elapsed().as_millis() < 20 { (2 * block).min(1 << 20) } else { (block / 2).max(16) };
            if target == next_look {
                self.watches.look(&*self.engine)?;
            }
            if target == next_row || target == last {
                history.append(&self.row())?;
            }
            if target == next_picture {
                frames.write(&self.engine.frame(&self.hosts))?;
            }
            let stop = watcher.interrupted.load(Ordering::Relaxed);
            if target == next_save || stop || target == last {
                history.sync()?;
                self.watches.sync()?;
                self.save(folder)?;
            }
            (watcher.progress)(target as f64 / last.max(1) as f64);
            if stop && target < last {
                let summary = self.summary(Status::Interrupted);
                summary.write(&folder.file("summary.json"))?;
                return Ok(summary);
            }
        }
        history.sync()?;
        let summary = self.summary(Status::Finished);
        summary.write(&folder.file("summary.json"))?;
        Ok(summary)
    }

    fn header(&self) -> Vec<String> {
        let mut header = vec!["time [s]".to_owned()];
        header.extend(engine::stocks(&*self.engine, &self.hosts).terms().map(|(name, _)| format!("{name} energy [J]")));
        header.extend(Account::ALL.map(|a| format!("{} [J]", a.name())));
        header.extend(
            ["residual [J]", "momentum residual [N.s]", "contacts [-]", "centre of mass height [m]"].map(String::from),
        );
        for name in self.hosts.names() {
            header.push(format!("host {name} displacement [m]"));
            header.push(format!("host {name} velocity [m/s]"));
            header.push(format!("force on host {name} [N]"));
        }
        header.extend(self.watches.header());
        header
    }

    fn row(&mut self) -> Vec<f64> {
        let stocks = engine::stocks(&*self.engine, &self.hosts);
        let mut row = vec![self.engine.time()];
        row.extend(stocks.terms().map(|(_, value)| value));
        row.extend(Account::ALL.map(|a| self.ledger.flow(a)));
        row.push(self.ledger.residual(&stocks));
        let momentum = self.ledger.momentum_residual(self.engine.momentum());
        row.push(momentum.iter().map(|p| p * p).sum::<f64>().sqrt());
        row.push(self.engine.contacts() as f64);
        row.push(self.engine.centre_of_mass()[2]);
        for host in &self.hosts.list {
            row.extend([host.displacement(), host.velocity(), host.grain_force()]);
        }
        row.extend(self.watches.row(&*self.engine));
        let seen = self.seen(&stocks);
        self.measured.take(&self.hosts, self.engine.contacts(), seen);
        row
    }

    /// What every scene has to tell of itself, in the order of [`SEEN`].
    fn seen(&self, stocks: &Stocks) -> [f64; 3] {
        [stocks.kinetic + stocks.rotational, self.engine.centre_of_mass()[2], self.engine.contacts() as f64]
    }

    fn save(&self, folder: &RunFolder) -> Result<(), FileError> {
        let mut state = self.state();
        self.measured.save(&mut state);
        self.watches.save(&mut state);
        state.put_real("run.wall-seconds", vec![self.wall_seconds()]);
        let header = Header {
            tsubu_version: crate::VERSION.to_owned(),
            scene_hash: self.scene_hash.clone(),
            step: self.engine.steps(),
            time: self.engine.time(),
        };
        checkpoint::write(folder.path(), &state, &header)
    }

    fn state(&self) -> State {
        let mut state = State::default();
        self.engine.save(&mut state);
        self.hosts.save(&mut state);
        self.ledger.save(&mut state);
        state
    }

    fn resume(&mut self, folder: &Path) -> Result<(), RunError> {
        let (header, state) = checkpoint::read(&checkpoint::path(folder))?;
        let refuse =
            |text: String| Err(RunError::NotThisScene(format!("the checkpoint in {} {text}", folder.display())));
        if header.scene_hash != self.scene_hash {
            let may = "only `title`, `duration`, [output], [[claim]], [response] and [sweep] may differ";
            return refuse(format!("belongs to another scene, or to this one with other values: {may}"));
        }
        let dt = self.engine.time_step();
        self.engine.load(&state)?;
        if self.engine.time() != header.time {
            return refuse(format!("was made with another time step than {dt} s: set `dem.time-step`"));
        }
        if self.engine.steps() > step_of(self.plan.duration, dt) {
            let (time, end) = (header.time, self.plan.duration);
            return refuse(format!("is of t = {time} s, behind the end: raise `duration` = {end} s"));
        }
        self.hosts.load(&state)?;
        self.ledger = Ledger::load(&state)?;
        self.measured.load(&state)?;
        self.watches.load(&state)?;
        self.wall_before = state.real("run.wall-seconds")?.first().copied().unwrap_or(0.0);
        Ok(())
    }

    fn wall_seconds(&self) -> f64 {
        self.wall_before + self.started.elapsed().as_secs_f64()
    }

    fn summary(&self, status: Status) -> Summary {
        let stocks = engine::stocks(&*self.engine, &self.hosts);
        let wall_seconds = self.wall_seconds();
        let mut summary = Summary {
            tsubu_version: crate::VERSION.to_owned(),
            status,
            method: self.plan.method.name().to_owned(),
            dimension: u32::from(self.plan.dimension),
            particles: self.engine.grains() as u64,
            steps: self.engine.steps(),
            time_step: self.engine.time_step(),
            simulated_seconds: self.engine.time(),
            wall_seconds,
            threads: rayon::current_num_threads() as u32,
            particle_steps_per_second: self.engine.grain_steps() as f64 / wall_seconds,
            contacts_mean: self.measured.contacts / self.measured.rows.max(1.0),
            state_hash: self.state().hash(),
            ..Summary::default()
        };
        for (name, value) in stocks.terms() {
            summary.energy.terms.insert(name, value);
        }
        for account in Account::ALL {
            summary.energy.terms.insert(account.name(), self.ledger.flow(account));
        }
        let residual = self.ledger.residual_relative(&stocks);
        summary.energy.terms.insert("residual", self.ledger.residual(&stocks));
        summary.energy.residual_relative = residual;
        let tolerance = self.plan.dem.energy_tolerance;
        if residual.abs() > tolerance {
            summary.warnings.push(format!(
                "the energy books miss {residual:.2e} of the energy turned over, more than `dem.energy-tolerance` = {tolerance:e}: shorten `dem.time-step`"
            ));
        }
        for note in self.engine.notes() {
            summary.warnings.push(format!("{}: {}", note.key, note.text));
        }
        self.watches.results(&mut summary);
        self.measured.results(&self.hosts, &mut summary);
        // Where nothing is watched, this is what happened.
        if self.plan.watch.is_empty() {
            self.measured.tell(self.seen(&stocks), &mut summary);
        }
        for (name, grains) in self.engine.traffic() {
            summary.give(name, "-", grains as f64);
        }
        let momentum = self.ledger.momentum_residual(self.engine.momentum());
        summary.give("momentum residual", "N.s", momentum.iter().map(|p| p * p).sum::<f64>().sqrt());
        judge(self.plan, &mut summary);
        summary
    }
}

/// Holds the scene's own claims against the results.
pub(crate) fn judge(plan: &Plan, summary: &mut Summary) {
    for claim in &plan.claim {
        let value = match summary.results.get(&claim.result) {
            Some(ResultValue::Number(value)) => *value,
            _ => f64::NAN,
        };
        summary.claims.push(Claim::judge(&claim.result, value, claim.low, claim.high, &claim.source));
    }
}

/// Number of the step that ends nearest to `time`.
fn step_of(time: f64, dt: f64) -> u64 {
    (time / dt).round() as u64
}

/// Events at multiples of an interval, each at the nearest step.
#[derive(Clone, Copy)]
struct Clock {
    interval: f64,
    dt: f64,
}

impl Clock {
    /// First event after step `now`.
    fn next(self, now: u64) -> u64 {
        let mut k = (now as f64 * self.dt / self.interval).floor();
        loop {
            k += 1.0;
            let step = step_of(k * self.interval, self.dt);
            if step > now {
                return step;
            }
        }
    }
}

/// What every scene has to tell of itself, with its unit.
const SEEN: [(&str, &str); 3] = [("kinetic energy", "J"), ("centre of mass height", "m"), ("contacts", "-")];

/// What is measured at every row of the history.
#[derive(Default)]
struct Measured {
    /// Of [`SEEN`].
    seen: Means,
    rows: f64,
    contacts: f64,
    /// Per host: sum, sum of squares, largest absolute value of the displacement.
    hosts: Vec<[f64; 3]>,
}

impl Measured {
    fn new(hosts: &Hosts) -> Self {
        Self { hosts: vec![[0.0; 3]; hosts.list.len()], ..Self::default() }
    }

    fn take(&mut self, hosts: &Hosts, contacts: usize, seen: [f64; 3]) {
        self.seen.take(seen.into_iter());
        self.rows += 1.0;
        self.contacts += contacts as f64;
        for (sums, host) in self.hosts.iter_mut().zip(&hosts.list) {
            let z = host.displacement();
            *sums = [sums[0] + z, sums[1] + z * z, sums[2].max(z.abs())];
        }
    }

    fn tell(&self, last: [f64; 3], summary: &mut Summary) {
        let means = self.seen.get().zip(self.seen.spreads()).zip(last);
        for ((name, unit), ((mean, spread), last)) in SEEN.into_iter().zip(means) {
            summary.give(name, unit, mean);
            summary.give(format!("{name} spread"), unit, spread);
            summary.give(format!("{name} final"), unit, last);
        }
    }

    fn results(&self, hosts: &Hosts, summary: &mut Summary) {
        for (sums, name) in self.hosts.iter().zip(hosts.names()) {
            let mean = sums[0] / self.rows;
            let variance = (sums[1] / self.rows - mean * mean).max(0.0);
            summary.give(format!("host {name} rms displacement"), "m", variance.sqrt());
            summary.give(format!("host {name} peak displacement"), "m", sums[2]);
            summary.give(format!("host {name} mean displacement"), "m", mean);
        }
    }

    fn save(&self, state: &mut State) {
        let mut values = vec![self.rows, self.contacts];
        values.extend(self.hosts.iter().flatten());
        state.put_real("run.measured", values);
        state.put_real("run.seen", self.seen.numbers());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let values = state.real("run.measured")?;
        if values.len() != 2 + 3 * self.hosts.len() {
            return Err(MissingSection { name: "run.measured".to_owned(), kind: "real" });
        }
        self.seen = Means::from_numbers(state.real("run.seen")?);
        (self.rows, self.contacts) = (values[0], values[1]);
        for (sums, v) in self.hosts.iter_mut().zip(values[2..].chunks_exact(3)) {
            sums.copy_from_slice(v);
        }
        Ok(())
    }
}
