//! Grains that touch walls: a wall is a body of infinite radius, under the same laws.

use super::{Load, Scene, Scratch, Sums, apply, skip};
use crate::contact::chunk::{Chunk, ROWS};
use crate::dem::memory::{Contacts, FRESH, Memory, WallKey};
use crate::dem::rows::Rows;
use crate::find::candidates::List;
use crate::view::WallLoad;
use crate::wall::{self, Wall};

/// Walks the grain-wall candidates of a block, law by law: a wall is a body of infinite radius.
pub(super) fn walls(
    scene: &Scene,
    list: &List,
    memory: &[Memory],
    scratch: &mut Scratch,
    sums: &mut Sums,
    mut visit: impl FnMut(&Rows),
) {
    for (law, memory) in memory.iter().enumerate() {
        walls_under(scene, law, list, memory, scratch, sums, &mut visit);
    }
}

/// The same for one law.
fn walls_under(
    scene: &Scene,
    number: usize,
    list: &List,
    memory: &Memory,
    scratch: &mut Scratch,
    sums: &mut Sums,
    visit: &mut impl FnMut(&Rows),
) {
    let g = scene.grains;
    let law = &scene.table.laws()[number];
    let several = scene.reaches.len() > 1;
    let remembers = law.width() > 0;
    let mut cursor = 0;
    let mut released = 0.0;
    scratch.rows[number].chunk.len = 0;
    scratch.keys.clear();
    // Candidates of one grain on one wall are looked at together: on a mesh some touch only as the edge of another.
    for near in list.walls.chunk_by(|a, b| (a.own, a.wall) == (b.own, b.wall)) {
        let (own, k) = (near[0].own, near[0].wall);
        let i = list.first + own as usize;
        let wall = &scene.walls[k as usize];
        let material = scene.table.index(g.material[i], wall.material);
        if several && scene.table.law(material) != number {
            continue;
        }
        let Scratch { elements, touching, .. } = scratch;
        elements.clear();
        elements.extend(near.iter().map(|candidate| candidate.element));
        wall.touching(elements, g.position[i], g.radius[i] + scene.reaches[number], touching);
        if remembers {
            let before = WallKey { own, wall: k, patch: 0 };
            let opened = skip(&memory.walls.keys, &mut cursor, |key| *key < before);
            released += memory.walls.held(opened, law);
            let old = skip(&memory.walls.keys, &mut cursor, |key| (key.own, key.wall) == (own, k));
            match_up(wall, &memory.walls.keys, &old, touching, &mut scratch.went_on);
            let went_on = &scratch.went_on;
            let ended = old.filter(|c| !went_on.contains(&place(*c)));
            released += ended.map(|c| memory.walls.held(c..c + 1, law)).sum::<f64>();
        }
        let mut t = 0;
        while t < scratch.touching.len() {
            let wall::Touch { element, nearest, .. } = scratch.touching[t];
            let overlap = g.radius[i] - nearest.distance;
            let rows = &mut scratch.rows[number];
            let r = rows.chunk.len;
            scratch.keys.push(WallKey { own, wall: k, patch: wall.key(element) });
            scratch.old[r] = if remembers { scratch.went_on[t] } else { FRESH };
            t += 1;
            let normal = -nearest.normal;
            rows.first[r] = own;
            rows.second[r] = k;
            rows.chunk.overlap[r] = overlap;
            Chunk::set(&mut rows.chunk.normal, r, normal);
            rows.chunk.radius[r] = g.radius[i];
            rows.chunk.mass[r] = 1.0 / (g.inverse_mass[i] + wall.inverse_mass);
            rows.arm[0][r] = g.radius[i] - 0.5 * overlap;
            rows.arm[1][r] = 0.0;
            rows.material[r] = material;
            Chunk::set(
                &mut rows.relative,
                r,
                g.velocity[i] - wall.velocity_at(g.position[i] + normal * rows.arm[0][r]),
            );
            Chunk::set(&mut rows.spin[0], r, g.spin[i]);
            Chunk::set(&mut rows.spin[1], r, wall.pose.spin);
            rows.chunk.len = r + 1;
            if r + 1 == ROWS {
                finish_walls(scene, number, memory, scratch, sums, visit);
            }
        }
    }
    finish_walls(scene, number, memory, scratch, sums, visit);
    if remembers {
        released += memory.walls.held(cursor..memory.walls.keys.len(), law);
        sums.lost[1] += released / scene.dt;
    }
}

/// For every place where a grain touches a wall, which of its `old` contacts with that wall goes on there. What has rolled
/// over a seam goes on with the history from the triangle before.
fn match_up(
    wall: &Wall,
    keys: &[WallKey],
    old: &std::ops::Range<usize>,
    touching: &[wall::Touch],
    went_on: &mut Vec<u32>,
) {
    let patch = |t: &wall::Touch| wall.key(t.element);
    went_on.clear();
    went_on.extend(touching.iter().map(|t| old.clone().find(|&c| keys[c].patch == patch(t)).map_or(FRESH, place)));
    for t in 1..touching.len() {
        // Two contacts of one patch share a name; the one history goes on once.
        if went_on[..t].contains(&went_on[t]) {
            went_on[t] = FRESH;
        }
    }
    for t in 0..touching.len() {
        if went_on[t] == FRESH {
            let free = |c: &usize| !went_on.contains(&place(*c));
            let before = old.clone().filter(free).find(|&c| wall.adjacent(keys[c].patch, patch(&touching[t])));
            went_on[t] = before.map_or(FRESH, place);
        }
    }
}

/// Where the history of contact `c` with a wall lies.
fn place(c: usize) -> u32 {
    Contacts::<WallKey>::place(c)
}

fn finish_walls(
    scene: &Scene,
    number: usize,
    memory: &Memory,
    scratch: &mut Scratch,
    sums: &mut Sums,
    visit: &mut impl FnMut(&Rows),
) {
    let Scratch { rows, next, old, keys, .. } = scratch;
    let (rows, next) = (&mut rows[number], &mut next[number]);
    let remembers = scene.table.laws()[number].width() > 0;
    let n = rows.chunk.rows();
    rows.motion(scene.rotation);
    if remembers {
        memory.walls.recall(&old[..n], &mut rows.chunk.history);
    }
    apply(scene, number, rows, sums);
    if remembers {
        next.walls.keys.extend_from_slice(keys);
        next.walls.remember(n, &rows.chunk.history);
    }
    visit(rows);
    keys.clear();
    rows.chunk.len = 0;
}

/// Adds the forces of a chunk of wall contacts to the grains and to the walls.
pub(super) fn react(scene: &Scene, list: &List, rows: &Rows, loads: &mut [Load], walls: &mut [WallLoad]) {
    for r in 0..rows.chunk.rows() {
        let own = rows.first[r] as usize;
        let force = Chunk::vector(&rows.force, r);
        let turn = Chunk::vector(&rows.turn[0], r);
        let load = &mut loads[own];
        load.force += force;
        load.lossy += Chunk::vector(&rows.lossy, r).as_vec3();
        if scene.rotation {
            load.torque += turn;
        }
        let k = rows.second[r] as usize;
        let wall = &scene.walls[k];
        let point = scene.grains.position[list.first + own] + rows.point(r);
        let mut torque = -(point - wall.pose.origin()).cross(force);
        if scene.rotation {
            torque -= Chunk::vector(&rows.chunk.torque, r);
        }
        walls[k].add(&WallLoad { force: -force, torque });
    }
}
