//! The files of a response.

use super::curve::{CaseResult, doubt};
use crate::ledger::Account;
use crate::study::summary::{begun, judge};
use std::collections::BTreeSet;
use tsubu_frame::csv::split_unit;
use tsubu_frame::{Cell, FileError, RunFolder, Status, Summary, Table};
use tsubu_scene::{Plan, Scene};

fn number(value: f64) -> Cell {
    Cell::Number(value)
}

fn text(value: &str) -> Cell {
    Cell::Text(value.to_owned())
}

#[expect(clippy::too_many_lines, reason = "three tables and the summary from one pass over the cases")]
/// Writes `response.csv`, `cases.csv`, `energy_by_cause.csv`, `check.txt` and `summary.json`.
pub(super) fn write(
    folder: &RunFolder,
    scene: &Scene,
    plans: &[Plan],
    results: &[CaseResult],
    status: Status,
    failures: Vec<String>,
    wall_seconds: f64,
) -> Result<Summary, FileError> {
    let plan = scene.plan();
    let rows = || results.iter().flat_map(|case| &case.rows);
    let watched: BTreeSet<&String> = rows().flat_map(|row| row.watched.keys()).collect();
    let fixed = [
        "frequency [Hz]",
        "frequency ratio [-]",
        "rms displacement [m]",
        "peak displacement [m]",
        "rms spread low [m]",
        "rms spread high [m]",
        "acceleration [m/s^2]",
        "transmissibility [-]",
        "base force [N]",
        "apparent mass [kg]",
        "loss per cycle [J]",
        "drift [-]",
        "periods discarded [-]",
        "particles [-]",
        "case [text]",
        "method [text]",
    ];
    let watched_columns = watched.iter().flat_map(|column| {
        let (what, unit) = split_unit(column);
        let unit = unit.unwrap_or("-");
        ["", " spread low", " spread high"].map(|which| format!("{what}{which} [{unit}]"))
    });
    let mut curves = Table::new(fixed.map(str::to_owned).into_iter().chain(watched_columns));
    // Only of a response that went both ways.
    let both = results.iter().any(|case| case.hysteresis.is_some());
    let fixed = [
        "case [text]",
        "method [text]",
        "particles [-]",
        "peak frequency ratio [-]",
        "peak within [-]",
        "peak rms [m]",
        "half-power damping [-]",
        "loss factor [-]",
        "apparent mass [kg]",
        "added-mass limit [-]",
        "energy residual [-]",
        "wall seconds [s]",
    ];
    let apart = ["hysteresis [-]", "hysteresis from [-]", "hysteresis to [-]"].into_iter().filter(|_| both);
    // Only with several seeds.
    let several = results.iter().any(|case| case.peak_interval.is_some());
    let interval = ["peak rms low [m]", "peak rms high [m]"].into_iter().filter(|_| several);
    let mut cases = Table::new(fixed.into_iter().chain(apart).chain(interval));
    let losses: Vec<Account> = Account::ALL.into_iter().filter(|a| !a.is_work()).collect();
    let header = std::iter::once("case [text]".to_owned()).chain(losses.iter().map(|a| format!("{} [J]", a.name())));
    let mut causes = Table::new(header);
    let mut summary = begun(plan, status, wall_seconds);
    summary.warnings = failures;
    for (case, case_plan) in results.iter().zip(plans) {
        let method = case_plan.method.name();
        let name = if case.name.is_empty() { "scene" } else { &case.name };
        for row in &case.rows {
            let fixed = [
                number(row.frequency),
                number(row.ratio),
                number(row.rms[0]),
                number(row.peak),
                number(row.rms[1]),
                number(row.rms[2]),
                number(row.acceleration),
                number(row.transmissibility),
                number(row.base_force),
                number(row.apparent_mass),
                number(row.loss),
                number(row.drift),
                number(f64::from(row.discarded)),
                number(case.particles as f64),
                text(name),
                text(method),
            ];
            let told = watched.iter().flat_map(|&column| row.watched.get(column).copied().unwrap_or([f64::NAN; 3]));
            curves.push(fixed.into_iter().chain(told.map(number)));
        }
        let Some(peak) = case.peak else { continue };
        let values = [
            ("peak frequency ratio", "-", peak.ratio),
            ("peak within", "-", peak.within),
            ("peak rms", "m", peak.rms),
            ("half-power damping", "-", peak.half_power_damping),
            ("loss factor", "-", case.loss_factor),
            ("apparent mass", "kg", case.apparent_mass),
            ("added-mass limit", "-", case.added_mass_limit),
        ];
        let mut cells = vec![text(name), text(method), number(case.particles as f64)];
        cells.extend(values.iter().map(|(_, _, v)| number(*v)));
        cells.extend([number(case.residual), number(case.wall)]);
        if both {
            let parted = case.hysteresis.map_or([f64::NAN; 3], |found| [found.gap, found.ratios[0], found.ratios[1]]);
            cells.extend(parted.map(number));
        }
        if several {
            cells.extend(case.peak_interval.unwrap_or([f64::NAN; 2]).map(number));
        }
        cases.push(cells);
        causes.push(
            std::iter::once(text(name))
                .chain(Account::ALL.iter().zip(&case.flows).filter(|(a, _)| !a.is_work()).map(|(_, f)| number(*f))),
        );
        let suffix = if case.name.is_empty() { String::new() } else { format!(" {}", case.name) };
        for (label, unit, value) in values {
            summary.give(format!("{label}{suffix}"), unit, value);
        }
        if let Some([low, high]) = case.peak_interval {
            summary.give(format!("peak rms low{suffix}"), "m", low);
            summary.give(format!("peak rms high{suffix}"), "m", high);
        }
        if let Some(hysteresis) = case.hysteresis {
            summary.give(format!("hysteresis{suffix}"), "-", hysteresis.gap);
        }
        summary.energy.residual_relative = summary.energy.residual_relative.max(case.residual);
        summary.particles = summary.particles.max(case.particles as u64);
        let heights: Vec<f64> = case.rows.iter().map(|row| row.rms[0]).collect();
        if let Some(doubt) = doubt(&heights).filter(|_| status == Status::Finished) {
            summary.warnings.push(format!("case `{name}`: {doubt}"));
        }
        let drift = case.rows.iter().map(|r| r.drift).fold(0.0, f64::max);
        if drift > 0.1 && status == Status::Finished {
            summary.warnings.push(format!(
                "case `{name}`: the amplitude still changes by up to {:.0} % within the measured periods; more `response.discard-periods` settle it, or the motion is irregular",
                100.0 * drift
            ));
        }
    }
    for name in plan.watch.keys().filter(|_| status == Status::Finished) {
        if !watched.iter().any(|column| column.strip_prefix(name.as_str()).is_some_and(|rest| rest.starts_with(' '))) {
            summary.warnings.push(format!(
                "the watch `{name}` has seen nothing in the measured periods, from whose begin its times count"
            ));
        }
    }
    judge(folder, plan, &mut summary)?;
    folder.write("response.csv", curves.to_csv().as_bytes())?;
    folder.write("cases.csv", cases.to_csv().as_bytes())?;
    folder.write("energy_by_cause.csv", causes.to_csv().as_bytes())?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}
