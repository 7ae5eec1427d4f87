//! Removal that no grain of a lattice can come to, so that nothing would ever leave there.

use super::remarks::Remarks;
use super::site::ground::Sites;
use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_scene::plan::Removal;

/// A lattice as a way for grains.
pub(crate) struct Ways<'a> {
    /// How its sites lie.
    pub sites: Sites,
    /// Columns and rows.
    pub size: [usize; 2],
    /// Whether the last column is next to the first, and the last row to the first.
    pub periodic: [bool; 2],
    /// Whether grains can be on a column and row: no wall is there that stays.
    pub open: &'a dyn Fn(usize, usize) -> bool,
    /// Where that is [m].
    pub point: &'a dyn Fn(usize, usize) -> DVec3,
    /// Width of a site [m].
    pub spacing: f64,
}

/// Says which regions hold no site, or none to which a way leads from the columns and rows where grains begin.
pub(crate) fn remark(
    removal: &BTreeMap<String, Removal>,
    ways: &Ways<'_>,
    begin: impl Iterator<Item = (usize, usize)>,
    remarks: &mut Remarks,
) {
    if removal.is_empty() {
        return;
    }
    let reached = flood(ways, begin);
    let [columns, rows] = ways.size;
    for (name, region) in removal {
        let held = |c: &usize, r: &usize| (ways.open)(*c, *r) && region.takes((ways.point)(*c, *r).to_array());
        let sites = || (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))).filter(|(c, r)| held(c, r));
        let text = if sites().next().is_none() {
            let wide = 1e3 * ways.spacing;
            format!(
                "no grain leaves there: it holds no site of the lattice, whose sites are {wide:.3} mm wide; move it or make it larger"
            )
        } else if !sites().any(|(c, r)| reached[c * rows + r]) {
            "no grain leaves there: walls stand between it and the grains, or leave a gap narrower than a site; widen the gap, or move it".to_owned()
        } else {
            continue;
        };
        remarks.doubt(format!("removal.{name}"), text);
    }
}

/// Columns and rows that can be reached, column by column.
fn flood(ways: &Ways<'_>, begin: impl Iterator<Item = (usize, usize)>) -> Vec<bool> {
    let [columns, rows] = ways.size;
    let mut reached = vec![false; columns * rows];
    let mut waiting: Vec<(usize, usize)> = begin.collect();
    for (c, r) in &waiting {
        reached[c * rows + r] = true;
    }
    let beside = |at: usize, by: usize, axis: usize| {
        let (size, to) = (ways.size[axis], at + by);
        if ways.periodic[axis] { Some((to + size - 1) % size) } else { to.checked_sub(1).filter(|to| *to < size) }
    };
    while let Some((column, row)) = waiting.pop() {
        for step in (0..9).filter(|step| ways.sites.meet(column, row, step % 3, step / 3)) {
            let (Some(c), Some(r)) = (beside(column, step % 3, 0), beside(row, step / 3, 1)) else { continue };
            if !reached[c * rows + r] && (ways.open)(c, r) {
                reached[c * rows + r] = true;
                waiting.push((c, r));
            }
        }
    }
    reached
}
