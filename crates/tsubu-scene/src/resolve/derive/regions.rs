//! The box around a round region.

use super::Derive;
use crate::complaint::Complaint;
use crate::plan::{Ball, Cylinder, Vector};
use serde::Deserialize;
use toml::{Table, Value};

impl Derive<'_> {
    /// Draws the box around every cylinder and sphere that is a region.
    pub(super) fn regions(&mut self, resolved: &mut Table) {
        let flat = resolved.get("dimension").and_then(Value::as_integer) != Some(3);
        for family in ["particles", "removal", "watch"] {
            if let Some(tables) = resolved.get_mut(family).and_then(Value::as_table_mut) {
                self.regions_in(tables, &mut vec![family.to_owned()], flat);
            }
        }
    }

    fn regions_in(&mut self, table: &mut Table, path: &mut Vec<String>, flat: bool) {
        for (key, value) in table.iter_mut() {
            let Some(inner) = value.as_table_mut() else { continue };
            path.push(key.clone());
            if key == "region" {
                self.around(inner, path, flat);
            } else {
                self.regions_in(inner, path, flat);
            }
            path.pop();
        }
    }

    fn around(&mut self, region: &mut Table, path: &[String], flat: bool) {
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        let ends = shape::<Cylinder>(region, "cylinder").map(|bar| bar.ends());
        let ends = ends.or_else(|| shape::<Ball>(region, "sphere").map(|ball| ball.ends()));
        let Some(ends) = ends else {
            // What is wrong has its own complaint.
            let typed = |key: &str| self.typed(&[&path, &[key][..]].concat());
            let round = typed("cylinder") || typed("sphere");
            if let Some(key) = ["low", "high"].into_iter().find(|key| !region.contains_key(*key) && !typed(key))
                && !round
            {
                let place = self.root.locate(&path);
                self.complain(
                    Complaint::new(format!("missing key `{key}` in [{}]", path.join(".")))
                        .at(&place, format!("needs `{key}`"))
                        .hint("region = { low = [\"-30 mm\", 0], high = [\"30 mm\", \"96 mm\"] }, three entries each in space")
                        .hint("or `cylinder`, or `sphere`: region.sphere = { centre = [0, 0, \"50 mm\"], radius = \"20 mm\" }"),
                );
            }
            return;
        };
        for (key, mut end) in ["low", "high"].into_iter().zip(ends) {
            if flat {
                end[1] = 0.0;
            }
            let told = region.insert(key.into(), Value::Array(end.map(Value::Float).to_vec()));
            if told.and_then(|told| told.try_into::<Vector>().ok()).is_some_and(|told| told != end) {
                let place = self.root.locate(&[&path, &[key][..]].concat());
                self.complain(
                    Complaint::new(format!("`{key}` is not that of the box around the region"))
                        .at(&place, format!("it is {end:?} m"))
                        .hint("leave `low` and `high` out where a region is a cylinder or a sphere"),
                );
            }
        }
    }
}

fn shape<T: for<'a> Deserialize<'a>>(region: &Table, key: &str) -> Option<T> {
    region.get(key)?.clone().try_into().ok()
}
