//! All ranks that MPI knows.

use mpi::Threading;
use mpi::datatype::Equivalence;
use mpi::environment::Universe;
use mpi::request::WaitGuard;
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator as _, Destination, Root, Source};
use std::sync::{Arc, Mutex, PoisonError};
use tsubu::ranks::Communicator;

/// MPI from its begin to its end.
pub struct Connection {
    universe: Universe,
}

impl std::fmt::Debug for Connection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Connection").finish_non_exhaustive()
    }
}

impl Connection {
    /// Begins; `None` where that was done before.
    pub fn open() -> Option<Self> {
        // One thread talks at a time, and not always the same.
        mpi::initialize_with_threading(Threading::Serialized).map(|(universe, _)| Self { universe })
    }

    pub fn communicator(&self) -> Arc<dyn Communicator> {
        let world = self.universe.world();
        Arc::new(World { rank: world.rank() as usize, size: world.size() as usize, spare: Mutex::default() })
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        // Who panics is not waited for.
        if std::thread::panicking() {
            self.universe.world().abort(101);
        }
    }
}

/// This rank among all.
#[derive(Debug)]
struct World {
    rank: usize,
    size: usize,
    /// Memory for what comes, one message a rank.
    spare: Mutex<Vec<Vec<f64>>>,
}

impl Communicator for World {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn exchange_while(&self, messages: &mut [Vec<f64>], partners: &[usize], work: &mut dyn FnMut() -> bool) {
        let world = SimpleCommunicator::world();
        let mut spare = self.spare.lock().unwrap_or_else(PoisonError::into_inner);
        spare.resize_with(self.size, Vec::new);
        mpi::request::scope(|scope| {
            let sent: Vec<_> = partners
                .iter()
                .map(|&rank| {
                    let to = world.process_at_rank(rank as i32);
                    WaitGuard::from(to.immediate_send(scope, &messages[rank][..]))
                })
                .collect();
            // A look at what has come lets the library go on with what is sent, too.
            while work() {
                let _ = world.any_process().immediate_probe();
            }
            for &rank in partners {
                let (message, status) = world.process_at_rank(rank as i32).matched_probe();
                let room = &mut spare[rank];
                room.resize(status.count(f64::equivalent_datatype()) as usize, 0.0);
                message.matched_receive_into(&mut room[..]);
            }
            drop(sent);
        });
        for &rank in partners {
            std::mem::swap(&mut messages[rank], &mut spare[rank]);
        }
    }

    fn broadcast(&self, message: &mut Vec<f64>) {
        let world = SimpleCommunicator::world();
        let root = world.process_at_rank(0);
        let mut length = message.len() as u64;
        root.broadcast_into(&mut length);
        message.resize(length as usize, 0.0);
        root.broadcast_into(&mut message[..]);
    }
}
