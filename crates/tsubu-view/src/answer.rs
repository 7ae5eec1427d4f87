//! What is answered to whom: the page, what runs there are, their frames and histories. Names of files are never asked for.

use std::borrow::Cow;

use serde_json::{Value, json};
use tsubu_frame::{Column, Kind, Values};

use crate::folder::Folder;
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

/// Answers what stands behind the token in an address.
pub fn answer(folders: &[Folder], asked: &str) -> Answer {
    let (path, query) = asked.split_once('?').unwrap_or((asked, ""));
    let parts: Vec<&str> = path.split('/').collect();
    let given = |key: &str| form_urlencoded::parse(query.as_bytes()).find(|(k, _)| k == key).map(|(_, v)| v);
    let colour = given("colour").unwrap_or_default();
    let of = |number: &str| folders.get(number.parse::<usize>().ok()?);
    let done = match parts[..] {
        [""] => return file("index.html"),
        ["page", name] => return file(name),
        ["runs"] => folders.iter().map(Folder::about).collect::<Result<Vec<_>, _>>().map(|all| json(&all.into())),
        ["run", run, what] => {
            let Some(folder) = of(run) else { return Answer::Nothing };
            match what {
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
            frame(folder, number, &colour, contacts)
        }
        ["run", run, "frame", number, "grain", row] => {
            let (Some(folder), Ok(number), Ok(row)) = (of(run), number.parse(), row.parse()) else {
                return Answer::Nothing;
            };
            grain(folder, number, row)
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

fn frame(folder: &Folder, number: usize, colour: &str, contacts: bool) -> Result<Answer, ViewError> {
    let kinds: &[Kind] = if contacts { &[Kind::Surface, Kind::Contact] } else { &[Kind::Surface] };
    let frame = folder.frame(number, kinds)?;
    Ok(frame.map_or(Answer::Nothing, |frame| {
        Answer::Bytes("application/octet-stream", moment::packet(&frame, colour).into())
    }))
}

/// Lowest and highest value of a colour in some frames from first to last.
fn range(folder: &Folder, colour: &str) -> Result<Option<[f64; 2]>, ViewError> {
    let count = folder.snapshots()?.len();
    let step = count.saturating_sub(1).div_ceil(SAMPLES).max(1);
    let mut all: Option<[f64; 2]> = None;
    for number in (0..count).step_by(step).chain(count.checked_sub(1)) {
        let frame = folder.frame(number, &[])?;
        let values = frame.and_then(|frame| paint::values(&frame, colour)).unwrap_or_default();
        if let Some([low, high]) = paint::range(&values) {
            all = Some(all.map_or([low, high], |[l, h]| [l.min(low), h.max(high)]));
        }
    }
    Ok(all)
}

/// All columns of one grain: names, units, numbers.
fn grain(folder: &Folder, number: usize, row: usize) -> Result<Answer, ViewError> {
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
