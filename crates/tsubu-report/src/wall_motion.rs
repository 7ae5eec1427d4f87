//! How the walls of pictures move.

use tsubu_frame::{FileError, Snapshot, read_frame};

use crate::balls::{Balls, Look};

/// A way shorter than this share of the walls' size is round-off.
const ROUND_OFF: f64 = 1e-9;

/// How fast the walls move at this snapshot, in the picture plane: from the one before it to the one after it.
pub(crate) fn motion(found: &[Snapshot], i: usize, balls: &Balls) -> Result<Option<[f64; 2]>, FileError> {
    let (before, after) = (i.saturating_sub(1), (i + 1).min(found.len() - 1));
    if before == after || balls.outlines.is_empty() {
        return Ok(None);
    }
    let at = |k: usize| Ok(Balls::of(&read_frame(&found[k].path)?, &Look::default()));
    Ok(velocity(&at(before)?, &at(after)?, found[after].time - found[before].time))
}

/// Mean velocity of the walls between two pictures, in the picture plane; `None` where there are none, or others.
pub(crate) fn velocity(before: &Balls, after: &Balls, dt: f64) -> Option<[f64; 2]> {
    let way = way(before, after).filter(|_| dt > 0.0)?;
    Some([way[0] / dt, way[1] / dt])
}

/// Where the box is, for boxes that move without a host: how far the walls have gone in the direction in which they go farthest.
/// Empty where they stay.
pub(crate) fn box_motion(found: &[Snapshot]) -> Result<Vec<(f64, f64)>, FileError> {
    const MOST: usize = 300;
    const MOST_GRAINS: usize = 20_000;
    let mut first: Option<Balls> = None;
    let mut ways = Vec::new();
    for snapshot in &found[found.len().saturating_sub(MOST)..] {
        let balls = Balls::of(&read_frame(&snapshot.path)?, &Look::default());
        let Some(way) = way(first.as_ref().unwrap_or(&balls), &balls) else { return Ok(Vec::new()) };
        if balls.centres.len() > MOST_GRAINS {
            return Ok(Vec::new());
        }
        ways.push((snapshot.time, way));
        first.get_or_insert(balls);
    }
    let reach = |k: usize| {
        let values = || ways.iter().map(|w| w.1[k]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    if reach(0).max(reach(1)) <= 0.0 {
        return Ok(Vec::new());
    }
    let along = usize::from(reach(1) > reach(0));
    Ok(ways.iter().map(|(t, w)| (*t, w[along])).collect())
}

/// How far the walls have gone from one picture to another, mean of their corners [m]; `None` where there are none, or others.
fn way(before: &Balls, after: &Balls) -> Option<[f64; 3]> {
    let pairs = || before.outlines.iter().zip(&after.outlines);
    let same = before.endless == after.endless && pairs().all(|(a, b)| a.len() == b.len());
    if before.outlines.is_empty() || !same {
        return None;
    }
    let (mut way, mut corners, mut size) = ([0.0; 3], 0.0, 0.0f64);
    for ((a, b), endless) in pairs().zip(&after.endless) {
        let step = step(a, b, *endless);
        let count = a.len() as f64;
        way = std::array::from_fn(|k| way[k] + count * step[k]);
        corners += count;
        size = size.max(length(less(b[0], b[b.len() / 2])));
    }
    let way = way.map(|w| w / corners);
    Some(if length(way) > ROUND_OFF * size { way } else { [0.0; 3] })
}

/// How far one outline has gone. An endless plane is drawn as far as there is something else to see: only its way across tells
/// that it moves.
fn step(before: &[[f64; 3]], after: &[[f64; 3]], endless: bool) -> [f64; 3] {
    let middle = |corners: &[[f64; 3]]| -> [f64; 3] {
        std::array::from_fn(|k| corners.iter().map(|c| c[k]).sum::<f64>() / corners.len() as f64)
    };
    let mut step = less(middle(after), middle(before));
    // A line has one direction, a square two that are square to one another.
    for sides in after.windows(2).take(if endless { 2 } else { 0 }) {
        let along = less(sides[1], sides[0]);
        let share = dot(step, along) / dot(along, along);
        step = std::array::from_fn(|k| step[k] - share * along[k]);
    }
    step
}

fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walls(outlines: &[&[[f64; 3]]], endless: bool) -> Balls {
        let corners = outlines.iter().map(|o| o.to_vec()).collect();
        Balls { outlines: corners, endless: vec![endless; outlines.len()], ..Balls::default() }
    }

    const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [0.0, 0.0, 2.0]];

    #[test]
    fn a_plane_that_is_drawn_elsewhere_stays_where_it_is() {
        let elsewhere = SQUARE.map(|[x, y, z]| [1.5 * x - 0.3, y, 1.5 * z + 0.1]);
        assert_eq!(velocity(&walls(&[&SQUARE], true), &walls(&[&elsewhere], true), 0.5), Some([0.0, 0.0]));
        let (line, longer) = ([[0.0, 1.0, 0.0], [4.0, 4.0, 0.0]], [[-4.0, -2.0, 0.0], [8.0, 7.0, 0.0]]);
        assert_eq!(velocity(&walls(&[&line], true), &walls(&[&longer], true), 0.5), Some([0.0, 0.0]));
    }

    #[test]
    fn a_plane_that_rises_is_seen_to_rise() {
        let higher = SQUARE.map(|[x, y, z]| [1.5 * x - 0.3, y + 0.25, 1.5 * z + 0.1]);
        let [x, y] = velocity(&walls(&[&SQUARE], true), &walls(&[&higher], true), 0.5).expect("the same walls");
        assert!(x.abs() < 1e-15 && (y - 0.5).abs() < 1e-15, "{x} {y}");
    }

    #[test]
    fn a_box_goes_as_a_whole() {
        let shifted = SQUARE.map(|[x, y, z]| [x + 0.1, y + 0.2, z]);
        let [x, y] = velocity(&walls(&[&SQUARE], false), &walls(&[&shifted], false), 0.1).expect("the same walls");
        assert!((x - 1.0).abs() < 1e-12 && (y - 2.0).abs() < 1e-12, "{x} {y}");
    }

    #[test]
    fn walls_that_have_gone_say_nothing() {
        assert_eq!(velocity(&walls(&[&SQUARE, &SQUARE], false), &walls(&[&SQUARE], false), 0.5), None);
        assert_eq!(velocity(&walls(&[], false), &walls(&[], false), 0.5), None);
    }
}
