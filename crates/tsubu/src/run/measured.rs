//! What a run measures of itself at every row of the history: means and spreads for its summary.

use crate::partner::Hosts;
use crate::watch::means::Means;
use tsubu_frame::state::MissingSection;
use tsubu_frame::{State, Summary};

/// What every scene has to tell of itself, with its unit.
pub(super) const SEEN: [(&str, &str); 3] = [("kinetic energy", "J"), ("centre of mass height", "m"), ("contacts", "-")];

/// What is measured at every row of the history.
#[derive(Default)]
pub(super) struct Measured {
    /// Of [`SEEN`].
    seen: Means,
    rows: f64,
    contacts: f64,
    /// Both in the stages before this one.
    before: [f64; 2],
    /// Per host: sum, sum of squares, largest absolute value of the displacement.
    hosts: Vec<[f64; 3]>,
}

impl Measured {
    pub(super) fn new(hosts: &Hosts) -> Self {
        Self { hosts: vec![[0.0; 3]; hosts.list.len()], ..Self::default() }
    }

    /// For the next stage of a run.
    pub(super) fn next(&self) -> Self {
        let before = [self.before[0] + self.rows, self.before[1] + self.contacts];
        Self { hosts: vec![[0.0; 3]; self.hosts.len()], before, ..Self::default() }
    }

    /// The mean number of contacts in the whole run.
    pub(super) fn contacts_mean(&self) -> f64 {
        (self.before[1] + self.contacts) / (self.before[0] + self.rows).max(1.0)
    }

    pub(super) fn take(&mut self, hosts: &Hosts, contacts: usize, seen: [f64; 3]) {
        self.seen.take(seen.into_iter());
        self.rows += 1.0;
        self.contacts += contacts as f64;
        for (sums, host) in self.hosts.iter_mut().zip(&hosts.list) {
            let z = host.displacement();
            *sums = [sums[0] + z, sums[1] + z * z, sums[2].max(z.abs())];
        }
    }

    pub(super) fn tell(&self, last: [f64; 3], summary: &mut Summary) {
        let means = self.seen.get().zip(self.seen.spreads()).zip(last);
        for ((name, unit), ((mean, spread), last)) in SEEN.into_iter().zip(means) {
            summary.give(name, unit, mean);
            summary.give(format!("{name} spread"), unit, spread);
            summary.give(format!("{name} final"), unit, last);
        }
    }

    pub(super) fn results(&self, hosts: &Hosts, summary: &mut Summary) {
        for (sums, name) in self.hosts.iter().zip(hosts.names()) {
            let mean = sums[0] / self.rows;
            let variance = (sums[1] / self.rows - mean * mean).max(0.0);
            summary.give(format!("host {name} rms displacement"), "m", variance.sqrt());
            summary.give(format!("host {name} peak displacement"), "m", sums[2]);
            summary.give(format!("host {name} mean displacement"), "m", mean);
        }
    }

    pub(super) fn save(&self, state: &mut State) {
        let mut values = vec![self.rows, self.contacts, self.before[0], self.before[1]];
        values.extend(self.hosts.iter().flatten());
        state.put_real("run.measured", values);
        state.put_real("run.seen", self.seen.numbers());
    }

    pub(super) fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let values = state.real("run.measured")?;
        if values.len() != 4 + 3 * self.hosts.len() {
            return Err(MissingSection { name: "run.measured".to_owned(), kind: "real" });
        }
        self.seen = Means::from_numbers(state.real("run.seen")?);
        (self.rows, self.contacts, self.before) = (values[0], values[1], [values[2], values[3]]);
        for (sums, v) in self.hosts.iter_mut().zip(values[4..].chunks_exact(3)) {
            sums.copy_from_slice(v);
        }
        Ok(())
    }
}
