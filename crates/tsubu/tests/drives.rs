//! What shocks and random vibration of a base do to an oscillator, against closed forms.

use std::f64::consts::{PI, TAU};
use std::path::Path;
use tsubu::ledger::{Account, Ledger};
use tsubu::partner::{Host, Hosts};
use tsubu::view::View;
use tsubu::watch::{Watch, open};
use tsubu_frame::State;
use tsubu_scene::{Plan, Scene};

/// An oscillator of 1 kg without grains on a base that moves so.
fn scene(frequency: f64, ratio: f64, drive: &str, seed: u64) -> Scene {
    let stiffness = (TAU * frequency).powi(2);
    let text = format!(
        "duration = 1\nseed = {seed}\n[hosts.tip]\nstructure.oscillator = {{ mass = 1, stiffness = {stiffness}, damping-ratio = {ratio} }}\n{drive}\n"
    );
    Scene::parse("scene.toml", &text, Path::new("."), &[]).unwrap_or_else(|complaints| panic!("{complaints}"))
}

/// Goes through `steps` steps and shows the structure after each.
fn go(hosts: &mut Hosts, dt: f64, steps: u32, mut look: impl FnMut(f64, &Host)) -> Ledger {
    let mut ledger = Ledger::default();
    for step in 1..=steps {
        let time = dt * f64::from(step);
        hosts.before(time, dt);
        hosts.after(time, dt, &mut ledger);
        look(time, &hosts.list[0]);
    }
    ledger
}

/// Largest stretch after a half-sine shock of a base, times w^2 over the peak acceleration, of an undamped oscillator of 20 Hz; `ratio` is the length of the
/// pulse over the natural period.
fn residual(ratio: f64) -> f64 {
    let (frequency, acceleration) = (20.0, 490.0);
    let duration = ratio / frequency;
    let drive = format!("base.shock = {{ acceleration = {acceleration}, duration = {duration}, at = 0.01 }}");
    let mut hosts = Hosts::new(&scene(frequency, 0.0, &drive, 1).plan().hosts);
    let dt = 1.0 / (frequency * 2000.0);
    let steps = ((0.01 + duration) / dt).ceil() + 4000.0;
    let mut highest = 0.0_f64;
    go(&mut hosts, dt, steps as u32, |time, host| {
        if time >= 0.01 + duration {
            highest = highest.max((host.displacement() - host.base_at(time)[0]).abs());
        }
    });
    highest * (TAU * frequency).powi(2) / acceleration
}

/// The stretch u = z - y follows u'' + w^2 u = -a sin(pi t / T); after the pulse it swings with (a / w) |integral of sin(pi s / T) exp(-i w s)|, so
/// w^2 u / a = 4 r |cos(pi r)| / |1 - 4 r^2| with r = T w / (2 pi), pi/2 at r = 1/2 (residual shock spectrum of the half sine, Harris and Crede 1961).
/// Control: a pulse of twice the length misses the gate at every r.
#[test]
fn what_a_shock_leaves_is_the_residual_spectrum() {
    for ratio in [0.1, 0.25, 0.5, 0.8, 1.0, 1.5, 2.0] {
        let exact = if ratio == 0.5 {
            0.5 * PI
        } else {
            4.0 * ratio * (PI * ratio).cos().abs() / (1.0 - 4.0 * ratio * ratio).abs()
        };
        let (found, twice) = (residual(ratio), residual(2.0 * ratio));
        assert!((found - exact).abs() < 5e-4, "{ratio}: {found} {exact}");
        assert!((twice - exact).abs() > 0.05, "{ratio}: {twice} {exact}");
    }
}

/// Mean square acceleration of an oscillator of 20 Hz and damping ratio 0.05 on a random base of 0.01 (m/s^2)^2/Hz from 5 to 80 Hz, in the mean over four
/// seeds of 100 s each, against the integral of (1 + (2 zeta r)^2) / ((1 - r^2)^2 + (2 zeta r)^2) S df; Miles (1954), pi/2 f S / (2 zeta), is
/// near. Control: a one-sided density that is taken for a two-sided one doubles it. The books close.
#[test]
fn a_random_base_shakes_as_miles_says() {
    let (frequency, zeta, density) = (20.0, 0.05, 0.01);
    let drive = format!("base.random = {{ frequency = [5, 80], psd = [{density}, {density}], lines = 200 }}");
    let transmitted = |f: f64| {
        let r: f64 = f / frequency;
        (1.0 + (2.0 * zeta * r).powi(2)) / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2))
    };
    let count = 75_000;
    let exact = (0..count).map(|k| transmitted(5.0 + (f64::from(k) + 0.5) * 1e-3) * density * 1e-3).sum::<f64>();
    let miles = 0.5 * PI * frequency * density / (2.0 * zeta);
    assert!((exact / miles - 1.0).abs() < 0.1, "{exact} {miles}");
    let dt = 5e-4;
    let square = |seed: u64| {
        let mut hosts = Hosts::new(&scene(frequency, zeta, &drive, seed).plan().hosts);
        let (mut sum, mut looks, mut velocity) = (0.0, 0.0, 0.0);
        let opening = hosts.energy(0.0);
        let ledger = go(&mut hosts, dt, 204_000, |time, host| {
            // After two seconds, twelve times the decay, the transient is gone.
            if time > 2.0 {
                sum += ((host.velocity() - velocity) / dt).powi(2);
                looks += 1.0;
            }
            velocity = host.velocity();
        });
        let closing = hosts.energy(102.0);
        let gained = closing.0 + closing.1 - opening.0 - opening.1;
        let [work, lost] = [Account::BaseWork, Account::HostDamping].map(|account| ledger.flow(account));
        assert!((gained - work + lost).abs() < 1e-3 * lost, "{gained} {work} {lost}");
        sum / looks
    };
    let mean = (1..=4).map(square).sum::<f64>() / 4.0;
    assert!((mean / exact - 1.0).abs() < 0.05, "{mean} {exact}");
    assert!((2.0 * mean / exact - 1.0).abs() > 0.05);
}

/// Looks at the structure at every step for so long [s]; once it saves what it has seen and goes on from that.
fn spectrum(plan: &Plan, seconds: f64) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut hosts = Hosts::new(&plan.hosts);
    let watch = || open(&plan.watch["w"].measure, plan);
    let (mut looking, mut rows, mut scalars) = (watch(), Vec::new(), Vec::new());
    let dt = 5e-4;
    let half = 0.5 * seconds;
    let mut ledger = Ledger::default();
    for step in 1..=(seconds / dt) as u32 {
        let time = dt * f64::from(step);
        hosts.before(time, dt);
        hosts.after(time, dt, &mut ledger);
        let sample = looking.take(&View { time, hosts: &hosts.list, ..View::default() });
        if !sample.rows.is_empty() {
            rows = sample.rows;
        }
        scalars = sample.scalars;
        if (time - half).abs() < 0.5 * dt {
            let mut state = State::default();
            looking.save("w", &mut state);
            let mut fresh: Box<dyn Watch> = watch();
            fresh.load("w", &state).unwrap();
            looking = fresh;
        }
    }
    (rows, scalars)
}

/// Transmissibility of an oscillator of 20 Hz and damping ratio 0.2 on a random base, by Welch's method: sqrt(1 + (2 zeta r)^2) / sqrt((1 - r^2)^2 + (2 zeta r)^2)
/// from 6 to 60 Hz, with a coherence near 1. Control: the curve of a structure that a force drives, without the root above. The densities: of
/// the base that of the scene, in the mean over the band; of the force on it that of the acceleration times the mass squared.
#[test]
fn transmissibility_comes_out_of_a_random_run() {
    let (frequency, zeta, density) = (20.0, 0.2, 0.01);
    let drive = format!(
        "base.random = {{ frequency = [4, 80], psd = [{density}, {density}], lines = 800 }}\n[watch.w]\nspectrum = {{ frequency = [6, 60], segment = 2 }}"
    );
    let scene = scene(frequency, zeta, &drive, 1);
    let (rows, scalars) = spectrum(scene.plan(), 60.0);
    assert_eq!((rows.len(), scalars[5]), (109, 59.0 - 1.0));
    let worst = |exact: &dyn Fn(f64) -> f64| {
        rows.iter().map(|row| (row[4] / exact(row[0] / frequency) - 1.0).abs()).fold(0.0, f64::max)
    };
    let below = |r: f64| ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)).sqrt();
    let off = worst(&|r| (1.0 + (2.0 * zeta * r).powi(2)).sqrt() / below(r));
    assert!(off < 0.03, "{off}");
    assert!(worst(&|r| 1.0 / below(r)) > 0.2);
    assert!(rows.iter().all(|row| row[5] > 0.95), "coherence");
    let mean = rows.iter().map(|row| row[1]).sum::<f64>() / rows.len() as f64;
    assert!((mean / density - 1.0).abs() < 0.05, "{mean}");
    assert!(rows.iter().all(|row| (row[3] / row[2] - 1.0).abs() < 1e-2), "the mass is 1 kg");
    assert!((scalars[0] / (54.0 * density).sqrt() - 1.0).abs() < 0.03, "{scalars:?}");
}
