//! Restitution at every kind of contact: equal and unequal grains, plane, cylinder, triangle.

use super::bench::{Rig, within};
use crate::case::Judged;
use crate::origin::{closed_form, other_program, printed};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

/// What is hit, and where the grain stands before it, in space, moving along -z.
const SHAPES: [(&str, &str); 5] = [
    (
        "an equal grain",
        "[particles.other]\nmaterial = \"acrylic\"\ndiameter = \"6 mm\"\nstart.at.position = [[0, 0, -6.01e-3]]",
    ),
    (
        "a grain twice as large",
        "[particles.other]\nmaterial = \"acrylic\"\ndiameter = \"12 mm\"\nstart.at.position = [[0, 0, -9.01e-3]]",
    ),
    ("a plane", "[walls.w]\nmaterial = \"acrylic\"\nshape.plane.point = [0, 0, -3.01e-3]"),
    (
        "a cylinder, inside",
        "[walls.w]\nmaterial = \"acrylic\"\nshape.cylinder = { point = [0, -1, 0.02699], axis = [0, 1, 0], radius = 0.03, length = 2 }",
    ),
    ("a triangle", "[walls.w]\nmaterial = \"acrylic\"\nshape.mesh = { path = \"triangle.obj\" }"),
];

/// A folder for a file that a scene reads, gone when done.
struct Folder(PathBuf);

impl Folder {
    fn with_triangle() -> Result<Self, String> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!("tsubu-verify-{}-{}", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).map_err(|e| e.to_string())?;
        let folder = Self(path);
        let text = "v -1 -1 -3.01e-3\nv 1 -1 -3.01e-3\nv 0 1 -3.01e-3\nf 1 2 3\n";
        std::fs::write(folder.0.join("triangle.obj"), text).map_err(|e| e.to_string())?;
        Ok(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind in the temporary folder harms nobody.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn impact(
    folder: &Folder,
    shape: &str,
    law: &str,
    restitution: f64,
    steps: u32,
    perturbation: f64,
) -> Result<[f64; 2], String> {
    let text = format!(
        r#"
        title = "one impact"
        dimension = 3
        gravity = 0
        duration = "10 ms"
        speed-scale = 1
        [materials.acrylic]
        young-modulus = "0.5 GPa"
        restitution = {restitution}
        density = 1768
        [particles.ball]
        material = "acrylic"
        diameter = "6 mm"
        start.at = {{ position = [[0, 0, 0]], velocity = [[0, 0, -1]] }}
        {shape}
        [contact]
        tangential.none = {{}}
        {law}
        [dem]
        steps-per-contact = {steps}
        "#
    );
    let mut rig = Rig::in_folder(&text, &folder.0, perturbation)?;
    rig.impact()?;
    let v = rig.vectors("velocity");
    Ok([v[0].z - v.get(1).map_or(0.0, |v| v.z), rig.residual()])
}

/// V-05: the restitution that was asked for comes back within 1e-3, whatever the other body is.
pub(super) fn restitution(perturbation: f64) -> Judged {
    let folder = Folder::with_triangle()?;
    // A linear dashpot jumps at first touch: its error falls with the step, not with its square.
    let forms = [
        ("sqrt", "damping.sqrt = {}", 200),
        ("quarter", "damping.quarter = {}", 200),
        ("quarter, attraction", "damping.quarter = {}\nattraction = true", 200),
        ("linear", "damping.linear = {}", 2000),
        ("hooke + linear", "normal.hooke = { stiffness = 1e5 }\ndamping.linear = {}", 2000),
    ];
    let mut claims = Vec::new();
    for (shape, entry) in SHAPES {
        for (form, law, steps) in forms {
            for e in [0.9, 0.3] {
                let [value, _] = impact(&folder, entry, law, e, steps, perturbation)?;
                let source = closed_form("definition; coefficients: Antypov and Elliott 2011, Thornton et al. 2013");
                claims.push(within(format!("restitution {e} by {form}, {shape}"), value, e, 1e-3, source));
            }
        }
        let [_, residual] = impact(&folder, entry, "", 0.7, 20, perturbation)?;
        let name = format!("impact on {shape}: energy residual at the default step");
        claims.push(within(name, residual, 0.0, 1e-3, closed_form("conservation of energy")));
    }
    Ok(claims)
}

/// V-05: the coefficient found for contacts without attraction is that of the published polynomial (0.1 <= e <= 0.9).
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(super) fn thornton(perturbation: f64) -> Judged {
    use tsubu::contact::calibrate;
    let published = |e: f64| {
        let h = [
            -6.918_798, -16.411_05, 146.8049, -796.4559, 2928.711, -7206.864, 11494.29, -11342.18, 6276.757, -1489.915,
        ];
        let series = h.iter().rev().fold(0.0, |sum, h| (sum + h) * e);
        (1.0 / (1.0 - (1.0 + e).powi(2) * series.exp()) - 1.0).sqrt()
    };
    let mut claims = Vec::new();
    for e in [0.1, 0.3, 0.5, 0.7, 0.9] {
        // Dashpot 2 gamma sqrt(m dF/dd), with dF/dd = 3/2 k sqrt(d).
        let beta = 2.0 * published(e) * 1.5f64.sqrt() * perturbation;
        let value = calibrate::restitution(beta, 1.5, 0.25, false);
        let source = printed("polynomial of Thornton, Cummins, Cleary 2013, good to 3e-4");
        claims.push(within(
            format!("restitution {e} with the published coefficient, no attraction"),
            value,
            e,
            1e-3,
            source,
        ));
    }
    for (e, apparent) in [(0.9, 0.9020), (0.75, 0.7626), (0.7, 0.7182), (0.5, 0.5503), (0.3, 0.3971)] {
        for (law, p, q) in [("linear", 1.0, 0.0), ("Hertz and quarter", 1.5, 0.25)] {
            let beta = calibrate::coefficient(e, p, q, true) * perturbation;
            let value = calibrate::restitution(beta, p, q, false);
            let source = other_program("independent integration; Schwager and Poeschel 2007");
            let name = format!("restitution {e} asked with attraction, {law}, attraction cut");
            claims.push(within(name, value, apparent, 1e-3, source));
        }
    }
    Ok(claims)
}
