//! Hops whose height, length and times are known.

use super::engines::done;
use super::{Ball, ball, column, near, on_wall, once, plan, scalar, touching, view, watch};
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;
use tsubu::view::{Contact, View};
use tsubu::watch::{Sample, Watch, open};
use tsubu_frame::{ResultValue, State, Summary, Table};

/// A quartz grain of 2 mm that falls 20 mm on a smooth floor, with 0.3 m/s along it.
const GRAIN: &str = r#"
gravity = 9.8
duration = "0.27 s"
dem.time-step = "0.5 us"
contact = { attraction = true, normal.hooke.stiffness = 1e4, damping.linear = {}, tangential.none = {} }
[materials.quartz]
density = 2650
young-modulus = "1 GPa"
restitution = 0.7
[particles.grain]
material = "quartz"
diameter = "2 mm"
start.at = { position = [[0, "21 mm"]], velocity = [[0.3, 0]] }
[walls.floor]
material = "quartz"
shape.plane = {}
[output]
history-interval = "10 ms"
[watch.w]
hops.most = 3
"#;

fn hops(text: &str, changes: &[&str], folder: &Path) -> (Summary, Table) {
    let summary = done(text, changes, folder);
    (summary, Table::read(&folder.join("watch/w.csv")).unwrap())
}

/// Worst relative miss of three hops against a ball that bounces with restitution `e`: times 2 e^n v/g, heights e^2n h,
/// lengths u t, restitution, and the contact time of a damped spring.
fn worst_miss(table: &Table, e: f64) -> f64 {
    let (g, h, u): (f64, f64, f64) = (9.8, 0.02, 0.3);
    let v = (2.0 * g * h).sqrt();
    let damping = -e.ln() / PI.hypot(e.ln());
    let mass = PI / 6.0 * 2650.0 * 0.002f64.powi(3);
    let contact = PI * (mass / 1e4).sqrt() / (1.0 - damping * damping).sqrt();
    if table.rows.len() != 3 {
        return f64::INFINITY;
    }
    let get = |name: &str| table.numbers(name).unwrap();
    let mut worst = 0.0f64;
    let mut miss = |name: &str, exact: &dyn Fn(i32) -> f64| {
        for (n, value) in (1..=3).zip(get(name)) {
            worst = worst.max((value / exact(n) - 1.0).abs());
        }
    };
    miss("flight time [s]", &|n| 2.0 * e.powi(n) * v / g);
    miss("height [m]", &|n| e.powi(2 * n) * h);
    miss("length [m]", &|n| u * 2.0 * e.powi(n) * v / g);
    miss("restitution [-]", &|_| e);
    miss("contact time [s]", &|_| contact);
    miss("impact speed [m/s]", &|n| (e.powi(n - 1) * v).hypot(u));
    miss("rebound speed [m/s]", &|n| (e.powi(n) * v).hypot(u));
    miss("impact angle [rad]", &|n| (e.powi(n - 1) * v).atan2(u));
    worst
}

#[test]
fn a_bouncing_grain_hops_as_in_the_book() {
    let folder = tempfile::tempdir().unwrap();
    let (summary, table) = hops(GRAIN, &[], folder.path());
    let miss = worst_miss(&table, 0.7);
    // The dashpot pulls at the end of a contact, which a step of 1/200 of it makes last too long or too short: 2.3e-3.
    assert!(miss < 3e-3, "{miss:e}");
    let number = |name: &str| match summary.results.get(name) {
        Some(ResultValue::Number(x)) => *x,
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(number("w hops final"), 3.0);
    assert!(near(number("w maximum height final"), 0.49 * 0.02, 3e-3));
    let heights = table.numbers("height [m]").unwrap();
    assert!(near(number("w mean height final"), heights.iter().sum::<f64>() / 3.0, 1e-12));
    // The controls: another restitution, and looks so far apart that contacts are not seen.
    assert!(worst_miss(&table, 0.707) > 1e-2);
    let (_, table) = hops(GRAIN, &["watch.w.every=120 us"], folder.path());
    assert!(worst_miss(&table, 0.7) > 3e-3);
}

/// A ball of radius 0.1 on a bed at z = 0 that hops `height` high and `length` long, a look every 0.05 of a flight of
/// 1 s; before and after it lies on the floor for a look.
fn arc(height: f64, length: f64) -> Vec<(f64, Ball, bool)> {
    let lift = 4.0 * height;
    let at = |t: f64| {
        let up = if (0.0..=1.0).contains(&t) { lift * t * (1.0 - t) } else { 0.0 };
        let rise = if (0.0..=1.0).contains(&t) { lift * (1.0 - 2.0 * t) } else { 0.0 };
        let along = length * t.clamp(0.0, 1.0);
        Ball { velocity: DVec3::new(length, 0.0, rise), ..ball(along, 0.0, 0.1 + up, 0.1) }
    };
    (-1..=21).map(|k| 0.05 * f64::from(k)).map(|t| (t, at(t), !(1e-9..1.0 - 1e-9).contains(&t))).collect()
}

fn shown(balls: &[Ball], contacts: Vec<Contact>, time: f64) -> View<'static> {
    let mut shown = view(balls, contacts, [None; 3]);
    shown.time = time;
    shown
}

/// The floor below a ball, with a little overlap.
fn floor(balls: &[Ball], first: usize) -> Contact {
    Contact { overlap: 1e-6, ..on_wall(balls, first, DVec3::new(0.0, 0.0, -0.1), DVec3::ZERO) }
}

/// All hops of the arcs one after the other.
fn flown(hops: &mut dyn Watch, arcs: &[(f64, f64)]) -> (Vec<Sample>, usize) {
    let mut samples = Vec::new();
    for (n, (height, length)) in arcs.iter().enumerate() {
        for (t, ball, down) in arc(*height, *length) {
            let contacts = if down { vec![floor(&[ball], 0)] } else { Vec::new() };
            samples.push(once(hops, &shown(&[ball], contacts, 1.2 * n as f64 + t)));
        }
    }
    let rows = samples.iter().map(|s| s.rows.len()).sum();
    (samples, rows)
}

/// Looks need not fall on the apex; a contact at the first look has no impact, and the way goes on.
#[test]
fn the_apex_is_found_between_looks() {
    let mut watch = watch(2, "hops = {}\n[walls.floor]\nmaterial = \"glass\"\nshape.plane = {}");
    let mut last = None;
    for (t, ball, down) in arc(0.3, 2.0) {
        // Nobody looks near the apex.
        if (t - 0.5).abs() > 0.18 {
            let contacts = if down { vec![floor(&[ball], 0)] } else { Vec::new() };
            let sample = once(&mut *watch, &shown(&[ball], contacts, t));
            last = Some(sample).filter(|s| !s.rows.is_empty()).or(last);
        }
    }
    let sample = last.unwrap();
    let get = |name: &str| column(&*watch, &sample, name)[0];
    assert!(near(get("height"), 0.3, 1e-5), "{}", get("height"));
    assert!((get("flight time") - 1.0).abs() < 0.05 && (get("length") - 2.0).abs() < 0.1, "within a look");
    assert!(get("restitution").is_nan() && get("impact speed").is_nan() && get("contact time").is_nan());
    // The control: the highest look is a good deal lower.
    assert!(!near(4.0 * 0.3 * 0.3 * 0.7, 0.3, 0.05));
}

#[test]
fn low_hops_and_hops_beyond_the_last_do_not_count() {
    let arcs = [(0.3, 1.0), (0.01, 0.1), (0.4, 1.0), (0.2, 1.0)];
    let floor = "\n[walls.floor]\nmaterial = \"glass\"\nshape.plane = {}";
    let count = |keys: &str| {
        let mut hops = watch(2, &format!("hops = {{ {keys} }}{floor}"));
        let (samples, rows) = flown(&mut *hops, &arcs);
        let sample = samples.last().unwrap();
        (scalar(&*hops, sample, "hops"), rows, scalar(&*hops, sample, "mean height"))
    };
    let (all, rows, mean) = count("");
    assert!(all == 4.0 && rows == 4 && near(mean, 0.91 / 4.0, 1e-4), "{mean}");
    let (some, rows, mean) = count("lowest = 0.05, most = 2");
    assert!(some == 2.0 && rows == 2 && near(mean, 0.35, 1e-4), "{mean}");
    assert_eq!(count("bed = [\"free-grains\"]").0, 0.0, "the floor is no bed then");
}

/// A ball that strikes a frozen one obliquely: only the speed along the line of centres is turned round.
#[test]
fn restitution_is_along_the_normal() {
    let look = |bed: &str, free: bool| {
        let more =
            "[particles.a]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[0, 0]]\nmotion.frozen = {}\n";
        let plan = plan(2, more, &format!("hops.bed = [\"{bed}\"]"));
        let mut hops = open(&plan.watch["w"].measure, &plan);
        let other = Ball { free, ..ball(0.0, 0.0, 0.0, 0.1) };
        let normal = DVec3::new(0.6, 0.0, 0.8);
        let slip = DVec3::new(0.8, 0.0, -0.6);
        let (before, after) = (-2.0 * normal + 0.5 * slip, 1.0 * normal + 0.5 * slip);
        let touch = 0.2 * normal;
        let mut rows = Vec::new();
        for k in -4..=40 {
            let t = 0.001 * (f64::from(k) + 0.5);
            let at = touch + if t < 0.0 { t * before } else { t * after };
            let velocity = if t < 0.0 { before } else { after };
            // It touches for two looks, and again in the end, where it comes back.
            let gap = if k == -1 || k == 0 || k == 40 { -1e-4 } else { 0.0 };
            let balls = [other, Ball { at: at + gap * normal, velocity, ..ball(0.0, 0.0, 0.0, 0.1) }];
            let contacts: Vec<Contact> = if gap < 0.0 {
                let overlapping = Ball { at: (0.2 - 1e-4) * normal, ..balls[1] };
                touching(&[other, overlapping], [None; 3], 0.0)
            } else {
                Vec::new()
            };
            rows.extend(once(&mut *hops, &shown(&balls, contacts, t)).rows);
        }
        let values = hops.sheet().unwrap().values;
        let restitution = values.iter().position(|name| name.starts_with("restitution")).unwrap() + 1;
        // Of two free grains both hop.
        rows.last().map(|row| (rows.len(), row[restitution]))
    };
    let (rows, restitution) = look("fixed-grains", false).unwrap();
    assert!(rows == 1 && near(restitution, 0.5, 1e-9), "{restitution}");
    assert_eq!(look("fixed-grains", true), None);
    assert_eq!(look("free-grains", true).unwrap().0, 2);
    // The control: speeds as a whole give another number.
    assert!(!near((1.0f64 + 0.25).sqrt() / (4.0f64 + 0.25).sqrt(), restitution, 0.05));
}

/// Cut in flight, in contact, and after a hop: what follows is the same, and a watch that forgot says something else.
#[test]
fn hops_go_on_after_a_checkpoint() {
    let ball = "[particles.a]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[0, 5]]";
    let plan = plan(2, &format!("[walls.floor]\nmaterial = \"glass\"\nshape.plane = {{}}\n{ball}"), "hops = {}");
    let fresh = || open(&plan.watch["w"].measure, &plan);
    let looks: Vec<(Ball, bool, f64)> = [(0.3, 1.0), (0.2, 0.7)]
        .iter()
        .enumerate()
        .flat_map(|(n, (h, l))| arc(*h, *l).into_iter().map(move |(t, ball, down)| (ball, down, t + 1.2 * n as f64)))
        .collect();
    let take = |watch: &mut dyn Watch, k: usize| {
        let (ball, down, time) = looks[k];
        let contacts = if down { vec![floor(&[ball], 0)] } else { Vec::new() };
        let sample = watch.take(&shown(&[ball], contacts, time));
        // Bits, so that what is not a number is equal to itself.
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        (bits(&sample.scalars), sample.rows.iter().map(|row| bits(row)).collect::<Vec<_>>())
    };
    for cut in [1, 10, 22, 24, 30] {
        let (mut whole, mut first, mut second) = (fresh(), fresh(), fresh());
        (0..cut).for_each(|k| drop((take(&mut *whole, k), take(&mut *first, k))));
        let mut state = State::default();
        first.save("watch.w", &mut state);
        second.load("watch.w", &state).unwrap();
        let mut forgetful = fresh();
        let mut differs = false;
        for k in cut..looks.len() {
            let sample = take(&mut *whole, k);
            assert_eq!(sample, take(&mut *second, k), "cut at {cut}, look {k}");
            differs |= sample != take(&mut *forgetful, k);
        }
        assert!(second.load("watch.other", &state).is_err());
        // A checkpoint that names a grain which the scene has not once asked for 584 GB.
        let mut forged = state.integer("watch.w.courses").unwrap().to_vec();
        if let Some(id) = forged.get_mut(1) {
            *id = 4_000_000_000;
            state.put_integer("watch.w.courses", forged);
            assert!(second.load("watch.w", &state).is_err());
        }
        // The control; at the second look there is nothing to forget yet.
        assert!(differs || cut == 1, "cut at {cut}");
    }
}
