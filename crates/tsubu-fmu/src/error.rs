//! What goes wrong, in the words of the project.

use tsubu::engine::OpenError;
use tsubu::run::RunError;
use tsubu_frame::Advise;
use tsubu_scene::{Complaints, Scene};

/// Something that went wrong: a text for people, with what to do about it on lines that begin with `hint: `.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Error(String);

impl Error {
    /// What went wrong.
    pub fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn hint(self, hint: impl AsRef<str>) -> Self {
        Self(format!("{}\nhint: {}", self.0, hint.as_ref()))
    }

    /// What went wrong, with the hints that it knows.
    pub fn of(error: &dyn Advise) -> Self {
        Self(error.told())
    }

    /// Why a scene cannot be opened: what its method refuses is shown where it stands.
    pub fn of_open(error: &OpenError, scene: &Scene) -> Self {
        match error {
            OpenError::Refused(refusal) => {
                let notes = refusal.notes.iter().map(|note| (note.key.as_str(), note.text.as_str()));
                scene.refused(refusal.method, notes).into()
            }
            _ => Self::of(error),
        }
    }

    /// The same of a scene opened by its simulation.
    pub fn of_run(error: &RunError, scene: &Scene) -> Self {
        match error {
            RunError::Open(error) => Self::of_open(error, scene),
            _ => Self::of(error),
        }
    }
}

impl From<Complaints> for Error {
    fn from(complaints: Complaints) -> Self {
        Self(complaints.to_string().trim_end().to_owned())
    }
}
