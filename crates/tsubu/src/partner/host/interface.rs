//! Where walls hang on a structure: a point that moves and turns with it.

use super::Host;
use glam::{DMat3, DQuat, DVec3};
use tsubu_scene::plan::{self, Structure};

/// A point of a structure. With coordinates q: displacement u = sum of t q, rotation R = exp(sum of r q), at any angle.
///
/// The spin of R is w = J sum of r q' with J the left Jacobian of the rotation vector, so that a force F and a torque T about the point
/// do the work of t . F + r . J^T T on each coordinate: what the grains lose the structure gains, however far it turns.
#[derive(Clone, Debug)]
pub struct Interface {
    name: Option<String>,
    point: DVec3,
    translation: Vec<DVec3>,
    rotation: Vec<DVec3>,
}

/// Where an interface is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// As drawn [m].
    pub point: DVec3,
    /// Displacement [m].
    pub offset: DVec3,
    /// Rotation since time 0; nothing where it cannot turn.
    pub rotation: Option<DQuat>,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Spin [rad/s].
    pub spin: DVec3,
}

impl Interface {
    /// All of a host: first what moves along its direction, then those with names. Where an interface is what is told, `seen` becomes
    /// its displacement along the direction.
    pub(super) fn all(plan: &plan::Host, seen: &mut Vec<f64>) -> Vec<Self> {
        let direction = DVec3::from_array(plan.direction);
        let vectors = |list: &[[f64; 3]]| -> Vec<DVec3> { list.iter().copied().map(DVec3::from_array).collect() };
        if let Some(told) = plan.at.as_ref().and_then(|at| plan.interface.get(at)) {
            *seen = vectors(&told.translation).into_iter().map(|t| t.dot(direction)).collect();
        }
        let along = Self {
            name: None,
            point: DVec3::ZERO,
            translation: seen.iter().map(|w| *w * direction).collect(),
            rotation: Vec::new(),
        };
        let named = plan.interface.iter().map(|(name, interface)| Self {
            name: Some(name.clone()),
            point: DVec3::from_array(interface.point),
            translation: vectors(&interface.translation),
            rotation: vectors(&interface.rotation),
        });
        let swings = match &plan.structure {
            Structure::Pendulum { pivot, axis, .. } => Some(Self {
                name: Some("body".to_owned()),
                point: DVec3::from_array(*pivot),
                translation: vec![DVec3::ZERO],
                rotation: vec![DVec3::from_array(*axis)],
            }),
            _ => None,
        };
        std::iter::once(along).chain(swings).chain(named).collect()
    }
}

impl Host {
    /// Number of the interface of this name; without a name of that which moves along the direction, or of a pendulum's body.
    pub fn interface(&self, name: Option<&str>) -> Option<usize> {
        match (name, self.weight) {
            (None, None) => Some(0),
            (None, Some(_)) => Some(1),
            (name, _) => self.interfaces.iter().position(|interface| interface.name.as_deref() == name),
        }
    }

    /// Displacement of an interface along the host's direction a unit of each coordinate.
    pub(super) fn along(&self, interface: usize) -> Vec<f64> {
        let direction = DVec3::from_array(self.direction);
        self.interfaces[interface].translation.iter().map(|t| t.dot(direction)).collect()
    }

    /// Where an interface is now.
    pub fn placed(&self, interface: usize) -> Placed {
        let Interface { point, translation, rotation, .. } = &self.interfaces[interface];
        let sum = |shape: &[DVec3], values: &[f64]| -> DVec3 {
            shape.iter().zip(values).fold(DVec3::ZERO, |sum, (shape, value)| sum + *shape * *value)
        };
        let (offset, velocity) = (sum(translation, &self.q), sum(translation, &self.v));
        if rotation.is_empty() {
            return Placed { point: *point, offset, rotation: None, velocity, spin: DVec3::ZERO };
        }
        let turn = sum(rotation, &self.q);
        let spin = jacobian(turn) * sum(rotation, &self.v);
        Placed { point: *point, offset, rotation: Some(DQuat::from_scaled_axis(turn)), velocity, spin }
    }

    /// Hears what grains do to walls at an interface: a force [N], and its torque [N.m] about a point [m].
    pub fn hear(&mut self, interface: usize, force: DVec3, torque: DVec3, about: DVec3) {
        self.heard.0 += force.dot(DVec3::from_array(self.direction));
        let Interface { point, translation, rotation, .. } = &self.interfaces[interface];
        for (heard, shape) in self.heard.1.iter_mut().zip(translation) {
            *heard += shape.dot(force);
        }
        if !rotation.is_empty() {
            let turn = rotation.iter().zip(&self.q).fold(DVec3::ZERO, |sum, (shape, q)| sum + *shape * *q);
            let origin = translation.iter().zip(&self.q).fold(*point, |sum, (shape, q)| sum + *shape * *q);
            let turned = jacobian(turn).transpose() * (torque + (about - origin).cross(force));
            for (heard, shape) in self.heard.1.iter_mut().zip(rotation) {
                *heard += shape.dot(turned);
            }
        }
    }

    /// The least mass that an interface shows to a push in any direction through its point [kg].
    pub fn shown_mass(&self, interface: usize) -> f64 {
        let translation = &self.interfaces[interface].translation;
        let column = |axis: usize| -> Vec<f64> { translation.iter().map(|t| t[axis]).collect() };
        // The trace bounds the largest eigenvalue from above, and is it where the motion has one direction.
        1.0 / (0..3).map(|axis| self.mobility(&column(axis))).sum::<f64>()
    }
}

/// Left Jacobian of a rotation vector: w = J dr/dt = dr/dt + (1 - cos a)/a^2 r x dr/dt + (a - sin a)/a^3 r x (r x dr/dt).
fn jacobian(r: DVec3) -> DMat3 {
    let square = r.length_squared();
    let (first, second) = if square < 1e-4 {
        // Series to a relative error below 1e-12.
        (0.5 - square / 24.0 + square * square / 720.0, 1.0 / 6.0 - square / 120.0 + square * square / 5040.0)
    } else {
        let a = square.sqrt();
        ((1.0 - a.cos()) / square, (a - a.sin()) / (square * a))
    };
    let cross = DMat3::from_cols(DVec3::new(0.0, r.z, -r.y), DVec3::new(-r.z, 0.0, r.x), DVec3::new(r.y, -r.x, 0.0));
    DMat3::IDENTITY + cross * first + cross * cross * second
}

#[cfg(test)]
mod tests {
    use super::jacobian;
    use glam::{DQuat, DVec3};

    /// The spin is that of the rotation: central differences of exp(r(t)) give it, small angles and large ones. Control: the rate of
    /// the rotation vector alone does not.
    #[test]
    fn spin_is_that_of_the_rotation() {
        for size in [1e-3, 9e-3, 1.1e-2, 0.7, 2.5] {
            let at = |t: f64| size * DVec3::new(1.0 + 0.3 * t, 0.4 - t, 2.0 * t);
            let rate = size * DVec3::new(0.3, -1.0, 2.0);
            let h = 1e-5;
            let turn = DQuat::from_scaled_axis(at(h)) * DQuat::from_scaled_axis(at(-h)).conjugate();
            let spin = turn.to_scaled_axis() / (2.0 * h);
            assert!((jacobian(at(0.0)) * rate - spin).length() < 1e-7 * size, "{size}");
            assert!((rate - spin).length() > 1e-2 * size * size, "{size}");
        }
    }
}
