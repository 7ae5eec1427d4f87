//! The contact table: everything about a pair of materials that does not change during a run, its law included.

use super::law::Law;
use super::pair::{Constants, Pair};
use crate::mutation::{Mutation, left_out, mutated};
use std::collections::BTreeSet;
use tsubu_scene::plan::{Contact, Material, MaterialPair, Plan};

/// All pairs of materials that grains and walls are made of.
#[derive(Debug, Default)]
pub struct Table {
    materials: Vec<String>,
    constants: Vec<Constants>,
    /// Number of the law of each pair.
    law: Vec<u32>,
    /// The different laws; in most scenes one.
    laws: Vec<Law>,
}

impl Table {
    /// The table of a plan. Pairs whose stacks of parts are equal share a law, whether the scene says so once or for each.
    pub fn new(plan: &Plan) -> Self {
        let of_grains = plan.particles.values().map(|group| &group.material);
        let of_walls = plan.walls.values().map(|wall| &wall.material);
        // A scene may bring a long list of materials; of those that nothing is made of no pair is needed.
        let used: BTreeSet<&String> = of_grains.chain(of_walls).collect();
        let used: Vec<_> = plan.materials.iter().filter(|(name, _)| used.contains(name)).collect();
        let mut table = Self { materials: used.iter().map(|(name, _)| (*name).clone()).collect(), ..Self::default() };
        let mut contacts: Vec<&Contact> = Vec::new();
        for a in &used {
            for b in &used {
                let contact = plan.contact_of(a.0, b.0);
                let law = contacts.iter().position(|known| *known == contact).unwrap_or_else(|| {
                    contacts.push(contact);
                    table.laws.push(Law::new(contact));
                    table.laws.len() - 1
                });
                let mut pair = combine(a.1, b.1, plan.pair(a.0, b.0));
                table.laws[law].prepare(&mut pair);
                table.constants.push(pair);
                table.law.push(law as u32);
            }
        }
        table
    }

    /// The different laws.
    #[inline]
    pub fn laws(&self) -> &[Law] {
        &self.laws
    }

    /// Number of the law of a pair of materials, by the number of the pair.
    #[inline]
    pub fn law(&self, index: u32) -> usize {
        self.law[index as usize] as usize
    }

    /// Number of a material.
    pub fn material(&self, name: &str) -> u32 {
        self.materials.iter().position(|m| m == name).unwrap_or_default() as u32
    }

    /// Name of a material, by its number.
    pub fn name(&self, material: u32) -> &str {
        &self.materials[material as usize]
    }

    /// Number of a pair of materials.
    #[inline(always)]
    pub fn index(&self, a: u32, b: u32) -> u32 {
        a * self.materials.len() as u32 + b
    }

    /// Constants of a pair of materials, by its number.
    #[inline(always)]
    pub fn constants(&self, index: u32) -> &Constants {
        &self.constants[index as usize]
    }

    /// Two bodies, given as (material, radius [m], mass [kg]); infinite radius and mass for walls.
    pub fn pair(&self, a: (u32, f64, f64), b: (u32, f64, f64)) -> Pair {
        let of_pair = |x: f64, y: f64| 1.0 / (1.0 / x + 1.0 / y);
        let index = self.index(a.0, b.0);
        let mut pair = Pair {
            constants: *self.constants(index),
            radius: of_pair(a.1, b.1),
            mass: of_pair(a.2, b.2),
            ..Pair::default()
        };
        self.laws[self.law(index)].judge(&mut pair);
        pair
    }
}

fn combine(m: &Material, n: &Material, found: Option<&MaterialPair>) -> Constants {
    let mix = |told: Option<f64>, x: f64, y: f64| told.unwrap_or_else(|| (x * y).sqrt());
    let elastic = |m: &Material| {
        let (young, poisson) = (mutated(Mutation::Young, m.young_modulus), mutated(Mutation::Poisson, m.poisson_ratio));
        [young / (1.0 - poisson * poisson), young / (2.0 * (1.0 + poisson) * (2.0 - poisson))]
    };
    let of_pair = |x: f64, y: f64| 1.0 / (1.0 / x + 1.0 / y);
    let ([plane, shear], [plane_of_other, shear_of_other]) = (elastic(m), elastic(n));
    let mutable = |what, told: Option<f64>, x, y| mutated(what, mix(told, x, y));
    let told = |of: fn(&MaterialPair) -> Option<f64>| found.and_then(of);
    Constants {
        effective_modulus: of_pair(plane, plane_of_other),
        shear_modulus: mutated(Mutation::TangentialStiffness, of_pair(shear, shear_of_other)),
        restitution: mix(told(|p| p.restitution), m.restitution, n.restitution),
        friction: if left_out(Mutation::Sliding) {
            0.0
        } else {
            mutable(Mutation::Friction, told(|p| p.friction), m.friction, n.friction)
        },
        rolling: mutable(
            Mutation::RollingFriction,
            told(|p| p.rolling_friction),
            m.rolling_friction,
            n.rolling_friction,
        ),
        twisting: mutable(
            Mutation::TwistingFriction,
            told(|p| p.twisting_friction),
            m.twisting_friction,
            n.twisting_friction,
        ),
        surface_energy: mutable(Mutation::Cohesion, told(|p| p.surface_energy), m.surface_energy, n.surface_energy),
        cohesion: mutable(Mutation::Cohesion, told(|p| p.cohesion), m.cohesion, n.cohesion),
        ..Constants::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write as _;
    use std::path::Path;
    use tsubu_scene::Scene;

    /// A list of 20,000 materials made 400 million pairs, in twenty seconds and more, though two balls need one.
    #[test]
    fn materials_that_nothing_is_made_of_cost_nothing() {
        let mut text = "duration = 1\n[particles.balls]\nmaterial = 'm7'\ndiameter = '6 mm'\nmass = '0.2 g'\n\
                        start.at.position = [[0, 1]]\n[walls.floor]\nmaterial = 'm9'\nshape.plane = {}\n"
            .to_owned();
        for i in 0..20_000 {
            let _ = write!(text, "[materials.m{i}]\nyoung-modulus = 1e9\nfriction = {}\n", 1e-3 * f64::from(i));
        }
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let table = Table::new(scene.plan());
        assert_eq!(table.constants.len(), 4);
        let [ball, floor] = ["m7", "m9"].map(|name| table.material(name));
        assert_eq!([table.name(ball), table.name(floor)], ["m7", "m9"]);
        assert!((table.constants(table.index(ball, floor)).friction - 63e-6_f64.sqrt()).abs() < 1e-15);
    }
}
