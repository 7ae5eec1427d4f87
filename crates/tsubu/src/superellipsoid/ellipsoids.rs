//! Where ellipsoids touch, many pairs at once.
//!
//! The search of [`super::touch`], for bodies whose support function is a root of squares: h(u) = sqrt(u . A u), with the sum A over the axes of
//! the squared semi-axis times the dyad of its direction. Pairs are rows of columns, which the compiler puts into vectors: there are no powers and
//! no branches. A row does the same whatever is beside it, so the bits depend on the two bodies alone. Steps are Newton's without a line search; a
//! row where the overlap grows, or which has not arrived after some steps, is left to the search that always ends.

use super::symmetric::{Column, Columns, ROWS, Symmetric, ZERO, set, vector};
use super::touch::{Rounding, Touch};
use super::{FLATTEST, Form, Outline};
use glam::DVec3;
use multiversion::multiversion;

/// Steps over the sphere; nearly all pairs take two or three.
const STEPS: usize = 8;

/// Longest step over the sphere [rad].
const LONGEST: f64 = 0.5;

/// A row has arrived where it goes no farther than this over the sphere [rad]: the square of it is left, and a last step takes the square of that.
const ARRIVED: f64 = 1e-3;

/// The greater of two numbers, without a word on what is none.
#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// An ellipsoid, or a sphere, as it is turned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ellipsoid {
    /// Sum over the axes of the squared semi-axis times the dyad of its direction [m^2].
    pub squared: Symmetric,
    /// Product of the semi-axes [m^3].
    pub product: f64,
    /// Radii of curvature end here [m].
    pub flattest: f64,
    /// Inverse of its inertia in space [1/(kg.m^2)].
    pub inverse_inertia: Symmetric,
}

impl Ellipsoid {
    /// A sphere of a radius [m].
    pub fn sphere(radius: f64) -> Self {
        let squared = Symmetric { on: DVec3::splat(radius * radius), off: DVec3::ZERO };
        let (product, flattest) = (radius * radius * radius, FLATTEST * radius);
        Self { squared, product, flattest, inverse_inertia: Symmetric::default() }
    }

    /// For the search that always ends.
    pub fn outline(&self) -> Outline {
        Outline { form: Form::Ellipsoid(self.product), squared: self.squared.full(), flattest: self.flattest }
    }
}

/// How round a body, by its product and its flattest radius, is where `point` is farthest along a normal, and how that changes with the normal: see
/// [`Outline::roundness`].
#[inline(always)]
fn roundness((product, flattest): (f64, f64), normal: DVec3, point: DVec3) -> (f64, DVec3) {
    let reach = normal.dot(point);
    let (radius, least) = (product / (reach * reach), 1e-6 * flattest);
    let slope = (point - normal * reach) * (-2.0 * radius / reach);
    let ends = if radius > least { flattest } else { least };
    let within = radius < flattest && radius > least;
    (if within { radius } else { ends }, slope * if within { 1.0 } else { 0.0 })
}

/// One direction of a pair.
struct Look {
    reach: [f64; 2],
    /// Of the first body the farthest point along the normal; of the second that against it, the other way round.
    points: [DVec3; 2],
    overlap: f64,
    /// How far the two points lie beside each other.
    beside: DVec3,
}

impl Look {
    #[inline(always)]
    fn at(normal: DVec3, first: &Symmetric, second: &Symmetric, apart: DVec3) -> Self {
        let (a, b) = (first.times(normal), second.times(normal));
        let reach = [normal.dot(a).sqrt(), normal.dot(b).sqrt()];
        let points = [a * (1.0 / reach[0]), b * (1.0 / reach[1])];
        let overlap = reach[0] + reach[1] - normal.dot(apart);
        let beside = points[0] + points[1] - apart - normal * overlap;
        Self { reach, points, overlap, beside }
    }

    /// How far directions go in answer to `pushed`, across the normal, of a pair that bends by the sum of both. The matrix of this is K = bend - overlap
    /// across the normal, and K^-1 = (trace - K) / determinant there.
    #[inline(always)]
    fn answer(&self, bend: &Symmetric, pushed: DVec3, size: f64) -> DVec3 {
        let (on, off) = (bend.on, bend.off);
        let (whole, f) = (on.x + on.y + on.z, self.overlap);
        let minors = on.x * on.y + on.y * on.z + on.z * on.x - off.dot(off);
        let (trace, determinant) = (whole - 2.0 * f, minors - f * whole + f * f);
        // Bodies deep in each other may have no least there; then less of a step goes down all the same.
        let least = 0.5 * (trace - greater(trace * trace - 4.0 * determinant, 0.0).sqrt());
        let lift = greater(1e-3 * size - least, 0.0);
        let determinant = determinant + lift * (trace + lift);
        (pushed * (trace + lift + f) - bend.times(pushed)) * (1.0 / determinant)
    }
}

/// One body of each pair, see [`Ellipsoid`].
#[derive(Clone, Debug)]
struct Body {
    squared: Columns<6>,
    product: Column,
    flattest: Column,
    inverse_inertia: Columns<6>,
}

/// Pairs of ellipsoids side by side.
#[derive(Clone, Debug)]
pub struct Pairs {
    len: usize,
    /// Rows that have set out.
    begun: usize,
    /// What each row stands for, by whoever put it there.
    pub name: [u32; ROWS],
    /// The numbers of its bodies.
    number: [[u32; 2]; ROWS],
    bodies: [Body; 2],
    apart: Columns<3>,
    normal: Columns<3>,
    overlap: Column,
    /// 1 where the last step was too short to matter.
    arrived: Column,
    /// 1 where the steps lead nowhere.
    lost: Column,
    /// What [`Pairs::descend`] ends with, as in [`Touch`].
    points: [Columns<3>; 2],
    radii: Columns<2>,
    force: Columns<3>,
    torques: [Columns<3>; 2],
    turning: Column,
    looks: usize,
}

impl Default for Pairs {
    fn default() -> Self {
        const BODY: Body = Body { squared: [ZERO; 6], product: ZERO, flattest: ZERO, inverse_inertia: [ZERO; 6] };
        const VECTOR: Columns<3> = [ZERO; 3];
        Self {
            len: 0,
            begun: 0,
            name: [0; ROWS],
            number: [[0; 2]; ROWS],
            bodies: [BODY; 2],
            apart: VECTOR,
            normal: VECTOR,
            overlap: ZERO,
            arrived: ZERO,
            lost: ZERO,
            points: [VECTOR; 2],
            radii: [ZERO; 2],
            force: VECTOR,
            torques: [VECTOR; 2],
            turning: ZERO,
            looks: 0,
        }
    }
}

impl Pairs {
    /// Whether there is no room for another.
    pub fn is_full(&self) -> bool {
        self.len == ROWS
    }

    /// Whether so many are left that it is time for [`Pairs::descend`].
    pub fn is_rich(&self) -> bool {
        self.len > ROWS / 4 * 3
    }

    /// Leaves all out.
    pub fn clear(&mut self) {
        (self.len, self.begun) = (0, 0);
    }

    /// Rows in use.
    #[inline(always)]
    pub fn rows(&self) -> usize {
        self.len.min(ROWS)
    }

    /// Takes a pair of bodies by their numbers; there must be room.
    #[inline]
    pub fn push(&mut self, name: u32, number: [u32; 2], bodies: [&Ellipsoid; 2], apart: DVec3) {
        let i = self.len;
        let [one, two] = &mut self.bodies;
        bodies[0].squared.set(&mut one.squared, i);
        bodies[1].squared.set(&mut two.squared, i);
        set(&mut self.apart, i, apart);
        (self.name[i], self.number[i]) = (name, number);
        self.len = i + 1;
    }

    /// Lets those set out that came last, and keeps the rows whose bodies may be nearer than `reach` [m].
    ///
    /// They set out from the normal of the place where Perram and Wertheim 1985 put the contact, exact for spheres; the overlap along it is one that the
    /// bodies have at most.
    pub fn sieve(&mut self, reach: f64) {
        let mut kept = self.begun;
        begin(self);
        for i in self.begun..self.rows() {
            if self.overlap[i] > -reach {
                self.shift(i, kept);
                kept += 1;
            }
        }
        (self.len, self.begun) = (kept, kept);
    }

    /// Puts row `from` where row `to` was.
    fn shift(&mut self, from: usize, to: usize) {
        (self.name[to], self.number[to]) = (self.name[from], self.number[from]);
        for body in &mut self.bodies {
            for column in &mut body.squared {
                column[to] = column[from];
            }
        }
        for k in 0..3 {
            self.apart[k][to] = self.apart[k][from];
            self.normal[k][to] = self.normal[k][from];
        }
        self.overlap[to] = self.overlap[from];
    }

    /// Goes to where the overlap is least, or to where it tells that the gap is `reach` [m] or more; `bodies` by their numbers.
    pub fn descend<'a>(&mut self, reach: f64, bodies: impl Fn(u32) -> &'a Ellipsoid) {
        let n = self.rows();
        for (i, number) in self.number[..n].iter().enumerate() {
            for (columns, number) in self.bodies.iter_mut().zip(number) {
                let body = bodies(*number);
                body.inverse_inertia.set(&mut columns.inverse_inertia, i);
                (columns.product[i], columns.flattest[i]) = (body.product, body.flattest);
            }
        }
        (self.arrived, self.lost, self.looks) = (ZERO, ZERO, 2);
        while self.looks < 2 + STEPS && self.arrived[..n].contains(&0.0) {
            step(self, reach);
            self.looks += 1;
        }
        end(self);
    }

    /// Whether a row has arrived; otherwise it wants the search that always ends.
    #[inline]
    pub fn arrived(&self, i: usize) -> bool {
        self.arrived[i] == 1.0 && self.lost[i] == 0.0
    }

    /// The overlap of a row along its normal, below 0 where there is a gap [m].
    #[inline]
    pub fn overlap(&self, i: usize) -> f64 {
        self.overlap[i]
    }

    /// How much both bodies of a row give way by turning, to a push along the normal [1/kg].
    #[inline]
    pub fn turning(&self, i: usize) -> f64 {
        self.turning[i]
    }

    /// Where a row touches.
    #[inline]
    pub fn touch(&self, i: usize) -> Touch {
        Touch {
            normal: vector(&self.normal, i),
            overlap: self.overlap[i],
            points: [vector(&self.points[0], i), vector(&self.points[1], i)],
            radii: [self.radii[0][i], self.radii[1][i]],
            rounding: Rounding {
                force: vector(&self.force, i),
                torques: [vector(&self.torques[0], i), vector(&self.torques[1], i)],
            },
            looks: self.looks,
        }
    }
}

#[multiversion(targets = "simd")]
fn begin(pairs: &mut Pairs) {
    for i in pairs.begun.min(ROWS)..pairs.rows() {
        let (first, second) = (Symmetric::at(&pairs.bodies[0].squared, i), Symmetric::at(&pairs.bodies[1].squared, i));
        let apart = vector(&pairs.apart, i);
        // Both reaches by the same length: only their ratio counts.
        let near = apart.dot(first.times(apart)).sqrt();
        let far = apart.dot(second.times(apart)).sqrt();
        let middle = Symmetric { on: first.on * far + second.on * near, off: first.off * far + second.off * near };
        let normal = middle.adjugate().times(apart);
        let length = normal.dot(normal).sqrt();
        let normal = if length > 0.0 { normal * (1.0 / length) } else { DVec3::Z };
        set(&mut pairs.normal, i, normal);
        let reaches = [normal.dot(first.times(normal)).sqrt(), normal.dot(second.times(normal)).sqrt()];
        pairs.overlap[i] = reaches[0] + reaches[1] - normal.dot(apart);
    }
}

/// A Newton step of every row that has not arrived.
#[multiversion(targets = "simd")]
fn step(pairs: &mut Pairs, reach: f64) {
    for i in 0..pairs.rows() {
        let (first, second) = (Symmetric::at(&pairs.bodies[0].squared, i), Symmetric::at(&pairs.bodies[1].squared, i));
        let (normal, apart) = (vector(&pairs.normal, i), vector(&pairs.apart, i));
        let look = Look::at(normal, &first, &second, apart);
        let size = apart.dot(apart).sqrt();
        let (a, b) = (1.0 / look.reach[0], 1.0 / look.reach[1]);
        let bend = first.bend(look.points[0], a).plus(&second.bend(look.points[1], b));
        let way = look.answer(&bend, -look.beside, size);
        let squared = way.dot(way);
        let longest = LONGEST * LONGEST;
        let to = normal + way * if squared > longest { (longest / squared).sqrt() } else { 1.0 };
        let to = to * (1.0 / to.dot(to).sqrt());
        let near = squared < ARRIVED * ARRIVED;
        let apart = look.overlap <= -reach;
        let there = pairs.arrived[i];
        let stays = there > 0.0 || apart;
        set(&mut pairs.normal, i, if stays { normal } else { to });
        // Along the way down the overlap falls.
        let grows = look.overlap > pairs.overlap[i] + 1e-12 * size;
        pairs.lost[i] = if grows { 1.0 } else { pairs.lost[i] };
        pairs.overlap[i] = look.overlap;
        pairs.arrived[i] = if near || apart { 1.0 } else { there };
    }
}

/// What is told of every row where it has arrived, by a last step so short that points go along it as the surfaces bend.
#[multiversion(targets = "simd")]
fn end(pairs: &mut Pairs) {
    for i in 0..pairs.rows() {
        let (first, second) = (Symmetric::at(&pairs.bodies[0].squared, i), Symmetric::at(&pairs.bodies[1].squared, i));
        let (normal, apart) = (vector(&pairs.normal, i), vector(&pairs.apart, i));
        let look = Look::at(normal, &first, &second, apart);
        let (a, b) = (1.0 / look.reach[0], 1.0 / look.reach[1]);
        let bends = (first.bend(look.points[0], a), second.bend(look.points[1], b));
        let (bend, size) = (bends.0.plus(&bends.1), apart.dot(apart).sqrt());
        let way = look.answer(&bend, -look.beside, size);
        let overlap = look.overlap + 0.5 * way.dot(look.beside);
        let (p1, p2) = (look.points[0] + bends.0.times(way), look.points[1] + bends.1.times(way));
        let to = normal + way;
        let normal = to * (1.0 / to.dot(to).sqrt());
        let beside = p1 + p2 - apart - normal * overlap;
        let [one, two] = &pairs.bodies;
        let (r1, g1) = roundness((one.product[i], one.flattest[i]), normal, p1);
        let (r2, g2) = roundness((two.product[i], two.flattest[i]), normal, p2);
        // Of R = r1 r2 / (r1 + r2).
        let share = (r2 / (r1 + r2), r1 / (r1 + r2));
        let (g1, g2) = (g1 * (share.0 * share.0), g2 * (share.1 * share.1));
        let force = look.answer(&bend, g1 + g2, size);
        let torques = (g1 - bends.0.times(force), g2 - bends.1.times(force));
        set(&mut pairs.torques[0], i, p1.cross(force) + normal.cross(torques.0));
        set(&mut pairs.torques[1], i, p2.cross(force) + normal.cross(torques.1));
        set(&mut pairs.force, i, force);
        let points = (p1 - beside * share.1, beside * share.0 - p2);
        set(&mut pairs.points[0], i, points.0);
        set(&mut pairs.points[1], i, points.1);
        let inertia = (Symmetric::at(&one.inverse_inertia, i), Symmetric::at(&two.inverse_inertia, i));
        let levers = (points.0.cross(normal), points.1.cross(normal));
        pairs.turning[i] = levers.0.dot(inertia.0.times(levers.0)) + levers.1.dot(inertia.1.times(levers.1));
        (pairs.radii[0][i], pairs.radii[1][i]) = (r1, r2);
        set(&mut pairs.normal, i, normal);
        pairs.overlap[i] = overlap;
    }
}
