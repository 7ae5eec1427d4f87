//! How bonds come to be, and how they go.

use super::beam::Beam;
use super::{Attitudes, Bonds, branch};
use crate::dem::bodies::Bodies;
use crate::dem::engine::DemEngine;
use crate::dem::history_transfer::HistorySnapshot;
use crate::engine::{Engine, Note, Refusal, Verdict};
use crate::ledger::{Account, Ledger};
use crate::polyhedron::touch::Search;
use crate::polyhedron::{self, Turned, with_round};
use crate::random::{Purpose, unit, words};
use crate::state::Grains;
use crate::superellipsoid::{self, Outline};
use glam::DVec3;
use tsubu_scene::plan::{Bond, Particles, Plan};

/// Scenes whose bonds nobody could make.
pub(in crate::dem) fn refused(plan: &Plan) -> Result<(), Refusal> {
    let nobody =
        |bond: &Bond| !plan.particles.iter().any(|(name, group): (_, &Particles)| group.count > 0 && bond.joins(name));
    let Some(index) = plan.bond.iter().position(nobody) else { return Ok(()) };
    Err(Refusal::of("dem", format!("bond.{index}"), "there are no grains that it could hold together"))
}

impl Bonds {
    /// What a plan says; none is made yet.
    pub fn new(plan: &Plan) -> Self {
        let joins = |bond: &Bond| plan.particles.keys().map(|name| bond.joins(name)).collect();
        Self {
            entries: plan.bond.clone(),
            joins: plan.bond.iter().map(joins).collect(),
            made: vec![false; plan.bond.len()],
            seed: plan.seed,
            plane: plan.dimension == 2,
            ..Self::default()
        }
    }

    /// Whether some are still to be made by a time [s].
    pub fn due(&self, time: f64) -> bool {
        self.entries.iter().zip(&self.made).any(|(bond, made)| !made && bond.at <= time)
    }

    /// Strength of the bond with a number over the mean: Weibull (1951).
    fn strength(&self, bond: &Bond, number: u64) -> f64 {
        bond.weibull_modulus.map_or(1.0, |modulus| {
            let [high, low, ..] = words(self.seed, Purpose::BondStrength, number as u32, number >> 32);
            let survival = 1.0 - unit(high, low);
            (-survival.ln()).powf(1.0 / modulus) / libm::tgamma(1.0 + 1.0 / modulus)
        })
    }
}

/// Radius of the smaller of two grains, a superellipsoid or polyhedron taken for a sphere of its volume, in the plane a disc of its area [m].
fn smaller(grains: &Grains, bodies: &Bodies, pair: [usize; 2]) -> f64 {
    let [a, b] = pair.map(|i| bodies.equivalent_radius(i).unwrap_or(grains.radius[i]));
    a.min(b)
}

/// Whether the surfaces of two grains, their centres `apart` [m], are no farther from each other than `gap` [m].
fn near(grains: &Grains, bodies: &Bodies, [i, j]: [usize; 2], apart: DVec3, gap: f64) -> bool {
    let radii = [grains.radius[i], grains.radius[j]];
    match (bodies.polyhedron(i).zip(bodies.outline(j)), bodies.outline(i).zip(bodies.polyhedron(j))) {
        (Some((body, round)), _) => return with_round::touched(&body, &round, apart, gap).is_some(),
        (_, Some((round, body))) => return with_round::touch(&round, &body, apart, gap).is_some(),
        _ => {}
    }
    if bodies.outline(i).is_some() || bodies.outline(j).is_some() {
        let [a, b] = [(i, radii[0]), (j, radii[1])].map(|(i, r)| bodies.outline(i).unwrap_or(Outline::sphere(r)));
        return superellipsoid::touch::touch([&a, &b], apart, gap).is_some();
    }
    if bodies.polyhedron(i).is_some() || bodies.polyhedron(j).is_some() {
        let [a, b] = [(i, radii[0]), (j, radii[1])].map(|(i, r)| bodies.polyhedron(i).unwrap_or(Turned::sphere(r)));
        let (mut search, mut found) = (Search::default(), Vec::new());
        polyhedron::touch::touch([&a, &b], apart, gap, &mut search, &mut found);
        return !found.is_empty();
    }
    let limit = radii[0] + radii[1] + gap;
    apart.length_squared() <= limit * limit
}

impl DemEngine {
    /// Whether bonds are to be made after step `step`.
    pub(in crate::dem) fn bonds_due(&self, step: u64) -> bool {
        !self.clock.settling && self.contacts.bonds.due(self.clock.time_of(step))
    }

    /// Makes the bonds whose time has come, at rest as the grains are; what the contacts in their place held is gone.
    pub(in crate::dem) fn make_bonds(&mut self, ledger: &mut Ledger) {
        let time = self.clock.time();
        if !self.contacts.bonds.due(time) {
            return;
        }
        let before = self.grain_energies().total();
        let history = self.snapshot_history();
        for entry in 0..self.contacts.bonds.entries.len() {
            let bonds = &self.contacts.bonds;
            if !bonds.made[entry] && bonds.entries[entry].at <= time {
                self.make_entry(entry);
            }
        }
        self.bonds_have_changed(history);
        ledger.post(Account::Bonds, before - self.grain_energies().total());
    }

    fn make_entry(&mut self, entry: usize) {
        let reach = self.neighbours.search.reach;
        let bond = self.contacts.bonds.entries[entry].clone();
        self.neighbours.search.reach = reach.max(0.5 * bond.gap * self.limits.largest_diameter);
        let part = self.neighbours.part.take();
        self.neighbours.rebuild(&self.grains, &self.walls);
        self.neighbours.search.reach = reach;
        let Self { grains, neighbours, contacts, integration, notes, .. } = self;
        let (bonds, periodic) = (&mut contacts.bonds, &neighbours.search.periodic);
        let bodies = &integration.bodies;
        let attitudes = Attitudes { orientation: &integration.orientation, bodies };
        let joins = |i: usize| bonds.joins[entry][grains.group[i] as usize];
        let mut pairs: Vec<([u32; 2], [u32; 2])> = Vec::new();
        for list in &neighbours.lists {
            for pair in &list.pairs {
                let (i, j) = (list.first + pair.first as usize, list.grain_at[pair.second as usize] as usize);
                let mut rows = [i as u32, j as u32];
                let gap = bond.gap * smaller(grains, bodies, [i, j]);
                if joins(i) && joins(j) && near(grains, bodies, [i, j], branch(periodic, grains, rows), gap) {
                    rows.sort_unstable_by_key(|row| grains.id[*row as usize]);
                    pairs.push((rows.map(|row| grains.id[row as usize]), rows));
                }
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        if pairs.is_empty() {
            let text = "no two grains that are not bonded yet lie within its `gap` of each other, so it holds nothing; a larger `gap`, or a time `at` when they touch".to_owned();
            notes.push(Note { key: format!("bond.{entry}"), verdict: Verdict::Doubtful, text });
        }
        for (ids, rows) in pairs {
            let [i, j] = rows.map(|row| row as usize);
            let turned = ids.map(|id| attitudes.of(id));
            let radius = bond.radius * smaller(grains, bodies, [i, j]);
            let mass = 1.0 / (grains.inverse_mass[i] + grains.inverse_mass[j]);
            let mut beam = Beam::new((entry as u32, &bond), ids, branch(periodic, grains, rows), turned, bonds.plane)
                .made_of(&bond, radius, mass);
            beam.strength = bonds.strength(&bond, bonds.counted);
            bonds.list.push(beam);
            bonds.counted += 1;
        }
        bonds.made[entry] = true;
        neighbours.joined.bond(bonds.pairs());
        neighbours.part = part;
    }

    /// Lets the bonds go that carry too much. Where grains are pressed together, their contact takes over.
    pub(in crate::dem) fn break_bonds(&mut self, ledger: &mut Ledger) {
        let before = self.grain_energies().total();
        let history = self.snapshot_history();
        self.contacts.bonds.give_way();
        self.bonds_have_changed(history);
        ledger.post(Account::Bonds, before - self.grain_energies().total());
    }

    /// Contacts are looked for anew where bonds have come or gone; motion and height of the grains do not change.
    fn bonds_have_changed(&mut self, history: HistorySnapshot) {
        self.neighbours.joined.bond(self.contacts.bonds.pairs());
        self.rebuild_neighbours_with(history);
        // What the springs of contacts held that have given way to bonds is in the difference that is posted.
        self.contacts.released = 0.0;
        self.evaluate_at_rest();
    }
}
