//! Tangential spring with history: Mindlin, incremental and rescaled on unloading.

use super::chunk::Chunk;
use super::part::{About, Needs, Part, Stage};
use super::table::Pair;
use glam::DVec3;

const ABOUT: About = About {
    name: "mindlin",
    models: "elastic tangential contact of spheres that slides when the spring exceeds the friction cone",
    formula: "dF = -k_t(d) v_t dt, F scaled down with k_t on unloading, |F + F_dashpot| <= mu f_n; k_t = 8 G* sqrt(R* d)",
    symbols: "F tangential spring force [N], v_t slip velocity [m/s], G* reduced shear modulus [Pa], mu [-]",
    limits: "no micro-slip inside the contact disc; wants `contact.normal.hertz`",
    reference: "Mindlin and Deresiewicz 1953; Thornton, Cummins, Cleary 2013",
};

#[derive(Debug)]
pub(super) struct Mindlin;

impl Part for Mindlin {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Tangential
    }

    fn needs(&self) -> Needs {
        Needs { history: true, roll: false }
    }

    fn prepare(&self, pair: &mut Pair) {
        pair.shear = 8.0 * pair.shear_modulus * pair.radius.sqrt();
        // Equal damping ratios: the dashpots stand as the roots of the two tangent stiffnesses.
        pair.shear_damping = (pair.shear / (1.5 * pair.stiffness)).sqrt();
    }

    fn apply(&self, chunk: &mut Chunk, dt: f64) {
        for i in 0..chunk.len {
            let stiffness = chunk.shear[i] * chunk.root[i];
            let normal = Chunk::vector(&chunk.normal, i);
            let slip = Chunk::vector(&chunk.slip, i);
            let old = DVec3::new(chunk.history[0][i], chunk.history[1][i], chunk.history[2][i]);
            let old_stiffness = chunk.history[3][i];
            let squared = old.length_squared();
            let mut stored_before = 0.0;
            let mut spring = DVec3::ZERO;
            if squared > 0.0 {
                stored_before = squared / (2.0 * old_stiffness);
                // Turn the spring with the contact: into the new tangent plane, at its old length.
                let flat = old - normal * old.dot(normal);
                // A shrinking contact disc cannot hold the force that a larger one held.
                let shrink = (stiffness / old_stiffness).min(1.0);
                let remaining = flat.length_squared();
                if remaining > 0.0 {
                    spring = flat * (shrink * (squared / remaining).sqrt());
                }
            }
            spring -= slip * (stiffness * dt);
            let mut total = spring - slip * (chunk.dashpot[i] * chunk.shear_damping[i]);
            let limit = chunk.friction[i] * chunk.normal_force[i].max(0.0);
            let size = total.length_squared();
            if size > limit * limit {
                // Sliding: the cone holds for the whole force, the spring gives way and the dashpot is dropped.
                total *= limit / size.sqrt();
                spring = total;
            }
            let stored = spring.length_squared() / (2.0 * stiffness);
            chunk.stored[i] += stored;
            // Work taken from the motion and not stored is lost.
            chunk.lost_sliding[i] += -total.dot(slip) - (stored - stored_before) / dt;
            for (column, value) in chunk.history.iter_mut().zip([spring.x, spring.y, spring.z, stiffness]) {
                column[i] = value;
            }
            let force = Chunk::vector(&chunk.tangential_force, i) + total;
            Chunk::set(&mut chunk.tangential_force, i, force);
        }
    }
}
