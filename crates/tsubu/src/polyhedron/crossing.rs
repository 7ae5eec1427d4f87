//! Where two edges cross.
//!
//! The points on two straight edges that are nearest to each other run from end to end as the edges become parallel, and with them a torque. So edges are crowned, as rollers
//! of bearings are: towards its ends an edge lies back, by s^2 q at the share s of its length from its middle. Then
//!
//! ```text
//! D^2 = least of |a(s) - b(t)|^2 + q (s^2 + t^2)        -1/2 <= s, t <= 1/2,   q = 8 c r^2
//! ```
//!
//! with r the sum of both rounding radii has one least whatever the edges do, and slopes without jumps. Its slope over the places of the edges is (a - b) / D at these s and t (the
//! envelope theorem), as if nothing depended on s and t. At its ends an edge lies back by c r: there the corners bear.

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

use super::contact::Contact;
use crate::superellipsoid::symmetric::{Column, Columns, ROWS, ZERO, set, vector};
use glam::DVec3;
use multiversion::multiversion;

/// How far an edge lies back at its ends, over the sum of both rounding radii.
pub(super) const CROWN: f64 = 0.02;

/// So many rows are worked on together: the last of a few go with others that are of no use.
const LOT: usize = 8;

/// An edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    /// Its middle [m].
    pub middle: DVec3,
    /// From its one end to its other [m].
    pub way: DVec3,
    /// Squared length [m^2].
    pub squared: f64,
}

impl Edge {
    /// From one end to another [m].
    #[inline(always)]
    pub fn between([a, b]: [DVec3; 2]) -> Self {
        let way = b - a;
        Self { middle: (a + b) * 0.5, way, squared: way.length_squared() }
    }
}

/// How two edges cross.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The points on both [m].
    pub points: [DVec3; 2],
    /// D^2 [m^2].
    pub squared: f64,
}

impl Crossing {
    /// Where they are nearest to each other. `radii` is the sum of both rounding radii [m].
    #[inline(always)]
    pub fn of(a: &Edge, b: &Edge, radii: f64) -> Self {
        let back = 8.0 * CROWN * radii * radii;
        let from = a.middle - b.middle;
        let (aa, bb, ab) = (a.squared + back, b.squared + back, a.way.dot(b.way));
        let (ra, rb) = (a.way.dot(from), b.way.dot(from));
        let free = within((ab * rb - bb * ra) / (aa * bb - ab * ab));
        let along = (ab * free + rb) / bb;
        let t = within(along);
        let bound = within((ab * t - ra) / aa);
        let s = if along.abs() > 0.5 { bound } else { free };
        let points = [a.middle + a.way * s, b.middle + b.way * t];
        Self { points, squared: (points[0] - points[1]).length_squared() + back * (s * s + t * t) }
    }

    /// The contact that it is; `apart` is the way from the centre of the first body to that of the second, whose edge is seen from the first.
    #[inline(always)]
    pub fn contact(&self, feature: u32, apart: DVec3, radii: f64) -> Contact {
        let Self { points: [p, q], squared } = *self;
        let (way, distance) = (q - p, squared.sqrt());
        let between = way.length();
        Contact {
            feature,
            points: [p, q - apart],
            overlap: radii - distance,
            normal: way / (between + f64::MIN_POSITIVE),
            share: between / distance,
        }
    }
}

/// A place within an edge.
#[inline(always)]
fn within(place: f64) -> f64 {
    place.clamp(-0.5, 0.5)
}

/// Edges that may cross, side by side: they divide and take roots, which vectors do for eight at the price of one. A row does the same whatever is beside it.
#[derive(Clone, Debug)]
pub(super) struct Crossings {
    len: usize,
    /// What each row stands for, by whoever put it there.
    pub name: [u32; ROWS],
    feature: [u32; ROWS],
    /// The ends of both edges, from the centres of their bodies [m].
    ends: [[Columns<3>; 2]; 2],
    apart: Columns<3>,
    radii: Column,
    /// What they end with, as in [`Crossing`] and [`Contact`].
    squared: Column,
    points: [Columns<3>; 2],
    normal: Columns<3>,
    overlap: Column,
    share: Column,
}

impl Default for Crossings {
    fn default() -> Self {
        const V: Columns<3> = [ZERO; 3];
        Self {
            len: 0,
            name: [0; ROWS],
            feature: [0; ROWS],
            ends: [[V; 2]; 2],
            apart: V,
            radii: ZERO,
            squared: ZERO,
            points: [V; 2],
            normal: V,
            overlap: ZERO,
            share: ZERO,
        }
    }
}

impl Crossings {
    pub fn is_full(&self) -> bool {
        self.len == ROWS
    }

    /// Rows in use.
    #[inline]
    pub fn rows(&self) -> usize {
        self.len.min(ROWS)
    }

    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Adds two edges by their ends, each from the centre of its body [m].
    #[inline]
    pub fn push(&mut self, (name, feature): (u32, u32), ends: [[DVec3; 2]; 2], apart: DVec3, radii: f64) {
        let r = self.len;
        if r >= ROWS {
            return;
        }
        self.len += 1;
        (self.name[r], self.feature[r], self.radii[r]) = (name, feature, radii);
        set(&mut self.apart, r, apart);
        for (columns, ends) in self.ends.iter_mut().zip(ends) {
            for (column, end) in columns.iter_mut().zip(ends) {
                set(column, r, end);
            }
        }
    }

    /// Finds where all of them cross.
    pub fn find(&mut self) {
        find(self);
    }

    /// The contact of a row that is nearer than a distance [m]. Returns how much farther the row is, below 0 where it is such a contact.
    #[inline]
    pub fn contact(&self, r: usize, cut: f64, contact: &mut Contact) -> f64 {
        let squared = self.squared[r];
        if squared >= cut * cut {
            return (squared.sqrt() - cut).max(0.0);
        }
        *contact = Contact {
            feature: self.feature[r],
            points: [vector(&self.points[0], r), vector(&self.points[1], r)],
            overlap: self.overlap[r],
            normal: vector(&self.normal, r),
            share: self.share[r],
        };
        -1.0
    }
}

#[multiversion(targets = "simd")]
fn find(crossings: &mut Crossings) {
    let rows = crossings.rows().next_multiple_of(LOT).min(ROWS);
    for r in 0..rows {
        let [[a, b], [c, d]] = &crossings.ends;
        let (apart, radii) = (vector(&crossings.apart, r), crossings.radii[r]);
        let p = Edge::between([vector(a, r), vector(b, r)]);
        let mut q = Edge::between([vector(c, r), vector(d, r)]);
        q.middle += apart;
        let crossing = Crossing::of(&p, &q, radii);
        let contact = crossing.contact(0, apart, radii);
        crossings.squared[r] = crossing.squared;
        set(&mut crossings.points[0], r, contact.points[0]);
        set(&mut crossings.points[1], r, contact.points[1]);
        set(&mut crossings.normal, r, contact.normal);
        (crossings.overlap[r], crossings.share[r]) = (contact.overlap, contact.share);
    }
}
