//! Steps and time.

/// Where the run is in time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    /// Time step [s].
    pub dt: f64,
    pub step: u64,
    /// Step and time [s] at which this stage began.
    pub begin: (u64, f64),
    /// Grains moved in every step so far, summed.
    pub grain_steps: u64,
    /// Whether the grains have done the first half of the next step already; never between two calls of `advance`.
    pub half_step_done: bool,
    /// Before time 0 grains settle: walls and water stand, whoever moves them.
    pub settling: bool,
}

impl Clock {
    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.time_of(self.step)
    }

    /// Time of a step of this stage [s]: steps times time step, so that it never drifts.
    pub fn time_of(&self, step: u64) -> f64 {
        let (first, begin) = self.begin;
        begin + (step - first) as f64 * self.dt
    }

    /// A stage begins here, with steps of `dt` [s].
    pub fn begin_stage(&mut self, dt: f64) {
        (self.begin, self.dt) = ((self.step, self.time()), dt);
    }

    /// Counts a step of so many grains.
    pub fn tick(&mut self, grains: usize) {
        self.step += 1;
        self.grain_steps += grains as u64;
    }
}
