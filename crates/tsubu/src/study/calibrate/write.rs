//! The files of a calibration.

use super::{Found, Purpose, Ran, Work};
use crate::student::interval_of_mean;
use crate::study::cases::value_text;
use crate::study::ranges::Range;
use crate::study::summary::{begun, judge};
use tsubu_frame::{Cell, FileError, RunFolder, Status, Summary, Table};
use tsubu_scene::plan;

/// A standard deviation larger than this share of that before anything was measured tells nothing.
const TELLS_NOTHING: f64 = 0.8;
/// Parameters that are correlated more than this are not told apart.
const TOLD_APART: f64 = 0.8;
/// More than this share of samples in the last twentieth of a range press against its end.
const PRESSING: f64 = 0.2;
const END: f64 = 0.05;
/// Half a 95 % interval of a normal distribution, over its standard deviation.
const INTERVAL: f64 = 1.96;

/// Writes `posterior.csv`, `parameters.csv`, `correlations.csv`, `measured.csv`, `curve.csv`, `runs.csv`, `best.toml`, `check.txt` and `summary.json`.
pub(super) fn write(
    folder: &RunFolder,
    work: &Work<'_>,
    found: Option<&Found>,
    status: Status,
    wall_seconds: f64,
    missing: Vec<String>,
) -> Result<Summary, FileError> {
    let task = work.task;
    folder.write("runs.csv", runs(work).to_csv().as_bytes())?;
    let mut summary = begun(task.scene.plan(), status, wall_seconds);
    summary.particles = task.scene.plan().grains() as u64;
    summary.give("runs", "-", work.ran.len() as f64);
    if let Some(found) = found {
        let parameters: Vec<Parameter> =
            task.ranges.iter().enumerate().map(|(axis, range)| Parameter::new(range, axis, &found.samples)).collect();
        for parameter in &parameters {
            parameter.tell(&mut summary);
        }
        let correlations = correlations(&found.samples);
        folder.write("parameters.csv", table_of(&parameters).to_csv().as_bytes())?;
        if !correlations.is_empty() {
            folder.write("correlations.csv", pairs(work, &correlations).to_csv().as_bytes())?;
        }
        let measured: Vec<Compared> = (0..task.measured.len()).map(|index| Compared::new(work, found, index)).collect();
        folder.write("posterior.csv", posterior(work, found, &measured).to_csv().as_bytes())?;
        folder.write("measured.csv", compared(&measured).to_csv().as_bytes())?;
        if let Some(of) = &task.wanted.curve {
            folder.write("curve.csv", curve(of, &measured).to_csv().as_bytes())?;
        }
        let (case, _) = Range::case(&task.ranges, &found.samples[found.best]);
        if let Ok(best) = case.scene(task.scene) {
            folder.write_editable("best.toml", best.resolved_toml().as_bytes())?;
        }
        doubts(work, found, &parameters, &measured, &mut summary);
        not_told_apart(work, &correlations, &mut summary);
    }
    failures(work, &mut summary);
    summary.warnings.extend(missing);
    summary.energy.residual_relative =
        work.ran.iter().map(|ran| ran.summary.energy.residual_relative).fold(0.0, f64::max);
    // What the scene claims is claimed of a run.
    let plan = plan::Plan { claim: Vec::new(), ..task.scene.plan().clone() };
    judge(folder, &plan, &mut summary)?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}

/// What is known of a key.
struct Parameter<'a> {
    range: &'a Range,
    mean: f64,
    deviation: f64,
    /// 2.5 %, 50 %, 97.5 % of the samples lie below.
    quantiles: [f64; 3],
    /// Its standard deviation over that before anything was measured, along the range.
    left: f64,
    /// Share of the samples near the lower and the upper end.
    ends: [f64; 2],
}

impl<'a> Parameter<'a> {
    fn new(range: &'a Range, axis: usize, samples: &[Vec<f64>]) -> Self {
        let mut places: Vec<f64> = samples.iter().map(|sample| sample[axis]).collect();
        places.sort_by(f64::total_cmp);
        let values: Vec<f64> = places.iter().map(|place| range.value(*place)).collect();
        let [mean, deviation] = moments(&values);
        let quantile = |share: f64| values[((share * values.len() as f64) as usize).min(values.len() - 1)];
        let share = |near: &dyn Fn(f64) -> bool| {
            places.iter().filter(|place| near(**place)).count() as f64 / places.len() as f64
        };
        Self {
            range,
            mean,
            deviation,
            quantiles: [0.025, 0.5, 0.975].map(quantile),
            left: moments(&places)[1] * 12_f64.sqrt(),
            ends: [share(&|place| place < END), share(&|place| place > 1.0 - END)],
        }
    }

    fn unit(&self) -> &str {
        if self.range.unit.is_empty() { "-" } else { &self.range.unit }
    }

    fn tell(&self, summary: &mut Summary) {
        let [low, median, high] = self.quantiles;
        let numbers =
            [("mean", self.mean), ("deviation", self.deviation), ("low", low), ("median", median), ("high", high)];
        for (word, number) in numbers {
            summary.give(format!("{} {word}", self.range.key), self.unit(), number);
        }
    }
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> [f64; 2] {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64;
    [mean, square.sqrt()]
}

/// Of every pair of keys, along their ranges.
fn correlations(samples: &[Vec<f64>]) -> Vec<(usize, usize, f64)> {
    let axis = |axis: usize| -> Vec<f64> { samples.iter().map(|sample| sample[axis]).collect() };
    let dimension = samples.first().map_or(0, Vec::len);
    let pair = |(i, j): (usize, usize)| {
        let (a, b) = (axis(i), axis(j));
        let ([ma, sa], [mb, sb]) = (moments(&a), moments(&b));
        let product = a.iter().zip(&b).map(|(a, b)| (a - ma) * (b - mb)).sum::<f64>() / a.len() as f64;
        (i, j, if sa * sb > 0.0 { product / (sa * sb) } else { 0.0 })
    };
    (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))).map(pair).collect()
}

/// A measured result beside what the samples are guessed to give, and what fresh runs gave.
struct Compared<'a> {
    measured: &'a plan::Measured,
    /// Mean and standard deviation over the samples.
    guessed: [f64; 2],
    /// Mean over the checks.
    checked: f64,
    interval: [f64; 2],
    /// Checks that lie where the process expects nineteen of twenty, and all checks.
    expected: (usize, usize),
    unit: String,
}

impl<'a> Compared<'a> {
    fn new(work: &Work<'a>, found: &Found, index: usize) -> Self {
        let measured = &work.task.measured[index];
        let fit = &found.fits[index];
        let guesses: Vec<f64> = found.samples.iter().map(|place| fit.at(place)[0]).collect();
        let checks = work.ran.iter().filter(|ran| ran.purpose == Purpose::Check && ran.results[index].is_finite());
        let inside = |ran: &&Ran| {
            let [guess, deviation] = fit.at(&ran.place);
            let wide = INTERVAL * deviation.hypot(fit.noise()).hypot(measured.uncertainty * ROUNDING);
            (ran.results[index] - guess).abs() <= wide
        };
        let values: Vec<f64> = checks.clone().map(|ran| ran.results[index]).collect();
        let with_unit = work.ran.iter().find_map(|ran| ran.results[index].is_finite().then_some(&ran.summary));
        Self {
            measured,
            guessed: moments(&guesses),
            checked: values.iter().sum::<f64>() / values.len() as f64,
            interval: if values.len() > 1 { interval_of_mean(&values) } else { [f64::NAN; 2] },
            expected: (checks.filter(inside).count(), values.len()),
            unit: with_unit.map_or("-", |summary| summary.unit(&measured.result)).to_owned(),
        }
    }
}

/// What is far below the measured uncertainty is no error of the process.
const ROUNDING: f64 = 0.05;

fn doubts(
    work: &Work<'_>,
    found: &Found,
    parameters: &[Parameter<'_>],
    measured: &[Compared<'_>],
    summary: &mut Summary,
) {
    let wanted = &work.task.wanted;
    let mut say = |text: String| summary.warnings.push(text);
    for Parameter { range: Range { key, .. }, left, ends, .. } in parameters {
        if *left > TELLS_NOTHING {
            say(format!("what was measured tells next to nothing of `{key}`"));
        }
        for (share, end) in ends.iter().zip(["lower", "upper"]) {
            if *share > PRESSING {
                say(format!("`{key}` presses against the {end} end of its range: widen it, if it may lie beyond"));
            }
        }
    }
    for (Compared { measured, checked, expected: (inside, all), guessed, .. }, doubt) in
        measured.iter().zip(&found.doubts)
    {
        let name = &measured.result;
        if *doubt > wanted.within {
            say(format!(
                "after {} runs `{name}` is known within {doubt:.2} of its uncertainty, less well than `calibrate.within` = {}: more `calibrate.runs`, or longer ones that scatter less",
                wanted.runs, wanted.within
            ));
        }
        let apart = (guessed[0] - measured.value).abs() / measured.uncertainty.hypot(guessed[1]);
        if apart > INTERVAL {
            say(format!(
                "no values within the ranges give `{name}` as it was measured, {} +- {}: they give {:.4}",
                measured.value, measured.uncertainty, guessed[0]
            ));
        }
        if *all > 0 && 2 * inside < *all {
            say(format!(
                "{} of {all} fresh runs gave another `{name}` than was expected, {checked:.4} in the mean: more `calibrate.runs`",
                all - inside
            ));
        }
    }
}

fn not_told_apart(work: &Work<'_>, correlations: &[(usize, usize, f64)], summary: &mut Summary) {
    let key = |axis: usize| &work.task.ranges[axis].key;
    for (i, j, correlation) in correlations.iter().filter(|pair| pair.2.abs() > TOLD_APART) {
        summary.warnings.push(format!(
            "`{}` and `{}` are not told apart: their correlation is {correlation:.2}; a measurement on which they act otherwise would",
            key(*i),
            key(*j)
        ));
    }
}

fn failures(work: &Work<'_>, summary: &mut Summary) {
    for ran in work.ran.iter().filter(|ran| ran.summary.status == Status::Failed) {
        let why = ran.summary.warnings.last().map_or("", String::as_str);
        summary.warnings.push(format!("run `{}` failed and is left out: {why}", ran.case.name));
    }
    for (index, measured) in work.task.measured.iter().enumerate() {
        let none = |ran: &&Ran| ran.summary.status == Status::Finished && ran.results[index].is_nan();
        let number = work.ran.iter().filter(none).count();
        if number > 0 {
            summary.warnings.push(format!("{number} runs have no `{}` and are left out of it", measured.result));
        }
    }
}

/// A key with its unit, as a header.
fn header(range: &Range) -> String {
    format!("{} [{}]", range.key, if range.unit.is_empty() { "-" } else { &range.unit })
}

fn posterior(work: &Work<'_>, found: &Found, measured: &[Compared<'_>]) -> Table {
    let task = work.task;
    let results = measured.iter().map(|one| format!("{} [{}]", one.measured.result, one.unit));
    let mut table = Table::new(task.ranges.iter().map(header).chain(results));
    for place in &found.samples {
        let values = task.ranges.iter().zip(place).map(|(range, place)| range.value(*place));
        table.push(values.chain(found.fits.iter().map(|fit| fit.at(place)[0])).map(Cell::Number));
    }
    table
}

fn table_of(parameters: &[Parameter<'_>]) -> Table {
    let names = ["key [text]", "unit [text]", "range low [-]", "range high [-]", "mean [-]", "deviation [-]"];
    let more = ["low [-]", "median [-]", "high [-]", "deviation left [-]"];
    let mut table = Table::new(names.into_iter().chain(more));
    for parameter in parameters {
        let Parameter { range, mean, deviation, quantiles: [low, median, high], left, .. } = parameter;
        let numbers = [range.low, range.high, *mean, *deviation, *low, *median, *high, *left];
        let texts = [range.key.as_str(), parameter.unit()];
        table.push(texts.map(Cell::from).into_iter().chain(numbers.map(Cell::Number)));
    }
    table
}

fn pairs(work: &Work<'_>, correlations: &[(usize, usize, f64)]) -> Table {
    let mut table = Table::new(["key [text]", "other key [text]", "correlation [-]"]);
    for (i, j, correlation) in correlations {
        let keys = [*i, *j].map(|axis| Cell::Text(work.task.ranges[axis].key.clone()));
        table.push(keys.into_iter().chain([Cell::Number(*correlation)]));
    }
    table
}

fn compared(measured: &[Compared<'_>]) -> Table {
    let mut table = Table::new([
        "result [text]",
        "unit [text]",
        "measured [-]",
        "uncertainty [-]",
        "expected [-]",
        "expected deviation [-]",
        "fresh runs [-]",
        "fresh runs low [-]",
        "fresh runs high [-]",
        "as expected [-]",
        "checks [-]",
        "source [text]",
    ]);
    for one in measured {
        let plan::Measured { result, value, uncertainty, source } = one.measured;
        let [low, high] = one.interval;
        let numbers = [*value, *uncertainty, one.guessed[0], one.guessed[1], one.checked, low, high];
        let counts = [one.expected.0 as f64, one.expected.1 as f64];
        let row = [Cell::from(result.as_str()), Cell::from(one.unit.as_str())].into_iter();
        table.push(
            row.chain(numbers.map(Cell::Number)).chain(counts.map(Cell::Number)).chain([Cell::from(source.as_str())]),
        );
    }
    table
}

/// A measured response curve beside what the samples are guessed to give, 95 % of them, and what fresh runs gave; its points are the last of
/// what was measured.
fn curve(of: &plan::Curve, measured: &[Compared<'_>]) -> Table {
    let (what, unit) = (of.quantity.column(), of.quantity.unit());
    let columns = ["", " uncertainty", " expected", " expected low", " expected high", " of fresh runs"];
    let header = columns.map(|column| format!("{what}{column} [{unit}]"));
    let mut table = Table::new(["frequency [Hz]".to_owned()].into_iter().chain(header));
    for (frequency, one) in of.frequency.iter().zip(&measured[measured.len() - of.frequency.len()..]) {
        let plan::Measured { value, uncertainty, .. } = one.measured;
        let [mean, deviation] = one.guessed;
        let ends = [mean - INTERVAL * deviation, mean + INTERVAL * deviation];
        table.push([*frequency, *value, *uncertainty, mean, ends[0], ends[1], one.checked].map(Cell::Number));
    }
    table
}

/// A row for every run, in the order in which they were.
fn runs(work: &Work<'_>) -> Table {
    let task = work.task;
    let keys = task.ranges.iter().map(|range| format!("{} [text]", range.key));
    let unit = |result: &str| {
        let known = work.ran.iter().find(|ran| ran.summary.results.get(result).is_some());
        known.map_or("-", |ran| ran.summary.unit(result)).to_owned()
    };
    let results = task.measured.iter().map(|measured| format!("{} [{}]", measured.result, unit(&measured.result)));
    let header = ["run [-]".to_owned(), "purpose [text]".to_owned()].into_iter().chain(keys);
    let mut table = Table::new(header.chain(results).chain(["status [text]".to_owned()]));
    for (index, ran) in work.ran.iter().enumerate() {
        let purpose = if ran.purpose == Purpose::Learn { "learn" } else { "check" };
        let mut row = vec![Cell::Number(index as f64), purpose.into()];
        row.extend(ran.case.values.iter().map(|(_, value)| Cell::Text(value_text(value))));
        row.extend(ran.results.iter().map(|value| Cell::Number(*value)));
        row.push(ran.summary.status.word().into());
        table.push(row);
    }
    table
}
