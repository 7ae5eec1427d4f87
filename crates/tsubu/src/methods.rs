//! The door to all methods: which engine a plan's method names.

use crate::clca::engine::ClCaEngine;
use crate::dem::DemEngine;
use crate::engine::{Engine, OpenError, Refusal};
use crate::lattice::engine::LatticeEngine;
use crate::lattice::site::build;
use crate::lattice::site::rule::{GasRule, SiteRule};
use crate::memory::refuse_more_than_there_is;
use crate::partner::Hosts;
use crate::ranks::Communicator;
use std::sync::Arc;
use tsubu_scene::plan::{GrainShape, Method, Particles, Plan};

/// Builds the engine that the plan's method names, at time 0.
pub fn open(plan: &Plan, hosts: &Hosts) -> Result<Box<dyn Engine>, OpenError> {
    open_on_ranks(plan, hosts, None)
}

/// The same on this rank of several, which all do so.
pub fn open_on_ranks(
    plan: &Plan,
    hosts: &Hosts,
    communicator: Option<Arc<dyn Communicator>>,
) -> Result<Box<dyn Engine>, OpenError> {
    if communicator.is_some() && plan.method != Method::Dem {
        return Err(Refusal::ranks(plan.method.name()).into());
    }
    if plan.stage.len() > 1 && plan.method != Method::Dem {
        return Err(Refusal::stages(plan.method.name()).into());
    }
    let cells = |group: &Particles| matches!(group.shape, GrainShape::Cells { .. });
    let takes = |group: &Particles| plan.method == Method::Dem || (plan.method == Method::ClCa && cells(group));
    if let Some((name, group)) = plan.particles.iter().find(|(_, group)| group.shape.is_clump() && !takes(group)) {
        return Err(Refusal::clumps(plan.method.name(), name, cells(group)).into());
    }
    if !plan.bond.is_empty() && plan.method != Method::Dem {
        return Err(Refusal::bonds(plan.method.name()).into());
    }
    refuse_more_than_there_is(plan, 0)?;
    let rule = match plan.method {
        Method::Dem => return Ok(Box::new(DemEngine::on_ranks(plan, hosts, communicator)?)),
        Method::Lattice => return Ok(Box::new(LatticeEngine::new(plan, hosts)?)),
        Method::ClCa => return Ok(Box::new(ClCaEngine::new(plan, hosts)?)),
        Method::Litwiniszyn => SiteRule::Litwiniszyn,
        Method::AfterCaramHong => SiteRule::CaramHong,
        Method::AfterSavage => SiteRule::Savage,
        Method::GuttHaff => SiteRule::GuttHaff,
        Method::AfterHemmingssonHerrmann => SiteRule::HemmingssonHerrmann,
        Method::Fhp => SiteRule::Gas(GasRule::Fhp),
        Method::AfterPengHerrmann => SiteRule::Gas(GasRule::PengHerrmann),
        Method::AfterBaxterBehringer => SiteRule::Gas(GasRule::BaxterBehringer),
        Method::AfterKarolyiKertesz => SiteRule::Gas(GasRule::KarolyiKertesz),
    };
    Ok(Box::new(build::open(plan, rule, hosts)?))
}
