//! What those who look on see of a model on sites beside its grains: forces between grains and on walls, and the walls.

use super::{Body, SiteEngine};
use crate::lattice::site::ground::NOBODY;
use crate::lattice::site::{ForceUnit, Link};
use crate::view::{Contact, WallLoad};
use crate::wall::Outline;
use glam::DVec3;
use std::collections::BTreeMap;
use tsubu_frame::Frame;
use tsubu_frame::frame::Kind;

impl SiteEngine {
    /// Newtons in the model's unit of force, for a grain.
    fn newtons(&self, mass: f64) -> f64 {
        match self.model.force_unit() {
            ForceUnit::Newton => 1.0,
            ForceUnit::Motion => mass * self.scene.ground.spacing / (self.dt * self.dt),
        }
    }

    /// Forces between grains and on walls.
    pub(super) fn forces(&self, bodies: &[Body]) -> (Vec<Contact>, Vec<WallLoad>) {
        let mut at = BTreeMap::new();
        let mut index = 0;
        self.model.seats(&mut |seat| {
            at.insert(seat.site, index);
            index += 1;
        });
        let mut loads = vec![WallLoad::default(); self.scene.walls.len()];
        let mut contacts = Vec::new();
        for Link { from, to, force } in self.model.links() {
            let Some(&first) = at.get(&from) else { continue };
            let force = self.newtons(self.scene.mass[bodies[first].grain]) * DVec3::new(force[0], 0.0, force[1]);
            let centre = bodies[first].position;
            let (second, wall, reach) = match at.get(&to) {
                Some(&second) => (second, false, 1.0),
                None if self.scene.owner[to] != NOBODY => (usize::from(self.scene.owner[to]), true, 0.5),
                None => continue,
            };
            let between = reach * (self.scene.ground.point(to) - self.scene.ground.point(from));
            let position = centre + 0.5 / reach * between;
            if wall {
                loads[second]
                    .add(&WallLoad { force, torque: (position - self.scene.walls[second].pose.origin()).cross(force) });
            }
            let normal = between.normalize_or(DVec3::NEG_Z);
            contacts.push(Contact {
                first,
                second,
                wall,
                position,
                branch: between,
                force: -force,
                normal,
                overlap: 0.0,
            });
        }
        (contacts, loads)
    }

    /// Outlines of the walls that stand; endless planes as far as the lattice goes.
    pub(super) fn draw_walls(&self, frame: &mut Frame) {
        let (mut number, mut position) = (Vec::new(), Vec::new());
        let (middle, size) = self.scene.ground.inside();
        let mut lines = 0;
        for wall in self.scene.walls.iter().filter(|wall| !wall.vanished()) {
            let outline = match wall.lone_plane() {
                Some((point, normal)) => {
                    let half = 0.5 * (size * normal.cross(DVec3::Y)).length();
                    Outline::of_plane(point, normal, middle, half, false)
                }
                None => wall.outline(),
            };
            for line in outline.lines {
                number.extend(std::iter::repeat_n(lines, line.len()));
                position.extend(line.iter().map(DVec3::to_array));
                lines += 1;
            }
        }
        frame.integer(Kind::Surface, "outline", "-", number);
        frame.vector(Kind::Surface, "position", "m", position);
    }
}
