//! Bodies of several spheres (clumps): contacts act on the spheres, their sum moves the body, and the body moves its spheres.
//!
//! The pieces are rows among the grains, so contacts, walls and neighbour lists know nothing of bodies, but that two pieces of one body never
//! touch. Integration is velocity Verlet, as for spheres. Free rotation between two kicks is the implicit midpoint rule with an
//! attitude by Cayley's map (Austin, Krishnaprasad and Wang 1993): in space the angular momentum stays what it is to the bit, and the
//! rotational energy to rounding, at any step and for any moments of inertia.

mod assemble;
mod body;
mod felt;
mod in_water;
mod refused;
mod rims;
mod saved;
mod seen;
mod told;

pub(super) use refused::refused;
pub(super) use rims::facet;

use super::contact_batch::ContactBatch;
use crate::contact::chunk::Chunk;
use crate::ledger::Energies;
use crate::neighbours::block::BlockList;
use crate::neighbours::joined::NO_BODY;
use crate::polyhedron::{Polyhedron, Turned};
use crate::state::{Grains, moved_along};
use crate::superellipsoid::{Outline, Superellipsoid};
use crate::threads::{each_in_parts, shares};
use crate::view;
pub(super) use body::Body;
use body::TOGETHER;
use felt::Pieces;
use glam::{DQuat, DVec3};
use multiversion::multiversion;

/// A sphere of a body, or one that is none.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Its number, or its rank.
    body: u32,
    /// Its centre from that of the body, along the principal axes [m].
    offset: DVec3,
}

/// All bodies of several spheres, with those that are yet to come and those that have gone, which have no pieces; empty where every grain is a sphere. Their numbers go with the ids
/// of their pieces. They lie as the grains do, so that what a block sees lies side by side; what is added up goes in the order of the numbers.
#[derive(Clone, Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is another question about all of them")]
pub(super) struct Bodies {
    list: Vec<Body>,
    /// Where in the list the body with a number is.
    rank: Vec<u32>,
    /// By the ids of grains, with the numbers of bodies.
    by_id: Vec<Piece>,
    /// The same as the grains are sorted, with the ranks of bodies.
    sorted: Vec<Piece>,
    /// Where the pieces are among the grains, body by body.
    places: Vec<u32>,
    /// Whether all stay in the plane: what rounding would bring out of it is an exact zero.
    plane: bool,
    /// Whether none turns, whatever torques it feels.
    locked: bool,
    /// Whether some are superellipsoids.
    shaped: bool,
    /// Whether some of these are no ellipsoids.
    powers: bool,
    /// Polyhedra of diameter 1.
    polyhedra: Vec<Polyhedron>,
    /// See [`Bodies::finest`].
    finest: Option<f64>,
}

impl Bodies {
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether every grain is a piece of one.
    pub fn are_all(&self) -> bool {
        self.places.len() == self.sorted.len() && !self.is_empty()
    }

    /// Whether there are superellipsoids; otherwise all pieces are spheres.
    pub fn shaped(&self) -> bool {
        self.shaped
    }

    /// Whether some superellipsoids are no ellipsoids.
    pub fn powers(&self) -> bool {
        self.powers
    }

    /// The superellipsoid that a grain is; `None`: it is a sphere.
    #[inline]
    pub fn superellipsoid(&self, i: usize) -> Option<(&Body, &Superellipsoid)> {
        let body = self.body(i)?;
        Some((body, body.superellipsoid.as_ref()?))
    }

    /// The same as it is turned.
    pub fn outline(&self, i: usize) -> Option<Outline> {
        let (body, shape) = self.superellipsoid(i)?;
        Some(if shape.is_ellipsoid() { body.ellipsoid.outline() } else { shape.turned(&body.axes) })
    }

    /// Whether there are polyhedra.
    pub fn faceted(&self) -> bool {
        !self.polyhedra.is_empty()
    }

    /// The body that a grain is a piece of.
    #[inline]
    pub fn body(&self, i: usize) -> Option<&Body> {
        self.list.get(self.sorted.get(i)?.body as usize)
    }

    /// The polyhedron that a grain is, as it is turned.
    #[inline]
    pub fn polyhedron(&self, i: usize) -> Option<Turned<'_>> {
        let body = self.body(i)?;
        Some(body.polyhedron.as_ref()?.at(&self.polyhedra, &body.axes))
    }

    /// Rounding radius of the polyhedron that a grain is [m].
    pub fn rounding(&self, i: usize) -> Option<f64> {
        self.polyhedron(i).map(|body| body.rounding)
    }

    /// Radius of the sphere of the volume of a body that is one piece, in the plane of the disc of its area [m]; `None`: the grain is a sphere.
    pub fn equivalent_radius(&self, i: usize) -> Option<f64> {
        self.body(i)?.equivalent_radius
    }

    /// Twice the smallest rounding radius of all polyhedra, those that are yet to come included [m]; infinite where there are none.
    pub fn finest(&self) -> f64 {
        self.finest.unwrap_or(f64::INFINITY)
    }

    /// The body of every grain by its id; nothing where there are none.
    pub fn of_grains(&self) -> Vec<u32> {
        if self.is_empty() { Vec::new() } else { self.by_id.iter().map(|piece| piece.body).collect() }
    }

    /// The body of the grain with an id.
    pub fn of(&self, id: u32) -> Option<u32> {
        self.by_id.get(id as usize).map(|piece| piece.body).filter(|body| *body != NO_BODY)
    }

    /// Finds the pieces among the grains; wherever these are sorted.
    pub fn find(&mut self, grains: &Grains) {
        if self.is_empty() {
            return;
        }
        self.sort(grains);
        let (by_id, rank) = (&self.by_id, &self.rank);
        let piece = |id: &u32| {
            let Piece { body, offset } = by_id[*id as usize];
            Piece { body: rank.get(body as usize).copied().unwrap_or(NO_BODY), offset }
        };
        self.sorted.clear();
        self.sorted.extend(grains.id.iter().map(piece));
        self.places = grains.by_id().into_iter().map(|place| place as u32).collect();
        let sorted = &self.sorted;
        self.places.retain(|place| sorted[*place as usize].body != NO_BODY);
        self.list.iter_mut().for_each(|body| (body.pieces, body.path) = (0..0, 0.0));
        for (k, place) in self.places.iter().enumerate() {
            let pieces = &mut self.list[sorted[*place as usize].body as usize].pieces;
            *pieces = if pieces.end == 0 { k..k + 1 } else { pieces.start..k + 1 };
        }
        for body in self.list.iter_mut().filter(|body| body.is_there()) {
            let inverse = grains.inverse_mass[self.places[body.pieces.start] as usize];
            body.added_mass = moved_along(body.mass, inverse);
        }
    }

    /// Puts the bodies in the order of their first pieces among the grains; those that are not there come last.
    fn sort(&mut self, grains: &Grains) {
        let Self { list, rank, by_id, .. } = self;
        rank.fill(NO_BODY);
        let mut met = 0;
        let of_grains = grains.id.iter().map(|id| by_id[*id as usize].body).filter(|body| *body != NO_BODY);
        for body in of_grains.chain(0..list.len() as u32) {
            let rank = &mut rank[body as usize];
            if *rank == NO_BODY {
                *rank = met;
                met += 1;
            }
        }
        let mut k = 0;
        while k < list.len() {
            let to = rank[list[k].number as usize] as usize;
            if to == k {
                k += 1;
            } else {
                list.swap(k, to);
            }
        }
    }

    /// All in the order of their numbers.
    fn numbered(&self) -> impl Iterator<Item = &Body> {
        self.rank.iter().map(|rank| &self.list[*rank as usize])
    }

    /// Those that are there.
    fn there(&self) -> impl Iterator<Item = &Body> {
        self.numbered().filter(|body| body.is_there())
    }

    /// Which bodies a look at their centres of mass [m] takes away, by their numbers.
    pub fn taken(&self, mut takes: impl FnMut(DVec3) -> bool) -> Vec<bool> {
        self.numbered().map(|body| body.is_there() && takes(body.centre)).collect()
    }

    /// Before the forces: bodies go to the end of the step. Their pieces follow block by block, see [`place`].
    pub fn first_half(&mut self, dt: f64) {
        let Self { list, places, plane, .. } = self;
        let plane = *plane;
        let (many, others) = list.as_chunks_mut::<TOGETHER>();
        each_in_parts(many, shares(places.len()), &|bodies: &mut [Body; TOGETHER]| {
            body::first_half(bodies, dt, plane);
        });
        body::first_half(others, dt, plane);
    }

    /// After the forces: sums what the pieces feel, which their columns carry ([`super::integrate`]), finds the new accelerations and completes
    /// the velocities, which the old ones have brought `share` [s] of the way. Then bodies may do the first half of a step at once. Returns the correction of the losses, as for spheres.
    pub fn second_half(&mut self, grains: &Grains, gravity: DVec3, share: f64, next: Option<f64>) -> f64 {
        let Self { list, sorted, places, plane, locked, .. } = self;
        let plane = *plane;
        let pieces = Pieces { grains, sorted, places, plane, locked: *locked };
        let work = |bodies: &mut [Body]| {
            for body in bodies.iter_mut().filter(|body| body.is_there()) {
                body.second_half(&pieces.felt(body), gravity, share, plane);
            }
            if let Some(dt) = next {
                body::first_half(bodies, dt, plane);
            }
        };
        let (many, others) = list.as_chunks_mut::<TOGETHER>();
        each_in_parts(many, shares(places.len()), &|bodies: &mut [Body; TOGETHER]| work(bodies));
        work(others);
        -2.0 / 3.0 * self.there().map(|body| body.correction).sum::<f64>()
    }

    /// Completes the velocities of the pieces, for those who look; the next step finds them anew.
    pub fn show(&self, grains: &mut Grains) {
        for (i, piece) in self.sorted.iter().enumerate() {
            let Some(body) = self.list.get(piece.body as usize) else { continue };
            grains.velocity[i] = body.velocity + body.spin.cross(body.arm(piece, self.plane));
            (grains.acceleration[i], grains.spin[i]) = (body.acceleration, body.spin);
            grains.angular_acceleration[i] = DVec3::ZERO;
        }
    }

    /// Gives each row of a batch the mass that its bodies show at the place of contact: 1/m + (r x n) . I^-1 (r x n), with the arm r from the
    /// centre of mass (Goldsmith 1960). So what was asked for comes back from an impact anywhere on a body.
    /// Only to the rows that are `asked` for.
    pub fn show_mass(&self, batch: &mut ContactBatch, list: &BlockList, wall: bool, asked: impl Fn(usize) -> bool) {
        if !self.is_empty() && !self.locked {
            show_mass(self, batch, list, wall, &asked);
        }
    }

    /// How much a body gives way by turning, to a push along a normal on a piece of it, or on what is `shift` [m] beside that [1/kg].
    #[expect(clippy::inline_always, reason = "a call inside a row would end the wide code of its loop")]
    #[inline(always)]
    pub fn turning(&self, i: usize, shift: DVec3, normal: DVec3) -> f64 {
        let piece = &self.sorted[i];
        let Some(body) = self.list.get(piece.body as usize).filter(|_| !self.locked) else { return 0.0 };
        let lever = (body.arm(piece, self.plane) + shift).cross(normal);
        lever.dot(body.inverse_inertia * lever)
    }

    /// Kinetic, rotational and potential energy.
    pub fn energies(&self, gravity: DVec3) -> Energies {
        let mut energies = Energies::default();
        for body in self.there() {
            let squared = body.velocity.length_squared();
            energies.kinetic += 0.5 * body.mass * squared;
            energies.added_mass += 0.5 * body.added_mass * squared;
            energies.rotational += 0.5 * body.angular_momentum.dot(body.spin);
            energies.potential -= body.mass * gravity.dot(body.centre);
        }
        energies
    }

    /// Total momentum [N.s], that of the water that moves along with them included.
    pub fn momentum(&self) -> DVec3 {
        self.there().map(|body| (body.mass + body.added_mass) * body.velocity).sum()
    }

    /// Sum of mass times centre [kg.m].
    pub fn moment_of_mass(&self) -> DVec3 {
        self.there().map(|body| body.mass * body.centre).sum()
    }

    /// Adds a velocity to all.
    pub fn push(&mut self, velocity: DVec3) {
        self.list.iter_mut().for_each(|body| body.velocity += velocity);
    }

    /// What is shown of those that are there, and for each grain its place among them.
    pub fn view(&self) -> (Vec<view::Body>, Vec<Option<u32>>) {
        let (mut shown, mut body_of) = (Vec::new(), vec![None; self.sorted.len()]);
        for body in self.there() {
            let places = &self.places[body.pieces.clone()];
            for place in places {
                body_of[*place as usize] = Some(shown.len() as u32);
            }
            let along = |axis: usize| body.axes.col(axis);
            shown.push(view::Body {
                grain: places[0] as usize,
                centre: body.centre,
                long: along(body.moments.min_position()),
                short: along(body.moments.max_position()),
            });
        }
        (shown, if self.is_empty() { Vec::new() } else { body_of })
    }

    /// Brings all to rest.
    pub fn stop(&mut self) {
        for body in &mut self.list {
            (body.velocity, body.angular_momentum, body.spin) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        }
    }

    /// How the body of a grain is turned.
    pub fn orientation(&self, id: u32) -> Option<DQuat> {
        self.of(id).map(|body| self.list[self.rank[body as usize] as usize].orientation)
    }
}

/// The pieces of one block, as columns.
pub(super) struct Block<'a> {
    pub first: usize,
    pub position: &'a mut [DVec3],
    pub velocity: &'a mut [DVec3],
    pub spin: &'a mut [DVec3],
    pub unwrap_offset: &'a [DVec3],
    pub reference: &'a [DVec3],
}

/// Puts the pieces of a block where their bodies have them. Returns, of all of its grains, the sum of the velocities [m/s] and how far the
/// farthest is from where it was at the search and from `offset` [m].
#[multiversion(targets = "simd")]
pub(super) fn place(bodies: &Bodies, block: &mut Block, offset: DVec3) -> (DVec3, f64) {
    let (mut total, mut farthest, mut sum) = (DVec3::ZERO, 0.0_f64, 0.0);
    for (i, piece) in bodies.sorted[block.first..].iter().enumerate().take(block.position.len()) {
        if let Some(body) = bodies.list.get(piece.body as usize) {
            let arm = body.arm(piece, bodies.plane);
            block.position[i] = body.centre + arm - block.unwrap_offset[i];
            block.velocity[i] = body.velocity + body.spin.cross(arm);
            block.spin[i] = body.spin;
        }
        total += block.velocity[i];
        let away = (block.position[i] - block.reference[i] - offset).length_squared();
        farthest = farthest.max(away);
        sum += away;
    }
    // The sum catches what a maximum hides.
    (total, if f64::is_finite(sum) { farthest.sqrt() } else { f64::NAN })
}

#[multiversion(targets = "simd")]
fn show_mass(bodies: &Bodies, batch: &mut ContactBatch, list: &BlockList, wall: bool, asked: &dyn Fn(usize) -> bool) {
    for r in (0..batch.chunk.rows()).filter(|r| asked(*r)) {
        let normal = Chunk::vector(&batch.chunk.normal, r);
        let mut more = bodies.turning(list.first + batch.first[r] as usize, batch.shift(0, r), normal);
        if !wall {
            more += bodies.turning(list.grain_at[batch.second[r] as usize] as usize, batch.shift(1, r), normal);
        }
        if more > 0.0 {
            batch.chunk.effective_mass[r] = 1.0 / (1.0 / batch.chunk.effective_mass[r] + more);
        }
    }
}
