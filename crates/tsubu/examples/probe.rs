//! Scratch.
use std::collections::BTreeMap;
use std::time::Instant;
use tsubu::dem::DemEngine;
use tsubu::engine::{stocks, Engine};
use tsubu::ledger::{Ledger, Account};
use tsubu::partner::Hosts;
use tsubu_scene::plan::*;

fn plan(n: usize, literal: bool, dt: Option<f64>) -> Plan {
    Plan {
        title: String::new(), method: Method::Dem, dimension: 2, seed: 1, gravity: [0.0,0.0,-10.0], duration: 1.0, speed_scale: None,
        materials: BTreeMap::from([("acrylic".into(), Material{young_modulus:0.5e9, poisson_ratio:0.3, restitution:0.75, friction:0.5, rolling_friction:0.0, density:None})]),
        material_pair: vec![],
        particles: BTreeMap::from([("balls".into(), Particles{material:"acrylic".into(), count:n, diameter:6e-3, mass:0.2e-3, start: Start::Settled{time:1.0}})]),
        walls: BTreeMap::from([("casing".into(), Wall{material:"acrylic".into(), shape: Shape::Box{width:0.06,height:0.096,depth:0.006,floor_centre:[0.0;3]}, host: Some("s".into()), motion: None})]),
        hosts: BTreeMap::from([("s".into(), Host{structure: Structure::Oscillator{mass:0.086,stiffness:123.4,damping:0.08}, direction:[0.0,0.0,1.0], base: Some(Signal::Sine{amplitude:0.5e-3, frequency:5.75, phase:0.0}), force:None, displacement:0.0, velocity:0.0})]),
        contact: if literal { Contact{normal:Normal::Hertz{}, damping:Damping::Sqrt{reference_speed:1.0}, attraction:true, tangential:Tangential::Coulomb{smoothing_speed:1e-3}, rolling:Rolling::None{}, rotation:false} }
          else { Contact{normal:Normal::Hertz{}, damping:Damping::Quarter{}, attraction:false, tangential:Tangential::Mindlin{}, rolling:Rolling::None{}, rotation:true} },
        dem: Dem{time_step: dt, steps_per_contact:20.0, integrator:Integrator::VelocityVerlet, skin:0.3, largest_overlap:0.1, energy_tolerance:1e-3},
        lattice: Lattice{mode:LatticeMode::Literal,time_step:1e-4,oblique_gravity:ObliqueGravity::Projected,collision:Collision::Pairwise,rebound_scatter:true,reset_when_blocked:true,keep_remainder:true,resting_impulses:false,resting_threshold:2.0,arithmetic:Arithmetic::Fixed,head_room:8},
        response: None, sweep: None, output: Output{history_interval:1e-3,frame_interval:None,checkpoint_interval:1.0,xyz:false}, claim: vec![],
    }
}

fn main() {
    for literal in [true, false] {
        for dt in [Some(2e-5), None, Some(2.5e-6)] {
            let n = 50;
            let p = plan(n, literal, dt);
            let mut hosts = Hosts::new(&p.hosts);
            let t0 = Instant::now();
            let mut e = match DemEngine::new(&p, &hosts) { Ok(e) => e, Err(x) => { println!("{literal} {dt:?} {x}"); continue } };
            let build = t0.elapsed().as_secs_f64();
            let mut ledger = Ledger::open(stocks(&e, &hosts), e.momentum());
            let steps = (2.0 / e.time_step()) as u64;
            let t0 = Instant::now();
            let mut zmax: f64 = 0.0;
            for _ in 0..steps/10 { if let Err(x) = e.advance(10, &mut hosts, &mut ledger) { println!("{x}"); break; } zmax = zmax.max(hosts.list[0].displacement().abs()); }
            let wall = t0.elapsed().as_secs_f64();
            let now = stocks(&e, &hosts);
            println!("literal {literal} dt {:.3e} build {build:.2}s  {:.0} ns/step  {:.2} Mps/s  zmax {zmax:.4} residual {:.3e} rel {:.3e} mom {:?}", e.time_step(), wall/steps as f64*1e9, n as f64*steps as f64/wall/1e6, ledger.residual(&now), ledger.residual_relative(&now), ledger.momentum_residual(e.momentum()));
            println!("   {:?}", Account::ALL.map(|a| (a.name(), ledger.flow(a))));
            println!("   host impulse {} wall impulse {:?} pairs {}", ledger.host_impulse, ledger.wall_impulse, e.contacts());
        }
    }
}
