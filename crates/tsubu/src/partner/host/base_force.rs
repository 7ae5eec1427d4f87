//! What a structure does to its base.

use super::{Drive, Host};

impl Host {
    /// Force of the structure on its base along the direction of its motion at `time` [s], the end of the last step:
    /// r . (K (q - r y) + C (q' - r y')) [N]; of a shaker what grains do to it.
    pub fn base_force(&self, time: f64) -> f64 {
        if self.shaker {
            return self.grain_force;
        }
        let Drive { y, y_rate, .. } = self.drive(time);
        let stretch = |j: usize| self.q[j] - self.driven[j] * y;
        let rate = |j: usize| self.v[j] - self.driven[j] * y_rate;
        let force = |i: usize| -> f64 {
            let row = i * self.n;
            let linear: f64 =
                (0..self.n).map(|j| self.stiffness[row + j] * stretch(j) + self.damping[row + j] * rate(j)).sum();
            linear + self.cubic * stretch(i).powi(3)
        };
        (0..self.n).filter(|&i| self.driven[i] != 0.0).map(|i| self.driven[i] * force(i)).sum()
    }
}
