//! From a plan to grains on a lattice: what CL-CA honours, what it approximates and by how much, and what it refuses.

use super::bed::Bed;
use super::kinds::{kinds, shapes, spacing};
use super::place::{self, Grain};
use crate::check;
use crate::engine::{Note, Refusal};
use crate::lattice::grid::WALL;
use crate::lattice::reach::{self, Ways};
use crate::lattice::remarks::{Pull, Remarks, World};
use crate::lattice::site::ground::Sites;
use crate::lattice::stage::{self, LARGEST, Stage};
use crate::memory::refuse_more_than_there_is;
use crate::partner::Hosts;
use crate::view::{Contacts, Wants};
use crate::wall::{Mover, Wall};
use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_scene::plan::{self, ClCaRule, GrainMotion, Plan, Removal, Signal, Start};

/// Everything that the engine needs from a plan.
pub(super) struct Built {
    pub bed: Bed,
    pub stage: Stage,
    pub walls: Vec<Wall>,
    pub notes: Vec<Note>,
    pub dt: f64,
    /// Whether bodies push.
    pub passive: bool,
    /// Every grain of groups that come later, by group.
    pub streams: Vec<GrainStream>,
}

/// A group that comes in one by one.
#[derive(Clone, Debug)]
pub(super) struct GrainStream {
    pub grains: Vec<Grain>,
    pub region: plan::Region,
    /// Grains per second.
    pub rate: f64,
    /// When the first comes [s].
    pub from: f64,
    /// How many have come.
    pub placed: usize,
}

/// What a watch may look at.
pub(super) const OFFERED: Wants = Wants { contacts: Contacts::Places, bodies: true, ..Wants::GRAINS };

/// Takes the plan apart, every field by name, so that a new field does not compile until it has been decided on here.
pub(super) fn build(plan: &Plan, hosts: &Hosts) -> Result<Built, Refusal> {
    let Plan {
        title: _,
        method: _,
        dimension: _, // As periodic and water: read by `Remarks::world`.
        seed,
        gravity,
        duration,
        speed_scale: _, // Only chooses DEM's step.
        materials: _,
        material_pair: _,
        particles: _,
        walls: _,
        periodic: _,
        removal,
        water: _,
        hosts: _,
        contact: _,
        bond: _,
        dem: _,
        lattice: _,
        cl_ca,
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
        start_from: _,
        start_fingerprint: _,
        start_at_zero: _,
        stage: _,
        claim: _,
    } = plan;
    let mut remarks = Remarks::of("cl-ca");
    let world = World { noun: "grains of lattice points", gravity: Pull::DownOrNone, periodic: [false; 2] };
    remarks.world(plan, world);
    remarks.refusal().map_or(Ok(()), Err)?;
    let forceless = "no forces: grains move where there is room, whatever their stiffness, restitution and friction";
    remarks.approximate("contact", forceless);
    remarks.watches(watch, plan, OFFERED);
    let walls: Vec<Wall> =
        plan.walls.iter().map(|(name, wall)| Wall::new(name, wall, 2, hosts, DVec3::from_array(*gravity))).collect();
    let moved = movers(plan, &mut remarks);
    let shapes = shapes(plan, &mut remarks);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    let spacing = spacing(plan, &shapes, &mut remarks);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    let (kinds, grains) = kinds(plan, &shapes, spacing, &mut remarks);
    let travel = plan.walls.values().filter_map(|wall| wall.motion.as_ref());
    let travel = travel.map(|motion| farthest(&motion.signal, *duration)).fold(0.0, f64::max);
    let margin = 4.0 * plan.particles.values().map(plan::Particles::largest_diameter).fold(0.0, f64::max) + travel;
    let region = cl_ca.region.clone().or_else(|| stage::region(plan, &walls, margin));
    let Some((region, stage)) = stage_of(region, spacing, &mut remarks) else { return Err(refusal(&remarks)) };
    refuse_more_than_there_is(plan, stage.columns * stage.rows)?;
    let mut bed = Bed::new(stage.grid(), kinds, *seed, cl_ca.memory);
    for wall in &walls {
        stage.paint(&mut bed.grid, wall);
    }
    place::place(plan, &stage, &grains, &mut bed, &mut remarks);
    let height = cl_ca.fall_height.unwrap_or(region.high[2] - region.low[2]);
    let dt = time_step(-gravity[2], height, &moved, *duration, &stage, &mut remarks);
    remarks_on_starts(plan, &mut remarks);
    if let Some(refusal) = remarks.refusal() {
        return Err(refusal);
    }
    let passive = match cl_ca.rule {
        ClCaRule::Automatic => !moved.is_empty(),
        ClCaRule::Active => false,
        ClCaRule::Passive => true,
    };
    if passive && plan.particles.values().any(|group| matches!(group.start, Start::Stream { .. })) {
        let text = "grains come in by a stream under the active rule alone; let them be there from the start";
        remarks.refuse("cl-ca.rule", text);
        return Err(refusal(&remarks));
    }
    let streams = plan.particles.values().zip(grains).filter_map(|(group, grains)| match &group.start {
        Start::Stream { region, rate, from, .. } => {
            Some(GrainStream { grains, region: region.clone(), rate: *rate, from: *from, placed: 0 })
        }
        _ => None,
    });
    let streams: Vec<GrainStream> = streams.collect();
    if moved.is_empty() {
        remark_removal(removal, &stage, &bed, &walls, &streams, &mut remarks);
    }
    Ok(Built { bed, stage, walls, notes: remarks.notes, dt, passive, streams })
}

/// Says which regions of removal no grain can come to; walls that move may let them.
fn remark_removal(
    removal: &BTreeMap<String, Removal>,
    stage: &Stage,
    bed: &Bed,
    walls: &[Wall],
    streams: &[GrainStream],
    remarks: &mut Remarks,
) {
    if removal.is_empty() {
        return;
    }
    let grid = &mut stage.grid();
    walls.iter().filter(|wall| wall.until.is_none()).for_each(|wall| stage.paint(grid, wall));
    let grid = &*grid;
    let ways = Ways {
        sites: Sites::Upright,
        size: [stage.columns, stage.rows],
        periodic: [false; 2],
        open: &|column, row| grid.at(grid.index(column, row)) != WALL,
        point: &|column, row| stage.position(bed.vector(grid.index(column, row))),
        spacing: stage.spacing,
    };
    let grains = bed.present().map(|grain| bed.grains.cell[grain] as usize);
    let middle = |stream: &GrainStream| {
        let (low, high) = (DVec3::from_array(stream.region.low), DVec3::from_array(stream.region.high));
        stage.cell(grid, 0.5 * (low + high))
    };
    let begin = grains.chain(streams.iter().filter_map(middle)).map(|cell| grid.column_and_row(cell));
    reach::remark(removal, &ways, begin, remarks);
}

/// The lattice of a region; `None` if there is none, and said why.
fn stage_of(region: Option<plan::Region>, spacing: f64, remarks: &mut Remarks) -> Option<(plan::Region, Stage)> {
    let key = "cl-ca.region";
    let Some(region) = region else {
        remarks.refuse(key, "nothing in the scene tells where the lattice ends; give `low` and `high`");
        return None;
    };
    let stage = Stage::new(&region, spacing);
    if stage.is_none() {
        let size = [region.high[0] - region.low[0], region.high[2] - region.low[2]];
        remarks.refuse(
            key,
            format!(
                "a lattice of {:.4} m by {:.4} m with points {spacing:.3e} m apart has less than one point across or more than {LARGEST:.0e}; change it, or `cl-ca.spacing`",
                size[0], size[1]
            ),
        );
    }
    Some((region, stage?))
}

fn refusal(remarks: &Remarks) -> Refusal {
    remarks.refusal().unwrap_or(Refusal { method: "cl-ca", notes: Vec::new() })
}

/// What moves as told: walls and driven groups. Other ways to move a wall need forces.
fn movers<'a>(plan: &'a Plan, remarks: &mut Remarks) -> Vec<&'a Signal> {
    let mut moved = Vec::new();
    for (name, wall) in &plan.walls {
        for (key, there) in [
            ("host", wall.host.is_some()),
            ("servo", wall.servo.is_some()),
            ("body", wall.body.is_some()),
            ("rotation", wall.rotation.is_some()),
        ] {
            if there {
                remarks.refuse(
                    format!("walls.{name}.{key}"),
                    "walls of CL-CA stand still, move by `motion`, or vanish by `until`; use `method = \"dem\"`",
                );
            }
        }
        moved.extend(wall.motion.as_ref().map(|motion| &motion.signal));
    }
    for group in plan.particles.values() {
        if let GrainMotion::Driven { signal, .. } = &group.motion {
            moved.push(signal);
        }
    }
    if plan.cl_ca.rule == ClCaRule::Active && !moved.is_empty() {
        remarks.refuse(
            "cl-ca.rule",
            "nothing pushes under the active rule, but a wall or a group moves; leave `rule` out, or set it to \"passive\"",
        );
    }
    if plan.cl_ca.turning && (plan.cl_ca.rule == ClCaRule::Passive || !moved.is_empty()) {
        remarks.refuse("cl-ca.turning", "grains turn under the active rule alone; set it to false");
    }
    moved
}

/// How far a motion takes a wall from where it stands at time 0 in a run, at most [m].
fn farthest(signal: &Signal, duration: f64) -> f64 {
    (2.0 * check::peak(signal)).min(check::fastest(signal) * duration)
}

/// The time in which a grain falls by one spacing, so that it falls by `height` in the time of free fall; shorter where
/// a wall or group moves faster than that [s].
fn time_step(gravity: f64, height: f64, moved: &[&Signal], duration: f64, stage: &Stage, remarks: &mut Remarks) -> f64 {
    let fall = if gravity > 0.0 { stage.spacing * (2.0 / (gravity * height)).sqrt() } else { f64::INFINITY };
    let fastest = moved.iter().map(|signal| check::fastest(signal)).fold(0.0, f64::max);
    let dt = fall.min(stage.spacing / fastest);
    if !dt.is_finite() {
        remarks.refuse("gravity", "without gravity and without a wall or group that moves, nothing happens");
        return duration;
    }
    remarks.approximate(
        "cl-ca.fall-height",
        format!(
            "grains fall at one speed, {:.3} m/s: one spacing of {:.3} mm in a step of {:.3e} s",
            stage.spacing / dt,
            1e3 * stage.spacing,
            dt
        ),
    );
    dt
}

/// What of the beginning cells cannot follow.
fn remarks_on_starts(plan: &Plan, remarks: &mut Remarks) {
    for (name, group) in &plan.particles {
        let key = format!("particles.{name}.start");
        let stirred = match &group.start {
            Start::Rows { speed, .. } => *speed != 0.0,
            Start::Random { velocity, speed, .. } | Start::Stream { velocity, speed, .. } => {
                *velocity != [0.0; 3] || *speed != 0.0
            }
            Start::At { velocity, spin, .. } => !velocity.is_empty() || !spin.is_empty(),
            Start::File { grains, .. } => !grains.velocity.is_empty() || !grains.spin.is_empty(),
            Start::Settled { .. } => false,
        };
        if stirred {
            remarks.approximate(key, "grains begin at rest: a velocity is what the last step was");
        }
    }
}

/// Whether a wall moves as told.
pub(super) fn moves(wall: &Wall) -> bool {
    matches!(wall.mover, Mover::Motion(..))
}
