//! What watches have seen: numbers over time, profiles at a few times, paths of grains, single events, fields as maps.

use serde::Deserialize;
use tsubu_frame::summary::read_json;
use tsubu_frame::{Table, csv::split_unit};

use crate::field;
use crate::figure::{Axis, Figure, Series, Style};
use crate::page::{Block, Grid, Tone, folded};
use crate::quantity::prefix;
use crate::source::Source;
use crate::steady::Steady;
use crate::text::short;

/// Figures of a watch that are seen without unfolding.
const OPEN: usize = 2;
/// Times at which a profile is drawn.
const TIMES: usize = 5;
/// Grains whose paths are drawn.
const PATHS: usize = 8;

/// What `watch/index.json` says of a watch.
#[derive(Debug, Deserialize)]
struct Entry {
    name: String,
    kind: String,
    #[serde(default)]
    about: String,
    scalars: Vec<String>,
    /// Components of an axis, n and -n the same: they have no mean of their own.
    #[serde(default)]
    axis: Vec<String>,
    file: Option<String>,
    coordinates: Vec<String>,
    values: Vec<String>,
}

/// The watches of a run.
#[derive(Debug, Default)]
pub(crate) struct Watches(Vec<Entry>);

impl Watches {
    /// Those of a folder; none if it has none.
    pub fn read(source: &mut Source) -> Self {
        let path = "watch/index.json";
        if !source.has(path) {
            return Self::default();
        }
        let read = read_json(&source.dir.join(path));
        Self(source.told(read).unwrap_or_default())
    }

    /// Whether a column of the history is theirs.
    pub fn own(&self, header: &str) -> bool {
        self.0.iter().any(|entry| entry.scalars.iter().any(|scalar| scalar == header))
    }

    /// Their section of the page.
    pub fn blocks(&self, source: &mut Source, history: Option<&Table>) -> Vec<Block> {
        let mut blocks = Vec::new();
        for entry in &self.0 {
            let mut drawn = Vec::new();
            if let Some(table) = entry.file.as_deref().and_then(|file| source.table(file)) {
                drawn.extend(entry.of_table(source, &table));
            }
            drawn.extend(history.map(|history| entry.over_time(source, history)).unwrap_or_default());
            let rest = drawn.split_off(drawn.len().min(OPEN));
            blocks.extend(drawn);
            if !rest.is_empty() {
                blocks.push(folded(&format!("More of {}", entry.name), rest));
            }
            if !entry.about.is_empty() {
                let what = format!("What {} measures ({})", entry.name, entry.kind.replace('-', " "));
                blocks.push(folded(&what, vec![Block::Typed(entry.about.clone())]));
            }
        }
        if let Some(table) = history.and_then(|history| self.steady(history)) {
            let text = "Means of the steady part, with half of their 95 % interval: the start is cut off by MSER-5 (White 1997), the interval is by the \
                        means of 16 batches. What drifts to the end or stands still is left out.";
            blocks.extend([Block::Text(text.to_owned()), table]);
        }
        blocks
    }

    /// Mean and error in the steady part of what has one and varies, as a table.
    fn steady(&self, history: &Table) -> Option<Block> {
        let times = numbers(history, 0);
        let mut grid = Grid::new(["in the steady part", "mean", "± (95 %)", "unit", "from t [s]"]);
        for scalar in self.0.iter().flat_map(Entry::of_no_axis) {
            let Some(column) = history.header.iter().position(|header| header == scalar) else { continue };
            let values = numbers(history, column);
            let Some(found) = Steady::of(&values).filter(|found| found.error > 1e-9 * found.mean.abs()) else {
                continue;
            };
            let (name, unit) = split_unit(scalar);
            let (factor, unit) = prefix(unit.unwrap_or("-"), found.mean.abs());
            let unit = if unit == "-" { String::new() } else { unit };
            let [mean, error] = [found.mean, found.error].map(|x| short(x * factor));
            grid.push(Tone::Plain, [name.to_owned(), mean, error, unit, short(times[found.first])]);
        }
        (!grid.rows.is_empty()).then_some(Block::Table(grid))
    }
}

/// A column as numbers.
fn numbers(table: &Table, column: usize) -> Vec<f64> {
    table.rows.iter().map(|row| row[column].number().unwrap_or(f64::NAN)).collect()
}

fn says_something(values: &[f64]) -> bool {
    values.iter().any(|x| x.is_finite() && *x != 0.0)
}

/// `position x` and `position z` belong together, `x` and `z` alone do not.
fn family(name: &str) -> &str {
    match name.rsplit_once(' ') {
        Some((family, component)) if component.len() <= 2 && component.chars().all(|c| "xyz".contains(c)) => family,
        _ => name,
    }
}

/// Columns next to each other that belong into one figure: components of one vector.
fn families<'a>(headers: &'a [(usize, &'a str)]) -> impl Iterator<Item = &'a [(usize, &'a str)]> {
    headers.chunk_by(|a, b| {
        let ((a, unit), (b, other)) = (split_unit(a.1), split_unit(b.1));
        unit == other && family(a) == family(b) && family(a) != a
    })
}

impl Entry {
    /// Columns of the history that have a mean of their own.
    fn of_no_axis(&self) -> impl Iterator<Item = &String> {
        self.scalars.iter().filter(|scalar| !self.axis.contains(scalar))
    }

    fn caption(&self, what: &str) -> String {
        format!("{} ({}): {what}", self.name, self.kind.replace('-', " "))
    }

    fn file(&self, what: &str) -> String {
        let plain = what.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
        format!("watch_{}_{plain}", self.name)
    }

    /// Columns of the history, components of a vector together.
    fn over_time(&self, source: &mut Source, history: &Table) -> Vec<Block> {
        let times = numbers(history, 0);
        let prefix = format!("{} ", self.name);
        let columns = self.scalars.iter().filter_map(|scalar| {
            let column = history.header.iter().position(|header| header == scalar)?;
            Some((column, scalar.strip_prefix(&prefix).unwrap_or(scalar)))
        });
        let columns: Vec<(usize, &str)> =
            columns.filter(|(column, _)| says_something(&numbers(history, *column))).collect();
        let mut blocks = Vec::new();
        for group in families(&columns) {
            let (name, unit) = split_unit(group[0].1);
            let label = if group.len() > 1 { family(name) } else { name };
            let mut figure = Figure::new("", Axis::new("time", "s"), Axis::new(label, unit.unwrap_or("-")));
            for (column, header) in group {
                let name = if group.len() > 1 { split_unit(header).0 } else { "" };
                let points = times.iter().copied().zip(numbers(history, *column)).collect();
                figure = figure.with(Series::line(name, points));
            }
            figure.height = 240;
            blocks.extend(source.figure(&self.file(label), &figure, &self.caption(label)));
        }
        blocks
    }

    fn of_table(&self, source: &mut Source, table: &Table) -> Vec<Block> {
        match (self.kind.as_str(), self.coordinates.len()) {
            ("track", _) => self.paths(source, table),
            ("hops", _) => self.events(source, table),
            (_, 1) => self.profiles(source, table),
            (_, 2) => self.maps(source, table),
            _ => Vec::new(),
        }
    }

    /// Values against the coordinate at a few times, and their mean.
    fn profiles(&self, source: &mut Source, table: &Table) -> Vec<Block> {
        let looks: Vec<&[Vec<tsubu_frame::Cell>]> = table.rows.chunk_by(|a, b| a[0] == b[0]).collect();
        let upright = self.coordinates[0].starts_with("z ");
        let coordinate = Axis::from_header(&self.coordinates[0]);
        let shown: Vec<usize> =
            (0..TIMES.min(looks.len())).map(|k| k * (looks.len() - 1) / (TIMES.min(looks.len()) - 1).max(1)).collect();
        let mut blocks = Vec::new();
        for (k, header) in self.values.iter().enumerate() {
            let column = 1 + self.coordinates.len() + k;
            if !says_something(&numbers(table, column)) {
                continue;
            }
            let value = Axis::from_header(header);
            let label = value.label.clone();
            let (x, y) = if upright { (value, coordinate.clone()) } else { (coordinate.clone(), value) };
            let mut figure = Figure::new("", x, y);
            let point = |(at, value): (f64, f64)| if upright { (value, at) } else { (at, value) };
            let number = |row: &[tsubu_frame::Cell], column: usize| row[column].number().unwrap_or(f64::NAN);
            let last = shown.last().map_or(f64::NAN, |k| number(&looks[*k][0], 0));
            for look in shown.iter().map(|k| looks[*k]) {
                let points = look.iter().map(|row| point((number(row, 1), number(row, column)))).collect();
                figure = figure.with(Series::line(crate::legend::time_label(number(&look[0], 0), last), points));
            }
            if looks.len() > TIMES {
                let points = means(table, column, looks[0].len());
                let points = points.into_iter().enumerate().map(|(k, mean)| point((number(&looks[0][k], 1), mean)));
                figure = figure.with(Series::line("mean over time", points.collect()).styled(Style::Dashed));
            }
            // Against the height a profile stands upright.
            (figure.width, figure.height) = if upright { (520, 460) } else { (0, 320) };
            blocks.extend(source.figure(&self.file(&format!("{label} profile")), &figure, &self.caption(&label)));
        }
        blocks
    }

    /// Components of the positions over time, a line a grain.
    fn paths(&self, source: &mut Source, table: &Table) -> Vec<Block> {
        let (times, ids) = (numbers(table, 0), numbers(table, 1));
        let mut names: Vec<f64> = Vec::new();
        for id in &ids {
            if !names.contains(id) && names.len() < PATHS {
                names.push(*id);
            }
        }
        let mut blocks = Vec::new();
        for (k, header) in self.values.iter().enumerate() {
            let values = numbers(table, 2 + k);
            if !says_something(&values) {
                continue;
            }
            let axis = Axis::from_header(header);
            let label = axis.label.clone();
            let mut figure = Figure::new("", Axis::new("time", "s"), axis);
            for id in &names {
                let rows = (0..values.len()).filter(|row| ids[*row] == *id);
                let points = rows.map(|row| (times[row], values[row])).collect();
                figure = figure.with(Series::line(format!("grain {id}"), points));
            }
            figure.height = 240;
            blocks.extend(source.figure(&self.file(&format!("{label} paths")), &figure, &self.caption(&label)));
        }
        blocks
    }

    /// Values of single events over time; the first value is the time at which one began. A colour a grain if they are few.
    fn events(&self, source: &mut Source, table: &Table) -> Vec<Block> {
        let (times, ids) = (numbers(table, 2), numbers(table, 1));
        let mut names = ids.clone();
        names.sort_by(f64::total_cmp);
        names.dedup();
        let few = (2..=PATHS).contains(&names.len());
        let mut blocks = Vec::new();
        for (k, header) in self.values.iter().enumerate().skip(1) {
            let values = numbers(table, 2 + k);
            if !says_something(&values) {
                continue;
            }
            let axis = Axis::from_header(header);
            let label = axis.label.clone();
            let mut figure = Figure::new("", Axis::new(split_unit(&self.values[0]).0, "s"), axis);
            let points = |of: &dyn Fn(f64) -> bool| {
                (0..values.len()).filter(|row| of(ids[*row])).map(|row| (times[row], values[row])).collect()
            };
            if few {
                for name in &names {
                    let points = points(&|id| id == *name);
                    figure = figure.with(Series::line(format!("grain {name}"), points).styled(Style::Points));
                }
            } else {
                figure = figure.with(Series::line("", points(&|_| true)).styled(Style::Points));
            }
            figure.height = 240;
            blocks.extend(source.figure(&self.file(&format!("{label} events")), &figure, &self.caption(&label)));
        }
        blocks
    }

    /// Means over time as maps.
    fn maps(&self, source: &mut Source, table: &Table) -> Vec<Block> {
        let look = table.rows.chunk_by(|a, b| a[0] == b[0]).next().unwrap_or_default();
        let places: Vec<[f64; 2]> =
            look.iter().map(|row| [1, 2].map(|c| row[c].number().unwrap_or(f64::NAN))).collect();
        let mut blocks = Vec::new();
        for (k, header) in self.values.iter().enumerate() {
            let values = means(table, 3 + k, look.len());
            if !says_something(&values) {
                continue;
            }
            let axes = [Axis::from_header(&self.coordinates[0]), Axis::from_header(&self.coordinates[1])];
            let value = Axis::from_header(header);
            let caption = self.caption(&format!("{}, mean over time", value.label));
            if let Some(svg) = field::map(&places, &values, &axes, &value) {
                blocks.push(source.drawing(&self.file(&format!("{} map", value.label)), svg, &caption));
            }
        }
        blocks
    }
}

/// Mean over the looks of every row of a look.
fn means(table: &Table, column: usize, rows: usize) -> Vec<f64> {
    let (mut sum, mut count) = (vec![0.0; rows], vec![0.0; rows]);
    for (k, value) in numbers(table, column).into_iter().enumerate().filter(|(_, value)| value.is_finite()) {
        sum[k % rows] += value;
        count[k % rows] += 1.0;
    }
    sum.into_iter().zip(count).map(|(sum, count)| sum / count).collect()
}
