//! What an engine shows to those who look on: grains, contacts, loads on walls.

use crate::neighbours::grid::{PeriodicBounds, wrapped};
use crate::partner::Host;
use crate::ranks::Reader;
use crate::water::Water;
use glam::DVec3;
use std::borrow::Cow;
use std::fmt::Debug;

/// How much of the contacts somebody wants to see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Contacts {
    /// Nothing.
    #[default]
    Nothing,
    /// Who overlaps whom, where and how deeply; forces are zero. Cheap enough for every step.
    Places,
    /// All of it; it costs about a step to make.
    Forces,
}

/// What somebody wants to see beside the grains, or what an engine can show beside them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wants {
    /// Spins of the grains.
    pub spins: bool,
    /// The list of contacts.
    pub contacts: Contacts,
    /// Forces and torques on the walls.
    pub walls: bool,
    /// Bodies that are no spheres.
    pub bodies: bool,
}

impl Wants {
    /// Grains alone, spins not looked at.
    pub const GRAINS: Self = Self { spins: false, contacts: Contacts::Nothing, walls: false, bodies: false };
    /// Grains, and which of them touch.
    pub const TOUCHES: Self = Self { contacts: Contacts::Places, ..Self::GRAINS };
    /// Grains and their contacts.
    pub const CONTACTS: Self = Self { contacts: Contacts::Forces, ..Self::GRAINS };
    /// Forces and torques on the walls.
    pub const WALLS: Self = Self { walls: true, ..Self::GRAINS };
    /// Everything.
    pub const ALL: Self = Self { spins: true, contacts: Contacts::Forces, walls: true, bodies: true };

    /// What either wants.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            spins: self.spins || other.spins,
            contacts: self.contacts.max(other.contacts),
            walls: self.walls || other.walls,
            bodies: self.bodies || other.bodies,
        }
    }

    /// What of this `offered` does not have, in words; `None` if it has all.
    pub fn missing(self, offered: Self) -> Option<&'static str> {
        if self.contacts > offered.contacts {
            Some("a list of contacts")
        } else if self.walls && !offered.walls {
            Some("forces on walls")
        } else if self.bodies && !offered.bodies {
            Some("bodies that are no spheres")
        } else {
            (self.spins && !offered.spins).then_some("spins")
        }
    }
}

/// How far grains that are no spheres reach.
pub trait Shapes: Debug + Sync {
    /// How far a grain reaches along an axis, from its position to its low and its high end [m]; `None`: as far as its radius, either way.
    fn ends(&self, grain: usize, axis: usize) -> Option<[f64; 2]>;

    /// Share of its volume, in the plane of its area, that lies below a `height` along the axis, from its position [m].
    fn below(&self, grain: usize, axis: usize, height: f64) -> f64;
}

/// One moment, to be read.
#[derive(Clone, Debug, Default)]
pub struct View<'a> {
    /// Simulated time [s].
    pub time: f64,
    /// Periodic axes.
    pub periodic: PeriodicBounds,
    /// The grains, in an order of the engine's own.
    pub grains: Columns<'a>,
    /// Touching pairs; empty unless wanted. Those who want places alone may be shown forces too, and then also pairs that
    /// adhere over a gap.
    pub contacts: Vec<Contact>,
    /// Pairs of grains that bonds hold together.
    pub bonds: Vec<[u32; 2]>,
    /// How many bonds have broken so far.
    pub broken_bonds: u64,
    /// Loads on the walls, in the order of their names; empty unless wanted.
    pub walls: Vec<WallLoad>,
    /// The bodies that are no spheres; empty unless wanted.
    pub bodies: Vec<Body>,
    /// For each grain the place among these of the body that it is a piece of; empty where there are none.
    pub body_of: Vec<Option<u32>>,
    /// How far those reach that are no spheres, if there are some.
    pub shapes: Option<&'a dyn Shapes>,
    /// The water that the grains are in.
    pub water: Option<&'a Water>,
    /// The hosts, in the order of their names; engines show none, whoever lets watches look adds them.
    pub hosts: &'a [Host],
}

/// Columns of the grains.
#[derive(Clone, Debug, Default)]
pub struct Columns<'a> {
    /// Centre [m]; may lie a little beyond a periodic end.
    pub position: Cow<'a, [DVec3]>,
    /// What periodic ends have taken from the position so far [m].
    pub unwrap_offset: Cow<'a, [DVec3]>,
    /// Velocity [m/s].
    pub velocity: Cow<'a, [DVec3]>,
    /// Spin [rad/s].
    pub spin: Cow<'a, [DVec3]>,
    /// Radius [m].
    pub radius: Cow<'a, [f64]>,
    /// Mass [kg].
    pub mass: Cow<'a, [f64]>,
    /// One over the mass [1/kg]; 0 for frozen and driven grains.
    pub inverse_mass: Cow<'a, [f64]>,
    /// Number of the group, in the order of the groups' names.
    pub group: Cow<'a, [u32]>,
    /// Number of the grain.
    pub id: Cow<'a, [u32]>,
}

/// A body that is no sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Index of a grain that is a piece of it, the one with the lowest number.
    pub grain: usize,
    /// Centre of mass, which periodic ends do not put back [m].
    pub centre: DVec3,
    /// Direction of the principal axis of the least moment of inertia.
    pub long: DVec3,
    /// Direction of the principal axis of the largest one.
    pub short: DVec3,
}

/// A touching pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the first grain.
    pub first: usize,
    /// Index of the second grain, or number of the wall.
    pub second: usize,
    /// Whether the second body is a wall.
    pub wall: bool,
    /// Point of contact [m].
    pub position: DVec3,
    /// From the centre of the first grain to that of the second, or of the image of it that is touched; for a wall to the
    /// point of contact [m].
    pub branch: DVec3,
    /// Force on the first grain [N].
    pub force: DVec3,
    /// Unit normal from the first to the second body.
    pub normal: DVec3,
    /// Overlap [m].
    pub overlap: f64,
}

impl Contact {
    /// Writes it into a message.
    pub(crate) fn put(&self, message: &mut Vec<f64>) {
        let Self { first, second, wall, position, branch, force, normal, overlap } = self;
        message.extend([*first as f64, *second as f64, f64::from(*wall)]);
        message.extend([position, branch, force, normal].into_iter().flat_map(DVec3::to_array));
        message.push(*overlap);
    }

    /// Takes one from a message.
    pub(crate) fn take(message: &mut Reader) -> Self {
        let (first, second, wall) = (message.number() as usize, message.number() as usize, message.number() != 0.0);
        let [position, branch, force, normal] = std::array::from_fn(|_| message.vector());
        Self { first, second, wall, position, branch, force, normal, overlap: message.number() }
    }
}

/// What grains do to a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallLoad {
    /// Force [N].
    pub force: DVec3,
    /// Torque about the origin of the wall's pose [N.m].
    pub torque: DVec3,
}

impl WallLoad {
    /// Adds another load.
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl View<'_> {
    /// Number of grains.
    pub fn len(&self) -> usize {
        self.grains.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether forces move the grain.
    pub fn free(&self, i: usize) -> bool {
        self.grains.inverse_mass[i] != 0.0
    }

    /// A point put between the periodic ends.
    pub fn put(&self, p: DVec3) -> DVec3 {
        wrapped(&self.periodic, p)
    }

    /// Of every grain, whether it overlaps another grain or a wall.
    pub fn overlapping(&self) -> Vec<bool> {
        let mut overlapping = vec![false; self.len()];
        for contact in self.contacts.iter().filter(|c| c.overlap > 0.0) {
            overlapping[contact.first] = true;
            if !contact.wall {
                overlapping[contact.second] = true;
            }
        }
        overlapping
    }

    /// How far a grain reaches along an axis, from its position to its low and its high end [m].
    pub fn ends(&self, i: usize, axis: usize) -> [f64; 2] {
        let radius = self.grains.radius[i];
        self.shapes.and_then(|shapes| shapes.ends(i, axis)).unwrap_or([-radius, radius])
    }

    /// Centre of a grain between the periodic ends.
    pub fn position(&self, i: usize) -> DVec3 {
        self.put(self.grains.position[i])
    }

    /// Centre of a grain as if the world did not repeat.
    pub fn unwrapped(&self, i: usize) -> DVec3 {
        self.grains.position[i] + self.grains.unwrap_offset[i]
    }

    /// One contact for each pair of bodies, however many of their corners and edges touch; a wall that is touched from several sides, as a
    /// box in a corner, has a contact at each.
    pub fn pairs(&self) -> impl Iterator<Item = &Contact> {
        let same = |a: &Contact, b: &Contact| {
            let bodies = (a.first, a.second, a.wall) == (b.first, b.second, b.wall);
            // A grain may touch another one directly and across a periodic end.
            let again = || a.branch.distance_squared(b.branch) < 1e-12 * a.branch.length_squared();
            bodies && if a.wall { a.normal.dot(b.normal) > 1.0 - 1e-6 } else { again() }
        };
        self.contacts.chunk_by(move |a, b| same(a, b)).map(|points| &points[0])
    }

    /// How many bodies touch every grain, as [`View::pairs`] counts them; walls only if `walls`.
    pub fn touching(&self, walls: bool) -> Vec<u32> {
        let mut count = vec![0; self.len()];
        for contact in self.pairs() {
            if !contact.wall {
                count[contact.first] += 1;
                count[contact.second] += 1;
            } else if walls {
                count[contact.first] += 1;
            }
        }
        count
    }
}
