//! How long a neighbour list is good, for grains that move together.
//!
//! What makes a list miss a pair is that two grains have come nearer to *each other* by more than the skin; how far they
//! have gone together does not matter. So every block has a drift, a displacement that its grains have roughly in common,
//! and only what a grain deviates from it counts:
//!
//! |u_i - u_j| <= |u_i - D_b| + |D_b - D_c| + |u_j - D_c| <= skin
//!
//! holds for any drifts D; good ones make it hold for longer. Asked of all blocks that lie near each other; blocks farther
//! apart than a margin must only have kept that distance. In a chute 26 degrees steep the lists of this kind are made five
//! times less often than those that count from where each grain was.

use super::block::{BLOCK, BlockList, blocks_at_once};
use super::grid::PeriodicBounds;
use crate::state::Grains;
use crate::threads::piece;
use crate::wall::{Pose, Wall};
use glam::DVec3;
use rayon::prelude::*;

/// Distance, in skins, from which on blocks are not compared one by one.
const MARGIN: f64 = 8.0;

/// What a block has done since the last search.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Displacement that its grains have roughly in common [m].
    pub offset: DVec3,
    /// Mean velocity at the last step [m/s].
    pub velocity: DVec3,
    /// Farthest that a grain deviates from the drift [m]; not a number when a coordinate is not.
    pub farthest: f64,
}

/// Which blocks lie near each other and near walls, and what each has done.
#[derive(Clone, Debug, Default)]
pub struct Drifts {
    /// One a block.
    pub of: Vec<Drift>,
    near: Vec<[u32; 2]>,
    near_walls: Vec<bool>,
    /// For every wall, how far the farthest grain was from its centre of rotation at the search, at most [m].
    extents: Vec<f64>,
}

/// A box around the grains of a block.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    centre: DVec3,
    half: DVec3,
}

impl Drifts {
    /// Begins anew after a search; mean velocities are kept as the first guess of the drift.
    pub fn reset(
        &mut self,
        lists: &[BlockList],
        reference: &[DVec3],
        grains: &Grains,
        walls: &[Wall],
        skin: f64,
        ends: &PeriodicBounds,
    ) {
        let margin = MARGIN * skin;
        let blocks = lists.par_iter().with_min_len(blocks_at_once(grains.len()));
        let bounds: Vec<Bounds> = blocks.clone().map(|list| bounds(list, reference, &grains.radius)).collect();
        self.find_near(&bounds, margin, ends);
        let mut found = Vec::new();
        self.near_walls.clear();
        self.near_walls.extend(bounds.iter().map(|b| {
            walls.iter().any(|wall| {
                found.clear();
                wall.near(b.centre, b.half.length() + margin, &mut found);
                !found.is_empty()
            })
        }));
        self.extents.clear();
        self.extents.extend(walls.iter().map(|wall| {
            let origin = wall.pose.origin();
            bounds.iter().map(|b| b.centre.distance(origin) + b.half.length()).fold(0.0, f64::max)
        }));
        let drift = |list: &BlockList| {
            let velocity = grains.velocity[list.first..list.first + list.own].iter().sum::<DVec3>() / list.own as f64;
            Drift { offset: DVec3::ZERO, velocity, farthest: 0.0 }
        };
        blocks.map(drift).collect_into_vec(&mut self.of);
    }

    /// Which blocks are nearer to each other than `margin` [m]: swept along the longest axis that has no periodic ends.
    fn find_near(&mut self, bounds: &[Bounds], margin: f64, ends: &PeriodicBounds) {
        let low = |b: u32, axis: usize| bounds[b as usize].centre[axis] - bounds[b as usize].half[axis];
        let high = |b: u32, axis: usize| bounds[b as usize].centre[axis] + bounds[b as usize].half[axis];
        let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
        let length = |axis: usize| {
            let ends = order.iter().map(|b| (low(*b, axis), high(*b, axis)));
            let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
            high - low
        };
        let open = (0..3).filter(|axis| ends[*axis].is_none());
        let axis = open.max_by(|a, b| length(*a).total_cmp(&length(*b)));
        if let Some(axis) = axis {
            order.sort_by(|a, b| low(*a, axis).total_cmp(&low(*b, axis)));
        }
        let near = |(k, &b): (usize, &u32)| {
            let reach = axis.map_or(f64::INFINITY, |axis| high(b, axis) + margin);
            let others = order[k + 1..].iter().take_while(move |c| axis.is_none_or(|axis| low(**c, axis) <= reach));
            let near = others.filter(move |c| gap(&bounds[b as usize], &bounds[**c as usize], ends) <= margin);
            near.map(move |&c| [b, c])
        };
        self.near.clear();
        let blocks = order.par_iter().enumerate().with_min_len(blocks_at_once(order.len() * BLOCK));
        self.near.par_extend(blocks.flat_map_iter(near));
    }

    /// How far any wall has moved since the search, at most, seen from the grains [m]. An endless wall that turns into itself has
    /// not, but rounding tilts it: what that comes to depends on how far away the grains are.
    pub fn walls_moved(&self, walls: &[Wall], reference: &[Pose]) -> f64 {
        let gone = self.of.iter().map(|d| d.offset.length() + d.farthest).fold(0.0, f64::max);
        let moved = walls.iter().zip(reference).zip(&self.extents).map(|((wall, then), extent)| {
            wall.travel_bound(then, extent + gone + wall.pose.origin().distance(then.origin()))
        });
        moved.fold(0.0, f64::max)
    }

    /// Whether a pair may have come nearer than the list allows; `moved`: how far any wall has [m].
    pub fn stale(&self, skin: f64, moved: f64) -> bool {
        let far = 0.5 * MARGIN * skin;
        let mean = self.of.iter().map(|d| d.offset).sum::<DVec3>() / self.of.len().max(1) as f64;
        // Written so that what is not a number counts as stale.
        let within = self.of.iter().zip(&self.near_walls).all(|(d, near_wall)| {
            let away = d.offset.length() + d.farthest + moved;
            2.0 * d.farthest <= skin
                && (d.offset - mean).length() + d.farthest <= far
                && away <= if *near_wall { skin } else { far }
        });
        let allowed = |&[b, c]: &[u32; 2]| {
            let (b, c) = (&self.of[b as usize], &self.of[c as usize]);
            b.farthest + c.farthest + (b.offset - c.offset).length() <= skin
        };
        let between = self.near.par_chunks(piece(self.near.len())).all(|pairs| pairs.iter().all(allowed));
        !(within && between)
    }
}

fn bounds(list: &BlockList, reference: &[DVec3], radius: &[f64]) -> Bounds {
    let own = list.first..list.first + list.own;
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (p, r) in reference[own.clone()].iter().zip(&radius[own]) {
        low = low.min(*p - *r);
        high = high.max(*p + *r);
    }
    Bounds { centre: 0.5 * (low + high), half: 0.5 * (high - low) }
}

/// Smallest distance between two boxes, across periodic ends too [m].
fn gap(a: &Bounds, b: &Bounds, ends: &PeriodicBounds) -> f64 {
    let mut squared = 0.0;
    for (axis, end) in ends.iter().enumerate() {
        let mut apart = (a.centre[axis] - b.centre[axis]).abs();
        if let Some([low, high]) = end {
            apart = apart.min(high - low - apart);
        }
        squared += (apart - a.half[axis] - b.half[axis]).max(0.0).powi(2);
    }
    squared.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sweep finds the pairs that all pairs would; with too short a reach it would not.
    #[test]
    fn near_blocks_are_those_of_all_pairs() {
        for periodic in [[false; 3], [true, false, false], [true, true, true]] {
            let ends: PeriodicBounds = periodic.map(|wraps| wraps.then_some([0.0, 10.0]));
            // Numbers that look random: multiples of the golden ratio.
            let number = |k: usize| 10.0 * (f64::from(k as u32) * 0.618_033_988_749_895).fract();
            let bounds: Vec<Bounds> = (0..300)
                .map(|k| Bounds {
                    centre: DVec3::new(number(6 * k), number(6 * k + 1), 2.0 * number(6 * k + 2)),
                    half: 0.05 * DVec3::new(number(6 * k + 3), number(6 * k + 4), number(6 * k + 5)),
                })
                .collect();
            let (mut drifts, margin) = (Drifts::default(), 0.3);
            drifts.find_near(&bounds, margin, &ends);
            let mut found: Vec<[u32; 2]> = drifts.near.iter().map(|[b, c]| [*b.min(c), *b.max(c)]).collect();
            found.sort_unstable();
            let all = (0..300u32).flat_map(|b| (b + 1..300).map(move |c| [b, c]));
            let near = all.filter(|[b, c]| gap(&bounds[*b as usize], &bounds[*c as usize], &ends) <= margin);
            let near: Vec<[u32; 2]> = near.collect();
            assert!(near.len() > 100);
            assert_eq!(found, near);
        }
    }
}
