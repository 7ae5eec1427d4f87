//! What no step may break, whatever the model: grains are neither made nor lost, and none goes too far. Looked at in debug builds.

use super::SiteEngine;
use crate::lattice::site::Seat;
use glam::DVec3;

impl SiteEngine {
    /// Where every grain is, without the ends of a world that repeats itself; nowhere: it has not come yet, or was removed [m].
    pub(super) fn seated(&self) -> Vec<Option<DVec3>> {
        let mut places = vec![None; self.scene.mass.len()];
        let [x, _, z] = self.scene.ground.ends().map(|ends| ends.map_or(0.0, |[low, high]| high - low));
        self.model.seats(&mut |Seat { grain, site, laps, .. }| {
            let laps = DVec3::new(x * f64::from(laps[0]), 0.0, z * f64::from(laps[1]));
            places[grain] = Some(self.scene.ground.point(site) + laps);
        });
        places
    }

    /// The first invariant that a step from the places `before` has broken: nobody comes from nowhere or is lost without an
    /// outlet, nobody is twice or on a crowded site, nobody goes too far.
    pub(super) fn fault(&self, before: &[Option<DVec3>]) -> Option<String> {
        let (most, reach) = self.model.limits();
        let mut sites = vec![0; self.scene.ground.len()];
        let mut count = 0;
        self.model.seats(&mut |seat| {
            sites[seat.site] += 1;
            count += 1;
        });
        if count != self.present {
            return Some(format!("{count} grains are there, not {}", self.present));
        }
        if let Some(site) = sites.iter().position(|count| *count > most) {
            return Some(format!("{} grains on site {site}", sites[site]));
        }
        let now = self.seated();
        if now.iter().flatten().count() != count {
            return Some("a grain is in two places".to_owned());
        }
        let farthest = reach * self.scene.ground.spacing * (1.0 + 1e-9);
        before.iter().zip(&now).enumerate().find_map(|(grain, pair)| match pair {
            (Some(from), Some(to)) if from.distance(*to) > farthest => Some(format!("grain {grain}: {from} to {to}")),
            (None, Some(to)) => Some(format!("grain {grain} comes from nowhere to {to}")),
            (Some(from), None) if self.scene.removal.is_empty() => Some(format!("grain {grain} is lost at {from}")),
            _ => None,
        })
    }
}
