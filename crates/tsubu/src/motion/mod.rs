//! Motions and forces given in advance as functions of time.

use tsubu_scene::plan::{Scale, Signal};

/// Value and rate of change of a signal at time `t` [s].
///
/// Sine: A sin(2 pi f t + p). Sine sweep: A (f0 / f)^n sin(2 pi integral of f) for 0 <= t <= T, zero afterwards; n = 0, 1, 2 for a constant
/// amplitude of displacement, velocity, acceleration.
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
        Signal::SineSweep { amplitude, from, to, duration, scale, keep } => {
            if !(0.0..=*duration).contains(&t) {
                return (0.0, 0.0);
            }
            let (turns, frequency, slope) = sweep(*scale, *from, *to, *duration, t);
            let (sin, cos) = (TAU * turns).sin_cos();
            match keep.power() {
                0 => (amplitude * sin, amplitude * TAU * frequency * cos),
                power => {
                    let amplitude = amplitude * keep.amplitude(frequency, *from);
                    let shrinks = f64::from(power) * slope / frequency;
                    (amplitude * sin, amplitude * (TAU * frequency * cos - shrinks * sin))
                }
            }
        }
        Signal::Impact { peak, duration, at } => {
            let phase = (t - at) / duration;
            if !(0.0..=1.0).contains(&phase) {
                return (0.0, 0.0);
            }
            let (sin, cos) = (PI * phase).sin_cos();
            (peak * sin, peak * PI / duration * cos)
        }
        Signal::Shock { acceleration, duration, at, compensation } => {
            compensated([*acceleration, *duration, *compensation], t - at)
        }
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

/// Turns, frequency [Hz] and its rate [Hz/s] at `t` [s]: f0 + (f1 - f0) t / T, or f0 (f1 / f0)^(t / T), and the integral from 0.
fn sweep(scale: Scale, from: f64, to: f64, duration: f64, t: f64) -> (f64, f64, f64) {
    let octaves = (to / from).ln() / duration;
    match scale {
        Scale::Logarithmic if octaves != 0.0 => {
            let frequency = from * (octaves * t).exp();
            (from * (octaves * t).exp_m1() / octaves, frequency, octaves * frequency)
        }
        _ => {
            let slope = (to - from) / duration;
            (from * t + 0.5 * slope * t * t, from + slope * t, slope)
        }
    }
}

/// A shock between two pulses of the other sign, by `peak` [m/s^2], length [s] and the share c of their peaks: of the length T / 2c each takes away half
/// of the speed that the shock gives, and by symmetry all ends where it began.
fn compensated([peak, duration, share]: [f64; 3], t: f64) -> (f64, f64) {
    if share == 0.0 {
        return shock(peak, duration, t);
    }
    let beside = 0.5 * duration / share;
    let pulses =
        [(-share * peak, beside, t), (peak, duration, t - beside), (-share * peak, beside, t - beside - duration)];
    if t >= 2.0 * beside + duration {
        return (0.0, 0.0);
    }
    pulses
        .into_iter()
        .map(|(peak, duration, t)| shock(peak, duration, t))
        .fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
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
    use tsubu_scene::plan::{Keep, Scale, Signal};

    /// The rate is the derivative of the value: central differences agree wherever the signal is smooth.
    #[test]
    fn rate_is_the_derivative() {
        let sweep = |scale, keep| Signal::SineSweep { amplitude: 0.5, from: 2.0, to: 9.0, duration: 1.0, scale, keep };
        let signals = [
            Signal::Sine { amplitude: 0.5, frequency: 6.0, phase: 0.3 },
            sweep(Scale::Linear, Keep::Displacement),
            sweep(Scale::Logarithmic, Keep::Displacement),
            sweep(Scale::Linear, Keep::Velocity),
            sweep(Scale::Logarithmic, Keep::Acceleration),
            Signal::Impact { peak: 3.0, duration: 0.4, at: 0.1 },
            Signal::Shock { acceleration: 3.0, duration: 0.2, at: 0.2, compensation: 0.0 },
            Signal::Shock { acceleration: 3.0, duration: 0.1, at: 0.1, compensation: 0.4 },
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

    /// A slow logarithmic sweep down from 50 to 10 Hz by 1 g: its acceleration has an amplitude of 1 g all the way, within what the slope of its frequency
    /// takes, k / (pi f) for f' = k f. Halfway it is at the geometric mean. Control: with a constant amplitude the acceleration falls 25 times.
    #[test]
    fn a_sweep_keeps_its_acceleration() {
        let (from, to, duration, g) = (50.0, 10.0, 20.0, 9.80665);
        let amplitude = g / (std::f64::consts::TAU * from).powi(2);
        let sweep = |keep| Signal::SineSweep { amplitude, from, to, duration, scale: Scale::Logarithmic, keep };
        let highest = |signal: &Signal, begin: f64, period: f64| {
            let slope = |t: f64| (value_and_rate(signal, t + 1e-6).1 - value_and_rate(signal, t - 1e-6).1) / 2e-6;
            (0..2000).map(|k| slope(begin + period * f64::from(k) / 2000.0).abs()).fold(0.0, f64::max)
        };
        for (at, frequency) in [(0.1, 50.0), (10.0, (50.0_f64 * 10.0).sqrt()), (19.8, 10.0)] {
            let off = highest(&sweep(Keep::Acceleration), at, 1.0 / frequency) / g - 1.0;
            assert!(off.abs() < 0.081 / (std::f64::consts::PI * 10.0), "{off:e} at {at} s");
        }
        let fallen = highest(&sweep(Keep::Displacement), 19.8, 0.1) / g;
        assert!((0.03..0.05).contains(&fallen), "{fallen}");
        // Zeros of the sine, and so the phase: the integral of the frequency, (from - to) / k turns in all.
        let turns = (from - to) / (from / to).ln() * duration;
        let whole = super::sweep(Scale::Logarithmic, from, to, duration, duration).0;
        assert!((whole / turns - 1.0).abs() < 1e-14);
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
        let shock = Signal::Shock { acceleration, duration, at, compensation: 0.0 };
        assert!(off(&shock) < 1e-5 * acceleration, "{}", off(&shock));
        assert!(off(&Signal::Impact { peak: acceleration, duration, at }) > acceleration);
        let gained = 2.0 * acceleration * duration / std::f64::consts::PI;
        assert!((value_and_rate(&shock, 1.0).1 / gained - 1.0).abs() < 1e-15);
        assert_eq!(value_and_rate(&shock, at), (0.0, 0.0));
    }

    /// Two pulses of a tenth, five times as long each, bring a shock of 30 m/s^2 and 11 ms back to rest where it was; in the middle it is what was asked for.
    /// Control: with nine tenths of their length the base would still move at the end.
    #[test]
    fn a_compensated_shock_ends_where_it_began() {
        let (acceleration, duration, compensation) = (30.0, 0.011, 0.1);
        let signal = Signal::Shock { acceleration, duration, at: 0.0, compensation };
        let middle = 5.5 * duration;
        let slope = (value_and_rate(&signal, middle + 1e-7).1 - value_and_rate(&signal, middle - 1e-7).1) / 2e-7;
        assert!((slope / acceleration - 1.0).abs() < 1e-6, "{slope}");
        // Just before the end, where all three pulses add up.
        let (place, speed) = value_and_rate(&signal, 11.0 * duration * (1.0 - 1e-9));
        let gained = 2.0 * acceleration * duration / std::f64::consts::PI;
        assert!(place.abs() < 1e-12 * gained * duration && speed.abs() < 1e-12 * gained, "{place:e} {speed:e}");
        assert_eq!(value_and_rate(&signal, 1.0), (0.0, 0.0));
        let short = super::shock(-3.0, 4.5 * duration, 1.0).1 * 2.0 + super::shock(30.0, duration, 1.0).1;
        assert!(short.abs() > 0.05 * gained, "{short:e}");
    }

    #[test]
    fn table_is_constant_outside() {
        let signal = Signal::Table { time: vec![0.0, 1.0], value: vec![2.0, 5.0] };
        assert_eq!(value_and_rate(&signal, -1.0), (2.0, 0.0));
        assert_eq!(value_and_rate(&signal, 1.5), (5.0, 0.0));
    }
}
