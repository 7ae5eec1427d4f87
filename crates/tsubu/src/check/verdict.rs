//! The verdict: is this scene resolved well enough, and what will it cost?

use super::rest::{self, IN_A_BED, IN_A_FILM, IN_AN_IMPACT};
use super::{bodies, bonds, clump, idle, mesh, opening, shortest_period, speed_scale, water};
use crate::contact::{Pair, Table};
use crate::engine::{Engine, Fault, Verdict as Noted};
use crate::memory::{self, human_memory};
use crate::partner::Hosts;
use std::fmt;
use tsubu_frame::{Advise, Hint};
use tsubu_scene::plan::{Integrator, Method, Plan};

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

    /// This verdict and that on another stage of the run.
    #[must_use]
    pub fn with(mut self, stage: Option<&str>, other: Self) -> Self {
        let named = |text: String| stage.map_or_else(|| text.clone(), |stage| format!("stage {stage}: {text}"));
        self.lines.extend(other.lines.into_iter().map(|line| Line { text: named(line.text), ..line }));
        self.fails |= other.fails;
        self
    }

    pub(crate) fn say(&mut self, text: String) {
        self.lines.push(Line { good: true, text, advice: String::new() });
    }

    /// Adds a warning.
    pub fn warn(&mut self, text: impl Into<String>, advice: impl Into<String>) {
        self.lines.push(Line { good: false, text: text.into(), advice: advice.into() });
    }

    /// The other lines say why; without them the user would be left with the blow-up alone.
    pub(crate) fn fail(&mut self, what: &str, fault: &Fault) {
        let hint = fault.hints().first().map_or_else(|| "what the warnings above name".to_owned(), Hint::to_string);
        self.judge(false, format!("{what}: {fault}"), || hint);
        self.fails = true;
    }

    pub(crate) fn judge(&mut self, good: bool, text: String, advice: impl FnOnce() -> String) {
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
            bonded(&mut verdict, plan, dt);
        }
        Method::Lattice => lattice(&mut verdict, plan, dt, speed),
        // Grains that move where there is room know no contact time.
        Method::ClCa
        | Method::Litwiniszyn
        | Method::AfterCaramHong
        | Method::AfterSavage
        | Method::GuttHaff
        | Method::AfterHemmingssonHerrmann
        | Method::Fhp
        | Method::AfterPengHerrmann
        | Method::AfterBaxterBehringer
        | Method::AfterKarolyiKertesz => {}
    }
    mesh::meshes(&mut verdict, plan);
    opening::cones(&mut verdict, plan);
    clump::packings(&mut verdict, plan);
    clump::cells(&mut verdict, plan);
    idle::gates(&mut verdict, plan);
    let period = shortest_period(hosts);
    if period.is_finite() {
        let steps = period / dt;
        verdict.judge(
            steps >= 50.0,
            format!("host: shortest natural period {period:.4e} s, {steps:.0} steps a period (wanted: 50 or more)"),
            || format!("shorten `{}` to {:.2e} s or less", engine.step_key(), period / 50.0),
        );
    }
    structures(&mut verdict, plan, hosts);
    idle::outputs(&mut verdict, plan);
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

/// A structure lighter than its grains is seldom meant: matrices and modes come from programs that calculate in units of their own.
fn structures(verdict: &mut Verdict, plan: &Plan, hosts: &Hosts) {
    let grains = plan.grain_mass();
    for ((name, planned), host) in plan.hosts.iter().zip(&hosts.list) {
        let Some([frequency, mass]) = host.livest_mode() else { continue };
        verdict.judge(
            grains <= mass,
            format!("host {name}: moves most in a mode of {frequency:.4} Hz and {mass:.3e} kg; the grains weigh {grains:.3e} kg"),
            || format!("units of [hosts.{name}.structure], if it is not as light as that: was it calculated in tonnes and millimetres?"),
        );
        let driven = planned.period().map(|period| 1.0 / period);
        if let Some(driven) = driven.filter(|driven| !(1e-3..=1e3).contains(&(driven / frequency))) {
            verdict.judge(
                false,
                format!(
                    "host {name}: it is driven at {driven:.4} Hz, and its mode that moves most is at {frequency:.3e} Hz"
                ),
                || format!("units of [hosts.{name}.structure]; or are mass and stiffness exchanged?"),
            );
        }
    }
}

fn bonded(verdict: &mut Verdict, plan: &Plan, dt: f64) {
    let period = bonds::shortest_period(plan);
    if period.is_finite() {
        verdict.judge(
            period / dt >= 9.999,
            format!("bonds: grains vibrate in {period:.3e} s or slower, {:.1} steps a period (never below 10, good from 20)", period / dt),
            || format!("`dem.time-step` to {:.2e} s or less, or leave it out (20 steps a period)", period / 20.0),
        );
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
        let overlap = pair.largest_overlap(speed) / (2.0 * a.size);
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
        if a.radius < a.size {
            let (share, limit) = (pair.largest_overlap(speed) / (2.0 * a.radius), plan.dem.largest_overlap);
            verdict.judge(
                share <= limit,
                format!("{label}: largest overlap / twice the radius of rounded edges = {share:.2e} (the run stops at {limit})"),
                || "`dem.largest-overlap`, or round the edges more".to_owned(),
            );
        }
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
        // A spring of a told stiffness knows nothing of the modulus.
        let told = plan.contact_of(&group.material, &group.material).normal.stiffness();
        if group.count == 0 || told.is_some() {
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
    let (eta, at_rest) = (pair.damping_coefficient(depth), pair.damping_coefficient(depth_at_rest));
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
    let normal = &plan.contact_of(material, other).normal;
    if normal.stiffness().is_none() {
        return format!("`materials.{material}.young-modulus`");
    }
    let own = plan.pair(material, other).is_some_and(|pair| pair.contact.is_some());
    let whose = if own { format!(" of the pair `{material}` and `{other}`") } else { String::new() };
    format!("`contact.normal.{}.stiffness`{whose}", normal.name())
}

fn lattice(verdict: &mut Verdict, plan: &Plan, dt: f64, speed: f64) {
    let Some(diameter) = plan.particles.values().map(|p| p.diameter).reduce(f64::min) else { return };
    let cell = plan.lattice.spacing(diameter);
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
