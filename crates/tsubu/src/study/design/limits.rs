//! Limits of a design that are known before anything is run: mass, space, sides, cost. Which of them leaves out how many, and how far it
//! would have to be loosened.

use super::space;
use tsubu_scene::Plan;
use tsubu_scene::plan::Design;

/// What a limit is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    Mass,
    Space,
    Side(usize),
    Cost,
}

/// A limit.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// As in the scene: `mass-limit`.
    pub key: &'static str,
    /// The largest value that is within it.
    most: f64,
    unit: &'static str,
    measure: Measure,
}

/// What a combination needs of each limit.
#[derive(Clone, Debug)]
pub(super) struct Needs {
    pub name: String,
    /// In the order of the limits, in SI units.
    values: Vec<f64>,
}

/// All limits of a design, with the combinations that are beyond them.
#[derive(Clone, Debug, Default)]
pub(super) struct Limits {
    pub list: Vec<Limit>,
    pub beyond: Vec<Needs>,
}

impl Limits {
    /// Those that a design asks for.
    pub fn new(wanted: &Design) -> Self {
        let mut list = Vec::new();
        let mut add = |key, most: Option<f64>, unit, measure| {
            list.extend(most.map(|most| Limit { key, most, unit, measure }));
        };
        add("mass-limit", wanted.mass_limit, "kg", Measure::Mass);
        add("space-limit", wanted.space_limit, "m^3", Measure::Space);
        if let Some(envelope) = &wanted.envelope {
            let sides = [envelope.width, envelope.depth, envelope.height];
            for (axis, key) in ["envelope.width", "envelope.depth", "envelope.height"].into_iter().enumerate() {
                add(key, sides[axis], "m", Measure::Side(axis));
            }
        }
        add("cost-limit", wanted.cost_limit, "", Measure::Cost);
        Self { list, beyond: Vec::new() }
    }

    /// What a combination needs; in words why that is not known.
    pub fn needs(&self, name: &str, plan: &Plan, wanted: &Design) -> Result<Needs, String> {
        let host = plan.response.as_ref().map_or("", |response| &response.host);
        let copies = copies(plan);
        let value = |limit: &Limit| match limit.measure {
            Measure::Mass => Ok(copies * plan.grain_mass()),
            Measure::Space => Ok(copies * space::sides(plan, host)?.iter().product::<f64>()),
            Measure::Side(_) if copies != 1.0 => Err(format!(
                "of `hosts.{host}.copies` = {copies} cavities the sides of all together are not known: use `design.space-limit`"
            )),
            Measure::Side(axis) => Ok(space::sides(plan, host)?[axis]),
            Measure::Cost => plan
                .grain_cost(&wanted.cost)
                .map(|cost| copies * cost)
                .ok_or_else(|| "a material has no `design.cost`".to_owned()),
        };
        let told = |limit: &Limit| value(limit).map_err(|why| format!("`design.{}`: {why}", limit.key));
        Ok(Needs { name: name.to_owned(), values: self.list.iter().map(told).collect::<Result<_, String>>()? })
    }

    /// Whether that is within all limits.
    pub fn hold(&self, needs: &Needs) -> bool {
        self.broken(needs).is_empty()
    }

    /// Which limits that is beyond.
    fn broken(&self, needs: &Needs) -> Vec<usize> {
        // A limit of three balls of 0.1 kg is 0.3 kg.
        let over = |index: &usize| needs.values[*index] > self.list[*index].most * (1.0 + 1e-9);
        (0..self.list.len()).filter(over).collect()
    }

    /// The limits that a plan is beyond, in words; none where what it needs is not known.
    pub fn beyond(plan: &Plan, wanted: &Design) -> Vec<String> {
        let limits = Self::new(wanted);
        let needs = limits.needs("", plan, wanted);
        let broken = needs.map(|needs| limits.broken(&needs)).unwrap_or_default();
        broken.into_iter().map(|index| limits.named(index, limits.list[index].most)).collect()
    }

    /// A limit as a scene says it, with this value.
    fn named(&self, index: usize, value: f64) -> String {
        let limit = &self.list[index];
        format!("`design.{}` = {} {}", limit.key, value, limit.unit).trim_end().to_owned()
    }

    /// How many combinations each limit leaves out, in their order.
    pub fn left_out(&self) -> Vec<usize> {
        let by = |index| self.beyond.iter().filter(|needs| self.broken(needs).contains(&index)).count();
        (0..self.list.len()).map(by).collect()
    }

    /// Which of the limits leaves out how many, and what would let one in: the limit that alone has to grow by the smallest factor, or, where
    /// none alone is enough, those of the combination whose largest factor is smallest.
    pub fn told(&self) -> String {
        let counts = self.left_out().into_iter().enumerate().filter(|(_, number)| *number > 0);
        let counts: Vec<String> = counts
            .map(|(index, number)| format!("{} leaves out {number}", self.named(index, self.list[index].most)))
            .collect();
        let factor = |needs: &Needs| {
            let factors = self.broken(needs).into_iter().map(|index| needs.values[index] / self.list[index].most);
            factors.fold(1.0, f64::max)
        };
        let nearest = |alone: bool| {
            let such = self.beyond.iter().filter(|needs| !alone || self.broken(needs).len() == 1);
            such.min_by(|a, b| factor(a).total_cmp(&factor(b)))
        };
        let Some(found) = nearest(true).or_else(|| nearest(false)) else { return counts.join(", ") };
        let wanted: Vec<String> =
            self.broken(found).into_iter().map(|index| self.named(index, enough(found.values[index]))).collect();
        let enough = if wanted.len() == 1 { "would be enough" } else { "together would be enough, and none alone" };
        format!("{}; {} {enough}, for `{}`", counts.join(", "), wanted.join(" and "), found.name)
    }
}

/// Mass [kg], space [m^3] and cost of a combination, not-a-number where that is not known.
pub(super) fn measures(plan: &Plan, wanted: &Design) -> [f64; 3] {
    let host = plan.response.as_ref().map_or("", |response| &response.host);
    let space = space::sides(plan, host).map_or(f64::NAN, |sides| sides.iter().product());
    let cost = if wanted.cost.is_empty() { None } else { plan.grain_cost(&wanted.cost) };
    [plan.grain_mass(), space, cost.unwrap_or(f64::NAN)].map(|measure| copies(plan) * measure)
}

/// How many cavities like that of the scene the host carries.
fn copies(plan: &Plan) -> f64 {
    plan.response.as_ref().and_then(|response| plan.hosts.get(&response.host)).map_or(1.0, |host| host.copies)
}

/// The number with four digits that is not below this one.
fn enough(value: f64) -> f64 {
    let unit = 10_f64.powf(value.abs().log10().floor() - 3.0);
    let digits = (value / unit - 1e-9).ceil();
    format!("{:.3e}", digits * unit).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(needs: &[(&str, [f64; 2])]) -> Limits {
        let list = vec![
            Limit { key: "mass-limit", most: 1.0, unit: "kg", measure: Measure::Mass },
            Limit { key: "cost-limit", most: 10.0, unit: "", measure: Measure::Cost },
        ];
        let beyond = needs.iter().map(|(name, values)| Needs { name: (*name).to_owned(), values: values.to_vec() });
        Limits { list, beyond: beyond.collect() }
    }

    /// One limit alone is named where it is enough, though another combination is nearer by two; then the two.
    #[test]
    fn the_limit_to_loosen_is_named() {
        let both = ("light", [1.2, 12.0]);
        let told = limits(&[both, ("cheap", [1.500_01, 8.0]), ("dear", [0.5, 100.0])]).told();
        assert_eq!(
            told,
            "`design.mass-limit` = 1 kg leaves out 2, `design.cost-limit` = 10 leaves out 2; `design.mass-limit` = 1.501 kg would be \
             enough, for `cheap`"
        );
        let told = limits(&[both, ("far", [2.0, 11.0])]).told();
        assert!(
            told.ends_with(
                "`design.mass-limit` = 1.2 kg and `design.cost-limit` = 12 together would be enough, and none alone, for `light`"
            ),
            "{told}"
        );
        assert!(limits(&[]).hold(&Needs { name: String::new(), values: vec![1.0, 10.0] }));
        assert_eq!([enough(0.000_345_600_1), enough(2.0), enough(999.96)], [0.000_345_7, 2.0, 1000.0]);
    }
}
