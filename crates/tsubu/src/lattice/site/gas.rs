//! From a plan to a lattice gas: its walls, outlets, grains and time step.

use super::Model;
use super::avalanche::Avalanche;
use super::engine::Scene;
use super::fhp::Fhp;
use super::grain_gas::GrainGas;
use super::rule::GasRule;
use crate::lattice::gas::collide::{REST, Rules, SLOTS};
use crate::lattice::gas::elongated::Alignment;
use crate::lattice::gas::grains::{Grains, Habits};
use crate::lattice::gas::numbers::Numbers;
use crate::lattice::gas::pile::{self, Pile};
use crate::lattice::gas::planes::Gas;
use crate::lattice::gas::sites::Sites;
use crate::lattice::remarks::Remarks;
use crate::lattice::sheet::WALL;
use tsubu_scene::plan::{self, FhpRules, GasWalls, Plan};

/// How many grains a site holds at the start in the gas of a plan.
pub(super) fn layers(plan: &Plan, gas: GasRule) -> usize {
    match gas {
        GasRule::Fhp if plan.fhp.rules == FhpRules::One => REST,
        GasRule::Fhp | GasRule::PengHerrmann | GasRule::BaxterBehringer => SLOTS,
        GasRule::KarolyiKertesz => 1,
    }
}

/// Distance of sites as typed [m].
pub(super) fn spacing(plan: &Plan, gas: GasRule) -> Option<f64> {
    match gas {
        GasRule::Fhp => plan.fhp.spacing,
        GasRule::PengHerrmann => plan.after_peng_herrmann.spacing,
        GasRule::BaxterBehringer => plan.after_baxter_behringer.spacing,
        GasRule::KarolyiKertesz => plan.after_karolyi_kertesz.spacing,
    }
}

/// The gas of a plan, with the grains on the layers of `cells`, and its time step [s].
pub(super) fn model(
    plan: &Plan,
    gas: GasRule,
    scene: &Scene,
    cells: &[i32],
    remarks: &mut Remarks,
) -> (Box<dyn Model>, f64) {
    let board = Board::new(plan, gas, scene, cells);
    match gas {
        GasRule::Fhp => fhp(plan, &board, remarks),
        GasRule::PengHerrmann => {
            let plan::PengHerrmann { gravity, dissipation, roughness, spacing: _, time_step } =
                plan.after_peng_herrmann;
            let habits = Habits { gravity: board.odds(gravity), dissipation, roughness };
            let dt = board.time_step(plan, time_step, gravity * FALLS, remarks);
            (Box::new(GrainGas::new(board.grains(habits), None, board.outlets)), dt)
        }
        GasRule::BaxterBehringer => {
            let plan::BaxterBehringer {
                neighbours,
                way,
                temperature,
                gravity,
                dissipation,
                roughness,
                spacing: _,
                time_step,
            } = plan.after_baxter_behringer;
            let habits = Habits { gravity: board.odds(gravity), dissipation, roughness };
            let dt = board.time_step(plan, time_step, gravity * FALLS, remarks);
            let mut grains = board.grains(habits);
            grains.elongate();
            let alignment = Alignment { neighbours, way, temperature };
            (Box::new(GrainGas::new(grains, Some(alignment), board.outlets)), dt)
        }
        GasRule::KarolyiKertesz => {
            let plan::KarolyiKertesz { gravity, dissipation, spacing: _, time_step } = plan.after_karolyi_kertesz;
            let friction: Vec<f64> =
                plan.particles.values().map(|group| friction(plan, &group.material, remarks)).collect();
            let habits = pile::Habits { gravity: board.odds(gravity), dissipation, friction };
            let dt = board.time_step(plan, time_step, gravity * FLIES, remarks);
            let mut pile = Pile::new(board.sites, habits, plan.seed);
            board.walls().for_each(|(column, row)| pile.set_wall(column, row));
            scene.group.iter().for_each(|kind| _ = pile.announce(*kind));
            let mut laid: Vec<_> = board.seats().collect();
            laid.sort_by_key(|(site, ..)| board.sites.column_and_row(*site).1);
            for (site, _, grain) in laid {
                pile.lay(site, grain);
            }
            (Box::new(Avalanche::new(pile, &board.outlets)), dt)
        }
    }
}

/// What a lone grain gains in a step, in the mean over rest and six directions, over the probability that gravity turns it:
/// one at rest 1, from NE and NW 1, from N, SE and SW 1/2, from S nothing.
const FALLS: f64 = 4.5 / 7.0;
/// The same for grains that only gain while they fly.
const FLIES: f64 = 3.5 / 6.0;

/// The ground as gases see it.
struct Board<'a> {
    sites: Sites,
    cells: &'a [i32],
    layers: usize,
    outlets: Vec<usize>,
    seed: u64,
    count: usize,
    spacing: f64,
    /// Strength of gravity [m/s^2].
    gravity: f64,
}

impl<'a> Board<'a> {
    fn new(plan: &Plan, gas: GasRule, scene: &Scene, cells: &'a [i32]) -> Self {
        let ground = &scene.ground;
        let takes = |site: &usize| scene.removal.iter().any(|removal| removal.takes(ground.point(*site).to_array()));
        Self {
            sites: Sites::new(ground.columns, ground.rows, ground.periodic),
            cells,
            layers: layers(plan, gas),
            outlets: (0..ground.len()).filter(takes).collect(),
            seed: plan.seed,
            count: scene.mass.len(),
            spacing: ground.spacing,
            gravity: scene.gravity.length(),
        }
    }

    fn is_wall(&self, site: usize) -> bool {
        self.cells[site] == WALL
    }

    fn walls(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.sites.count()).filter(|site| self.is_wall(*site)).map(|site| self.sites.column_and_row(site))
    }

    /// Site, slot and number of every grain. The first layer is that of rest, if there is one.
    fn seats(&self) -> impl Iterator<Item = (usize, usize, u32)> {
        let slot = |layer: usize| if self.layers == SLOTS { (layer + REST) % SLOTS } else { layer };
        let grains = self.cells.iter().enumerate().filter(|(_, cell)| **cell >= 0);
        grains.map(move |(at, cell)| (at % self.sites.count(), slot(at / self.sites.count()), *cell as u32))
    }

    /// The probability of gravity, which is none where there is no gravity.
    fn odds(&self, typed: f64) -> f64 {
        if self.gravity > 0.0 { typed } else { 0.0 }
    }

    fn numbers(&self) -> Numbers {
        let mut numbers = Numbers::new(self.sites, self.count);
        self.seats().for_each(|(site, slot, grain)| numbers.set(site, slot, grain));
        numbers
    }

    fn grains(&self, habits: Habits) -> Grains {
        let Sites { columns, rows, periodic } = self.sites;
        let mut grains = Grains::new(columns, rows, periodic, habits, self.seed);
        for (column, row) in self.walls() {
            grains.set_wall(column, row, self.sites.mirror(column, row, |site| self.is_wall(site)));
        }
        grains.restore(self.numbers(), Vec::new(), 0);
        grains
    }

    /// The step in which a grain that gains `gain` spacings a step gains what gravity gives it [s].
    fn time_step(&self, plan: &Plan, typed: Option<f64>, gain: f64, remarks: &mut Remarks) -> f64 {
        let key = format!("{}.time-step", plan.method.name());
        let dt = match typed {
            Some(dt) => dt,
            None if self.gravity > 0.0 => (gain * self.spacing / self.gravity).sqrt(),
            None => {
                remarks.refuse(key, "without gravity nothing tells how long a step is; give it a time");
                return 1.0;
            }
        };
        let fall = gain * self.spacing / (dt * dt);
        let other = if self.gravity > 0.0 && (fall / self.gravity - 1.0).abs() > 1e-6 {
            format!("; grains fall with {fall:.3} m/s^2 instead of {:.3}", self.gravity)
        } else {
            String::new()
        };
        let text = format!(
            "whoever flies has the speed {:.4} m/s: a spacing of {:.4} mm in a step of {:.4} ms{other}",
            self.spacing / dt,
            1e3 * self.spacing,
            1e3 * dt
        );
        remarks.approximate(key, text);
        dt
    }
}

/// The gas FHP of a plan, and its time step [s].
fn fhp(plan: &Plan, board: &Board, remarks: &mut Remarks) -> (Box<dyn Model>, f64) {
    let plan::Fhp { rules, gravity, walls, spacing: _, time_step } = plan.fhp;
    let Sites { columns, rows, periodic } = board.sites;
    let rules = match rules {
        FhpRules::One => Rules::One,
        FhpRules::Two => Rules::Two,
        FhpRules::Three => Rules::Three,
    };
    let mut gas = Gas::new(rules, columns, rows, periodic, plan.seed);
    let smooth = walls == GasWalls::Smooth;
    for (column, row) in board.walls() {
        let mirror = if smooth { board.sites.mirror(column, row, |site| board.is_wall(site)) } else { None };
        gas.wall(column, row, mirror);
    }
    // A turn along z gives two spacings a step and is possible for one axis of three, one along x gives sqrt(3) for two.
    let free = board.sites.count() - board.walls().count();
    let filling = (board.count as f64 / (board.layers * free.max(1)) as f64).min(1.0);
    let gain = gravity * 2.0 * (1.0 - filling) / board.layers as f64;
    if board.gravity > 0.0 {
        let [x, _, z] = plan.gravity.map(|part| part / board.gravity);
        gas.push([gravity * x / 3.0_f64.sqrt(), gravity * z]);
    }
    if filling >= 1.0 && time_step.is_none() {
        remarks.refuse("particles", "every slot of every site is taken, so that nobody can turn; take fewer grains");
    }
    let dt = board.time_step(plan, time_step, gain, remarks);
    (Box::new(Fhp::new(gas, board.sites, board.numbers(), board.outlets.clone(), smooth)), dt)
}

/// The friction of a material as the probability that a grain of it stops when it slides.
fn friction(plan: &Plan, material: &str, remarks: &mut Remarks) -> f64 {
    let friction = plan.materials.get(material).map_or(0.0, |material| material.friction);
    if friction > 1.0 {
        let text = format!("{friction} is no probability to stop; here it has to be at most 1");
        remarks.refuse(format!("materials.{material}.friction"), text);
    }
    friction
}
