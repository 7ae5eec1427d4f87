//! On which side of a wall a place is, and where a grain that begins there falls.
//!
//! A drum, a cone, a shell and a mesh without open edges have an inside. A mesh that is open, as a barrel without a lid, has one
//! as far as it goes: where every way across gravity meets it an odd number of times. Before the mouth of a vessel nothing is
//! inside, but what begins there may fall into it.

use super::Wall;
use super::frustum::Frustum;
use super::half_space::HalfSpace;
use super::mesh::Mesh;
use super::surface::Surface;
use glam::{DQuat, DVec3};

/// Ways across gravity, from which an open mesh is looked at.
const WAYS: usize = 8;
/// How many of them may miss: a way that grazes an edge counts wrong.
const MISSES: usize = 1;
/// Heights at which a fall into an open mesh is looked for.
const HEIGHTS: usize = 16;
/// Steps towards a curved wall at most.
const STEPS: usize = 200;

impl Wall {
    /// Whether a point lies within a drum, cone, shell or mesh; `None` where the wall has no inside, beyond open ends, and
    /// where an open mesh does not tell. `down`: the way of gravity, a unit vector or zero.
    pub fn encloses(&self, point: DVec3, down: DVec3) -> Option<bool> {
        let own = self.pose.to_own(point);
        match &self.surface {
            _ if self.vanished() => None,
            Surface::Frustum(frustum) => frustum.encloses(own),
            Surface::Shell(shell) => Some(own.distance(shell.centre) < shell.radius),
            Surface::Mesh(mesh) if mesh.closed => Some(mesh.holds(own)),
            Surface::Mesh(mesh) => mesh.surrounds(own, &self.across(down)).then_some(true),
            Surface::HalfSpaces { .. } => None,
        }
    }

    /// Whether what falls from a point comes to the inside of a wall; `None` where it does not pass the wall.
    pub fn catches(&self, point: DVec3, down: DVec3) -> Option<bool> {
        let (own, fall) = (self.pose.to_own(point), self.pose.to_own(point + down) - self.pose.to_own(point));
        match &self.surface {
            _ if self.vanished() || down == DVec3::ZERO => None,
            Surface::Frustum(frustum) => frustum.catches(own, fall),
            Surface::Mesh(mesh) if !mesh.closed => mesh.catches(own, fall, &self.across(down)),
            Surface::Shell(_) | Surface::Mesh(_) | Surface::HalfSpaces { .. } => None,
        }
    }

    /// Whether straight below a point there is any of a curved wall or a mesh.
    pub fn lies_below(&self, point: DVec3, down: DVec3) -> bool {
        match &self.surface {
            _ if self.vanished() => false,
            Surface::Mesh(mesh) => {
                let fall = self.pose.to_own(point + down) - self.pose.to_own(point);
                !mesh.crossings(self.pose.to_own(point), fall).is_empty()
            }
            Surface::Frustum(_) | Surface::Shell(_) => {
                // Nothing is nearer than the nearest point, so this far one can go.
                let mut at = point;
                for _ in 0..STEPS {
                    let distance = self.nearest(0, at).distance;
                    if distance < 1e-3 * (at - point).length() || distance == 0.0 {
                        return true;
                    }
                    at += down * distance;
                }
                false
            }
            Surface::HalfSpaces { .. } => false,
        }
    }

    /// Whether straight below a point there is any of the wall; a plane or a box goes on without end.
    pub fn stops(&self, point: DVec3, down: DVec3) -> bool {
        match &self.surface {
            Surface::HalfSpaces { planes, .. } => {
                let (own, fall) = (self.pose.to_own(point), self.pose.to_own(point + down) - self.pose.to_own(point));
                let stops = |p: &HalfSpace| fall.dot(p.normal) < -1e-9 && (own - p.point).dot(p.normal) > 0.0;
                !self.vanished() && planes.iter().any(stops)
            }
            _ => self.lies_below(point, down),
        }
    }

    /// Directions across gravity, in the wall's own frame; without gravity on a circle that lies askew.
    fn across(&self, down: DVec3) -> Vec<DVec3> {
        let down = if down == DVec3::ZERO { DVec3::new(0.3, 0.2, -0.933_381) } else { down };
        let side = if self.in_plane { DVec3::Y.cross(down) } else { down.any_orthonormal_vector() };
        // No way along an axis: that is where edges of drawn meshes lie.
        let ways = (0..WAYS).map(|k| {
            let turn = 0.37 + std::f64::consts::TAU * k as f64 / WAYS as f64;
            let flat = if self.in_plane {
                DQuat::from_axis_angle(DVec3::Y, 0.02 * (k as f64 + 0.5) - 0.08) * if k % 2 == 0 { side } else { -side }
            } else {
                DQuat::from_axis_angle(down, turn) * side
            };
            self.pose.to_own(flat) - self.pose.to_own(DVec3::ZERO)
        });
        ways.collect()
    }
}

impl Frustum {
    /// See [`Wall::catches`]: where a fall comes abreast of an end, it is inside or beside.
    fn catches(&self, point: DVec3, fall: DVec3) -> Option<bool> {
        let (along, speed) = ((point - self.point).dot(self.axis), fall.dot(self.axis));
        let length = self.length?;
        let way = match along {
            s if s < 0.0 && speed > 1e-6 => -s / speed,
            s if s > length && speed < -1e-6 => (length - s) / speed,
            _ => return None,
        };
        self.encloses(point + fall * way * (1.0 + 1e-9))
    }
}

impl Mesh {
    /// Whether a point is within a mesh without open edges: two of three ways out cross it an odd number of times.
    fn holds(&self, point: DVec3) -> bool {
        let ways = [DVec3::new(0.8, 0.36, 0.48), DVec3::new(-0.28, 0.576, -0.768), DVec3::new(0.352, -0.936, 0.0)];
        ways.iter().filter(|way| self.crossings(point, **way).len() % 2 == 1).count() >= 2
    }

    /// Whether all ways across cross the mesh an odd number of times.
    fn surrounds(&self, point: DVec3, across: &[DVec3]) -> bool {
        let even = across.iter().filter(|way| self.crossings(point, **way).len().is_multiple_of(2));
        even.take(MISSES + 1).count() <= MISSES
    }

    /// See [`Wall::catches`]: a fall ends where it meets the mesh, which then does not tell.
    fn catches(&self, point: DVec3, fall: DVec3, across: &[DVec3]) -> Option<bool> {
        let (low, high) = self.extent();
        let corners = (0..8).map(|k| DVec3::select(glam::BVec3::new(k & 1 > 0, k & 2 > 0, k & 4 > 0), high, low));
        let depth = corners.map(|corner| (corner - point).dot(fall)).fold(0.0, f64::max);
        let landing = self.crossings(point, fall).first().copied();
        let end = landing.unwrap_or(depth);
        let heights = (0..HEIGHTS).map(|k| point + fall * (end * (k as f64 + 0.5) / HEIGHTS as f64));
        let inside = heights.into_iter().any(|place| self.surrounds(place, across));
        if inside { Some(true) } else { landing.is_none().then_some(false) }
    }
}
