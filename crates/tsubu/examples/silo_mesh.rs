//! Writes the silo of `studies/open-dem-benchmark` as a Wavefront OBJ: cylinder, 45 degree cone, orifice; one mesh, so
//! that a grain near the joint feels one wall.
//!
//! ```sh
//! cargo run --example silo_mesh -- 0.020 > studies/open-dem-benchmark/silo-small.obj
//! ```
//!
//! Arguments: radius of the orifice [m]; then, if need be, the number of segments.

use std::f64::consts::TAU;
use std::io::Write;

/// Radius and height of the cylinder [m].
const RADIUS: f64 = 0.100;
const HEIGHT: f64 = 0.300;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let orifice: f64 = words.next().ok_or("give the radius of the orifice in metres")?.parse()?;
    let segments: usize = words.next().map_or(Ok(72), |word| word.parse())?;
    // Heights as in the published set-up: the cone's apex would lie at -0.0793 m or -0.0854 m.
    let top = if orifice < 0.025 { 0.0207 } else { 0.0146 };
    let rings = [(top + HEIGHT, RADIUS), (top, RADIUS), (top - (RADIUS - orifice), orifice)];
    // Polygons as large as the circles they stand for.
    let angle = TAU / segments as f64;
    let swell = (angle / angle.sin()).sqrt();
    let mut out = std::io::stdout().lock();
    writeln!(out, "# silo, orifice radius {orifice} m, {segments} segments; from crates/tsubu/examples/silo_mesh.rs")?;
    for (z, radius) in rings {
        for k in 0..segments {
            let (sine, cosine) = (angle * k as f64).sin_cos();
            writeln!(out, "v {:.9} {:.9} {z:.6}", radius * swell * cosine, radius * swell * sine)?;
        }
    }
    for ring in 0..2 {
        for k in 0..segments {
            let (above, below) = (ring * segments + 1, (ring + 1) * segments + 1);
            let next = (k + 1) % segments;
            writeln!(out, "f {} {} {}", above + k, below + k, below + next)?;
            writeln!(out, "f {} {} {}", above + k, below + next, above + next)?;
        }
    }
    Ok(())
}
