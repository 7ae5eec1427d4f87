//! How far a bed expands that water carries: Richardson and Zaki (1954).

use super::beds::line;
use super::bench::{Rig, near};
use super::control::refused;
use crate::case::Judged;
use crate::origin::{closed_form, remembered};
use std::f64::consts::PI;
use tsubu_frame::Claim;

/// Grains of a bed, and the width of its periodic column [d].
const COUNT: f64 = 300.0;
const WIDTH: f64 = 5.0;
/// Of water and glass [kg/m^3], of gravity [m/s^2] and of the water's viscosity [m^2/s].
const WATER: f64 = 1000.0;
const GLASS: f64 = 2500.0;
const GRAVITY: f64 = 9.8;
const VISCOSITY: f64 = 1e-6;

/// Beads of one size, and how they hinder one another.
struct Beads {
    diameter: f64,
    young: &'static str,
    hindrance: &'static str,
}

impl Beads {
    /// Drag [N] by Schiller and Naumann, by Di Felice in a crowd of void fraction e, at the superficial velocity u, with what the
    /// gradient of the pressure adds.
    fn drag(&self, e: f64, u: f64) -> f64 {
        let re = u * self.diameter / VISCOSITY;
        let coefficient = if re > 1000.0 { 0.44 } else { 24.0 / re * (1.0 + 0.15 * re.powf(0.687)) };
        let b = 3.7 - 0.65 * (-0.5 * (1.5 - re.log10()).powi(2)).exp();
        coefficient * 0.5 * WATER * 0.25 * PI * self.diameter.powi(2) * u * u * e.powf(-b - 1.0)
    }

    /// Superficial velocity at which the drag is the weight under water; at e = 1 the terminal speed of one grain alone [m/s].
    fn carries(&self, e: f64) -> f64 {
        let weight = (GLASS - WATER) * GRAVITY * PI / 6.0 * self.diameter.powi(3);
        let (mut low, mut high) = (1e-6, 10.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if self.drag(e, middle) < weight { low = middle } else { high = middle }
        }
        low
    }

    /// Void fraction of the bed in water that rises with `velocity` [m/s], of a bed that is alike everywhere: twice the height of
    /// its centre is its own.
    fn expanded(&self, velocity: f64, perturbation: f64) -> Result<f64, String> {
        let d = self.diameter;
        let text = format!(
            r#"
            dimension = 3
            duration = "1 s"
            speed-scale = {speed}
            [materials.glass]
            young-modulus = "{young}"
            density = {GLASS}
            restitution = 0.3
            [particles.beads]
            material = "glass"
            count = {COUNT}
            diameter = {d}
            start.rows = {{ spacing = 1.15, jitter = 1, region = {{ low = [0, 0, 0], high = [{width}, {width}, {tall}] }} }}
            [walls.floor]
            material = "glass"
            shape.plane = {{ normal = "z" }}
            [periodic]
            x = [0, {width}]
            y = [0, {width}]
            [water]
            drag.schiller-naumann = {{}}
            hindrance = {{ {hindrance} }}
            flow.column = {{ bottom = 0, top = {top}, velocity = {velocity} }}
            "#,
            speed = self.carries(1.0),
            young = self.young,
            width = WIDTH * d,
            tall = 30.0 * d,
            top = 45.0 * d,
            hindrance = self.hindrance,
        );
        let mut rig = Rig::new(&text, perturbation)?;
        // Until disturbances have passed through the bed several times.
        let pass = 10.0 * d / velocity;
        rig.until(6.0 * pass)?;
        let (mut height, samples) = (0.0, 20);
        for i in 1..=samples {
            rig.until((6.0 + 0.3 * f64::from(i)) * pass)?;
            height += 2.0 * rig.engine.centre_of_mass()[2] / f64::from(samples);
        }
        Ok(1.0 - COUNT * PI / 6.0 * d / (WIDTH * WIDTH * height))
    }
}

/// Void fractions that a bed is to expand to.
const WANTED: [f64; 3] = [0.5, 0.6, 0.7];
const FINE: Beads = Beads { diameter: 0.3e-3, young: "20 kPa", hindrance: "di-felice = {}" };
const COARSE: Beads = Beads { diameter: 2e-3, young: "100 kPa", hindrance: "di-felice = {}" };

/// A bed in water that rises as fast as the law says for a void fraction: it comes to that within 2 %.
fn gate(beads: &Beads, wanted: f64, perturbation: f64) -> Result<(f64, Claim), String> {
    let velocity = beads.carries(wanted);
    let found = beads.expanded(velocity, perturbation)?;
    let name =
        format!("bed of {} mm beads in water that rises with {velocity:.4} m/s: void fraction", beads.diameter * 1e3);
    let source = closed_form("drag of Schiller and Naumann in a crowd by Di Felice = weight under water");
    Ok((found, near(name, found, wanted, 0.02, source)))
}

/// Fine beads: drag balances weight in the bed as it expands.
pub(super) fn balance(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for wanted in WANTED {
        claims.push(gate(&FINE, wanted, perturbation)?.1);
    }
    let free = Beads { hindrance: "richardson-zaki.exponent = 1", ..FINE };
    claims.push(refused("grains that hinder one another less", &[gate(&free, WANTED[1], perturbation)?.1], 1));
    Ok(claims)
}

/// u = u_0 e^n: the published exponent at the Reynolds number of one grain alone.
fn published(reynolds: f64) -> f64 {
    if reynolds > 500.0 { 2.4 } else { 4.4 * reynolds.powf(-0.1) }
}

/// Fine and coarse beads: the exponent is the published one, 10 %; the coarse ones keep the balance.
pub(super) fn exponents(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for beads in [FINE, COARSE] {
        let mut points = Vec::new();
        for wanted in WANTED {
            let (found, claim) = gate(&beads, wanted, perturbation)?;
            points.push((found.ln(), beads.carries(wanted).ln()));
            // Of fine beads `balance` claims it.
            claims.extend((beads.diameter > FINE.diameter).then_some(claim));
        }
        let reynolds = beads.carries(1.0) * beads.diameter / VISCOSITY;
        let name = format!("bed of {} mm beads: exponent of the expansion", beads.diameter * 1e3);
        let source = remembered("Richardson and Zaki 1954: 4.4 Re^-0.1 to Re = 500, 2.4 above; Re of one grain alone");
        claims.push(near(name, line(&points).0, published(reynolds), 0.1, source));
    }
    Ok(claims)
}
