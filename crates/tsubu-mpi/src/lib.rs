//! The door to MPI: the ranks that `mpirun` starts make one run together.
//!
//! MPI itself is behind the feature `mpi`. Without it this crate only tells when it would be needed.

#[cfg(feature = "mpi")]
mod world;

use std::sync::Arc;
use tsubu::ranks::Communicator;

/// A program that was started on several ranks, and cannot talk to the others.
#[derive(Debug, thiserror::Error)]
#[error(
    "{started} ranks were started, and this program was built without MPI: each would make the whole run, all in one folder"
)]
pub struct WithoutMpi {
    /// How many ranks there are.
    pub started: usize,
}

/// What to do about it.
pub const HOW_TO_BUILD: &str = "start it without `mpirun`; or build it with MPI: `cargo build --release --package tsubu-cli --features mpi` \
                                wants the packages libopenmpi-dev (or libmpich-dev) and libclang-dev";

/// Whether this program knows MPI.
pub const BUILT: bool = cfg!(feature = "mpi");

/// Variables in which launchers tell programs how many ranks there are: Open MPI, MPICH and its relatives, Slurm with PMIx.
const SIZES: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"];

/// The same for ranks on this machine.
const SIZES_HERE: [&str; 3] = ["OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "MV2_COMM_WORLD_LOCAL_SIZE"];

/// The same for the number of this rank.
const RANKS: [&str; 4] = ["OMPI_COMM_WORLD_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "PMIX_RANK"];

fn told(names: &[&str]) -> Option<usize> {
    names.iter().find_map(|name| std::env::var(name).ok()?.parse().ok())
}

/// On how many ranks a launcher has started this program; 1 without one.
pub fn started() -> usize {
    let by_slurm = std::env::var_os("PMIX_RANK").and_then(|_| told(&["SLURM_STEP_NUM_TASKS"]));
    told(&SIZES).or(by_slurm).unwrap_or(1)
}

/// How many of the ranks share this machine.
pub fn started_here() -> usize {
    told(&SIZES_HERE).unwrap_or(1)
}

/// Whether this is the rank that speaks for all.
pub fn is_first() -> bool {
    told(&RANKS).unwrap_or(0) == 0
}

/// The ranks of this run, as long as it lives.
#[derive(Debug)]
pub struct Ranks {
    communicator: Arc<dyn Communicator>,
    #[cfg(feature = "mpi")]
    _world: world::Connection,
}

impl Ranks {
    /// Joins the other ranks; `None` where there are none.
    #[cfg(feature = "mpi")]
    pub fn join() -> Result<Option<Self>, WithoutMpi> {
        if started() < 2 {
            return Ok(None);
        }
        let connection = world::Connection::open();
        Ok(connection.map(|connection| Self { communicator: connection.communicator(), _world: connection }))
    }

    /// Joins the other ranks; `None` where there are none.
    #[cfg(not(feature = "mpi"))]
    pub fn join() -> Result<Option<Self>, WithoutMpi> {
        let started = started();
        if started < 2 { Ok(None) } else { Err(WithoutMpi { started }) }
    }

    /// How they talk.
    pub fn communicator(&self) -> &Arc<dyn Communicator> {
        &self.communicator
    }
}
