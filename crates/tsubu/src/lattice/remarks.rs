//! What a lattice model has to say about a scene: what it approximates, and what it cannot do.

use crate::engine::{Note, Refusal, Verdict};
use crate::view::Wants;
use tsubu_scene::plan::{self, Plan, Watch};

/// What of a scene's world a lattice has room for.
#[derive(Clone, Copy, Debug)]
pub struct World {
    /// What its grains are called.
    pub noun: &'static str,
    /// Where gravity may point.
    pub gravity: Pull,
    /// Whether the world may repeat itself along x and along z.
    pub periodic: [bool; 2],
}

/// Where gravity may point on a lattice.
#[derive(Clone, Copy, Debug)]
pub enum Pull {
    /// Along -z.
    Down,
    /// Along -z, or there is none.
    DownOrNone,
    /// Downwards in the plane, though it may lean.
    Leaning,
    /// Anywhere in the plane, or there is none.
    Anywhere,
}

impl Pull {
    fn takes(self, [x, y, z]: [f64; 3]) -> bool {
        let way = match self {
            Self::Down => x == 0.0 && z < 0.0,
            Self::DownOrNone => x == 0.0 && z <= 0.0,
            Self::Leaning => z < 0.0,
            Self::Anywhere => true,
        };
        way && y == 0.0
    }

    fn told(self) -> &'static str {
        match self {
            Self::Down => "along -z; set `gravity` to one number, or turn the scene",
            Self::DownOrNone => "along -z or none; set `gravity` to one number, or turn the scene",
            Self::Leaning => "that may lean in the plane but points down; turn the scene",
            Self::Anywhere => "in the plane of x and z; set its y to 0",
        }
    }
}

/// Collects remarks; a refused entry refuses the run.
#[derive(Debug)]
pub struct Remarks {
    method: &'static str,
    /// All remarks so far.
    pub notes: Vec<Note>,
}

impl Remarks {
    /// No remarks yet of the method of that name.
    pub fn of(method: &'static str) -> Self {
        Self { method, notes: Vec::new() }
    }

    /// The method cannot honour this; the text says why and what to do.
    pub fn refuse(&mut self, key: impl Into<String>, text: impl Into<String>) {
        self.notes.push(Note { key: key.into(), verdict: Verdict::Refused, text: text.into() });
    }

    /// The method does something near it; the text says what.
    pub fn approximate(&mut self, key: impl Into<String>, text: impl Into<String>) {
        self.notes.push(Note { key: key.into(), verdict: Verdict::Approximated, text: text.into() });
    }

    /// The method takes this as it is, though it is hardly meant so; the text says why and what to do.
    pub fn doubt(&mut self, key: impl Into<String>, text: impl Into<String>) {
        self.notes.push(Note { key: key.into(), verdict: Verdict::Doubtful, text: text.into() });
    }

    /// Refuses what of a scene's world the method has no room for: space, water, gravity, ends that meet.
    pub fn world(&mut self, plan: &Plan, world: World) {
        let World { noun, gravity, periodic } = world;
        if plan.dimension != 2 {
            let text = format!("{noun} live in the plane; set `dimension = 2`, or use `method = \"dem\"`");
            self.refuse("dimension", text);
        }
        if plan.water.is_some() {
            self.refuse("water", format!("{noun} fall in air; use `method = \"dem\"`"));
        }
        if !gravity.takes(plan.gravity) {
            self.refuse("gravity", format!("the lattice has gravity {}", gravity.told()));
        }
        let plan::Periodic { x, y, z } = &plan.periodic;
        let refused = |ends: &Option<[f64; 2]>, can: bool| ends.is_some() && !can;
        if refused(x, periodic[0]) || refused(z, periodic[1]) || y.is_some() {
            let text = "the lattice ends at walls there; `after-savage` and `after-karolyi-kertesz` repeat themselves along x, `dem`, `fhp` and the gases of grains along both axes";
            self.refuse("periodic", text);
        }
    }

    /// Watches that want to see what the method does not have.
    pub fn watches(&mut self, watches: &toml::map::Map<String, Watch>, plan: &Plan, offered: Wants) {
        for (name, watch) in watches {
            let kind = watch.measure.name();
            let key = format!("watch.{name}.{kind}");
            let way_out = match kind {
                "slope" => "set `touching = false`",
                "profile" => "leave `coordination` out of its quantities",
                _ => "leave this watch out",
            };
            let wants = crate::watch::open(&watch.measure, plan).wants();
            match wants.missing(offered) {
                None => {}
                Some("spins") => self.approximate(key, format!("`{}` knows no spin; it is given as zero", self.method)),
                Some(what) => {
                    let method = self.method;
                    let text = format!(
                        "it looks at {what}, which `{method}` does not have; {way_out}, or use `method = \"dem\"`"
                    );
                    self.refuse(key, text);
                }
            }
        }
    }

    /// The refusal, if anything was refused.
    pub fn refusal(&self) -> Option<Refusal> {
        let notes: Vec<Note> = self.notes.iter().filter(|n| n.verdict == Verdict::Refused).cloned().collect();
        (!notes.is_empty()).then_some(Refusal { method: self.method, notes })
    }
}
