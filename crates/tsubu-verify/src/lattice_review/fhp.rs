//! the lattice gas FHP in its three forms.

use super::super::bench::{near, within};
use super::super::control::{refused, refused_number};
use super::super::ensemble;
use crate::case::Judged;
use crate::origin::closed_form;
use std::f64::consts::{PI, TAU};
use tsubu::lattice::direction::Direction;
use tsubu::lattice::gas::collide::{REST, Rules, SLOTS, collide};
use tsubu::lattice::gas::planes::{Gas, momentum};
use tsubu::lattice::grid::COLUMN_SPACING;
use tsubu_frame::{Claim, Source};

pub(super) const FRISCH: Source = closed_form("Frisch, d'Humieres, Hasslacher, Lallemand, Pomeau, Rivet 1987");
pub(super) const ALL: [(Rules, &str); 3] = [(Rules::One, "FHP-I"), (Rules::Two, "FHP-II"), (Rules::Three, "FHP-III")];

/// Kinematic viscosity at mean occupation d, in spacings squared a step, without correlations between particles.
pub(super) fn formula(rules: Rules, d: f64) -> f64 {
    let hole = 1.0 - d;
    match rules {
        Rules::One => 1.0 / (12.0 * d * hole.powi(3)) - 0.125,
        Rules::Two => 1.0 / (28.0 * d * hole.powi(3) * (1.0 - 4.0 * d / 7.0)) - 0.125,
        Rules::Three => 1.0 / (28.0 * d * hole * (1.0 - 8.0 * d * hole / 7.0)) - 0.125,
    }
}

/// The same from the collisions themselves: how fast they undo a small shear stress c_x c_z in a gas without correlations.
fn from_collisions(rules: Rules, d: f64) -> f64 {
    let stress = |slot: usize| {
        if slot == REST {
            0
        } else {
            let way = Direction::from_index(slot);
            way.h() * way.k()
        }
    };
    let slots = if rules == Rules::One { REST } else { SLOTS };
    let mut rate = 0.0;
    for state in 0_usize..1 << slots {
        let there = |slot: usize| state >> slot & 1 == 1;
        let likely: f64 = (0..slots).map(|slot| if there(slot) { d } else { 1.0 - d }).product();
        let rise = |slot: usize| if there(slot) { 1.0 / d } else { -1.0 / (1.0 - d) };
        let more: f64 = (0..slots).map(|slot| stress(slot) as f64 * rise(slot)).sum();
        let before: [u64; SLOTS] = std::array::from_fn(|slot| u64::from(there(slot)));
        for turn in [0, 1] {
            let after = collide(rules, before, turn);
            let gain: i64 = (0..slots).map(|slot| stress(slot) * (after[slot] as i64 - before[slot] as i64)).sum();
            rate += 0.5 * likely * more * gain as f64;
        }
    }
    // Four directions have stress of size one.
    1.0 / (4.0 * -rate / 4.0) - 0.125
}

/// Slope of the straight line through points.
pub(crate) fn slope(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let cross: f64 = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    cross / x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>()
}

/// The viscosity that the collisions themselves give, against the published closed form.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(crate) fn collisions(perturbation: f64) -> Judged {
    let (mut claims, mut gates) = (Vec::new(), Vec::new());
    for (rules, name) in ALL {
        for d in [0.1, 0.3, 0.5] {
            let value = from_collisions(rules, d * perturbation);
            let other = formula(if rules == Rules::Two { Rules::Three } else { Rules::Two }, d);
            claims.push(near(
                format!("{name}: viscosity of its collisions, d = {d}"),
                value,
                formula(rules, d),
                1e-9,
                FRISCH,
            ));
            gates.push(near(name, value, other, 1e-9, FRISCH));
        }
    }
    claims.push(refused_number("viscosity of another form", &gates, 9));
    Ok(claims)
}

/// Speed of sound from the beats of a standing wave.
fn sound_speed(rules: Rules, seed: u64) -> f64 {
    const COLUMNS: usize = 256;
    const ROWS: usize = 4096;
    let phase = |c: usize| TAU * c as f64 / COLUMNS as f64;
    let mut gas = Gas::new(rules, COLUMNS, ROWS, [true, true], seed);
    gas.scatter(|column, _, _| 0.3 * (1.0 + 0.1 * phase(column).cos()));
    // Zeros one after the other are half a period apart; the damping, 2 % of the frequency, shifts them by 1e-4.
    let (mut last, mut zeros) = (1.0, Vec::new());
    while zeros.len() < 5 {
        gas.step();
        let now: f64 = (0..COLUMNS).map(|c| gas.counts(c).iter().sum::<u64>() as f64 * phase(c).cos()).sum();
        if now * last < 0.0 {
            zeros.push(gas.steps() as f64 - now / (now - last));
        }
        last = now;
    }
    let half = (zeros[4] - zeros[0]) / 4.0;
    PI / half / (TAU / (COLUMNS as f64 * COLUMN_SPACING))
}

/// Speed of sound of the three forms.
pub(crate) fn sound(perturbation: f64) -> Judged {
    ensemble::drawn("sound", 1..=3, |seed| {
        let speeds = ALL.map(|(rules, name)| (rules, name, sound_speed(rules, seed) * perturbation));
        let expected = |rules: Rules| if rules == Rules::One { 0.5_f64.sqrt() } else { (3.0_f64 / 7.0).sqrt() };
        let mut claims: Vec<Claim> = speeds
            .iter()
            .map(|(rules, name, value)| near(format!("{name}: speed of sound"), *value, expected(*rules), 0.02, FRISCH))
            .collect();
        let other = |rules: Rules| expected(if rules == Rules::One { Rules::Two } else { Rules::One });
        let gates = speeds.map(|(rules, name, value)| near(name, value, other(rules), 0.02, FRISCH));
        claims.push(refused_number("speed of sound with and without particles at rest exchanged", &gates, 3));
        Ok(claims)
    })
}

/// A channel between upright walls, driven along it.
struct Channel {
    gas: Gas,
    mass: u64,
}

const WIDTH: usize = 20;
const ROWS: usize = 65_536;
const LOOK: u64 = 10;
const DENSITY: f64 = 0.5;
/// How often a site that can turns a particle.
const ODDS: f64 = 46.0 / 65_536.0;

impl Channel {
    fn new(rough: bool, seed: u64) -> Self {
        let mut gas = Gas::new(Rules::Three, WIDTH + 2, ROWS, [true, true], seed);
        for row in 0..ROWS {
            gas.wall(0, row, (!rough).then_some(0));
            gas.wall(WIDTH + 1, row, (!rough).then_some(0));
        }
        // Near where it will be, which saves the way there; and more, for two slots of every wall site will be filled.
        let form = profile_of(1.0);
        let filling = DENSITY * (1.0 + 4.0 / (7 * WIDTH) as f64);
        let down = |slot: usize| if slot == REST { 0.0 } else { -0.5 * Direction::from_index(slot).k() as f64 };
        gas.scatter(|column, _, slot| filling * (1.0 + 7.0 / 3.0 * down(slot) * form[column - 1]));
        gas.push([0.0, -ODDS]);
        let mass = gas.mass();
        Self { gas, mass }
    }

    /// Mean speed down in every column of the channel over `steps` steps [spacings a step].
    fn profile(&mut self, steps: u64) -> Vec<f64> {
        let mut speeds = vec![0.0; WIDTH];
        let end = self.gas.steps() + steps;
        while self.gas.steps() < end {
            self.gas.steps_on((LOOK - self.gas.steps() % LOOK).min(end - self.gas.steps()));
            if !self.gas.steps().is_multiple_of(LOOK) {
                continue;
            }
            for (column, speed) in speeds.iter_mut().enumerate() {
                let counts = self.gas.counts(column + 1);
                *speed -= 0.5 * momentum(&counts).k as f64 / counts.iter().sum::<u64>() as f64 / (steps / LOOK) as f64;
            }
        }
        speeds
    }
}

/// The closed form in a gas of FHP-III. A site turns a particle if N is full and S is empty, so often that a gas at rest gains
/// a = 2 odds (1 - d) / 7, and one that moves at u gains a (1 - b u) with b = 7 / (3 - 3 d). The viscous answer
/// u = (1 - cosh(q x) / cosh(q h)) / b, q^2 = a b / nu, is the parabola for a weak force.
fn profile_of(push: f64) -> Vec<f64> {
    let (a, b) = (push * ODDS * (1.0 - DENSITY) * 2.0 / 7.0, 7.0 / (3.0 - 3.0 * DENSITY));
    let q = (a * b / formula(Rules::Three, DENSITY)).sqrt();
    let half = 0.5 * WIDTH as f64 * COLUMN_SPACING;
    let place = |column: usize| (column as f64 + 0.5) * COLUMN_SPACING - half;
    (0..WIDTH).map(|c| (1.0 - (q * place(c)).cosh() / (q * half).cosh()) / b).collect()
}

/// A channel whose walls send back flows as the closed form says, and comes to rest half a column inside the walls; with
/// mirrors for walls the gas falls freely.
pub(crate) fn channel(perturbation: f64) -> Judged {
    ensemble::drawn("channels", 1..=5, |seed| channel_of(seed, perturbation))
}

/// The same of one draw.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
fn channel_of(seed: u64, perturbation: f64) -> Judged {
    let mut channel = Channel::new(true, seed);
    channel.profile(1000);
    let speeds = channel.profile(1600);
    let form = profile_of(perturbation);
    let middle = |speeds: &[f64]| speeds[WIDTH / 2 - 3..WIDTH / 2 + 3].iter().sum::<f64>();
    let source = closed_form("Navier and Stokes, with the viscosity of Frisch et al. 1987");
    let gates = |speeds: &[f64]| {
        let farthest = speeds.iter().zip(&form).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / form[WIDTH / 2];
        let shape = |speeds: &[f64]| 1.0 - (speeds[WIDTH / 4] + speeds[WIDTH - 1 - WIDTH / 4]) * 3.0 / middle(speeds);
        vec![
            near(
                "FHP-III: speed in the middle of a channel over the closed form",
                middle(speeds) / middle(&form),
                1.0,
                0.03,
                source,
            ),
            near(
                "FHP-III: fall of speed from there to half way to the walls, over it",
                shape(speeds),
                shape(&form),
                0.08,
                source,
            ),
            within("FHP-III: largest distance from the closed form over its height", farthest, 0.0, 0.04, source),
        ]
    };
    let mut claims = gates(&speeds);
    let mut free = Channel::new(false, seed);
    free.profile(1000);
    let slipping = free.profile(100);
    claims.push(refused("a channel with mirrors for walls", &gates(&slipping), 3));
    let flat = |speeds: &[f64]| {
        let spread = speeds.iter().fold(0.0, |most: f64, v| most.max((v / speeds[WIDTH / 2] - 1.0).abs()));
        within("FHP-III: smooth walls leave the flow flat", spread, 0.0, 0.05, closed_form("no drag at a mirror"))
    };
    claims.push(flat(&slipping));
    claims.push(refused("walls that send back for mirrors", &[flat(&speeds)], 1));
    let lost = |channel: &Channel| {
        let more = channel.gas.mass() as f64 - channel.mass as f64;
        let name = "FHP-III: particles more in the channel than at the begin";
        within(name, more, 0.0, 0.0, closed_form("conservation"))
    };
    claims.push(lost(&channel));
    // A site of the gas is swept empty on the way.
    free.gas.set_site(WIDTH / 2, 7, 0);
    free.gas.set_site(WIDTH / 2, 8, 0);
    free.profile(LOOK);
    claims.push(refused("two sites that are swept empty", &[lost(&free)], 1));
    Ok(claims)
}
