//! Distribution of contact forces, and force chains.

use super::{Inside, Sample, Sheet, Watch, mean};
use crate::about::About;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.forces",
    formula: "\
Distribution of the normal forces f of the contacts; what pulls counts as zero.
mean force       <f>                                                                     [N]
chain share      share of the contacts with f > <f>, which carry the force chains        [-]
chain load       share of the sum of forces that these carry                             [-]
tail exponent    beta of P(f / <f>) ~ exp(-beta f / <f>) above the mean, by greatest likelihood: 1 / (mean of
                 f / <f> over those above 1, less 1)                                     [-]
largest force    over the mean                                                           [-]
The table is the histogram of f / <f> as a probability density: its integral is the share of contacts below `largest`.
In a region, a contact counts if its point is inside.",
    symbols: "",
    limits: "The exponent of few contacts is noise.",
    reference: "Radjai et al. 1996 (Phys. Rev. Lett. 77, 274) for the division at the mean; Mueth et al. 1998 for the tail, \
about 1.5",
};

/// Sorts forces.
#[derive(Clone, Debug)]
pub(super) struct Forces {
    bins: usize,
    largest: f64,
    walls: bool,
    region: Inside,
}

pub(super) fn open(asked: &watch::Forces, plan: &Plan) -> Forces {
    let watch::Forces { bins, largest, walls, region } = asked;
    Forces { bins: *bins, largest: *largest, walls: *walls, region: Inside::new(region.as_ref(), plan) }
}

impl Watch for Forces {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::CONTACTS
    }

    fn scalars(&self) -> Vec<String> {
        ["mean force [N]", "chain share [-]", "chain load [-]", "tail exponent [-]", "largest force [-]"]
            .map(String::from)
            .to_vec()
    }

    fn sheet(&self) -> Option<Sheet> {
        let coordinates = vec!["force over mean [-]".to_owned()];
        Some(Sheet { coordinates, values: vec!["probability density [-]".to_owned()], steady: true })
    }

    fn take(&mut self, view: &View) -> Sample {
        let counted =
            view.contacts.iter().filter(|c| (self.walls || !c.wall) && self.region.holds(view.put(c.position)));
        // The normal points at the second body: what presses the first one away from it is positive.
        let forces: Vec<f64> = counted.map(|c| (-c.force.dot(c.normal)).max(0.0)).collect();
        let average = mean(forces.iter().copied());
        let over = || forces.iter().map(|f| f / average);
        let chain = || over().filter(|x| *x > 1.0);
        let number = forces.len() as f64;
        let scalars = vec![
            average,
            chain().count() as f64 / number,
            chain().sum::<f64>() / number,
            1.0 / (mean(chain()) - 1.0),
            over().fold(f64::NAN, f64::max),
        ];
        let width = self.largest / self.bins as f64;
        let mut histogram = vec![0.0; self.bins];
        for bin in over().map(|x| (x / width) as usize).filter(|bin| *bin < self.bins) {
            histogram[bin] += 1.0 / (number * width);
        }
        let row = |(k, density): (usize, &f64)| {
            let density = if average > 0.0 { *density } else { f64::NAN };
            vec![(k as f64 + 0.5) * width, density]
        };
        Sample { scalars, rows: histogram.iter().enumerate().map(row).collect() }
    }
}
