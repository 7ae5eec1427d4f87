//! Claims: values held against accepted ranges, and where the ranges come from.

use serde::{Deserialize, Serialize};

use crate::not_a_number::{real, reals};

/// What kind of number an accepted range is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// The formula follows from the model: a closed form, a symmetry, a quantity that is conserved. The tolerance may be ours.
    ClosedForm,
    /// A number or a statement printed in a publication.
    Printed,
    /// Read from a figure of a publication.
    Digitised,
    /// Another program, or an independent calculation.
    OtherProgram,
    /// Written down from memory, the source not read.
    Remembered,
    /// Our own choice.
    Own,
    /// Set around a value that came out: it says that nothing moved, not that it is right.
    Regression,
    /// The count of a control: a wrong model, run through the same code, must be refused.
    Control,
    /// Given by the writer of a scene.
    #[default]
    Scene,
}

impl Origin {
    /// All that a shipped claim may have, in the order of tables.
    pub const SHIPPED: [Self; 8] = [
        Self::ClosedForm,
        Self::Printed,
        Self::Digitised,
        Self::OtherProgram,
        Self::Remembered,
        Self::Own,
        Self::Regression,
        Self::Control,
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Printed => "printed",
            Self::Digitised => "digitised figure",
            Self::OtherProgram => "other program",
            Self::Remembered => "remembered",
            Self::Own => "own choice",
            Self::Regression => "regression",
            Self::Control => "control",
            Self::Scene => "the scene",
        }
    }

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the form that serde asks for")]
    fn is_scene(&self) -> bool {
        *self == Self::Scene
    }
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The value, or the interval of an ensemble, lies in the range.
    Pass,
    /// It lies outside.
    Fail,
    /// The interval of an ensemble lies neither in the range nor outside.
    Undecided,
}

impl Verdict {
    /// What it is called.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "FAIL",
            Self::Undecided => "undecided",
        }
    }
}

/// The runs of one scene with different seeds, whose mean is the value of a claim.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Seed of each run.
    pub seeds: Vec<u64>,
    /// What came out of each.
    #[serde(deserialize_with = "reals")]
    pub members: Vec<f64>,
    /// Confidence interval of the mean, 95 %.
    #[serde(deserialize_with = "reals")]
    pub interval: Vec<f64>,
}

/// Where an accepted range comes from.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    text: &'a str,
    origin: Origin,
    after: bool,
    timed: bool,
}

impl<'a> Source<'a> {
    /// Given by the writer of a scene.
    pub const fn scene(text: &'a str) -> Self {
        Self::new(Origin::Scene, text)
    }

    /// Of an origin, in a few words; the range was set before the value was seen.
    pub const fn new(origin: Origin, text: &'a str) -> Self {
        Self { text, origin, after: false, timed: false }
    }

    /// The same for a range that was set after the value had been seen.
    #[must_use]
    pub const fn after(self) -> Self {
        Self { after: true, ..self }
    }

    /// The same for a value that hangs on how fast the machine is and on what else it does.
    #[must_use]
    pub const fn timed(self) -> Self {
        Self { timed: true, ..self }
    }
}

/// What a claim's value was made of, to be drawn: points found, and those they are held against.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Points {
    /// Figure; claims of a study with the same one share it.
    pub figure: String,
    /// Axes, `what [unit]`.
    pub axes: [String; 2],
    /// Whether the axes are logarithmic.
    #[serde(default)]
    pub log: bool,
    /// What tells these points from others of the figure.
    pub series: String,
    /// What came out.
    pub found: Vec<[f64; 2]>,
    /// What the source says; empty where it says nothing at single points.
    #[serde(default)]
    pub published: Vec<[f64; 2]>,
}

/// A value held against its accepted range.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// Study it belongs to; empty for a scene's own claims, and then left out of the file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub study: String,
    /// What is claimed.
    pub name: String,
    /// What came out.
    #[serde(deserialize_with = "real")]
    pub value: f64,
    /// Lower end of the accepted range; none if open.
    #[serde(default)]
    pub low: Option<f64>,
    /// Upper end of the accepted range; none if open.
    #[serde(default)]
    pub high: Option<f64>,
    /// Whether the value is in the range.
    pub pass: bool,
    /// Where the range comes from.
    #[serde(default)]
    pub source: String,
    /// What kind of number that is; left out of the file for a scene's own claims.
    #[serde(default, skip_serializing_if = "Origin::is_scene")]
    pub origin: Origin,
    /// Whether the range was set after the value had been seen.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub after: bool,
    /// Whether the value hangs on how fast the machine is and on what else it does.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub timed: bool,
    /// Of a control: the claims that the wrong model does not pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refuses: Vec<String>,
    /// The number that the source itself gives, if it is one; to be drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beside: Option<f64>,
    /// What was wrong on purpose in the runs that this claim refuses.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub controls: Vec<String>,
    /// The runs that the value is the mean of, if it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ensemble: Option<Ensemble>,
    /// What the value was made of, if there is something to draw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Points>,
}

impl Claim {
    /// Holds a value against its range. Not-a-number never passes.
    pub fn judge(name: impl Into<String>, value: f64, low: Option<f64>, high: Option<f64>, source: Source<'_>) -> Self {
        let pass = !value.is_nan() && low.is_none_or(|l| value >= l) && high.is_none_or(|h| value <= h);
        let Source { text, origin, after, timed } = source;
        Self { name: name.into(), value, low, high, pass, source: text.into(), origin, after, timed, ..Self::default() }
    }

    /// Holds the mean of an ensemble against its range: it passes only where the whole interval lies in it.
    pub fn judge_ensemble(
        name: impl Into<String>,
        ensemble: Ensemble,
        low: Option<f64>,
        high: Option<f64>,
        source: Source<'_>,
    ) -> Self {
        Self::judge(name, f64::NAN, low, high, source).drawn(ensemble)
    }

    /// The same claim of the mean of an ensemble.
    #[must_use]
    pub fn drawn(self, ensemble: Ensemble) -> Self {
        let value = ensemble.members.iter().sum::<f64>() / ensemble.members.len() as f64;
        let inside = |&end: &f64| self.low.is_none_or(|l| end >= l) && self.high.is_none_or(|h| end <= h);
        let pass = ensemble.interval.len() == 2 && ensemble.interval.iter().all(inside);
        Self { value, pass, ensemble: Some(ensemble), ..self }
    }

    /// What became of it. Not-a-number fails.
    pub fn verdict(&self) -> Verdict {
        if self.pass {
            return Verdict::Pass;
        }
        let interval = self.ensemble.as_ref().map(|ensemble| ensemble.interval.as_slice());
        match interval {
            Some(&[from, to]) if self.low.is_none_or(|low| to >= low) && self.high.is_none_or(|high| from <= high) => {
                if from.is_nan() || to.is_nan() {
                    Verdict::Fail
                } else {
                    Verdict::Undecided
                }
            }
            _ => Verdict::Fail,
        }
    }

    /// The same claim beside the number that its source gives.
    #[must_use]
    pub fn beside(mut self, said: f64) -> Self {
        self.beside = Some(said);
        self
    }

    /// The same claim with what is to be drawn.
    #[must_use]
    pub fn showing(mut self, points: Points) -> Self {
        self.points = Some(points);
        self
    }

    /// The same claim under a study's name.
    #[must_use]
    pub fn of(mut self, study: impl Into<String>) -> Self {
        self.study = study.into();
        self
    }
}
