//! Contacts of superellipsoids.
//!
//! Neighbour lists and the narrow phase see the sphere that holds a body. What touches there is looked at again: where the surfaces meet, and how
//! round each is. The law then gets two spheres that are as round, with the centres that such spheres have; forces and torques on these are
//! carried over to the bodies. Scenes without superellipsoids pass all of this by.

use super::bodies::Bodies;
use super::contact_batch::ContactBatch;
use super::contact_forces::ForceInput;
use super::narrow_phase::{Spheres, TouchingPair, TouchingPairs};
use crate::contact::Law;
use crate::contact::chunk::{Chunk, Column};
use crate::neighbours::block::{BlockList, Pair};
use crate::polyhedron::with_round;
use crate::superellipsoid::ellipsoids::{Ellipsoid, Pairs};
use crate::superellipsoid::touch::{Rounding, Touch, touch};
use glam::DVec3;

/// A pair of which one at least is no sphere.
#[derive(Clone, Copy, Debug)]
struct Shaped {
    /// Number in the neighbour list.
    pair: u32,
    touch: Touch,
    /// How much both bodies give way by turning, see [`super::bodies::Bodies::turning`] [1/kg].
    turning: f64,
}

/// The pairs of a block of which one at least is no sphere, in the order of the list.
#[derive(Clone, Debug, Default)]
pub(super) struct PairShapes {
    found: Vec<Shaped>,
    members: Vec<Member>,
    ellipsoids: Pairs,
    /// Of each row of the batch its place in `found`, or [`SPHERES`].
    rows: Vec<u32>,
}

/// A row whose bodies are both spheres.
const SPHERES: u32 = u32::MAX;

/// A grain that a block sees.
#[derive(Clone, Copy, Debug)]
struct Member {
    /// Itself, or the ellipsoid with its semi-axes.
    ellipsoid: Ellipsoid,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Form {
    Sphere,
    Ellipsoid,
    /// A superellipsoid with other exponents.
    Other,
    Polyhedron,
}

impl PairShapes {
    /// Looks at the pairs whose spheres touch, and leaves out those whose bodies are apart by more than a law reaches.
    pub fn find(&mut self, pairs: &mut TouchingPairs, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        self.found.clear();
        if !input.bodies.shaped() {
            return;
        }
        self.load(input, list, spheres);
        for pair in pairs.all() {
            let second = list.pairs[pair.pair as usize].second;
            let (a, b) = (&self.members[pair.first as usize], &self.members[second as usize]);
            match a.form.max(b.form) {
                Form::Sphere => {}
                Form::Ellipsoid => {
                    let apart = between(spheres, pair.first, second);
                    self.ellipsoids.push(pair.pair, [pair.first, second], [&a.ellipsoid, &b.ellipsoid], apart);
                    if self.ellipsoids.is_full() {
                        self.ellipsoids.sieve(input.laws.reach());
                        if self.ellipsoids.is_rich() {
                            self.descend(input, list, spheres);
                        }
                    }
                }
                Form::Other => self.search(pair.pair, input, list, spheres),
                Form::Polyhedron => self.search_faceted(pair.pair, input, list, spheres),
            }
        }
        self.ellipsoids.sieve(input.laws.reach());
        self.descend(input, list, spheres);
        if input.bodies.powers() || input.bodies.faceted() {
            self.found.sort_unstable_by_key(|shaped| shaped.pair);
        }
        let (mut k, found, members) = (0, &self.found, &self.members);
        pairs.keep(|pair| {
            let touches = found.get(k).is_some_and(|shaped| shaped.pair == pair.pair);
            k += usize::from(touches);
            let sphere = |local: u32| members[local as usize].form == Form::Sphere;
            touches || sphere(pair.first) && sphere(list.pairs[pair.pair as usize].second)
        });
    }

    /// Takes the grains of a block.
    fn load(&mut self, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        self.members.clear();
        self.members.extend((0..).zip(&list.grain_at).map(|(local, grain)| {
            match input.bodies.superellipsoid(*grain as usize) {
                Some((body, shape)) => Member {
                    ellipsoid: body.ellipsoid,
                    form: if shape.is_ellipsoid() { Form::Ellipsoid } else { Form::Other },
                },
                None => Member {
                    ellipsoid: Ellipsoid::sphere(spheres.at(local)[3]),
                    form: if input.bodies.polyhedron(*grain as usize).is_some() {
                        Form::Polyhedron
                    } else {
                        Form::Sphere
                    },
                },
            }
        }));
    }

    /// Where the ellipsoids touch that are near each other.
    fn descend(&mut self, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        let reach = input.laws.reach();
        let members = &self.members;
        self.ellipsoids.descend(reach, |local| &members[local as usize].ellipsoid);
        for i in 0..self.ellipsoids.rows() {
            let pair = self.ellipsoids.name[i];
            if !self.ellipsoids.arrived(i) {
                self.search(pair, input, list, spheres);
            } else if self.ellipsoids.overlap(i) > -reach {
                let (touch, turning) = (self.ellipsoids.touch(i), self.ellipsoids.turning(i));
                self.found.push(Shaped { pair, touch, turning });
            }
        }
        self.ellipsoids.clear();
    }

    /// Where one pair touches, of any bodies.
    fn search(&mut self, pair: u32, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        let Pair { first, second } = list.pairs[pair as usize];
        let [a, b] = [first, second].map(|local| {
            let member = &self.members[local as usize];
            let turned = match member.form {
                Form::Other => input.bodies.outline(list.grain_at[local as usize] as usize),
                _ => None,
            };
            turned.unwrap_or_else(|| member.ellipsoid.outline())
        });
        if let Some(touch) = touch([&a, &b], between(spheres, first, second), input.laws.reach()) {
            let turning = self.turning(&touch, pair, input, list);
            self.found.push(Shaped { pair, touch, turning });
        }
    }

    /// Where a superellipsoid touches a polyhedron.
    fn search_faceted(&mut self, pair: u32, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        let Pair { first, second } = list.pairs[pair as usize];
        let outline = |local: u32| input.bodies.outline(list.grain_at[local as usize] as usize);
        let polyhedron = |local: u32| input.bodies.polyhedron(list.grain_at[local as usize] as usize);
        let (apart, reach) = (between(spheres, first, second), input.laws.reach());
        let touch = match (polyhedron(first), polyhedron(second)) {
            (Some(body), _) => outline(second).and_then(|round| with_round::touched(&body, &round, apart, reach)),
            (_, Some(body)) => outline(first).and_then(|round| with_round::touch(&round, &body, apart, reach)),
            _ => None,
        };
        if let Some(touch) = touch {
            let turning = self.turning(&touch, pair, input, list);
            self.found.push(Shaped { pair, touch, turning });
        }
    }

    /// How much both bodies of a pair give way by turning.
    #[inline]
    fn turning(&self, touch: &Touch, pair: u32, input: &ForceInput, list: &BlockList) -> f64 {
        let Pair { first, second } = list.pairs[pair as usize];
        let of = |local: u32, point: DVec3| {
            let member = &self.members[local as usize];
            if member.form == Form::Sphere {
                // Of a clump perhaps.
                return input.bodies.turning(list.grain_at[local as usize] as usize, DVec3::ZERO, touch.normal);
            }
            if member.form == Form::Polyhedron {
                return input.bodies.turning(list.grain_at[local as usize] as usize, point, touch.normal);
            }
            let lever = point.cross(touch.normal);
            lever.dot(member.ellipsoid.inverse_inertia.times(lever))
        };
        of(first, touch.points[0]) + of(second, touch.points[1])
    }

    /// Leaves out what is beyond the reach of its own law.
    pub fn part(&self, pairs: &mut TouchingPairs, reaches: &[f64]) {
        if !self.found.is_empty() {
            pairs.keep_by_law(|law, pair| self.of(pair.pair).is_none_or(|touch| touch.overlap > -reaches[law]));
        }
    }

    /// Where a pair of the list touches; `None`: both are spheres.
    pub fn of(&self, pair: u32) -> Option<&Touch> {
        let k = self.found.binary_search_by_key(&pair, |shaped| shaped.pair).ok()?;
        Some(&self.found[k].touch)
    }

    /// Puts the spheres that stand for bodies into the rows of a batch.
    pub fn gather(&mut self, batch: &mut ContactBatch, touching: &[TouchingPair]) {
        batch.shifted = !self.found.is_empty();
        if !batch.shifted {
            return;
        }
        self.rows.clear();
        let mut k = touching.first().map_or(0, |pair| self.found.partition_point(|shaped| shaped.pair < pair.pair));
        for (r, pair) in touching.iter().enumerate() {
            while self.found.get(k).is_some_and(|shaped| shaped.pair < pair.pair) {
                k += 1;
            }
            let Some(Shaped { touch: Touch { normal, overlap, points, radii, .. }, turning, .. }) =
                self.found.get(k).filter(|shaped| shaped.pair == pair.pair)
            else {
                (0..2).for_each(|body| batch.set_shift(body, r, DVec3::ZERO));
                self.rows.push(SPHERES);
                continue;
            };
            self.rows.push(k as u32);
            let shifts = [points[0] - *normal * radii[0], points[1] + *normal * radii[1]];
            let relative = Chunk::vector(&batch.relative_velocity, r);
            let [one, two] = &batch.spin;
            let relative = relative + Chunk::vector(one, r).cross(shifts[0]) - Chunk::vector(two, r).cross(shifts[1]);
            Chunk::set(&mut batch.relative_velocity, r, relative);
            Chunk::set(&mut batch.branch, r, *normal * (radii[0] + radii[1] - overlap));
            batch.inverse_mass[r] += turning;
            for body in 0..2 {
                batch.radius[body][r] = radii[body];
                batch.set_shift(body, r, shifts[body]);
            }
        }
    }
}

impl PairShapes {
    /// Gives rows of spheres the mass that their bodies show, see [`Bodies::show_mass`]; the others have it from [`PairShapes::gather`].
    pub fn show_mass(&self, bodies: &Bodies, batch: &mut ContactBatch, list: &BlockList) {
        if !batch.shifted {
            bodies.show_mass(batch, list, false, |_| true);
        } else if self.rows.contains(&SPHERES) {
            bodies.show_mass(batch, list, false, |r| self.rows[r] == SPHERES);
        }
    }

    /// After the law: adds what moves and turns bodies to where they are less round, see [`Rounding`].
    pub fn round(&self, batch: &mut ContactBatch, law: &Law) {
        if !batch.shifted {
            return;
        }
        let slopes = law.energy_slopes(&batch.chunk);
        for (r, row) in self.rows.iter().enumerate().filter(|(_, row)| **row != SPHERES) {
            let Rounding { force, torques } = &self.found[*row as usize].touch.rounding;
            let (force, slope) = (*force, slopes[r]);
            // The torque of this force about the centre of the body is in the torque already.
            let torques = [torques[0] - batch.shift(0, r).cross(force), torques[1] + batch.shift(1, r).cross(force)];
            add(&mut batch.force, r, force * slope);
            for (column, torque) in batch.torque.iter_mut().zip(torques) {
                add(column, r, torque * slope);
            }
        }
    }
}

/// From the centre of one grain to that of another [m].
fn between(spheres: &Spheres, first: u32, second: u32) -> DVec3 {
    let (p, q) = (spheres.at(first), spheres.at(second));
    DVec3::new(q[0] - p[0], q[1] - p[1], q[2] - p[2])
}

pub(super) fn add(column: &mut [Column; 3], r: usize, more: DVec3) {
    let sum = Chunk::vector(column, r) + more;
    Chunk::set(column, r, sum);
}
