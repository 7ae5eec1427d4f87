//! How far and how fast signals go, and what they drive.

use std::f64::consts::{PI, TAU};
use tsubu_scene::plan::Signal;

/// A random sum is beyond so many times its root mean square for 6e-5 of the time.
const USUAL: f64 = 4.0;

/// Largest absolute value of a signal, or more.
pub(crate) fn peak(signal: &Signal) -> f64 {
    match signal {
        Signal::Sine { amplitude, .. } => amplitude.abs(),
        Signal::SineSweep { from, to, .. } => swept(signal, *from).max(swept(signal, *to)),
        Signal::Impact { peak, .. } => peak.abs(),
        Signal::Sines { amplitude, offset, .. } => offset.abs() + amplitude.iter().map(|a| a.abs()).sum::<f64>(),
        Signal::Shock { .. } | Signal::Steady { .. } => f64::INFINITY,
        Signal::Table { value, .. } => value.iter().map(|v| v.abs()).fold(0.0, f64::max),
    }
}

/// Largest rate of change of a signal, or more.
pub(crate) fn fastest(signal: &Signal) -> f64 {
    match signal {
        Signal::Sine { amplitude, frequency, .. } => (amplitude * frequency).abs() * TAU,
        Signal::SineSweep { from, to, duration, keep, .. } => {
            let change = match keep.power() {
                0 => 0.0,
                power => f64::from(power) * (to - from).abs() / (from.min(*to) * duration),
            };
            let rate = |frequency: f64| swept(signal, frequency) * (TAU * frequency + change);
            rate(*from).max(rate(*to))
        }
        Signal::Impact { peak, duration, .. } => (peak / duration).abs() * PI,
        Signal::Shock { acceleration, duration, .. } => gained(*acceleration, *duration),
        Signal::Sines { amplitude, frequency, .. } => {
            amplitude.iter().zip(frequency).map(|(a, f)| (a * f).abs() * TAU).sum()
        }
        Signal::Steady { rate } => rate.abs(),
        Signal::Table { time, value } => {
            let slopes = time.windows(2).zip(value.windows(2)).map(|(t, v)| ((v[1] - v[0]) / (t[1] - t[0])).abs());
            slopes.fold(0.0, f64::max)
        }
    }
}

/// Rate of change that a signal hardly ever goes beyond.
pub(super) fn usual_speed(signal: &Signal) -> f64 {
    usual(signal, |w| w).unwrap_or(f64::INFINITY).min(fastest(signal))
}

/// Speed [m/s] of an oscillator of angular frequency `w` [rad/s] and damping ratio `ratio` on a base that moves so: at resonance, of many sines the usual one, after
/// a shock no more than what the base gains and what an undamped oscillator answers, 1.77 a / w (Harris and Crede 1961).
pub(super) fn shaken_speed(signal: &Signal, w: f64, ratio: f64) -> f64 {
    let transmitted = |driven: f64| {
        let r = driven / w;
        driven * ((1.0 + (2.0 * ratio * r).powi(2)) / ((1.0 - r * r).powi(2) + (2.0 * ratio * r).powi(2))).sqrt()
    };
    match signal {
        Signal::Shock { acceleration, duration, .. } => {
            let gained = gained(*acceleration, *duration);
            gained + gained.min(1.77 * acceleration.abs() / w)
        }
        // From rest it swings about what it follows, up to twice as fast.
        Signal::Steady { rate } => 2.0 * rate.abs(),
        _ => usual(signal, transmitted).unwrap_or_else(|| 0.5 / ratio * w * at_resonance(signal, w)),
    }
}

/// The same of an oscillator of `stiffness` [N/m] under such a force.
pub(super) fn pushed_speed(signal: &Signal, w: f64, ratio: f64, stiffness: f64) -> f64 {
    let answered = |driven: f64| {
        let r = driven / w;
        driven / ((1.0 - r * r).powi(2) + (2.0 * ratio * r).powi(2)).sqrt()
    };
    if let Signal::Steady { rate } = signal {
        return 2.0 * rate.abs() / stiffness;
    }
    usual(signal, answered).unwrap_or_else(|| 0.5 / ratio * w * at_resonance(signal, w)) / stiffness
}

/// Amplitude of a sweep at one of its frequencies [Hz].
fn swept(signal: &Signal, frequency: f64) -> f64 {
    match signal {
        Signal::SineSweep { amplitude, from, keep, .. } => amplitude.abs() * keep.amplitude(frequency, *from),
        _ => 0.0,
    }
}

/// What drives an oscillator of angular frequency `w` [rad/s] at its resonance: of a sweep the amplitude as near to it as it comes.
fn at_resonance(signal: &Signal, w: f64) -> f64 {
    match signal {
        Signal::SineSweep { from, to, .. } => swept(signal, (w / TAU).clamp(from.min(*to), from.max(*to))),
        _ => peak(signal),
    }
}

/// What a sum of sines hardly ever goes beyond, of which each is multiplied with `gain` of its angular frequency [rad/s].
fn usual(signal: &Signal, gain: impl Fn(f64) -> f64) -> Option<f64> {
    let Signal::Sines { amplitude, frequency, .. } = signal else { return None };
    let sizes = || amplitude.iter().zip(frequency).map(|(a, f)| (a * gain(TAU * f)).abs());
    let square: f64 = sizes().map(|size| 0.5 * size * size).sum();
    Some(sizes().sum::<f64>().min(USUAL * square.sqrt()))
}

/// Speed that a half-sine pulse of acceleration gives [m/s].
fn gained(acceleration: f64, duration: f64) -> f64 {
    2.0 / PI * acceleration.abs() * duration
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A base or a force that goes on at one rate had no largest value at resonance: the speed scale was infinite, the step nothing, and the run had
    /// no end. From rest, y = r t moves an undamped oscillator by r t - r sin(w t) / w, at most at twice the rate.
    #[test]
    fn what_goes_on_at_one_rate_drives_at_twice_it() {
        let signal = Signal::Steady { rate: -1e-3 };
        assert!((shaken_speed(&signal, 40.0, 0.01) - 2e-3).abs() < 1e-15);
        assert!((pushed_speed(&signal, 40.0, 0.01, 100.0) - 2e-5).abs() < 1e-17);
    }
}
