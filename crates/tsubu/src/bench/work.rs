//! The pieces of work that are measured.

use tsubu_scene::Scene;
use tsubu_scene::plan::{Plan, Start};

/// Name, and how to make it.
pub(super) type Work = (&'static str, fn() -> Plan);

/// All of them.
pub(super) static ALL: &[Work] = &[("chute", chute), ("bed", bed)];

/// Silbert et al. (2001): diameter, mass and gravity are one, 26 degrees.
const CHUTE: &str = r#"
dimension = 3
gravity = [0.4384, 0, -0.8988]
duration = 1
[materials.bead]
young-modulus = 1e6
friction = 0.5
[periodic]
x = [0, 40]
y = [0, 20]
[particles.base]
material = "bead"
count = 800
diameter = 1
mass = 1
motion.frozen = {}
start.rows = { spacing = 1, jitter = 0, region = { low = [0, 0, -1], high = [40, 20, 0] } }
[particles.flow]
material = "bead"
count = 8000
diameter = 1
mass = 1
start.rows = { region = { low = [0, 0, 0], high = [40, 20, 20] } }   # for the count; see `chute`
[contact]
normal.hooke.stiffness = 2e5
damping.rate.rate = 50
tangential.spring = { damping = 0 }
[dem]
time-step = 1e-4
skin = 0.1
largest-overlap = 0.5
"#;

/// Glass beads, soft ones, in a box.
const BED: &str = r#"
dimension = 3
duration = 1
[materials.glass]
density = 2500
young-modulus = 5e6
restitution = 0.7
friction = 0.5
[walls.box]
material = "glass"
shape.box = { width = 0.04, depth = 0.04, height = 0.2 }
[particles.beads]
material = "glass"
count = 10000
size.uniform = { smallest = 0.0018, largest = 0.0022 }
start.rows = { spacing = 1, jitter = 0 }
[dem]
time-step = 1e-5
skin = 0.1
largest-overlap = 0.5
"#;

fn plan(text: &str) -> Plan {
    let scene = Scene::parse("bench", text, std::path::Path::new("."), &[]);
    match scene {
        Ok(scene) => scene.plan().clone(),
        // A test runs every text; a mistake here cannot reach a user.
        Err(complaints) => unreachable!("{complaints}"),
    }
}

/// The flow as it runs after a while: speed grows from the ground up, as in a steady flow (Bagnold's profile).
fn chute() -> Plan {
    let mut plan = plan(CHUTE);
    let count = plan.particles.get("flow").map_or(0, |flow| flow.count);
    let (across, deep, high): (usize, usize, f64) = (38, 19, 8.0);
    let (mut position, mut velocity) = (Vec::new(), Vec::new());
    for k in 0..count {
        let (i, j, layer) = (k % across, k / across % deep, k / (across * deep));
        // Layers are shifted against each other, as spheres lie.
        let shift = if layer % 2 == 0 { 0.0 } else { 0.5 };
        let z = 0.5 + 0.68 * layer as f64;
        let pitch = [40.0 / across as f64, 20.0 / deep as f64];
        position.push([(i as f64 + 0.25 + shift) * pitch[0], (j as f64 + 0.25 + shift) * pitch[1], z]);
        let depth = (1.0 - z / high).max(0.0);
        velocity.push([3.0 * (1.0 - depth * depth.sqrt()), 0.0, 0.0]);
    }
    if let Some(flow) = plan.particles.get_mut("flow") {
        flow.start = Start::At { position, velocity, spin: Vec::new() };
    }
    plan
}

fn bed() -> Plan {
    plan(BED)
}
