//! Polyhedra that touch other grains, contact by contact of their features.

use super::{ContactSums, ForceInput, Scratch, apply_law, power};
use crate::contact::chunk::ROWS;
use crate::dem::contact_batch::ContactBatch;
use crate::dem::contact_history::{ContactHistory, Walk};
use crate::neighbours::block::BlockList;

/// Walks the contacts that [`super::pairs::evaluate`] has left for here, law by law; `visit` sees every finished batch.
pub(super) fn evaluate(
    input: &ForceInput,
    list: &BlockList,
    history: &mut [ContactHistory],
    scratch: &mut Scratch,
    sums: &mut ContactSums,
    mut visit: impl FnMut(&ContactBatch),
) {
    if !input.bodies.faceted() {
        return;
    }
    let ForceInput { grains, laws, .. } = *input;
    let Scratch { spheres, features, batches, .. } = scratch;
    for (number, (law, (history, batch))) in laws.all().iter().zip(history.iter_mut().zip(batches)).enumerate() {
        let (history, remembers) = (&mut history.features, law.width() > 0);
        let mut walk = Walk::default();
        let count = features.under(number, input, list);
        for start in (0..count).step_by(ROWS) {
            let range = start..count.min(start + ROWS);
            batch.gather(features.pairs(range.clone()), grains, list, spheres, &laws.table, laws.rotation);
            features.gather(batch, range.clone(), input, list);
            batch.sphere_geometry(laws.rotation, laws.lever_share);
            features.lie_back(batch);
            features.show_mass(batch, input, list);
            if remembers {
                history.recall(features.keys(range.clone()), &mut walk, law, &mut batch.chunk.history);
            }
            apply_law(input, number, batch, sums);
            features.push_less(batch);
            if remembers {
                history.remember(features.keys(range), &mut walk, &batch.chunk.history);
            }
            visit(batch);
        }
        if remembers {
            history.end(&mut walk, law);
            sums.lost.sliding += power(walk.released, input);
        }
    }
}
