//! From a plan to the automaton: what it honours, what it approximates and by how much, and what it refuses.

mod casing;

use super::damper::{Beyond, Damper, Rules};
use super::fixed::{Restitution, Scale};
use super::remarks::{Pull, Remarks, World};
use super::shape::Shape;
use super::start;
use crate::engine::{Note, Refusal};
use crate::view::Wants;
use casing::{Casing, casing, check_carrier, place};
use tsubu_scene::plan::{self, Collision, LatticeMode, ObliqueGravity, Plan, Rolling, Tangential};

/// Everything that the engine needs from a plan.
pub(super) struct Built {
    pub damper: Damper,
    pub notes: Vec<Note>,
    /// Name of the wall that is the box.
    pub wall: String,
    pub dt: f64,
    /// Mass of a ball [kg].
    pub mass: f64,
    /// Radius of a ball [m].
    pub radius: f64,
    /// The box at level 0, and the cells of a ball.
    pub geometry: start::Geometry,
}

/// The balls' common properties.
struct BallKind<'a> {
    material: &'a str,
    diameter: f64,
    mass: f64,
    count: usize,
}

/// Takes the plan apart, every field by name, so that a new field does not compile until it has been decided on here.
pub(super) fn build(plan: &Plan) -> Result<Built, Refusal> {
    let Plan {
        title: _,
        method: _,
        dimension: _, // As gravity, periodic and water: read by `Remarks::world`.
        seed,
        gravity,
        duration: _,
        speed_scale: _, // Only chooses DEM's step.
        materials: _,   // Read pair by pair in `restitution`.
        material_pair,
        particles: _,
        walls: _,
        periodic: _,
        removal,
        water: _,
        hosts,
        contact,
        bond: _,
        dem: _,
        lattice,
        cl_ca: _,
        litwiniszyn: _,
        after_caram_hong: _,
        after_savage: _,
        gutt_haff: _,
        after_hemmingsson_herrmann: _,
        fhp: _,
        after_peng_herrmann: _,
        after_baxter_behringer: _,
        after_karolyi_kertesz: _,
        response: _,
        atlas: _,
        design: _,
        calibrate: _,
        sweep: _,
        watch,
        output: _,
        start_from: _, // Of the run, as its stages.
        start_fingerprint: _,
        start_at_zero: _,
        stage: _,
        claim: _,
    } = plan;
    let mut remarks = Remarks::of("lattice");
    remarks.world(plan, World { noun: "the automaton's balls", gravity: Pull::DownOrNone, periodic: [false; 2] });
    if !removal.is_empty() {
        remarks.refuse("removal", "the automaton keeps its balls; use `method = \"dem\"`");
    }
    let casing = casing(plan, &mut remarks);
    let kind = kind(plan, &mut remarks);
    remark_contact(contact, None, plan, &mut remarks);
    for (index, pair) in material_pair.iter().enumerate() {
        if let Some(own) = &pair.contact {
            remark_contact(own, Some((index, contact)), plan, &mut remarks);
        }
    }
    remarks.watches(watch, plan, Wants::GRAINS);
    let (Some(casing), Some(kind)) = (casing, kind) else {
        return Err(remarks.refusal().unwrap_or(Refusal { method: "lattice", notes: Vec::new() }));
    };
    check_carrier(&casing, &kind, hosts, lattice, &mut remarks);
    let shape = Shape::hexagon(lattice.ball_radius);
    let spacing = lattice.spacing(kind.diameter);
    let place = place(&casing, &kind, spacing, lattice, &mut remarks);
    let scale = scale(spacing, -gravity[2], lattice, &mut remarks);
    let rules = rules(plan, &casing, &kind, *seed, &scale);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    let geometry = start::Geometry { spacing, floor_centre: casing.floor_centre, place, shape };
    let balls = start::place(plan, &geometry, &scale, &mut remarks);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    let damper = Damper::new(scale, rules, place, geometry.shape.clone(), &balls);
    remark_reach(&damper, scale, lattice, &mut remarks);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    Ok(Built {
        damper,
        notes: remarks.notes,
        wall: casing.name.to_owned(),
        dt: lattice.time_step,
        mass: kind.mass,
        radius: 0.5 * kind.diameter,
        geometry,
    })
}

/// Refuses what whole numbers cannot hold.
fn remark_reach(damper: &Damper, scale: Scale, lattice: &plan::Lattice, remarks: &mut Remarks) {
    match damper.within_reach() {
        Ok(()) => {}
        Err(Beyond::Cell) => remarks.refuse(
            "particles",
            format!(
                "a ball begins faster than {:.4} m/s, a cell a step, which is as fast as balls move; shorten `lattice.time-step`, or begin slower",
                scale.cell as f64 * scale.speed
            ),
        ),
        Err(Beyond::Books) => remarks.refuse(
            "lattice.time-step",
            format!(
                "{} s is so short that whole numbers cannot hold the energy of the balls in units of (g dt / 1024)^2; lengthen it",
                lattice.time_step
            ),
        ),
    }
}

/// The one kind of ball.
fn kind<'a>(plan: &'a Plan, remarks: &mut Remarks) -> Option<BallKind<'a>> {
    let mut groups = plan.particles.iter();
    let Some((first_name, first)) = groups.next() else {
        // An empty box is what every response curve is compared with; cells still need a size.
        let wall = plan.walls.values().next()?;
        let plan::Shape::Box { width, .. } = wall.shape else { return None };
        return Some(BallKind { material: &wall.material, diameter: width / 10.0, mass: 0.0, count: 0 });
    };
    let mut count = first.count;
    for (name, group) in &plan.particles {
        refuse_group(name, group, remarks);
    }
    for (name, group) in groups {
        for (key, value, common) in [("diameter", group.diameter, first.diameter), ("mass", group.mass, first.mass)] {
            if value != common {
                remarks.refuse(
                    format!("particles.{name}.{key}"),
                    format!(
                        "{value} differs from the {common} of `{first_name}`; all balls of the automaton are equal"
                    ),
                );
            }
        }
        let common = restitution(plan, &first.material, &first.material);
        let differs = |other: &plan::Particles| {
            // The square root of e e can miss e by one bit.
            (restitution(plan, &group.material, &other.material) - common).abs() > 1e-12
        };
        if plan.particles.values().any(differs) {
            remarks.refuse(
                format!("particles.{name}.material"),
                format!("its restitution differs from that of `{first_name}`; all balls of the automaton are equal"),
            );
        }
        count += group.count;
    }
    Some(BallKind { material: &first.material, diameter: first.diameter, mass: first.mass, count })
}

/// What a group may say that cells cannot follow.
fn refuse_group(name: &str, group: &plan::Particles, remarks: &mut Remarks) {
    let plan::Particles { material: _, count: _, diameter: _, mass: _, shape: _, size, start: _, motion } = group;
    if !matches!(size, plan::Size::Equal {}) {
        remarks.refuse(format!("particles.{name}.size"), "all balls of the automaton are equal");
    }
    if !matches!(motion, plan::GrainMotion::Free {}) {
        remarks.refuse(format!("particles.{name}.motion"), "all balls of the automaton are free");
    }
}

/// What of the contact law the automaton leaves out; of that of a pair of materials, given with its number and the scene's
/// law, only what the scene's does not have.
fn remark_contact(contact: &plan::Contact, pair: Option<(usize, &plan::Contact)>, plan: &Plan, remarks: &mut Remarks) {
    let plan::Contact {
        normal,
        damping,
        attraction: _,
        tangential,
        rolling,
        twisting: _,
        cohesion,
        film,
        pulled_friction: _,
        rotation,
        slip_lever: _,
    } = contact;
    let key = |part: &str| pair.map_or_else(|| part.to_owned(), |(index, _)| format!("material-pair.{index}.{part}"));
    let scene = pair.map(|(_, scene)| scene);
    if !normal.elastic() && scene.is_none_or(|scene| scene.normal != *normal) {
        let text = "the automaton's balls neither yield nor hold each other: they rebound by their restitution";
        remarks.approximate(key("contact.normal"), text);
    }
    let told = matches!(
        damping,
        plan::Damping::None {}
            | plan::Damping::Rate { .. }
            | plan::Damping::Viscoelastic { .. }
            | plan::Damping::Dashpot { .. }
    );
    if told && scene.is_none_or(|scene| scene.damping != *damping) {
        let text = "the automaton's balls rebound by the restitution of their materials";
        remarks.approximate(key("contact.damping"), text);
    }
    if !matches!(cohesion, plan::Cohesion::None {}) && scene.is_none_or(|scene| scene.cohesion != *cohesion) {
        remarks.approximate(key("contact.cohesion"), "the automaton knows no cohesion");
    }
    if !matches!(film, plan::Film::None {}) && scene.is_none_or(|scene| scene.film != *film) {
        remarks.approximate(key("contact.film"), "the automaton's balls are dry");
    }
    let slides = matches!(tangential, Tangential::None {}) || plan.materials.values().all(|m| m.friction <= 0.0);
    if !slides && scene.is_none_or(|scene| scene.tangential != *tangential) {
        remarks.approximate(key("contact.tangential"), "the automaton knows no friction: balls slide freely");
    }
    let rolls = !matches!(rolling, Rolling::None {});
    let text = "the automaton knows no spin and no rolling resistance";
    match scene {
        None if *rotation || rolls => remarks.approximate("contact.rotation", text),
        Some(scene) if rolls && scene.rolling != *rolling => remarks.approximate(key("contact.rolling"), text),
        _ => {}
    }
}

/// Units, and whether whole numbers can hold them.
fn scale(spacing: f64, gravity: f64, lattice: &plan::Lattice, remarks: &mut Remarks) -> Scale {
    let dt = lattice.time_step;
    if dt.is_nan() || dt <= 0.0 {
        remarks.refuse("lattice.time-step", "it must be positive; the automaton of Komatsuzaki (2003) uses \"0.1 ms\"");
    }
    let half = lattice.oblique_gravity == ObliqueGravity::Projected;
    let scale = Scale::new(spacing, gravity, dt, lattice.arithmetic, half);
    if scale.gravity > 0 && !(1 << 17..1 << 32).contains(&scale.cell) {
        let longest = (spacing * 1024.0 / gravity / f64::from(1 << 17)).sqrt();
        let shortest = (spacing * 1024.0 / gravity / 2.0_f64.powi(32)).sqrt();
        remarks.refuse(
            "lattice.time-step",
            format!(
                "{dt} s is outside of what cells of {:.3} mm need: {shortest:.1e} to {longest:.1e} s",
                1e3 * spacing
            ),
        );
    }
    scale
}

fn rules(plan: &Plan, casing: &Casing, kind: &BallKind, seed: u64, scale: &Scale) -> Rules {
    let plan::Lattice {
        mode,
        time_step: _,
        oblique_gravity,
        collision,
        rebound_scatter,
        reset_when_blocked,
        keep_remainder,
        resting_impulses,
        resting_threshold,
        arithmetic: _,
        head_room: _,
        ball_radius: _, // Makes the balls' shape.
    } = &plan.lattice;
    // The mode has done its work when the scene was read: it chose the defaults of the options below.
    let (LatticeMode::Literal | LatticeMode::Extended) = mode;
    let (Collision::Pairwise | Collision::Literal) = collision;
    Rules {
        oblique_gravity: *oblique_gravity,
        collision: *collision,
        rebound_scatter: *rebound_scatter,
        reset_when_blocked: *reset_when_blocked,
        keep_remainder: *keep_remainder,
        resting_impulses: *resting_impulses,
        resting_speed: (resting_threshold * scale.gravity as f64).round() as i64,
        ball: Restitution::new(restitution(plan, kind.material, kind.material)),
        wall: Restitution::new(restitution(plan, kind.material, casing.material)),
        seed,
    }
}

/// Restitution of a pair of materials: what the scene says of the pair, else the geometric mean.
pub(super) fn restitution(plan: &Plan, a: &str, b: &str) -> f64 {
    let own = |name: &str| plan.materials.get(name).map_or(1.0, |m| m.restitution);
    // The square root of e e can miss e by one bit.
    let mean = || if a == b { own(a) } else { (own(a) * own(b)).sqrt() };
    plan.pair(a, b).and_then(|p| p.restitution).unwrap_or_else(mean)
}
