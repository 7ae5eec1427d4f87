//! A task: runs that are named, one after the other.

use super::logs::begun;
use crate::failure::Failure;
use crate::output;
use crate::session::Session;
use tsubu::study::apart::Apart;
use tsubu_frame::Status;

/// Does these runs, and says of each how it ended; one that goes wrong leaves the others to be done.
pub fn cases(study: &mut (dyn Apart + Send), session: &Session, names: &[String]) -> Result<(), Failure> {
    let mut wrong = Vec::new();
    for name in names {
        output::tell(&format!("{}\n", begun(name)));
        let words = "interrupted; the next task of this run goes on from its checkpoint";
        let (done, interrupt) = session.work(words, |watcher| study.run(name, watcher));
        match done {
            Ok(Status::Finished) => output::tell(&format!("case {name}: finished\n")),
            Ok(Status::Interrupted) => {}
            Ok(Status::Failed) => wrong.push(Failure::failed(format!("case {name} failed; its table says why"))),
            Err(error) => {
                let failure = Failure::of_cases(&error, &session.scene, &session.folder);
                output::report(&failure);
                wrong.push(failure);
            }
        }
        if interrupt.asked() {
            return Err(Failure::interrupted(format!("case {name}: {words}")));
        }
    }
    match (names, wrong.pop()) {
        (_, None) => Ok(()),
        ([_], Some(only)) => Err(only),
        (_, Some(_)) => Err(Failure::failed(format!("{} of {} cases failed", wrong.len() + 1, names.len()))),
    }
}
