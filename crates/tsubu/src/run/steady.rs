//! Whether hosts are steady: their rms displacement, period by period, from the rows of the history.

use crate::partner::Hosts;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::Plan;

/// Section of a checkpoint.
const STEADY: &str = "run.steady";

/// Nothing is known of a period yet.
const UNKNOWN: f64 = f64::NAN;

/// The hosts that a sine drives.
#[derive(Default)]
pub(super) struct Steady {
    hosts: Vec<Driven>,
}

/// One of them.
struct Driven {
    /// Which host.
    index: usize,
    period: f64,
    /// Number of the present period, rows in it, their sum and sum of squares.
    sums: [f64; 4],
    /// Rms displacement in the last whole period and in the one before [m].
    rms: [f64; 2],
}

impl Steady {
    /// For a stage; nobody is looked at where it does not ask.
    pub(super) fn new(plan: &Plan, stage: usize) -> Self {
        let until = plan.stage.get(stage).and_then(|stage| stage.until.as_ref());
        if until.is_none_or(|until| until.host_steady.is_none()) {
            return Self::default();
        }
        let driven = plan.hosts.values().enumerate().filter_map(|(index, host)| Some((index, host.period()?)));
        let driven = driven.map(|(index, period)| Driven { index, period, sums: [0.0; 4], rms: [UNKNOWN; 2] });
        Self { hosts: driven.collect() }
    }

    /// Takes a row, so long after the begin of the stage [s].
    pub(super) fn take(&mut self, time: f64, hosts: &Hosts) {
        for driven in &mut self.hosts {
            let z = hosts.list[driven.index].displacement();
            // The row at the end of a period belongs to it, whatever rounding says.
            let number = (time / driven.period - 1e-9).floor().max(0.0);
            let [present, rows, sum, squares] = driven.sums;
            if number > present {
                let mean = sum / rows;
                driven.rms = [(squares / rows - mean * mean).max(0.0).sqrt(), driven.rms[0]];
                driven.sums = [number, 1.0, z, z * z];
            } else {
                driven.sums = [present, rows + 1.0, sum + z, squares + z * z];
            }
        }
    }

    /// Whether all of them have changed by less than a share from one period to the next.
    pub(super) fn within(&self, share: f64) -> bool {
        let steady = |[now, before]: [f64; 2]| (now - before).abs() < share * before;
        self.hosts.iter().all(|driven| steady(driven.rms))
    }

    pub(super) fn save(&self, state: &mut State) {
        if !self.hosts.is_empty() {
            let numbers = self.hosts.iter().flat_map(|driven| driven.sums.into_iter().chain(driven.rms));
            state.put_real(STEADY, numbers.collect::<Vec<_>>());
        }
    }

    pub(super) fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        if self.hosts.is_empty() {
            return Ok(());
        }
        let numbers = state.real(STEADY)?.as_chunks::<6>().0;
        if numbers.len() != self.hosts.len() {
            return Err(MissingSection { name: STEADY.to_owned(), kind: "real" });
        }
        for (driven, &[number, rows, sum, squares, now, before]) in self.hosts.iter_mut().zip(numbers) {
            (driven.sums, driven.rms) = ([number, rows, sum, squares], [now, before]);
        }
        Ok(())
    }
}
