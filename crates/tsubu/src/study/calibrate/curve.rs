//! A measured response curve: a run is a response at its frequencies, and tells a result at each.

use crate::engine::OpenError;
use crate::interrupt::Watcher;
use crate::run::RunError;
use crate::study::cases::{Case, CasesError};
use crate::study::kept;
use crate::study::response::{response, tasks::reference_frequency};
use std::path::Path;
use toml::Value;
use tsubu_frame::{Advise, FileError, Status, Summary, Table};
use tsubu_scene::Scene;
use tsubu_scene::plan::{Curve, Measured, Plan};

/// A frequency that is a ratio of the natural one, and multiplied by it again, is within this of what it was.
const SAME: f64 = 1e-12;

/// Its points as results of a run.
pub(super) fn measured(curve: &Curve) -> impl Iterator<Item = Measured> + '_ {
    let points = curve.frequency.iter().zip(&curve.value).zip(&curve.uncertainty);
    points.map(|((frequency, value), uncertainty)| Measured {
        result: result(curve, *frequency),
        value: *value,
        uncertainty: *uncertainty,
        source: curve.source.clone(),
    })
}

/// The name of what a response tells at a frequency.
fn result(curve: &Curve, frequency: f64) -> String {
    format!("{} at {frequency} Hz", curve.quantity.column())
}

/// The case whose response has the frequencies of the curve, over the natural frequency of the case, and nothing that the response varies.
pub(super) fn at_its_frequencies(case: &mut Case, scene: &Scene, curve: &Curve) -> Result<(), CasesError> {
    let of_case = case.scene(scene).map_err(CasesError::Complaints)?;
    let Some(wanted) = &of_case.plan().response else { return Ok(()) };
    let reference = reference_frequency(of_case.plan(), &wanted.host).map_err(CasesError::Scene)?;
    let ratios = curve.frequency.iter().map(|frequency| Value::Float(frequency / reference)).collect();
    case.values.push(("response.frequency-ratio".to_owned(), Value::Array(ratios)));
    case.values.push(("response.vary".to_owned(), Value::Table(toml::Table::new())));
    Ok(())
}

/// Makes the response of a case in a folder of its own; one that is finished is kept, one that was cut goes on.
pub(super) fn one(scene: &Scene, case: &Case, folder: &Path, watcher: &Watcher) -> Result<Summary, CasesError> {
    if let Some(summary) = kept::of_case(scene, case, folder)?.filter(|summary| summary.status == Status::Finished) {
        return Ok(summary);
    }
    let scene = case.scene(scene).map_err(CasesError::Complaints)?;
    match response(&scene, folder, !kept::is_of(&scene, folder), &watcher.quiet()) {
        // One that goes wrong leaves the others their results.
        Err(CasesError::Run { error: RunError::Fault(fault) | RunError::Open(OpenError::Settling(fault)), .. }) => {
            Ok(kept::failed(&scene, folder, &fault.told())?)
        }
        other => other,
    }
}

/// Puts what the response in a folder tells at the frequencies of the curve into its summary; nothing where some is missing.
pub(super) fn tell(curve: &Curve, folder: &Path, summary: &mut Summary) -> Result<(), FileError> {
    let table = Table::read(&folder.join("response.csv"))?;
    let [frequencies, values] =
        ["frequency", curve.quantity.column()].map(|column| table.numbers(column).unwrap_or_default());
    for frequency in &curve.frequency {
        // A response may have looked at more, about its peak.
        let there = frequencies.iter().position(|there| (there / frequency - 1.0).abs() < SAME);
        if let Some(value) = there.and_then(|row| values.get(row)) {
            summary.give(result(curve, *frequency), curve.quantity.unit(), *value);
        }
    }
    Ok(())
}

/// How long a run lasts, in simulated time [s].
pub(super) fn seconds(plan: &Plan, curve: &Curve) -> f64 {
    let Some(response) = &plan.response else { return plan.duration };
    let periods = response.periods() * f64::from(response.seeds);
    curve.frequency.iter().map(|frequency| periods / frequency).sum()
}
