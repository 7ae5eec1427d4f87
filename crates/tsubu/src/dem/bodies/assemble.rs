//! How bodies come to be: clumps of a plan in the place of the grains that stand for them.

use super::body::Body;
use super::{Bodies, Piece};
use crate::engine::{Note, Refusal, Verdict};
use crate::neighbours::joined::NO_BODY;
use crate::random::{Purpose, unit, words};
use crate::state::{Grain, Grains};
use glam::{DMat3, DQuat, DVec3};
use tsubu_scene::plan::{Clump, ClumpOrientation, Integrator, Plan, Start};

/// What scenes with clumps cannot have yet.
pub(in crate::dem) fn refused(plan: &Plan) -> Result<(), Refusal> {
    if !plan.particles.values().any(|group| group.shape.is_clump()) {
        return Ok(());
    }
    let mut notes = Vec::new();
    let mut refuse =
        |key: String, text: &str| notes.push(Note { key, verdict: Verdict::Refused, text: text.to_owned() });
    for (name, group) in &plan.particles {
        if group.shape.is_clump() && matches!(group.start, Start::Stream { .. }) {
            refuse(
                format!("particles.{name}.start.stream"),
                "clumps cannot come in during a run yet; let them begin by `start.random` or `start.rows`",
            );
        }
    }
    if let Some(name) = plan.removal.keys().next() {
        refuse(
            format!("removal.{name}"),
            "grains cannot be removed from a scene with clumps yet; let them fall onto a floor out of the way",
        );
    }
    if plan.dem.integrator != Integrator::VelocityVerlet {
        refuse("dem.integrator".to_owned(), "clumps are moved by `velocity-verlet` alone; leave the key out");
    }
    if !plan.contact.rotation {
        refuse("contact.rotation".to_owned(), "clumps turn; leave the key out");
    }
    if notes.is_empty() { Ok(()) } else { Err(Refusal { method: "dem", notes }) }
}

impl Bodies {
    /// Puts the spheres of clumps in the place of the grains that stand for them; those get numbers one after the other.
    pub fn assemble(plan: &Plan, grains: &mut Grains) -> Self {
        let clumps: Vec<Option<Clump>> = plan.particles.values().map(|group| group.shape.clump()).collect();
        let mut bodies = Self { plane: plan.dimension == 2, ..Self::default() };
        if clumps.iter().all(Option::is_none) {
            return bodies;
        }
        let whole = std::mem::take(grains);
        for i in 0..whole.len() {
            let grain = whole.row(i);
            let id = grains.len() as u32;
            if let Some(clump) = &clumps[grain.group as usize] {
                bodies.add(clump, &grain, plan, grains);
            } else {
                grains.push(Grain { id, ..grain });
                bodies.by_id.push(Piece { body: NO_BODY, offset: DVec3::ZERO });
            }
        }
        bodies.find(grains);
        let Self { list, sorted, places, plane, .. } = &mut bodies;
        for body in &mut *list {
            body.follow(*plane);
            for &place in &places[body.pieces.clone()] {
                let i = place as usize;
                let arm = body.arm(&sorted[i], *plane);
                grains.position[i] = body.centre + arm;
            }
        }
        bodies.show(grains);
        bodies
    }

    fn add(&mut self, clump: &Clump, grain: &Grain, plan: &Plan, grains: &mut Grains) {
        let diameter = 2.0 * grain.radius;
        let drawn = DQuat::from_mat3(&DMat3::from_cols_array_2d(&clump.axes)).normalize();
        let turned = match clump.orientation {
            ClumpOrientation::AsDrawn => DQuat::IDENTITY,
            ClumpOrientation::Random => anyhow(plan, grain.id),
        };
        let orientation = (turned * drawn).normalize();
        let moments = DVec3::from_array(clump.moments) * (grain.mass * diameter * diameter);
        let axes = DMat3::from_quat(orientation);
        let inertia = axes * DMat3::from_diagonal(moments) * axes.transpose();
        let body = self.list.len() as u32;
        let first = self.list.last().map_or(0, |body| body.pieces.end);
        self.list.push(Body {
            mass: grain.mass,
            moments,
            pieces: first..first + clump.pieces.len(),
            centre: grain.position,
            velocity: grain.velocity,
            acceleration: DVec3::ZERO,
            orientation,
            angular_momentum: inertia * grain.spin,
            torque: DVec3::ZERO,
            axes,
            inverse_inertia: DMat3::ZERO,
            spin: grain.spin,
            correction: 0.0,
        });
        let volume: f64 = clump.pieces.iter().map(|(_, radius)| radius.powi(3)).sum();
        for (offset, radius) in &clump.pieces {
            grains.push(Grain {
                radius: radius * diameter,
                // Others feel the mass of the whole; shares of it make sums over grains right.
                mass: grain.mass * radius.powi(3) / volume,
                inverse_mass: 1.0 / grain.mass,
                inertia: 0.0,
                id: grains.len() as u32,
                ..*grain
            });
            self.by_id.push(Piece { body, offset: DVec3::from_array(*offset) * diameter });
        }
    }
}

/// Any orientation as likely as another (Shoemake 1992); in the plane any angle about y.
fn anyhow(plan: &Plan, id: u32) -> DQuat {
    let tau = std::f64::consts::TAU;
    let draw = |k: u64| {
        let w = words(plan.seed, Purpose::Orientation, id, k);
        [unit(w[0], w[1]), unit(w[2], w[3])]
    };
    let ([u, v], [w, _]) = (draw(0), draw(1));
    if plan.dimension == 2 {
        return DQuat::from_rotation_y(tau * u);
    }
    let (low, high) = ((1.0 - u).sqrt(), u.sqrt());
    DQuat::from_xyzw(low * (tau * v).sin(), low * (tau * v).cos(), high * (tau * w).sin(), high * (tau * w).cos())
}
