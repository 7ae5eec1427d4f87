//! Where the dwell of a host has come to.

use super::{Sample, Watch};
use crate::about::About;
use crate::partner::Host;
use crate::view::{View, Wants};
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.resonance",
    formula: "\
Of the last whole period of the drive:
frequency      f, which the drive has come to                                               [Hz]
lag            of the told displacement, against the base, behind the drive                 [rad]
amplitude      of the told displacement, against the base                                   [m]
added mass     m0 ((f0 / f)^2 - 1): what, hung on the lowest mode, would shift it to f      [kg]",
    symbols: "f0, m0: natural frequency and modal mass of the lowest mode of the structure without grains",
    limits: "The added mass is meant at a lag of a quarter of a turn, when the loop has come to rest: `frequency` no longer changes. It is that of a \
lump of mass, whatever grains lose; where modes lie close to one another each shifts the lag of the other.",
    reference: "by definition",
};

/// Reads a host's dwell.
#[derive(Clone, Debug)]
pub(super) struct Resonance {
    host: usize,
    natural: f64,
    mass: f64,
}

pub(super) fn open(asked: &watch::Resonance, plan: &Plan) -> Resonance {
    let watch::Resonance { host } = asked;
    let built = plan.hosts.get(host).map(Host::new);
    Resonance {
        host: plan.hosts.keys().position(|name| name == host).unwrap_or(0),
        natural: built.as_ref().and_then(|host| host.natural_frequencies().first().copied()).unwrap_or(f64::NAN),
        mass: built.as_ref().map_or(f64::NAN, Host::modal_mass),
    }
}

impl Watch for Resonance {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        ["frequency [Hz]", "lag [rad]", "amplitude [m]", "added mass [kg]"].map(str::to_owned).to_vec()
    }

    fn take(&mut self, view: &View) -> Sample {
        let scalars = match view.hosts.get(self.host).and_then(Host::dwelling) {
            Some(found) => {
                let added = self.mass * ((self.natural / found.frequency).powi(2) - 1.0);
                vec![found.frequency, found.lag, found.amplitude, added]
            }
            None => vec![f64::NAN; 4],
        };
        Sample { scalars, rows: Vec::new() }
    }
}
