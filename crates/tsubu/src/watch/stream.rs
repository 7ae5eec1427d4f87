//! The water.

use super::{Sample, Sheet, Watch};
use crate::view::{View, Wants};
use crate::water::Stream;

pub(super) const ABOUT: &str = "\
Water in layers (`water.flow.coupled`, `water.flow.column`): for every layer
velocity          of the water, along x in a stream, upwards in a column        [m/s]
share of water    what the grains leave of the layer                            [-]
and of the whole
discharge         of water per width of a stream; of a column per plan area     [m^2/s] or [m/s]
mean velocity     discharge over the depth of water, sum of shares times thickness [m/s]
shear velocity    sqrt(stress at the bottom over density), of a stream          [m/s]
level             height z where a stream ends: its lid, or its free surface    [m]
Limits: as those of the layers; velocities are those of the last step, shares are measured every 50 steps.";

/// Reads the layers of the water.
#[derive(Clone, Debug)]
pub(super) struct Layered {
    /// Whether the water goes along x; else upwards.
    pub along: bool,
}

impl Watch for Layered {
    fn about(&self) -> &'static str {
        ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        let discharge = if self.along { "discharge [m^2/s]" } else { "discharge [m/s]" };
        let rest = ["mean velocity [m/s]", "shear velocity [m/s]", "level [m]"];
        [discharge].into_iter().chain(rest.into_iter().take(if self.along { 3 } else { 1 })).map(String::from).collect()
    }

    fn sheet(&self) -> Option<Sheet> {
        let values = ["velocity [m/s]", "share of water [-]"].map(String::from).to_vec();
        Some(Sheet { coordinates: vec!["z [m]".to_owned()], values, steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let Some((stream, layers)) = view.water.and_then(|water| Some((&water.stream, water.stream.layers()?))) else {
            return Sample { scalars: vec![f64::NAN; self.scalars().len()], rows: Vec::new() };
        };
        let velocity = |k: usize| match stream {
            Stream::Coupled(coupled) => coupled.velocity[k],
            Stream::Column { velocity, .. } => velocity / layers.open[k],
            Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => 0.0,
        };
        let depth: f64 = layers.open.iter().map(|open| open * layers.thickness).sum();
        let mean = (0..layers.len()).map(|k| velocity(k) * layers.open[k] * layers.thickness).sum::<f64>() / depth;
        let scalars = match stream {
            Stream::Coupled(coupled) => vec![coupled.discharge(), mean, coupled.bottom_shear_velocity(), layers.top()],
            Stream::Column { velocity, .. } => vec![*velocity, mean],
            Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => Vec::new(),
        };
        let row = |k: usize| vec![layers.middle(k), velocity(k), layers.open[k]];
        Sample { scalars, rows: (0..layers.len()).map(row).collect() }
    }
}
