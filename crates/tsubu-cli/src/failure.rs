//! How a command ends when it does not end well: a message, hints and an exit code.

use crate::stream::Stream;
use crate::table;
use std::fmt::Write as _;
use std::path::Path;
use tsubu::bench::BenchError;
use tsubu::engine::OpenError;
use tsubu::run::RunError;
use tsubu::study::cases::CasesError;
use tsubu::study::compare::{CompareError, Refused};
use tsubu_frame::{Advise, CheckpointError, FileError, Hint, checkpoint};
use tsubu_report::ReportError;
use tsubu_scene::{Complaints, Scene};

/// The scene or the command line is wrong; nothing was written.
const WRONG: u8 = 2;
/// The run failed; what was computed so far is kept.
const FAILED: u8 = 3;
/// What to do where a folder has results of another scene.
const ANOTHER: &str = "name another folder with `-o`, or replace the results with `--overwrite`";

/// A command that did not end well.
#[derive(Debug, Default)]
pub struct Failure {
    code: u8,
    /// Nothing where all has been said.
    message: Option<Message>,
    hints: Vec<Hint>,
}

#[derive(Debug)]
enum Message {
    /// To be put after `error: `.
    Plain(String),
    /// In its final form: complaints about a scene, or no error at all.
    Ready(String),
}

impl Failure {
    /// The scene or the command line is wrong.
    pub fn wrong(message: impl Into<String>) -> Self {
        Self::new(WRONG, message)
    }

    /// What was begun could not be finished.
    pub fn failed(message: impl Into<String>) -> Self {
        Self::new(FAILED, message)
    }

    /// A claim does not hold; what is to be said was printed with the results.
    pub fn claim() -> Self {
        Self { code: 1, ..Self::default() }
    }

    /// The same, said by somebody else.
    #[must_use]
    pub fn quiet(self) -> Self {
        Self { code: self.code, ..Self::default() }
    }

    /// The same with a word on where it went wrong.
    #[must_use]
    pub fn on(self, place: &str) -> Self {
        let message = self.message.map(|message| match message {
            Message::Plain(text) => Message::Plain(format!("{place}: {text}")),
            Message::Ready(text) => Message::Ready(format!("{place}: {text}")),
        });
        Self { message, ..self }
    }

    /// The user stopped it.
    pub fn interrupted(message: impl Into<String>) -> Self {
        Self { code: 130, message: Some(Message::Ready(message.into())), hints: Vec::new() }
    }

    /// An end before the end that is no failure of ours: the reader of stdout has gone away, as in `tsubu schema | head`, or another rank
    /// has the failure.
    pub fn none() -> Self {
        Self::default()
    }

    /// Adds a way out.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<Hint>) -> Self {
        self.hints.push(hint.into());
        self
    }

    fn new(code: u8, message: impl Into<String>) -> Self {
        Self { code, message: Some(Message::Plain(message.into())), hints: Vec::new() }
    }

    /// An error with the ways out that it knows.
    fn of(code: u8, error: &dyn Advise) -> Self {
        Self { hints: error.hints(), ..Self::new(code, error.to_string()) }
    }

    /// What on the command line is wrong.
    pub fn of_words(error: &dyn Advise) -> Self {
        Self::of(WRONG, error)
    }

    /// What went wrong in a benchmark.
    pub fn of_bench(error: &BenchError) -> Self {
        Self::of(FAILED, error)
    }

    /// The message with its hints, as it is printed.
    pub fn text(&self) -> String {
        let stream = Stream::Error;
        let mut text = String::new();
        match &self.message {
            Some(Message::Plain(message)) => {
                let _ = writeln!(text, "{}: {message}", stream.bold_red("error"));
            }
            Some(Message::Ready(message)) => {
                let _ = writeln!(text, "{message}");
            }
            None => {}
        }
        for hint in &self.hints {
            let _ = writeln!(text, "{}: {hint}", stream.bold_cyan("hint"));
        }
        text
    }

    /// What the program says to whoever started it.
    pub fn code(&self) -> u8 {
        self.code
    }

    /// What a method has against a scene, shown where it stands; other errors as ever.
    pub fn of_open(error: &OpenError, scene: &Scene) -> Self {
        match error {
            OpenError::Refused(refusal) => {
                let notes = refusal.notes.iter().map(|note| (note.key.as_str(), note.text.as_str()));
                (&scene.refused(refusal.method, notes)).into()
            }
            _ => error.into(),
        }
    }

    /// What went wrong in a run of a scene into `folder`.
    pub fn of_scene(error: &RunError, scene: &Scene, folder: &Path) -> Self {
        match error {
            RunError::Open(error) => Self::of_open(error, scene),
            _ => Self::of_run(error, folder),
        }
    }

    /// What went wrong in a run into `folder`.
    fn of_run(error: &RunError, folder: &Path) -> Self {
        match error {
            RunError::Open(error) => error.into(),
            RunError::File(file) => Self::of_file(file, folder),
            RunError::Stopped { error: file, .. } => Self::of(FAILED, error).stopped_by(file, folder),
            RunError::Checkpoint(CheckpointError::Unreadable { path, source })
                if source.kind() == std::io::ErrorKind::NotFound =>
            {
                Self::wrong(format!("nothing to resume: there is no checkpoint {}", path.display()))
                    .hint("start again with `--overwrite` in place of `--resume`")
            }
            RunError::Checkpoint(error) => Self::wrong(error.to_string()),
            RunError::Elsewhere(_) => Self::of(FAILED, error),
            RunError::NoStep { .. } | RunError::NotThisScene(_) | RunError::Start(_) => Self::of(WRONG, error),
            RunError::Fault(fault) => {
                Self::of(FAILED, fault).hint(format!("what was computed so far is kept in {}", folder.display()))
            }
        }
    }

    /// What went wrong with a file of the results in `folder`.
    ///
    /// A folder that cannot be made and results that cannot be read stop a run before it begins; a file that cannot
    /// be written stops it on its way.
    pub fn of_file(error: &FileError, folder: &Path) -> Self {
        let FileError::Write { path, .. } = error else { return Self::of(WRONG, error) };
        if path == folder {
            return Self::of(WRONG, error).hint("name another folder with `-o`");
        }
        Self::of(FAILED, error).stopped_by(error, folder)
    }

    /// With what can be done where a file of the results in `folder` could not be written.
    fn stopped_by(self, error: &FileError, folder: &Path) -> Self {
        let failure = match checkpoint::read(&checkpoint::path(folder)) {
            Ok((header, _)) => self.hint(format!(
                "the checkpoint of step {}, t = {} s is whole: `--resume` goes on from it",
                header.step,
                table::number(header.time)
            )),
            Err(_) => self,
        };
        if error.is_disk_full() {
            failure.hint("the disk is full: make room, or name another disk with `-o`")
        } else {
            failure
        }
    }

    /// What went wrong with a report.
    pub fn of_report(error: &ReportError) -> Self {
        match error {
            ReportError::File(error @ FileError::Write { .. }) => Self::of(FAILED, error),
            ReportError::File(error) => Self::of(WRONG, error),
            ReportError::NoFolder { .. } | ReportError::NoResults { .. } => Self::wrong(error.to_string()),
        }
    }

    /// What went wrong in a response or a sweep of a scene into `folder`; a case is named with its own trouble.
    pub fn of_cases(error: &CasesError, scene: &Scene, folder: &Path) -> Self {
        match error {
            CasesError::Scene(message) => Self::wrong(message.as_str()),
            CasesError::NotThisScene(message) => Self::wrong(message.as_str()).hint(ANOTHER),
            CasesError::Complaints(complaints) => complaints.into(),
            CasesError::Open(error) => Self::of(WRONG, error),
            CasesError::Run { case, error } => Self::of_scene(error, scene, folder).about("case", case),
            CasesError::File(error) => Self::of_file(error, folder),
        }
    }

    /// The same for a comparison.
    pub fn of_compare(error: &CompareError, scene: &Scene, folder: &Path) -> Self {
        match error {
            CompareError::Scene(complaints) => complaints.into(),
            CompareError::Nobody(refused) => {
                let reasons = |refused: &Refused| {
                    let because = refused.because.iter().map(|(key, why)| (key.as_str(), why.as_str()));
                    scene.refused(&refused.method, because).render(Stream::Error.colour())
                };
                let all: Vec<String> = refused.iter().map(reasons).collect();
                let message =
                    Message::Ready(format!("{}\n\nnone of these methods can run the scene", all.join("\n\n")));
                Self { code: WRONG, message: Some(message), hints: Vec::new() }
            }
            CompareError::NotThisScene(message) => Self::wrong(message.as_str()).hint(ANOTHER),
            CompareError::Run { method, error } => {
                Self::of_scene(error, scene, &folder.join(method)).about("method", method)
            }
            CompareError::File(error) => Self::of_file(error, folder),
        }
    }

    fn about(mut self, kind: &str, name: &str) -> Self {
        match &mut self.message {
            Some(Message::Plain(text)) if !name.is_empty() && !text.starts_with(kind) => {
                *text = format!("{kind} `{name}`: {text}");
            }
            Some(Message::Ready(text)) if !name.is_empty() && !text.contains(&format!("{kind} `{name}`")) => {
                self.hints.push(format!("so it is in the {kind} `{name}`").into());
            }
            _ => {}
        }
        self
    }
}

impl From<&Complaints> for Failure {
    fn from(complaints: &Complaints) -> Self {
        let text = complaints.render(Stream::Error.colour());
        Self { code: WRONG, message: Some(Message::Ready(text)), hints: Vec::new() }
    }
}

impl From<&OpenError> for Failure {
    fn from(error: &OpenError) -> Self {
        match error {
            OpenError::Running(_) | OpenError::Settling(_) => Self::of(FAILED, error),
            OpenError::Refused(_) | OpenError::Bed(_) => Self::of(WRONG, error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu::engine::Fault;

    /// A message that began with "error" was taken for one in its final form, and lost its head; one with a line of the user's that
    /// began with "hint: " was cut there. A hint is a value now, and a message is what it is.
    #[test]
    fn a_message_is_not_searched_for_hints() {
        let failure = Failure::wrong("errors.toml is no folder\nhint: of a name").hint("name another");
        assert_eq!(failure.text(), "error: errors.toml is no folder\nhint: of a name\nhint: name another\n");
    }

    /// Whoever resumed with another scene was told that it is another, and not what to do: the hint was lost on the way.
    #[test]
    fn the_hints_of_an_error_come_through() {
        let error = RunError::NotThisScene("the checkpoint is of another scene".to_owned());
        let text = Failure::of_run(&error, Path::new("out")).text();
        let hint = "hint: run without `--resume` into another folder, or with `--overwrite`";
        assert_eq!(text, format!("error: the checkpoint is of another scene\n{hint}\n"));
        let fault = Fault::Lattice { step: 1, time: 0.5, text: "it jams".to_owned(), hint: Some("shake less".into()) };
        let text = Failure::of_run(&fault.into(), Path::new("out")).text();
        let kept = "hint: what was computed so far is kept in out";
        assert_eq!(text, format!("error: step 1, t = 0.5 s: it jams\nhint: shake less\n{kept}\n"));
    }
}
