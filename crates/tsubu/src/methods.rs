//! The door to all methods: which engine a plan's method names, and what is known of a method before its engine is there.

use crate::clca::engine::ClCaEngine;
use crate::dem::DemEngine;
use crate::engine::{Engine, OpenError};
use crate::lattice::engine::LatticeEngine;
use crate::lattice::site::build;
use crate::lattice::site::rule::{GasRule, SiteRule};
use crate::memory::refuse_more_than_there_is;
use crate::partner::Hosts;
use tsubu_scene::plan::{Method, Plan};

/// What runs a method.
enum Kind {
    Dem,
    Lattice,
    ClCa,
    Sites(SiteRule),
}

const fn kind(method: Method) -> Kind {
    match method {
        Method::Dem => Kind::Dem,
        Method::Lattice => Kind::Lattice,
        Method::ClCa => Kind::ClCa,
        Method::Litwiniszyn => Kind::Sites(SiteRule::Litwiniszyn),
        Method::AfterCaramHong => Kind::Sites(SiteRule::CaramHong),
        Method::AfterSavage => Kind::Sites(SiteRule::Savage),
        Method::GuttHaff => Kind::Sites(SiteRule::GuttHaff),
        Method::AfterHemmingssonHerrmann => Kind::Sites(SiteRule::HemmingssonHerrmann),
        Method::Fhp => Kind::Sites(SiteRule::Gas(GasRule::Fhp)),
        Method::AfterPengHerrmann => Kind::Sites(SiteRule::Gas(GasRule::PengHerrmann)),
        Method::AfterBaxterBehringer => Kind::Sites(SiteRule::Gas(GasRule::BaxterBehringer)),
        Method::AfterKarolyiKertesz => Kind::Sites(SiteRule::Gas(GasRule::KarolyiKertesz)),
    }
}

/// Builds the engine that the plan's method names, at time 0.
pub fn open(plan: &Plan, hosts: &Hosts) -> Result<Box<dyn Engine>, OpenError> {
    refuse_more_than_there_is(plan, 0)?;
    Ok(match kind(plan.method) {
        Kind::Dem => Box::new(DemEngine::new(plan, hosts)?),
        Kind::Lattice => Box::new(LatticeEngine::new(plan, hosts)?),
        Kind::ClCa => Box::new(ClCaEngine::new(plan, hosts)?),
        Kind::Sites(rule) => Box::new(build::open(plan, rule, hosts)?),
    })
}
