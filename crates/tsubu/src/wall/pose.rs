//! Where a wall is and how it moves.

use glam::{DQuat, DVec3};

/// Place and motion of a wall against the place it was drawn at: x = centre + offset + R (x0 - centre).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The centre of rotation as drawn [m]; never changes.
    pub centre: DVec3,
    /// Displacement of the centre of rotation [m].
    pub offset: DVec3,
    /// Rotation R since time 0.
    pub rotation: DQuat,
    /// Velocity of the centre of rotation [m/s].
    pub velocity: DVec3,
    /// Spin [rad/s].
    pub spin: DVec3,
}

impl Pose {
    /// As drawn and at rest.
    pub fn at_rest(centre: DVec3) -> Self {
        Self { centre, offset: DVec3::ZERO, rotation: DQuat::IDENTITY, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }

    /// Where the centre of rotation is now [m].
    #[inline]
    pub fn origin(&self) -> DVec3 {
        self.centre + self.offset
    }

    /// A point of the world, seen in the frame the wall was drawn in [m].
    #[inline]
    pub fn to_own(&self, point: DVec3) -> DVec3 {
        if self.turned() {
            self.centre + self.rotation.conjugate() * (point - self.origin())
        } else {
            // Not by way of the centre: a wall that never turns must not feel the rounding of a far centre.
            point - self.offset
        }
    }

    /// A drawn point, where it is now [m].
    #[inline]
    pub fn to_world(&self, point: DVec3) -> DVec3 {
        if self.turned() { self.origin() + self.rotation * (point - self.centre) } else { point + self.offset }
    }

    /// A drawn direction as it points now.
    #[inline]
    pub fn direction(&self, drawn: DVec3) -> DVec3 {
        if self.turned() { self.rotation * drawn } else { drawn }
    }

    /// A direction of the world in the frame the wall was drawn in.
    #[inline]
    pub fn own_direction(&self, world: DVec3) -> DVec3 {
        if self.turned() { self.rotation.conjugate() * world } else { world }
    }

    /// Velocity of the wall's material at a point of the world [m/s]: v + w x (x - origin).
    #[inline]
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(point - self.origin())
    }

    /// Greatest change of any unit vector fixed to the wall since `reference` [-]: 2 sin(angle / 2).
    pub fn turn_since(&self, reference: &Self) -> f64 {
        // Both vectors parts of the relative quaternion: sin(angle / 2) without the loss of an arc cosine near zero.
        let relative = self.rotation * reference.rotation.conjugate();
        2.0 * relative.xyz().length().min(1.0)
    }

    /// Offset and rotation as plain numbers, for checkpoints.
    pub fn place(&self) -> [f64; 7] {
        let (o, q) = (self.offset, self.rotation);
        [o.x, o.y, o.z, q.x, q.y, q.z, q.w]
    }

    /// Takes offset and rotation from [`Pose::place`].
    pub fn set_place(&mut self, place: [f64; 7]) {
        let [x, y, z, i, j, k, w] = place;
        self.offset = DVec3::new(x, y, z);
        self.rotation = DQuat::from_xyzw(i, j, k, w);
    }

    #[inline]
    fn turned(&self) -> bool {
        self.rotation != DQuat::IDENTITY
    }
}
