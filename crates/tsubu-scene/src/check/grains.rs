//! Groups of grains whose keys contradict each other.

use super::{Parts, polyhedron};
use crate::complaint::Complaint;
use crate::grain_file::{How, clump::MOST_PIECES};
use crate::plan::{GrainMotion, GrainShape, NO_GRAIN, Particles, Size, Start, Vector, deep};

/// Longest semi-axis of a superellipsoid over its shortest; the search for contacts has been tried so far.
const MOST_SLENDER: f64 = 10.0;

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (name, group) in &parts.particles {
        let at = |keys: &[&str]| parts.root.locate(&[&["particles", name.as_str()], keys].concat());
        if matches!(group.shape, GrainShape::Disc { .. }) && parts.space() {
            complaints.push(
                Complaint::new(format!("the grains `{name}` are discs, which only the plane has"))
                    .at(&at(&["shape", "disc"]), "the scene has dimension 3")
                    .hint("write shape.sphere = {}, or set dimension = 2"),
            );
        }
        clump(parts, name, group, complaints);
        superellipsoid(parts, name, group, complaints);
        cells(parts, name, group, complaints);
        polyhedron::check(parts, name, group, complaints);
        sizes_and_places(parts, name, group, complaints);
        held(parts, name, group, complaints);
        complaints.extend(density(parts, name, group));
        if let Start::Stream { from, .. } = group.start
            && let Some(duration) = parts.resolved.get("duration").and_then(toml::Value::as_float)
            && from >= duration
        {
            complaints.push(
                Complaint::new(format!("not one grain of `{name}` comes before the end of the run"))
                    .at(&at(&["start", "stream", "from"]), format!("{from} s"))
                    .also(&parts.root.locate(&["duration"]), format!("the run ends at {duration} s")),
            );
        }
    }
}

/// A clump has as many diameters as centres; in the plane its centres are in the plane.
fn clump(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    if group.shape.clump_key().is_some() && !matches!(group.motion, GrainMotion::Free {}) {
        complaints.push(
            Complaint::new(format!("the {} `{name}` must be free to move", group.shape.plural()))
                .at(&parts.root.locate(&["particles", name, "motion"]), "spheres and discs may be held or driven")
                .hint("build a rough floor or a moving part of spheres, or as a wall"),
        );
    }
    let GrainShape::Clump { centre, diameter, .. } = &group.shape else { return };
    let at = |key: &str| parts.root.locate(&["particles", name, "shape", "clump", key]);
    if centre.is_empty() {
        complaints
            .push(Complaint::new(format!("the clump `{name}` has no spheres")).at(&at("centre"), "needs one or more"));
    } else if centre.len() != diameter.len() {
        complaints.push(
            Complaint::new(format!("the clump `{name}` has another number of diameters than of centres"))
                .at(&at("diameter"), format!("{} diameters, {} centres", diameter.len(), centre.len())),
        );
    }
    if centre.len() > MOST_PIECES {
        complaints.push(
            Complaint::new(format!("the clump `{name}` has {} spheres", centre.len()))
                .at(&at("centre"), format!("at most {MOST_PIECES}")),
        );
    }
}

/// A superellipsoid has a thickness along each of its axes.
fn superellipsoid(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let GrainShape::Superellipsoid { semi_axes, exponents, .. } = &group.shape else { return };
    let at = |keys: &[&str]| parts.root.locate(&[&["particles", name, "shape", "superellipsoid"], keys].concat());
    let axes = deep(*semi_axes);
    // In space a depth of 0 is no word for another.
    if let Some(axis) = if parts.space() { semi_axes } else { &axes }.iter().find(|axis| **axis <= 0.0) {
        complaints.push(
            Complaint::new(format!("the superellipsoid `{name}` has no thickness"))
                .at(&at(&["semi-axes"]), format!("{axis} is not above 0")),
        );
    }
    if exponents.len() != 2 {
        complaints.push(
            Complaint::new(format!("the superellipsoid `{name}` has {} exponents", exponents.len()))
                .at(&at(&["exponents"]), "needs two: of the profile and of the equator"),
        );
    }
    let [short, long] = [f64::min, f64::max].map(|pick| axes.iter().copied().fold(axes[0], pick));
    if short > 0.0 && long > MOST_SLENDER * short {
        complaints.push(
            Complaint::new(format!("the superellipsoid `{name}` is {:.1} times as long as it is thick", long / short))
                .at(&at(&["semi-axes"]), format!("at most {MOST_SLENDER}"))
                .hint("for longer bodies write shape.clump"),
        );
    }
}

/// Cells are in the plane, hang together, and have one size.
fn cells(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let GrainShape::Cells { outline, .. } = &group.shape else { return };
    let at = |keys: &[&str]| parts.root.locate(&[&["particles", name], keys].concat());
    if outline.cells().is_none() {
        let path: Vec<&str> = ["shape", "cells", "outline"].into_iter().chain(outline.key().split('.')).collect();
        complaints.push(Complaint::new(format!("the cells of `{name}` are no grain")).at(&at(&path), NO_GRAIN));
    } else if parts.space() && !group.shape.is_polyhedron() {
        complaints.push(
            Complaint::new(format!("the grains `{name}` are made of cells, which only the plane has"))
                .at(&at(&["shape", "cells"]), "the scene has dimension 3")
                .hint("set dimension = 2"),
        );
    }
    let in_file = matches!(&group.start, Start::File { grains, .. } if !grains.diameter.is_empty());
    if group.size != (Size::Equal {}) || in_file {
        let (path, what) = if in_file { ("start", "the file has diameters") } else { ("size", "drawn here") };
        complaints.push(
            Complaint::new(format!("the grains `{name}` are made of cells, whose spacing is their size"))
                .at(&at(&[path]), what)
                .hint("make a group for each size, with other cells"),
        );
    }
}

/// Who gives places gives sizes with them: drawn at random they would overlap.
fn sizes_and_places(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let (start, way) = match &group.start {
        Start::At { .. } => ("start.at", "make a group for each diameter, or put places and diameters into a file"),
        Start::File { grains, .. } if grains.diameter.is_empty() => {
            ("start.file", "put a column `diameter` or `radius` into the file")
        }
        Start::File { .. } => ("start.file", "leave `size` out: the file has diameters"),
        _ => return,
    };
    if group.size != (Size::Equal {}) {
        complaints.push(
            Complaint::new(format!("the grains `{name}` have given places, so their sizes cannot be drawn"))
                .at(&parts.root.locate(&["particles", name, "size"]), format!("not together with `{start}`"))
                .hint(way),
        );
    }
}

/// Two ways to the same density may differ in the digits that a file has.
const SAME_DENSITY: f64 = 1e-3;

/// A file that tells densities must agree with the scene, which gives the masses: either could be meant.
fn density(parts: &Parts<'_>, name: &str, group: &Particles) -> Option<Complaint> {
    let (Start::File { path, kind, .. }, GrainMotion::Free {}) = (&group.start, &group.motion) else { return None };
    let file = parts.files.known_grains(path, How { space: parts.space(), kind: *kind })?;
    let own = group.mass / group.shape.mass(1.0, group.diameter);
    let differs = |told: &f64| (told - own).abs() > SAME_DENSITY * own;
    let densities = file.told_densities(group.diameter, |diameter| group.shape.mass(1.0, diameter));
    let index = densities.iter().position(differs)?;
    let (told, line) = (densities[index], file.lines.get(index)?);
    let complaint = Complaint::new(format!("`{path}` has other densities than the grains `{name}`"))
        .at(
            &parts.root.locate(&["particles", name, "start", "file", "path"]),
            format!("line {line}: {} kg/m^3, but the grains have {}", short(told), short(own)),
        )
        .hint(format!("give [materials.{}] the density of the file, or correct the file", group.material));
    let many = densities.iter().any(|other| (other - told).abs() > SAME_DENSITY * told);
    Some(if many && kind.is_none() {
        complaint.hint("of grains of several densities make several groups; `start.file.kind` chooses an atom type")
    } else {
        complaint
    })
}

/// Six digits.
fn short(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// Grains that no force moves: what a start says about moving them would be ignored.
fn held(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let (word, motion) = match group.motion {
        GrainMotion::Free {} => return,
        GrainMotion::Frozen {} => ("frozen", "frozen"),
        GrainMotion::Driven { .. } => ("driven", "driven"),
    };
    let moves = |vector: &Vector| vector.iter().any(|x| *x != 0.0);
    let (path, what): (&[&str], &str) = match &group.start {
        Start::Settled { .. } => (&["start", "settled"], "cannot fall and settle"),
        Start::Stream { .. } => (&["start", "stream"], "cannot come in a stream"),
        Start::Rows { speed, .. } if *speed != 0.0 => (&["start", "rows", "speed"], "have no speed of their own"),
        Start::Random { speed, .. } if *speed != 0.0 => (&["start", "random", "speed"], "have no speed of their own"),
        Start::Random { velocity, .. } if moves(velocity) => {
            (&["start", "random", "velocity"], "have no velocity of their own")
        }
        Start::At { velocity, .. } if velocity.iter().any(moves) => {
            (&["start", "at", "velocity"], "have no velocity of their own")
        }
        Start::At { spin, .. } if spin.iter().any(moves) => (&["start", "at", "spin"], "do not spin"),
        _ => return,
    };
    let place = parts.root.locate(&[&["particles", name], path].concat());
    complaints.push(
        Complaint::new(format!("the grains `{name}` are {word}: they {what}"))
            .at(&place, "nothing would come of it")
            .also(&parts.root.locate(&["particles", name, "motion", motion]), format!("{word} here"))
            .hint("start them with `rows`, `random`, `at` or `file`, at rest"),
    );
}
