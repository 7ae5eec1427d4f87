//! What grains carry along a bed, and how many start and stop.

use super::classes::Classes;
use super::{Inside, Sample, Volumes, Watch, axes, group_number};
use crate::about::About;
use crate::view::{View, Wants};
use crate::water::FORMULAS;
use glam::DVec3;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{self, Axis, Flow, Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.bedload",
    formula: "\
Transport of grains along a horizontal axis over the plan area A of a region, by free grains whose centres are in it.
transport rate        q = sum V u / A, V the volume of a grain, u its velocity along the axis      [m^2/s]
mean transport rate   of the looks so far                                                          [m^2/s]
mass rate             the same of masses: sum m u / A; in the plane with `width` only               [kg/(m.s)]
fluctuation           standard deviation of q over the looks so far                                [m^2/s]
moving grains         number of those that move                                                    [-]
moving speed          mean of u over them, by volume                                               [m/s]
started, stopped      grains that began to move, or came to rest, since the last look              [-]
entrainment           started over A and the time since the last look                              [1/(m^2.s)]
deposition            stopped over the same                                                        [1/(m^2.s)]
`transport rate below 1 mm`, ... with `sizes`: q of the grains of that diameter alone                [m^2/s]
Einstein number       q / sqrt((s - 1) g d^3), s the density of the grains over `fluid-density`     [-]
Shields number        as the watch `stream` tells it, where the water is a stream and `fluid-density` is told               [-]
Meyer-Peter and Mueller 1948, Wong and Parker 2006: the Einstein number by their formulas, 8 (Shields number - 0.047)^1.5 and
                      3.97 (Shields number - 0.0495)^1.5                                          [-]
A grain moves from the look on at which it is faster than `moving-speed`, until it is slower than `resting-speed`: a grain
that rocks in its pocket between the two does not start again and again. It counts where it is when that is seen; one that
is new, or comes into the region moving, has not started.
V is that of the shape; of a clump each sphere carries its share, and is counted as a grain.
In the plane A is a length and V the area of the disc or polygon, so q is again per width; with `width` grains are spheres
in a bed of that width, V = pi d^3 / 6 / width, and polygons as thick as they are. Entrainment is per length then. Density
and d of the Einstein number are means over the free groups, or of the one that is asked for, as the scene tells them; of a grain that is
no sphere d is the diameter of the sphere of its volume, of a polygon that of the disc of its area.",
    symbols: "",
    limits: "Q is of volumes without voids; a grain that starts and stops between two looks is not seen; entrainment \
depends on the two speeds, so tell them with it.",
    reference: "q as in Ancey et al. 2008 (J. Fluid Mech. 595, 83); Einstein 1950; Meyer-Peter and Mueller 1948; Wong and Parker 2006",
};

/// Sums up volumes on their way.
#[derive(Clone, Debug)]
pub(super) struct Bedload {
    axis: usize,
    region: Inside,
    /// Plan area of the region [m^2], in the plane its length [m].
    area: f64,
    group: Option<u32>,
    /// In the plane: width of the bed [m], if grains are spheres.
    width: Option<f64>,
    flat: bool,
    volumes: Volumes,
    classes: Classes,
    /// Speeds at which a grain begins and ceases to move [m/s].
    speeds: [f64; 2],
    /// sqrt((s - 1) g d^3), if the Einstein number is asked for [m^2/s].
    scale: Option<f64>,
    /// Whether a stream's stress on the bed is known, for the Shields number; density [kg/m^3] and diameter [m] of its grains.
    sheared: bool,
    grain: (f64, f64),
    gravity: f64,
    /// Whether a grain moves, by its number; nobody knows before it has been seen.
    moves: Vec<Option<bool>>,
    last: f64,
    /// Number, mean, and sum of squares about the mean, of the rates so far (Welford 1962).
    rates: [f64; 3],
}

pub(super) fn open(asked: &watch::Bedload, plan: &Plan) -> Bedload {
    let watch::Bedload { axis, region, group, width, moving_speed, resting_speed, fluid_density, sizes } = asked;
    let (density, diameter) = plan::submerged(plan.particles.iter(), group.as_deref());
    let gravity = DVec3::from_array(plan.gravity).length();
    let flow = plan.water.as_ref().map(|water| &water.flow);
    let flows = matches!(flow, Some(Flow::Coupled { .. } | Flow::LogLaw { .. }));
    let size = |a: usize| region.high[a] - region.low[a];
    Bedload {
        axis: axis.index(),
        region: Inside::new(Some(region), plan),
        area: axes(plan).iter().filter(|&&a| a != Axis::Z.index()).map(|&a| size(a)).product(),
        group: group.as_ref().map(|name| group_number(plan, name)),
        width: *width,
        flat: plan.dimension == 2,
        volumes: Volumes::new(plan, plan.dimension == 2 && width.is_none()),
        classes: Classes::new(sizes.as_ref()),
        speeds: [*moving_speed, *resting_speed],
        sheared: fluid_density.is_some() && flows,
        grain: (density, diameter),
        gravity,
        scale: fluid_density.map(|fluid| ((density / fluid - 1.0) * gravity * diameter.powi(3)).sqrt()),
        moves: Vec::new(),
        last: f64::NAN,
        rates: [0.0; 3],
    }
}

impl Bedload {
    fn volume(&self, view: &View, i: usize) -> f64 {
        self.volumes.of(view, i) / self.width.unwrap_or(1.0)
    }

    /// Whether masses can be told per width.
    fn weighs(&self) -> bool {
        !self.flat || self.width.is_some()
    }

    /// Whether the grain moves now, and whether it did before.
    fn moves(&mut self, id: u32, speed: f64) -> (bool, Option<bool>) {
        let id = id as usize;
        if self.moves.len() <= id {
            self.moves.resize(id + 1, None);
        }
        let before = self.moves[id];
        let now = speed > if before == Some(true) { self.speeds[1] } else { self.speeds[0] };
        self.moves[id] = Some(now);
        (now, before)
    }

    fn remember(&mut self, rate: f64) {
        let [count, mean, squares] = &mut self.rates;
        *count += 1.0;
        let before = rate - *mean;
        *mean += before / *count;
        *squares += before * (rate - *mean);
    }
}

impl Watch for Bedload {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        let per = if self.flat { "1/(m.s)" } else { "1/(m^2.s)" };
        let mut names: Vec<String> = [
            "transport rate [m^2/s]",
            "mean transport rate [m^2/s]",
            "fluctuation [m^2/s]",
            "moving grains [-]",
            "moving speed [m/s]",
            "started [-]",
            "stopped [-]",
        ]
        .map(String::from)
        .to_vec();
        names.extend([format!("entrainment [{per}]"), format!("deposition [{per}]")]);
        names.extend(self.weighs().then(|| "mass rate [kg/(m.s)]".to_owned()));
        names.extend(self.classes.names().map(|class| format!("transport rate {class} [m^2/s]")));
        names.extend(self.scale.map(|_| "Einstein number [-]".to_owned()));
        if self.sheared {
            names.push("Shields number [-]".to_owned());
            names.extend(FORMULAS.map(|formula| format!("{} [-]", formula.source)));
        }
        names
    }

    fn so_far(&self) -> &'static [&'static str] {
        &["mean transport rate", "fluctuation"]
    }

    fn take(&mut self, view: &View) -> Sample {
        let g = &view.grains;
        let (mut flux, mut mass, mut carried, mut carrying) = (0.0, 0.0, 0.0, 0.0);
        let mut of_class = vec![0.0; self.classes.len()];
        let (mut moving, mut started, mut stopped) = (0.0, 0.0, 0.0);
        for i in 0..view.len() {
            if !view.free(i) || self.group.is_some_and(|group| g.group[i] != group) {
                continue;
            }
            let (r, u) = (g.radius[i], g.velocity[i][self.axis]);
            let (now, before) = self.moves(g.id[i], g.velocity[i].length());
            if !self.region.holds(view.position(i)) {
                continue;
            }
            let volume = self.volume(view, i);
            flux += volume * u;
            mass += g.mass[i] * u;
            if let Some(flux) = of_class.get_mut(self.classes.of(2.0 * r)) {
                *flux += volume * u;
            }
            if now {
                moving += 1.0;
                carried += volume * u;
                carrying += volume;
            }
            started += f64::from(u8::from(now && before == Some(false)));
            stopped += f64::from(u8::from(!now && before == Some(true)));
        }
        let rate = flux / self.area;
        self.remember(rate);
        let [count, mean, squares] = self.rates;
        let elapsed = view.time - std::mem::replace(&mut self.last, view.time);
        let per = 1.0 / (self.area * elapsed);
        let mut scalars = vec![rate, mean, (squares / count).sqrt(), moving, carried / carrying, started, stopped];
        scalars.extend([started * per, stopped * per]);
        scalars.extend(self.weighs().then(|| mass / (self.area * self.width.unwrap_or(1.0))));
        scalars.extend(of_class.into_iter().map(|flux| flux / self.area));
        scalars.extend(self.scale.map(|scale| rate / scale));
        if self.sheared {
            let stress =
                view.water.and_then(|water| Some(water.shields(water.bed_stress()?, self.grain, self.gravity)));
            let shields = stress.unwrap_or(f64::NAN);
            scalars.push(shields);
            scalars.extend(FORMULAS.map(|formula| formula.rate(shields)));
        }
        Sample { scalars, rows: Vec::new() }
    }

    fn save(&self, name: &str, state: &mut State) {
        let moves = self.moves.iter().map(|m| m.map_or(-1, i64::from)).collect::<Vec<_>>();
        state.put_integer(&format!("{name}.moves"), moves);
        state.put_real(&format!("{name}.rates"), [&[self.last], self.rates.as_slice()].concat());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let key = format!("{name}.rates");
        let &[last, ref rates @ ..] = state.real(&key)? else {
            return Err(MissingSection { name: key, kind: "real" });
        };
        self.rates = rates.try_into().map_err(|_| MissingSection { name: key, kind: "real" })?;
        self.last = last;
        let known = |m: &i64| (*m >= 0).then_some(*m == 1);
        self.moves = state.integer(&format!("{name}.moves"))?.iter().map(known).collect();
        Ok(())
    }
}
