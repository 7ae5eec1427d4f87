//! A task: runs that are named, one after the other.

use super::Runs;
use super::logs::begun;
use crate::failure::Failure;
use crate::{output, stop};
use tsubu_frame::Status;

/// Does these runs, and says of each how it ended; one that goes wrong leaves the others to be done.
pub fn cases(runs: &mut dyn Runs, names: &[String]) -> Result<(), Failure> {
    let mut wrong = Vec::new();
    for name in names {
        output::tell(&format!("{}\n", begun(name)));
        match runs.run(name) {
            Ok(Status::Finished) => output::tell(&format!("case {name}: finished\n")),
            Ok(Status::Interrupted) => {}
            Ok(Status::Failed) => wrong.push(Failure::failed(format!("case {name} failed; its table says why"))),
            Err(failure) => {
                output::report(&failure);
                wrong.push(failure);
            }
        }
        if stop::is_asked() {
            return Err(Failure::interrupted(format!("case {name}: {INTERRUPTED}")));
        }
    }
    match (names, wrong.pop()) {
        (_, None) => Ok(()),
        // It has been told above.
        ([_], Some(only)) => Err(only.quiet()),
        (_, Some(_)) => Err(Failure::failed(format!("{} of {} cases failed", wrong.len() + 1, names.len()))),
    }
}

/// Said of a run that was stopped.
pub const INTERRUPTED: &str = "interrupted; the next task of this run goes on from its checkpoint";
