//! Sliding and rolling on a plane.

use super::bench::{Rig, near, within};
use crate::case::Judged;
use crate::origin::{closed_form, own, printed};
use tsubu::ledger::Account;
use tsubu_frame::Claim;

const G: f64 = 9.8;
const RADIUS: f64 = 5e-3;
const MASS: f64 = 1e-3;
/// Stiffness [N/m]: a weight presses 1e-5 of the radius.
const STIFFNESS: f64 = MASS * G / (1e-5 * RADIUS);

const SPHERE: (&str, &str, f64) = ("sphere", "sphere = {}", 0.4);
const DISC: (&str, &str, f64) = ("disc", "disc = { thickness = 1e-3 }", 0.5);

/// What rolls, how it starts, and on what slope [rad].
struct Start<'a> {
    shape: &'a str,
    slope: f64,
    friction: f64,
    rolling: f64,
    speed: f64,
    spin: f64,
    law: &'a str,
    duration: f64,
}

impl Start<'_> {
    fn rig(&self, perturbation: f64) -> Result<Rig, String> {
        let Self { shape, slope, friction, rolling, speed, spin, law, duration } = self;
        let text = format!(
            r#"
            title = "a grain on a plane"
            gravity = [{gx}, {gz}]
            duration = {duration}
            [materials.hard]
            young-modulus = 1e9
            restitution = 0.1
            friction = {friction}
            rolling-friction = {rolling}
            [particles.grain]
            material = "hard"
            diameter = {diameter}
            mass = {MASS}
            shape.{shape}
            start.at = {{ position = [[0, {height}]], velocity = [[{speed}, 0]], spin = [{spin}] }}
            [walls.plane]
            material = "hard"
            shape.plane = {{}}
            [contact]
            normal.hooke = {{ stiffness = {STIFFNESS} }}
            damping.linear = {{}}
            {law}
            "#,
            // What rolls without slip knows no constant of the law: the perturbation acts on gravity too.
            gx = G * perturbation * slope.sin(),
            gz = -G * perturbation * slope.cos(),
            diameter = 2.0 * RADIUS,
            height = RADIUS * (1.0 - 1e-5),
        );
        Rig::new(&text, perturbation)
    }
}

const PLAIN: Start<'static> = Start {
    shape: SPHERE.1,
    slope: 0.0,
    friction: 0.3,
    rolling: 0.0,
    speed: 0.0,
    spin: 0.0,
    law: "tangential.spring = {}",
    duration: 1.0,
};

fn books(name: &str, rig: &Rig) -> Claim {
    within(
        format!("{name}: energy residual at the default step"),
        rig.residual(),
        0.0,
        1e-3,
        closed_form("conservation of energy"),
    )
}

/// V-20: a sliding grain comes to roll.
pub(super) fn slide_to_roll(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let (mu, u0) = (0.3, 1.0);
    for (name, shape, share) in [SPHERE, DISC] {
        let end = u0 / (1.0 + share);
        let time = (u0 - end) / (mu * G);
        let distance = 0.5 * (u0 + end) * time;
        let mut rig = Start { shape, speed: u0, friction: mu, ..PLAIN }.rig(perturbation)?;
        let source = closed_form("closed form");
        // Half way it still slides.
        rig.until(0.5 * time)?;
        let half = 0.5 * (u0 + end);
        claims.push(near(format!("slide to roll, {name}: speed half way m/s"), rig.speed(), half, 2e-3, source));
        while rig.speed() - rig.vector("spin", 0).y * RADIUS > 1e-3 * u0 && rig.engine.time() < 2.0 * time {
            rig.steps(1)?;
        }
        claims.push(near(format!("slide to roll, {name}: time s"), rig.engine.time(), time, 5e-3, source));
        let went = rig.vector("position", 0).x;
        claims.push(near(format!("slide to roll, {name}: distance m"), went, distance, 5e-3, source));
        rig.until(1.5 * time)?;
        claims.push(near(format!("slide to roll, {name}: speed after m/s"), rig.speed(), end, 1e-3, source));
        claims.push(books(&format!("slide to roll, {name}"), &rig));
    }
    Ok(claims)
}

/// V-21: down a slope, with and without slip.
pub(super) fn incline(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (name, shape, share) in [SPHERE, DISC] {
        // It rolls without slip up to tan(slope) = (1 + 1/share) mu.
        let limit = 1.0 + 1.0 / share;
        for (what, mu) in [("rolls", 0.3), ("slips", 0.1)] {
            let slope = (0.5 * (0.3 + 0.1) * limit).atan();
            let closed =
                if what == "rolls" { G * slope.sin() / (1.0 + share) } else { G * (slope.sin() - mu * slope.cos()) };
            let mut rig = Start { shape, slope, friction: mu, ..PLAIN }.rig(perturbation)?;
            rig.until(0.1)?;
            let (v, t) = (rig.speed(), rig.engine.time());
            rig.until(0.3)?;
            let value = (rig.speed() - v) / (rig.engine.time() - t);
            let name = format!("slope of {:.1} degrees, {name} {what}", slope.to_degrees());
            claims.push(near(format!("{name}: acceleration m/s^2"), value, closed, 2e-3, closed_form("closed form")));
            if what == "rolls" {
                let slip = (rig.speed() - rig.vector("spin", 0).y * RADIUS) / rig.speed();
                claims.push(within(format!("{name}: slip over speed"), slip, 0.0, 1e-3, closed_form("closed form")));
            }
            claims.push(books(&name, &rig));
        }
    }
    Ok(claims)
}

/// V-22: rolling resistance alone slows a spin at a constant rate; V-24: Osada's torque, and its energy.
pub(super) fn spin_down(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let (mu_r, w0, time) = (0.05, 100.0, 0.2);
    let laws = ["rolling.constant = {}", "rolling.epsd = {}", "rolling.spring = { stiffness = 1e4, damping = 0.1 }"];
    for law in laws {
        let law = format!("tangential.none = {{}}\n{law}");
        let name = law.lines().last().unwrap_or_default().split([' ', '=']).next().unwrap_or_default().to_owned();
        let mut rig = Start { rolling: mu_r, spin: w0, law: &law, ..PLAIN }.rig(perturbation)?;
        rig.until(time)?;
        let closed = 2.5 * mu_r * G / RADIUS;
        let value = (w0 - rig.vector("spin", 0).y) / rig.engine.time();
        claims.push(near(format!("spin-down, {name}: rate rad/s^2"), value, closed, 2e-3, closed_form("closed form")));
        claims.push(books(&format!("spin-down, {name}"), &rig));
    }
    let factor = 0.5;
    let law = "tangential.none = {}\nrolling.contact-width = {}";
    let mut rig = Start { rolling: factor, spin: w0, law, ..PLAIN }.rig(perturbation)?;
    rig.until(0.02)?;
    let (w, t, lost) = (rig.vector("spin", 0).y, rig.engine.time(), rig.flow(Account::Rolling));
    rig.until(0.05)?;
    let width = 2.0 * (2.0 * RADIUS * 1e-5 * RADIUS).sqrt();
    let torque = factor * width * MASS * G;
    let elapsed = rig.engine.time() - t;
    let end = rig.vector("spin", 0).y;
    let source = printed("Osada 2004, f = f' b");
    let closed = torque / (0.4 * MASS * RADIUS * RADIUS);
    claims.push(near("spin-down, contact width: rate rad/s^2", (w - end) / elapsed, closed, 2e-3, source));
    let angle = 0.5 * (w + end) * elapsed;
    let spent = (rig.flow(Account::Rolling) - lost) / angle;
    claims.push(near("spin-down, contact width: energy lost per angle J", spent, torque, 2e-3, source));
    Ok(claims)
}

/// V-23: a rolling grain stops where it must, and stays there; models that cannot hold a slope creep as they say.
pub(super) fn models(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    let (mu_r, v0) = (0.1, 0.3);
    let slowing = mu_r * G / 1.4;
    let stop = v0 * v0 / (2.0 * slowing);
    for (model, law) in [("A (constant)", "rolling.constant = {}"), ("C (EPSD)", "rolling.epsd = {}")] {
        let law = format!("tangential.spring = {{}}\n{law}");
        let mut rig = Start { friction: 0.6, rolling: mu_r, speed: v0, spin: v0 / RADIUS, law: &law, ..PLAIN }
            .rig(perturbation)?;
        rig.until(2.0 * v0 / slowing)?;
        let source = closed_form("closed form: mu_r g / (7/5)");
        let went = rig.vector("position", 0).x;
        claims.push(near(format!("rolling model {model}: distance to rest m"), went, stop, 0.01, source));
        let mut fastest = 0.0f64;
        for _ in 0..500 {
            rig.steps(1)?;
            fastest = fastest.max(rig.speed().abs());
        }
        let source = own("at rest, without chatter").after();
        claims.push(within(format!("rolling model {model}: speed at rest m/s"), fastest, 0.0, 1e-5, source));
        claims.push(books(&format!("rolling model {model}"), &rig));
    }
    // On a slope of a quarter of the limit.
    let slope = (0.25 * mu_r).atan();
    for (shape, entry, _) in [SPHERE, DISC] {
        let start = |law, rolling| Start { shape: entry, slope, friction: 0.6, rolling, law, duration: 2.0, ..PLAIN };
        for (model, law) in [
            ("C (EPSD)", "tangential.spring = {}\nrolling.epsd = {}"),
            ("EPSD2", "tangential.spring.damping = 1\nrolling.epsd2 = {}"),
        ] {
            let mut rig = start(law, mu_r).rig(perturbation)?;
            rig.until(0.5)?;
            let at = rig.vector("position", 0).x;
            rig.until(1.0)?;
            let name = format!("rolling model {model} on a slope, {shape}: creep in 0.5 s over radius");
            let moved = (rig.vector("position", 0).x - at) / RADIUS;
            claims.push(within(name, moved, 0.0, 1e-6, closed_form("it holds where tan(slope) < mu_r")));
        }
    }
    let tangential = "tangential.spring = {}";
    let law = format!("{tangential}\nrolling.constant.smoothing-speed = 1e-2");
    let mut rig = Start { slope, friction: 0.6, rolling: mu_r, law: &law, ..PLAIN }.rig(perturbation)?;
    rig.until(1.0)?;
    let source = closed_form("its own formula: it creeps at v_eps tan(slope) / mu_r");
    claims.push(near("rolling model A on a slope: creep m/s", rig.speed(), 1e-2 * 0.25, 0.01, source));
    let law = format!("{tangential}\nrolling.viscous.coefficient = 5");
    let mut rig = Start { slope, friction: 0.6, rolling: mu_r, law: &law, ..PLAIN }.rig(perturbation)?;
    rig.until(3.0)?;
    let source = closed_form("its own formula: it does not hold a slope, but rolls at tan(slope) / (mu_r c)");
    claims.push(near("rolling model B on a slope: speed m/s", rig.speed(), 0.25 / 5.0, 0.01, source));
    Ok(claims)
}
