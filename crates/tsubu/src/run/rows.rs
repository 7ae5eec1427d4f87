//! Rows of the history: what each run tells of itself, and what its watches add.

use super::Run;
use crate::engine;
use crate::ledger::{Account, Energies};

impl Run<'_> {
    pub(super) fn header(&self) -> Vec<String> {
        let mut header = vec!["time [s]".to_owned()];
        header
            .extend(engine::energies(&*self.engine, &self.hosts).terms().map(|(name, _)| format!("{name} energy [J]")));
        header.extend(Account::ALL.map(|a| format!("{} [J]", a.name())));
        header.extend(
            ["residual [J]", "momentum residual [N.s]", "contacts [-]", "centre of mass height [m]"].map(String::from),
        );
        for name in self.hosts.names() {
            header.push(format!("host {name} displacement [m]"));
            header.push(format!("host {name} velocity [m/s]"));
            header.push(format!("force on host {name} [N]"));
        }
        header.extend(self.watches.header());
        header
    }

    pub(super) fn row(&mut self) -> Vec<f64> {
        let energies = engine::energies(&*self.engine, &self.hosts);
        let mut row = vec![self.engine.time()];
        row.extend(energies.terms().map(|(_, value)| value));
        row.extend(Account::ALL.map(|a| self.ledger.flow(a)));
        row.push(self.ledger.residual(&energies));
        let momentum = self.ledger.momentum_residual(self.engine.momentum());
        row.push(momentum.iter().map(|p| p * p).sum::<f64>().sqrt());
        row.push(self.engine.contacts() as f64);
        row.push(self.height());
        for host in &self.hosts.list {
            row.extend([host.displacement(), host.velocity(), host.grain_force()]);
        }
        row.extend(self.watches.row(&*self.engine));
        let seen = self.seen(&energies);
        self.measured.take(&self.hosts, self.engine.contacts(), seen);
        self.lost.look(self.plan, &*self.engine);
        self.stages.steady.take(self.engine.time() - self.engine.stage_begin().1, &self.hosts);
        let row = self.in_columns(row);
        if let Some(onlooker) = self.onlooker {
            onlooker.row(&self.stages.columns, &row);
        }
        row
    }

    /// What every scene has to tell of itself, in the order of [`SEEN`].
    pub(super) fn seen(&self, energies: &Energies) -> [f64; 3] {
        [energies.kinetic + energies.rotational, self.height(), self.engine.contacts() as f64]
    }

    /// Height of the centre of mass [m]; not a number without grains.
    fn height(&self) -> f64 {
        if self.engine.grains() == 0 { f64::NAN } else { self.engine.centre_of_mass()[2] }
    }
}
