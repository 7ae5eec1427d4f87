//! Sine dwell: the frequency of the drive follows the resonance, by the phase of the answer.

use super::{Host, dot};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{self, Keep, Signal};

/// A damping ratio below which the loop is as slow as at it.
const LEAST_RATIO: f64 = 0.002;

/// A loop that locks the phase, of the first order: once a period of the drive the lag of the answer over that period is taken, by the
/// parts of its velocity in phase with the drive (C) and a quarter behind (S), lag = atan2(S, C), and the frequency is multiplied
/// with 1 - gain (lag - wanted).
///
/// The answer follows the frequency within 1 / (2 pi zeta) periods, and its lag changes by 1 / zeta for a relative change of frequency: with gain = pi zeta^2 / 2 the
/// loop is critically damped, and comes to rest within a few times 1 / (pi zeta) periods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dwell {
    wanted: f64,
    gain: f64,
    keep: Keep,
    /// Share of the period that has gone by [-], and the sums over it.
    gone: f64,
    sums: [f64; 2],
    /// Of the last whole period: lag [rad], amplitude of the stretch [m].
    found: [f64; 2],
}

/// What a dwell has found in the last whole period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwelling {
    /// Frequency of the drive [Hz].
    pub frequency: f64,
    /// How far the stretch lags behind the drive [rad]; not a number in the first period.
    pub lag: f64,
    /// Amplitude of the stretch [m].
    pub amplitude: f64,
}

impl Dwell {
    /// A loop for a structure of this damping ratio whose drive begins with `phase` [rad].
    pub fn new(plan: &plan::Dwell, ratio: f64, phase: f64) -> Self {
        Self {
            wanted: plan.lag,
            gain: plan.gain.unwrap_or_else(|| 0.5 * PI * ratio.max(LEAST_RATIO).powi(2)),
            keep: plan.keep,
            gone: (phase / TAU).rem_euclid(1.0),
            sums: [0.0; 2],
            found: [f64::NAN; 2],
        }
    }

    /// Takes a step of `turns` periods that ended at phase `angle` [rad] with a `rate` [m/s] of the stretch; gives the factor on the
    /// frequency where a period has ended. A step over the end counts for both periods.
    fn take(&mut self, turns: f64, angle: f64, rate: f64, frequency: f64) -> Option<f64> {
        let (sin, cos) = angle.sin_cos();
        let before = turns.min(1.0 - self.gone);
        let add = |sums: &mut [f64; 2], share: f64| {
            sums[0] += share * rate * cos;
            sums[1] += share * rate * sin;
        };
        add(&mut self.sums, before);
        self.gone += turns;
        if self.gone < 1.0 {
            return None;
        }
        let [c, s] = self.sums;
        self.sums = [0.0; 2];
        self.gone -= 1.0;
        add(&mut self.sums, turns - before);
        let lag = s.atan2(c);
        self.found = [lag, 2.0 * c.hypot(s) / (TAU * frequency)];
        // Far from resonance the sign alone is known.
        let off = (lag - self.wanted + PI).rem_euclid(TAU) - PI;
        Some(1.0 - self.gain * off.clamp(-FRAC_PI_2, FRAC_PI_2))
    }
}

impl Host {
    /// Lets the frequency of the sine that drives it follow the resonance from now on, or no longer.
    pub(super) fn begin_dwell(&mut self, plan: Option<&plan::Dwell>) {
        let phase = match self.sine() {
            Some(Signal::Sine { phase, .. }) => *phase,
            _ => 0.0,
        };
        self.dwell = plan.map(|plan| Dwell::new(plan, self.damping_ratio(), phase));
    }

    /// What the dwell has found; nothing where the frequency follows nothing.
    pub fn dwelling(&self) -> Option<Dwelling> {
        let dwell = self.dwell?;
        let Some(Signal::Sine { frequency, .. }) = self.sine() else { return None };
        let [lag, amplitude] = dwell.found;
        Some(Dwelling { frequency: *frequency, lag, amplitude })
    }

    /// The sine that drives it: of its base, else the force.
    fn sine(&self) -> Option<&Signal> {
        [&self.base, &self.force].into_iter().flatten().find(|signal| matches!(signal, Signal::Sine { .. }))
    }

    /// Lets the frequency of the drive follow the resonance at `time` [s], the end of a step.
    pub(super) fn follow_resonance(&mut self, time: f64, dt: f64) {
        let Some(mut dwell) = self.dwell else { return };
        let Some(Signal::Sine { frequency, phase, .. }) = self.sine() else { return };
        let (frequency, angle) = (*frequency, TAU * frequency * (time - self.driven_since) + phase);
        let rate = self.velocity() - dot(&self.seen, &self.driven) * self.base(time).1;
        let factor = dwell.take(frequency * dt, angle, rate, frequency);
        self.dwell = Some(dwell);
        if let Some(factor) = factor {
            self.go_over_to(factor * frequency, dwell.keep, time);
        }
    }

    /// Writes the loop and the sine that it has come to.
    pub(super) fn save_dwell(&self, name: &str, state: &mut State) {
        let Some(Dwell { wanted: _, gain: _, keep: _, gone, sums, found }) = self.dwell else { return };
        let Some(Signal::Sine { amplitude, frequency, phase }) = self.sine() else { return };
        let sine = [*amplitude, *frequency, *phase];
        state.put_real(&format!("{name}.dwell"), [&[gone], &sums[..], &found, &sine].concat());
    }

    /// Takes them back.
    pub(super) fn load_dwell(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let Some(dwell) = &mut self.dwell else { return Ok(()) };
        let name = format!("{name}.dwell");
        let [gone, ahead, behind, lag, reached, was @ ..] = state.real(&name)? else {
            return Err(MissingSection { name, kind: "real" });
        };
        (dwell.gone, dwell.sums, dwell.found) = (*gone, [*ahead, *behind], [*lag, *reached]);
        let &[amplitude, frequency, phase] = was else {
            return Err(MissingSection { name, kind: "real" });
        };
        let mut drives = [&mut self.base, &mut self.force].into_iter().flatten();
        if let Some(sine) = drives.find(|signal| matches!(signal, Signal::Sine { .. })) {
            *sine = Signal::Sine { amplitude, frequency, phase };
        }
        Ok(())
    }
}
