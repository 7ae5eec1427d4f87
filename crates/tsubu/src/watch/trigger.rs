//! When a watch looks.

use tsubu_scene::plan;

/// Looks at `from`, `from + every`, ... up to `until`, each at the nearest step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    from: f64,
    every: f64,
    until: f64,
    dt: f64,
    /// Step with which the stage of the run began that the times count from.
    begin: u64,
}

impl Trigger {
    /// The trigger of a watch in a run with steps of `dt` [s].
    pub fn new(watch: &plan::Watch, dt: f64) -> Self {
        let until = watch.until.unwrap_or(f64::INFINITY);
        Self { from: watch.from, every: watch.every.unwrap_or(dt), until, dt, begin: 0 }
    }

    /// Events at all multiples of an interval [s].
    pub fn each(interval: f64, dt: f64) -> Self {
        Self { from: 0.0, every: interval, until: f64::INFINITY, dt, begin: 0 }
    }

    /// The same in a stage that begins with step `begin`: times count from there.
    #[must_use]
    pub fn beginning(self, begin: u64) -> Self {
        Self { begin, ..self }
    }

    /// The first look at step `now` or later; `u64::MAX` if there is none any more.
    pub fn at_or_after(&self, now: u64) -> u64 {
        self.in_stage(now.saturating_sub(self.begin)).saturating_add(self.begin)
    }

    /// The same by the steps of the stage.
    fn in_stage(&self, now: u64) -> u64 {
        if self.every <= self.dt {
            // A look falls to every step. They are not counted: there may be more of them than numbers tell apart.
            let step = now.max((self.from / self.dt).round() as u64);
            let earliest = self.from.max((step as f64 - 0.5) * self.dt);
            return if earliest > self.until { u64::MAX } else { step };
        }
        let before = ((now as f64 * self.dt - self.from) / self.every).floor().max(0.0);
        // The step nearest to the last look that is not after `now` may lie before it; that of the next one does not.
        for k in [before, before + 1.0] {
            let time = self.from + k * self.every;
            // The last look is not lost to the last digit.
            if time > self.until + 1e-9 * self.every {
                return u64::MAX;
            }
            let step = (time / self.dt).round() as u64;
            if step >= now {
                return step;
            }
        }
        now
    }

    /// The first look after step `now`.
    pub fn after(&self, now: u64) -> u64 {
        self.at_or_after(now + 1)
    }

    /// Whether there is a look at this step.
    pub fn due(&self, step: u64) -> bool {
        self.at_or_after(step) == step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looks(from: f64, every: f64, until: f64, dt: f64, last: u64) -> Vec<u64> {
        let trigger = Trigger { from, every, until, dt, begin: 0 };
        (0..=last).filter(|step| trigger.due(*step)).collect()
    }

    #[test]
    fn looks_come_when_they_are_due() {
        assert_eq!(looks(0.0, 0.3, f64::INFINITY, 0.1, 10), [0, 3, 6, 9]);
        assert_eq!(looks(0.2, 0.3, 0.8, 0.1, 20), [2, 5, 8]);
        // Finer than the step: every step, never twice.
        assert_eq!(looks(0.0, 0.01, f64::INFINITY, 0.1, 3), [0, 1, 2, 3]);
        // Not a multiple of the step: the nearest.
        assert_eq!(looks(0.0, 0.25, f64::INFINITY, 0.1, 10), [0, 3, 5, 8, 10]);
    }

    /// Looks were counted up one by one: an interval of next to nothing never ended.
    #[test]
    fn looks_between_steps_are_not_counted() {
        for every in [1e-300, 1e-14, 1e-3, 0.06, 0.099] {
            let trigger = Trigger::each(every, 0.1);
            assert_eq!([0, 7, 1 << 40].map(|now| trigger.after(now)), [1, 8, (1 << 40) + 1], "{every}");
        }
        let rare = Trigger::each(1e300, 0.1);
        assert_eq!(rare.after(0), u64::MAX);
    }

    #[test]
    fn the_next_look_is_found_from_anywhere() {
        let trigger = Trigger { from: 0.2, every: 0.3, until: 0.8, dt: 0.1, begin: 0 };
        assert_eq!([0, 2, 3, 6, 8, 9].map(|now| trigger.at_or_after(now)), [2, 2, 5, 8, 8, u64::MAX]);
    }
}
