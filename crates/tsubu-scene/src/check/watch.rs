//! Watches that could not see anything, or not what they say.

use super::fill::has_size;
use super::place::Room;
use super::{Parts, named};
use crate::complaint::{Complaint, Place};
use crate::key::{Kind, Word};
use crate::plan::watch::{Bedload, CoarseGrain, Discharge, Hops, Mixing, Resonance, Spectrum, Track, WallLoad};
use crate::plan::{self, Bed, Face, GrainMotion, Measure, Particles, Region, Watch};
use crate::suggest;

/// More points than this are a slip, not a field.
const MOST_POINTS: usize = 1_000_000;

pub(super) fn check(parts: &Parts<'_>, rooms: &[Room<'_>], complaints: &mut Vec<Complaint>) {
    names_and_kinds(parts, complaints);
    for (name, watch) in named::<Watch>(parts.resolved, "watch") {
        times(parts, &name, &watch, complaints);
        places_and_axes(parts, rooms, [&name, watch.measure.name()], complaints);
        measure(parts, &name, &watch.measure, complaints);
    }
}

fn names_and_kinds(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    let Some(typed) = parts.root.find(&["watch"]).and_then(crate::node::Node::table) else { return };
    for entry in &typed.entries {
        // A watch gives its name to a file.
        if !entry.key.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_') || entry.key.is_empty() {
            complaints.push(
                Complaint::new(format!("`{}` cannot be the name of a watch", entry.key))
                    .at(&entry.place, "names the file of the watch")
                    .hint("use letters, digits, `-` and `_`"),
            );
        }
        if let Some(watch) = entry.node.table()
            // A misspelt one has its own complaint.
            && watch.keys().all(|key| ["from", "until", "every"].contains(&key))
        {
            complaints.push(
                Complaint::new(format!("the watch `{}` measures nothing", entry.key))
                    .at(&entry.place, "needs one of its tables")
                    .hint(format!("choices: {}", suggest::list(Measure::NAMES.iter().copied()))),
            );
        }
    }
}

fn times(parts: &Parts<'_>, name: &str, watch: &Watch, complaints: &mut Vec<Complaint>) {
    let at = |key: &str| parts.root.locate(&["watch", name, key]);
    if let Some(until) = watch.until.filter(|until| *until < watch.from) {
        complaints.push(
            Complaint::new(format!("the watch `{name}` ends before it begins"))
                .at(&at("until"), format!("{until} s"))
                .also(&at("from"), format!("begins at {} s", watch.from)),
        );
    }
}

/// What can be wrong with a `region` and with words for axes, whatever the kind.
fn places_and_axes(parts: &Parts<'_>, rooms: &[Room<'_>], [name, kind]: [&str; 2], complaints: &mut Vec<Complaint>) {
    let Some(values) = ["watch", name, kind].iter().try_fold(parts.resolved, |table, key| table.get(*key)?.as_table())
    else {
        return;
    };
    if let Some(region) = values.get("region").and_then(|region| region.clone().try_into::<Region>().ok()) {
        where_it_looks(parts, rooms, [name, kind], &region, complaints);
    }
    let table = Measure::KEYS.iter().find(|key| key.name == kind);
    let Some(Kind::Table(keys)) = table.map(|key| key.kind) else { return };
    let along_y = |words: &[Word], value: &toml::Value| {
        words.iter().any(|word| word.name == "y") && value.as_str().is_some_and(|axis| ["y", "-y"].contains(&axis))
    };
    for key in keys {
        let Some(value) = values.get(key.name) else { continue };
        let wrong = match key.kind {
            Kind::OneOf(words) => along_y(words, value),
            Kind::SomeOf(words) => value.as_array().is_some_and(|some| some.iter().any(|value| along_y(words, value))),
            _ => false,
        };
        if wrong && !parts.space() {
            complaints.push(
                Complaint::new("the plane has no y to look along")
                    .at(&parts.root.locate(&["watch", name, kind, key.name]), "the scene has dimension 2")
                    .hint("write \"x\" or \"z\", or set dimension = 3"),
            );
        }
    }
}

fn where_it_looks(
    parts: &Parts<'_>,
    rooms: &[Room<'_>],
    [name, kind]: [&str; 2],
    region: &Region,
    complaints: &mut Vec<Complaint>,
) {
    let path = ["watch", name, kind, "region"];
    if !has_size(parts, region, &path, complaints) {
        return;
    }
    let place = parts.root.locate(&path);
    let axes: &[usize] = if parts.space() { &[0, 1, 2] } else { &[0, 2] };
    let ends = [parts.periodic.x, parts.periodic.y, parts.periodic.z];
    for &axis in axes {
        let letter = ["x", "y", "z"][axis];
        if ends[axis].is_some_and(|[low, high]| region.low[axis] < low || region.high[axis] > high) {
            complaints.push(
                Complaint::new(format!(
                    "the region of the watch `{name}` reaches beyond the periodic world along {letter}"
                ))
                .at(&place, format!("must lie within the ends of periodic.{letter}")),
            );
            return;
        }
    }
    // A box that moves, or a second one, may hold grains elsewhere.
    let [room] = rooms else { return };
    let wall = &parts.walls[room.name];
    let moved = wall.host.is_some() || wall.motion.is_some() || wall.servo.is_some() || wall.body.is_some();
    let apart = axes.iter().any(|&axis| {
        let [low, high] = room.ends(axis);
        region.low[axis] >= high || region.high[axis] <= low
    });
    if apart && !moved {
        complaints.push(
            Complaint::new(format!("the region of the watch `{name}` lies outside the box `{}`", room.name))
                .at(&place, "no grain will be here")
                .also(&parts.root.locate(&["walls", room.name, "shape", "box"]), "the box"),
        );
    }
}

/// Whether a wall turns, by itself or with the host that carries it.
fn turns(parts: &Parts<'_>, wall: &plan::Wall) -> bool {
    let host = wall.host.as_ref().and_then(|host| parts.hosts.get(host));
    let tilts = host.is_some_and(|host| match wall.interface.as_ref().map(|name| host.interface.get(name)) {
        Some(point) => point.is_some_and(|point| point.rotation.iter().any(|turn| *turn != [0.0; 3])),
        None => host.turns(),
    });
    tilts || wall.rotation.is_some() || wall.body.is_some()
}

fn measure(parts: &Parts<'_>, name: &str, measure: &Measure, complaints: &mut Vec<Complaint>) {
    let kind = measure.name();
    let at = |key: &str| parts.root.locate(&["watch", name, kind, key]);
    match measure {
        Measure::Bedload(asked) => bedload(parts, name, asked, complaints),
        Measure::Stream(_) => {
            let flow = parts.resolved.get("water").and_then(|water| water.get("flow"));
            if flow.is_none_or(|flow| ["coupled", "log-law", "column"].iter().all(|kind| flow.get(kind).is_none())) {
                complaints.push(Complaint::new(format!("the watch `{name}` has no stream to look at")).at(
                    &parts.root.locate(&["watch", name, kind]),
                    "needs water.flow.coupled, water.flow.log-law or water.flow.column",
                ));
            }
        }
        Measure::CoarseGrain(CoarseGrain { axes, points, .. }) => {
            let all = points.iter().try_fold(1usize, |product, n| product.checked_mul(*n));
            if axes.len() != points.len() {
                complaints.push(
                    Complaint::new("`points` needs one number for each of `axes`")
                        .at(&at("points"), format!("{} for {} axes", points.len(), axes.len())),
                );
            } else if all.is_none_or(|all| all > MOST_POINTS) {
                complaints.push(
                    Complaint::new(format!("the field `{name}` has too many points"))
                        .at(&at("points"), format!("more than {MOST_POINTS} in all")),
                );
            }
        }
        Measure::Orientation(_) if parts.particles.values().all(|group| !group.shape.is_clump()) => complaints.push(
            Complaint::new(format!("the watch `{name}` has no body to look at"))
                .at(&parts.root.locate(&["watch", name, kind]), "spheres have no axis")
                .hint("write shape.clump, shape.superellipsoid, shape.polyhedron or shape.polygon for some particles"),
        ),
        Measure::Discharge(Discharge { sizes, .. }) => complaints.extend(classes(sizes.as_deref(), &at("sizes"))),
        Measure::Mixing(Mixing { groups: Some(groups), .. }) if groups.len() < 2 => complaints.push(
            Complaint::new("mixing is of two groups or more")
                .at(&at("groups"), format!("{} in this list", groups.len()))
                .hint("leave `groups` out to have all of them"),
        ),
        // A list that is wrong has its own complaint.
        Measure::Mixing(Mixing { groups: None, .. })
            if parts.particles.len() < 2 && parts.root.find(&["watch", name, kind, "groups"]).is_none() =>
        {
            complaints.push(
                Complaint::new(format!("the watch `{name}` has nothing to mix"))
                    .at(&parts.root.locate(&["watch", name, kind]), "needs two groups of particles or more"),
            );
        }
        Measure::Hops(asked) => hops(parts, name, asked, complaints),
        Measure::WallLoad(WallLoad { area: None, direction: Some(_), .. }) => complaints.push(
            Complaint::new("a `direction` is of no use without an `area`")
                .at(&at("direction"), "says how the pressure acts")
                .hint("give an `area`, or leave `direction` out: forces are given along all axes"),
        ),
        Measure::WallLoad(WallLoad { wall, face: Some(face), .. }) => {
            let known = parts.walls.get(wall);
            if known.is_some_and(|wall| !matches!(wall.shape, plan::Shape::Box { .. }) || turns(parts, wall)) {
                complaints.push(
                    Complaint::new(format!("the wall `{wall}` has no `face` of its own"))
                        .at(&at("face"), "asks for one face of a box that does not turn")
                        .hint("leave `face` out; a plane is one face, and a box of planes has a load for each"),
                );
            }
            if matches!(face, Face::Front | Face::Back) && !parts.space() {
                complaints.push(
                    Complaint::new("in the plane a box has no front and no back")
                        .at(&at("face"), "the scene has dimension 2"),
                );
            }
        }
        Measure::StressPath(_) if !parts.incomplete && plan::box_of_planes(&parts.walls, parts.space()).is_none() => {
            complaints.push(
                Complaint::new(format!("the watch `{name}` has no box of planes to look at"))
                    .at(&parts.root.locate(&["watch", name, kind]), "needs two planes that face each other along every axis")
                    .hint("walls with shape.plane, whose normals are \"x\", \"-x\", \"z\", \"-z\", and in space \"y\", \"-y\""),
            );
        }
        Measure::Track(Track { ids, group }) => {
            let counted = parts.particles.iter().filter(|(name, _)| group.as_ref().is_none_or(|only| only == *name));
            let grains: usize = counted.map(|(_, group)| group.numbered()).sum();
            let whose = group.as_ref().map_or_else(|| "the scene".to_owned(), |name| format!("the group `{name}`"));
            let beyond = ids.iter().find(|id| **id as usize >= grains);
            if let Some(id) = beyond.filter(|_| !parts.incomplete && !counts_vary(parts)) {
                complaints.push(
                    Complaint::new(format!("there is no grain {id} to track"))
                        .at(&at("ids"), format!("{whose} has {grains}, counted from 0")),
                );
            }
            if let Some(k) = (1..ids.len()).find(|&k| ids[..k].contains(&ids[k])) {
                complaints.push(
                    Complaint::new(format!("the grain {} is tracked twice", ids[k])).at(&at("ids"), "given again"),
                );
            }
        }
        Measure::Resonance(Resonance { host }) => resonance(parts, name, host, complaints),
        Measure::Spectrum(asked) => spectrum(parts, name, asked, complaints),
        _ => {}
    }
}

/// Only a dwell comes to a resonance.
fn resonance(parts: &Parts<'_>, name: &str, host: &str, complaints: &mut Vec<Complaint>) {
    if parts.hosts.get(host).is_some_and(|host| host.dwell.is_none()) {
        complaints.push(
            Complaint::new(format!("the host `{host}` has no `dwell` to look at"))
                .at(&parts.root.locate(&["watch", name, "resonance"]), "what does its frequency follow?")
                .hint(format!("hosts.{host}.dwell = {{}} lets the frequency of its sine follow the resonance")),
        );
    }
}

/// Most frequencies of a spectrum: each is summed up at every look.
const MOST_FREQUENCIES: f64 = 4000.0;

/// Frequencies that a segment and the looks can tell apart.
fn spectrum(parts: &Parts<'_>, name: &str, asked: &Spectrum, complaints: &mut Vec<Complaint>) {
    let Spectrum { host: _, frequency: [low, high], segment } = asked;
    let at = |key: &str| parts.root.locate(&["watch", name, "spectrum", key]);
    let every = parts.resolved.get("watch").and_then(|watch| watch.get(name)?.get("every")?.as_float());
    if low * segment < 2.0 - 1e-9 {
        complaints.push(
            Complaint::new(format!("segments of {segment} s are too short for {low} Hz"))
                .at(&at("segment"), "must be two periods of the lowest frequency or longer")
                .hint(format!("segment = \"{} s\" tells frequencies from {} Hz on", 4.0 / low, 0.5 * low)),
        );
    } else if (high - low) * segment > MOST_FREQUENCIES {
        complaints.push(
            Complaint::new(format!("the spectrum `{name}` has too many frequencies"))
                .at(&at("segment"), format!("more than {MOST_FREQUENCIES}, {} Hz apart", 1.0 / segment))
                .hint("shorten `segment`, or narrow `frequency`"),
        );
    }
    if let Some(every) = every.filter(|every| every * high > 0.4) {
        complaints.push(
            Complaint::new(format!("looks every {every} s are too few for {high} Hz"))
                .at(
                    &parts.root.locate(&["watch", name, "every"]),
                    "what is faster than half of their rate is folded over",
                )
                .hint("leave `every` out to look at every step, or look five times a period of the highest frequency"),
        );
    }
}

/// Diameters that part classes must rise.
fn classes(sizes: Option<&[f64]>, place: &Place) -> Option<Complaint> {
    let sizes = sizes.filter(|sizes| sizes.is_empty() || sizes.windows(2).any(|pair| pair[0] >= pair[1]))?;
    let wrong = Complaint::new("`sizes` needs diameters that rise").at(place, format!("{sizes:?} m"));
    Some(wrong.hint("sizes = [\"1 mm\", \"2 mm\"] parts grains below 1 mm, up to 2 mm, and from there on"))
}

/// Speeds in their order, and a fluid that grains sink in.
fn bedload(parts: &Parts<'_>, name: &str, asked: &Bedload, complaints: &mut Vec<Complaint>) {
    let Bedload { group, width, moving_speed, resting_speed, fluid_density, sizes, .. } = asked;
    let at = |key: &str| parts.root.locate(&["watch", name, "bedload", key]);
    complaints.extend(classes(sizes.as_deref(), &at("sizes")));
    if resting_speed > moving_speed {
        complaints.push(
            Complaint::new(format!("grains of the watch `{name}` would come to rest faster than they begin to move"))
                .at(&at("resting-speed"), format!("above `moving-speed` = {moving_speed} m/s"))
                .hint("the lower the `resting-speed`, the longer a grain that slows down counts as moving"),
        );
    }
    if width.is_some() && parts.space() {
        complaints.push(
            Complaint::new("a `width` of the bed is of no use in space")
                .at(&at("width"), "the scene has dimension 3")
                .hint("leave it out: grains are spheres, and the region has a width"),
        );
    }
    let Some(fluid) = fluid_density else { return };
    let no_gravity = |g: &toml::Value| g.as_array().is_some_and(|g| g.iter().all(|g| g.as_float() == Some(0.0)));
    if parts.resolved.get("gravity").is_some_and(no_gravity) {
        complaints.push(
            Complaint::new("without gravity there is no Einstein number")
                .at(&at("fluid-density"), "asks for it")
                .hint("leave `fluid-density` out"),
        );
    }
    let (density, _) = plan::submerged(parts.particles.iter(), group.as_deref());
    if !parts.incomplete && density <= *fluid {
        complaints.push(
            Complaint::new(format!("the grains of the watch `{name}` are lighter than the fluid"))
                .at(&at("fluid-density"), format!("the grains have {density:.0} kg/m^3"))
                .hint("the Einstein number is of grains that sink"),
        );
    }
}

/// Hops need a bed, and a way along it.
fn hops(parts: &Parts<'_>, name: &str, asked: &Hops, complaints: &mut Vec<Complaint>) {
    let Hops { bed, along, up, .. } = asked;
    let at = |key: &str| parts.root.locate(&["watch", name, "hops", key]);
    let cosine: f64 = along.iter().zip(up).map(|(a, b)| a * b).sum();
    if cosine.abs() > 1e-3 {
        let key = if parts.root.find(&["watch", name, "hops", "along"]).is_some() { "along" } else { "up" };
        complaints.push(
            Complaint::new(format!("`along` and `up` of the watch `{name}` are not at right angles"))
                .at(&at(key), format!("{:.1} degrees apart", cosine.clamp(-1.0, 1.0).acos().to_degrees()))
                .hint("`along` is \"x\" and `up` is \"z\" where they are not given"),
        );
    }
    let fixed = |group: &Particles| !matches!(group.motion, GrainMotion::Free {});
    let there = |kind: &Bed| match kind {
        Bed::Walls => !parts.walls.is_empty(),
        Bed::FixedGrains => parts.particles.values().any(fixed),
        Bed::FreeGrains => true,
    };
    if !parts.incomplete && !bed.iter().any(there) {
        complaints.push(
            Complaint::new(format!("the watch `{name}` has no bed that grains could hop on"))
                .at(&at("bed"), "there is none of this in the scene")
                .hint("walls, grains with `motion.frozen = {}`, or `bed = [\"free-grains\"]`"),
        );
    }
}

/// Whether a study changes groups: a grain may be there in some of its cases only.
fn counts_vary(parts: &Parts<'_>) -> bool {
    let varied =
        |study: &str| parts.resolved.get(study).and_then(|study| study.get("vary")).and_then(toml::Value::as_table);
    crate::study::STUDIES
        .into_iter()
        .filter_map(varied)
        .flat_map(toml::Table::keys)
        .any(|key| key.starts_with("particles."))
}
