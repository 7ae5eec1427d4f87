//! The stream: what drives it, and what it flows over.

use super::{Derive, groups_by_name};
use crate::complaint::Complaint;
use crate::plan::Directions;
use toml::Value;

/// What the log law's slope and its constant say: U = U* (8.5 + 5.75 log10(Z/k)).
const CONSTANT: f64 = 8.5;
const PER_DECADE: f64 = 5.75;

impl Derive<'_> {
    /// Turns gravity that was given as a number down the slope.
    pub(super) fn slope(&mut self, resolved: &mut toml::Table) {
        let Some(slope) = resolved.remove("slope").and_then(|slope| slope.as_float()) else { return };
        let place = self.root.locate(&["slope"]);
        if slope.abs() >= std::f64::consts::FRAC_PI_2 {
            self.complain(
                Complaint::new("the slope is too steep")
                    .at(&place, format!("{:.4} deg", slope.to_degrees()))
                    .hint("give less than 90 deg either way"),
            );
            return;
        }
        let Some(gravity) = resolved.get_mut("gravity").and_then(Value::as_array_mut) else { return };
        let entries: Vec<f64> = gravity.iter().filter_map(Value::as_float).collect();
        let &[x, y, z] = entries.as_slice() else { return };
        if x != 0.0
            || y != 0.0
            || self.root.find(&["gravity"]).is_some_and(|typed| matches!(typed.value, crate::node::Value::List(_)))
        {
            self.complain(
                Complaint::new("`slope` and a direction of gravity exclude each other")
                    .at(&place, "turns gravity")
                    .also(&self.root.locate(&["gravity"]), "has a direction of its own")
                    .hint("give gravity as a number, or leave out `slope`"),
            );
            return;
        }
        gravity[0] = Value::Float(-z * slope.sin());
        gravity[2] = Value::Float(z * slope.cos());
    }

    /// What follows from others in the water.
    pub(super) fn water(&mut self, resolved: &mut toml::Table) {
        self.stream(resolved);
        self.fluctuation(resolved);
    }

    /// How long the water around a grain keeps its velocity: with the variance of the fluctuation upwards, what Rouse's parabola
    /// k U* Z (1 - Z/h), k = 0.40, diffuses in the mean over the depth h. In a coupled stream the variance goes with the stress, as
    /// 1 - Z/h: its mean is half of that at the bed.
    fn fluctuation(&mut self, resolved: &mut toml::Table) {
        let path = ["water", "fluctuation"];
        if !self.typed(&path) {
            return;
        }
        let place = self.root.locate(&path);
        let along = gravity_along(resolved);
        let Some(water) = resolved.get_mut("water").and_then(Value::as_table_mut) else { return };
        let number = |table: &toml::Table, key: &str| table.get(key).and_then(Value::as_float);
        let law = |name: &str| water.get("flow")?.get(name)?.as_table();
        let (shear, depth, mean) = if let Some(law) = law("log-law") {
            let shear = number(law, "shear-velocity");
            let depth = number(law, "zero-level").zip(number(water, "surface")).map(|(level, surface)| surface - level);
            (shear, depth, 1.0)
        } else if let Some(law) = law("coupled") {
            let depth = number(law, "bottom").zip(number(law, "top")).map(|(bottom, top)| top - bottom);
            let driven = || depth.filter(|_| along > 0.0).map(|depth| (along * depth).sqrt());
            let carried = || {
                let (depth, k) = (depth?, number(law, "roughness")?);
                Some(number(law, "discharge")? / mean_speed(depth / k) / depth)
            };
            (number(law, "shear-velocity").or_else(driven).or_else(carried), depth, 0.5)
        } else {
            let flow = self.root.locate(&["water", "flow"]);
            self.complain(
                Complaint::new("only a log-law or coupled stream fluctuates")
                    .at(&place, "its strength is a share of the shear velocity")
                    .also(&flow, "without `log-law` or `coupled`")
                    .hint("leave `fluctuation` out, or write flow.log-law = { shear-velocity = \"0.1 m/s\" }"),
            );
            return;
        };
        let Some(told) = water.get_mut("fluctuation").and_then(Value::as_table_mut) else { return };
        if told.contains_key("time") || self.typed(&[path[0], path[1], "time"]) {
            return;
        }
        let stream = told.get("directions").and_then(Value::as_str) == Some("stream");
        let [_, _, up] = if stream { Directions::Stream } else { Directions::Even }.shares();
        match (depth.filter(|depth| *depth > 0.0), shear, number(told, "strength").map(|strength| strength * up)) {
            (Some(depth), Some(shear), Some(strength)) => {
                told.insert("time".into(), Value::Float(0.40 / 6.0 * depth / (mean * strength * strength * shear)));
            }
            (None, Some(_), _) => self.complain(
                Complaint::new("nothing says how long the water around a grain keeps its velocity")
                    .at(&place, "needs `time`: the stream has no depth to take it from")
                    .hint("`time`: for example \"0.05 s\"; below a depth h about h/(15 strength^2 U*)"),
            ),
            // What is wrong with the stream or the strength has its own complaint.
            _ => {}
        }
    }

    /// Shear velocity, roughness and surface of a stream.
    fn stream(&mut self, resolved: &mut toml::Table) {
        let diameter = mean_diameter(resolved);
        self.layers(resolved, diameter);
        let along = gravity_along(resolved);
        let Some(water) = resolved.get_mut("water").and_then(Value::as_table_mut) else { return };
        let path = ["water", "flow", "log-law"];
        let Some(law) = water.get_mut("flow").and_then(|flow| flow.get_mut("log-law")).and_then(Value::as_table_mut)
        else {
            return;
        };
        let root = self.root;
        let place = root.locate(&path);
        let typed = |key: &str| root.find(&[path[0], path[1], path[2], key]).is_some();
        let number = |law: &toml::Table, key: &str| law.get(key).and_then(Value::as_float);
        if !law.contains_key("roughness") && !typed("roughness") {
            if let Some(diameter) = diameter {
                law.insert("roughness".into(), Value::Float(diameter));
            } else {
                self.complain(
                    Complaint::new("the stream has no roughness")
                        .at(&place, "needs `roughness`: there are no grains to take it from")
                        .hint("roughness = \"2 mm\": the diameter of the grains of the bed"),
                );
            }
        }
        let depth = law.remove("depth").and_then(|depth| depth.as_float());
        let discharge = law.remove("discharge").and_then(|discharge| discharge.as_float());
        let roughness = number(law, "roughness");
        if !typed("shear-velocity") && !typed("discharge") && !typed("depth") {
            self.complain(
                Complaint::new("nothing says how fast the stream is")
                    .at(&place, "needs `shear-velocity`, `depth` or `discharge`")
                    .hint("`depth`: on a slope, for example depth = \"2 cm\" with slope = \"3 deg\" at the top")
                    .hint("`shear-velocity`: for example \"0.1 m/s\"")
                    .hint("`discharge`: of water per width, together with `depth`"),
            );
        } else if typed("discharge") && !typed("depth") {
            self.complain(
                Complaint::new("a discharge tells the speed of a stream only together with its depth")
                    .at(&self.root.locate(&[path[0], path[1], path[2], "discharge"]), "needs `depth` beside it"),
            );
        }
        let found = match (number(law, "shear-velocity"), discharge, depth) {
            (None, Some(discharge), Some(depth)) => roughness.map(|k| discharge / mean_speed(depth / k) / depth),
            (None, None, Some(depth)) => {
                // A slope that is wrong has its own complaint.
                let steep = self.root.find(&["slope"]).is_some() && along == 0.0 && !self.complaints.is_empty();
                if along <= 0.0 && !steep {
                    self.complain(
                        Complaint::new("the depth tells the speed of a stream only on a slope")
                            .at(
                                &self.root.locate(&[path[0], path[1], path[2], "depth"]),
                                "nothing drives the water along x",
                            )
                            .hint("give slope = \"3 deg\" at the top, or `shear-velocity` or `discharge` here"),
                    );
                }
                (along > 0.0).then(|| (along * depth).sqrt())
            }
            _ => None,
        };
        if let Some(found) = found {
            law.insert("shear-velocity".into(), Value::Float(found));
        }
        let level = number(law, "zero-level");
        if let (Some(level), Some(depth)) = (level, depth) {
            water.entry("surface").or_insert(Value::Float(level + depth));
        }
    }
}

impl Derive<'_> {
    /// Layers of a flow: how many, how large, over which roughness.
    fn layers(&mut self, resolved: &mut toml::Table, diameter: Option<f64>) {
        let length = |axis: &str| {
            let ends = resolved.get("periodic")?.get(axis)?.as_array()?;
            Some(ends.last()?.as_float()? - ends.first()?.as_float()?)
        };
        let across = if super::is_space(resolved) { length("y") } else { diameter };
        let length_x = length("x");
        let area = length_x.zip(across).map(|(a, b)| a * b);
        let root = self.root;
        let Some(water) = resolved.get_mut("water").and_then(Value::as_table_mut) else { return };
        let Some(flow) = water.get_mut("flow").and_then(Value::as_table_mut) else { return };
        for kind in ["coupled", "column"] {
            let Some(flow) = flow.get_mut(kind).and_then(Value::as_table_mut) else { continue };
            let path = ["water", "flow", kind];
            let typed = |key: &str| root.find(&[path[0], path[1], path[2], key]).is_some();
            let number = |key: &str| flow.get(key).and_then(Value::as_float);
            let (bottom, top) = (number("bottom"), number("top"));
            if let (Some(bottom), Some(top)) = (bottom, top)
                && top <= bottom
            {
                self.complain(
                    Complaint::new("the water has no depth")
                        .at(&root.locate(&[path[0], path[1], path[2], "top"]), "not above `bottom`"),
                );
                continue;
            }
            if !typed("layers")
                && let (Some(bottom), Some(top), Some(diameter)) = (bottom, top, diameter)
            {
                // A stream changes within a grain above its bed. In a crowd an average over less than three grains is none.
                let per_grain = if kind == "coupled" { 2.0 } else { 1.0 / 3.0 };
                let layers = (per_grain * (top - bottom) / diameter).round().clamp(2.0, 1e5) as i64;
                flow.insert("layers".into(), Value::Integer(layers));
            }
            if !typed("area")
                && let Some(area) = area
            {
                flow.insert("area".into(), Value::Float(area));
            }
            let feeds = flow.get("lid").and_then(Value::as_str) == Some("free") && flow.contains_key("discharge");
            if feeds
                && !typed("reach")
                && let Some(length) = length_x
            {
                flow.insert("reach".into(), Value::Float(length));
            }
            let rough = kind == "coupled";
            if rough
                && !typed("roughness")
                && let Some(diameter) = diameter
            {
                flow.insert("roughness".into(), Value::Float(diameter));
            }
            for (key, wanted, why) in [
                ("layers", true, "there are no grains to take them from"),
                ("area", true, "the world is not periodic along x (and y)"),
                ("roughness", rough, "there are no grains to take it from"),
                ("reach", feeds, "the world is not periodic along x"),
            ] {
                if wanted && !flow.contains_key(key) && !typed(key) {
                    self.complain(
                        Complaint::new(format!("missing key `{key}` in [water.flow.{kind}]"))
                            .at(&root.locate(&path), format!("needs `{key}`: {why}")),
                    );
                }
            }
            if let Some(top) = top {
                water.entry("surface").or_insert(Value::Float(top));
            }
            return;
        }
    }
}

/// Gravity along x [m/s^2].
fn gravity_along(resolved: &toml::Table) -> f64 {
    let gravity = resolved.get("gravity").and_then(Value::as_array);
    gravity.and_then(|gravity| gravity.first()?.as_float()).unwrap_or(0.0)
}

/// Mean over the depth of U/U* for a depth of `h` roughnesses: the integral of 8.5 + 5.75 log10(Z/k) from where it is zero.
fn mean_speed(h: f64) -> f64 {
    let b = PER_DECADE / std::f64::consts::LN_10;
    let zero = (-CONSTANT / b).exp();
    let integral = |z: f64| z * (CONSTANT - b + b * z.ln());
    (integral(h.max(zero)) - integral(zero)) / h
}

/// Mean diameter of the grains by number.
fn mean_diameter(resolved: &toml::Table) -> Option<f64> {
    let groups = groups_by_name(resolved).into_iter().filter_map(|(_, group)| {
        let diameter = group.get("diameter")?.as_float()?;
        let count = group.get("count")?.as_integer()? as f64;
        (count > 0.0).then_some((count, count * diameter))
    });
    let (count, sum) = groups.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    (count > 0.0).then(|| sum / count)
}

#[cfg(test)]
mod tests {
    use super::mean_speed;

    /// The mean of the log law by Simpson's rule.
    #[test]
    fn the_mean_is_the_integral() {
        let law = |z: f64| (8.5 + 5.75 * z.log10()).max(0.0);
        let n = 1_000_000;
        let h = 10.0;
        let sum: f64 = (0..n).map(|i| law((f64::from(i) + 0.5) / f64::from(n) * h)).sum();
        assert!((sum / f64::from(n) - mean_speed(h)).abs() < 1e-6 * mean_speed(h));
    }
}
