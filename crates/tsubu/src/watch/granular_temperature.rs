//! How much grains move about their mean motion.

use super::{Axes, Inside, LETTERS, Sample, Watch, axes, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.granular-temperature",
    formula: "\
Granular temperature T = <|v - V|^2> / D of the free grains of a group (of all, unless told), V = <v> their mean velocity, D the
dimension; means are by mass, so that D m T / 2 is the kinetic energy of the fluctuation of a mass m.
granular temperature   T                                                                 [m^2/s^2]
temperature x, z       <(v - V)^2> of each component; T is their mean                    [m^2/s^2]
velocity x, z          V                                                                 [m/s]",
    symbols: "",
    limits: "What moves as a whole has no temperature, but shear and rotation of the group count as fluctuation: take a region that \
is small beside them, or the `profile` of a shear flow. Spins are left out; the spheres of a clump count one by one, so that its turning counts.",
    reference: "Campbell 1990 (Annu. Rev. Fluid Mech. 22, 57)",
};

/// Sums up squares of velocities.
#[derive(Clone, Debug)]
pub(super) struct GranularTemperature {
    group: Option<u32>,
    region: Inside,
    axes: Axes,
}

pub(super) fn open(asked: &watch::GranularTemperature, plan: &Plan) -> GranularTemperature {
    let watch::GranularTemperature { group, region } = asked;
    GranularTemperature {
        group: group.as_ref().map(|name| group_number(plan, name)),
        region: Inside::new(region.as_ref(), plan),
        axes: axes(plan),
    }
}

impl Watch for GranularTemperature {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        let of = |what: &'static str, unit: &'static str| {
            self.axes.iter().map(move |&a| format!("{what} {} [{unit}]", LETTERS[a]))
        };
        let whole = "granular temperature [m^2/s^2]".to_owned();
        std::iter::once(whole).chain(of("temperature", "m^2/s^2")).chain(of("velocity", "m/s")).collect()
    }

    fn take(&mut self, view: &View) -> Sample {
        let g = &view.grains;
        let of_the_group = |i: usize| self.group.is_none_or(|group| g.group[i] == group);
        let counted = |i: &usize| view.free(*i) && of_the_group(*i) && self.region.holds(view.position(*i));
        let own: Vec<usize> = (0..view.len()).filter(counted).collect();
        let mass: f64 = own.iter().map(|&i| g.mass[i]).sum();
        // Without grains not numbers.
        let velocity = own.iter().map(|&i| g.mass[i] * g.velocity[i]).sum::<DVec3>() / mass;
        // About the mean and not from the mean square, which would lose the fluctuation of what moves fast.
        let square = |v: DVec3| v * v;
        let squares = own.iter().map(|&i| g.mass[i] * square(g.velocity[i] - velocity)).sum::<DVec3>() / mass;
        let along = |v: DVec3| self.axes.iter().map(move |&a| v[a]);
        let temperature = along(squares).sum::<f64>() / self.axes.len() as f64;
        Sample {
            scalars: std::iter::once(temperature).chain(along(squares)).chain(along(velocity)).collect(),
            rows: Vec::new(),
        }
    }
}
