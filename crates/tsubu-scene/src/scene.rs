//! The scene: what was typed, and the plan it means.

use crate::attach::{self, Companion};
use crate::change;
use crate::check::check;
use crate::complaint::{Complaint, Complaints, Source};
use crate::files::{self, Files};
use crate::node::{self, Node};
use crate::plan::Plan;
use crate::range;
use crate::resolve::{self, Read};
use crate::stage;
use crate::study;
use crate::write;
use std::path::Path;

/// A scene that is right: its text and its plan.
#[derive(Clone, Debug)]
pub struct Scene {
    typed: Typed,
    /// One for each stage of the run.
    plans: Vec<Plan>,
    companions: Vec<Companion>,
}

/// Everything the plan is made from.
#[derive(Clone, Debug)]
struct Typed {
    name: String,
    text: String,
    /// `key.path=value`, in the order given; a later one wins.
    changes: Vec<String>,
    files: Files,
}

impl Scene {
    /// Reads a scene file and applies changes of the form `key.path=value`.
    pub fn read(path: &Path, changes: &[String]) -> Result<Self, Complaints> {
        let name = path.display().to_string();
        let text = files::read_scene(&name, path)?;
        Self::parse(&name, &text, path.parent().unwrap_or(Path::new("")), changes)
    }

    /// The same for a text; `folder` is where files named in it are looked for.
    pub fn parse(name: &str, text: &str, folder: &Path, changes: &[String]) -> Result<Self, Complaints> {
        let typed = Typed {
            name: name.to_string(),
            text: text.to_string(),
            changes: changes.to_vec(),
            files: Files::new(folder),
        };
        Self::new(typed, true)
    }

    /// This scene with some keys changed, as sweeps and responses do for each of their cases.
    pub fn with(&self, changes: &[(&str, &toml::Value)]) -> Result<Self, Complaints> {
        let texts: Vec<String> = changes.iter().map(|(path, value)| change_text(path, value)).collect();
        self.changed(&texts)
    }

    /// The same for changes of the form `key.path=value`.
    pub fn changed<'a>(&self, changes: impl IntoIterator<Item = &'a String>) -> Result<Self, Complaints> {
        let mut typed = self.typed.clone();
        typed.changes.extend(changes.into_iter().cloned());
        // What is varied was tried when this scene was read.
        Self::new(typed, false)
    }

    fn new(mut typed: Typed, try_varied: bool) -> Result<Self, Complaints> {
        let mut plans = Vec::new();
        loop {
            let mut work = Work::begin_stage(&typed, plans.len());
            let mut files = typed.files.clone();
            let plan = work.plan(&mut files, try_varied && plans.is_empty(), &typed);
            typed.files = files;
            let never = plan.as_ref().and_then(|plan| stage::never_steady(plan, plans.len(), &work.root));
            work.complaints.extend(never);
            let Some(mut plan) = plan.filter(|_| work.complaints.is_empty()) else {
                return Err(Complaints::new(work.sources, work.complaints));
            };
            let companions = attach::companions(&mut plan, &typed.files);
            let stages = plan.stage.len();
            plans.push(plan);
            if plans.len() >= stages {
                return Ok(Self { typed, plans, companions });
            }
        }
    }

    /// What the scene means; of a run of several stages, the first.
    pub fn plan(&self) -> &Plan {
        &self.plans[0]
    }

    /// What it means stage by stage; most scenes are one.
    pub fn plans(&self) -> &[Plan] {
        &self.plans
    }

    /// What was typed, without the changes.
    pub fn text(&self) -> &str {
        &self.typed.text
    }

    /// The name the scene was read under.
    pub fn name(&self) -> &str {
        &self.typed.name
    }

    /// What a method has against entries of this scene, key and reason, as complaints that show where they stand. What follows a
    /// semicolon in a reason is what to do.
    pub fn refused<'a>(&self, method: &str, reasons: impl IntoIterator<Item = (&'a str, &'a str)>) -> Complaints {
        let work = Work::begin(&self.typed);
        let complaint = |(key, reason): (&str, &str)| {
            let (why, advice) = reason.split_once("; ").map_or((reason, None), |(why, advice)| (why, Some(advice)));
            // An entry of a list is a step of its own.
            let path: Vec<&str> = key.split(['.', '[', ']']).filter(|step| !step.is_empty()).collect();
            let complaint = Complaint::new(format!("method `{method}` cannot run this scene: `{key}`: {why}"))
                .hints(advice.map(str::to_owned));
            let typed = work.root.find(&path[..1]).is_some();
            if typed { complaint.at(&work.root.locate(&path), "") } else { complaint }
        };
        let list = reasons.into_iter().map(complaint).collect();
        Complaints::new(work.sources, list)
    }

    /// The files that the scene reads, for the run folder: the name there, as [`Self::resolved_toml`] says it, and the
    /// bytes. Files that become numbers of the plan (tables of signals) are not among them.
    pub fn companions(&self) -> Vec<(String, Vec<u8>)> {
        self.companions.iter().map(|(name, bytes)| (name.clone(), bytes.to_vec())).collect()
    }

    /// The scene in SI numbers with every default written out; read again beside its [`Self::companions`] it gives the
    /// same plan, bit by bit. What follows from what a study varies is left to follow it.
    pub fn resolved_toml(&self) -> String {
        let typed = Work::begin(&self.typed).root;
        write::to_toml(self.plan(), |table| {
            study::leave_open(table, self.plan(), &typed);
            stage::leave_open(table, &typed);
        })
    }

    /// Whether the text or a change gives a value to a key.
    pub(crate) fn tells(&self, path: &[&str]) -> bool {
        Work::begin(&self.typed).root.find(path).is_some()
    }
}

/// One reading of a scene.
struct Work {
    sources: Vec<Source>,
    root: Node,
    complaints: Vec<Complaint>,
}

impl Work {
    /// Parses the text and applies the changes.
    fn begin(typed: &Typed) -> Self {
        Self::begin_stage(typed, 0)
    }

    /// The same with what the stages up to one of them set.
    fn begin_stage(typed: &Typed, number: usize) -> Self {
        let (mut root, mut complaints) = node::parse(&typed.text, 0);
        let mut sources = vec![Source { name: typed.name.clone(), text: typed.text.clone(), numbered: true }];
        for text in &typed.changes {
            let source = sources.len();
            sources.push(Source { name: "--set".to_string(), text: text.clone(), numbered: false });
            complaints.extend(change::apply(&mut root, text, source).err());
        }
        if complaints.is_empty() {
            complaints.extend(stage::enter(&mut root, number));
        }
        Self { sources, root, complaints }
    }

    fn plan(&mut self, files: &mut Files, try_varied: bool, typed: &Typed) -> Option<Plan> {
        let broken = !self.complaints.is_empty();
        let (mut resolved, mut complaints) =
            resolve::resolve(&self.root, if broken { Read::Broken } else { Read::All });
        complaints.retain(|complaint| !self.follows_from_syntax(complaint));
        self.complaints.extend(complaints);
        // What follows looks for what is missing, and would complain about the consequences of broken syntax.
        if broken {
            return None;
        }
        self.complaints.extend(resolve::derive(&mut resolved, &self.root, files, &mut self.sources));
        self.complaints.extend(stage::find_start(&mut resolved, &self.root, files));
        self.complaints.extend(check(&resolved, &self.root, files));
        // After all others: they say more of what is wrong.
        if self.complaints.is_empty() {
            self.complaints.extend(resolve::limits(&resolved, &self.root));
        }
        if !self.complaints.is_empty() {
            if try_varied {
                self.check_varied_paths();
            }
            return None;
        }
        let plan = match toml::Value::Table(resolved).try_into::<Plan>() {
            Ok(mut plan) => {
                attach::grains(&mut plan.particles, files, plan.dimension == 3);
                attach::meshes(&mut plan.walls, files);
                plan
            }
            Err(error) => {
                self.complaints.push(
                    Complaint::new(format!("the scene passed every check but makes no plan: {}", error.message()))
                        .hint("this is a mistake in tsubu: please report it with the scene"),
                );
                return None;
            }
        };
        if try_varied {
            self.try_varied(&plan, typed, files);
        }
        Some(plan)
    }

    /// What stands where the syntax is broken was guessed by the parser; complaining about it would be noise.
    fn follows_from_syntax(&self, complaint: &Complaint) -> bool {
        let line = |complaint: &Complaint| {
            let place = complaint.place()?;
            let text = &self.sources[place.source].text.as_bytes()[..place.start];
            Some((place.source, text.split(|byte| *byte == b'\n').count()))
        };
        let guessed = complaint.place().is_some_and(|place| place.start == place.end);
        !self.complaints.is_empty() && (guessed || self.complaints.iter().any(|known| line(known) == line(complaint)))
    }

    /// While the scene itself is wrong, only the paths of what is varied can be judged.
    fn check_varied_paths(&mut self) {
        for family in study::STUDIES {
            let Some(varied) = self.root.find(&[family, "vary"]).and_then(Node::table) else { continue };
            for entry in &varied.entries {
                let change = format!("{}=0", entry.key);
                if let Err(complaint) = change::apply(&mut self.root.clone(), &change, 0) {
                    self.complaints.push(cannot_vary(&entry.key, complaint.title()).at(&entry.place, "varied here"));
                }
            }
        }
    }

    /// Resolves the scene once with every value that a study will give it, so that no case fails an hour later.
    fn try_varied(&mut self, plan: &Plan, typed: &Typed, files: &Files) {
        let wrong = |changes: Vec<String>| {
            let mut case = typed.clone();
            case.files = files.clone();
            case.changes.extend(changes);
            Scene::new(case, false).err()
        };
        for (family, vary) in study::varied(plan) {
            let vary: Vec<Varied<'_>> = vary.iter().map(|(path, values)| Varied::new(family, path, values)).collect();
            for varied in &vary {
                for (index, value) in varied.values.iter().enumerate() {
                    let change = change_text(varied.path, value);
                    let Some(complaints) = wrong(vec![change.clone()]) else { continue };
                    // What the scene says of the other keys may be nothing that the study gives them: the first and the last of theirs are.
                    let others = |pick| {
                        let others = vary.iter().filter(|other| other.path != varied.path);
                        others.filter_map(|other| other.change(pick)).chain([change.clone()]).collect::<Vec<_>>()
                    };
                    let mut beside = [<[_]>::first, <[_]>::last].map(others).into_iter();
                    if vary.len() > 1 && beside.any(|changes| wrong(changes).is_none()) {
                        continue;
                    }
                    let place = self.root.locate(&[family, "vary", varied.path, &index.to_string()]);
                    let title = complaints.titles().next().unwrap_or_default();
                    self.complaints
                        .push(cannot_vary(&format!("{} = {value}", varied.path), title).at(&place, "varied here"));
                }
            }
        }
    }
}

/// A key that a study varies, and the values that are tried.
struct Varied<'a> {
    path: &'a str,
    values: Vec<toml::Value>,
}

impl<'a> Varied<'a> {
    /// Of what varies continuously the ends are tried.
    fn new(family: &str, path: &'a str, values: &[toml::Value]) -> Self {
        let ends = if study::CONTINUOUS.contains(&family) { range::ends(values) } else { None };
        Self { path, values: ends.map_or_else(|| values.to_vec(), Vec::from) }
    }

    /// What gives it one of the values.
    fn change(&self, pick: fn(&[toml::Value]) -> Option<&toml::Value>) -> Option<String> {
        Some(change_text(self.path, pick(&self.values)?))
    }
}

fn cannot_vary(what: &str, why: &str) -> Complaint {
    Complaint::new(format!("cannot vary `{what}`: {why}"))
}

fn change_text(path: &str, value: &toml::Value) -> String {
    format!("{path}={value}")
}
