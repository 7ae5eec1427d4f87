//! What a unit takes in and gives out: one table, from which its description is written and by which its values are found.

use tsubu_scene::plan::Plan;

/// What a variable is to the tool that moves the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// Time.
    Independent,
    /// Told before a step.
    Input,
    /// Known after a step.
    Output,
}

/// What the motion of a base is told by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// Displacement from where it is drawn [m].
    Displacement,
    /// Velocity [m/s].
    Velocity,
    /// Acceleration [m/s^2].
    Acceleration,
}

/// What stands behind a variable; hosts are counted in the order of their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Time of the tool [s].
    Time,
    /// The motion of the base of a host.
    Base(usize, Told),
    /// Displacement of a host along its direction [m].
    Displacement(usize),
    /// Its velocity [m/s].
    Velocity(usize),
    /// Force of the grains on it along its direction, at this moment [N].
    Force(usize),
    /// The mean of that force over the last communication step [N].
    MeanForce(usize),
    /// Kinetic energy of the grains, spin included [J].
    Kinetic,
    /// Their potential energy in gravity, from z = 0 [J].
    Potential,
    /// Energy stored in contacts [J].
    Elastic,
    /// Energy of the structures inside the unit, kinetic and of springs [J].
    Structures,
    /// Energy lost since time 0: all rows of losses of the books [J].
    Dissipated,
    /// Work of the bases since time 0 [J].
    BaseWork,
    /// What the books cannot explain, over the energy turned over [-].
    Residual,
    /// Whether no step has failed and the residual is within `dem.energy-tolerance`.
    Well,
}

/// A variable of a unit. Its value reference is its place in [`variables`].
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name: `HOST.base.velocity`, `kinetic_energy`.
    pub name: String,
    /// What it is to the tool.
    pub causality: Causality,
    /// Its unit in the description, nothing for plain numbers and truth values.
    pub unit: &'static str,
    /// One sentence.
    pub about: String,
    /// What stands behind it.
    pub meaning: Meaning,
}

impl Variable {
    /// Whether it is true or false; all others are numbers.
    pub fn is_boolean(&self) -> bool {
        self.meaning == Meaning::Well
    }
}

/// Units that variables have: name, and the powers of kilogram, metre and second.
pub const UNITS: [(&str, [i8; 3]); 6] = [
    ("s", [0, 0, 1]),
    ("m", [0, 1, 0]),
    ("m/s", [0, 1, -1]),
    ("m/s2", [0, 1, -2]),
    ("N", [1, 1, -2]),
    ("J", [1, 2, -2]),
];

/// The variables of a scene: time, three inputs for each host with a base, four outputs for each host, and the books.
pub fn variables(plan: &Plan) -> Vec<Variable> {
    let mut all = vec![variable("time", Causality::Independent, "s", "Time", Meaning::Time)];
    let steered = plan.hosts.iter().enumerate().filter(|(_, (_, host))| host.base.is_some());
    for (at, (name, _)) in steered {
        for (word, unit, told) in [
            ("displacement", "m", Told::Displacement),
            ("velocity", "m/s", Told::Velocity),
            ("acceleration", "m/s2", Told::Acceleration),
        ] {
            let about = format!("{word} of the base of `{name}` along its direction when a step begins");
            let about = format!("{}{}", about[..1].to_uppercase(), &about[1..]);
            let meaning = Meaning::Base(at, told);
            all.push(variable(&format!("{name}.base.{word}"), Causality::Input, unit, &about, meaning));
        }
    }
    for (at, name) in plan.hosts.keys().enumerate() {
        let along = format!("`{name}` along its direction");
        for (word, unit, about, meaning) in [
            ("displacement", "m", format!("Displacement of {along}"), Meaning::Displacement(at)),
            ("velocity", "m/s", format!("Velocity of {along}"), Meaning::Velocity(at)),
            ("force", "N", format!("Force of the grains on {along}, now"), Meaning::Force(at)),
            (
                "mean_force",
                "N",
                format!("Mean force of the grains on {along} over the last communication step: impulse over time"),
                Meaning::MeanForce(at),
            ),
        ] {
            all.push(variable(&format!("{name}.{word}"), Causality::Output, unit, &about, meaning));
        }
    }
    let out = |name, unit, about, meaning| variable(name, Causality::Output, unit, about, meaning);
    all.extend([
        out("kinetic_energy", "J", "Kinetic energy of the grains, spin included", Meaning::Kinetic),
        out("potential_energy", "J", "Potential energy of the grains in gravity, from z = 0", Meaning::Potential),
        out("elastic_energy", "J", "Energy stored in contacts", Meaning::Elastic),
        out("structure_energy", "J", "Energy of the structures inside: kinetic and of springs", Meaning::Structures),
        out(
            "dissipated_energy",
            "J",
            "Energy lost since the start, in contacts, dampers and water",
            Meaning::Dissipated,
        ),
        out("base_work", "J", "Work of the bases since the start", Meaning::BaseWork),
        out("energy_residual", "", "What the books cannot explain, over the energy turned over", Meaning::Residual),
        out(
            "well",
            "",
            "Whether no step has failed and the energy residual is within `dem.energy-tolerance`",
            Meaning::Well,
        ),
    ]);
    all
}

fn variable(name: &str, causality: Causality, unit: &'static str, about: &str, meaning: Meaning) -> Variable {
    Variable { name: name.to_owned(), causality, unit, about: about.to_owned(), meaning }
}
