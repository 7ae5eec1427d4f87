//! What parts with a limit have in common: springs that slide, and torques that may stop a motion but not turn it.

use super::chunk::{Chunk, Column};
use super::part::Slot;
use super::root::{least, most};
use glam::DVec3;

/// Keeps divisions finite where nothing touches; squares of forces below 1e-100 N are lost in it.
pub(super) const TINY: f64 = 1e-200;

/// Largest share of the effective mass (of the effective inertia in rolling) that a tangential dashpot may hold per time step:
/// c dt <= 0.05 m*, decision 0014.
///
/// A grain between 12 others is turned by all their dashpots, two thirds of each, and twice where neighbours turn alike:
/// a rate of 12 c R^2 (4/3) / (2/5 m R^2) = 20 c/m*, and predicted velocities are stable below a rate of 1/dt.
const ROOM: f64 = 0.05;

/// A dashpot [N.s/m] that the contacts of one grain can bear together, however many; vanishes as a limit for dt -> 0.
#[inline(always)]
pub(super) fn bearable(dashpot: f64, mass: f64, dt: f64) -> f64 {
    least(dashpot, ROOM * mass / dt)
}

/// History of a spring in the tangent plane: what it holds (3), one over the stiffness it holds it at, and how fast it was being
/// stretched (3).
pub(super) const SPRING: &[Slot] = &[Slot::Odd, Slot::Odd, Slot::Odd, Slot::Even, Slot::Odd, Slot::Odd, Slot::Odd];

/// The columns of such a history.
pub(super) type Held = [Column; 7];

/// Energy [J] in such a history.
pub(super) fn held(history: &[f64]) -> f64 {
    match *history {
        [x, y, z, compliance, ..] => 0.5 * (x * x + y * y + z * z) * compliance,
        _ => 0.0,
    }
}

/// Strength of a spring that slides, in force and length or in torque and angle.
#[derive(Clone, Copy)]
pub(super) struct Strength {
    pub stiffness: f64,
    pub dashpot: f64,
    /// Where it slides.
    pub cap: f64,
    /// Largest factor on what the spring holds when its stiffness changes: 1 lets it only shrink (the spring is a force, and a
    /// smaller disc of contact cannot hold what a larger one held), infinity makes the spring a displacement.
    pub growth: f64,
    /// Mean stiffness since the bodies met, over the present one, in the step of their first touch: with k as d^s, 1/(1+s).
    pub onset: f64,
}

/// A spring after a step.
pub(super) struct Slid {
    /// What the spring holds: force or torque on the first body.
    pub spring: DVec3,
    /// One over the stiffness it holds it at.
    pub compliance: f64,
    /// How fast it is being stretched.
    pub rate: DVec3,
    /// What acts on the first body: spring and dashpot, within the cap.
    pub total: DVec3,
    /// Energy the spring holds [J].
    pub stored: f64,
    /// Power lost [W].
    pub lost: f64,
}

/// A step of a spring that slides at a cap, with a dashpot beside it.
///
/// What it held, `old` at one over the stiffness `was`, is turned with the contact into the tangent plane at its old length,
/// follows the stiffness, is moved on, and cut at the cap. The dashpot has what the spring leaves of the cap: it
/// cannot fill the spring, and against a slide it has nothing. Work taken from the motion and not stored is lost.
///
/// It is stretched by the velocity of the half step, with which the bodies have come here: the mean of the velocity `before`, at the
/// end of the last step, and of `rate`, which is predicted with the same accelerations. So it is second order in time, as the
/// positions are. What is then the velocity at the end of this step is predicted too, but for what the spring itself does to it: a force
/// of one adds `mobility`. Where it stiffens on the way it has the mean of both stiffnesses. In the step of first touch it has `rate`, for
/// as long as the bodies have touched.
///
/// `dt` is the time of contact in this step and `rates` one over the time step. The time is that of the divisions and roots.
#[inline(always)]
pub(super) fn slide(
    (old, was): (DVec3, f64),
    normal: DVec3,
    [before, rate]: [DVec3; 2],
    s: Strength,
    mobility: f64,
    [dt, rates]: [f64; 2],
) -> Slid {
    let squared = old.length_squared();
    let flat = old - normal * old.dot(normal);
    let lengthen = (squared / most(flat.length_squared(), TINY)).sqrt();
    let stiffened = s.stiffness * was;
    let followed = least(stiffened, s.growth);
    let share = if stiffened > 0.0 { 0.5 + 0.5 * followed / stiffened } else { s.onset };
    let past = if was > 0.0 { 0.5 } else { 0.0 };
    let mean = (before - normal * before.dot(normal)) * past + rate * (1.0 - past);
    let turned = flat * lengthen;
    let trial = turned * followed - mean * (share * s.stiffness * dt);
    let spring = trial * least(s.cap / most(trial.length_squared(), TINY).sqrt(), 1.0);
    let complete = rate + (spring - turned) * mobility;
    let both = spring - complete * s.dashpot;
    let total = both * least(s.cap / most(both.length_squared(), TINY).sqrt(), 1.0);
    let compliance = inverse(s.stiffness);
    let stored = 0.5 * spring.length_squared() * compliance;
    let lost = -total.dot(rate) - (stored - 0.5 * squared * was) * rates;
    Slid { spring, compliance, rate: complete, total, stored, lost }
}

/// How long the bodies of row `i` have touched in a step [s]: all of it, or since their surfaces met, where the spring held nothing
/// before (`was`, one over its stiffness, is zero).
#[inline(always)]
pub(super) fn touched(chunk: &Chunk, i: usize, was: f64, dt: f64) -> f64 {
    let since = least(most(chunk.overlap[i], 0.0) / most(chunk.closing[i], TINY), dt);
    if was > 0.0 { dt } else { since }
}

/// One over a stiffness, and zero where there is none.
#[inline(always)]
pub(super) fn inverse(stiffness: f64) -> f64 {
    if stiffness > 0.0 { 1.0 / stiffness } else { 0.0 }
}

/// A step of a rolling spring in all rows; `strength` says how strong it is in a row.
#[inline(always)]
pub(super) fn roll(
    chunk: &mut Chunk,
    [x, y, z, c, u, v, w]: &mut Held,
    dt: f64,
    strength: impl Fn(&Chunk, usize) -> Strength,
) {
    let passing = chunk.passing(dt);
    for i in 0..chunk.rows() {
        let mut s = strength(chunk, i);
        s.dashpot = bearable(s.dashpot, inertia(chunk, i), dt);
        let (normal, roll) = (Chunk::vector(&chunk.normal, i), Chunk::vector(&chunk.roll, i));
        let rates = [DVec3::new(u[i], v[i], w[i]), roll];
        let times = [touched(chunk, i, c[i], passing), 1.0 / dt];
        let slid = slide((DVec3::new(x[i], y[i], z[i]), c[i]), normal, rates, s, 0.0, times);
        (x[i], y[i], z[i], c[i]) = (slid.spring.x, slid.spring.y, slid.spring.z, slid.compliance);
        (u[i], v[i], w[i]) = (slid.rate.x, slid.rate.y, slid.rate.z);
        let torque = Chunk::vector(&chunk.torque, i) + slid.total;
        Chunk::set(&mut chunk.torque, i, torque);
        chunk.stored[i] += slid.stored;
        chunk.lost_rolling[i] += slid.lost;
    }
}

/// A torque of the size `limit` against the rolling, in all rows, fading below the rolling speed `slow` [m/s].
#[inline(always)]
pub(super) fn resist(chunk: &mut Chunk, slow: f64, dt: f64, limit: impl Fn(&Chunk, usize) -> f64) {
    for i in 0..chunk.rows() {
        let limit = limit(chunk, i);
        let roll = Chunk::vector(&chunk.roll, i);
        let squared = roll.length_squared();
        let slow = most(slow / chunk.effective_radius[i], turning(chunk, i, limit, dt));
        let factor = limit / most(most(squared.sqrt(), slow), TINY);
        let torque = Chunk::vector(&chunk.torque, i) - roll * factor;
        Chunk::set(&mut chunk.torque, i, torque);
        chunk.lost_rolling[i] += factor * squared;
    }
}

/// Rolling or twisting [rad/s] below which a torque `limit` could turn it round within a step. The inertia against relative
/// turning of two spheres is not less than 2/5 m* R*^2; the factor 2 leaves room for the several contacts of a grain.
#[inline(always)]
pub(super) fn turning(chunk: &Chunk, i: usize, limit: f64, dt: f64) -> f64 {
    2.0 * limit * dt / inertia(chunk, i)
}

/// Least inertia against relative turning, 2/5 m* R*^2 [kg.m^2].
#[inline(always)]
pub(super) fn inertia(chunk: &Chunk, i: usize) -> f64 {
    0.4 * chunk.effective_mass[i] * (chunk.effective_radius[i] * chunk.effective_radius[i])
}
