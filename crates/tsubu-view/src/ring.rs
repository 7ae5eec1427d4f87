//! The last frames of a run, in memory: no more of them than fit.

use std::sync::Arc;

use tsubu_frame::{Column, Frame, Values};

/// Most frames that are kept.
const FRAMES: usize = 240;

/// Most bytes that they take together.
const BYTES: usize = 256 << 20;

/// Frames under the numbers that they came with.
#[derive(Default)]
pub struct Ring {
    kept: Vec<(usize, Arc<Frame>)>,
    bytes: usize,
    next: usize,
}

impl Ring {
    /// Adds a frame. Where there is no room, every second of those before it goes: what is left still tells of the whole run, the
    /// more coarsely the longer ago.
    pub fn push(&mut self, frame: Frame) {
        self.bytes += size(&frame);
        self.kept.push((self.next, Arc::new(frame)));
        self.next += 1;
        while self.kept.len() > 2 && (self.kept.len() > FRAMES || self.bytes > BYTES) {
            let last = self.kept.len() - 1;
            let mut place = 0;
            self.kept.retain(|_| {
                place += 1;
                place % 2 == 1 || place > last
            });
            self.bytes = self.kept.iter().map(|(_, frame)| size(frame)).sum();
        }
    }

    /// Numbers and times [s] of the frames that are there.
    pub fn moments(&self) -> Vec<(usize, f64)> {
        self.kept.iter().map(|(number, frame)| (*number, frame.time)).collect()
    }

    /// The frame of that number, or the last before it if it has gone.
    pub fn get(&self, number: usize) -> Option<Arc<Frame>> {
        let behind = self.kept.partition_point(|(kept, _)| *kept <= number);
        (number < self.next).then(|| self.kept.get(behind.saturating_sub(1)).map(|(_, frame)| frame.clone()))?
    }

    /// The last frame.
    pub fn last(&self) -> Option<&Frame> {
        self.kept.last().map(|(_, frame)| &**frame)
    }
}

/// Bytes of the numbers of a frame.
fn size(frame: &Frame) -> usize {
    let bytes = |Column { values, .. }: &Column| {
        let each = match values {
            Values::Scalar(_) | Values::Integer(_) => 8,
            Values::Vector(_) => 24,
            Values::Quaternion(_) => 32,
        };
        each * values.len()
    };
    frame.columns.iter().map(bytes).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu_frame::Kind;

    fn frame(time: f64, grains: usize) -> Frame {
        let mut frame = Frame { time, ..Frame::default() };
        frame.scalar(Kind::Grain, "radius", "m", vec![1.0; grains]);
        frame
    }

    #[test]
    fn a_ring_keeps_the_first_and_the_last_and_never_more_than_fit() {
        let mut ring = Ring::default();
        for number in 0..10_000_u32 {
            ring.push(frame(f64::from(number), 1));
            let moments = ring.moments();
            assert!(moments.len() <= FRAMES);
            assert_eq!((moments[0].0, moments.last()), (0, Some(&(number as usize, f64::from(number)))));
        }
        let (moments, ring_at) = (ring.moments(), |number| ring.get(number).map(|frame| frame.time));
        assert!(moments.windows(2).all(|pair| pair[0].0 < pair[1].0));
        // One that has gone is the last before it; one that is to come is none.
        let gone = (0..10_000).find(|number| moments.iter().all(|(kept, _)| kept != number)).expect("some went");
        assert_eq!(ring_at(gone), ring_at(moments[moments.partition_point(|(kept, _)| *kept < gone) - 1].0));
        assert_eq!(ring_at(10_000), None);
    }

    #[test]
    fn large_frames_are_fewer() {
        let mut ring = Ring::default();
        (0..40_u32).for_each(|number| ring.push(frame(f64::from(number), 2 << 20)));
        assert!(ring.bytes <= BYTES && ring.moments().len() <= 16, "{} frames", ring.moments().len());
    }
}
