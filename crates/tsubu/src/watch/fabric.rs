//! The fabric of the contacts.

use super::axial::{dyad, principal};
use super::{Axes, Inside, LETTERS, Sample, Watch, axes};
use crate::about::About;
use crate::view::{View, Wants};
use nalgebra::{Matrix3, SymmetricEigen};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.fabric",
    formula: "\
Fabric tensor F = sum n n / N over the N contacts, n their unit normals; its trace is 1.
fabric xx, xz, ...     entries on and above the diagonal                                            [-]
deviator               sqrt(((F1 - F2)^2 + (F2 - F3)^2 + (F3 - F1)^2) / 2), in the plane F1 - F2    [-]
principal direction    unit vector of the largest principal value, its last entry not negative      [-]
Contacts with walls count if asked for: their normals show the wall, not the grains. In a region, a contact counts if its point is inside.",
    symbols: "",
    limits: "Where two principal values are equal the direction is any.",
    reference: "Satake 1982; Oda 1982",
};

/// Sums up normals.
#[derive(Clone, Debug)]
pub(super) struct Fabric {
    walls: bool,
    region: Inside,
    axes: Axes,
}

pub(super) fn open(asked: &watch::Fabric, plan: &Plan) -> Fabric {
    let watch::Fabric { walls, region } = asked;
    Fabric { walls: *walls, region: Inside::new(region.as_ref(), plan), axes: axes(plan) }
}

impl Fabric {
    /// The entries on and above the diagonal.
    fn entries(&self) -> impl Iterator<Item = (usize, usize)> {
        let axes = self.axes;
        axes.iter().enumerate().flat_map(move |(k, &a)| axes[k..].iter().map(move |&b| (a, b)))
    }
}

impl Watch for Fabric {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.entries().map(|(a, b)| format!("fabric {}{} [-]", LETTERS[a], LETTERS[b])).collect();
        names.push("deviator [-]".to_owned());
        names.extend(self.axes.iter().map(|&a| format!("principal direction {} [-]", LETTERS[a])));
        names
    }

    fn axis(&self) -> Option<&'static str> {
        Some("principal direction")
    }

    fn take(&mut self, view: &View) -> Sample {
        let counted =
            view.contacts.iter().filter(|c| (self.walls || !c.wall) && self.region.holds(view.put(c.position)));
        let (mut sum, mut number) = (Matrix3::zeros(), 0.0);
        for c in counted {
            sum += dyad(c.normal);
            number += 1.0;
        }
        if number == 0.0 {
            return Sample { scalars: vec![f64::NAN; self.scalars().len()], rows: Vec::new() };
        }
        let fabric = sum / number;
        let values = SymmetricEigen::new(fabric).eigenvalues;
        // The plane has no third value: what nalgebra finds for y is zero.
        let deviator = if self.axes.len() == 2 {
            (fabric[(0, 0)] - fabric[(2, 2)]).hypot(2.0 * fabric[(0, 2)])
        } else {
            let apart = |a: usize, b: usize| (values[a] - values[b]).powi(2);
            (0.5 * (apart(0, 1) + apart(1, 2) + apart(2, 0))).sqrt()
        };
        let mut scalars: Vec<f64> = self.entries().map(|(a, b)| fabric[(a, b)]).collect();
        scalars.push(deviator);
        let (_, direction) = principal(fabric);
        scalars.extend(self.axes.iter().map(|&a| direction[a]));
        Sample { scalars, rows: Vec::new() }
    }
}
