//! The verdict: is this scene resolved well enough, and what will it cost?

use super::rest::{self, IN_A_BED, IN_A_FILM, IN_AN_IMPACT};
use super::{bodies, cost, idle, memory, mesh, shortest_period, speed_scale, water};
use crate::bench::Bench;
use crate::contact::{Pair, Table};
use crate::engine::{self, Engine, Fault, OpenError, Verdict as Noted};
use crate::neighbours::lists::WORTH_THREADS;
use crate::partner::Hosts;
use crate::study::unsettled;
use std::fmt;
use tsubu_scene::plan::{Integrator, Method, Normal, Particles, Plan, Start};

/// One judgement.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// `false`: a warning.
    pub good: bool,
    /// What was found.
    pub text: String,
    /// What to change, with the key; empty where nothing needs changing.
    pub advice: String,
}

/// All judgements on a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// The lines, in the order of importance to a reader.
    pub lines: Vec<Line>,
    /// Whether the run would be refused or would fail.
    pub fails: bool,
}

impl Verdict {
    /// Whether there is a warning.
    pub fn warns(&self) -> bool {
        self.lines.iter().any(|l| !l.good)
    }

    pub(super) fn say(&mut self, text: String) {
        self.lines.push(Line { good: true, text, advice: String::new() });
    }

    /// Adds a warning.
    pub fn warn(&mut self, text: impl Into<String>, advice: impl Into<String>) {
        self.lines.push(Line { good: false, text: text.into(), advice: advice.into() });
    }

    /// The other lines say why; without them the user would be left with the blow-up alone.
    fn fail(&mut self, what: &str, fault: &Fault) {
        let text = fault.to_string();
        let (reason, hint) = text.split_once("\nhint: ").unwrap_or((&text, "what the warnings above name"));
        self.judge(false, format!("{what}: {reason}"), || hint.to_owned());
        self.fails = true;
    }

    pub(super) fn judge(&mut self, good: bool, text: String, advice: impl FnOnce() -> String) {
        let advice = if good { String::new() } else { advice() };
        self.lines.push(Line { good, text, advice });
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in &self.lines {
            writeln!(f, "{} {}", if line.good { "ok  " } else { "warn" }, line.text)?;
            if !line.advice.is_empty() {
                writeln!(f, "       change: {}", line.advice)?;
            }
        }
        Ok(())
    }
}

/// Builds the scene, judges it, and measures for a moment how fast this machine moves it.
///
/// Where `bench` knows this machine, the estimate is for all its cores too. `ahead` hears what is known so far, and what comes
/// next: a part that may take long.
pub fn check(
    plan: &Plan,
    bench: Option<&Bench>,
    ahead: &mut dyn FnMut(&Verdict, &'static str),
) -> Result<Verdict, OpenError> {
    ahead(&Verdict::default(), "placing the grains");
    let mut hosts = Hosts::new(&plan.hosts);
    let settles = |group: &Particles| matches!(group.start, Start::Settled { time } if time > 0.0);
    let mut engine = engine::open(&unsettled(plan), &hosts)?;
    let mut verdict = verdict(plan, &hosts, &*engine);
    let total = plan.duration / engine.time_step();
    if total.round() < 1.0 {
        let (duration, dt) = (plan.duration, engine.time_step());
        verdict.judge(false, format!("the run would have no step: it lasts {duration} s, a step {dt} s"), || {
            format!("`duration`, or `{}`", step_key(plan))
        });
        verdict.fails = true;
        return Ok(verdict);
    }
    if plan.particles.values().any(settles) {
        ahead(&verdict, "settling the grains before time 0");
        match engine::open(plan, &hosts) {
            Ok(settled) => engine = settled,
            Err(OpenError::Settling(fault)) => {
                verdict.fail("settling before time 0 would fail", &fault);
                return Ok(verdict);
            }
            Err(other) => return Err(other),
        }
    }
    ahead(&verdict, "the first steps");
    let now = match cost::trial(&mut *engine, &mut hosts, total) {
        Ok(cost) => cost,
        Err(fault) => {
            verdict.fail("the run would fail", &fault);
            return Ok(verdict);
        }
    };
    ahead(&verdict, "the first steps of a settled bed");
    let dense = cost::of_a_bed(plan).map_or(now, |bed| bed.max(now));
    times(&mut verdict, plan, &hosts, &*engine, [now, dense], bench);
    Ok(verdict)
}

/// The longest run [s] that is not worth a warning: a month.
const LONGEST: f64 = 30.0 * 86_400.0;

/// How long a run takes, with the cost of a step as it is measured now, and of a settled bed [s].
fn times(
    verdict: &mut Verdict,
    plan: &Plan,
    hosts: &Hosts,
    engine: &dyn Engine,
    cost: [f64; 2],
    bench: Option<&Bench>,
) {
    let total = plan.duration / engine.time_step();
    let [low, high] = cost.map(|cost| cost * total);
    let shorter = || format!("a shorter `duration`, fewer grains, or a longer `{}`", step_key(plan));
    verdict.judge(
        high <= LONGEST,
        format!(
            "time: about {} on this machine for one run ({} a step, one thread{})",
            span(low, high),
            span(cost[0], cost[1]),
            if cost[1] > 1.2 * cost[0] { ", as grains are now to all of them lying on each other" } else { "" }
        ),
        shorter,
    );
    let threaded = plan.method == Method::Dem && engine.grains() >= WORTH_THREADS;
    match bench {
        Some(bench) if threaded && bench.cores > 1 => verdict.say(format!(
            "time: about {} with {} threads, {:.2} times as fast by `tsubu bench`",
            span(low / bench.scaling(), high / bench.scaling()),
            bench.cores,
            bench.scaling()
        )),
        None if threaded => verdict.say("time with more threads: `tsubu bench` measures this machine".to_owned()),
        _ => {}
    }
    let Some(response) = &plan.response else { return };
    let cases: usize = response.vary.values().map(Vec::len).product();
    let runs = cases * response.frequency_ratio.len() * response.seeds as usize;
    let f0 = hosts.index(&response.host).and_then(|i| hosts.list[i].natural_frequencies().first().copied());
    // A period is that of the drive: at a tenth of the natural frequency ten times as long.
    let periods = f64::from(response.discard_periods + response.measure_periods);
    let seconds: f64 = response.frequency_ratio.iter().map(|ratio| periods / (ratio * f0.unwrap_or(1.0))).sum();
    let steps = seconds / engine.time_step() * (cases * response.seeds as usize) as f64;
    let [low, high] = cost.map(|cost| cost * steps * grains_of_cases(plan) / rayon::current_num_threads() as f64);
    verdict.judge(
        high <= LONGEST,
        format!("time: about {} for `tsubu response` ({runs} runs side by side)", span(low, high)),
        || "fewer frequencies, cases or periods".to_owned(),
    );
}

/// Grains of the cases of a response over those of the scene, in the mean.
fn grains_of_cases(plan: &Plan) -> f64 {
    let all = plan.grains();
    let vary = plan.response.iter().flat_map(|response| &response.vary);
    let more = plan.particles.iter().map(|(name, group)| {
        let values = vary.clone().find(|(key, _)| **key == format!("particles.{name}.count")).map(|(_, values)| values);
        let counts = values.into_iter().flatten().filter_map(toml::Value::as_integer);
        let (sum, number) = counts.fold((0.0, 0.0), |(sum, number), count| (sum + count as f64, number + 1.0));
        if number > 0.0 { sum / number - group.count as f64 } else { 0.0 }
    });
    if all > 0 { 1.0 + more.sum::<f64>() / all as f64 } else { 1.0 }
}

/// A time, or from when to when.
fn span(low: f64, high: f64) -> String {
    if high <= 1.2 * low { human_time(high) } else { format!("{} to {}", human_time(low), human_time(high)) }
}

/// The judgement without the measurement.
pub fn verdict(plan: &Plan, hosts: &Hosts, engine: &dyn Engine) -> Verdict {
    let mut verdict = Verdict::default();
    let speed = speed_scale(plan, hosts);
    let dt = engine.time_step();
    let origin =
        if plan.speed_scale.is_some() { "told by `speed-scale`" } else { "estimated; set `speed-scale` to tell it" };
    verdict.say(format!("speed scale {speed:.3} m/s ({origin})"));
    match plan.method {
        Method::Dem => {
            dem(&mut verdict, plan, hosts, dt, speed);
            water::judge(&mut verdict, plan, hosts, dt);
        }
        Method::Lattice => lattice(&mut verdict, plan, dt, speed),
        // Grains that move where there is room know no contact time.
        _ => {}
    }
    mesh::meshes(&mut verdict, plan);
    idle::gates(&mut verdict, plan);
    let period = shortest_period(hosts);
    if period.is_finite() {
        let steps = period / dt;
        verdict.judge(
            steps >= 50.0,
            format!("host: shortest natural period {period:.4e} s, {steps:.0} steps a period (wanted: 50 or more)"),
            || format!("shorten `{}` to {:.2e} s or less", step_key(plan), period / 50.0),
        );
    }
    for note in engine.notes() {
        let (why, advice) = note.text.split_once("; ").unwrap_or((&note.text, ""));
        match note.verdict {
            Noted::Doubtful => {
                verdict.judge(false, format!("`{}`: {why}", note.key), || advice.to_owned());
            }
            _ => verdict.say(format!("approximated: `{}`: {}", note.key, note.text)),
        }
    }
    let steps = plan.duration / dt;
    verdict.say(format!(
        "{} grains, {steps:.0} steps of {dt:.3e} s, {:.3e} particle-steps, about {} of memory",
        engine.grains(),
        steps * engine.grains() as f64,
        human_memory(memory::of(plan, engine.places()))
    ));
    verdict
}

fn step_key(plan: &Plan) -> &'static str {
    match plan.method {
        Method::Dem => "dem.time-step",
        Method::Lattice => "lattice.time-step",
        Method::ClCa => "cl-ca.spacing",
        Method::Litwiniszyn => "litwiniszyn.time-step",
        Method::AfterCaramHong => "after-caram-hong.time-step",
        Method::AfterSavage => "after-savage.time-step",
        Method::GuttHaff => "gutt-haff.time-step",
        Method::AfterHemmingssonHerrmann => "duration",
        Method::Fhp => "fhp.time-step",
        Method::AfterPengHerrmann => "after-peng-herrmann.time-step",
        Method::AfterBaxterBehringer => "after-baxter-behringer.time-step",
        Method::AfterKarolyiKertesz => "after-karolyi-kertesz.time-step",
    }
}

fn dem(verdict: &mut Verdict, plan: &Plan, hosts: &Hosts, dt: f64, speed: f64) {
    let table = Table::new(plan);
    let bodies = bodies(plan, &table, hosts);
    for (a, b) in bodies.pairs() {
        let label = format!("{} on {}", a.name, b.name);
        let pair = table.pair(a.body(), b.body());
        let time = pair.contact_time(speed);
        let steps = time / dt;
        // Osada 2004: fewer than 10 steps a contact give abnormal rebounds.
        verdict.judge(
            steps >= 9.999,
            format!("{label}: contact time {time:.3e} s at {speed:.3} m/s, {steps:.1} steps per contact (never below 10, good from 20)"),
            || format!("`dem.time-step` to {:.2e} s or less, or leave it out (20 steps per contact)", time / 20.0),
        );
        let overlap = pair.largest_overlap(speed) / (2.0 * a.radius);
        verdict.judge(
            overlap <= 0.01,
            format!(
                "{label}: largest overlap / d = {overlap:.2e} (window 0.001 to 0.01{})",
                if overlap < 0.001 { "; stiffer than it need be, safe" } else { "" }
            ),
            || {
                format!(
                    "stiffen: {} by {:.1}, or lower `speed-scale`",
                    stiffness_key(plan, table.name(a.material), table.name(b.material)),
                    (overlap / 0.01).powf(2.5)
                )
            },
        );
        let depth = rest::overlap(plan, &pair, a);
        let pressed = pair.speed_of(depth);
        if pressed > speed {
            let steps = pair.contact_time(pressed) / dt;
            verdict.judge(
                steps >= 9.999,
                format!(
                    "{label}: a bed of all grains presses deeper than impacts do, d = {depth:.2e} m: {steps:.1} steps per contact (never below 10)"
                ),
                || format!("`dem.time-step` to {:.2e} s or less, or `speed-scale` to {pressed:.2} m/s", pair.contact_time(pressed) / 20.0),
            );
        }
        damping_stable(verdict, plan, &label, &pair, dt, speed, depth);
        film(verdict, &label, &pair, dt, speed);
    }
    idle::parts(verdict, plan, &table, &bodies);
    for (name, group) in &plan.particles {
        // A linear spring knows nothing of the modulus.
        let hertz = matches!(plan.contact_of(&group.material, &group.material).normal, Normal::Hertz {});
        if group.count == 0 || !hertz {
            continue;
        }
        let m = &plan.materials[&group.material];
        let density = group.mass / (std::f64::consts::PI / 6.0 * group.diameter.powi(3));
        let shear = m.young_modulus / (2.0 * (1.0 + m.poisson_ratio));
        let rayleigh = std::f64::consts::PI * 0.5 * group.diameter * (density / shear).sqrt()
            / (0.1631 * m.poisson_ratio + 0.8766);
        verdict.judge(
            dt <= 0.5 * rayleigh,
            format!(
                "{name}: Rayleigh time {rayleigh:.3e} s, step is {:.0} % of it (usual: 10 to 30 %, limit 50 %)",
                100.0 * dt / rayleigh
            ),
            || format!("`dem.time-step` to {:.2e} s or less", 0.3 * rayleigh),
        );
    }
}

/// Explicit dashpots: forward Euler gains energy when dt > eta/k; all schemes need a small eta dt / m, in an impact and, for
/// all contacts of a grain together, in a bed at rest.
fn damping_stable(
    verdict: &mut Verdict,
    plan: &Plan,
    label: &str,
    pair: &Pair,
    dt: f64,
    speed: f64,
    depth_at_rest: f64,
) {
    if pair.damping == 0.0 {
        return;
    }
    let depth = pair.largest_overlap(speed);
    let (eta, at_rest) = (pair.dashpot(depth), pair.dashpot(depth_at_rest));
    let (impact, bed) = (eta * dt / pair.mass, at_rest * dt / pair.mass);
    // A step that was chosen by one of the limits may lie on it.
    let within = |number: f64, limit: f64| number <= limit * (1.0 + 1e-9);
    verdict.judge(
        within(impact, IN_AN_IMPACT) && within(bed, IN_A_BED),
        format!(
            "{label}: dashpot number eta dt / m* = {impact:.3} in an impact (limit {IN_AN_IMPACT}), {bed:.3} in a bed at rest (limit {IN_A_BED})"
        ),
        || {
            let longest = rest::longest_step(pair, speed, depth_at_rest);
            format!("`dem.time-step` to {longest:.2e} s or less, or leave it out")
        },
    );
    if plan.dem.integrator == Integrator::ForwardEuler {
        let tangent = pair.constants.exponent * pair.stiffness * depth.powf(pair.constants.exponent - 1.0);
        let limit = eta / tangent;
        verdict.judge(
            dt <= limit,
            format!("{label}: forward Euler needs dt <= eta / k = {limit:.2e} s, else contacts gain energy"),
            || "`dem.integrator = \"velocity-verlet\"`".to_owned(),
        );
    }
}

/// The film of liquid between bodies: whether the step can bear it where it is thinnest, and what it leaves of an impact.
fn film(verdict: &mut Verdict, label: &str, pair: &Pair, dt: f64, speed: f64) {
    if pair.film == 0.0 {
        return;
    }
    let number = pair.film * dt / pair.mass;
    let stopped = pair.film_takes / pair.mass;
    let fate = if stopped < speed {
        format!("it takes {:.1} % of an approach at {speed:.3} m/s", 100.0 * stopped / speed)
    } else {
        format!("it stops an approach at {speed:.3} m/s before touch")
    };
    verdict.judge(
        number <= IN_A_FILM * (1.0 + 1e-9),
        format!("{label}: film number c dt / m* = {number:.3} at its roughness (limit {IN_A_FILM}); {fate}"),
        || {
            let longest = IN_A_FILM * pair.mass / pair.film;
            format!(
                "`dem.time-step` to {longest:.2e} s or less, or leave it out; or `contact.film.lubrication.roughness`"
            )
        },
    );
}

fn stiffness_key(plan: &Plan, material: &str, other: &str) -> String {
    match plan.contact_of(material, other).normal {
        Normal::Hertz {} => format!("`materials.{material}.young-modulus`"),
        Normal::Hooke { .. } if plan.pair(material, other).is_some_and(|pair| pair.contact.is_some()) => {
            format!("`contact.normal.hooke.stiffness` of the pair `{material}` and `{other}`")
        }
        Normal::Hooke { .. } => "`contact.normal.hooke.stiffness`".to_owned(),
    }
}

fn lattice(verdict: &mut Verdict, plan: &Plan, dt: f64, speed: f64) {
    let Some(cell) = plan.particles.values().map(|p| p.diameter).reduce(f64::min) else { return };
    let limit = cell / dt;
    verdict.judge(
        speed < 0.5 * limit,
        format!("lattice: cell {:.3} mm, speed limit {limit:.1} m/s (one cell a step)", 1e3 * cell),
        || format!("`lattice.time-step` to {:.2e} s or less", 0.5 * cell / speed),
    );
    let gravity = plan.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    if gravity > 0.0 {
        let quantum = gravity * dt;
        verdict.judge(
            quantum < 0.02 * speed,
            format!(
                "lattice: speed quantum g dt = {:.3} mm/s, {:.2} % of the speed scale",
                1e3 * quantum,
                100.0 * quantum / speed
            ),
            || format!("`lattice.time-step` to {:.2e} s or less", 0.01 * speed / gravity),
        );
    }
}

/// A time in the unit that suits it.
pub fn human_time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-6 => format!("{:.0} ns", s * 1e9),
        s if s < 1e-3 => format!("{:.1} us", s * 1e6),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// An amount of memory in the unit that suits it.
pub(super) fn human_memory(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.1} MB", bytes / 1e6) } else { format!("{:.2} GB", bytes / 1e9) }
}
