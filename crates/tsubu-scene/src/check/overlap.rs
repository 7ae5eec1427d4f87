//! Pairs of grains that are nearer than they are wide, found in a time that grows with their number.

use crate::plan::{Periodic, Vector};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A grain with a given place.
pub(super) struct Grain<'a> {
    pub group: &'a str,
    pub index: usize,
    /// Its line, if it comes from a file.
    pub line: Option<u32>,
    pub diameter: f64,
    pub position: Vector,
    /// Frozen or driven: nothing it touches moves it.
    pub held: bool,
}

/// A cube of a grid. There is a grid for every power of two of the diameter, so that one boulder among sand does not put
/// all the sand into one cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Cell {
    level: i32,
    at: [i64; 3],
}

/// A grain, or its image on the other side of a periodic world.
struct Entry {
    cell: Cell,
    position: Vector,
    grain: usize,
    held: bool,
    image: bool,
}

/// The entries of a cell: free grains, then held ones, which do not mind each other.
#[derive(Clone, Copy)]
struct Span {
    begin: usize,
    held: usize,
    end: usize,
}

/// Calls `found` with the numbers of two grains and the distance of their centres, until it returns `false`. Pairs of
/// held grains are left out: rough beds are made of grains that overlap.
pub(super) fn pairs(grains: &[Grain<'_>], periodic: &Periodic, found: &mut dyn FnMut(usize, usize, f64) -> bool) {
    let entries = entries(grains, periodic);
    let cells = cells(&entries);
    let mut levels: Vec<i32> = entries.iter().map(|entry| entry.cell.level).collect();
    levels.sort_unstable();
    levels.dedup();
    for a in entries.iter().filter(|entry| !entry.image) {
        // The smaller of two looks for the larger; of two on one level the first for the second.
        for &level in levels.iter().filter(|level| **level >= a.cell.level) {
            let centre = cell(a.position, level);
            for step in 0..27 {
                let offset = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
                let at = [0, 1, 2].map(|axis| centre.at[axis].saturating_add(offset[axis]));
                let Some(span) = cells.get(&Cell { level, at }) else { continue };
                let near = &entries[span.begin..if a.held { span.held } else { span.end }];
                for b in near.iter().filter(|b| b.grain != a.grain && (level > a.cell.level || b.grain > a.grain)) {
                    let reach = 0.5 * (grains[a.grain].diameter + grains[b.grain].diameter);
                    let distance = (0..3).map(|k| (a.position[k] - b.position[k]).powi(2)).sum::<f64>().sqrt();
                    if distance < reach && !found(a.grain, b.grain, distance) {
                        return;
                    }
                }
            }
        }
    }
}

fn entries(grains: &[Grain<'_>], periodic: &Periodic) -> Vec<Entry> {
    let largest = grains.iter().map(|grain| grain.diameter).fold(0.0, f64::max);
    let mut entries: Vec<Entry> = grains
        .iter()
        .enumerate()
        .map(|(number, grain)| Entry {
            cell: cell(grain.position, level(grain.diameter)),
            position: grain.position,
            grain: number,
            held: grain.held,
            image: false,
        })
        .collect();
    for (axis, ends) in [periodic.x, periodic.y, periodic.z].into_iter().enumerate() {
        let Some([low, high]) = ends else { continue };
        let images: Vec<Entry> = entries
            .iter()
            .flat_map(|entry| {
                let x = entry.position[axis];
                let shifts = [(x < low + largest, high - low), (x > high - largest, low - high)];
                shifts.into_iter().filter(|(near, _)| *near).map(move |(_, shift)| {
                    let mut position = entry.position;
                    position[axis] += shift;
                    let cell = cell(position, entry.cell.level);
                    Entry { cell, position, grain: entry.grain, held: entry.held, image: true }
                })
            })
            .collect();
        entries.extend(images);
    }
    entries.sort_unstable_by_key(|entry| (entry.cell, entry.held, entry.grain, entry.image));
    entries
}

fn cells(entries: &[Entry]) -> HashMap<Cell, Span, BuildHasherDefault<Mix>> {
    let mut cells = HashMap::default();
    let mut begin = 0;
    for group in entries.chunk_by(|a, b| a.cell == b.cell) {
        let free = group.partition_point(|entry| !entry.held);
        cells.insert(group[0].cell, Span { begin, held: begin + free, end: begin + group.len() });
        begin += group.len();
    }
    cells
}

/// The power of two that is not below the diameter.
fn level(diameter: f64) -> i32 {
    diameter.log2().ceil() as i32
}

fn cell(position: Vector, level: i32) -> Cell {
    let size = 2.0_f64.powi(level);
    Cell { level, at: position.map(|x| (x / size).floor() as i64) }
}

/// Cells of a scene are no attack: a multiplication is hash enough, and ten times as quick as the usual one.
#[derive(Clone, Copy, Default)]
struct Mix(u64);

impl Hasher for Mix {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 29)
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let word = chunk.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
            self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x517c_c1b7_2722_0a95);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grain(diameter: f64, position: Vector, held: bool) -> Grain<'static> {
        Grain { group: "", index: 0, line: None, diameter, position, held }
    }

    fn all(grains: &[Grain<'_>], periodic: &Periodic) -> Vec<(usize, usize)> {
        let mut list = Vec::new();
        pairs(grains, periodic, &mut |a, b, _| {
            list.push((a.min(b), a.max(b)));
            true
        });
        list.sort_unstable();
        list
    }

    /// Numbers without a pattern, the same every time.
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    #[test]
    fn the_grid_finds_what_looking_at_every_pair_finds() {
        let mut seed = 7;
        let periodic = Periodic { x: Some([-1.0, 1.0]), y: None, z: Some([0.0, 1.5]) };
        let grains: Vec<Grain<'_>> = (0..800)
            .map(|i| {
                let mut random = || noise(&mut seed);
                let diameter = 0.04 * 10.0_f64.powf(random() * random());
                let position = [2.0 * random() - 1.0, random(), 1.5 * random()];
                grain(diameter, position, i % 3 == 0)
            })
            .collect();
        let apart = |x: f64, length: f64| x.abs().min(length - x.abs());
        let mut expected = Vec::new();
        for (i, a) in grains.iter().enumerate() {
            for (j, b) in grains.iter().enumerate().skip(i + 1) {
                let d = [0, 1, 2].map(|axis| a.position[axis] - b.position[axis]);
                let distance = apart(d[0], 2.0).hypot(d[1]).hypot(apart(d[2], 1.5));
                if distance < 0.5 * (a.diameter + b.diameter) && !(a.held && b.held) {
                    expected.push((i, j));
                }
            }
        }
        assert!(expected.len() > 100, "{}", expected.len());
        assert_eq!(all(&grains, &periodic), expected);
    }

    #[test]
    fn a_crowd_of_held_grains_is_no_work() {
        let crowd: Vec<Grain<'_>> = (0..100_000).map(|_| grain(1.0, [0.3; 3], true)).collect();
        assert_eq!(all(&crowd, &Periodic::default()), []);
    }

    #[test]
    fn odd_sizes_and_places_do_no_harm() {
        let sizes = [f64::MIN_POSITIVE, 1e-300, 1.0, 1e300];
        let grains: Vec<Grain<'_>> = sizes.iter().map(|size| grain(*size, [1e308, -1e308, 0.0], false)).collect();
        let mut found = all(&grains, &Periodic::default());
        found.dedup();
        assert_eq!(found.len(), 6, "all in one place");
    }
}
