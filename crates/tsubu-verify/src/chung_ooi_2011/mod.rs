//! Chung and Ooi 2011: eight tests of single contacts (Granular Matter 13, 643).

mod normal;
mod oblique;
mod spin;

pub(super) use normal::{elastic, restitution};
pub(super) use oblique::{gross_sliding, kharaz, kharaz_default};
pub(super) use spin::{no_slip, spinning};

/// A material of the tests: Young's modulus [Pa], Poisson's ratio, density [kg/m^3].
#[derive(Clone, Copy)]
struct Material {
    name: &'static str,
    young: f64,
    poisson: f64,
    density: f64,
}

const fn material(name: &'static str, young: f64, poisson: f64, density: f64) -> Material {
    Material { name, young, poisson, density }
}

const OXIDE: Material = material("aluminium oxide", 380e9, 0.23, 4000.0);
const ALLOY: Material = material("aluminium alloy", 70e9, 0.33, 2700.0);

impl Material {
    /// The start of a throw of a ball of this material.
    fn throw(&self) -> super::throw::Throw<'static> {
        super::throw::Throw {
            young: self.young,
            poisson: self.poisson,
            density: self.density,
            ..super::throw::Throw::default()
        }
    }
}
