//! Which moments of a run to show: eight of a period where one can be told, evenly spread ones otherwise.

use std::collections::HashMap;
use tsubu_frame::{FileError, Frame, Kind, Snapshot, Table, read_frame, snapshots};

use crate::animation;
use crate::balls::{Balls, ColourBy, Look, common};
use crate::legend::time_label;
use crate::page::Block;
use crate::quantity::spoken;
use crate::raster;
use crate::source::Source;
use crate::strip::{Panel, strip};
use crate::text::short;
use crate::wall_motion::{box_motion, motion, velocity};

const PICTURES: usize = 8;
/// Pictures of space are larger: the first moment, the middle, the last.
const IN_SPACE: usize = 3;
/// An animation of more pictures is heavier than a mail takes.
const MOST_FRAMES: usize = 60;
/// A picture is no taller than that, where its legend leaves it room [pixels].
const HEIGHT: f64 = 420.0;
/// Time a page may take for its animation sets the number of grains in it.
const MOST_ANIMATED: usize = 200_000;

/// Strip and animation of a folder's snapshots.
pub(crate) fn blocks(source: &mut Source, history: Option<&Table>, stem: &str) -> Vec<Block> {
    let read = snapshots(&source.dir);
    let found = source.told(read).unwrap_or_default();
    if found.is_empty() {
        return Vec::new();
    }
    let drawn = draw(source, history, &found, stem);
    source.told(drawn).unwrap_or_default()
}

fn draw(source: &mut Source, history: Option<&Table>, found: &[Snapshot], stem: &str) -> Result<Vec<Block>, FileError> {
    let by_host = history.map(periods).unwrap_or_default();
    let who = if by_host.is_empty() { "box" } else { "host" };
    let all = if by_host.is_empty() { whole_periods(&box_motion(found)?) } else { by_host };
    let resolved = shown_period(all, found);
    let chosen = if let Some(period) = resolved {
        eighths(found, period)
    } else {
        let space = Balls::of(&read_frame(&found[found.len() - 1].path)?, &Look::default()).space;
        evenly(found, if space { IN_SPACE } else { PICTURES }).into_iter().map(|i| (i, None)).collect()
    };
    let look = Look::default();
    let mut panels = Vec::new();
    for (i, phase) in &chosen {
        let balls = Balls::of(&read_frame(&found[*i].path)?, &look);
        let time = time_label(found[*i].time, found[found.len() - 1].time);
        let label = phase.map_or(time, |p: f64| format!("{p:.0}°"));
        panels.push(Panel { arrow: motion(found, *i, &balls)?, balls, label });
    }
    if panels.iter().all(|p| p.arrow.is_none_or(|a| a[0].hypot(a[1]) == 0.0)) {
        for panel in &mut panels {
            panel.arrow = None;
        }
    }
    let arrows = if panels.iter().any(|p| p.arrow.is_some()) { " Arrows show how the box moves." } else { "" };
    let arrows = format!("{arrows}{}", left_out(&panels));
    let caption = match resolved {
        Some(p) => format!(
            "One period of {} from t = {} s on, in eighths; 0° is where the {who} passes its middle going up.{arrows}",
            spoken(p.length, "s"),
            short(p.start)
        ),
        None => format!("The run at {} moments.{arrows}", panels.len()),
    };
    let columns = if wide(&panels) { 4 } else { PICTURES };
    let columns = if panels.iter().any(|p| p.balls.space) { IN_SPACE } else { columns };
    let mut blocks = vec![source.drawing(&format!("{stem}strip"), strip(&panels, &look, columns), &caption)];
    if found.len() > 2 && panels.iter().all(|p| p.balls.centres.len() <= MOST_ANIMATED) {
        let moving = animated(source, found, resolved.is_some(), stem)?;
        // The page of one run has what can be turned instead; its file is for talks.
        blocks.extend(moving.filter(|_| !stem.is_empty()));
    }
    blocks.extend(told_apart(source, found, stem)?);
    Ok(blocks)
}

/// In space, the last moment by what tells grains apart: their size and their group.
fn told_apart(source: &mut Source, found: &[Snapshot], stem: &str) -> Result<Vec<Block>, FileError> {
    let mut blocks = Vec::new();
    let frame = read_frame(&found[found.len() - 1].path)?;
    for name in ["radius", "group"] {
        let names = if name == "group" { source.names("particles") } else { Vec::new() };
        let look = Look { colour: ColourBy::Column(name.to_owned()), names, ..Look::default() };
        let balls = Balls::of(&frame, &look);
        let (low, high) = balls.range();
        if balls.space && high > 1.02 * low && balls.values.len() == balls.centres.len() {
            let caption = format!("The last moment, t = {} s, by {name}.", short(frame.time));
            let width = width(common(std::slice::from_ref(&balls), &look).window);
            let bytes = raster::picture(&balls, &look, width).to_png();
            source.files.push((format!("figures/{stem}{name}.png"), bytes.clone()));
            blocks.push(Block::Picture { media: "image/png", bytes, caption });
        }
    }
    Ok(blocks)
}

/// The strip of snapshots that were taken at the eighths of one period of the drive, the last of them a whole period after
/// the first; `drive` says what of the drive is at 0°, `who` what is seen.
pub(crate) fn filmed(source: &mut Source, who: &str, drive: &str) -> Vec<Block> {
    let read = snapshots(&source.dir);
    let found = source.told(read).unwrap_or_default();
    if found.len() != PICTURES + 1 {
        return Vec::new();
    }
    let drawn = draw_filmed(source, &found, who, drive);
    source.told(drawn).into_iter().collect()
}

fn draw_filmed(source: &mut Source, found: &[Snapshot], who: &str, drive: &str) -> Result<Block, FileError> {
    let look = Look::default();
    let series =
        found.iter().map(|f| Ok(Balls::of(&read_frame(&f.path)?, &look))).collect::<Result<Vec<_>, FileError>>()?;
    let panels: Vec<Panel> = (0..PICTURES)
        .map(|i| Panel {
            balls: series[i].clone(),
            label: format!("{:.0}°", 360.0 * i as f64 / PICTURES as f64),
            // The last picture shows the phase of the first: what lies before the first lies before the last.
            arrow: velocity(
                &series[if i == 0 { PICTURES - 1 } else { i - 1 }],
                &series[i + 1],
                2.0 * found[1].time - 2.0 * found[0].time,
            ),
        })
        .collect();
    let length = found[PICTURES].time - found[0].time;
    let caption = format!(
        "{who} at {}: one period of {}, in eighths; 0° is where {drive}. Arrows show how the box moves.",
        spoken(1.0 / length, "Hz"),
        spoken(length, "s"),
    );
    let columns = if wide(&panels) { 4 } else { PICTURES };
    Ok(source.drawing("strip", strip(&panels, &look, columns), &caption))
}

/// Heights at which the grains of a frame were in an earlier one [m]; not a number for those that were not there.
pub(crate) fn heights(earlier: &Frame, frame: &Frame) -> Vec<f64> {
    let began = earlier.vectors(Kind::Grain, "position").iter().map(|place| place[2]);
    let ids = earlier.integers(Kind::Grain, "id");
    let heights: HashMap<i64, f64> = ids.iter().copied().zip(began).collect();
    frame.integers(Kind::Grain, "id").iter().map(|id| heights.get(id).copied().unwrap_or(f64::NAN)).collect()
}

/// What a strip does not show, in words.
fn left_out(panels: &[Panel]) -> String {
    let all: Vec<Balls> = panels.iter().map(|p| p.balls.clone()).collect();
    let look = common(&all, &Look::default());
    let most = look.window.and_then(|w| all.iter().map(|balls| (balls.outside(w), balls.centres.len())).max());
    match most {
        Some((out, of)) if out > 0 => {
            format!(" Up to {out} of {of} grains are far off, outside the pictures.")
        }
        _ => String::new(),
    }
}

/// Eight in a row only if each is taller than wide.
fn wide(panels: &[Panel]) -> bool {
    let look = common(&panels.iter().map(|p| p.balls.clone()).collect::<Vec<_>>(), &Look::default());
    look.window.is_none_or(|w| (w[2] - w[0]) > 0.6 * (w[3] - w[1]))
}

/// Width of the picture of a window [pixels]: a tall vessel fits on a screen, a long bed on the page.
fn width(window: Option<[f64; 4]>) -> u32 {
    let shape = window.map_or(1.0, |w| (w[2] - w[0]) / (w[3] - w[1]));
    (HEIGHT * shape).clamp(290.0, 600.0) as u32
}

/// Puts an animation and its last picture into the folder of figures.
fn animated(source: &mut Source, found: &[Snapshot], periodic: bool, stem: &str) -> Result<Option<Block>, FileError> {
    let chosen: Vec<usize> = if periodic {
        (found.len().saturating_sub(MOST_FRAMES)..found.len()).collect()
    } else {
        evenly(found, MOST_FRAMES)
    };
    let first = read_frame(&found[0].path)?;
    let heights = heights(&first, &first);
    let mut look =
        Look { colour: ColourBy::Given("height at the start".into(), "m".into(), heights.clone()), ..Look::default() };
    let mut series = Vec::new();
    for i in &chosen {
        series.push(Balls::of(&read_frame(&found[*i].path)?, &look));
    }
    if series.iter().any(|b| b.centres.len() != heights.len()) {
        // Grains came or went: the height at the start means nothing for them.
        look.colour = ColourBy::Speed;
        series.clear();
        for i in &chosen {
            series.push(Balls::of(&read_frame(&found[*i].path)?, &look));
        }
    }
    let look = common(&series, &look);
    let width = width(look.window);
    let pictures: Vec<_> = series.iter().map(|b| raster::picture(b, &look, width)).collect();
    let Ok(bytes) = animation::gif(&pictures, 15.0) else { return Ok(None) };
    source.files.push((format!("figures/{stem}animation.gif"), bytes.clone()));
    if let Some(last) = series.last() {
        let png = raster::picture(last, &look, 2 * width).to_png();
        source.files.push((format!("figures/{stem}last.png"), png));
    }
    let span = found[chosen[chosen.len() - 1]].time - found[chosen[0]].time;
    let caption = format!("The last {} in {} pictures.", spoken(span, "s"), chosen.len());
    let caption = if periodic { caption } else { caption.replace("The last", "The whole run of") };
    Ok(Some(Block::Picture { media: "image/gif", bytes, caption }))
}

/// A period of the host's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Period {
    pub start: f64,
    pub length: f64,
}

/// The column of a host's displacement.
pub(crate) fn host_columns(history: &Table) -> Vec<usize> {
    let is_host = |h: &String| h.starts_with("host") && h.contains("displacement");
    history.header.iter().enumerate().filter(|(_, h)| is_host(h)).map(|(i, _)| i).collect()
}

/// The last whole period of the first host's displacement.
pub(crate) fn last_period(history: &Table) -> Option<Period> {
    periods(history).pop()
}

fn periods(history: &Table) -> Vec<Period> {
    let Some(&column) = host_columns(history).first() else { return Vec::new() };
    let pair = |r: &Vec<tsubu_frame::Cell>| Some((r[0].number()?, r[column].number()?));
    whole_periods(&history.rows.iter().filter_map(pair).collect::<Vec<_>>())
}

/// Whole periods of a motion, from one upward passage of its middle to the next. The middle is that of the later half,
/// when the start has died away.
fn whole_periods(motion: &[(f64, f64)]) -> Vec<Period> {
    let points: Vec<_> = motion.iter().filter(|p| p.0.is_finite() && p.1.is_finite()).collect();
    let late = &points[points.len() / 2..];
    let ends = |(l, h): (f64, f64), p: &&(f64, f64)| (l.min(p.1), h.max(p.1));
    let (low, high) = late.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    let middle = f64::midpoint(low, high);
    let passages: Vec<f64> = points
        .windows(2)
        .filter(|w| w[0].1 < middle && w[1].1 >= middle)
        .map(|w| w[0].0 + (w[1].0 - w[0].0) * (middle - w[0].1) / (w[1].1 - w[0].1))
        .collect();
    let whole = |w: &[f64]| Period { start: w[0], length: w[1] - w[0] };
    passages.windows(2).map(whole).filter(|p| p.length > 0.0).collect()
}

/// The last period that the snapshots show from end to end, finely enough for eighths.
fn shown_period(periods: Vec<Period>, found: &[Snapshot]) -> Option<Period> {
    let spacing = typical_spacing(found);
    let (first, last) = (found.first()?.time, found.last()?.time);
    periods.into_iter().rev().find(|p| {
        first - spacing / 2.0 <= p.start
            && p.start + p.length * 7.0 / 8.0 <= last + spacing / 2.0
            && spacing <= p.length / 6.0
    })
}

fn typical_spacing(found: &[Snapshot]) -> f64 {
    match found {
        [.., a, b] => b.time - a.time,
        _ => f64::INFINITY,
    }
}

/// The snapshots nearest to the eighths of a period.
fn eighths(found: &[Snapshot], period: Period) -> Vec<(usize, Option<f64>)> {
    (0..PICTURES)
        .filter_map(|k| {
            let part = k as f64 / PICTURES as f64;
            let wanted = period.start + part * period.length;
            let near = |i: &usize| (found[*i].time - wanted).abs();
            let i = (0..found.len()).min_by(|a, b| near(a).total_cmp(&near(b)))?;
            Some((i, Some(360.0 * part)))
        })
        .collect()
}

fn evenly(found: &[Snapshot], count: usize) -> Vec<usize> {
    if found.len() <= count {
        return (0..found.len()).collect();
    }
    (0..count).map(|k| k * (found.len() - 1) / (count - 1)).collect()
}
