//! The contact table: everything about a pair of species that does not change during a run.

use super::law::Law;
use crate::partner::Hosts;
use std::collections::BTreeMap;
use tsubu_scene::plan::{Material, MaterialPair, Plan, Wall};

/// Grains of one kind, or the walls of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Species {
    /// Name of the material.
    pub material: String,
    /// Radius [m]; infinite for walls.
    pub radius: f64,
    /// Mass [kg]; infinite for walls that nothing light carries, the host's effective mass for those on a host.
    pub mass: f64,
}

impl Species {
    /// The species of a wall. A wall on a light structure gives way in an impact: its mass is the one the structure shows.
    fn of_wall(wall: &Wall, hosts: &Hosts) -> Self {
        let host = wall.host.as_deref().and_then(|name| hosts.index(name));
        let mass = host.map_or(f64::INFINITY, |index| hosts.list[index].effective_mass());
        Self { material: wall.material.clone(), radius: f64::INFINITY, mass }
    }
}

/// Two species in contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pair {
    /// Reduced radius R* = 1/(1/R1 + 1/R2) [m].
    pub radius: f64,
    /// Reduced mass m* = 1/(1/m1 + 1/m2) [kg].
    pub mass: f64,
    /// Reduced modulus E*: 1/E* = (1-s1^2)/E1 + (1-s2^2)/E2 [Pa].
    pub young: f64,
    /// Reduced shear modulus G*: 1/G* = (2-s1)/G1 + (2-s2)/G2 [Pa].
    pub shear_modulus: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
    /// Friction coefficient [-].
    pub friction: f64,
    /// Rolling friction coefficient [-].
    pub rolling_friction: f64,
    /// Exponent p of the elastic force k d^p, set by the normal part.
    pub exponent: f64,
    /// k, set by the normal part [N/m^p].
    pub stiffness: f64,
    /// c of the damping c d^q d', set by the damping part; zero without one.
    pub damping: f64,
    /// q, set by the damping part [-].
    pub damping_exponent: f64,
    /// 8 G* sqrt(R*), set by Mindlin's part [N/m^1.5].
    pub shear: f64,
    /// Tangential over normal dashpot, set by Mindlin's part [-].
    pub shear_damping: f64,
}

impl Pair {
    /// Undamped contact time at impact speed `v` [s]: 2.943275 d_max / v (Hertz), pi sqrt(m*/k) (Hooke).
    pub fn contact_time(&self, v: f64) -> f64 {
        if self.exponent == 1.5 {
            2.943_275 * self.largest_overlap(v) / v
        } else {
            std::f64::consts::PI * (self.mass / self.stiffness).sqrt()
        }
    }

    /// Largest overlap at impact speed `v`, undamped [m]: (5 m* v^2 / (4 k))^(2/5) (Hertz), v sqrt(m*/k) (Hooke).
    pub fn largest_overlap(&self, v: f64) -> f64 {
        if self.exponent == 1.5 {
            (1.25 * self.mass * v * v / self.stiffness).powf(0.4)
        } else {
            v * (self.mass / self.stiffness).sqrt()
        }
    }
}

/// All pairs of species.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The species: grain groups in the order of their names, then the kinds of walls.
    pub species: Vec<Species>,
    pairs: Vec<Pair>,
}

impl Table {
    /// The table of a plan under a law.
    pub fn new(plan: &Plan, law: &Law, hosts: &Hosts) -> Self {
        let mut species: Vec<Species> = plan
            .particles
            .values()
            .map(|p| Species { material: p.material.clone(), radius: 0.5 * p.diameter, mass: p.mass })
            .collect();
        for wall in plan.walls.values() {
            let kind = Species::of_wall(wall, hosts);
            if !species.contains(&kind) {
                species.push(kind);
            }
        }
        let mut pairs = Vec::with_capacity(species.len() * species.len());
        for a in &species {
            for b in &species {
                let mut pair = combine(a, b, &plan.materials, &plan.material_pair);
                if pair.radius.is_finite() {
                    law.prepare(&mut pair);
                }
                pairs.push(pair);
            }
        }
        Self { species, pairs }
    }

    /// The pair of two species.
    #[inline]
    pub fn pair(&self, a: u32, b: u32) -> &Pair {
        &self.pairs[a as usize * self.species.len() + b as usize]
    }

    /// Index of the species of a wall of the plan.
    pub fn wall_species(&self, wall: &Wall, hosts: &Hosts) -> u32 {
        let kind = Species::of_wall(wall, hosts);
        self.species.iter().position(|s| *s == kind).unwrap_or_default() as u32
    }
}

fn combine(a: &Species, b: &Species, materials: &BTreeMap<String, Material>, special: &[MaterialPair]) -> Pair {
    let (m, n) = (&materials[&a.material], &materials[&b.material]);
    let found = special.iter().find(|p| {
        p.between == [a.material.clone(), b.material.clone()] || p.between == [b.material.clone(), a.material.clone()]
    });
    let mix = |told: Option<f64>, x: f64, y: f64| told.unwrap_or_else(|| (x * y).sqrt());
    let plane_modulus = |m: &Material| m.young_modulus / (1.0 - m.poisson_ratio * m.poisson_ratio);
    let shear = |m: &Material| m.young_modulus / (2.0 * (1.0 + m.poisson_ratio) * (2.0 - m.poisson_ratio));
    let reduced = |x: f64, y: f64| 1.0 / (1.0 / x + 1.0 / y);
    Pair {
        radius: reduced(a.radius, b.radius),
        mass: reduced(a.mass, b.mass),
        young: reduced(plane_modulus(m), plane_modulus(n)),
        shear_modulus: reduced(shear(m), shear(n)),
        restitution: mix(found.and_then(|p| p.restitution), m.restitution, n.restitution),
        friction: mix(found.and_then(|p| p.friction), m.friction, n.friction),
        rolling_friction: mix(found.and_then(|p| p.rolling_friction), m.rolling_friction, n.rolling_friction),
        ..Pair::default()
    }
}
