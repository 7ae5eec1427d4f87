//! Whoever looks at a run that goes on: is given moments of it, and may ask it to stand still.

use super::Run;
use crate::interrupt::Interrupt;
use std::thread::sleep;
use std::time::{Duration, Instant};
use tsubu_frame::Frame;

/// What somebody wants to be shown now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Nothing yet: too little time has passed since the last.
    Nothing,
    /// Grains and walls.
    Grains,
    /// The contacts too.
    Contacts,
}

/// Somebody who looks on. All of it is called from the thread of the run, which waits until it is done: it must be quick. It is
/// told, and changes nothing: the run is the same to the last bit.
pub trait Onlooker: Sync {
    /// A stage begins: its number and its name, empty where a scene has none; and what `check` says of all stages so far.
    fn stage(&self, number: usize, name: &str, verdicts: &str);

    /// A row of the history under these columns.
    fn row(&self, columns: &[String], row: &[f64]);

    /// How far the run is: simulated time [s], steps, share done from 0 to 1.
    fn moved(&self, time: f64, steps: u64, share: f64);

    /// What is wanted at this moment.
    fn wish(&self) -> Wish;

    /// A moment, and how long the run has worked for it.
    fn frame(&self, frame: Frame, cost: Duration);

    /// Whether the run is to stand still for now.
    fn paused(&self) -> bool;
}

/// How often a run that stands still asks whether it may go on.
const PATIENCE: Duration = Duration::from_millis(20);

impl Run<'_> {
    /// Tells of the stage that begins, and shows its first moment.
    pub(super) fn tell_stage(&self) {
        let (stages, Some(onlooker)) = (&self.stages, self.onlooker) else { return };
        onlooker.stage(stages.at(), stages.name().unwrap_or_default(), &stages.verdicts);
        self.show(onlooker, onlooker.wish());
    }

    /// Shows this moment to whoever wants it, the last one of a stage in any case, and stands still as long as that is wished.
    pub(super) fn be_seen(&mut self, share: f64, last: bool, interrupt: &Interrupt) {
        let Some(onlooker) = self.onlooker else { return };
        onlooker.moved(self.engine.time(), self.engine.steps(), share);
        let (wish, paused) = (onlooker.wish(), onlooker.paused());
        let pressing = wish == Wish::Nothing && (last || paused);
        self.show(onlooker, if pressing { Wish::Contacts } else { wish });
        if !paused {
            return;
        }
        let begun = Instant::now();
        while onlooker.paused() && !interrupt.asked() {
            sleep(PATIENCE);
        }
        self.idle += begun.elapsed();
    }

    fn show(&self, onlooker: &dyn Onlooker, wish: Wish) {
        let begun = Instant::now();
        let frame = match wish {
            Wish::Nothing => return,
            Wish::Grains => self.engine.grain_frame(&self.hosts),
            Wish::Contacts => self.engine.frame(&self.hosts),
        };
        onlooker.frame(frame, begun.elapsed());
    }
}
