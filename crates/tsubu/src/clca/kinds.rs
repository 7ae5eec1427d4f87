//! Which lattice points grains have, and how far apart those are.

use super::bed::GrainKind;
use super::place::Grain;
use crate::lattice::direction::Vector;
use crate::lattice::remarks::Remarks;
use crate::lattice::shape::Shape;
use crate::lattice::stage;
use crate::random::{Purpose, words};
use crate::sizes;
use tsubu_scene::plan::{self, ClumpOrientation, GrainMotion, GrainShape, Plan, Start};

/// The largest hexagon that stands for a disc.
const LARGEST_RADIUS: usize = 12;

/// How far the points of a grain may lie from its reference point, in columns and rows: less than the lattice's rim.
const REACH: i64 = stage::RIM as i64 - 2;

/// Two spacings that differ by less are one.
const SAME: f64 = 1e-6;

/// The shapes that the scene draws, by group.
pub(super) fn shapes(plan: &Plan, remarks: &mut Remarks) -> Vec<Option<Shape>> {
    for name in plan.cl_ca.shapes.keys().filter(|name| !plan.particles.contains_key(*name)) {
        remarks.refuse(format!("cl-ca.shapes.{name}"), "there is no group of grains of that name");
    }
    let drawn = |(name, group): (&String, &plan::Particles), remarks: &mut Remarks| {
        let (outline, key) = match (&group.shape, plan.cl_ca.shapes.get(name)) {
            (GrainShape::Cells { outline, .. }, None) => {
                (outline, format!("particles.{name}.shape.cells.outline.{}", outline.key()))
            }
            (GrainShape::Cells { .. }, Some(_)) => {
                let text = "`shape.cells` says which lattice points these grains have; leave this out";
                remarks.refuse(format!("cl-ca.shapes.{name}"), text);
                return None;
            }
            (_, outline) => {
                let outline = outline?;
                (outline, format!("cl-ca.shapes.{name}.{}", outline.key()))
            }
        };
        let shape = outline.cells().map(Shape::of);
        let fits = |p: &Vector| p.h.abs() <= REACH && p.k.abs() <= 2 * REACH;
        match &shape {
            None => remarks.refuse(key, plan::NO_GRAIN),
            Some(shape) if !shape.points().iter().all(fits) => {
                remarks.refuse(key, format!("it reaches more than {REACH} spacings from its middle"));
            }
            Some(_) => {}
        }
        shape
    };
    plan.particles.iter().map(|group| drawn(group, remarks)).collect()
}

/// The spacing: as told, that of grains of cells, or the one at which the smallest grains have their own shape's size, or that of a hexagon
/// of radius 1 [m].
pub(super) fn spacing(plan: &Plan, shapes: &[Option<Shape>], remarks: &mut Remarks) -> f64 {
    let mut found = plan.cl_ca.spacing;
    for (name, group) in &plan.particles {
        let GrainShape::Cells { spacing: own, .. } = group.shape else { continue };
        let other = *found.get_or_insert(own);
        if (own - other).abs() > SAME * other {
            let text = format!(
                "the lattice has points {other:.4e} m apart, and these cells are {own:.4e} m apart; one lattice has one spacing"
            );
            remarks.refuse(format!("particles.{name}.shape.cells.spacing"), text);
        }
    }
    let one = Shape::hexagon(1).diameter();
    let of = |(group, shape): (&plan::Particles, &Option<Shape>)| {
        group.smallest_diameter() / shape.as_ref().map_or(one, Shape::diameter)
    };
    let smallest = || plan.particles.values().zip(shapes).map(of).fold(f64::INFINITY, f64::min);
    found.unwrap_or_else(|| Some(smallest()).filter(|smallest| smallest.is_finite()).unwrap_or(1e-3))
}

/// Kinds of grains, and the grains of every group with their kinds.
pub(super) fn kinds(
    plan: &Plan,
    shapes: &[Option<Shape>],
    spacing: f64,
    remarks: &mut Remarks,
) -> (Vec<GrainKind>, Vec<Vec<Grain>>) {
    let hexagons: Vec<f64> = (0..=LARGEST_RADIUS).map(|radius| Shape::hexagon(radius).diameter() * spacing).collect();
    let mut kinds: Vec<GrainKind> = Vec::new();
    let mut all = Vec::new();
    let mut id = 0;
    for (number, ((name, group), drawn)) in plan.particles.iter().zip(shapes).enumerate() {
        let (cells, random) = match group.shape {
            GrainShape::Cells { orientation, .. } => (true, orientation == ClumpOrientation::Random),
            _ => (false, false),
        };
        let free = matches!(group.motion, GrainMotion::Free {});
        let mut own = Vec::new();
        let mut off = 0.0_f64;
        for place in 0..group.count {
            let diameter = match &group.start {
                Start::File { grains, .. } => grains.diameter.get(place).copied(),
                _ => None,
            };
            let diameter = diameter.unwrap_or_else(|| sizes::diameter(group, plan.seed, id));
            let near = |radius: &usize| (hexagons[*radius] / diameter).ln().abs();
            let radius = (0..=LARGEST_RADIUS).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
            let shape = drawn.clone().unwrap_or_else(|| Shape::hexagon(radius));
            if !cells {
                off = off.max((shape.diameter() * spacing / diameter - 1.0).abs());
            }
            let turns = if random { words(plan.seed, Purpose::Orientation, id, 0)[0] % 6 } else { 0 };
            let shape = (0..turns).fold(shape, |shape, _| shape.turned());
            let kind = kinds.iter().position(|kind| kind.group == number as u32 && kind.shape == shape);
            let kind = kind.unwrap_or_else(|| {
                let mass = sizes::mass(group, if drawn.is_some() { diameter } else { shape.diameter() * spacing });
                // Grains that are all equal keep the mass they were given.
                let mass = if matches!(group.size, plan::Size::Equal {}) { group.mass } else { mass };
                kinds.push(GrainKind { group: number as u32, shape, stencil: 0, orientations: 1, mass, free });
                kinds.len() - 1
            });
            own.push(Grain { id, kind });
            id += 1;
        }
        if off > 0.5 {
            remarks.refuse(
                format!("particles.{name}.diameter"),
                format!(
                    "its lattice grains would be {:.0} % off in size; change `cl-ca.spacing` ({spacing:.3e} m now), or draw `cl-ca.shapes.{name}`",
                    100.0 * off
                ),
            );
        } else if off > 1e-3 {
            let text = format!("taken to the nearest shape of lattice points, at most {:.1} % off", 100.0 * off);
            remarks.approximate(format!("particles.{name}.diameter"), text);
        }
        all.push(own);
    }
    (kinds, all)
}
