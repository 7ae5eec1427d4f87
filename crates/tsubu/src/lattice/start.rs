//! Where the balls of the automaton begin.
//!
//! `settled` and `rows` fill the box row by row from the floor, as long as balls fit in; the columns of the last, incomplete row
//! are drawn at random. `at` takes the nearest cell, and the lattice direction nearest to the velocity.

use super::damper::{Ball, BoxPlace};
use super::direction::{Direction, Vector as LatticeVector};
use super::fixed::Scale;
use super::grid::COLUMN_SPACING;
use super::remarks::Remarks;
use super::shape::Shape;
use crate::random::{Purpose, words};
use std::collections::BTreeMap;
use tsubu_scene::plan::{Plan, Start, Vector};

/// The interior of the box.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Cell spacing [m]; where a ball has one cell, its diameter.
    pub spacing: f64,
    /// Centre of the floor [m].
    pub floor_centre: Vector,
    /// Interior columns, numbered from 1, and rows, numbered from 0.
    pub place: BoxPlace,
    /// The cells of a ball.
    pub shape: Shape,
}

impl Geometry {
    /// Centre of a cell [m].
    pub fn centre(&self, column: usize, row: i64) -> Vector {
        let x = (column as f64 - 0.5 * (self.place.columns + 1) as f64) * COLUMN_SPACING;
        let z = row as f64 + 0.5 + if column % 2 == 1 { 0.5 } else { 0.0 };
        let [x0, y0, z0] = self.floor_centre;
        [x0 + self.spacing * x, y0, z0 + self.spacing * z]
    }

    /// The cell nearest to a point in which the middle of a ball can be, and its distance [m].
    fn nearest(&self, point: Vector) -> (usize, usize, f64) {
        let mut best = (1, 0, f64::INFINITY);
        for column in 1..=self.place.columns {
            for row in (0..self.place.rows).filter(|row| self.place.holds(&self.shape, column, *row as i64)) {
                let [x, _, z] = self.centre(column, row as i64);
                let distance = (x - point[0]).hypot(z - point[2]);
                if distance < best.2 {
                    best = (column, row, distance);
                }
            }
        }
        best
    }
}

/// Cells taken so far, with the ball that took them.
type Taken = BTreeMap<[i64; 2], usize>;

pub(super) fn place(plan: &Plan, geometry: &Geometry, scale: &Scale, remarks: &mut Remarks) -> Vec<Ball> {
    let BoxPlace { columns, rows, .. } = geometry.place;
    let count = plan.grains();
    let holds = columns * rows / geometry.shape.points().len();
    let refuse = |holds: usize, remarks: &mut Remarks| {
        let text = format!(
            "{count} balls do not fit into {columns} columns of {rows} cells; the automaton's box holds {holds}"
        );
        remarks.refuse("particles", text);
    };
    if count > holds {
        refuse(holds, remarks);
        return Vec::new();
    }
    let mut taken = Taken::new();
    let mut balls = Vec::with_capacity(count);
    let mut refused = 0;
    for (name, group) in &plan.particles {
        let key = format!("particles.{name}.start");
        match &group.start {
            Start::At { position, velocity, spin } => {
                place_at(&key, position, velocity, geometry, scale, &mut taken, &mut balls, remarks);
                if spin.iter().any(|s| *s != [0.0; 3]) {
                    remarks.approximate(format!("{key}.at.spin"), "the automaton knows no spin; taken as zero");
                }
            }
            Start::Settled { time: _ } => {
                fill(group.count, plan.seed, geometry, &mut taken, &mut balls);
                remarks.approximate(
                    format!("{key}.settled"),
                    "filled row by row from the floor, the columns of the last row at random, instead of dropped",
                );
            }
            Start::Random { .. } | Start::Stream { .. } | Start::File { .. } => {
                refused += group.count;
                remarks.refuse(key, "the automaton fills its box by `settled`, `rows` or `at`; use `method = \"dem\"`");
            }
            Start::Rows { region: Some(_), .. } => {
                refused += group.count;
                remarks.refuse(format!("{key}.rows.region"), "the automaton fills its box from the floor up");
            }
            Start::Rows { spacing: _, jitter: _, speed, region: None } => {
                let first = balls.len();
                fill(group.count, plan.seed, geometry, &mut taken, &mut balls);
                remarks.approximate(
                    format!("{key}.rows"),
                    "cells have one spacing: filled row by row from the floor, without gaps and jitter",
                );
                for (i, ball) in balls.iter_mut().enumerate().skip(first) {
                    let word = words(plan.seed, Purpose::Placement, i as u32, 1)[0];
                    ball.direction = if *speed > 0.0 {
                        Direction::from_index(((u64::from(word) * 6) >> 32) as usize)
                    } else {
                        Direction::S
                    };
                    ball.speed = scale.cut(scale.speed_units(*speed));
                }
            }
        }
    }
    if balls.len() + refused < count {
        refuse(balls.len(), remarks);
    }
    balls
}

#[expect(clippy::too_many_arguments, reason = "one call; a struct for it would only rename the arguments")]
fn place_at(
    key: &str,
    position: &[Vector],
    velocity: &[Vector],
    geometry: &Geometry,
    scale: &Scale,
    taken: &mut Taken,
    balls: &mut Vec<Ball>,
    remarks: &mut Remarks,
) {
    let mut farthest = 0.0_f64;
    let mut turned = 0.0_f64;
    for (index, point) in position.iter().enumerate() {
        let (column, row, distance) = geometry.nearest(*point);
        farthest = farthest.max(distance);
        let cells = geometry.shape.seen_from(column, row as i64);
        let others: Vec<usize> = cells.filter_map(|cell| taken.insert(cell, balls.len())).collect();
        if let Some(other) = others.first() {
            remarks.refuse(
                format!("{key}.at.position[{index}]"),
                format!(
                    "its nearest cell (column {column}, row {}) is that of ball {other}; a cell holds one ball",
                    row + 1
                ),
            );
        }
        let [x, _, z] = velocity.get(index).copied().unwrap_or_default();
        let units = |speed: f64| scale.speed_units(speed);
        let wanted = LatticeVector { h: units(x / COLUMN_SPACING), k: units(2.0 * z) };
        let direction = Direction::nearest(wanted);
        let speed = scale.cut(direction.along4(wanted) / 4);
        let [ux, _, uz] = direction.unit();
        let real = speed as f64 * scale.speed;
        turned = turned.max((x - real * ux).hypot(z - real * uz));
        balls.push(Ball { column, row, direction, speed });
    }
    if farthest > 1e-6 * geometry.spacing {
        remarks.approximate(
            format!("{key}.at.position"),
            format!("taken to the nearest cell, at most {:.2} mm away", 1e3 * farthest),
        );
    }
    if turned > 4.0 * scale.speed * scale.quantum as f64 {
        remarks.approximate(
            format!("{key}.at.velocity"),
            format!("projected on the nearest lattice direction, at most {turned:.3} m/s off"),
        );
    }
}

/// Fills the lowest free cells row by row; the columns of a row that is not filled up are drawn at random.
fn fill(count: usize, seed: u64, geometry: &Geometry, taken: &mut Taken, balls: &mut Vec<Ball>) {
    let Geometry { place, shape, .. } = geometry;
    let mut left = count;
    for row in 0..place.rows {
        let mut free = Vec::new();
        for column in 1..=place.columns {
            let mut cells = shape.seen_from(column, row as i64);
            if place.holds(shape, column, row as i64) && cells.all(|cell| !taken.contains_key(&cell)) {
                taken.extend(shape.seen_from(column, row as i64).map(|cell| (cell, balls.len() + free.len())));
                free.push(column);
            }
        }
        if left < free.len() {
            for cell in free.iter().flat_map(|column| shape.seen_from(*column, row as i64)) {
                taken.remove(&cell);
            }
            // Fisher-Yates from the end; the drawn columns are put in order so that ids run from left to right.
            for last in (1..free.len()).rev() {
                let word = words(seed, Purpose::Placement, last as u32, 0)[0];
                free.swap(last, ((u64::from(word) * (last as u64 + 1)) >> 32) as usize);
            }
            free.truncate(left);
            free.sort_unstable();
        }
        left -= free.len();
        for column in free {
            taken.extend(shape.seen_from(column, row as i64).map(|cell| (cell, balls.len())));
            balls.push(Ball { column, row, direction: Direction::S, speed: 0 });
        }
    }
}
