//! A shaker: walls that move as the base says, whatever grains do to them. What the grains take is work of the base.

use super::Host;
use crate::ledger::{Account, Ledger};
use tsubu_scene::plan::Signal;

impl Host {
    /// Replaces what the base does; the clock begins anew.
    pub fn shake(&mut self, base: Signal) {
        self.base = Some(base);
        self.begin_anew();
    }

    /// Where the base is at `time` [s].
    pub(super) fn follow_base(&mut self, time: f64) {
        let (y, rate) = self.base(time);
        (self.q[0], self.v[0]) = (y, rate);
    }

    /// What it takes to move the walls at this `rate` [m/s] against the grains [W].
    pub(super) fn power_of_shaker(&self, rate: f64) -> [f64; 3] {
        [-self.felt[0] * rate, 0.0, 0.0]
    }

    /// A step from `time` under a constant force of the grains [N], which does its work over the way gone.
    pub(super) fn shaken_step(&mut self, time: f64, dt: f64, grain_force: f64, ledger: &mut Ledger) {
        let before = self.q[0];
        self.follow_base(time + dt);
        ledger.post(Account::BaseWork, -self.felt[0] * (self.q[0] - before));
        self.grain_force = grain_force;
        self.power = self.powers(self.drive(time + dt));
    }
}
