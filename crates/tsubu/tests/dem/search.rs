//! The search finds every pair, once.

use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeMap;
use tsubu::neighbours::grid::PRIMARY_IMAGE;
use tsubu::neighbours::{NeighbourLists, Search};
use tsubu::partner::Hosts;
use tsubu::random::philox;
use tsubu::state::Grains;
use tsubu::wall::Wall;
use tsubu_scene::plan::{Rotation, Shape, Signal};

/// Grains in a box of sides 1, some of them near its faces; radii from `small` to `large`, most of them small.
fn strewn(count: usize, small: f64, large: f64, frozen: bool, seed: u64) -> Grains {
    let key = [seed as u32, (seed >> 32) as u32];
    let mut grains = Grains::default();
    for id in 0..count as u32 {
        let row = philox([id, 0, 0, 0], key).map(|word| f64::from(word) / (f64::from(u32::MAX) + 1.0));
        grains.position.push(DVec3::new(row[0], row[1], row[2]));
        grains.radius.push(small * (large / small).powf(row[3].powi(4)));
        grains.inverse_mass.push(if frozen && id % 3 == 0 { 0.0 } else { 1.0 });
        grains.id.push(id);
        for column in
            [&mut grains.velocity, &mut grains.acceleration, &mut grains.spin, &mut grains.angular_acceleration]
        {
            column.push(DVec3::ZERO);
        }
        grains.unwrap_offset.push(DVec3::ZERO);
        grains.mass.push(1.0);
        grains.inertia.push(1.0);
        grains.material.push(0);
        grains.group.push(0);
    }
    grains
}

/// How often the lists have each pair: ids, the lower first, and the periods that the second is away.
fn listed(lists: &NeighbourLists, grains: &Grains) -> BTreeMap<(u32, u32, [i32; 3]), usize> {
    let mut pairs = BTreeMap::new();
    for list in &lists.lists {
        for pair in &list.pairs {
            let local = pair.second as usize;
            let image = if local < list.own { PRIMARY_IMAGE } else { list.halo[local - list.own].image };
            let periods = [image % 3, image / 3 % 3, image / 9].map(|k| k as i32 - 1);
            let (i, j) = (grains.id[list.first + pair.first as usize], grains.id[list.grain_at[local] as usize]);
            let key = if i < j { (i, j, periods) } else { (j, i, periods.map(|k| -k)) };
            *pairs.entry(key).or_default() += 1;
        }
    }
    pairs
}

/// All pairs whose gap is below the skin and of which one can move, by looking at every image of every pair.
fn all(grains: &Grains, search: &Search) -> Vec<(u32, u32, [i32; 3])> {
    let mut pairs = Vec::new();
    let turns = |axis: usize| if search.periodic[axis].is_some() { -1..=1 } else { 0..=0 };
    for i in 0..grains.len() {
        for j in (0..grains.len()).filter(|&j| grains.id[i] < grains.id[j]) {
            if grains.inverse_mass[i] + grains.inverse_mass[j] == 0.0 {
                continue;
            }
            for (x, y, z) in turns(0).flat_map(|x| turns(1).flat_map(move |y| turns(2).map(move |z| (x, y, z)))) {
                let image = grains.position[j] + DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                let limit = grains.radius[i] + grains.radius[j] + search.skin;
                if grains.position[i].distance_squared(image) < limit * limit {
                    pairs.push((grains.id[i], grains.id[j], [x, y, z]));
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Grains that rest while a wall turns; whether their lists must be made again after some of its turns.
fn stale(shape: Shape, axis: DVec3, angle: f64) -> bool {
    let skin = 1e-3;
    let grains = strewn(300, 0.01, 0.02, false, 5);
    let mut plan = crate::wall::plan_wall(shape);
    plan.rotation =
        Some(Rotation { centre: [0.1, 0.2, 0.3], axis: axis.to_array(), signal: Signal::Steady { rate: angle } });
    let hosts = Hosts::default();
    let mut walls = vec![Wall::new("turned", &plan, 3, &hosts, DVec3::ZERO)];
    let search = Search { skin, ..Search::default() };
    let mut lists = NeighbourLists::new(search);
    lists.rebuild(&grains, &walls);
    walls[0].follow(1.0, &hosts);
    lists.stale(&grains, &walls)
}

/// A drum without ends that turns about its axis, or a floor about its normal, moves no surface. Rounding tilts both by 1e-16, and
/// as they have no end, that was taken for a way without end: lists were made at nearly every step, 3 to 12 times as slow.
#[test]
fn endless_walls_that_turn_into_themselves_keep_lists() {
    let axis = DVec3::new(0.3, 0.5, -0.8).normalize();
    let drum = Shape::Cylinder { point: [0.1, 0.2, 0.3], axis: axis.to_array(), radius: 2.0, length: None };
    let floor = Shape::Plane { point: [0.1, 0.2, 0.3], normal: axis.to_array() };
    for angle in [0.1, 1.0, 2.3, 40.0, 1234.5] {
        assert!(!stale(drum.clone(), axis, angle) && !stale(floor.clone(), axis, angle), "{angle}");
    }
    // What really tilts or moves out of the axis does so by its lever: about 1 m, to a skin of 1 mm.
    let across = axis.any_orthonormal_vector();
    assert!(stale(drum.clone(), across, 0.01) && stale(floor.clone(), across, 0.01));
    assert!(!stale(drum.clone(), across, 1e-4) && !stale(floor, across, 1e-4));
    let Shape::Cylinder { point, axis: along, .. } = drum else { unreachable!() };
    let beside =
        Shape::Cylinder { point: [point[0] + 0.1, point[1], point[2]], axis: along, radius: 2.0, length: None };
    assert!(stale(beside, axis, 1.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Any number of grains and sizes, any axes periodic, from cells as large as the box to small ones.
    #[test]
    fn every_near_pair_is_listed_once(
        seed in any::<u64>(), count in 2_usize..700, small in 0.01..0.12_f64, ratio in 1.0..12.0_f64, skin in 0.0..0.04_f64,
        periodic in any::<[bool; 3]>(), frozen in any::<bool>(),
    ) {
        // A grain may be near its own image, which is no pair, but not near an image two periods away.
        let large = (small * ratio).min(0.45);
        let search = Search { skin, periodic: periodic.map(|p| p.then_some([0.0, 1.0])), ..Search::default() };
        let mut grains = strewn(count, small, large, frozen, seed);
        let mut lists = NeighbourLists::new(search);
        lists.sort_grains(&mut grains, &[]);
        lists.rebuild(&grains, &[]);
        let listed = listed(&lists, &grains);
        prop_assert!(listed.values().all(|&times| times == 1), "a pair is listed twice");
        let all = all(&grains, &search);
        prop_assert!(listed.keys().eq(&all), "{} pairs listed, {} near", listed.len(), all.len());
        // A rank that has one block finds what it found among all.
        for (block, among) in lists.lists.iter().enumerate() {
            let mut part = NeighbourLists::new(search);
            part.part = Some(block..block + 1);
            part.rebuild(&grains, &[]);
            let alone = &part.lists[block];
            prop_assert_eq!((&alone.pairs, &alone.halo), (&among.pairs, &among.halo));
        }
    }
}
