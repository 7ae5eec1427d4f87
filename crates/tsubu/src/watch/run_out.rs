//! How far grains run out, and what they leave.

use super::surface::Surface;
use super::{Sample, Sheet, Watch, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Heading, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.run-out",
    formula: "\
Run-out along a horizontal axis, of the free grains (of a group), against where they were at the first look.
front           furthest point of the grains that touch anything, on the axis                       [m]
run-out         from the furthest point of all grains at the first look to the front                [m]
mass front      where the share `share` of the mass has its centres behind                          [m]
travel          horizontal way of the centre of mass                                                [m]
fall            its way down                                                                        [m]
travel angle    atan(fall / travel), Heim's angle of the line through both centres of mass          [rad]
deposit height  highest point of the columns above the low end of the region                        [m]
The table is the deposit: the region is cut into columns along the axis, and the surface of each is the highest point of the
grains whose centres are in it and that touch anything; `NaN` where there are none.
Horizontal and down are against gravity, also where that is tilted to make a slope; the axis, the fronts and the deposit are
those of the scene. Positions go on across periodic ends, those of the deposit do not.",
    symbols: "",
    limits: "One grain that rolls on ahead is the front, so see the mass front; two that collide in flight touch. A \
column is taken at its highest grain, up to a radius above the mean surface. Grains that vanish move the \
centre of mass.",
    reference: "Heim 1932 (Bergsturz und Menschenleben), whose fahrboeschung is from the crest of the scar to the toe and \
whose pauschalgefaelle is the travel angle here: with sliding friction alone its tangent is the coefficient \
of friction",
};

/// Follows the front and the centre of mass.
#[derive(Clone, Debug)]
pub(super) struct RunOut {
    heading: Heading,
    share: f64,
    group: Option<u32>,
    surface: Surface,
    /// Lower end of the region [m].
    ground: f64,
    /// Unit vectors: up, and horizontal where the axis points.
    up: DVec3,
    ahead: DVec3,
    /// Furthest point of all grains along the heading, and centre of mass [m], at the first look that saw any.
    first: Option<(f64, DVec3)>,
}

pub(super) fn open(asked: &watch::RunOut, plan: &Plan) -> RunOut {
    let watch::RunOut { direction, share, bins, group, region } = asked;
    let up = -DVec3::from_array(plan.gravity).normalize_or(DVec3::NEG_Z);
    let mut along = DVec3::ZERO;
    along[direction.axis().index()] = direction.sign();
    RunOut {
        heading: *direction,
        share: *share,
        group: group.as_ref().map(|name| group_number(plan, name)),
        surface: Surface::new(direction.axis(), *bins, region, plan),
        ground: region.low[2],
        up,
        ahead: along.reject_from(up).normalize_or(along),
        first: None,
    }
}

impl RunOut {
    /// Where the share of the mass is behind, along the heading; `grains` are (way, mass).
    fn mass_front(&self, mut grains: Vec<(f64, f64)>) -> f64 {
        grains.sort_by(|a, b| a.0.total_cmp(&b.0));
        let goal = self.share * grains.iter().map(|g| g.1).sum::<f64>() * (1.0 - 1e-12);
        let mut behind = 0.0;
        let there = grains.iter().find(|(_, mass)| {
            behind += mass;
            behind >= goal
        });
        there.map_or(f64::NAN, |g| g.0)
    }
}

impl Watch for RunOut {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::TOUCHES
    }

    fn scalars(&self) -> Vec<String> {
        [
            "front [m]",
            "run-out [m]",
            "mass front [m]",
            "travel [m]",
            "fall [m]",
            "travel angle [rad]",
            "deposit height [m]",
        ]
        .map(String::from)
        .to_vec()
    }

    fn sheet(&self) -> Option<Sheet> {
        let coordinates = vec![format!("{} [m]", self.heading.axis().name())];
        Some(Sheet { coordinates, values: vec!["surface height [m]".to_owned()], steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let g = &view.grains;
        let (axis, sign) = (self.heading.axis().index(), self.heading.sign());
        let touches = view.overlapping();
        let ours = |i: usize| view.free(i) && self.group.is_none_or(|group| g.group[i] == group);
        let columns = self.surface.columns(view, |i| ours(i) && touches[i]);
        let (mut front, mut furthest, mut mass, mut moment) = (f64::NAN, f64::NAN, 0.0, DVec3::ZERO);
        let mut grains = Vec::new();
        for i in (0..view.len()).filter(|&i| ours(i)) {
            let place = view.unwrapped(i);
            let way = sign * place[axis];
            let [low, high] = view.ends(i, axis);
            let end = way + if sign > 0.0 { high } else { -low };
            furthest = furthest.max(end);
            if touches[i] {
                front = front.max(end);
            }
            mass += g.mass[i];
            moment += g.mass[i] * place;
            grains.push((way, g.mass[i]));
        }
        let centre = moment / mass;
        if self.first.is_none() && mass > 0.0 {
            self.first = Some((furthest, centre));
        }
        let (begun, start) = self.first.unwrap_or((f64::NAN, DVec3::NAN));
        let (travel, fall) = ((centre - start).dot(self.ahead), (start - centre).dot(self.up));
        let angle = if travel > 0.0 { fall.atan2(travel) } else { f64::NAN };
        let highest = columns.iter().map(|c| c.1).fold(f64::NAN, f64::max);
        let mass_front = sign * self.mass_front(grains);
        Sample {
            scalars: vec![sign * front, front - begun, mass_front, travel, fall, angle, highest - self.ground],
            rows: columns.into_iter().map(|(x, z)| vec![x, z]).collect(),
        }
    }

    fn save(&self, name: &str, state: &mut State) {
        let (front, centre) = self.first.unwrap_or((f64::NAN, DVec3::NAN));
        state.put_real(&format!("{name}.first"), [[front].as_slice(), &centre.to_array()].concat());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let name = format!("{name}.first");
        let &[front, x, y, z] = state.real(&name)? else { return Err(MissingSection { name, kind: "real" }) };
        self.first = (!x.is_nan()).then_some((front, DVec3::new(x, y, z)));
        Ok(())
    }
}
