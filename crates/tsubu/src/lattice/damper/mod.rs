//! The damper automaton (Komatsuzaki, Sato, Iwata, Morishita 2003): balls on a triangular lattice in a box that moves up
//! and down.
//!
//! A ball sits in a cell and has a direction, a speed v and a stored distance S along the direction. One step is
//!
//! 1. [`gravity`]: v += -g dt (direction . z); a ball that went up and ran out of speed turns down;
//! 2. [`resting`], [`wall_collision`], [`ball_collision`]: from the old state, at most one collision a ball;
//! 3. [`box_motion`]: the box moves by whole cells and ejects what is in the way;
//! 4. [`movement`]: S += v; at S >= dx the ball moves one cell if that is free, else by lottery.
//!
//! What makes it fast: a check of a ball against the one ahead is repeated only when it can have changed. Two balls in
//! vertical free flight keep their relative speed, so a pair that does not approach will not until one of them collides,
//! turns or moves (`stale`); oblique flyers, and whoever is next to the floor or the ceiling, are looked at every step. Balls
//! that rest on the floor, straight or in columns, are one body (`rest`).
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
use super::grid::Grid;
use crate::about::About;
use ball_set::BallSet;
pub(crate) use books::Beyond;
use tsubu_scene::plan::{Collision, ObliqueGravity};

pub(crate) const ABOUT: About = About {
    key: "method.lattice",
    formula: "v += -g dt (direction . z);  S += v dt;  at S >= one cell the ball moves one cell if it is free, else by lottery",
    symbols: "v speed along one of six directions [m/s], S stored distance [m], g gravity [m/s^2], dt time step [s]",
    limits: "Equal balls in boxes that move up and down; no friction, no spin. Whole numbers: the books close without \
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
}

/// The balls that rest on the floor or on each other: in every column a stack from the floor up, one body with the speed
/// of the box.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Height of the stack of every grid column [balls].
    pub height: Vec<usize>,
    /// Balls in all stacks.
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
    ahead: Vec<usize>,
    pull: Vec<i64>,
    pull_of: [i64; 6],
    oblique_count: [i64; 6],
    oblique: BallSet,
    stale: BallSet,
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

/// A ball as it is put into the box: column (1 is the leftmost), row (0 is the lowest), direction and speed.
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
    /// The automaton with these balls, one a cell, in a box at its level.
    pub fn new(scale: Scale, rules: Rules, place: BoxPlace, balls: &[Ball]) -> Self {
        let mut grid = Grid::new(place.columns + 2, place.rows + 2 + 2 * place.head);
        grid.paint_box(place.columns, place.floor(), place.rows);
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
            direction: vec![Direction::S; n],
            speed: vec![0; n],
            stored: vec![0; n],
            resting: vec![false; n],
            rest: Rest { height: vec![0; grid.columns()], count: 0, speed: 0, risen: 0 },
            step: 0,
            tally: Tally::default(),
            look_everywhere: false,
            odd: balls.iter().map(|b| b.column % 2).collect(),
            ahead: vec![0; n],
            pull: vec![0; n],
            pull_of,
            oblique_count: [0; 6],
            oblique: BallSet::new(n),
            stale: BallSet::new(n),
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
        for (i, ball) in balls.iter().enumerate() {
            damper.grid.set(damper.cell[i], i as i32);
            damper.point(i, ball.direction, ball.speed);
        }
        damper.stale.fill(n);
        damper
    }

    /// Number of balls.
    pub fn balls(&self) -> usize {
        self.cell.len()
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

    /// The first ball that is not alone in a cell of the box, or rests on nothing.
    pub fn fault(&self) -> Option<String> {
        let astray = |i: &usize| self.grid.at(self.cell[*i]) != *i as i32 || !self.has_seat(*i);
        (0..self.balls())
            .find(astray)
            .map(|i| format!("the cell of ball {i} belongs to {}", self.grid.at(self.cell[i])))
    }

    /// Whether a ball is inside the box, and in the stack of its column if it rests.
    fn has_seat(&self, i: usize) -> bool {
        let (column, row) = self.grid.column_and_row(self.cell[i]);
        if !(1..=self.place.columns).contains(&column) || row < self.place.floor() {
            return false;
        }
        row - self.place.floor() < if self.resting[i] { self.rest.height[column] } else { self.place.rows }
    }

    /// Sets direction and speed of a ball that does not rest.
    #[inline]
    fn point(&mut self, i: usize, direction: Direction, speed: i64) {
        self.unpoint(i);
        self.direction[i] = direction;
        self.speed[i] = speed;
        self.pull[i] = self.pull_of[direction as usize];
        self.ahead[i] = self.grid.neighbour(self.cell[i], self.odd[i], direction);
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
            let other = self.grid.at(self.grid.neighbour(self.cell[i], self.odd[i], direction));
            if other >= 0 {
                self.stale.insert(other as usize);
            }
        }
    }

    /// Recomputes everything that follows from cells, directions, speeds, stored distances, rest flags and the box.
    pub(crate) fn rebuild(&mut self) {
        let n = self.balls();
        self.grid.paint_box(self.place.columns, self.place.floor(), self.place.rows);
        self.rest.height.fill(0);
        self.rest.count = 0;
        self.oblique = BallSet::new(n);
        self.oblique_count = [0; 6];
        for i in 0..n {
            self.grid.set(self.cell[i], i as i32);
            let column = self.grid.column_and_row(self.cell[i]).0;
            self.odd[i] = column % 2;
            self.point(i, self.direction[i], self.speed[i]);
            if self.resting[i] {
                self.pull[i] = 0;
                self.rest.height[column] += 1;
                self.rest.count += 1;
            }
        }
        self.stale.fill(n);
    }
}
