//! How bodies come to be: clumps of a plan in the place of the grains that stand for them.

use super::body::Body;
use super::{Bodies, Piece};
use crate::neighbours::joined::NO_BODY;
use crate::polyhedron::{Faceted, Polyhedron};
use crate::random::{Purpose, unit, words};
use crate::sizes;
use crate::state::{Grain, Grains};
use crate::superellipsoid::Superellipsoid;
use crate::water::Submerged;
use glam::{DMat3, DQuat, DVec3};
use tsubu_scene::plan::{Clump, ClumpOrientation, Particles, Plan, Start};

impl Bodies {
    /// Puts the spheres of clumps in the place of the grains that stand for them, which get numbers one after the other; those of streams
    /// have the numbers behind, see [`super::super::sources`].
    pub fn assemble(plan: &Plan, grains: &mut Grains) -> Self {
        let clumps: Vec<Option<Clump>> = plan.particles.values().map(|group| group.shape.clump()).collect();
        let mut bodies = Self { plane: plan.dimension == 2, locked: !plan.contact.rotation, ..Self::default() };
        if clumps.iter().all(Option::is_none) {
            return bodies;
        }
        let mut shapes: Vec<Option<u32>> = Vec::new();
        for clump in &clumps {
            let polyhedron = clump.as_ref().and_then(|clump| clump.polyhedron.as_ref());
            shapes.push(polyhedron.map(|_| bodies.polyhedra.len() as u32));
            bodies.polyhedra.extend(polyhedron.map(Polyhedron::new));
        }
        // Of diameter 1; only water looks at it.
        let in_water = |group: &Particles| plan.water.as_ref().map(|_| Submerged::of(&group.shape, 1.0));
        let seen: Vec<Submerged> =
            plan.particles.values().map(|group| in_water(group).unwrap_or(Submerged::sphere(0.5))).collect();
        let whole = std::mem::take(grains);
        for i in 0..whole.len() {
            let grain = whole.row(i);
            let (first, group) = (grains.len() as u32, grain.group as usize);
            if let Some(clump) = &clumps[group] {
                bodies.expect(clump, shapes[group], seen[group], grain.mass, 2.0 * grain.radius);
                bodies.enter(clump, &grain, first, plan).into_iter().for_each(|piece| grains.push(piece));
            } else {
                grains.push(Grain { id: first, ..grain });
                bodies.by_id.push(ALONE);
            }
        }
        for (k, group) in plan.particles.values().enumerate().filter(|(_, group)| is_stream(group)) {
            for _ in 0..group.count {
                let diameter = sizes::diameter(group, plan.seed, bodies.by_id.len() as u32);
                match &clumps[k] {
                    Some(clump) => bodies.expect(clump, shapes[k], seen[k], sizes::mass(group, diameter), diameter),
                    None => bodies.by_id.push(ALONE),
                }
            }
        }
        let shapes = || bodies.list.iter().filter_map(|body| body.superellipsoid.as_ref());
        (bodies.shaped, bodies.powers) = (shapes().next().is_some(), shapes().any(|shape| !shape.is_ellipsoid()));
        let rounding = |body: &Body| body.polyhedron.as_ref().map(Faceted::rounding);
        bodies.finest = bodies.list.iter().filter_map(rounding).reduce(f64::min).map(|radius| 2.0 * radius);
        bodies.find(grains);
        bodies.show(grains);
        bodies
    }

    /// Makes room for a body: what of it never changes.
    fn expect(&mut self, clump: &Clump, polyhedron: Option<u32>, seen: Submerged, mass: f64, diameter: f64) {
        let body = self.list.len() as u32;
        let superellipsoid = clump.superellipsoid.map(|shape| Superellipsoid {
            semi_axes: DVec3::from_array(shape.semi_axes) * diameter,
            exponents: shape.exponents,
            reach: 0.5 * diameter,
        });
        // A polygon; a superellipsoid in the plane has a depth.
        let flat = self.plane && superellipsoid.is_none();
        self.rank.push(body);
        self.list.push(Body {
            number: body,
            mass,
            equivalent_radius: clump.is_one_piece().then(|| clump.equivalent_radius(flat) * diameter),
            submerged: Submerged { radius: seen.radius * diameter, ..seen },
            added_mass: 0.0,
            moments: DVec3::from_array(clump.moments) * (mass * diameter * diameter),
            ellipsoid: superellipsoid.map(|shape| shape.ellipsoid(&DMat3::IDENTITY)).unwrap_or_default(),
            superellipsoid,
            polyhedron: polyhedron.map(|shape| Faceted::new(shape, diameter, &self.polyhedra)),
            pieces: 0..0,
            centre: DVec3::ZERO,
            velocity: DVec3::ZERO,
            acceleration: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            angular_momentum: DVec3::ZERO,
            torque: DVec3::ZERO,
            axes: DMat3::IDENTITY,
            inverse_inertia: DMat3::ZERO,
            spin: DVec3::ZERO,
            path: 0.0,
            correction: 0.0,
        });
        let piece = |(offset, _): &([f64; 3], f64)| Piece { body, offset: DVec3::from_array(*offset) * diameter };
        self.by_id.extend(clump.pieces.iter().map(piece));
    }

    /// Puts a body in the place of a grain that stands for it: its pieces, with numbers from `first` on.
    pub fn enter(&mut self, clump: &Clump, grain: &Grain, first: u32, plan: &Plan) -> Vec<Grain> {
        let (plane, pieces) = (self.plane, &self.by_id[first as usize..][..clump.pieces.len()]);
        let body = &mut self.list[self.rank[pieces[0].body as usize] as usize];
        let drawn = DQuat::from_mat3(&DMat3::from_cols_array_2d(&clump.axes)).normalize();
        let turned = match clump.orientation {
            ClumpOrientation::AsDrawn => DQuat::IDENTITY,
            ClumpOrientation::Random => anyhow(plan, grain.id),
        };
        body.orientation = (turned * drawn).normalize();
        let axes = DMat3::from_quat(body.orientation);
        let inertia = axes * DMat3::from_diagonal(body.moments) * axes.transpose();
        (body.centre, body.velocity, body.acceleration) = (grain.position, grain.velocity, grain.acceleration);
        let spin = if self.locked { DVec3::ZERO } else { grain.spin };
        (body.angular_momentum, body.torque, body.correction) = (inertia * spin, DVec3::ZERO, 0.0);
        body.follow(plane);
        let volume: f64 = clump.pieces.iter().map(|(_, radius)| radius.powi(3)).sum();
        let piece = |(k, (piece, (_, radius))): (usize, (&Piece, &([f64; 3], f64)))| {
            let arm = body.arm(piece, plane);
            Grain {
                position: body.centre + arm,
                velocity: body.velocity + body.spin.cross(arm),
                spin: body.spin,
                radius: radius * 2.0 * grain.radius,
                // Others feel the mass of the whole; shares of it make sums over grains right.
                mass: grain.mass * radius.powi(3) / volume,
                inverse_mass: 1.0 / grain.mass,
                inertia: 0.0,
                id: first + k as u32,
                ..*grain
            }
        };
        pieces.iter().zip(&clump.pieces).enumerate().map(piece).collect()
    }
}

/// A grain that is a piece of no body.
const ALONE: Piece = Piece { body: NO_BODY, offset: DVec3::ZERO };

fn is_stream(group: &Particles) -> bool {
    matches!(group.start, Start::Stream { .. })
}

/// Any orientation as likely as another (Shoemake 1992); in the plane any angle about y.
fn anyhow(plan: &Plan, id: u32) -> DQuat {
    let tau = std::f64::consts::TAU;
    let draw = |k: u64| {
        let w = words(plan.seed, Purpose::Orientation, id, k);
        [unit(w[0], w[1]), unit(w[2], w[3])]
    };
    let ([u, v], [w, _]) = (draw(0), draw(1));
    if plan.dimension == 2 {
        return DQuat::from_rotation_y(tau * u);
    }
    let (low, high) = ((1.0 - u).sqrt(), u.sqrt());
    DQuat::from_xyzw(low * (tau * v).sin(), low * (tau * v).cos(), high * (tau * w).sin(), high * (tau * w).cos())
}
