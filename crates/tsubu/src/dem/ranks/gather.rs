//! Numbers of all ranks in one place.

use super::Ranks;

impl Ranks {
    /// What all ranks have, in the order of the ranks; `mine` alone where there is but one.
    pub fn gather(&self, mine: Vec<f64>) -> Vec<f64> {
        let Some(all) = &self.communicator else { return mine };
        let mut messages = vec![mine; all.size()];
        all.exchange(&mut messages);
        messages.concat()
    }

    /// The same on the first rank; on others nothing.
    pub fn gather_first(&self, mut mine: Vec<f64>) -> Vec<f64> {
        if !self.is_first() {
            self.tell_first(mine);
            return Vec::new();
        }
        let others = self.tell_first(Vec::new());
        mine.reserve_exact(others.iter().map(Vec::len).sum());
        others.into_iter().for_each(|mut message| mine.append(&mut message));
        mine
    }

    /// What the other ranks have, in their order, on the first rank; on others nothing.
    pub fn tell_first(&self, mine: Vec<f64>) -> Vec<Vec<f64>> {
        let Some(all) = &self.communicator else { return Vec::new() };
        let mut messages = self.letters();
        messages[0] = mine;
        all.exchange(&mut messages);
        if self.is_first() { messages.split_off(1) } else { Vec::new() }
    }
}
