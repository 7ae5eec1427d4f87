//! Bodies that meet in a liquid (V-56).

use super::bench::{Rig, near, within};
use super::control::{refused, refused_number};
use crate::case::Judged;
use crate::origin::{closed_form, remembered};
use std::f64::consts::PI;
use tsubu::view::Wants;
use tsubu_frame::Claim;

/// Radius [m], what an impact moves with the water taken along [kg], the dry restitution, the speed of approach [m/s], and the film.
const R: f64 = 1e-3;
const MOVED: f64 = (2650.0 + 500.0) * 4.0 / 3.0 * PI * 1e-9;
const DRY: f64 = 0.97;
const SPEED: f64 = 0.5;
const ROUGHNESS: f64 = 2e-6;
const REACH: f64 = 2e-4;

/// What a film takes of the momentum on the way in, over 6 pi mu R^2: ln(reach/roughness) + 1.
fn takes() -> f64 {
    (REACH / ROUGHNESS).ln() + 1.0
}

/// Viscosity [m^2/s] at which the Stokes number (sigma + rho/2) v d/(9 rho nu) is `number`.
fn viscosity(number: f64) -> f64 {
    MOVED / (4.0 / 3.0 * PI * R.powi(3)) * SPEED * 2.0 * R / (9.0 * 1000.0 * number)
}

/// What became of an approach.
struct Rebound {
    /// Speeds down at touch, and up behind the film [m/s].
    touch: f64,
    up: f64,
    /// Energy residual over the energy turned over.
    missing: f64,
}

/// A grain that comes down onto a floor from beyond the film, no force but the film's and the contact's.
fn rebound(viscosity: f64, stiffness: &str, rest: &str, perturbation: f64) -> Result<Rebound, String> {
    let text = format!(
        r#"
        dimension = 3
        duration = 1
        gravity = 0
        speed-scale = {SPEED}
        [materials.quartz]
        young-modulus = "{stiffness}"
        density = "2650 kg/m^3"
        restitution = {DRY}
        [particles.grain]
        material = "quartz"
        diameter = {diameter}
        start.at = {{ position = [[0, 0, {height}]], velocity = [[0, 0, -{SPEED}]] }}
        [walls.floor]
        material = "quartz"
        shape.plane = {{ point = [0, 0, 0], normal = "z" }}
        [water]
        viscosity = {viscosity}
        drag.none = {{}}
        {rest}
        "#,
        diameter = 2.0 * R,
        height = R + 1.2 * REACH,
    );
    let mut rig = Rig::new(&text, perturbation)?;
    let look = |rig: &Rig| {
        let view = rig.engine.view(Wants::GRAINS);
        (view.grains.position[0].z - R, view.grains.velocity[0].z)
    };
    let longest = (200.0 * REACH / SPEED / rig.engine.time_step()) as u64;
    let (mut touch, mut up, mut touching) = (0.0, 0.0, 0);
    for _ in 0..longest {
        rig.steps(1)?;
        let (gap, velocity) = look(&rig);
        touching += u32::from(gap <= 0.0);
        // The second half of the last kick of the film comes in the step after touch; the contact is still slack then.
        if touching == 2 && touch == 0.0 {
            touch = -velocity;
        }
        if gap > 1.1 * REACH && velocity > 0.0 {
            up = velocity;
            break;
        }
    }
    Ok(Rebound { touch, up, missing: rig.residual().abs() })
}

/// V-56: what a film takes of an approach, and what it leaves of a rebound.
pub(super) fn rebounds(perturbation: f64) -> Judged {
    let (soft, hard) = ("0.5 MPa", "5 MPa");
    let film = "[contact]\nfilm.lubrication = {}";
    let (mut claims, mut missing) = (Vec::new(), 0.0f64);
    for dt in ["1e-7", "1e-6", "4e-6"] {
        let rest = format!("{film}\ndamping.none = {{}}\n[dem]\ntime-step = {dt}");
        let found = rebound(1e-6, soft, &rest, perturbation)?;
        missing = missing.max(found.missing);
        let lost = SPEED - found.touch;
        let gate = |factor: f64| {
            let name = format!("a film on the way in, steps of {dt} s: speed it takes [m/s]");
            let wanted = factor * 6.0 * PI * 1e-3 * R * R / MOVED * takes();
            near(name, lost, wanted, 0.01, closed_form("6 pi mu R*^2/m (ln(h_0/h_r) + 1), Reynolds 1886"))
        };
        claims.push(gate(1.0));
        claims.push(refused_number("the factor of two equal spheres", &[gate(0.25)], 1));
    }
    let mut wet = |number: f64, stiffness: &str, rest: &str| {
        let found = rebound(viscosity(number), stiffness, rest, perturbation)?;
        missing = missing.max(found.missing);
        Ok::<f64, String>(found.up / SPEED)
    };
    let name = |number: f64| format!("wet restitution, Stokes number {number}");
    let published =
        remembered("Joseph, Zenit, Hunt and Rosenwinkel 2001: none up to about 10, the dry one from about 1000 on");
    claims.push(within(name(8.0), wet(8.0, hard, film)?, 0.0, 1e-9, published));
    for number in [30.0, 100.0] {
        let wanted = DRY - (1.0 + DRY) * takes() / number;
        let gate = |stiffness: &str, found: f64| {
            let name = format!("{}, {stiffness}", name(number));
            within(
                name,
                found,
                wanted,
                0.01,
                closed_form("e - (1 + e) (ln(h_0/h_r) + 1)/St: the film takes as much on both ways"),
            )
        };
        for stiffness in [hard, soft] {
            claims.push(gate(stiffness, wet(number, stiffness, film)?));
        }
        let through = wet(number, soft, "[contact]\nfilm.lubrication.in-contact = true")?;
        claims.push(refused("a film that goes on through a soft contact", &[gate(soft, through)], 1));
    }
    let gate = |found: f64| Claim::judge(name(1000.0), found, Some(0.97 * DRY), Some(DRY), published);
    claims.push(gate(wet(1000.0, hard, film)?));
    claims.push(refused("a film ten times as viscous", &[gate(wet(100.0, hard, film)?)], 1));
    let source = closed_form("the ledger closes to 1e-3");
    claims.push(Claim::judge("energy that the books of these impacts miss", missing, None, Some(1e-3), source));
    Ok(claims)
}
