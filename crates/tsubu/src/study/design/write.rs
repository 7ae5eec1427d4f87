//! The files of a design.

use super::limits;
use super::search;
use super::work::{Found, Work};
use super::{Measured, Standing};
use crate::study::cases::value_text;
use crate::study::summary::{begun, judge};
use tsubu_frame::{Cell, FileError, RunFolder, Status, Summary, Table};
use tsubu_scene::Scene;

/// Writes `design.csv`, `steps.csv`, `curves.csv`, `best.toml`, `check.txt` and `summary.json`.
pub(super) fn write(
    folder: &RunFolder,
    scene: &Scene,
    work: &Work<'_>,
    found: Option<&Found>,
    status: Status,
    wall_seconds: f64,
) -> Result<Summary, FileError> {
    let task = work.task;
    folder.write("design.csv", candidates(work, found.map(|found| found.best)).to_csv().as_bytes())?;
    let mut summary = begun(scene.plan(), status, wall_seconds);
    summary.give("runs", "-", f64::from(work.runs()));
    summary.give("candidates", "-", task.candidates.list.len() as f64);
    for (limit, number) in task.candidates.limits.list.iter().zip(task.candidates.limits.left_out()) {
        summary.give(format!("beyond {}", limit.key), "-", number as f64);
    }
    let measured: Vec<usize> = work.values().into_iter().map(|(index, _)| index).collect();
    summary.give("candidates measured", "-", measured.len() as f64);
    summary.give("candidates failed", "-", work.failures.len() as f64);
    let farthest = task.candidates.farthest(&measured).map_or(0.0, |(_, distance)| distance);
    summary.give("distance of the farthest from those", "-", farthest);
    if let Some(two) = work.differences().filter(|_| task.wanted.cheap.is_some()) {
        summary.give("candidates measured cheaply", "-", work.cheap_values() as f64);
        summary.give("cost of these in runs", "-", work.cheap_cost());
        summary.give("candidates measured both ways", "-", two.number as f64);
        summary.give("cheap: mean difference of logarithms", "-", two.mean);
        summary.give("cheap: deviation of the difference", "-", two.deviation);
        summary.give("cheap: correlation", "-", two.correlation);
        summary.give("cheap: factor", "-", two.factor);
    }
    if let Some(found) = found {
        folder.write("steps.csv", steps(work, found.best).to_csv().as_bytes())?;
        folder.write("curves.csv", curves(work, found.best).to_csv().as_bytes())?;
        if let Ok(best) = task.candidates.list[found.best].case.scene(scene) {
            folder.write_editable("best.toml", best.resolved_toml().as_bytes())?;
        }
        summary.particles = task.plan(found.best).grains() as u64;
        let [mass, ..] = limits::measures(task.plan(found.best), &task.wanted);
        summary.give("mass of the grains", "kg", mass);
        tell(work, found, &mut summary);
        let gain = search::gain(&task.candidates, &work.values(), &work.cheap, &work.closed());
        summary.give("gain expected of others", "-", gain);
        summary.give("half the interval over the best", "-", work.doubt(found.best));
        if task.wanted.until.is_some() {
            summary.give("ended by until", "-", f64::from(u8::from(found.ended_by_until)));
        }
    }
    doubts(work, found, status, &mut summary);
    summary.energy.residual_relative = work.done.values().map(Measured::residual).fold(0.0, f64::max);
    let plan = found.map_or(scene.plan(), |found| task.plan(found.best));
    judge(folder, plan, &mut summary)?;
    folder.write_json("summary.json", &summary)?;
    folder.sync()?;
    Ok(summary)
}

/// The best, and the scene as it is written, in numbers.
fn tell(work: &Work<'_>, found: &Found, summary: &mut Summary) {
    for (index, which) in [(found.best, ""), (work.task.as_written(), " as written")] {
        let Some(standing) = work.standing(index) else { continue };
        summary.give(format!("rms displacement{which}"), "m", standing.rms);
        if let Some([low, high]) = standing.interval {
            summary.give(format!("rms displacement low{which}"), "m", low);
            summary.give(format!("rms displacement high{which}"), "m", high);
        }
        summary.give(format!("peak displacement{which}"), "m", standing.stroke);
        summary.give(format!("peak frequency ratio{which}"), "-", standing.ratio);
    }
}

/// What is to be known before the best is believed.
fn doubts(work: &Work<'_>, found: Option<&Found>, status: Status, summary: &mut Summary) {
    let (task, wanted) = (work.task, &work.task.wanted);
    let candidates = &task.candidates;
    let mut say = |text: String| summary.warnings.push(text);
    if candidates.wrong > 0 {
        let first = candidates.first_wrong.as_deref().unwrap_or_default();
        say(format!("{} combinations cannot be and are left out; the first: {first}", candidates.wrong));
    }
    let beyond = limits::Limits::beyond(task.plan(task.as_written()), wanted);
    if !beyond.is_empty() && work.standing(task.as_written()).is_some() {
        say(format!("the scene as it is written is beyond {}: it is told for comparison alone", beyond.join(" and ")));
    }
    for (index, error) in &work.failures {
        say(format!("candidate `{}` is out, for a run of it failed: {error}", task.name(*index)));
    }
    if let Some(found) = found {
        let near = alike(work, found.best);
        if !near.is_empty() {
            say(format!("not told apart from the best by their intervals: {}", near.join("; ")));
        }
        let of_one_bed =
            |(index, standing): &(usize, Standing)| standing.interval.is_none() && task.plan(*index).grain_mass() > 0.0;
        let same: Vec<String> = confirmed(work).filter(of_one_bed).map(|(index, _)| task.name(index)).collect();
        if !same.is_empty() {
            say(format!(
                "without an interval, for all seeds give the same bed, as where a box is too full for grains to be placed in another way: {}",
                same.join("; ")
            ));
        }
        if let (Some(until), false) = (wanted.until, found.ended_by_until) {
            say(format!(
                "the {} runs were spent before `design.until` = {until} was reached: half the interval of the best is {:.2} % of it, and {}",
                wanted.runs,
                100.0 * work.doubt(found.best),
                if found.searched { "nothing better was expected" } else { "a better one was still expected" }
            ));
        } else if !found.searched {
            say(format!(
                "half of the {} runs were spent while a better one was still expected: a larger `design.runs` may find it",
                wanted.runs
            ));
        }
        if !found.confirmed {
            say(format!(
                "the {} runs were spent before all neighbours of the best were confirmed with {} seeds: a larger `design.runs` does",
                wanted.runs, wanted.seeds
            ));
        }
        if work.standing(found.best).is_some_and(|standing| !standing.found) {
            say("the peak of the best wanders from run to run; the highest that was seen stands for it".to_owned());
        }
    } else if status == Status::Failed {
        let strokes = work.values().into_iter().filter_map(|(index, _)| Some((index, work.standing(index)?.stroke)));
        let strokes = strokes.min_by(|a, b| a.1.total_cmp(&b.1));
        let least = strokes.map_or(f64::INFINITY, |(_, least)| least);
        say(match wanted.stroke_limit.filter(|_| least.is_finite()) {
            Some(limit) => format!(
                "no candidate that was measured keeps within `design.stroke-limit` = {limit} m: the least displacement is {least:.4e} m, of `{}`",
                strokes.map_or_else(String::new, |(index, _)| task.name(index))
            ),
            None => "no candidate could be measured".to_owned(),
        });
    }
}

/// Confirmed candidates whose interval reaches below the end of the best's.
fn alike(work: &Work<'_>, best: usize) -> Vec<String> {
    let ends = |standing: &Standing| standing.interval.unwrap_or([standing.rms; 2]);
    let Some(own) = work.standing(best) else { return Vec::new() };
    let near = |standing: &Standing| ends(standing)[0] <= ends(&own)[1] && work.fits(standing);
    confirmed(work)
        .filter(|(index, standing)| *index != best && near(standing))
        .map(|(index, _)| work.task.name(index))
        .collect()
}

/// Candidates that were measured with all seeds.
fn confirmed<'a>(work: &'a Work<'_>) -> impl Iterator<Item = (usize, Standing)> + 'a {
    let all = work.values().into_iter().filter_map(|(index, _)| Some((index, work.standing(index)?)));
    all.filter(|(_, standing)| standing.seeds >= work.task.wanted.seeds as usize)
}

/// The values of a candidate, key by key; of the scene as it is written those that it has.
fn values(work: &Work<'_>, index: usize) -> Vec<Cell> {
    match work.task.candidates.list.get(index) {
        Some(one) => one.case.values.iter().map(|(_, value)| Cell::Text(value_text(value))).collect(),
        None => work.task.wanted.vary.keys().map(|_| Cell::Text("as written".to_owned())).collect(),
    }
}

fn numbers(standing: &Standing) -> Vec<Cell> {
    let [low, high] = standing.interval.unwrap_or([f64::NAN; 2]);
    [standing.rms, low, high].map(Cell::Number).to_vec()
}

/// A row for every candidate that was measured, in the order in which they were.
fn candidates(work: &Work<'_>, best: Option<usize>) -> Table {
    let task = work.task;
    let keys = task.wanted.vary.keys().map(|key| format!("{key} [text]"));
    let numbers_of = [
        "grain mass [kg]",
        "space [m^3]",
        "grain cost [-]",
        "rms displacement [m]",
        "rms low [m]",
        "rms high [m]",
        "peak displacement [m]",
        "peak frequency ratio [-]",
        "seeds [-]",
        "runs [-]",
        "cheap rms [m]",
        "expected rms [m]",
        "expected low [m]",
        "expected high [m]",
        "standing [text]",
        "front [text]",
    ];
    let mut table =
        Table::new(["candidate [text]".to_owned()].into_iter().chain(keys).chain(numbers_of.map(str::to_owned)));
    let mut order: Vec<usize> = work.expected.iter().map(|(index, _)| *index).collect();
    order.extend(
        work.values()
            .into_iter()
            .map(|(index, _)| index)
            .filter(|index| !work.expected.iter().any(|(known, _)| known == index)),
    );
    order.push(task.as_written());
    let front = front(work);
    for index in order {
        let Some(standing) = work.standing(index) else { continue };
        let expected = work.expected.iter().find(|(known, _)| *known == index).and_then(|(_, expected)| *expected);
        let [mean, deviation] = expected.unwrap_or([f64::NAN; 2]);
        let word = match index {
            _ if Some(index) == best => "best",
            _ if index == task.as_written() => "as written",
            _ if work.failures.contains_key(&index) => "failed",
            _ if !work.fits(&standing) => "beyond the stroke limit",
            _ if standing.seeds >= task.wanted.seeds as usize => "confirmed",
            _ => "searched",
        };
        let mut row = vec![Cell::Text(task.name(index))];
        row.extend(values(work, index));
        row.extend(limits::measures(task.plan(index), &task.wanted).map(Cell::Number));
        row.extend(numbers(&standing));
        row.extend(
            [standing.stroke, standing.ratio, standing.seeds as f64, f64::from(standing.runs)].map(Cell::Number),
        );
        row.push(Cell::Number(work.cheap_value(index).unwrap_or(f64::NAN)));
        row.extend([0.0, -1.96, 1.96].map(|wide| Cell::Number((mean + wide * deviation).exp())));
        row.extend([word, if front.contains(&index) { "yes" } else { "no" }].map(|text| Cell::Text(text.to_owned())));
        table.push(row);
    }
    table
}

/// Candidates within the limits than which none that was measured is both lighter and better (Pareto's front of mass and response).
fn front(work: &Work<'_>) -> Vec<usize> {
    let measured: Vec<(usize, f64, f64)> = work
        .values()
        .into_iter()
        .filter(|(index, _)| work.standing(*index).is_some_and(|standing| work.fits(&standing)))
        .map(|(index, rms)| (index, limits::measures(work.task.plan(index), &work.task.wanted)[0], rms))
        .collect();
    let beaten = |one: &(usize, f64, f64)| {
        measured.iter().any(|other| other.1 <= one.1 && other.2 <= one.2 && (other.1 < one.1 || other.2 < one.2))
    };
    measured.iter().filter(|one| !beaten(one)).map(|one| one.0).collect()
}

/// A row for every step of one key from the best: what it changes.
fn steps(work: &Work<'_>, best: usize) -> Table {
    let task = work.task;
    let mut table = Table::new(
        [
            "key [text]",
            "value [text]",
            "rms displacement [m]",
            "rms low [m]",
            "rms high [m]",
            "change [-]",
            "seeds [-]",
        ]
        .map(str::to_owned),
    );
    let (Some(own), one) = (work.standing(best), &task.candidates.list[best]) else { return table };
    for (axis, (key, value)) in one.case.values.iter().enumerate() {
        let mut rows: Vec<(usize, Vec<Cell>)> = Vec::new();
        let around = task.candidates.neighbours(best).into_iter().chain([best]);
        for index in around {
            let other = &task.candidates.list[index];
            let Some(standing) = work.standing(index) else { continue };
            if index != best && other.digits[axis] == one.digits[axis] {
                continue;
            }
            let shown = if index == best { value } else { &other.case.values[axis].1 };
            let mut row = vec![Cell::Text(key.clone()), Cell::Text(value_text(shown))];
            row.extend(numbers(&standing));
            row.extend([standing.rms / own.rms - 1.0, standing.seeds as f64].map(Cell::Number));
            rows.push((other.digits[axis], row));
        }
        rows.sort_by_key(|(digit, _)| *digit);
        for (_, row) in rows {
            table.push(row);
        }
    }
    table
}

/// The response of the scene as it is written, and that of the best.
fn curves(work: &Work<'_>, best: usize) -> Table {
    let task = work.task;
    let mut table = Table::new(
        [
            "candidate [text]",
            "frequency [Hz]",
            "frequency ratio [-]",
            "rms displacement [m]",
            "peak displacement [m]",
            "apparent mass [kg]",
        ]
        .map(str::to_owned),
    );
    for index in [task.as_written(), best] {
        let of_it = work.done.iter().filter(|(key, _)| (key.candidate, key.level, key.seed) == (index, 0, 0));
        for (ratio, measured) in of_it.filter_map(|(key, measured)| Some((key.ratio?.0, measured))) {
            let Measured::Point(point) = measured else { continue };
            let mut row = vec![Cell::Text(task.name(index))];
            let numbers = [point.frequency, ratio, point.rms, point.peak, point.apparent_mass];
            row.extend(numbers.map(Cell::Number));
            table.push(row);
        }
    }
    table
}
