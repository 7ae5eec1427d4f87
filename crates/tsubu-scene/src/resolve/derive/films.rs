//! Films of liquid between bodies: of which liquid, how rough, how far.

use super::{Derive, table_at};
use crate::complaint::Complaint;
use toml::Value;

/// Shares of the smallest diameter.
const ROUGHNESS: f64 = 0.001;
const REACH: f64 = 0.1;

/// What a film is told by.
#[derive(Clone, Copy)]
struct Around {
    /// Density times kinematic viscosity of the water [Pa.s].
    viscosity: Option<f64>,
    /// Smallest diameter of the grains [m].
    smallest: Option<f64>,
}

impl Derive<'_> {
    /// Fills the films of the scene's contact law and of those of pairs of materials.
    pub(super) fn films(&mut self, resolved: &mut toml::Table) {
        let number = |table: &toml::Table, key: &str| table.get(key).and_then(Value::as_float);
        let water = table_at(resolved, "water");
        let viscosity = water.and_then(|water| Some(number(water, "density")? * number(water, "viscosity")?));
        let around = Around { viscosity, smallest: smallest_diameter(resolved) };
        if let Some(contact) = resolved.get_mut("contact").and_then(Value::as_table_mut) {
            self.film(contact, &["contact"], around);
        }
        let pairs = resolved.get_mut("material-pair").and_then(Value::as_array_mut).into_iter().flatten();
        for (index, pair) in pairs.enumerate() {
            if let Some(contact) = pair.get_mut("contact").and_then(Value::as_table_mut) {
                self.film(contact, &["material-pair", &index.to_string(), "contact"], around);
            }
        }
    }

    fn film(&mut self, contact: &mut toml::Table, path: &[&str], around: Around) {
        let Some(film) = contact.get_mut("film").and_then(|film| film.get_mut("lubrication")) else { return };
        let Some(film) = film.as_table_mut() else { return };
        let path = [path, &["film", "lubrication"]].concat();
        let typed = |me: &Self, key: &str| me.typed(&[path.as_slice(), &[key]].concat());
        for (key, value, why, hint) in [
            (
                "viscosity",
                around.viscosity,
                "there is no [water] to take it from",
                "add [water], or give viscosity = \"1 mPa s\" here",
            ),
            (
                "roughness",
                around.smallest.map(|d| ROUGHNESS * d),
                "there are no grains to take it from",
                "roughness = \"2 um\": about a thousandth of a diameter",
            ),
            (
                "reach",
                around.smallest.map(|d| REACH * d),
                "there are no grains to take it from",
                "reach = \"0.2 mm\": about a tenth of a diameter",
            ),
        ] {
            match value {
                _ if film.contains_key(key) || typed(self, key) => {}
                Some(value) => {
                    film.insert(key.into(), Value::Float(value));
                }
                // A wrong key in the water has its own complaint.
                None if key == "viscosity" && self.typed(&["water"]) => {}
                None => self.complain(
                    Complaint::new(format!("the film between grains has no `{key}`"))
                        .at(&self.root.locate(&path), format!("needs `{key}`: {why}"))
                        .hint(hint),
                ),
            }
        }
        let number = |key: &str| film.get(key).and_then(Value::as_float);
        if let (Some(roughness), Some(reach)) = (number("roughness"), number("reach"))
            && reach <= roughness
        {
            let at = |key: &str| self.root.locate(&[path.as_slice(), &[key]].concat());
            self.complain(
                Complaint::new("the film between grains ends before it begins")
                    .at(&at("reach"), format!("reaches {reach} m"))
                    .also(&at("roughness"), format!("is {roughness} m"))
                    .hint("`reach` is some ten to a hundred times `roughness`"),
            );
        }
    }
}

/// Smallest diameter of all grains.
fn smallest_diameter(resolved: &toml::Table) -> Option<f64> {
    let groups = table_at(resolved, "particles")?.values();
    groups.filter_map(|group| group.get("diameter")?.as_float()).reduce(f64::min)
}
