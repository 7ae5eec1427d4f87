//! A bond: an elastic beam between two grains.
//!
//! The energy is a function of where the two grains are and how they are turned, after the vector-based model of Kuzkin and Asonov (2012): e is the
//! unit vector from the first centre to the second, n, m, p are three axes of the beam that each grain carries along (n along e at rest),
//!
//! U = A (r - a)^2 / 2 + B (|n1 - e|^2 + |n2 - e|^2) / 2 + C |n1 - n2|^2 / 2 + D (|m1 - m2|^2 + |p1 - p2|^2) / 4.
//!
//! Force and torques are its exact derivatives, so nothing is remembered from step to step, and energy, momentum and angular momentum hold at
//! any rotation. For small deflections it is the beam of Timoshenko: see [`crate::beam`].

use crate::beam::{Section, Stiffness};
use crate::state::Grains;
use glam::{DMat3, DQuat, DVec3};
use tsubu_scene::plan;

/// A bond between two grains, and what it does at a time level.
#[derive(Clone, Debug, Default)]
pub struct Beam {
    /// Which entry of the scene has made it.
    pub entry: u32,
    /// Ids of the grains, the smaller first.
    pub grains: [u32; 2],
    /// Distance of the centres at rest [m].
    pub length: f64,
    /// Radius of the section [m].
    pub radius: f64,
    /// Its strength over that of the scene [-].
    pub strength: f64,
    /// Its axes n, m, p in those of each grain.
    pub axes: [DQuat; 2],
    pub stiffness: Stiffness,
    /// How long it takes stresses to follow: stress = stiffness (strain + time strain rate) [s].
    pub relaxation: f64,
    /// Where the two are among the grains.
    pub rows: [u32; 2],
    /// Present force on the second grain [N] and torques on both [N.m]: what is elastic, and what damps.
    pub elastic: Act,
    pub damping: Act,
    /// Stored [J], and lost by damping [W].
    pub energy: f64,
    pub lost: f64,
    /// Largest tension and shear stress in the section [Pa].
    pub stress: [f64; 2],
}

/// Force of a bond on its second grain [N], the opposite one on the first, and torques on both [N.m].
#[derive(Clone, Copy, Debug, Default)]
pub struct Act {
    pub force: DVec3,
    pub torque: [DVec3; 2],
}

impl Act {
    /// What the ends' torques, which turn the beam, and a pull along it ask for: torques across the beam need a couple of forces.
    fn balanced(pull: f64, direction: DVec3, distance: f64, torque: [DVec3; 2]) -> Self {
        Self { force: direction.cross(torque[0] + torque[1]) / distance - pull * direction, torque }
    }
}

impl Beam {
    /// At rest between two grains as they are, apart by `branch` [m] and turned by `turned`.
    pub fn new(entry: (u32, &plan::Bond), grains: [u32; 2], branch: DVec3, turned: [DQuat; 2], plane: bool) -> Self {
        let n = branch.normalize();
        let m = if plane { DVec3::Y } else { n.any_orthonormal_vector() };
        let axes = DQuat::from_mat3(&DMat3::from_cols(n, m, n.cross(m)));
        let axes = turned.map(|turned| turned.conjugate() * axes);
        Self { entry: entry.0, grains, length: branch.length(), axes, strength: 1.0, ..Self::default() }
    }

    /// Gives it a section, and grains of an effective mass [kg] to damp.
    pub fn made_of(mut self, bond: &plan::Bond, radius: f64, effective_mass: f64) -> Self {
        self.radius = radius;
        self.stiffness = Stiffness::of(bond, radius, self.length);
        self.relaxation = 2.0 * bond.damping * (effective_mass / self.stiffness.stretch).sqrt();
        self
    }

    /// Evaluates it, `branch` [m] from the first centre to the second, the grains turned by `turned`.
    pub fn evaluate(&mut self, grains: &Grains, branch: DVec3, turned: [DQuat; 2]) {
        let Stiffness { stretch, ends, bend, twist } = self.stiffness;
        let distance = branch.length();
        let e = branch / distance;
        let [first, second] = [0, 1].map(|k| {
            let axes = DMat3::from_quat(turned[k] * self.axes[k]);
            [axes.x_axis, axes.y_axis, axes.z_axis]
        });
        let extension = distance - self.length;
        // The difference of nearly equal vectors: neither energies nor torques lose digits at small deflections.
        let tilt = [first[0] - e, second[0] - e];
        let apart = [0, 1, 2].map(|k| second[k] - first[k]);
        let cross = bend - 0.5 * twist;
        self.energy = 0.5 * stretch * extension * extension
            + 0.5 * ends * (tilt[0].length_squared() + tilt[1].length_squared())
            + 0.5 * cross * apart[0].length_squared()
            + 0.25 * twist * (apart[1].length_squared() + apart[2].length_squared());
        let between =
            cross * first[0].cross(apart[0]) + 0.5 * twist * (first[1].cross(apart[1]) + first[2].cross(apart[2]));
        let torque = [ends * tilt[0].cross(e) + between, ends * tilt[1].cross(e) - between];
        self.elastic = Act::balanced(stretch * extension, e, distance, torque);
        self.stress = self.stresses(e, stretch * extension);
        if self.relaxation > 0.0 {
            self.damp(grains, e, distance);
        }
    }

    /// Largest tension and shear stress in the section [Pa] (Potyondy and Cundall 2004, eqs. 15 and 16).
    fn stresses(&self, e: DVec3, pull: f64) -> [f64; 2] {
        let Section { area, moment } = Section::round(self.radius);
        let across = |v: DVec3| (v - e * v.dot(e)).length();
        let bending = across(self.elastic.torque[0]).max(across(self.elastic.torque[1]));
        let twisting = self.elastic.torque[1].dot(e).abs();
        [
            pull / area + bending * self.radius / moment,
            across(self.elastic.force) / area + twisting * self.radius / (2.0 * moment),
        ]
    }

    /// The same stiffnesses on the rates of all deflections.
    fn damp(&mut self, grains: &Grains, e: DVec3, distance: f64) {
        let Stiffness { stretch, ends, bend, twist } = self.stiffness;
        let [i, j] = self.rows.map(|row| row as usize);
        let relative = grains.velocity[j] - grains.velocity[i];
        let turning = e.cross(relative) / distance;
        let along = relative.dot(e);
        let spins = [grains.spin[i], grains.spin[j]];
        let across = spins.map(|spin| spin - e * spin.dot(e) - turning);
        let bending = across[1] - across[0];
        let twisting = (spins[1] - spins[0]).dot(e);
        let time = self.relaxation;
        let between = time * (bend * bending + twist * twisting * e);
        let torque = [between - time * ends * across[0], -between - time * ends * across[1]];
        self.damping = Act::balanced(time * stretch * along, e, distance, torque);
        self.lost = time
            * (stretch * along * along
                + ends * (across[0].length_squared() + across[1].length_squared())
                + bend * bending.length_squared()
                + twist * twisting * twisting);
    }
}
