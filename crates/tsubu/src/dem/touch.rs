//! Touch: candidates into chunks, the law on the chunks, forces back to the grains.
//!
//! Candidates are taken in blocks of [`ROWS`]. With one thread the forces of a block are scattered to the grains at once;
//! with many the blocks leave their forces beside the pairs, and every grain gathers its own in the order of the pairs:
//! the same additions in the same order, so the same bits.

use crate::contact::chunk::{HISTORY, ROWS};
use crate::contact::{Chunk, Law, Table};
use crate::find::Candidates;
use crate::state::Grains;
use crate::wall::Plane;
use glam::DVec3;
use rayon::prelude::*;

/// Fewer grains than this are not worth waking threads for.
const WORTH_THREADS: usize = 2000;

/// Forces of one time level, and what the contacts hold and lose.
#[derive(Clone, Debug, Default)]
pub(super) struct Forces {
    /// Contact force on every grain [N].
    pub force: Vec<DVec3>,
    /// Contact torque on every grain [N.m].
    pub torque: Vec<DVec3>,
    /// The part of the force that takes energy away: damping and friction [N].
    pub lossy: Vec<DVec3>,
    /// Force of the grains on every plane [N].
    pub plane_force: Vec<DVec3>,
    /// Sums over all contacts.
    pub sums: Sums,
}

/// Sums over contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sums {
    /// Stored energy [J].
    pub stored: f64,
    /// Power lost in normal damping, sliding, rolling [W].
    pub lost: [f64; 3],
    /// Touching pairs.
    pub contacts: usize,
    /// Deepest overlap [m].
    pub deepest: f64,
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.stored += other.stored;
        for (a, b) in self.lost.iter_mut().zip(other.lost) {
            *a += b;
        }
        self.contacts += other.contacts;
        self.deepest = self.deepest.max(other.deepest);
    }

    /// Adds a correction of the losses [W], to each in proportion.
    pub fn correct(&mut self, correction: f64) {
        let total: f64 = self.lost.iter().map(|l| l.abs()).sum();
        if total > 0.0 {
            for lost in &mut self.lost {
                *lost += correction * lost.abs() / total;
            }
        }
    }
}

/// Force and torques of one touching pair.
#[derive(Clone, Copy, Debug, Default)]
struct Action {
    force: DVec3,
    lossy: DVec3,
    torque: [DVec3; 2],
}

/// Scratch of the touch phase, and the history of every candidate.
#[derive(Clone, Debug, Default)]
pub(super) struct Touch {
    /// History of grain-grain candidates.
    pub pair_history: Vec<[f64; HISTORY]>,
    /// History of grain-plane candidates.
    pub wall_history: Vec<[f64; HISTORY]>,
    block: Block,
    actions: Vec<Action>,
    /// Per grain: its pairs, as 2 k for the first body and 2 k + 1 for the second.
    gather_start: Vec<u32>,
    gather: Vec<u32>,
}

/// One chunk at work: which candidate each row came from, and the lever arms.
#[derive(Clone, Debug, Default)]
struct Block {
    chunk: Box<Chunk>,
    row: Vec<u32>,
    arm: Vec<[f64; 2]>,
}

/// What the touch phase reads.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub grains: &'a Grains,
    pub planes: &'a [Plane],
    pub candidates: &'a Candidates,
    pub law: &'a Law,
    pub table: &'a Table,
    pub rotation: bool,
    pub dt: f64,
}

impl Touch {
    /// Forgets the gather index; called when the candidates have changed.
    pub fn reset(&mut self) {
        self.gather_start.clear();
    }

    /// Evaluates all contacts.
    pub fn forces(&mut self, scene: &Scene, forces: &mut Forces) {
        let n = scene.grains.len();
        forces.force.clear();
        forces.force.resize(n, DVec3::ZERO);
        forces.lossy.clear();
        forces.lossy.resize(n, DVec3::ZERO);
        forces.torque.clear();
        forces.torque.resize(n, DVec3::ZERO);
        forces.plane_force.clear();
        forces.plane_force.resize(scene.planes.len(), DVec3::ZERO);
        forces.sums = Sums::default();
        if n >= WORTH_THREADS && rayon::current_num_threads() > 1 {
            self.pairs_threaded(scene, forces);
        } else {
            self.pairs_serial(scene, forces);
        }
        self.walls(scene, forces);
    }

    fn pairs_serial(&mut self, scene: &Scene, forces: &mut Forces) {
        let pairs = &scene.candidates.pairs;
        for (pairs, history) in pairs.chunks(ROWS).zip(self.pair_history.chunks_mut(ROWS)) {
            let sums = self.block.pairs(scene, pairs, history);
            forces.sums.add(&sums);
            for r in 0..self.block.row.len() {
                let [i, j] = pairs[self.block.row[r] as usize].map(|i| i as usize);
                let action = self.block.action(r, scene.rotation);
                forces.force[i] += action.force;
                forces.force[j] -= action.force;
                forces.lossy[i] += action.lossy;
                forces.lossy[j] -= action.lossy;
                if scene.rotation {
                    forces.torque[i] += action.torque[0];
                    forces.torque[j] += action.torque[1];
                }
            }
        }
    }

    fn pairs_threaded(&mut self, scene: &Scene, forces: &mut Forces) {
        let pairs = &scene.candidates.pairs;
        if self.gather_start.is_empty() {
            self.index(scene.grains.len(), pairs);
        }
        self.actions.resize(pairs.len(), Action::default());
        let sums: Vec<Sums> = pairs
            .par_chunks(ROWS)
            .zip(self.pair_history.par_chunks_mut(ROWS))
            .zip(self.actions.par_chunks_mut(ROWS))
            .map_init(Block::default, |block, ((pairs, history), actions)| {
                let sums = block.pairs(scene, pairs, history);
                actions.fill(Action::default());
                for r in 0..block.row.len() {
                    actions[block.row[r] as usize] = block.action(r, scene.rotation);
                }
                sums
            })
            .collect();
        for part in &sums {
            forces.sums.add(part);
        }
        let (start, gather, actions) = (&self.gather_start, &self.gather, &self.actions);
        let Forces { force, torque, lossy, .. } = forces;
        force
            .par_iter_mut()
            .zip(torque.par_iter_mut())
            .zip(lossy.par_iter_mut())
            .enumerate()
            .with_min_len(256)
            .for_each(|(i, ((force, torque), lossy))| {
                for &entry in &gather[start[i] as usize..start[i + 1] as usize] {
                    let action = &actions[(entry >> 1) as usize];
                    if entry & 1 == 0 {
                        *force += action.force;
                        *lossy += action.lossy;
                    } else {
                        *force -= action.force;
                        *lossy -= action.lossy;
                    }
                    *torque += action.torque[(entry & 1) as usize];
                }
            });
    }

    /// Lists the pairs of every grain, in the order of the pairs.
    fn index(&mut self, grains: usize, pairs: &[[u32; 2]]) {
        self.gather_start.clear();
        self.gather_start.resize(grains + 1, 0);
        for pair in pairs {
            for &i in pair {
                self.gather_start[i as usize + 1] += 1;
            }
        }
        for i in 0..grains {
            self.gather_start[i + 1] += self.gather_start[i];
        }
        let mut next = self.gather_start.clone();
        self.gather.resize(2 * pairs.len(), 0);
        for (k, pair) in pairs.iter().enumerate() {
            for (side, &i) in pair.iter().enumerate() {
                self.gather[next[i as usize] as usize] = 2 * k as u32 + side as u32;
                next[i as usize] += 1;
            }
        }
    }

    fn walls(&mut self, scene: &Scene, forces: &mut Forces) {
        for (pairs, history) in scene.candidates.walls.chunks(ROWS).zip(self.wall_history.chunks_mut(ROWS)) {
            let sums = self.block.walls(scene, pairs, history);
            forces.sums.add(&sums);
            for r in 0..self.block.row.len() {
                let [i, k] = pairs[self.block.row[r] as usize].map(|i| i as usize);
                let action = self.block.action(r, scene.rotation);
                forces.force[i] += action.force;
                forces.lossy[i] += action.lossy;
                forces.plane_force[k] -= action.force;
                if scene.rotation {
                    forces.torque[i] += action.torque[0];
                }
            }
        }
    }
}

/// A touching pair, for pictures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Index of the first grain.
    pub first: usize,
    /// Index of the second grain; `None` for a wall.
    pub second: Option<usize>,
    /// Point of contact [m].
    pub position: DVec3,
    /// Force on the first grain [N].
    pub force: DVec3,
    /// Overlap [m].
    pub overlap: f64,
}

impl Touch {
    /// All contacts, evaluated anew at the present positions and velocities without touching the history.
    pub fn contacts(&self, scene: &Scene) -> Vec<Contact> {
        // A step of length zero leaves the tangential springs as they are.
        let scene = Scene { dt: 0.0, ..*scene };
        let mut block = Block::default();
        let mut contacts = Vec::new();
        let mut take = |block: &Block, pairs: &[[u32; 2]], walls: bool| {
            for r in 0..block.row.len() {
                let [i, j] = pairs[block.row[r] as usize].map(|i| i as usize);
                contacts.push(Contact {
                    first: i,
                    second: (!walls).then_some(j),
                    position: scene.grains.position[i] + Chunk::vector(&block.chunk.normal, r) * block.arm[r][0],
                    force: block.action(r, false).force,
                    overlap: block.chunk.overlap[r],
                });
            }
        };
        for (pairs, history) in scene.candidates.pairs.chunks(ROWS).zip(self.pair_history.chunks(ROWS)) {
            block.pairs(&scene, pairs, &mut history.to_vec());
            take(&block, pairs, false);
        }
        for (pairs, history) in scene.candidates.walls.chunks(ROWS).zip(self.wall_history.chunks(ROWS)) {
            block.walls(&scene, pairs, &mut history.to_vec());
            take(&block, pairs, true);
        }
        contacts
    }
}

impl Block {
    fn clear(&mut self) {
        self.chunk.len = 0;
        self.row.clear();
        self.arm.clear();
    }

    /// Fills the chunk with the touching ones of the grain-grain candidates and applies the law.
    fn pairs(&mut self, scene: &Scene, pairs: &[[u32; 2]], history: &mut [[f64; HISTORY]]) -> Sums {
        self.clear();
        let grains = scene.grains;
        let mut released = 0.0;
        for (k, pair) in pairs.iter().enumerate() {
            let [i, j] = pair.map(|i| i as usize);
            let between = grains.position[j] - grains.position[i];
            let reach = grains.radius[i] + grains.radius[j];
            let squared = between.length_squared();
            if squared >= reach * reach {
                released += release(scene, &mut history[k]);
                continue;
            }
            let distance = squared.sqrt();
            // Two centres in one place have no normal; any will do, the overlap limit stops the run.
            let normal = if distance > 0.0 { between / distance } else { DVec3::Z };
            let overlap = reach - distance;
            let arm = [grains.radius[i] - 0.5 * overlap, grains.radius[j] - 0.5 * overlap];
            let mut relative = grains.velocity[i] - grains.velocity[j];
            if scene.rotation {
                relative += (grains.spin[i] * arm[0] + grains.spin[j] * arm[1]).cross(normal);
            }
            self.push(scene, k, overlap, normal, relative, arm, [grains.species[i], grains.species[j]], &history[k]);
            if scene.law.needs.roll {
                self.roll(grains.spin[i] - grains.spin[j], normal);
            }
        }
        self.finish(scene, history, released)
    }

    /// The same for grain-plane candidates: a plane is a body of infinite radius and mass.
    fn walls(&mut self, scene: &Scene, pairs: &[[u32; 2]], history: &mut [[f64; HISTORY]]) -> Sums {
        self.clear();
        let grains = scene.grains;
        let mut released = 0.0;
        for (k, pair) in pairs.iter().enumerate() {
            let i = pair[0] as usize;
            let plane = &scene.planes[pair[1] as usize];
            let overlap = grains.radius[i] - plane.distance(grains.position[i]);
            if overlap <= 0.0 {
                released += release(scene, &mut history[k]);
                continue;
            }
            let normal = -plane.normal;
            let arm = [grains.radius[i] - 0.5 * overlap, 0.0];
            let mut relative = grains.velocity[i] - plane.velocity;
            if scene.rotation {
                relative += (grains.spin[i] * arm[0]).cross(normal);
            }
            self.push(scene, k, overlap, normal, relative, arm, [grains.species[i], plane.species], &history[k]);
            if scene.law.needs.roll {
                self.roll(grains.spin[i], normal);
            }
        }
        self.finish(scene, history, released)
    }

    #[inline]
    #[expect(clippy::too_many_arguments, reason = "one row of a chunk, written in one place")]
    fn push(
        &mut self,
        scene: &Scene,
        candidate: usize,
        overlap: f64,
        normal: DVec3,
        relative: DVec3,
        arm: [f64; 2],
        species: [u32; 2],
        history: &[f64; HISTORY],
    ) {
        let chunk = &mut *self.chunk;
        let r = chunk.len;
        let closing = relative.dot(normal);
        chunk.overlap[r] = overlap;
        chunk.root[r] = overlap.sqrt();
        chunk.closing[r] = closing;
        Chunk::set(&mut chunk.normal, r, normal);
        Chunk::set(&mut chunk.slip, r, relative - normal * closing);
        let pair = scene.table.pair(species[0], species[1]);
        chunk.stiffness[r] = pair.stiffness;
        chunk.damping[r] = pair.damping;
        chunk.shear[r] = pair.shear;
        chunk.shear_damping[r] = pair.shear_damping;
        chunk.friction[r] = pair.friction;
        chunk.rolling[r] = pair.rolling_friction * pair.radius;
        chunk.radius[r] = pair.radius;
        chunk.mass[r] = pair.mass;
        if scene.law.needs.history {
            for (column, value) in chunk.history.iter_mut().zip(history) {
                column[r] = *value;
            }
        }
        chunk.len = r + 1;
        self.row.push(candidate as u32);
        self.arm.push(arm);
    }

    fn roll(&mut self, relative: DVec3, normal: DVec3) {
        let r = self.chunk.len - 1;
        Chunk::set(&mut self.chunk.roll, r, relative - normal * relative.dot(normal));
    }

    fn finish(&mut self, scene: &Scene, history: &mut [[f64; HISTORY]], released: f64) -> Sums {
        scene.law.apply(&mut self.chunk, scene.dt);
        let chunk = &*self.chunk;
        if scene.law.needs.history {
            for (r, &k) in self.row.iter().enumerate() {
                for (value, column) in history[k as usize].iter_mut().zip(&chunk.history) {
                    *value = column[r];
                }
            }
        }
        let n = chunk.len;
        Sums {
            stored: chunk.stored[..n].iter().sum(),
            lost: [
                chunk.lost_normal[..n].iter().sum(),
                chunk.lost_sliding[..n].iter().sum::<f64>() + released / scene.dt,
                chunk.lost_rolling[..n].iter().sum(),
            ],
            contacts: n,
            deepest: chunk.overlap[..n].iter().copied().fold(0.0, f64::max),
        }
    }

    /// Force on the first body and torques on both, of row `r`.
    #[inline]
    fn action(&self, r: usize, rotation: bool) -> Action {
        let chunk = &*self.chunk;
        let normal = Chunk::vector(&chunk.normal, r);
        let tangential = Chunk::vector(&chunk.tangential_force, r);
        let force = tangential - normal * chunk.normal_force[r];
        let lossy = tangential - normal * chunk.damping_force[r];
        if !rotation {
            return Action { force, lossy, torque: [DVec3::ZERO; 2] };
        }
        let turn = normal.cross(tangential);
        let rolling = Chunk::vector(&chunk.torque, r);
        Action { force, lossy, torque: [turn * self.arm[r][0] + rolling, turn * self.arm[r][1] - rolling] }
    }
}

/// Empties the history of a contact that has opened; returns the energy its spring still held [J].
#[inline]
fn release(scene: &Scene, history: &mut [f64; HISTORY]) -> f64 {
    if !scene.law.needs.history || history[3] == 0.0 {
        return 0.0;
    }
    let [x, y, z, stiffness] = *history;
    *history = [0.0; HISTORY];
    (x * x + y * y + z * z) / (2.0 * stiffness)
}
