//! A structure in a checkpoint.

use super::Host;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

impl Host {
    /// Writes the state under `name`.
    pub fn save(&self, name: &str, state: &mut State) {
        let mut values = Vec::with_capacity(3 * self.n + 4);
        values.extend(&self.q);
        values.extend(&self.v);
        values.extend(&self.a);
        values.extend(self.power);
        values.push(self.grain_force);
        state.put_real(name, values);
        if self.interfaces.len() > 1 {
            state.put_real(&format!("{name}.felt"), self.felt.clone());
        }
        if self.driven_since != 0.0 {
            state.put_real(&format!("{name}.driven-since"), vec![self.driven_since]);
        }
        self.save_steered(name, state);
        self.save_dwell(name, state);
    }

    /// Takes the state back.
    pub fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let values = state.real(name)?;
        let n = self.n;
        if values.len() != 3 * n + 4 {
            return Err(MissingSection { name: name.to_owned(), kind: "real" });
        }
        self.q.copy_from_slice(&values[..n]);
        self.v.copy_from_slice(&values[n..2 * n]);
        self.a.copy_from_slice(&values[2 * n..3 * n]);
        self.power.copy_from_slice(&values[3 * n..3 * n + 3]);
        self.grain_force = values[3 * n + 3];
        for (felt, seen) in self.felt.iter_mut().zip(&self.seen) {
            *felt = seen * self.grain_force;
        }
        if self.interfaces.len() > 1 {
            let felt = state.real(&format!("{name}.felt"))?;
            if felt.len() != n {
                return Err(MissingSection { name: name.to_owned(), kind: "real" });
            }
            self.felt.copy_from_slice(felt);
        }
        if let Ok(&[since]) = state.real(&format!("{name}.driven-since")) {
            self.driven_since = since;
        }
        self.load_steered(name, state);
        self.load_dwell(name, state)
    }
}
