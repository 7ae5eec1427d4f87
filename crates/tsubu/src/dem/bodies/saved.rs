//! Bodies in a checkpoint, in the order of their numbers.

use super::{Bodies, NO_BODY};
use crate::state::Grains;
use glam::{DQuat, DVec3};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Names of [`super::Body::vectors`] in a checkpoint.
const VECTORS: [&str; 5] =
    ["bodies.centre", "bodies.velocity", "bodies.acceleration", "bodies.angular-momentum", "bodies.torque"];

impl Bodies {
    pub fn save(&self, state: &mut State) {
        if self.is_empty() {
            return;
        }
        for (k, name) in VECTORS.iter().enumerate() {
            let column = self.numbered().flat_map(|body| body.vectors()[k].to_array());
            state.put_real(name, column.collect::<Vec<_>>());
        }
        let turned = self.numbered().flat_map(|body| body.orientation.to_array());
        state.put_real("bodies.orientation", turned.collect::<Vec<_>>());
    }

    /// Takes it back, with the grains that were saved beside.
    pub fn load(&mut self, state: &State, grains: &Grains) -> Result<(), MissingSection> {
        if self.is_empty() {
            return Ok(());
        }
        let missing = |name: &str| MissingSection { name: name.to_owned(), kind: "real" };
        if grains.id.iter().any(|id| *id as usize >= self.by_id.len()) {
            return Err(missing("bodies"));
        }
        self.find(grains);
        // A body is there with all of its pieces.
        let mut pieces = vec![0; self.list.len()];
        for piece in self.by_id.iter().filter(|piece| piece.body != NO_BODY) {
            pieces[piece.body as usize] += 1;
        }
        if self.numbered().zip(pieces).any(|(body, count)| body.is_there() && body.pieces.len() != count) {
            return Err(missing("bodies"));
        }
        for (k, name) in VECTORS.iter().enumerate() {
            let column = state.real(name)?.as_chunks::<3>().0;
            if column.len() != self.list.len() {
                return Err(missing(name));
            }
            for (rank, value) in self.rank.iter().zip(column) {
                *self.list[*rank as usize].vectors_mut()[k] = DVec3::from_array(*value);
            }
        }
        let turned = state.real("bodies.orientation")?.as_chunks::<4>().0;
        if turned.len() != self.list.len() {
            return Err(missing("bodies.orientation"));
        }
        for (rank, turned) in self.rank.iter().zip(turned) {
            let body = &mut self.list[*rank as usize];
            body.orientation = DQuat::from_array(*turned);
            body.follow(self.plane);
        }
        Ok(())
    }
}
