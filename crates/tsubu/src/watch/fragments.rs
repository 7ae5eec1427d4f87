//! Pieces that bonds hold together.

use super::{Sample, Watch};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.fragments",
    formula: "\
A fragment is a grain with all that bonds hold it together with, straight or by way of others; the spheres of a clump are one grain.
bonds      number of bonds that hold                                      [-]
broken     number of bonds that have broken so far                        [-]
fragments  number of fragments, single grains counted                     [-]
largest    share of the mass of all grains that the heaviest fragment has [-]",
    symbols: "",
    limits: "Grains that only touch are not together.",
    reference: "Potyondy and Cundall 2004",
};

/// Counts fragments.
#[derive(Clone, Debug)]
pub(super) struct Fragments;

pub(super) fn open(asked: &watch::Fragments, _: &Plan) -> Fragments {
    let watch::Fragments {} = asked;
    Fragments
}

impl Watch for Fragments {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants { bodies: true, ..Wants::GRAINS }
    }

    fn scalars(&self) -> Vec<String> {
        ["bonds [-]", "broken [-]", "fragments [-]", "largest [-]"].map(String::from).to_vec()
    }

    fn so_far(&self) -> &'static [&'static str] {
        &["broken"]
    }

    fn take(&mut self, view: &View) -> Sample {
        let pieces =
            view.body_of.iter().enumerate().filter_map(|(i, body)| Some((i, view.bodies[(*body)? as usize].grain)));
        let held = view.bonds.iter().map(|bond| bond.map(|row| row as usize));
        let mass = masses(&view.grains.mass, held.chain(pieces.map(|(i, first)| [i, first])));
        let heaviest = mass.iter().copied().fold(0.0, f64::max);
        let all: f64 = view.grains.mass.iter().sum();
        let largest = if all > 0.0 { heaviest / all } else { 0.0 };
        let scalars = vec![view.bonds.len() as f64, view.broken_bonds as f64, mass.len() as f64, largest];
        Sample { scalars, rows: Vec::new() }
    }
}

/// Mass of every fragment [kg], of grains of which some pairs are `held` together.
fn masses(mass: &[f64], held: impl Iterator<Item = [usize; 2]>) -> Vec<f64> {
    // Every grain points to one of its fragment; the last to itself.
    let mut points: Vec<usize> = (0..mass.len()).collect();
    let last = |points: &mut Vec<usize>, mut i: usize| {
        while points[i] != i {
            points[i] = points[points[i]];
            i = points[i];
        }
        i
    };
    for pair in held {
        let [a, b] = pair.map(|row| last(&mut points, row));
        points[a.max(b)] = a.min(b);
    }
    let mut sum = vec![0.0; mass.len()];
    for (i, mass) in mass.iter().enumerate() {
        sum[last(&mut points, i)] += mass;
    }
    (0..mass.len()).filter(|&i| points[i] == i).map(|i| sum[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::masses;

    #[test]
    fn chains_and_single_grains_are_told_apart() {
        let mass = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
        assert_eq!(masses(&mass, [[4, 1], [0, 4], [5, 2]].into_iter()), [19.0, 36.0, 8.0]);
        assert_eq!(masses(&mass, std::iter::empty()), mass);
    }
}
