//! What is answered to whom: the page, what runs there are, their frames and histories. Names of files are never asked for.

use std::borrow::Cow;

use serde_json::{Value, json};
use tsubu_frame::{Column, Kind, Values};

use crate::source::Source;
use crate::{ViewError, moment, page, paint};

/// What goes back.
pub enum Answer {
    /// Bytes of a type.
    Bytes(&'static str, Cow<'static, [u8]>),
    /// There is no such thing.
    Nothing,
    /// It is there, but cannot be read.
    Broken(String),
}

/// Frames that are looked at for the range of a colour over a run.
const SAMPLES: usize = 8;

/// Frames that are looked at for the curve of a grain.
const POINTS: usize = 100;

/// Whether something behind the token is asked for that changes what is done, and not only shown.
pub fn is_command(asked: &str) -> bool {
    let path = asked.split_once('?').map_or(asked, |(path, _)| path);
    match path.split('/').collect::<Vec<_>>()[..] {
        ["run", _, word] => ["pause", "go-on", "stop", "bye"].contains(&word),
        _ => false,
    }
}

/// Does what is asked for.
pub fn command(sources: &[Source], asked: &str) -> Answer {
    let (path, query) = asked.split_once('?').unwrap_or((asked, ""));
    let [_, run, word] = path.split('/').collect::<Vec<_>>()[..] else { return Answer::Nothing };
    let Some(live) = run.parse().ok().and_then(|run: usize| sources.get(run)?.live()) else { return Answer::Nothing };
    if word == "bye" {
        live.page(query, false);
        return json(&json!("bye"));
    }
    if live.command(word) { json(&live.about()) } else { Answer::Nothing }
}

/// Answers what stands behind the token in an address.
pub fn answer(sources: &[Source], asked: &str) -> Answer {
    let (path, query) = asked.split_once('?').unwrap_or((asked, ""));
    let parts: Vec<&str> = path.split('/').collect();
    let given = |key: &str| form_urlencoded::parse(query.as_bytes()).find(|(k, _)| k == key).map(|(_, v)| v);
    let colour = given("colour").unwrap_or_default();
    let of = |number: &str| sources.get(number.parse::<usize>().ok()?);
    let done = match parts[..] {
        [""] => return file("index.html"),
        ["page", name] => return file(name),
        ["runs"] => sources.iter().map(Source::about).collect::<Result<Vec<_>, _>>().map(|all| json(&all.into())),
        ["run", run, what] => {
            let Some(folder) = of(run) else { return Answer::Nothing };
            match what {
                "news" => {
                    if let Some(live) = folder.live() {
                        live.page(query, true);
                    }
                    folder.about().map(|about| json(&about))
                }
                "about" => folder.about().map(|about| json(&about)),
                "history" => {
                    folder.history().map(|found| found.map_or(Answer::Nothing, |text| Answer::Bytes(CSV, text.into())))
                }
                "range" => range(folder, &colour).map(|range| json(&json!(range))),
                _ => return Answer::Nothing,
            }
        }
        ["run", run, "frame", number] => {
            let (Some(folder), Ok(number)) = (of(run), number.parse()) else { return Answer::Nothing };
            let contacts = given("contacts").is_some_and(|wish| wish == "1");
            frame(folder, number, [&colour, &given("arrows").unwrap_or_default()], contacts)
        }
        ["run", run, "frame", number, "grain", row] => {
            let (Some(folder), Ok(number), Ok(row)) = (of(run), number.parse(), row.parse()) else {
                return Answer::Nothing;
            };
            grain(folder, number, row)
        }
        ["run", run, "grain", id] => {
            let (Some(folder), Ok(id)) = (of(run), id.parse()) else { return Answer::Nothing };
            curve(folder, id, &colour).map(|curve| json(&json!(curve)))
        }
        _ => return Answer::Nothing,
    };
    done.unwrap_or_else(|error| Answer::Broken(error.to_string()))
}

const CSV: &str = "text/csv; charset=utf-8";

fn file(name: &str) -> Answer {
    page::file(name).map_or(Answer::Nothing, |(kind, bytes)| Answer::Bytes(kind, bytes.into()))
}

fn json(value: &Value) -> Answer {
    Answer::Bytes("application/json", value.to_string().into_bytes().into())
}

fn frame(folder: &Source, number: usize, [colour, arrows]: [&str; 2], contacts: bool) -> Result<Answer, ViewError> {
    let kinds: &[Kind] = if contacts { &[Kind::Surface, Kind::Contact] } else { &[Kind::Surface] };
    let frame = folder.frame(number, kinds)?;
    Ok(frame.map_or(Answer::Nothing, |frame| {
        Answer::Bytes("application/octet-stream", moment::packet(&frame, colour, arrows).into())
    }))
}

/// Lowest and highest value of a colour in some frames from first to last.
fn range(folder: &Source, colour: &str) -> Result<Option<[f64; 2]>, ViewError> {
    let mut all: Option<[f64; 2]> = None;
    for (number, _) in some(&folder.moments()?, SAMPLES) {
        let frame = folder.frame(number, &[])?;
        let values = frame.and_then(|frame| paint::values(&frame, colour)).unwrap_or_default();
        if let Some([low, high]) = paint::range(&values) {
            all = Some(all.map_or([low, high], |[l, h]| [l.min(low), h.max(high)]));
        }
    }
    Ok(all)
}

/// Some moments from the first to the last.
fn some(moments: &[(usize, f64)], wanted: usize) -> Vec<(usize, f64)> {
    let last = moments.len().saturating_sub(1);
    let step = last.div_ceil(wanted).max(1);
    moments.iter().enumerate().filter(|(place, _)| place % step == 0 || *place == last).map(|(_, m)| *m).collect()
}

/// Times [s], and what a grain has in a column at them; nothing at those at which it is not there.
fn curve(folder: &Source, id: i64, colour: &str) -> Result<[Vec<Option<f64>>; 2], ViewError> {
    let mut curve = [Vec::new(), Vec::new()];
    for (number, time) in some(&folder.moments()?, POINTS) {
        let Some(frame) = folder.frame(number, &[])? else { continue };
        let row = frame.integers(Kind::Grain, "id").iter().position(|known| *known == id);
        let value = row.and_then(|row| paint::values(&frame, colour)?.get(row).copied());
        curve[0].push(Some(time));
        curve[1].push(value.filter(|value| value.is_finite()));
    }
    Ok(curve)
}

/// All columns of one grain: names, units, numbers.
fn grain(folder: &Source, number: usize, row: usize) -> Result<Answer, ViewError> {
    let Some(frame) = folder.frame(number, &[])? else { return Ok(Answer::Nothing) };
    if row >= frame.rows(Kind::Grain) {
        return Ok(Answer::Nothing);
    }
    let told = |Column { name, unit, values, .. }: &Column| {
        let value = match values {
            Values::Scalar(v) => json!(v.get(row)),
            Values::Vector(v) => json!(v.get(row)),
            Values::Quaternion(v) => json!(v.get(row)),
            Values::Integer(v) => json!(v.get(row)),
        };
        json!({ "name": name, "unit": unit, "value": value })
    };
    Ok(json(&frame.of(Kind::Grain).map(told).collect::<Vec<_>>().into()))
}
