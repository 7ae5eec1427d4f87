//! Where grains touch walls: spheres, and bodies that are none.
//!
//! A wall is found by the sphere that holds a body, and is then looked at again: a row of a batch is the contact of one place of the body, told to the law as a sphere that is as round there.

mod faceted;
mod round;

use super::contact_batch::ContactBatch;
use super::contact_forces::ForceInput;
use super::shapes::add;
use crate::contact::Law;
use crate::neighbours::block::BlockList;
use crate::wall::{self, Wall};
use glam::DVec3;

/// Where a grain touches a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallShape {
    /// Overlap [m].
    pub overlap: f64,
    /// Unit normal from the grain to the wall.
    pub normal: DVec3,
    /// How round the grain is there [m].
    pub radius: f64,
    /// Centre of the sphere that stands for the body, from that of the body [m].
    pub shift: DVec3,
    /// The wall's name for the place; above [`PLACES`] what of a polyhedron it is.
    pub patch: u32,
    /// How much the overlap grows as the body comes nearer, see [`crate::polyhedron::contact::Contact`].
    pub share: f64,
    /// Force on the body, and torque about its centre, for each unit of the slope of energy over radius, see [`crate::superellipsoid::touch::Rounding`].
    pub rounding: [DVec3; 2],
}

/// So many names of places a wall has for bodies that are no spheres; above that count what of the body is there: 0 for the whole, then its corners, then its edges, and last
/// the whole core at a corner of the wall.
const PLACES: u32 = 1 << 24;
/// Of the first edge: there are 64 corners at most.
const EDGES: u32 = 65;
/// Of the core.
const CORE: u32 = 255;

/// Where one grain touches a wall.
#[derive(Clone, Debug, Default)]
pub(super) struct WallShapes {
    pub found: Vec<WallShape>,
    /// What the rows of a batch are, where there are bodies that are no spheres.
    rows: Vec<WallShape>,
    touching: Vec<wall::Touch>,
    ridges: Vec<u32>,
    tips: Vec<u32>,
    /// Places of a round body that are not judged yet.
    places: Vec<round::Place>,
}

impl WallShapes {
    /// Looks where a grain of a block touches a wall, or is nearer than `reach` [m] to it; `elements` are all that its sphere may touch.
    pub fn find(
        &mut self,
        input: &ForceInput,
        list: &BlockList,
        (own, number): (u32, u32),
        elements: &[u32],
        reach: f64,
    ) {
        let (i, wall) = (list.first + own as usize, &input.walls[number as usize]);
        let (centre, radius) = (input.grains.position[i], input.grains.radius[i]);
        self.found.clear();
        if input.bodies.shaped()
            && let Some(outline) = input.bodies.outline(i)
        {
            self.round_body(&outline, wall, centre, radius, elements, reach);
        } else if let Some(body) = input.bodies.polyhedron(i) {
            self.faceted_body(&body, wall, centre, radius, elements, reach);
        } else {
            wall.touching(elements, centre, radius + reach, &mut self.touching);
            self.found.extend(self.touching.iter().map(|touch| WallShape::sphere(wall, touch, radius)));
        }
    }

    /// Takes a row of a batch.
    pub fn push(&mut self, batch: &mut ContactBatch, r: usize, shape: &WallShape) {
        batch.set_shift(0, r, shape.shift);
        self.rows.push(*shape);
    }

    /// After the geometry: what lies back closes less fast.
    pub fn lie_back(&self, batch: &mut ContactBatch) {
        if batch.shifted {
            self.rows.iter().enumerate().for_each(|(r, row)| batch.chunk.closing[r] *= row.share);
        }
    }

    /// After the law: the force that belongs to what lies back, and what brings bodies to where they are less round.
    pub fn round(&mut self, batch: &mut ContactBatch, law: &Law) {
        if !batch.shifted {
            return;
        }
        let slopes = law.energy_slopes(&batch.chunk);
        for (r, row) in self.rows.drain(..).enumerate() {
            if row.share < 1.0 {
                let lacks = row.normal * (1.0 - row.share);
                add(&mut batch.force, r, lacks * batch.chunk.normal_force[r]);
                add(&mut batch.dissipative, r, lacks * batch.chunk.damping_force[r]);
            }
            let [force, torque] = row.rounding.map(|of| of * slopes[r]);
            // The torque of this force about the centre of the body is in the torque already; the wall feels it at the place of contact.
            let (own, at_place) = (torque - row.shift.cross(force), torque - batch.contact_point(r).cross(force));
            add(&mut batch.torque[0], r, own);
            add(&mut batch.chunk.torque, r, at_place);
            add(&mut batch.force, r, force);
        }
    }
}

impl WallShape {
    /// Of a sphere.
    fn sphere(wall: &Wall, touch: &wall::Touch, radius: f64) -> Self {
        Self {
            overlap: radius - touch.nearest.distance,
            normal: -touch.nearest.normal,
            radius,
            shift: DVec3::ZERO,
            patch: wall.key(touch.element),
            share: 1.0,
            rounding: [DVec3::ZERO; 2],
        }
    }

    /// Whether a contact may have rolled here from another place of the wall.
    pub fn may_follow(&self, wall: &Wall, before: u32, shaped: bool) -> bool {
        if !shaped {
            return wall.adjacent(before, self.patch);
        }
        let part = before / PLACES;
        part == self.patch / PLACES && part < EDGES && wall.adjacent(before % PLACES, self.patch % PLACES)
    }
}
