//! C-F4 to C-F8: the sketches of rules, each as a small lattice before and after.
//!
//! Places are (h, k) from the middle of the lattice: x = h sqrt(3)/2, z = k/2. Grains are hexagons of 7 points, which are apart where
//! their centres are 3 spacings from each other. The lattice is empty but for what a sketch puts there.

use crate::bench::{between, within};
use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::closed_form;
use tsubu::clca::active::Active;
use tsubu::clca::bed::{Bed, GrainKind};
use tsubu::clca::order::{Past, Pull};
use tsubu::clca::passive::Passive;
use tsubu::lattice::direction::Direction::{self, N, S, SE, SW};
use tsubu::lattice::direction::Vector;
use tsubu::lattice::grid::{EMPTY, Grid};
use tsubu::lattice::shape::Shape;
use tsubu_frame::Claim;

/// Draws of each sketch.
const SEEDS: u64 = 400;
const MIDDLE: Vector = Vector { h: 20, k: 40 };

/// What a grain of a sketch is.
#[derive(Clone, Copy)]
enum Role {
    /// Goes by the rules; what it did in the step before.
    Free(Option<Direction>),
    /// Stays, or is driven by what it did in this step.
    Driven(Option<Direction>),
}
use Role::{Driven, Free};

/// A sketch: places and roles, and where each grain is one step later.
type Sketch<'a> = &'a [((i64, i64), Role)];

fn cell(bed: &Bed, (h, k): (i64, i64)) -> usize {
    let (h, k) = (MIDDLE.h + h, MIDDLE.k + k);
    bed.grid.index(h as usize, ((k - (h & 1)) / 2) as usize)
}

fn lay(sketch: Sketch, radius: usize, seed: u64) -> Bed {
    let kind =
        |free| GrainKind { group: 0, shape: Shape::hexagon(radius), stencil: 0, orientations: 1, mass: 1.0, free };
    let mut grid = Grid::new(2 * MIDDLE.h as usize, MIDDLE.k as usize);
    grid.fill(EMPTY);
    let mut bed = Bed::new(grid, vec![kind(true), kind(false)], seed, 1);
    for (id, &(place, role)) in sketch.iter().enumerate() {
        let cell = cell(&bed, place);
        bed.add(usize::from(matches!(role, Driven(_))), cell, id as u32);
        if let Free(Some(last)) = role {
            (bed.grains.last[id], bed.grains.past[id]) = (Some(last), Past::default().then(last));
        }
    }
    bed
}

/// What the first grains of a sketch do under the active rule.
fn active<const G: usize>(sketch: Sketch, pull: Pull, seed: u64) -> [Option<Direction>; G] {
    let mut bed = lay(sketch, 1, seed);
    Active::default().step(&mut bed, pull);
    std::array::from_fn(|grain| bed.grains.last[grain])
}

/// What the first grain does under the passive rule; the driven ones stand where they have gone.
fn passive(sketch: Sketch, seed: u64) -> Option<Direction> {
    let mut bed = lay(sketch, 1, seed);
    bed.grid.fill(EMPTY);
    let gone =
        |role| if let Driven(Some(direction)) = role { Direction::times(direction, 1) } else { Vector::default() };
    let driven: Vec<Vector> = sketch.iter().map(|&(_, role)| gone(role)).collect();
    Passive::new(&bed).step(&mut bed, None, &[], &driven);
    bed.grains.last[0]
}

/// Share of a set of draws in which something happens.
fn share(set: u64, happens: impl Fn(u64) -> bool) -> f64 {
    (1..=SEEDS).filter(|draw| happens(set * SEEDS + draw)).count() as f64 / SEEDS as f64
}

/// A share of draws that is to be all, none, or a part: then within three deviations of it.
fn drawn(name: &str, found: f64, expected: f64) -> Claim {
    let source = closed_form("Sakaguchi et al. 2001, figures 4 to 8; draws are fair");
    let deviation = (expected * (1.0 - expected) / SEEDS as f64).sqrt();
    within(format!("{name}: share of {SEEDS} draws"), found, expected, 3.0 * deviation, source)
}

/// C-F4: points that two hexagons share at a distance along a direction: rows of 2r + 1 - |j| points, each less the distance.
fn overlap(radius: usize, added: usize) -> u32 {
    let mut wrong = 0;
    for direction in Direction::ALL {
        for distance in 1..=2 * radius as i64 + 2 {
            let away = direction.times(distance);
            let sketch = [((0, 0), Free(None)), ((away.h, away.k), Free(None))];
            let bed = lay(&sketch, radius + added, 1);
            let found = Passive::new(&bed).overlaps(&bed, &[]).iter().map(|pair| i64::from(pair.points)).sum::<i64>();
            let r = radius as i64;
            let expected: i64 = (-r..=r).map(|j| (2 * r + 1 - j.abs() - distance).max(0)).sum();
            wrong += u32::from(found != expected);
        }
    }
    wrong
}

const FREE: Role = Free(None);
const FIXED: Role = Driven(None);
/// A grain on top of one that stays.
const BLOCKED: Sketch = &[((0, 6), FREE), ((0, 0), FIXED)];
const LEANING: Sketch = &[((0, 6), Free(Some(SE))), ((0, 0), FIXED)];
/// Two grains, each held from below and from outside, with room for one of them between.
const RIVALS: Sketch = &[((-2, 0), FREE), ((2, 0), FREE), ((-4, -4), FIXED), ((4, -4), FIXED)];
const ONE_GOES_ON: Sketch = &[((-2, 0), FREE), ((2, 0), Free(Some(SW))), ((-4, -4), FIXED), ((4, -4), FIXED)];
/// One grain above the room, one beside it that is held from below and from outside.
const ABOVE_AND_BESIDE: Sketch = &[((0, 4), FREE), ((-3, 1), FREE), ((-5, -3), FIXED)];
const BESIDE_GOES_ON: Sketch = &[((0, 4), FREE), ((-3, 1), Free(Some(SE))), ((-5, -3), FIXED)];
/// A driven grain has come down onto one.
const PUSHED: Sketch = &[((0, 0), FREE), ((0, 4), Driven(Some(S)))];
const PUSHED_ON: Sketch = &[((0, 0), Free(Some(SW))), ((0, 4), Driven(Some(S)))];
/// Driven grains have come from both upper sides, or from above and below.
const PUSHED_TWICE: Sketch = &[((0, 0), FREE), ((-2, 2), Driven(Some(SE))), ((2, 2), Driven(Some(SW)))];
const PRESSED: Sketch = &[((0, 0), FREE), ((0, 4), Driven(Some(S))), ((0, -4), Driven(Some(N)))];

/// The active rule: C-F5 to C-F7.
fn active_rule(pull: Pull, set: u64) -> Vec<Claim> {
    let alone: Sketch = &[((0, 0), FREE)];
    let one = |sketch, wanted: Direction| share(set, |seed| active::<1>(sketch, pull, seed) == [Some(wanted)]);
    let two = |sketch, wanted: [Option<Direction>; 2]| share(set, |seed| active(sketch, pull, seed) == wanted);
    vec![
        drawn("a grain with room below goes straight down", one(alone, S), 1.0),
        drawn("a grain on another goes to the right", one(BLOCKED, SE), 0.5),
        drawn("a grain on another goes to the left", one(BLOCKED, SW), 0.5),
        drawn("a grain on another goes on to the side it went to", one(LEANING, SE), 1.0),
        drawn("of two grains with room for one the left one goes", two(RIVALS, [Some(SE), None]), 0.5),
        drawn("of two grains with room for one the right one goes", two(RIVALS, [None, Some(SW)]), 0.5),
        drawn("inertia comes before gravity", two(ONE_GOES_ON, [None, Some(SW)]), 1.0),
        drawn("straight down comes before oblique", two(ABOVE_AND_BESIDE, [Some(S), None]), 1.0),
        drawn("who comes too late goes elsewhere", two(BESIDE_GOES_ON, [Some(SE), Some(SE)]), 1.0),
    ]
}

/// The passive rule: C-F8.
fn passive_rule(step: impl Fn(Sketch, u64) -> Option<Direction>, set: u64) -> Vec<Claim> {
    let goes = |sketch, wanted: Option<Direction>| share(set, |seed| step(sketch, seed) == wanted);
    vec![
        drawn("a pushed grain goes to the right", goes(PUSHED, Some(SE)), 1.0 / 3.0),
        drawn("a pushed grain goes straight on", goes(PUSHED, Some(S)), 1.0 / 3.0),
        drawn("a pushed grain goes on to the side it went to", goes(PUSHED_ON, Some(SW)), 1.0),
        drawn("pushed from two sides a grain takes the common way", goes(PUSHED_TWICE, Some(S)), 1.0),
        drawn("pressed from above and below a grain rests", goes(PRESSED, None), 1.0),
    ]
}

/// C-F4 to C-F8, exactly. The perturbation makes hexagons one point larger, lets gravity pull up, and gives nobody a push.
pub(crate) fn rules(perturbation: f64) -> Judged {
    ensemble::drawn("sketches", 0..=3, |set| {
        let spoilt = perturbation != 1.0;
        let source = closed_form("counted row by row");
        let counted = |added| {
            (1..=4).map(move |radius| {
                let points = 3 * radius * (radius + 1) + 1;
                let name = format!("overlap of hexagons of {points} points: distances with another count");
                between(name, f64::from(overlap(radius, added)), 0.0, 0.0, source)
            })
        };
        let nobody = |_: Sketch, _: u64| None;
        let mut claims: Vec<Claim> = counted(usize::from(spoilt)).collect();
        claims.extend(active_rule(if spoilt { Pull::UP } else { Pull::DOWN }, set));
        claims.extend(if spoilt { passive_rule(nobody, set) } else { passive_rule(passive, set) });
        claims.push(refused("hexagons a point larger", &counted(1).collect::<Vec<_>>(), 4));
        claims.push(refused("gravity that pulls up", &active_rule(Pull::UP, set), 8));
        let against = |sketch: Sketch, seed| passive(sketch, seed).map(Direction::opposite);
        claims.push(refused("grains that go against the push", &passive_rule(against, set), 4));
        Ok(claims)
    })
}
