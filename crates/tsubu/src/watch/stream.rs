//! The water.

use super::{Sample, Sheet, Watch};
use crate::about::About;
use crate::state::sphere;
use crate::view::{View, Wants};
use crate::water::{Coupled, KARMAN, Layers, Stream, Submerged, Water};
use glam::DVec3;
use tsubu_scene::plan::{self, Flow, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.stream",
    formula: "\
The water. Of a stream along x (`water.flow.coupled`, `water.flow.log-law`)
shear velocity    U*, sqrt(stress on the bottom over density)                            [m/s]
bed stress        stress at the top of the bed, and what is given to grains above it     [Pa]
Shields number    bed stress / ((s - 1) rho g d), s density of the grains over rho       [-]
Rouse number      w / (0.40 sqrt(bed stress / rho)), w terminal speed of a sphere of d   [-]
of layers (`coupled`, `water.flow.column`)
discharge         of water per width of a stream; of a column per plan area              [m^2/s] or [m/s]
mean velocity     of the water: velocity, weighed by share times thickness of the layers [m/s]
level             height z where a stream ends: its lid, or its free surface              [m]
depth above the bed  of a stream, from the top of its bed to its level                   [m]
and for every layer
velocity          of the water, along x in a stream, upwards in a column                 [m/s]
share of water    what the grains leave of the layer                                     [-]
shear             dU/dz, between the middles of the layers below and above               [1/s]
stress            shear stress of the water, mean of the lower and the upper face        [Pa]
The bed ends with the highest layer that grains fill by 0.3; of a log-law stream, which knows no grains, bed stress is rho U*^2. Density,
d and w are those of the mean grain of the free groups, or of the group that is asked for, as the scene tells them. Of a grain that is no
sphere d is the diameter of the sphere of its volume, the nominal diameter of Wadell 1932, and not `diameter`, that of the sphere which
holds it.
Which is which: U* is that on the bottom, below the bed, where little of the stress comes to; Shields and Rouse number are those at the
top of the bed, in the mean and at the end; `check` tells them of the stream as typed, before grains take from it.",
    symbols: "",
    limits: "As those of the layers; velocities and stresses are those of the last step, shares are measured every 50 \
steps. While the stream gains or loses speed the bed stress is not the weight of the water along the slope.",
    reference: "Shields 1936; Rouse 1937; Wadell 1932",
};

/// Reads the water.
#[derive(Clone, Debug)]
pub(super) struct Watched {
    /// Whether there is a stream along x; else water rises in a column.
    along: bool,
    layered: bool,
    /// The mean grain, if there is one: density [kg/m^3] and diameter [m].
    grain: Option<(f64, f64)>,
    /// [m/s^2]
    gravity: f64,
}

pub(super) fn open(asked: &watch::Stream, plan: &Plan) -> Watched {
    let flow = plan.water.as_ref().map(|water| &water.flow);
    let grain = plan::submerged(plan.particles.iter(), asked.group.as_deref());
    Watched {
        along: !matches!(flow, Some(Flow::Column { .. })),
        layered: matches!(flow, Some(Flow::Column { .. } | Flow::Coupled { .. })),
        grain: Some(grain).filter(|(density, _)| density.is_finite()),
        gravity: DVec3::from_array(plan.gravity).length(),
    }
}

impl Watched {
    /// Shear velocity and stress at the bed, and the numbers of the mean grain.
    fn bed(&self, water: &Water) -> Vec<f64> {
        let shear = water.stream.shear_velocity().unwrap_or(f64::NAN);
        let stress = water.bed_stress().unwrap_or(f64::NAN);
        let numbers = self.grain.map(|grain @ (density, d)| {
            let terminal = water.terminal(Submerged::sphere(0.5 * d), density * sphere::volume(0.5 * d), self.gravity);
            let rouse = terminal.map_or(0.0, |speed| speed / (KARMAN * (stress / water.density).sqrt()));
            [water.shields(stress, grain, self.gravity), rouse]
        });
        [shear, stress].into_iter().chain(numbers.into_iter().flatten()).collect()
    }

    fn rows(water: &Water, layers: &Layers) -> Vec<Vec<f64>> {
        let row = |k: usize, velocity: f64| vec![layers.middle(k), velocity, layers.porosity[k]];
        match &water.stream {
            Stream::Coupled(coupled) => {
                let stresses = coupled.stresses();
                let whole = |k: usize| [row(k, coupled.velocity[k]), sheared(coupled, &stresses, k).to_vec()].concat();
                (0..layers.len()).map(whole).collect()
            }
            Stream::Column { velocity, .. } => {
                (0..layers.len()).map(|k| row(k, velocity / layers.porosity[k])).collect()
            }
            Stream::Still | Stream::LogLaw { .. } | Stream::Table { .. } => Vec::new(),
        }
    }
}

/// Shear [1/s] and stress [Pa] of a layer.
fn sheared(stream: &Coupled, stresses: &[f64], k: usize) -> [f64; 2] {
    let (below, above) = (k.saturating_sub(1), (k + 1).min(stream.layers.len() - 1));
    let way = (above - below) as f64 * stream.layers.thickness;
    [(stream.velocity[above] - stream.velocity[below]) / way, 0.5 * (stresses[k] + stresses[k + 1])]
}

impl Watch for Watched {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        let mut names = Vec::new();
        if self.layered {
            names.extend([if self.along { "discharge [m^2/s]" } else { "discharge [m/s]" }, "mean velocity [m/s]"]);
        }
        if self.along && self.layered {
            names.extend(["level [m]", "depth above the bed [m]"]);
        }
        if self.along {
            names.extend(["shear velocity [m/s]", "bed stress [Pa]"]);
            names.extend(self.grain.iter().flat_map(|_| ["Shields number [-]", "Rouse number [-]"]));
        }
        names.into_iter().map(String::from).collect()
    }

    fn sheet(&self) -> Option<Sheet> {
        let values = ["velocity [m/s]", "share of water [-]", "shear [1/s]", "stress [Pa]"];
        let values = values.into_iter().take(if self.along { 4 } else { 2 }).map(String::from).collect();
        self.layered.then(|| Sheet { coordinates: vec!["z [m]".to_owned()], values, steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let Some(water) = view.water else {
            return Sample { scalars: vec![f64::NAN; self.scalars().len()], rows: Vec::new() };
        };
        let mut sample = Sample::default();
        if let Some(layers) = water.stream.layers() {
            let depth: f64 = layers.porosity.iter().map(|open| open * layers.thickness).sum();
            sample.rows = Self::rows(water, layers);
            let through: f64 = sample.rows.iter().map(|row| row[1] * row[2] * layers.thickness).sum();
            let discharge = match &water.stream {
                Stream::Column { velocity, .. } => *velocity,
                _ => through,
            };
            sample.scalars = vec![discharge, through / depth];
            if let Stream::Coupled(coupled) = &water.stream {
                sample.scalars.extend([layers.top(), layers.top() - coupled.bed_top()]);
            }
        }
        if self.along {
            sample.scalars.extend(self.bed(water));
        }
        sample
    }
}
