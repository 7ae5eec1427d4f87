//! A scene of the common test by every method: what was seen, measured, and left in a folder to be looked at.

use super::super::bench::Rig;
use super::super::ensemble;
use crate::case::Judged;
use glam::DVec3;
use std::path::Path;
use std::time::Instant;
use tsubu::study::compare::{self, Refused};
use tsubu::study::variant::Variant;
use tsubu::watch;
use tsubu_frame::{Cell, Claim, FileError, Formats, Frame, FrameWriter, Kind, RunFolder, Table};
use tsubu_scene::{Plan, Scene};

/// Who runs every test: DEM that rolls freely, that resists rolling and that does not turn, and every other model that can.
const WHO: &str = "dem,rolling=dem:contact.rolling.epsd={},locked=dem:contact.rotation=false,all";

/// A scene of the common test, and what is asked of it.
pub(super) struct Test {
    pub name: &'static str,
    /// One line for the figure.
    pub title: &'static str,
    pub scene: &'static str,
    /// How often it is drawn; pictures and tables are of the first draw.
    pub draws: u64,
    /// Variants that run this test alone; empty for none.
    pub more: &'static str,
    /// Variants that must not show the effect; empty for none.
    pub controls: &'static str,
    /// Takes away what the effect needs.
    pub spoil: fn(&mut Plan),
    /// Every quantity, `what [unit]`, and its value.
    pub measure: fn(&Seen) -> Vec<(&'static str, f64)>,
    pub judge: fn(&Measured) -> Vec<Claim>,
    pub picture: Picture,
}

/// What the figure shows of a test.
pub(super) struct Picture {
    /// Left, bottom, right, top [m].
    pub window: [f64; 4],
    /// The moment to be shown, and the one that colours tell heights of; by their sizes where there is none.
    pub moments: fn(&Seen) -> (usize, Option<usize>),
}

/// A run, looked at in regular intervals.
pub(super) struct Seen {
    pub name: String,
    pub frames: Vec<Frame>,
    /// What each watch of the scene said at each look.
    looks: Vec<Vec<(String, f64)>>,
    /// Computing time [s], without looking.
    seconds: f64,
    steps: u64,
}

/// A grain in a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grain {
    pub id: i64,
    pub at: DVec3,
    pub radius: f64,
}

impl Seen {
    fn of(name: &str, plan: &Plan) -> Result<Self, String> {
        let mut rig = Rig::of(plan.clone(), 1.0)?;
        let interval = plan.output.frame_interval.ok_or("the scene writes no frames")?;
        let mut seen = Self { name: name.to_owned(), frames: Vec::new(), looks: Vec::new(), seconds: 0.0, steps: 0 };
        for look in 0..=(plan.duration / interval).round() as u64 {
            let begun = Instant::now();
            rig.until(look as f64 * interval)?;
            seen.seconds += begun.elapsed().as_secs_f64();
            seen.frames.push(rig.frame());
            let mut said = Vec::new();
            for (name, watch) in &plan.watch {
                let mut watch = watch::open(&watch.measure, plan);
                let sample = watch.take(&rig.engine.view(watch.wants()));
                let names = watch.scalars().into_iter().map(|what| format!("{name} {what}"));
                said.extend(names.zip(sample.scalars));
            }
            seen.looks.push(said);
        }
        seen.steps = rig.engine.steps();
        Ok(seen)
    }

    /// Last look.
    pub fn last(&self) -> usize {
        self.frames.len() - 1
    }

    pub fn time(&self, look: usize) -> f64 {
        self.frames[look].time
    }

    /// The look nearest to a time [s].
    pub fn near(&self, time: f64) -> usize {
        let off = |look: &usize| (self.time(*look) - time).abs();
        (0..self.frames.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
    }

    /// What a watch said at a look.
    pub fn said(&self, look: usize, what: &str) -> f64 {
        self.looks[look].iter().find(|(name, _)| name == what).map_or(f64::NAN, |(_, value)| *value)
    }

    pub fn grains(&self, look: usize) -> Vec<Grain> {
        let frame = &self.frames[look];
        let position = frame.vectors(Kind::Grain, "position");
        let radius = super::super::bench::scalars(frame, Kind::Grain, "radius");
        let all = frame.integers(Kind::Grain, "id").iter().zip(position).zip(radius);
        all.map(|((id, at), radius)| Grain { id: *id, at: DVec3::from_array(*at), radius }).collect()
    }

    /// Grains that are there at both looks: then and now.
    pub fn pairs(&self, then: usize, now: usize) -> Vec<(Grain, Grain)> {
        let mut before = self.grains(then);
        before.sort_by_key(|grain| grain.id);
        let found = |now: &Grain| before.binary_search_by_key(&now.id, |grain| grain.id).ok().map(|at| before[at]);
        self.grains(now).into_iter().filter_map(|now| Some((found(&now)?, now))).collect()
    }
}

/// What came of a test.
pub(super) struct Measured {
    runs: Vec<(Seen, Vec<(&'static str, f64)>)>,
    /// How many of the runs are no controls.
    who: usize,
    refused: Vec<Refused>,
}

impl Measured {
    /// A quantity of a run; not a number where the model did not run.
    pub fn value(&self, name: &str, what: &str) -> f64 {
        let run = self.runs.iter().find(|(seen, _)| seen.name == name);
        let value = run.and_then(|(_, values)| values.iter().find(|(known, _)| *known == what));
        value.map_or(f64::NAN, |(_, value)| *value)
    }

    /// Names of those that ran, without the controls.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.runs[..self.who].iter().map(|(seen, _)| seen.name.as_str())
    }
}

/// Runs a test and judges it; into a folder also pictures and tables.
pub(super) fn judged(test: &Test, perturbation: f64, folder: Option<&RunFolder>) -> Judged {
    ensemble::drawn(test.name, 1..=test.draws, |seed| {
        let measured = run(test, seed, perturbation)?;
        if let Some(folder) = folder.filter(|_| seed == 1) {
            keep(test, &measured, folder).map_err(|error| error.to_string())?;
        }
        Ok((test.judge)(&measured))
    })
}

fn run(test: &Test, seed: u64, perturbation: f64) -> Result<Measured, String> {
    let scene =
        Scene::parse(test.name, test.scene, Path::new("."), &[format!("seed={seed}")]).map_err(|c| c.to_string())?;
    let of = |list: &str| {
        let variants =
            if list.is_empty() { Vec::new() } else { Variant::list(list).map_err(|error| error.to_string())? };
        compare::scenes(&scene, &variants).map_err(|error| error.to_string())
    };
    let (mut who, mut refused) = of(WHO)?;
    // Those of DEM stand side by side, before the lattices.
    who.sort_by_key(|(variant, _)| variant.method != tsubu_scene::plan::Method::Dem);
    who.extend(of(test.more)?.0);
    let (controls, _) = of(test.controls)?;
    let count = who.len();
    let mut runs = Vec::new();
    let mut broken = 0;
    for (index, (variant, scene)) in who.into_iter().chain(controls).enumerate() {
        let mut plan = scene.plan().clone();
        if perturbation != 1.0 {
            (test.spoil)(&mut plan);
        }
        match Seen::of(&variant.name, &plan) {
            Ok(seen) => runs.push(((test.measure)(&seen), seen)),
            // What every method is asked for may turn out to be too much for one on its way.
            Err(why) if variant.may_refuse && index < count => {
                broken += 1;
                refused.push(Refused { method: variant.name, because: vec![("its run".to_owned(), why)] });
            }
            Err(why) => return Err(format!("{}: {why}", variant.name)),
        }
    }
    let mut runs: Vec<_> = runs.into_iter().map(|(values, seen)| (seen, values)).collect();
    for (seen, values) in &mut runs {
        let simulated = seen.time(seen.last());
        values.extend([
            ("computing time per simulated second [-]", seen.seconds / simulated),
            ("steps per simulated second [1/s]", seen.steps as f64 / simulated),
        ]);
    }
    Ok(Measured { runs, who: count - broken, refused })
}

/// Writes the frames that the figure shows, and the tables.
fn keep(test: &Test, measured: &Measured, folder: &RunFolder) -> Result<(), FileError> {
    let place = format!("common-test/{}", test.name);
    let shown = &measured.runs[..measured.who];
    folder.claim(shown.iter().map(|(seen, _)| format!("{place}/{}/frames/", seen.name)))?;
    let mut panels = Vec::new();
    for (seen, _) in shown {
        let (now, then) = (test.picture.moments)(seen);
        let mut frames = FrameWriter::create(&folder.file(&format!("{place}/{}", seen.name)), Formats::default());
        for look in then.into_iter().chain([now]) {
            frames.write(&seen.frames[look])?;
        }
        frames.sync()?;
        panels.push(&seen.name);
    }
    let what: Vec<&str> =
        measured.runs.first().map_or_else(Vec::new, |(_, v)| v.iter().map(|(what, _)| *what).collect());
    let header = std::iter::once("quantity [text]".to_owned())
        .chain(measured.runs.iter().map(|(seen, _)| format!("{} [unit of the row]", seen.name)));
    let mut table = Table::new(header);
    for what in what {
        let values = measured.runs.iter().map(|(seen, _)| Cell::Number(measured.value(&seen.name, what)));
        table.push(std::iter::once(Cell::Text(what.to_owned())).chain(values));
    }
    folder.write(&format!("{place}/measures.csv"), table.to_csv().as_bytes())?;
    folder.write_json(
        &format!("{place}/gallery.json"),
        &serde_json::json!({
            "title": test.title, "window": test.picture.window, "panels": panels, "refused": measured.refused
        }),
    )
}

/// Standard deviation of places about their mean, with weights.
pub(super) fn spread(places: &[(f64, f64)]) -> f64 {
    let weight: f64 = places.iter().map(|(_, w)| w).sum();
    let mean = places.iter().map(|(x, w)| x * w).sum::<f64>() / weight;
    (places.iter().map(|(x, w)| w * (x - mean) * (x - mean)).sum::<f64>() / weight).sqrt()
}

/// The value below which a share of the values lies.
pub(super) fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = (share * (values.len() as f64 - 1.0)).round();
    values.get(place.max(0.0) as usize).copied().unwrap_or(f64::NAN)
}
