//! Two bodies in contact: the constants of their materials, and what the verdict on the time step asks of them.

/// Two materials in contact, under a law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constants {
    /// Effective modulus E*: 1/E* = (1-ν1^2)/E1 + (1-ν2^2)/E2 [Pa].
    pub effective_modulus: f64,
    /// Effective shear modulus G*: 1/G* = (2-ν1)/G1 + (2-ν2)/G2 [Pa].
    pub shear_modulus: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
    /// Friction coefficient [-].
    pub friction: f64,
    /// Rolling friction coefficient [-].
    pub rolling: f64,
    /// Twisting friction coefficient [-].
    pub twisting: f64,
    /// Surface energy of one face [J/m^2].
    pub surface_energy: f64,
    /// Cohesion, in the unit of its part.
    pub cohesion: f64,
    /// Exponent p of the elastic force k d^p, set by the normal part.
    pub exponent: f64,
    /// Number of the damping part, set by it.
    pub damping: f64,
    /// Tangential over normal dashpot [-], set by the tangential part.
    pub shear_damping: f64,
}

/// Two bodies in contact, for the verdict on the time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pair {
    /// Their materials.
    pub constants: Constants,
    /// Effective radius R* = 1/(1/R1 + 1/R2) [m].
    pub radius: f64,
    /// Effective mass m* = 1/(1/m1 + 1/m2) [kg].
    pub mass: f64,
    /// k of the elastic force k d^p in loading, set by the normal part [N/m^p].
    pub stiffness: f64,
    /// The largest k with which it ever acts, where that is not the same, set by the normal part [N/m^p].
    pub stiffest: f64,
    /// c of the damping c d^q d', set by the damping part; zero without one.
    pub damping: f64,
    /// q, set by the damping part [-].
    pub damping_exponent: f64,
    /// Largest dashpot of a film of liquid [N.s/m]; zero without one.
    pub film: f64,
    /// Momentum that the film takes from an approach from its reach to touch, whatever its speed [N.s].
    pub film_takes: f64,
}

impl Pair {
    /// Undamped contact time at impact speed `v` [s]: pi sqrt(m*/k) (p = 1), 2.943275 d_max / v (p = 3/2), and for any p
    /// 2 I d_max / v with I the integral of 1/sqrt(1 - x^(p+1)) from 0 to 1; with the largest k, as it is for the time step.
    pub fn contact_time(&self, v: f64) -> f64 {
        let stiff = Self { stiffness: self.stiffness.max(self.stiffest), ..*self };
        match self.constants.exponent {
            1.0 => std::f64::consts::PI * (stiff.mass / stiff.stiffness).sqrt(),
            1.5 => 2.943_275 * stiff.largest_overlap(v) / v,
            p => 2.0 * approach(p) * stiff.largest_overlap(v) / v,
        }
    }

    /// Largest overlap at impact speed `v`, undamped [m]: ((p+1) m* v^2 / (2 k))^(1/(p+1)).
    pub fn largest_overlap(&self, v: f64) -> f64 {
        match self.constants.exponent {
            1.0 => v * (self.mass / self.stiffness).sqrt(),
            p => (0.5 * (p + 1.0) * self.mass * v * v / self.stiffness).powf(1.0 / (p + 1.0)),
        }
    }

    /// Impact speed at which the largest overlap is `depth`, undamped [m/s].
    pub fn speed_of(&self, depth: f64) -> f64 {
        // 1/2 m* v^2 = k d^(p+1) / (p+1).
        let p = self.constants.exponent;
        (2.0 * self.stiffness * depth.powf(p + 1.0) / ((p + 1.0) * self.mass)).sqrt()
    }

    /// Overlap at rest under a force [m]: (f / k)^(1/p).
    pub fn overlap_under(&self, force: f64) -> f64 {
        (force / self.stiffness).powf(1.0 / self.constants.exponent)
    }

    /// Damping coefficient at an overlap [N.s/m]: c d^q.
    pub fn damping_coefficient(&self, depth: f64) -> f64 {
        self.damping * depth.powf(self.damping_exponent)
    }
}

/// Time of an undamped approach under k d^p over d_max / v: the integral of 1/sqrt(1 - x^(p+1)) from 0 to 1, by the midpoint rule
/// in s with x = 1 - s^2, where nothing is singular.
fn approach(p: f64) -> f64 {
    const PIECES: u32 = 1000;
    let piece = 1.0 / f64::from(PIECES);
    let rate = |s: f64| 2.0 * s / (1.0 - (1.0 - s * s).powf(p + 1.0)).sqrt();
    (0..PIECES).map(|k| rate((f64::from(k) + 0.5) * piece) * piece).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kind of law was asked for by `exponent == 1.5`, so that every other got the contact time of a linear spring. The closed
    /// forms: pi/2 for p = 1, half of Hertz's 2.943275 for p = 3/2; a half-sine would be wrong by 11 % for p = 3.
    #[test]
    fn the_contact_time_follows_the_exponent() {
        assert!((approach(1.0) / std::f64::consts::FRAC_PI_2 - 1.0).abs() < 1e-6);
        assert!((approach(1.5) / (0.5 * 2.943_275) - 1.0).abs() < 1e-6);
        let constants = Constants { exponent: 3.0, ..Constants::default() };
        let pair = Pair { constants, mass: 2e-6, stiffness: 5e12, ..Pair::default() };
        // m d'' = -k d^3 from d = 0 at speed v, by small steps.
        let (v, dt) = (0.3, 1e-9);
        let (mut depth, mut speed, mut time, mut deepest) = (0.0f64, v, 0.0, 0.0f64);
        while depth >= 0.0 {
            speed -= 0.5 * dt * pair.stiffness * depth.powi(3) / pair.mass;
            depth += dt * speed;
            speed -= 0.5 * dt * pair.stiffness * depth.powi(3) / pair.mass;
            (time, deepest) = (time + dt, deepest.max(depth));
        }
        assert!((pair.largest_overlap(v) / deepest - 1.0).abs() < 1e-4, "{deepest:e}");
        let contact_time = pair.contact_time(v);
        assert!((contact_time / time - 1.0).abs() < 1e-4, "{time:e} {contact_time:e}");
        let half_sine = std::f64::consts::PI * pair.largest_overlap(v) / v;
        assert!((half_sine / time - 1.0).abs() > 0.1);
    }
}
