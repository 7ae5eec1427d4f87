//! Averages in slices across an axis.

use super::{Axes, Inside, LETTERS, Sample, Sheet, Volumes, Watch, axes};
use crate::about::About;
use crate::state::sphere;
use crate::view::{View, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Axis, Plan, Quantity, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.profile",
    formula: "\
Averages in equal slices of a region across an axis. A grain belongs to the region by its centre across the axis; along
it, its volume is cut by the slices, and it counts in each by its share s there. Polyhedra are cut as their cores,
stretched to where the body ends; superellipsoids as ellipsoids that reach as far; the spheres of a clump one by one.
solid fraction        sum s V / volume of the slice; V by shape; in the plane areas         [-]
velocity              V = sum s m v / sum s m                                               [m/s]
granular temperature  sum s m |v - V|^2 / (D sum s m), D the dimension                      [m^2/s^2]
coordination          sum s z / sum s, z all contacts of a grain, those with walls among them [-]
spin                  W = sum s m r^2 w / sum s m r^2: by moment of inertia; in the plane about y  [rad/s]
Frozen and driven grains fill space, but are left out of the others. The history has the same for the whole region;
its temperature is the mean over slices by mass.",
    symbols: "",
    limits: "Overlaps of grains count twice, those of the spheres of a clump once; spins of bodies are weighed by half of \
their diameter as r; the region is still, also where the box moves. Stresses in slices, of contacts (Love and Weber) and of \
fluctuations, are those of `coarse-grain` with `axes = [\"z\"]`.",
    reference: "averages as in any textbook; cuts of spheres, ellipsoids and polyhedra by a plane in closed form",
};

/// Averages in slices.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    axis: Axis,
    low: f64,
    height: f64,
    bins: usize,
    /// Volume of a slice [m^3], in the plane its area [m^2].
    volume: f64,
    quantities: Vec<Quantity>,
    region: Inside,
    axes: Axes,
    volumes: Volumes,
    bin: Vec<Bin>,
}

/// Sums of a slice.
#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    filled: f64,
    shares: f64,
    mass: f64,
    momentum: DVec3,
    squares: f64,
    contacts: f64,
    inertia: f64,
    turning: DVec3,
}

impl Bin {
    fn add(&mut self, other: &Self) {
        self.filled += other.filled;
        self.shares += other.shares;
        self.mass += other.mass;
        self.momentum += other.momentum;
        self.squares += other.squares;
        self.contacts += other.contacts;
        self.inertia += other.inertia;
        self.turning += other.turning;
    }
}

pub(super) fn open(asked: &watch::Profile, plan: &Plan) -> Profile {
    let watch::Profile { axis, bins, quantities, region } = asked;
    let size = |a: usize| region.high[a] - region.low[a];
    let height = size(axis.index()) / *bins as f64;
    Profile {
        axis: *axis,
        low: region.low[axis.index()],
        height,
        bins: *bins,
        volume: axes(plan).iter().filter(|a| **a != axis.index()).map(|a| size(*a)).product::<f64>() * height,
        quantities: quantities.clone(),
        region: Inside::new(Some(region), plan),
        axes: axes(plan),
        volumes: Volumes::new(plan, plan.dimension == 2),
        bin: vec![Bin::default(); *bins],
    }
}

impl Profile {
    fn asks(&self, what: Quantity) -> bool {
        self.quantities.contains(&what)
    }

    /// Axes that grains turn about.
    fn turns(&self) -> Axes {
        if self.axes.len() == 3 { self.axes } else { &[1] }
    }

    /// Calls `visit(bin, grain, share)` for every slice that a grain is in.
    fn slices(&self, view: &View, mut visit: impl FnMut(usize, usize, f64)) {
        let a = self.axis.index();
        let flat = self.axes.len() == 2;
        for i in 0..view.len() {
            let (p, r) = (view.position(i), view.grains.radius[i]);
            if !self.region.holds_but(p, &[a]) {
                continue;
            }
            let shape = view.shapes.and_then(|shapes| Some((shapes, shapes.ends(i, a)?)));
            let [down, up] = shape.map_or([-r, r], |(_, ends)| ends);
            let below = |height: f64| shape.map_or(below(height / r, flat), |(shapes, _)| shapes.below(i, a, height));
            let mut image = |z: f64| {
                let bin = |z: f64| ((z - self.low) / self.height).floor().clamp(0.0, self.bins as f64) as usize;
                for k in bin(z + down)..=bin(z + up).min(self.bins - 1) {
                    let floor = self.low + k as f64 * self.height - z;
                    let share = below(floor + self.height) - below(floor);
                    if share > 0.0 {
                        visit(k, i, share);
                    }
                }
            };
            image(p[a]);
            if let Some([low, high]) = view.periodic[a] {
                image(p[a] - (high - low));
                image(p[a] + (high - low));
            }
        }
    }

    fn values(&self, bin: &Bin, volume: f64) -> Vec<f64> {
        let mut values = Vec::new();
        for quantity in &self.quantities {
            match quantity {
                Quantity::SolidFraction => values.push(bin.filled / volume),
                Quantity::Velocity => values.extend(self.axes.iter().map(|&a| bin.momentum[a] / bin.mass)),
                Quantity::GranularTemperature => values.push(bin.squares / (self.axes.len() as f64 * bin.mass)),
                Quantity::Coordination => values.push(bin.contacts / bin.shares),
                Quantity::Spin => values.extend(self.turns().iter().map(|&a| bin.turning[a] / bin.inertia)),
            }
        }
        values
    }
}

/// Share of a sphere's volume, or of a disc's area, below a plane at `t` radii above its centre.
fn below(t: f64, flat: bool) -> f64 {
    if flat {
        let t = t.clamp(-1.0, 1.0);
        0.5 + (t * (1.0 - t * t).sqrt() + t.asin()) / std::f64::consts::PI
    } else {
        sphere::below(t)
    }
}

impl Watch for Profile {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        let wants = if self.asks(Quantity::Coordination) { Wants::CONTACTS } else { Wants::GRAINS };
        Wants { spins: self.asks(Quantity::Spin), ..wants }
    }

    fn scalars(&self) -> Vec<String> {
        let mut names = Vec::new();
        for quantity in &self.quantities {
            match quantity {
                Quantity::SolidFraction => names.push("solid fraction [-]".to_owned()),
                Quantity::Velocity => names.extend(self.axes.iter().map(|&a| format!("velocity {} [m/s]", LETTERS[a]))),
                Quantity::GranularTemperature => names.push("granular temperature [m^2/s^2]".to_owned()),
                Quantity::Coordination => names.push("coordination [-]".to_owned()),
                Quantity::Spin => names.extend(self.turns().iter().map(|&a| format!("spin {} [rad/s]", LETTERS[a]))),
            }
        }
        names
    }

    fn sheet(&self) -> Option<Sheet> {
        let coordinates = vec![format!("{} [m]", self.axis.name())];
        Some(Sheet { coordinates, values: self.scalars(), steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let g = &view.grains;
        let contacts = if self.asks(Quantity::Coordination) { view.touching(true) } else { Vec::new() };
        let mut bins = std::mem::take(&mut self.bin);
        bins.fill(Bin::default());
        self.slices(view, |k, i, share| {
            let (bin, r) = (&mut bins[k], g.radius[i]);
            bin.filled += share * self.volumes.of(view, i);
            if view.free(i) {
                bin.shares += share;
                bin.mass += share * g.mass[i];
                bin.momentum += share * g.mass[i] * g.velocity[i];
                let inertia = share * g.mass[i] * r * r;
                bin.inertia += inertia;
                bin.turning += inertia * g.spin[i];
                bin.contacts += share * contacts.get(i).map_or(0.0, |z| f64::from(*z));
            }
        });
        if self.asks(Quantity::GranularTemperature) {
            self.slices(view, |k, i, share| {
                if view.free(i) {
                    let v = g.velocity[i] - bins[k].momentum / bins[k].mass;
                    bins[k].squares += share * g.mass[i] * v.length_squared();
                }
            });
        }
        self.bin = bins;
        let mut whole = Bin::default();
        self.bin.iter().for_each(|bin| whole.add(bin));
        let row = |(k, bin): (usize, &Bin)| {
            let middle = self.low + (k as f64 + 0.5) * self.height;
            [middle].into_iter().chain(self.values(bin, self.volume)).collect()
        };
        Sample {
            scalars: self.values(&whole, self.volume * self.bins as f64),
            rows: self.bin.iter().enumerate().map(row).collect(),
        }
    }
}
