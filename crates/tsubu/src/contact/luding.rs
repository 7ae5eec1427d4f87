//! A linear spring that yields and holds on: Luding's hysteretic law.
//!
//! All that a contact remembers is the depth that its dent belongs to: on first loading the overlap itself, afterwards the deepest
//! so far, and less again once the faces have been torn from each other in part. Overlaps and forces off that line are elastic, so
//! the energy is known without following the way: what is stored is that of the spring k2, and what is lost follows from how the
//! depth of the dent has changed.

use super::chunk::{Chunk, Column};
use super::pair::{Constants, Pair};
use super::part::{About, Part, Slot, Stage};
use super::root::{least, most};
use multiversion::multiversion;

pub(super) const ABOUT: About = About {
    key: "contact.normal.luding",
    formula: "\
f = k1 d              pressed as never before
f = k2 (d - d0)       let go and pressed again, d0 = (1 - k1/k2) d_m, d_m the deepest overlap
f = -kc d             pulled, where that is more than k2 (d - d0); strongest at d = (k2 - k1) / (k2 + kc) d_m
k2 = k1 + (K - k1) d_m/D, not above K, with D = K / (K - k1) 2 R* phi; deeper than D the contact is elastic with K.
Torn along -kc d the dent shrinks: d_m falls with d so that pressing again goes with its k2. It is gone where the bodies part, d = 0.
Friction sees f + kc d. Stored f^2 / (2 k2). Lost (1/2) k1 d_m d0 in loading, (1/2) kc k2 d0^2 / (k2 + kc) in tearing off.",
    symbols: "d overlap [m], k1 `stiffness` [N/m], K = `unloading-ratio` k1, kc = `adhesion-ratio` k1, phi `plasticity-depth` [-], R* effective radius [m]",
    limits: "stiffnesses are choices, not material constants; nothing is seen of a dent at the next touch; a dashpot loses beside it: without one (`damping.none`) an impact without adhesion has the restitution sqrt(k1/k2)",
    reference: "Luding 2008, Granular Matter 10, 235; Walton and Braun 1986; the shrinking of d_m where k2 depends on it is ours",
};

#[derive(Clone, Copy, Debug)]
pub(super) struct Luding {
    /// k1 [N/m].
    pub stiffness: f64,
    /// K over k1 [-].
    pub unloading: f64,
    /// kc over k1 [-].
    pub adhesion: f64,
    /// phi [-].
    pub depth: f64,
}

impl Part for Luding {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn stage(&self) -> Stage {
        Stage::Normal
    }

    /// The depth that the dent belongs to [m], and the energy that tearing off would still take [J].
    fn history(&self) -> &'static [Slot] {
        &[Slot::Even, Slot::Even]
    }

    fn prepare(&self, constants: &mut Constants) {
        constants.exponent = 1.0;
    }

    fn judge(&self, pair: &mut Pair) {
        pair.stiffness = self.stiffness;
        pair.stiffest = self.stiffness * self.unloading.max(self.adhesion);
    }

    fn apply(&self, chunk: &mut Chunk, at: usize, dt: f64) {
        chunk.with_history(at, |chunk, history| rows(chunk, history, 1.0 / dt, *self));
    }

    fn held(&self, history: &[f64]) -> f64 {
        history.get(1).copied().unwrap_or_default()
    }
}

/// A dent.
struct Dent {
    /// k2 [N/m].
    stiffness: f64,
    /// d0 [m].
    rest: f64,
    /// Energy lost in making it [J].
    yielding: f64,
    /// Energy lost in tearing it off [J].
    tearing: f64,
}

/// The dent of a depth [m]; k2 grows by `growth` with it [N/m^2].
#[inline(always)]
fn dent([k1, kc]: [f64; 2], growth: f64, depth: f64) -> Dent {
    let stiffness = k1 + growth * depth;
    let rest = growth * depth * depth / stiffness;
    let tearing = 0.5 * kc * stiffness * (rest * rest) / (stiffness + kc);
    Dent { stiffness, rest, yielding: 0.5 * k1 * depth * rest, tearing }
}

#[multiversion(targets = "simd")]
fn rows(chunk: &mut Chunk, [depth, tearing]: &mut [Column; 2], rate: f64, law: Luding) {
    let [k1, kc] = [law.stiffness, law.adhesion * law.stiffness];
    for i in 0..chunk.rows() {
        let overlap = most(chunk.overlap[i], 0.0);
        let deepest = law.unloading / (law.unloading - 1.0) * 2.0 * chunk.effective_radius[i] * law.depth;
        let growth = (law.unloading - 1.0) * k1 / deepest;
        let old = dent([k1, kc], growth, depth[i]);

        let pressed = least(most(depth[i], overlap), deepest);
        let Dent { stiffness, rest, .. } = dent([k1, kc], growth, pressed);
        let (elastic, pull) = (stiffness * (overlap - rest), 0.0 - kc * overlap);
        let torn = elastic < pull;
        // The depth whose elastic line meets the limb of the pull at this overlap: growth z (z - d) = (k1 + kc) d.
        let met = 0.5 * (overlap + (overlap * (overlap + 4.0 * (k1 + kc) / growth)).sqrt());
        let now = if torn { least(met, pressed) } else { pressed };
        let new = dent([k1, kc], growth, now);
        let force = if torn { pull } else { elastic };
        let lost = if now > depth[i] { new.yielding - old.yielding } else { old.tearing - new.tearing };

        chunk.contact_radius[i] = (chunk.effective_radius[i] * overlap).sqrt();
        chunk.secant_stiffness[i] = k1;
        chunk.normal_force[i] = force;
        chunk.pull_off[i] += kc * overlap;
        chunk.stored[i] = 0.5 * (force * force) / new.stiffness;
        chunk.lost_normal[i] += lost * rate;
        depth[i] = now;
        tearing[i] = new.tearing;
    }
}
