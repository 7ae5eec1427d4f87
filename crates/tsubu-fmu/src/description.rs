//! The description of a unit: `modelDescription.xml`, in the form of version 3.0 of the standard or of 2.0.

use crate::variables::{Causality, UNITS, Variable, variables};
use std::fmt::Write as _;
use tsubu_scene::plan::Plan;

/// The name of the library in every unit: the same moves all scenes.
pub const IDENTIFIER: &str = "tsubu";

/// A version of the standard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Version {
    /// FMI 3.0.
    #[default]
    #[value(name = "3")]
    Three,
    /// FMI 2.0.
    #[value(name = "2")]
    Two,
}

/// What a description tells.
pub struct About<'a> {
    /// In which form.
    pub version: Version,
    /// The scene.
    pub plan: &'a Plan,
    /// What binds it to the scene.
    pub token: &'a str,
    /// The engine's step [s].
    pub time_step: f64,
    /// The communication step that is proposed [s].
    pub step: f64,
}

impl Version {
    /// The folder of a library for this machine.
    pub fn platform(self) -> String {
        let bits = if cfg!(target_pointer_width = "64") { "64" } else { "32" };
        match self {
            Self::Three => {
                let system = if cfg!(target_os = "macos") { "darwin" } else { std::env::consts::OS };
                format!("{}-{system}", std::env::consts::ARCH)
            }
            Self::Two if cfg!(target_os = "macos") => format!("darwin{bits}"),
            Self::Two if cfg!(windows) => format!("win{bits}"),
            Self::Two => format!("{}{bits}", std::env::consts::OS),
        }
    }
}

/// The description as XML.
pub fn describe(about: &About<'_>) -> String {
    let variables = variables(about.plan);
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    head(&mut xml, about);
    units(&mut xml);
    xml.push_str(
        "  <LogCategories>\n    <Category name=\"logStatusError\" description=\"What went wrong, and what to do about it\"/>\n    \
         <Category name=\"logStatusWarning\" description=\"What is approximated or doubtful\"/>\n  </LogCategories>\n",
    );
    let _ = writeln!(
        xml,
        "  <DefaultExperiment startTime=\"0\" stopTime=\"{:?}\" stepSize=\"{:?}\"/>",
        about.plan.duration, about.step
    );
    xml.push_str("  <ModelVariables>\n");
    for (reference, variable) in variables.iter().enumerate() {
        match about.version {
            Version::Three => three(&mut xml, reference, variable),
            Version::Two => two(&mut xml, reference, variable),
        }
    }
    xml.push_str("  </ModelVariables>\n");
    structure(&mut xml, about.version, &variables);
    xml.push_str("</fmiModelDescription>\n");
    xml
}

fn head(xml: &mut String, about: &About<'_>) {
    let title = if about.plan.title.is_empty() { "scene" } else { &about.plan.title };
    let (title, tool) = (escaped(title), tsubu::VERSION);
    let text = "Grains that shake and are shaken: a scene of tsubu. Inputs are the motions of the bases of its hosts when a step begins, \
                outputs what the grains do to the hosts, and energies. A communication step is a whole number of the engine's steps";
    let text = format!("{text}, {:?} s.", about.time_step);
    let (version, bound) = match about.version {
        Version::Three => ("3.0", "instantiationToken"),
        Version::Two => ("2.0", "guid"),
    };
    let _ = writeln!(
        xml,
        "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{title}\" {bound}=\"{}\" description=\"{}\" version=\"{tool}\" \
         generationTool=\"tsubu {tool}\" variableNamingConvention=\"flat\">",
        about.token,
        escaped(&text)
    );
    let _ = write!(
        xml,
        "  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" needsExecutionTool=\"false\" \
         canBeInstantiatedOnlyOncePerProcess=\"false\" canHandleVariableCommunicationStepSize=\"true\""
    );
    let _ = match about.version {
        Version::Three => writeln!(
            xml,
            " canGetAndSetFMUState=\"true\" canSerializeFMUState=\"false\" fixedInternalStepSize=\"{:?}\" hasEventMode=\"false\"/>",
            about.time_step
        ),
        Version::Two => writeln!(xml, " canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"false\"/>"),
    };
}

fn units(xml: &mut String) {
    xml.push_str("  <UnitDefinitions>\n");
    for (name, powers) in UNITS {
        let of = |(base, power): (&str, i8)| if power == 0 { String::new() } else { format!(" {base}=\"{power}\"") };
        let powers: String = ["kg", "m", "s"].into_iter().zip(powers).map(of).collect();
        let _ = writeln!(xml, "    <Unit name=\"{name}\"><BaseUnit{powers}/></Unit>");
    }
    xml.push_str("  </UnitDefinitions>\n");
}

/// Attributes that both forms share: name, value reference, description, causality.
fn common(reference: usize, variable: &Variable) -> String {
    let causality = match variable.causality {
        Causality::Independent => "independent",
        Causality::Input => "input",
        Causality::Output => "output",
    };
    format!(
        "name=\"{}\" valueReference=\"{reference}\" description=\"{}\" causality=\"{causality}\"",
        escaped(&variable.name),
        escaped(&variable.about)
    )
}

fn three(xml: &mut String, reference: usize, variable: &Variable) {
    let common = common(reference, variable);
    let unit = unit(variable);
    let _ = match (variable.is_boolean(), variable.causality) {
        (true, _) => writeln!(xml, "    <Boolean {common} variability=\"discrete\" initial=\"calculated\"/>"),
        (false, Causality::Independent) => writeln!(xml, "    <Float64 {common} variability=\"continuous\"{unit}/>"),
        (false, Causality::Input) => {
            writeln!(xml, "    <Float64 {common} variability=\"continuous\"{unit} start=\"0\"/>")
        }
        (false, Causality::Output) => {
            writeln!(xml, "    <Float64 {common} variability=\"continuous\" initial=\"calculated\"{unit}/>")
        }
    };
}

fn two(xml: &mut String, reference: usize, variable: &Variable) {
    let common = common(reference, variable);
    let unit = unit(variable);
    let (variability, inner) = match (variable.is_boolean(), variable.causality) {
        (true, _) => ("discrete", "<Boolean/>".to_owned()),
        (false, Causality::Input) => ("continuous", format!("<Real{unit} start=\"0\"/>")),
        (false, _) => ("continuous", format!("<Real{unit}/>")),
    };
    let initial = if variable.causality == Causality::Output { " initial=\"calculated\"" } else { "" };
    let _ =
        writeln!(xml, "    <ScalarVariable {common} variability=\"{variability}\"{initial}>{inner}</ScalarVariable>");
}

fn unit(variable: &Variable) -> String {
    if variable.unit.is_empty() { String::new() } else { format!(" unit=\"{}\"", variable.unit) }
}

/// Outputs, and what is unknown at the start: the same variables. Version 3.0 names them by value reference, 2.0 by place from 1.
fn structure(xml: &mut String, version: Version, variables: &[Variable]) {
    let outputs = || (0..variables.len()).filter(|at| variables[*at].causality == Causality::Output);
    xml.push_str("  <ModelStructure>\n");
    match version {
        Version::Three => {
            for element in ["Output", "InitialUnknown"] {
                for at in outputs() {
                    let _ = writeln!(xml, "    <{element} valueReference=\"{at}\"/>");
                }
            }
        }
        Version::Two => {
            for list in ["Outputs", "InitialUnknowns"] {
                let _ = writeln!(xml, "    <{list}>");
                for at in outputs() {
                    let _ = writeln!(xml, "      <Unknown index=\"{}\"/>", at + 1);
                }
                let _ = writeln!(xml, "    </{list}>");
            }
        }
    }
    xml.push_str("  </ModelStructure>\n");
}

/// Text as it may stand in an attribute.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML has no other control characters, not even escaped.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
