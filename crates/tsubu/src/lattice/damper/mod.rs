//! The damper automaton (Komatsuzaki, Sato, Iwata, Morishita 2003): balls on a triangular lattice in a box that moves up
//! and down.
//!
//! A ball sits in a cell, or in the hexagon of cells round one, and has a direction, a speed v and a stored distance S along the
//! direction. One step is
//!
//! 1. [`gravity`]: v += -g dt (direction . z); a ball that went up and ran out of speed turns down;
//! 2. [`resting`], [`wall_collision`], [`ball_collision`]: from the old state, at most one collision a ball;
//! 3. [`box_motion`]: the box moves by whole cells and ejects what is in the way;
//! 4. [`movement`]: S += v; at S >= dx the ball moves one cell if what it takes is free; of several that want it one is drawn.
//!
//! The authors name balls of several cells as a remedy for a packing and for directions that the lattice locks. The rules are the same for
//! them: all that a ball's shape says is which cells a move takes and which it leaves, and so who is ahead, touches it, or stands on it.
//!
//! What makes it fast: a check of a ball against the one ahead is repeated only when it can have changed. Two balls in
//! vertical free flight keep their relative speed, so a pair that does not approach will not until one of them collides,
//! turns or moves (`stale`); oblique flyers, and whoever is next to the floor or the ceiling, are looked at every step. Balls
//! that rest on the floor, straight or on each other, are one body (`rest`).
//!
//! Books are kept in whole numbers (`books`): twice the energy over m u^2, and momentum over m u in the basis of
//! [`Vector`].

pub mod ball_collision;
mod ball_set;
mod books;
pub mod box_motion;
pub mod gravity;
pub mod movement;
pub mod resting;
pub mod wall_collision;

use super::direction::{Direction, Vector};
use super::fixed::{Restitution, Scale};
use super::grid::{Grid, WALL};
use super::shape::{Shape, Stencil};
use crate::about::About;
use ball_set::BallSet;
pub(crate) use books::Beyond;
use tsubu_scene::plan::{Collision, ObliqueGravity};

pub(crate) const ABOUT: About = About {
    key: "method.lattice",
    formula: "v += -g dt (direction . z);  S += v dt;  at S >= one cell the ball moves one cell if that is free; of several that want it one is drawn",
    symbols: "v speed along one of six directions [m/s], S stored distance [m], g gravity [m/s^2], dt time step [s]",
    limits: "Equal balls of one cell or a hexagon of cells in boxes that move up and down; no friction, no spin. Whole numbers: the books close without \
rounding. `lattice.mode` says how near it is to what was published.",
    reference: "Komatsuzaki, Sato, Iwata and Morishita 2003",
};

/// The named choices of the rules.
#[expect(clippy::struct_excessive_bools, reason = "each is a rule that the scene switches on or off by its name")]
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// Gravity along the oblique directions.
    pub oblique_gravity: ObliqueGravity,
    /// Who changes in a ball-ball collision.
    pub collision: Collision,
    /// Whether rebounds scatter to the neighbours of straight back.
    pub rebound_scatter: bool,
    /// Whether collisions and blocked moves forget the stored distance.
    pub reset_when_blocked: bool,
    /// Whether a move keeps what the stored distance has over a cell.
    pub keep_remainder: bool,
    /// Whether resting contacts pass their impulse to the box.
    pub resting_impulses: bool,
    /// Approach speed up to which a contact is a resting one [speed units].
    pub resting_speed: i64,
    /// Restitution between balls.
    pub ball: Restitution,
    /// Restitution between ball and wall.
    pub wall: Restitution,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// What happened in one step, in whole numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Impulse of the box on the balls [m u].
    pub wall: Vector,
    /// Impulse that rules made out of nothing [m u].
    pub rule: Vector,
    /// Energy lost by restitution [m u^2 / 2].
    pub collision: i64,
    /// Energy lost by rules [m u^2 / 2].
    pub rules: i64,
}

/// Where the box and its grid are.
#[derive(Clone, Copy, Debug)]
pub struct BoxPlace {
    /// Interior columns.
    pub columns: usize,
    /// Interior rows.
    pub rows: usize,
    /// Grid rows above and below the box at level 0.
    pub head: usize,
    /// Whole cells that the box stands above its drawn place.
    pub level: i64,
}

impl BoxPlace {
    /// Grid row of the lowest interior cells.
    #[inline]
    pub fn floor(&self) -> usize {
        (self.head as i64 + 1 + self.level) as usize
    }

    /// Whether a ball of a shape with its middle there is inside: columns count from 1, rows from 0.
    pub fn holds(&self, shape: &Shape, column: usize, row: i64) -> bool {
        shape
            .seen_from(column, row)
            .all(|[column, row]| (1..=self.columns as i64).contains(&column) && (0..self.rows as i64).contains(&row))
    }
}

/// The balls that rest on the floor or on each other: one body with the speed of the box. Each has the floor or another of them below it.
#[derive(Clone, Debug)]
pub struct Rest {
    /// How many they are.
    pub count: i64,
    /// Speed up [speed units].
    pub speed: i64,
    /// Distance risen and not yet turned into cells [distance units]; zero when rules forget distances.
    pub risen: i64,
}

/// The state of the automaton and what it needs to go on.
#[derive(Clone, Debug)]
pub struct Damper {
    /// Units.
    pub scale: Scale,
    /// Rules.
    pub rules: Rules,
    /// The box.
    pub place: BoxPlace,
    pub(crate) grid: Grid,
    shape: Shape,
    stencil: Stencil,
    /// Cell of every ball, or of its middle.
    pub(crate) cell: Vec<usize>,
    pub(crate) direction: Vec<Direction>,
    /// Speed along the direction; 0 for balls at rest, whose speed is the box's.
    pub(crate) speed: Vec<i64>,
    /// Distance stored along the direction; for balls at rest upwards and without [`Rest::risen`].
    pub(crate) stored: Vec<i64>,
    pub(crate) resting: Vec<bool>,
    pub(crate) rest: Rest,
    pub(crate) step: u64,
    /// What happened in the last step.
    pub tally: Tally,
    /// Looks at every ball every step: slow, to check that nothing is missed.
    pub look_everywhere: bool,
    // From here on scratch that follows from the above.
    odd: Vec<usize>,
    pull: Vec<i64>,
    pull_of: [i64; 6],
    oblique_count: [i64; 6],
    oblique: BallSet,
    stale: BallSet,
    /// At least all vertical flyers next to the floor, the ceiling or a ball at rest.
    near: BallSet,
    hit: BallSet,
    pairs: Vec<ball_collision::Pair>,
    movers: Vec<usize>,
    cluster: Vec<usize>,
    claims: Vec<u8>,
    /// This step's word for rebounds, and the step it was drawn for, counted from 1.
    lot: (u64, u64),
    /// So many collide in this step that all balls will be looked at again.
    crowded: bool,
}

/// A ball as it is put into the box: column (1 is the leftmost) and row (0 is the lowest) of its middle, direction and speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ball {
    /// Interior column, from 1.
    pub column: usize,
    /// Interior row, from 0.
    pub row: usize,
    /// Direction.
    pub direction: Direction,
    /// Speed [speed units].
    pub speed: i64,
}

impl Damper {
    /// The automaton with these balls, all of one shape, in a box at its level.
    pub fn new(scale: Scale, rules: Rules, place: BoxPlace, shape: Shape, balls: &[Ball]) -> Self {
        let grid = Grid::new(place.columns + 2, place.rows + 2 + 2 * place.head);
        let n = balls.len();
        let oblique_pull = match rules.oblique_gravity {
            ObliqueGravity::Projected => scale.gravity / 2,
            ObliqueGravity::Unit => scale.gravity,
        };
        let pull_of =
            Direction::ALL.map(|d| if d.is_vertical() { -scale.gravity * d.k() / 2 } else { -oblique_pull * d.k() });
        let cell: Vec<usize> = balls.iter().map(|b| grid.index(b.column, place.floor() + b.row)).collect();
        let mut damper = Self {
            scale,
            rules,
            place,
            stencil: Stencil::new(&shape, &grid),
            shape,
            direction: balls.iter().map(|ball| ball.direction).collect(),
            speed: balls.iter().map(|ball| ball.speed).collect(),
            stored: vec![0; n],
            resting: vec![false; n],
            rest: Rest { count: 0, speed: 0, risen: 0 },
            step: 0,
            tally: Tally::default(),
            look_everywhere: false,
            odd: vec![0; n],
            pull: vec![0; n],
            pull_of,
            oblique_count: [0; 6],
            oblique: BallSet::new(n),
            stale: BallSet::new(n),
            near: BallSet::new(n),
            hit: BallSet::new(n),
            pairs: Vec::with_capacity(6 * n),
            movers: Vec::with_capacity(n),
            cluster: Vec::with_capacity(n),
            claims: vec![0; n],
            lot: (0, 0),
            crowded: false,
            grid,
            cell,
        };
        damper.rebuild();
        damper
    }

    /// Number of balls.
    pub fn balls(&self) -> usize {
        self.cell.len()
    }

    /// The cells of a ball.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Number of balls that rest on the floor or on each other.
    pub fn at_rest(&self) -> usize {
        self.rest.count as usize
    }

    /// One step with the box moving upwards at `wall` [speed units] and standing at `level` cells at the end.
    pub fn advance(&mut self, wall: i64, level: i64) -> Result<(), box_motion::OutOfRoom> {
        self.tally = Tally::default();
        self.pull_down();
        self.carry_rest(wall);
        self.collide(wall);
        while self.place.level != level {
            self.shift(level > self.place.level, wall)?;
        }
        self.travel();
        self.step += 1;
        Ok(())
    }

    /// The first ball that is not alone in its cells of the box, or rests on nothing.
    pub fn fault(&self) -> Option<String> {
        let alone = |i: usize| self.cells(i).all(|cell| self.grid.at(cell) == i as i32);
        let well = |i: usize| self.fits(self.cell[i]) && alone(i) && (!self.resting[i] || self.stands(i));
        (0..self.balls())
            .find(|i| !well(*i))
            .map(|i| format!("ball {i} is not alone in its cells, or rests on nothing"))
    }

    /// Whether a ball with its middle in a cell is inside the box.
    pub(crate) fn fits(&self, cell: usize) -> bool {
        let (column, row) = self.grid.column_and_row(cell);
        self.place.holds(&self.shape, column, row as i64 - self.place.floor() as i64)
    }

    /// The cells of a ball.
    fn cells(&self, i: usize) -> impl Iterator<Item = usize> {
        self.stencil.points[self.odd[i]].iter().map(move |&offset| self.cell[i].wrapping_add_signed(offset))
    }

    /// The cells that a move of a ball takes.
    #[inline]
    fn ahead(&self, i: usize, direction: Direction) -> impl Iterator<Item = usize> {
        let ahead = &self.stencil.ahead[self.odd[i]][direction as usize];
        ahead.iter().map(move |&offset| self.cell[i].wrapping_add_signed(offset))
    }

    /// One of these cells.
    fn goal(&self, i: usize, direction: Direction, k: usize) -> usize {
        self.cell[i].wrapping_add_signed(self.stencil.ahead[self.odd[i]][direction as usize][k])
    }

    /// The balls in these cells; one that has several of them comes as often.
    #[inline]
    fn balls_ahead(&self, i: usize, direction: Direction) -> impl Iterator<Item = usize> {
        self.ahead(i, direction).filter_map(|cell| usize::try_from(self.grid.at(cell)).ok())
    }

    /// Whether a ball touches a wall there.
    #[inline]
    fn meets_wall(&self, i: usize, direction: Direction) -> bool {
        self.ahead(i, direction).any(|cell| self.grid.at(cell) == WALL)
    }

    /// Whether the floor or a ball at rest is below a ball.
    fn stands(&self, i: usize) -> bool {
        self.meets_wall(i, Direction::S) || self.balls_ahead(i, Direction::S).any(|below| self.resting[below])
    }

    /// Sets direction and speed of a ball that does not rest.
    #[inline]
    fn point(&mut self, i: usize, direction: Direction, speed: i64) {
        self.unpoint(i);
        self.direction[i] = direction;
        self.speed[i] = speed;
        self.pull[i] = self.pull_of[direction as usize];
        self.near.insert(i);
        if !direction.is_vertical() {
            self.oblique.insert(i);
            self.oblique_count[direction as usize] += 1;
        }
    }

    /// Takes a ball out of the count of oblique flyers.
    #[inline]
    fn unpoint(&mut self, i: usize) {
        if self.oblique.contains(i) {
            self.oblique.remove(i);
            self.oblique_count[self.direction[i] as usize] -= 1;
        }
    }

    /// Gives a ball a direction and a speed where a rule meant the velocity `meant`; the difference is the rules' doing.
    /// The stored distance is forgotten, or carried over as far as it points the new way.
    fn redirect(&mut self, i: usize, meant: Vector, direction: Direction, speed: i64) {
        let got = direction.times(speed);
        self.tally.rule.h += got.h - meant.h;
        self.tally.rule.k += got.k - meant.k;
        self.tally.rules += (meant.square4() - got.square4()) / 4 + self.scale.gravity / 2 * (meant.k - got.k);
        let old = self.direction[i];
        let stored = self.stored[i];
        let kept = if self.rules.reset_when_blocked { 0 } else { stored * old.twice_cosine(direction) / 2 };
        self.tally.rules += self.scale.gravity * (stored * old.k() - kept * direction.k());
        self.stored[i] = kept;
        self.point(i, direction, speed);
        self.disturb(i);
    }

    /// A ball changed its velocity or place: it and whoever looks at it must be looked at again.
    fn disturb(&mut self, i: usize) {
        if self.crowded {
            return;
        }
        self.stale.insert(i);
        for direction in Direction::ALL {
            for &offset in &self.stencil.ahead[self.odd[i]][direction as usize] {
                let other = self.grid.at(self.cell[i].wrapping_add_signed(offset));
                if other >= 0 {
                    self.stale.insert(other as usize);
                }
            }
        }
    }

    /// Recomputes everything that follows from cells, directions, speeds, stored distances, rest flags and the box.
    pub(crate) fn rebuild(&mut self) {
        let n = self.balls();
        self.rest.count = 0;
        self.oblique = BallSet::new(n);
        self.oblique_count = [0; 6];
        for i in 0..n {
            self.odd[i] = self.grid.column_and_row(self.cell[i]).0 % 2;
            self.point(i, self.direction[i], self.speed[i]);
            if self.resting[i] {
                self.pull[i] = 0;
                self.rest.count += 1;
            }
        }
        self.paint();
    }

    /// Paints the box and the balls anew, and has all looked at again.
    fn paint(&mut self) {
        self.grid.paint_box(self.place.columns, self.place.floor(), self.place.rows);
        for i in 0..self.cell.len() {
            self.put(i, i as i32);
        }
        self.stale.fill(self.cell.len());
        self.near.fill(self.cell.len());
    }

    /// Puts something into all cells of a ball.
    fn put(&mut self, i: usize, content: i32) {
        for &offset in &self.stencil.points[self.odd[i]] {
            self.grid.set(self.cell[i].wrapping_add_signed(offset), content);
        }
    }
}
