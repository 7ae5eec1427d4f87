//! Commands that were started on several ranks.

use crate::failure::Failure;
use crate::{output, stop};
use tsubu::ranks::Communicator;
use tsubu::threads::alone;
use tsubu_mpi::{HOW_TO_BUILD, Ranks};

/// Joins the other ranks; `None` where there are none.
pub fn join() -> Result<Option<Ranks>, Failure> {
    Ranks::join().map_err(|error| said_once(Failure::wrong(error.to_string()).hint(HOW_TO_BUILD)))
}

/// A command that makes nothing on several ranks.
pub fn refuse() -> Result<(), Failure> {
    let started = tsubu_mpi::started();
    if started < 2 {
        return Ok(());
    }
    let message = format!("this command was started on {started} ranks, and works on one");
    let hint = "`tsubu run` works on several, and `tsubu sweep --case` does; many runs go over `--launcher`";
    Err(said_once(Failure::wrong(message).hint(hint)))
}

/// What all ranks have to say, said by the first. The others end as if all were well: a launcher ends everybody when one ends with an error,
/// and the first may not have spoken yet.
fn said_once(failure: Failure) -> Failure {
    if tsubu_mpi::is_first() { failure } else { Failure::none() }
}

/// Work of a rank: its threads may look for work with open eyes where every one of all ranks has a core.
pub fn at_work<R>(work: impl FnOnce() -> R) -> R {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = rayon::current_num_threads();
    // A rank that is bound to its cores sees these alone.
    let crowded = threads > cores || (tsubu_mpi::started_here() * threads > cores && cores > threads);
    if crowded { work() } else { alone(work) }
}

/// Goes on where all ranks can. What the first cannot do it says alone; of the others speaks who fails where the first does not.
pub fn together<T>(communicator: &dyn Communicator, mine: Result<T, Failure>) -> Result<T, Failure> {
    let (rank, size) = (communicator.rank(), communicator.size());
    let mut failed = vec![vec![f64::from(mine.is_err())]; size];
    communicator.exchange(&mut failed);
    let bad = |rank: usize| failed[rank].first() == Some(&1.0);
    match mine {
        Ok(_) if (0..size).any(bad) => Err(Failure::wrong("").quiet()),
        Err(failure) if rank > 0 && bad(0) => Err(failure.quiet()),
        Err(failure) if rank > 0 => Err(failure.on(&format!("rank {rank}"))),
        mine => mine,
    }
}

/// The end of a command on several ranks: all have said what they have to say before one of them goes, after which a launcher may end the others.
pub fn part(communicator: &dyn Communicator, done: Result<(), Failure>) -> Result<(), Failure> {
    let done = done.map_err(|failure| {
        output::report(&failure);
        failure.quiet()
    });
    communicator.exchange(&mut vec![Vec::new(); communicator.size()]);
    stop::nothing_to_save();
    done
}
