//! Motions and forces given in advance as functions of time.

use tsubu_scene::plan::Signal;

/// Value and rate of change of a signal at time `t` [s].
///
/// Sine: A sin(2 pi f t + p). Sine sweep: A sin(2 pi (f0 t + (f1 - f0) t^2 / (2 T))) for 0 <= t <= T, zero afterwards.
/// Impact: P sin(pi (t - t0) / T) for t0 <= t <= t0 + T, zero elsewhere. Shock: that as acceleration, from rest. Sines: c + sum of
/// A sin(2 pi f t + p). Steady: r t. Table: straight lines, constant outside.
pub fn value_and_rate(signal: &Signal, t: f64) -> (f64, f64) {
    use std::f64::consts::{PI, TAU};
    match signal {
        Signal::Sine { amplitude, frequency, phase } => {
            let w = TAU * frequency;
            let (sin, cos) = (w * t + phase).sin_cos();
            (amplitude * sin, amplitude * w * cos)
        }
        Signal::SineSweep { amplitude, from, to, duration } => {
            if !(0.0..=*duration).contains(&t) {
                return (0.0, 0.0);
            }
            let slope = (to - from) / duration;
            let (sin, cos) = (TAU * (from * t + 0.5 * slope * t * t)).sin_cos();
            (amplitude * sin, amplitude * TAU * (from + slope * t) * cos)
        }
        Signal::Impact { peak, duration, at } => {
            let phase = (t - at) / duration;
            if !(0.0..=1.0).contains(&phase) {
                return (0.0, 0.0);
            }
            let (sin, cos) = (PI * phase).sin_cos();
            (peak * sin, peak * PI / duration * cos)
        }
        Signal::Shock { acceleration, duration, at } => shock(*acceleration, *duration, t - at),
        Signal::Sines { amplitude, frequency, phase, offset } => {
            let lines = amplitude.iter().zip(frequency).zip(phase);
            lines.fold((*offset, 0.0), |(value, rate), ((amplitude, frequency), phase)| {
                let w = TAU * frequency;
                let (sin, cos) = (w * t + phase).sin_cos();
                (value + amplitude * sin, rate + amplitude * w * cos)
            })
        }
        Signal::Steady { rate } => (rate * t, *rate),
        Signal::Table { time, value } => table(time, value, t),
    }
}

/// Displacement [m] and velocity [m/s] at `t` [s] after the begin of a half-sine pulse of acceleration a sin(pi t / T): with T' = T / pi
/// a T' (t - T' sin(t / T')) and a T' (1 - cos(t / T')); afterwards it goes on at 2 a T'.
fn shock(acceleration: f64, duration: f64, t: f64) -> (f64, f64) {
    let scale = duration / std::f64::consts::PI;
    let gained = acceleration * scale;
    match t {
        _ if t <= 0.0 => (0.0, 0.0),
        _ if t >= duration => (gained * (2.0 * t - duration), 2.0 * gained),
        _ => {
            // 1 - cos(x) would lose what the first moments gain.
            let half = (0.5 * t / scale).sin();
            (gained * (t - scale * (t / scale).sin()), 2.0 * gained * half * half)
        }
    }
}

/// Straight-line interpolation; the rate is the slope of the line that begins at or before `t`.
fn table(time: &[f64], value: &[f64], t: f64) -> (f64, f64) {
    let after = time.partition_point(|&x| x <= t);
    if after == 0 {
        return (value.first().copied().unwrap_or(0.0), 0.0);
    }
    if after == time.len() {
        return (value.last().copied().unwrap_or(0.0), 0.0);
    }
    let slope = (value[after] - value[after - 1]) / (time[after] - time[after - 1]);
    (value[after - 1] + slope * (t - time[after - 1]), slope)
}

#[cfg(test)]
mod tests {
    use super::value_and_rate;
    use tsubu_scene::plan::Signal;

    /// The rate is the derivative of the value: central differences agree wherever the signal is smooth.
    #[test]
    fn rate_is_the_derivative() {
        let signals = [
            Signal::Sine { amplitude: 0.5, frequency: 6.0, phase: 0.3 },
            Signal::SineSweep { amplitude: 0.5, from: 2.0, to: 9.0, duration: 1.0 },
            Signal::Impact { peak: 3.0, duration: 0.4, at: 0.1 },
            Signal::Shock { acceleration: 3.0, duration: 0.2, at: 0.2 },
            Signal::Sines { amplitude: vec![0.5, 0.1], frequency: vec![2.0, 7.3], phase: vec![0.3, -1.0], offset: 0.2 },
            Signal::Steady { rate: -2.0 },
            Signal::Table { time: vec![0.0, 0.25, 0.6], value: vec![1.0, -1.0, 2.0] },
        ];
        for signal in &signals {
            for t in [0.13, 0.31, 0.44] {
                let h = 1e-6;
                let slope = (value_and_rate(signal, t + h).0 - value_and_rate(signal, t - h).0) / (2.0 * h);
                let rate = value_and_rate(signal, t).1;
                assert!((slope - rate).abs() < 1e-6 * rate.abs().max(1.0), "{signal:?} at {t}: {slope} {rate}");
            }
        }
    }

    /// The rate of a shock has the acceleration that was asked for as its derivative, and 2 a T / pi is gained. Control: the impact of the same
    /// height, whose value is the half sine, has not.
    #[test]
    fn a_shock_is_a_half_sine_of_acceleration() {
        let (acceleration, duration, at) = (30.0, 0.011, 0.005);
        let asked = |t: f64| {
            let s = (t - at) / duration;
            if (0.0..=1.0).contains(&s) { acceleration * (std::f64::consts::PI * s).sin() } else { 0.0 }
        };
        let off = |signal: &Signal| {
            let slope = |t: f64| (value_and_rate(signal, t + 1e-7).1 - value_and_rate(signal, t - 1e-7).1) / 2e-7;
            (1..30).map(|k| 7e-4 * f64::from(k)).map(|t| (slope(t) - asked(t)).abs()).fold(0.0, f64::max)
        };
        let shock = Signal::Shock { acceleration, duration, at };
        assert!(off(&shock) < 1e-5 * acceleration, "{}", off(&shock));
        assert!(off(&Signal::Impact { peak: acceleration, duration, at }) > acceleration);
        let gained = 2.0 * acceleration * duration / std::f64::consts::PI;
        assert!((value_and_rate(&shock, 1.0).1 / gained - 1.0).abs() < 1e-15);
        assert_eq!(value_and_rate(&shock, at), (0.0, 0.0));
    }

    #[test]
    fn table_is_constant_outside() {
        let signal = Signal::Table { time: vec![0.0, 1.0], value: vec![2.0, 5.0] };
        assert_eq!(value_and_rate(&signal, -1.0), (2.0, 0.0));
        assert_eq!(value_and_rate(&signal, 1.5), (5.0, 0.0));
    }
}
