//! What tsubu is held against: every claim re-run by one command, `tsubu verify`.

mod apparent_mass;
mod bedload;
mod beds;
mod bench;
mod brazil_nut;
mod carried;
mod case;
mod case_run;
mod chaotic;
mod chung_ooi_2011;
mod chute;
mod cl_ca_2001;
mod cohesion;
mod common_test;
mod contact;
mod control;
mod cooling;
mod damper_2003;
mod drop;
mod drum;
mod drum_regimes;
mod ensemble;
mod expansion;
mod film;
mod gdr_midi_2004;
mod held;
mod host;
mod impact_damper;
mod keep;
mod lattice_grain;
mod lattice_review;
mod lump;
mod moved;
mod mutants;
mod open_dem_benchmark;
mod order;
mod orifice;
mod origin;
mod outlet;
mod packing;
mod pile_stress;
mod pile_twin;
mod plastic;
mod prediction;
mod random_loads;
mod reasons;
mod recorded;
mod registry;
mod rheology;
mod rock_core;
mod rods;
mod rolling;
mod sediment_2004;
mod shapes;
mod sieving;
mod silo;
mod spin_in_water;
mod stack;
mod throw;
mod triaxial;
mod twisting;
mod voids;
mod water;
mod window;

pub use case::{Case, How, Judged};
pub use case_run::{CaseRun, Done};
pub use chaotic::{Chaotic, chaotic, one_draw};
pub use control::is_missing as lacks_control;
pub use keep::Archive;
pub use moved::{Moved, moved};
pub use mutants::{MUTATED_LONGEST, Mutant, mutants, mutants_not_run};
pub use reasons::reason;
pub use recorded::{recorded, recorded_run};
pub use registry::CASES;

/// The cases that the given names choose: case names or study names; none given means all quick ones.
/// Fails with the first name that is neither.
pub fn chosen(names: &[String], all: bool) -> Result<Vec<&'static Case>, String> {
    if names.is_empty() {
        return Ok(CASES.iter().filter(|c| all || c.is_quick()).collect());
    }
    let mut chosen = Vec::new();
    for name in names {
        let before = chosen.len();
        chosen.extend(CASES.iter().filter(|c| c.name == name || c.study == name));
        if chosen.len() == before {
            return Err(format!("there is no verification case or study `{name}`; `tsubu verify --list` shows them"));
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names and studies do not clash, so that a name means one thing.
    #[test]
    fn names_are_unique() {
        for (i, case) in CASES.iter().enumerate() {
            assert!(CASES[i + 1..].iter().all(|c| c.name != case.name), "{} twice", case.name);
            assert!(CASES.iter().all(|c| c.study != case.name), "{} is a study too", case.name);
        }
        assert!(chosen(&["no such case".to_owned()], false).is_err());
    }
}
