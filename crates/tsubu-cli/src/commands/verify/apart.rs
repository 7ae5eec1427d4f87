//! The cases of a verification, each done by a task of its own.
//!
//! A task has a folder of its own in that of the verification, as a verification of that case alone has: nobody else holds it, and what is done of an ensemble is kept there.

use super::runner::Outcome;
use super::{Against, Options, RESULTS, claims};
use crate::failure::Failure;
use crate::launch::{Estimate, Logs, Runs};
use crate::options::WorkOptions;
use crate::output;
use crate::stream::Stream;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tsubu::interrupt::Interrupt;
use tsubu::study::apart::{Need, unlocked};
use tsubu_frame::{Existing, FileError, RunFolder, Status};
use tsubu_verify::{Archive, Case, Done, How, recorded_run};

/// The folders of the tasks.
const TASKS: &str = "tasks";
/// More than any case takes [bytes].
const MEMORY: f64 = 500e6;

/// The cases that were chosen.
pub struct Cases<'a> {
    chosen: Vec<&'static Case>,
    folder: &'a Path,
    controls: bool,
    work: &'a WorkOptions,
    /// How they were chosen.
    words: Vec<String>,
}

impl<'a> Cases<'a> {
    /// Those that an option chose. They need a folder.
    pub fn new(options: &'a Options, chosen: Vec<&'static Case>) -> Result<Self, Failure> {
        let Some(folder) = &options.output else {
            return Err(Failure::wrong("tasks meet in a folder, and none is named").hint("name it with `-o DIR`"));
        };
        let mut words = options.names.clone();
        words.extend(options.all.then(|| "--all".to_owned()));
        words.extend(options.controls.then(|| "--controls".to_owned()));
        if let Some(Against::Stored) = options.against {
            words.extend(["--against", "stored"].map(str::to_owned));
        }
        Ok(Self { chosen, folder, controls: options.controls, work: &options.work, words })
    }

    fn task(&self, case: &Case) -> PathBuf {
        self.folder.join(TASKS).join(case.name)
    }

    /// What a task has kept of its case.
    fn done(&self, case: &Case) -> Option<Done> {
        let folder = RunFolder::create(self.task(case), Existing::Resume, [RESULTS]).ok()?;
        Archive::new(folder).ok()?.case(case.name, self.controls)
    }

    /// The folder of all, for the results.
    pub fn results(&self) -> Result<RunFolder, Failure> {
        let folder = RunFolder::create(self.folder, Existing::Resume, [RESULTS]);
        folder.map_err(|error| Failure::of_file(&error, self.folder))
    }

    /// Refuses a folder in which no verification by tasks was begun.
    pub fn goes_on(&self) -> Result<(), Failure> {
        if self.folder.join(TASKS).is_dir() {
            return Ok(());
        }
        Err(Failure::wrong(format!("no verification by tasks is begun in {}", self.folder.display()))
            .hint("`--gather` makes a new folder"))
    }

    /// What is there of the cases, and of each that is not, why.
    pub fn gather(&self) -> (Vec<(&'static Case, Outcome)>, Vec<String>) {
        let logs = Logs::read(self.folder);
        let (mut done, mut missing) = (Vec::new(), Vec::new());
        for case in &self.chosen {
            match self.done(case) {
                Some(Done { run, claims }) => done.push((*case, Outcome { claims, run: Some(run), late: None })),
                None => missing.push(format!(
                    "{}: `{}` has no result: {}\n",
                    Stream::Error.yellow("warning"),
                    case.name,
                    logs.why(case.name)
                )),
            }
        }
        (done, missing)
    }
}

impl Runs for Cases<'_> {
    fn folder(&self) -> &Path {
        self.folder
    }

    fn begin(&mut self, overwrite: bool) -> Result<(), Failure> {
        let tasks = format!("{TASKS}/");
        let existing = match overwrite {
            true => Existing::Overwrite,
            false if self.folder.join(TASKS).is_dir() => Existing::Resume,
            false => Existing::Refuse,
        };
        let made = RunFolder::create(self.folder, existing, [RESULTS, &tasks]).and_then(|folder| {
            folder.claim([&tasks])?;
            std::fs::create_dir_all(folder.file(TASKS)).map_err(FileError::write(&folder.file(TASKS)))
        });
        made.map_err(|error| Failure::of_file(&error, self.folder))
    }

    fn missing(&mut self) -> Result<Vec<String>, Failure> {
        let missing = self.chosen.iter().filter(|case| self.done(case).is_none());
        Ok(missing.map(|case| case.name.to_owned()).collect())
    }

    fn run(&mut self, name: &str) -> Result<Status, Failure> {
        let Some(case) = self.chosen.iter().find(|case| case.name == name) else {
            return Err(Failure::wrong(format!("there is no case `{name}` in this verification"))
                .hint("`tsubu verify --list` has the names"));
        };
        self.goes_on()?;
        let folder = self.task(case);
        let existing = if folder.is_dir() { Existing::Resume } else { Existing::Refuse };
        let archive = || RunFolder::create(&folder, existing, [RESULTS]).and_then(Archive::new);
        let archive = unlocked(&Interrupt::new(), FileError::is_locked, archive);
        let archive = archive.map_err(|error| Failure::of_file(&error, &folder))?;
        let how = How { archive: Some(Arc::new(archive)), controls: self.controls };
        let done = self.work.pool()?.install(|| case.done(&how, Arc::new(|| ())));
        let done = done.map_err(|error| Failure::failed(format!("`{name}` did not run: {error}")))?;
        output::print(&done.claims.iter().map(claims::line).collect::<String>())?;
        Ok(Status::Finished)
    }

    /// By what they took when they were stored, and twice that with controls.
    fn need(&self) -> Result<Estimate, Failure> {
        let stored = |case: &&Case| recorded_run(case.name).map_or(f64::from(case.budget), |run| run.seconds);
        let longest = self.chosen.iter().copied().map(|case| stored(&case)).fold(0.0, f64::max);
        let seconds = if self.controls { 2.0 * longest } else { longest };
        Ok(Box::new(move || Some(Need { seconds, bytes: MEMORY })))
    }

    fn words(&self, _: &str) -> Vec<String> {
        self.words.clone()
    }
}
