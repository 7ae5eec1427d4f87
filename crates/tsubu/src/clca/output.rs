//! What those who look on see of CL-CA beside the grains: pairs, and walls where the lattice has them.

use super::bed::Bed;
use super::engine::{ClCaEngine, Rule};
use super::movers::shift;
use super::passive::{Body, Shared};
use crate::engine::Engine;
use crate::lattice::direction::Direction;
use crate::view::Contact;
use crate::wall::Outline;
use glam::DVec3;
use std::collections::BTreeSet;
use tsubu_frame::{Frame, Kind};

/// Pairs of grains with points beside each other, each once.
fn touching(bed: &Bed) -> Vec<Shared> {
    let mut pairs = BTreeSet::new();
    for grain in bed.present().filter(|&grain| bed.kind(grain).free) {
        let stencil = bed.kind(grain).stencil + bed.grains.turn[grain] as usize;
        for cell in bed.cells(stencil, bed.grains.cell[grain] as usize) {
            for direction in Direction::ALL {
                let owner = bed.grid.at(bed.grid.neighbour(cell, bed.odd(cell), direction));
                if owner > grain as i32 {
                    pairs.insert((grain, owner as usize));
                }
            }
        }
    }
    pairs.into_iter().map(|(grain, other)| Shared { grain, other: Body::Grain(other), points: 0 }).collect()
}

impl ClCaEngine {
    /// Pairs that touch (active rule) or share points (passive rule), with the number of points shared.
    pub fn pairs(&self) -> Vec<Shared> {
        match &self.rule {
            Rule::Active(_) => touching(&self.bed),
            Rule::Passive(passive, pushers, _) => passive.clone().overlaps(&self.bed, pushers),
        }
    }

    /// Touching pairs for those who look on: the overlap is the number of shared points times the spacing.
    pub(super) fn contacts_of(&self, present: &[usize]) -> Vec<Contact> {
        let mut place = vec![0; self.bed.len()];
        present.iter().enumerate().for_each(|(index, &grain)| place[grain] = index);
        let contact = |pair: Shared| {
            let centre = self.position(pair.grain);
            let (second, wall, between) = match pair.other {
                Body::Grain(other) => (place[other], false, self.position(other) - centre),
                // A wall is below or beside, wherever it came from: against its last move.
                Body::Pusher(number) => {
                    let Rule::Passive(_, pushers, _) = &self.rule else { return None };
                    let from = -self.stage.step(pushers[number].moved).normalize_or(DVec3::Z);
                    (pushers[number].wall, true, from * self.radius(pair.grain))
                }
            };
            let normal = between.normalize_or(DVec3::Z);
            Some(Contact {
                first: place[pair.grain],
                second,
                wall,
                position: centre + 0.5 * between,
                branch: between,
                force: DVec3::ZERO,
                normal,
                overlap: f64::from(pair.points) * self.stage.spacing,
            })
        };
        self.pairs().into_iter().filter_map(contact).collect()
    }

    /// The outline of every grain: its `shape`, and for every shape, turned ones too, a closed line round the grain's position.
    pub(super) fn draw_grains(&self, present: &[usize], frame: &mut Frame) {
        let shape = |grain: usize| self.bed.kind(grain).stencil + usize::from(self.bed.grains.turn[grain]);
        frame.integer(Kind::Grain, "shape", "-", present.iter().map(|&grain| shape(grain) as i64).collect());
        let (mut number, mut corner) = (Vec::new(), Vec::new());
        for kind in &self.bed.kinds {
            let mut shape = kind.shape.clone();
            for turn in 0..usize::from(kind.orientations) {
                let line = shape.outline();
                number.extend(std::iter::repeat_n((kind.stencil + turn) as i64, line.len()));
                corner.extend(line.into_iter().map(|at| (0.5 * self.stage.step(at)).to_array()));
                shape = shape.turned();
            }
        }
        frame.integer(Kind::Global, "shape of corner", "-", number);
        frame.vector(Kind::Global, "corner", "m", corner);
    }

    /// Outlines of the walls that stand, where the lattice has them.
    pub(super) fn draw_walls(&self, frame: &mut Frame) {
        let (mut number, mut position) = (Vec::new(), Vec::new());
        let (middle, size) = self.stage.inside();
        let mut lines = 0;
        for (index, wall) in self.walls.iter().enumerate() {
            let outline = match wall.lone_plane() {
                // Endless planes are drawn as far as the lattice goes.
                Some((point, normal)) => {
                    let half = 0.5 * (size * normal.cross(DVec3::Y)).length();
                    Outline::of_plane(point, normal, middle, half, false)
                }
                None => wall.outline(),
            };
            let moved = match &self.rule {
                Rule::Passive(_, pushers, _) if pushers.iter().any(|pusher| pusher.wall == index) => {
                    self.stage.step(shift(wall, &self.stage, self.time()))
                }
                _ => DVec3::ZERO,
            };
            for line in outline.lines {
                number.extend(std::iter::repeat_n(lines, line.len()));
                position.extend(line.iter().map(|&corner| (corner + moved).to_array()));
                lines += 1;
            }
        }
        frame.integer(Kind::Surface, "outline", "-", number);
        frame.vector(Kind::Surface, "position", "m", position);
    }
}
