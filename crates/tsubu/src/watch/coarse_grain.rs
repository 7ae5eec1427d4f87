//! Coarse-grained fields.

use super::kernel::Kernel;
use super::points::Points;
use super::{Axes, Inside, LETTERS, Sample, Sheet, Watch, axes, mean};
use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.coarse-grain",
    formula: "\
Fields on points, from grains smeared out by a kernel phi of width w (Goldhirsch 2010, Granular Matter 12, 239).
density            rho = sum m phi(x - r)                                     [kg/m^3]; in the plane [kg/m^2]
velocity           V = sum m v phi(x - r) / rho                               [m/s]
kinetic stress     -sum m v' v' phi(x - r), v' = v - V(x)                     [Pa]; in the plane [N/m]
contact stress     sum over contacts of f b times the mean of phi along b     [Pa]; in the plane [N/m]
boundary force     sum over contacts with walls of f phi(x - c)               [N/m^3]; in the plane [N/m^2]
granular temperature  -trace(kinetic stress) / (D rho)                        [m^2/s^2]
f is the force on a grain, b its branch: to the centre of the other grain (or its image across a periodic end), or to the
point of contact c with a wall or with a frozen or driven grain, which are boundaries (Weinhart et al. 2012, Granular
Matter 14, 289). Tension is positive. The first letter of a stress is that of the force.
Then rho DV/Dt = div(stress) + rho g + boundary force holds at every point, and the integral of the stress is the sum of
Love and Weber.",
    symbols: "",
    limits: "Along axes that are not asked for, fields are means over the region, to which a body belongs by its centre \
and a contact by the middle of its branch. Fields within a kernel of the region's ends see what lies beyond. \
Spins are left out. What bonds, the body of a clump and water do to grains is in no field: with these the balance misses it.",
    reference: "Goldhirsch 2010, Granular Matter 12, 239; boundaries: Weinhart et al. 2012, Granular Matter 14, 289",
};

/// Numbers kept at every point: density, momentum, two stresses, boundary force.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    density: f64,
    momentum: DVec3,
    kinetic: [DVec3; 3],
    contact: [DVec3; 3],
    boundary: DVec3,
}

impl Cell {
    fn velocity(&self) -> DVec3 {
        // Where nothing is, 0 / 0 says so.
        self.momentum / self.density
    }
}

/// Fields on points.
#[derive(Clone, Debug)]
pub(super) struct CoarseGrain {
    kernel: Kernel,
    points: Points,
    region: Inside,
    /// What the other axes are averaged over: their extents multiplied.
    across: f64,
    varies: Vec<usize>,
    axes: Axes,
    cells: Vec<Cell>,
}

pub(super) fn open(asked: &watch::CoarseGrain, plan: &Plan) -> CoarseGrain {
    let watch::CoarseGrain { kernel, width, axes: along, points, region } = asked;
    let varies: Vec<usize> = along.iter().map(|a| a.index()).collect();
    let others = axes(plan).iter().filter(|a| !varies.contains(a));
    let across = others.map(|&a| region.high[a] - region.low[a]).product();
    let points = Points::new(along, points, region);
    let cells = vec![Cell::default(); points.len()];
    let kernel = Kernel::new(*kernel, *width, varies.len());
    CoarseGrain { kernel, points, region: Inside::new(Some(region), plan), across, varies, axes: axes(plan), cells }
}

impl CoarseGrain {
    /// Whether a point counts: along the axes that fields vary along everything does.
    fn counts(&self, view: &View, p: DVec3) -> bool {
        self.region.holds_but(view.put(p), &self.varies)
    }

    fn grains(&mut self, view: &View) {
        let (reach, kernel, across) = (self.kernel.reach(), self.kernel, self.across);
        let g = &view.grains;
        let own: Vec<usize> = (0..view.len()).filter(|&i| view.free(i) && self.counts(view, g.position[i])).collect();
        let (points, cells) = (&self.points, &mut self.cells);
        let mut smear = |change: &dyn Fn(&mut Cell, usize, f64)| {
            for &i in &own {
                points.near(points.project(g.position[i]), DVec3::ZERO, reach, &view.periodic, |k, x| {
                    change(&mut cells[k], i, kernel.value(x.length_squared()) / across);
                });
            }
        };
        smear(&|cell, i, phi| {
            cell.density += g.mass[i] * phi;
            cell.momentum += g.mass[i] * phi * g.velocity[i];
        });
        // A second time, about the mean: squares less the square of the mean would lose what is small.
        smear(&|cell, i, phi| {
            if phi > 0.0 {
                let v = g.velocity[i] - cell.velocity();
                (0..3).for_each(|a| cell.kinetic[a] -= g.mass[i] * phi * v[a] * v);
            }
        });
    }

    fn contacts(&mut self, view: &View) {
        let g = &view.grains;
        for c in &view.contacts {
            let (first, to_point) = (g.position[c.first], c.position - g.position[c.first]);
            let held = |i: usize| !view.free(i);
            match (held(c.first), c.wall || held(c.second)) {
                (false, false) => self.branch(view, first, c.branch, c.force, false),
                (false, true) => self.branch(view, first, to_point, c.force, true),
                (true, false) => self.branch(view, first + c.branch, to_point - c.branch, -c.force, true),
                (true, true) => {}
            }
        }
    }

    /// Smears a force along a branch that begins at `from`; at its end it may press on a boundary.
    fn branch(&mut self, view: &View, from: DVec3, b: DVec3, force: DVec3, boundary: bool) {
        if !self.counts(view, from + 0.5 * b) {
            return;
        }
        let (p, along) = (self.points.project(from), self.points.project(b));
        let (kernel, across, cells) = (self.kernel, self.across, &mut self.cells);
        self.points.near(p, along, kernel.reach(), &view.periodic, |k, x| {
            let mean = kernel.line(x, along) / across;
            (0..3).for_each(|a| cells[k].contact[a] += force[a] * mean * b);
            if boundary {
                cells[k].boundary += force * (kernel.value((x - along).length_squared()) / across);
            }
        });
    }

    fn row(&self, k: usize) -> Vec<f64> {
        let (place, cell) = (self.points.position(k), &self.cells[k]);
        let mut row: Vec<f64> = self.varies.iter().map(|&a| place[a]).collect();
        row.push(cell.density);
        row.extend(self.axes.iter().map(|&a| cell.velocity()[a]));
        for stress in [&cell.kinetic, &cell.contact] {
            row.extend(self.axes.iter().flat_map(|&a| self.axes.iter().map(move |&b| stress[a][b])));
        }
        row.extend(self.axes.iter().map(|&a| cell.boundary[a]));
        row.push(self.trace(&cell.kinetic) / -cell.density);
        row
    }

    /// Mean of the diagonal.
    fn trace(&self, stress: &[DVec3; 3]) -> f64 {
        mean(self.axes.iter().map(|&a| stress[a][a]))
    }

    fn units(&self) -> [&'static str; 3] {
        if self.axes.len() == 3 { ["kg/m^3", "Pa", "N/m^3"] } else { ["kg/m^2", "N/m", "N/m^2"] }
    }
}

impl Watch for CoarseGrain {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        let [density, stress, _] = self.units();
        vec![format!("mean density [{density}]"), format!("mean pressure [{stress}]")]
    }

    fn sheet(&self) -> Option<Sheet> {
        let [density, stress, boundary] = self.units();
        let letters = || self.axes.iter().map(|&a| LETTERS[a]);
        let mut values = vec![format!("density [{density}]")];
        values.extend(letters().map(|a| format!("velocity {a} [m/s]")));
        for what in ["kinetic", "contact"] {
            values.extend(letters().flat_map(|a| letters().map(move |b| format!("{what} stress {a}{b} [{stress}]"))));
        }
        values.extend(letters().map(|a| format!("boundary force {a} [{boundary}]")));
        values.push("granular temperature [m^2/s^2]".to_owned());
        let coordinates = self.varies.iter().map(|&a| format!("{} [m]", LETTERS[a])).collect();
        Some(Sheet { coordinates, values, steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        self.cells.fill(Cell::default());
        self.grains(view);
        self.contacts(view);
        let pressure = |cell: &Cell| -self.trace(&cell.kinetic) - self.trace(&cell.contact);
        let scalars = vec![mean(self.cells.iter().map(|c| c.density)), mean(self.cells.iter().map(pressure))];
        Sample { scalars, rows: (0..self.cells.len()).map(|k| self.row(k)).collect() }
    }
}
