//! The page in one file that carries some frames itself, for reports that are mailed.

use std::io::Write as _;

use base64::Engine as _;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use serde_json::{Value, json};
use tsubu_frame::{FileError, Frame};

use crate::moment::{OF_GRAINS, arrays};
use crate::page;
use crate::paint::{Paint, paints, range, values};
use crate::quantised::{Array, Bits, Moment, pack};

/// Most frames that a page carries.
const FRAMES: usize = 60;

/// Most bytes of all that it is: the page, three.js and the frames.
pub const BYTES: usize = 3_000_000;

/// Columns that grains can be coloured by there, where frames have them.
const COLOURS: [&str; 5] = ["velocity", "contact force", "spin", "radius", "group"];

/// It may run what it carries, and load nothing.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'; img-src blob: data:; media-src blob:";

/// Ids are parted by that.
const HALF: f64 = 32768.0;

/// What stands around the frames of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run<'a> {
    /// Its name.
    pub name: &'a str,
    /// The history as CSV, already thinned.
    pub history: &'a str,
    /// The scene as it was run, which names the groups of grains; empty if it is not known.
    pub scene: &'a str,
}

/// Names of the groups of grains of a scene, in the order of their numbers; none where the text is no scene.
pub fn groups(scene: &str) -> Vec<String> {
    let table: toml::Table = scene.parse().unwrap_or_default();
    let particles = table.get("particles").and_then(toml::Value::as_table);
    let mut names: Vec<String> = particles.into_iter().flat_map(toml::Table::keys).cloned().collect();
    names.sort();
    names
}

/// A page with its frames.
#[derive(Clone, Debug)]
pub struct Embedded {
    /// The whole document.
    pub html: String,
    /// What of the run it leaves out, in a sentence.
    pub left_out: String,
}

/// Makes the page of so many frames, of which `read` gives each; of more than fit it takes some from the first to the last, and of more
/// grains than fit every few. Nothing where there is no frame.
pub fn embed(
    count: usize,
    run: &Run,
    read: &mut dyn FnMut(usize) -> Result<Frame, FileError>,
) -> Result<Option<Embedded>, FileError> {
    if count == 0 {
        return Ok(None);
    }
    let (first, last) = (read(0)?, read(count - 1)?);
    let room = BYTES.saturating_sub(document(run, &Parts::of(&first), &[]).len());
    let size = |parts: &Parts| packed(run, parts, &[parts.moment(&first), parts.moment(&last)]).len() / 2;
    let mut parts = Parts::of(&first);
    parts.bonds = room / size(&Parts { bonds: true, ..parts.clone() }).max(1) >= FRAMES / 2;
    // A page of one frame cannot be played: rather some frames of fewer grains.
    while room / size(&parts).max(1) < 4 && parts.every < 1 << 16 {
        parts.every *= 2;
    }
    let mut wanted = (room / size(&parts).max(1)).clamp(1, FRAMES).min(count);
    loop {
        let chosen = evenly(count, wanted);
        let moments =
            chosen.iter().map(|number| Ok(parts.moment(&read(*number)?))).collect::<Result<Vec<_>, FileError>>()?;
        let html = document(run, &parts, &moments);
        if html.len() <= BYTES || wanted == 1 {
            let left_out = left_out(count, wanted, &first, &parts);
            return Ok(Some(Embedded { html, left_out }));
        }
        wanted = (wanted * 9 / 10).min(wanted * BYTES / html.len()).max(1);
    }
}

/// What of frames is carried.
#[derive(Clone, Default)]
struct Parts {
    colours: Vec<(String, &'static str)>,
    bonds: bool,
    /// Of the grains one in so many.
    every: usize,
}

impl Parts {
    fn of(frame: &Frame) -> Self {
        let known = paints(frame).into_iter().filter(|Paint { name, .. }| COLOURS.contains(&name.as_str()));
        Self { colours: known.map(|Paint { name, unit }| (name, unit)).collect(), bonds: false, every: 1 }
    }

    fn moment(&self, frame: &Frame) -> Moment {
        let mut found: Vec<Array> = Vec::new();
        let mut add = |name: String, width: usize, bits: Bits, numbers: &[f64]| {
            let grains = OF_GRAINS.contains(&name.as_str()) || name == "id high" || name.starts_with("colour ");
            let rows = numbers.chunks_exact(width).step_by(if grains { self.every } else { 1 });
            let values = rows.flatten().map(|x| *x as f32).collect();
            found.push(Array { name, width, bits, values });
        };
        for (name, width, numbers) in arrays(frame, self.bonds) {
            if name == "id" {
                // Two halves, each of whole numbers that 16 bits hold exactly.
                let half = |of: fn(f64) -> f64| numbers.iter().map(|id| of(*id)).collect::<Vec<_>>();
                add("id".to_owned(), 1, Bits::Sixteen, &half(|id| id.rem_euclid(HALF)));
                add("id high".to_owned(), 1, Bits::Sixteen, &half(|id| (id / HALF).floor()));
                continue;
            }
            let bits = if ["group", "forces"].contains(&name) { Bits::Eight } else { Bits::Sixteen };
            add(name.to_owned(), width, bits, &numbers);
        }
        for (name, _) in &self.colours {
            add(format!("colour {name}"), 1, Bits::Eight, &values(frame, name).unwrap_or_default());
        }
        let head = json!({ "time": frame.time, "step": frame.step, "cell": frame.periodic() });
        Moment { head, arrays: found }
    }
}

/// What a page does not show of a run.
fn left_out(count: usize, frames: usize, first: &Frame, parts: &Parts) -> String {
    let mut said = vec!["Numbers are rounded: places to a 65,534th of the scene, colours to a 254th.".to_owned()];
    if frames < count {
        said.insert(0, format!("It carries {frames} of {count} frames."));
    }
    if parts.every > 1 {
        said.push(format!("Of the grains it shows one in {}.", parts.every));
    }
    if !parts.bonds && first.rows(tsubu_frame::Kind::Contact) > 0 {
        said.push("Contacts are left out.".to_owned());
    }
    said.push("Arrows are left out.".to_owned());
    said.push("All of it: `tsubu view` with this folder.".to_owned());
    said.join(" ")
}

/// So many numbers below `count`, from the first to the last.
fn evenly(count: usize, wanted: usize) -> Vec<usize> {
    if wanted <= 1 {
        return vec![count - 1];
    }
    (0..wanted).map(|k| k * (count - 1) / (wanted - 1)).collect()
}

/// Frames, modules of the page and their heads as one text of base64.
fn packed(run: &Run, parts: &Parts, moments: &[Moment]) -> String {
    let (mut head, bytes) = pack(moments);
    let times: Vec<&Value> = moments.iter().map(|moment| &moment.head["time"]).collect();
    head["about"] = json!({
        "name": run.name, "times": times, "status": "finished", "stages": [], "verdict": "", "groups": groups(run.scene),
    });
    head["columns"] = parts.colours.iter().map(|(name, unit)| column(name, unit, moments)).collect();
    head["history"] = run.history.into();
    base64(&framed(&head, &bytes))
}

fn column(name: &str, unit: &str, moments: &[Moment]) -> Value {
    let painted = format!("colour {name}");
    let found = moments.iter().flat_map(|moment| &moment.arrays).filter(|array| array.name == painted);
    let numbers: Vec<f64> = found.flat_map(|array| &array.values).map(|x| f64::from(*x)).collect();
    json!({ "name": name, "unit": unit, "range": range(&numbers) })
}

/// A head in JSON behind its length in bytes, then the bytes; deflated.
fn framed(head: &Value, bytes: &[u8]) -> Vec<u8> {
    let head = head.to_string();
    let mut packer = DeflateEncoder::new(Vec::new(), Compression::new(6));
    // Writing into memory does not fail.
    let _ = packer.write_all(&(head.len() as u32).to_le_bytes());
    let _ = packer.write_all(head.as_bytes());
    let _ = packer.write_all(bytes);
    packer.finish().unwrap_or_default()
}

/// The document: the page's own, with style, modules and frames in it instead of beside it.
fn document(run: &Run, parts: &Parts, moments: &[Moment]) -> String {
    let modules: serde_json::Map<String, Value> =
        page::modules(true).map(|(name, text)| (name.to_owned(), text.into())).collect();
    let code = base64(&framed(&modules.into(), &[]));
    let text = |name: &str| page::file(name).map(|(_, bytes)| String::from_utf8_lossy(bytes)).unwrap_or_default();
    let begin = text("begin.js");
    text("index.html")
        .replace("<html lang=\"en\">", "<html lang=\"en\" data-embedded>")
        .replace("<meta charset=\"utf-8\">", &format!("<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">"))
        .replace("<link rel=\"stylesheet\" href=\"page/style.css\">", &format!("<style>{}</style>", text("style.css")))
        .replace(
            "<script type=\"module\" src=\"page/main.js\"></script>",
            &format!(
                "<script type=\"text/plain\" id=\"code\">{code}</script><script type=\"text/plain\" id=\"frames\">{}</script>\
                 <script type=\"module\">{begin}</script>",
                packed(run, parts, moments)
            ),
        )
}

fn base64(bytes: &[u8]) -> String {
    base64::engine::general_purpose::STANDARD.encode(bytes)
}
