//! Contacts with their forces, for those who look on.

use super::{ContactForces, ContactSums, ForceInput, Scratch, features, pairs, walls};
use crate::contact::chunk::Chunk;
use crate::dem::contact_batch::ContactBatch;
use crate::view::Contact;
use std::ops::Range;

/// Shows the contacts of own blocks one by one, evaluated anew at the present positions and velocities without changing what is remembered.
pub(in crate::dem) fn each_contact(
    forces: &ContactForces,
    input: &ForceInput,
    blocks: Range<usize>,
    mut show: impl FnMut(Contact),
) {
    let input = ForceInput { moment: true, ..*input };
    let mut scratch = Scratch::new(input.laws.all());
    for (block, list) in forces.blocks[blocks.clone()].iter().zip(&input.neighbours.lists[blocks]) {
        let mut take = |batch: &ContactBatch, wall: bool| {
            // What is only near, within the reach of a law, is no contact.
            for r in (0..batch.chunk.rows()).filter(|&r| batch.chunk.contact_radius[r] > 0.0) {
                let first = list.first + batch.first[r] as usize;
                let second = batch.second[r] as usize;
                let second = if wall { second } else { list.grain_at[second] as usize };
                let contact_point = batch.contact_point(r);
                show(Contact {
                    first,
                    second,
                    wall,
                    position: input.grains.position[first] + contact_point,
                    branch: if wall { contact_point } else { batch.between_centres(r) },
                    force: Chunk::vector(&batch.force, r),
                    normal: Chunk::vector(&batch.chunk.normal, r),
                    overlap: batch.chunk.overlap[r],
                });
            }
        };
        let mut sums = ContactSums::default();
        scratch.features.near.forget(list.pairs.len());
        let mut history = block.history.clone();
        pairs::evaluate(&input, list, &mut history, &mut scratch, &mut sums, |batch| take(batch, false));
        features::evaluate(&input, list, &mut history, &mut scratch, &mut sums, |batch| take(batch, false));
        walls::evaluate(&input, list, &mut history, &mut scratch, &mut sums, |batch| take(batch, true));
    }
}
