//! Grains that touch walls: a wall is a body of infinite radius, under the same laws.

use super::{ContactSums, ForceInput, Load, Scratch, apply_law, power};
use crate::contact::chunk::{Chunk, ROWS};
use crate::dem::contact_batch::ContactBatch;
use crate::dem::contact_history::{ContactHistory, FRESH, HistoryColumns, Walk, WallKey};
use crate::dem::wall_shapes::WallShape;
use crate::neighbours::block::BlockList;
use crate::view::WallLoad;
use crate::wall::Wall;

/// Walks the grain-wall candidates of a block, law by law; `visit` sees every finished batch.
pub(super) fn evaluate(
    input: &ForceInput,
    list: &BlockList,
    history: &mut [ContactHistory],
    scratch: &mut Scratch,
    sums: &mut ContactSums,
    mut visit: impl FnMut(&ContactBatch),
) {
    for (law, history) in history.iter_mut().enumerate() {
        evaluate_law(input, law, list, &mut history.walls, scratch, sums, &mut visit);
    }
}

/// The same for one law.
fn evaluate_law(
    input: &ForceInput,
    number: usize,
    list: &BlockList,
    history: &mut HistoryColumns<WallKey>,
    scratch: &mut Scratch,
    sums: &mut ContactSums,
    visit: &mut impl FnMut(&ContactBatch),
) {
    let g = input.grains;
    let law = &input.laws.all()[number];
    let several = input.laws.reaches.len() > 1;
    let remembers = law.width() > 0;
    let shaped = input.bodies.shaped() || input.bodies.faceted();
    if list.walls.is_empty() && history.keys.is_empty() {
        return;
    }
    let mut walk = Walk::default();
    scratch.batches[number].chunk.len = 0;
    scratch.keys.clear();
    // Contacts with walls are few, and not read in the order in which they are written.
    let mut before = std::mem::take(&mut scratch.wall_history);
    before.keep(history);
    history.clear(law.width());
    let mut written = Walk::default();
    // NeighbourLists of one grain on one wall are looked at together: on a mesh some touch only as the edge of another.
    for near in list.walls.chunk_by(|a, b| (a.own, a.wall) == (b.own, b.wall)) {
        let (own, k) = (near[0].own, near[0].wall);
        let i = list.first + own as usize;
        let wall = &input.walls[k as usize];
        let material = input.laws.table.index(g.material[i], wall.material);
        if several && input.laws.table.law(material) != number {
            continue;
        }
        let Scratch { elements, wall_shapes, .. } = scratch;
        elements.clear();
        elements.extend(near.iter().map(|candidate| candidate.element));
        let reach = input.laws.reaches[number];
        wall_shapes.find(input, list, (own, k), elements, reach);
        if remembers {
            let first = WallKey { own, wall: k, patch: 0 };
            before.open(&mut walk, law, |key| *key < first);
            let old = before.pass(&mut walk, |key| (key.own, key.wall) == (own, k));
            match_up(wall, &before.keys, &old, (&wall_shapes.found, shaped), &mut scratch.went_on);
            let went_on = &scratch.went_on;
            let ended = old.filter(|c| !went_on.contains(&slot(*c)));
            walk.released += ended.map(|c| before.stored_energy(c..c + 1, law)).sum::<f64>();
        }
        for t in 0..scratch.wall_shapes.found.len() {
            let shape = scratch.wall_shapes.found[t];
            let WallShape { overlap, normal, radius, shift, patch, .. } = shape;
            let batch = &mut scratch.batches[number];
            let r = batch.chunk.len;
            scratch.keys.push(WallKey { own, wall: k, patch });
            scratch.old[r] = if remembers { scratch.went_on[t] } else { FRESH };
            batch.first[r] = own;
            batch.second[r] = k;
            batch.chunk.overlap[r] = overlap;
            Chunk::set(&mut batch.chunk.normal, r, normal);
            batch.chunk.effective_radius[r] = radius;
            batch.chunk.effective_mass[r] = 1.0 / (g.inverse_mass[i] + wall.inverse_mass);
            batch.lever_arm[0][r] = radius - input.laws.lever_share * overlap;
            batch.lever_arm[1][r] = 0.0;
            batch.material_pair[r] = material;
            let (mut centre, mut velocity) = (g.position[i], g.velocity[i]);
            batch.shifted = shaped;
            if batch.shifted {
                (centre, velocity) = (centre + shift, velocity + g.spin[i].cross(shift));
                scratch.wall_shapes.push(batch, r, &shape);
            }
            let contact = centre + normal * batch.lever_arm[0][r];
            Chunk::set(&mut batch.relative_velocity, r, velocity - wall.velocity_at(contact));
            Chunk::set(&mut batch.spin[0], r, g.spin[i]);
            Chunk::set(&mut batch.spin[1], r, wall.pose.spin);
            batch.chunk.len = r + 1;
            if r + 1 == ROWS {
                finish(input, number, list, (&before, history, &mut written), scratch, sums, visit);
            }
        }
    }
    finish(input, number, list, (&before, history, &mut written), scratch, sums, visit);
    if remembers {
        before.open(&mut walk, law, |_| true);
        sums.lost.sliding += power(walk.released, input);
    }
    scratch.wall_history = before;
}

/// For every place where a grain touches a wall, which of its `old` contacts with that wall goes on there. What has rolled
/// over a seam goes on with the history from the triangle before.
fn match_up(
    wall: &Wall,
    keys: &[WallKey],
    old: &std::ops::Range<usize>,
    (places, shaped): (&[WallShape], bool),
    went_on: &mut Vec<u32>,
) {
    went_on.clear();
    let same = |place: &WallShape| old.clone().find(|&c| keys[c].patch == place.patch).map_or(FRESH, slot);
    went_on.extend(places.iter().map(same));
    for t in 1..places.len() {
        // Two contacts of one patch share a name; the one history goes on once.
        if went_on[..t].contains(&went_on[t]) {
            went_on[t] = FRESH;
        }
    }
    for (t, place) in places.iter().enumerate() {
        if went_on[t] == FRESH {
            let free = |c: &usize| !went_on.contains(&slot(*c));
            let before = old.clone().filter(free).find(|&c| place.may_follow(wall, keys[c].patch, shaped));
            went_on[t] = before.map_or(FRESH, slot);
        }
    }
}

/// Where the history of contact `c` with a wall lies.
fn slot(c: usize) -> u32 {
    HistoryColumns::<WallKey>::slot(c)
}

fn finish(
    input: &ForceInput,
    number: usize,
    list: &BlockList,
    (before, history, written): (&HistoryColumns<WallKey>, &mut HistoryColumns<WallKey>, &mut Walk),
    scratch: &mut Scratch,
    sums: &mut ContactSums,
    visit: &mut impl FnMut(&ContactBatch),
) {
    let Scratch { batches, old, keys, wall_shapes, .. } = scratch;
    let batch = &mut batches[number];
    let remembers = input.laws.all()[number].width() > 0;
    let n = batch.chunk.rows();
    batch.relative_motion(input.laws.rotation);
    wall_shapes.lie_back(batch);
    input.bodies.show_mass(batch, list, true, |_| true);
    if remembers {
        before.gather(&old[..n], &mut batch.chunk.history);
    }
    apply_law(input, number, batch, sums);
    wall_shapes.round(batch, &input.laws.all()[number]);
    if remembers {
        history.remember(keys.iter().copied(), written, &batch.chunk.history);
    }
    visit(batch);
    keys.clear();
    batch.chunk.len = 0;
}

/// Adds the forces of a chunk of wall contacts to the grains and to the walls.
pub(super) fn scatter(
    input: &ForceInput,
    list: &BlockList,
    batch: &ContactBatch,
    loads: &mut [Load],
    walls: &mut [WallLoad],
) {
    for r in 0..batch.chunk.rows() {
        let own = batch.first[r] as usize;
        let force = Chunk::vector(&batch.force, r);
        let torque = Chunk::vector(&batch.torque[0], r);
        let load = &mut loads[own];
        load.force += force;
        load.dissipative += Chunk::vector(&batch.dissipative, r).as_vec3();
        if input.laws.rotation {
            load.torque += torque;
        }
        if batch.shifted {
            load.torque += batch.shift(0, r).cross(force);
        }
        let k = batch.second[r] as usize;
        let wall = &input.walls[k];
        let point = input.grains.position[list.first + own] + batch.contact_point(r);
        let mut torque = -(point - wall.pose.origin()).cross(force);
        if input.laws.rotation {
            torque -= Chunk::vector(&batch.chunk.torque, r);
        }
        walls[k].add(&WallLoad { force: -force, torque });
    }
}
