//! Bonds that cannot do what they say.

use super::{Parts, list};
use crate::complaint::Complaint;
use crate::plan::Bond;
use toml::Value;

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let bonds = list::<Bond>(parts.resolved, "bond");
    let of = |table: &str, key: &str| parts.resolved.get(table).and_then(|table| table.get(key));
    for (index, bond) in &bonds {
        let at = |key: &str| parts.root.locate(&["bond", index, key]);
        if bond.weibull_modulus.is_some() && !bond.breaks() {
            complaints.push(
                Complaint::new("a scatter of strengths needs strengths")
                    .at(&at("weibull-modulus"), "of bonds that never break")
                    .hint("give `tensile-strength`, `shear-strength`, or both"),
            );
        }
        if of("contact", "rotation").and_then(Value::as_bool) == Some(false) {
            complaints.push(
                Complaint::new("bonds bend and twist, so their grains must rotate")
                    .at(&parts.root.locate(&["bond", index]), "bonds here")
                    .also(&parts.root.locate(&["contact", "rotation"]), "rotation is off")
                    .hint("leave `contact.rotation` out"),
            );
        }
        let integrator = of("dem", "integrator").and_then(Value::as_str).unwrap_or_default();
        if integrator != "velocity-verlet" {
            complaints.push(
                Complaint::new(format!("bonds are not moved by `{integrator}`"))
                    .at(&parts.root.locate(&["bond", index]), "bonds here")
                    .also(&parts.root.locate(&["dem", "integrator"]), "told here")
                    .hint("leave `dem.integrator` out: velocity Verlet"),
            );
        }
        if let Some(duration) = parts.resolved.get("duration").and_then(Value::as_float)
            && bond.at >= duration
        {
            complaints.push(
                Complaint::new("these bonds are made after the end of the run")
                    .at(&at("at"), format!("{} s", bond.at))
                    .also(&parts.root.locate(&["duration"]), format!("the run ends at {duration} s")),
            );
        }
    }
}
