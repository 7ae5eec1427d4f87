//! Grains that touch grains.

use super::{ContactSums, ForceInput, Load, Scratch, apply_law, power};
use crate::contact::chunk::{Chunk, ROWS};
use crate::dem::contact_batch::ContactBatch;
use crate::dem::contact_history::{ContactHistory, Walk};
use crate::mutation::{Mutation, mutated};
use crate::neighbours::block::BlockList;

/// Walks the grain-grain pairs of a block, law by law; `visit` sees every finished batch.
pub(super) fn evaluate(
    input: &ForceInput,
    list: &BlockList,
    history: &mut [ContactHistory],
    scratch: &mut Scratch,
    sums: &mut ContactSums,
    mut visit: impl FnMut(&ContactBatch),
) {
    let ForceInput { grains, laws, .. } = *input;
    let Scratch { spheres, touching_pairs, shapes, features, batches, .. } = scratch;
    spheres.load(grains, list, &input.neighbours.shifts);
    touching_pairs.find(list, spheres, laws.reach());
    features.take(touching_pairs, input, list, spheres);
    shapes.find(touching_pairs, input, list, spheres);
    if laws.reaches.len() > 1 {
        touching_pairs.group_by_law(grains, list, spheres, &laws.table, &laws.reaches);
        shapes.part(touching_pairs, &laws.reaches);
    }
    for (number, (law, (history, batch))) in laws.all().iter().zip(history.iter_mut().zip(batches)).enumerate() {
        let (history, remembers) = (&mut history.pairs, law.width() > 0);
        let mut walk = Walk::default();
        for touching in touching_pairs.under(number).chunks(ROWS) {
            batch.gather(touching, grains, list, spheres, &laws.table, laws.rotation);
            shapes.gather(batch, touching);
            batch.sphere_geometry(laws.rotation, laws.lever_share);
            shapes.show_mass(input.bodies, batch, list);
            let keys = touching.iter().map(|touching| touching.pair);
            if remembers {
                history.recall(keys.clone(), &mut walk, law, &mut batch.chunk.history);
            }
            apply_law(input, number, batch, sums);
            shapes.round(batch, law);
            if remembers {
                history.remember(keys, &mut walk, &batch.chunk.history);
            }
            visit(batch);
        }
        if remembers {
            history.end(&mut walk, law);
            sums.lost.sliding += power(walk.released, input);
        }
    }
}

/// Adds the forces of a batch to both grains of every row.
pub(super) fn scatter(batch: &ContactBatch, loads: &mut [Load], rotation: bool) {
    for r in 0..batch.chunk.rows() {
        let force = Chunk::vector(&batch.force, r);
        let dissipative = Chunk::vector(&batch.dissipative, r).as_vec3();
        let first = &mut loads[batch.first[r] as usize];
        first.force += force;
        first.dissipative += dissipative;
        if rotation {
            first.torque += Chunk::vector(&batch.torque[0], r);
        }
        if batch.shifted {
            first.torque += batch.shift(0, r).cross(force);
        }
        let second = &mut loads[batch.second[r] as usize];
        second.force -= mutated(Mutation::ThirdLaw, 1.0) * force;
        second.dissipative -= dissipative;
        if rotation {
            second.torque += Chunk::vector(&batch.torque[1], r);
        }
        if batch.shifted {
            second.torque -= batch.shift(1, r).cross(force);
        }
    }
}
