//! A base that somebody outside the program moves, piece by piece.

use super::Host;
use tsubu_frame::State;

/// A piece of its way: the cubic through displacement [m] and velocity [m/s] at both ends, and on at the last velocity after that.
///
/// With s = (t - t0) / T: y = (1 + 2 s) (1 - s)^2 y0 + s (1 - s)^2 T v0 + s^2 (3 - 2 s) y1 + s^2 (s - 1) T v1 (Hermite). Where both ends
/// are those of a motion at constant acceleration, it is that motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    begin: f64,
    span: f64,
    from: [f64; 2],
    to: [f64; 2],
}

impl Piece {
    /// Displacement [m] and velocity [m/s] at `time` [s].
    pub fn at(&self, time: f64) -> (f64, f64) {
        let Self { begin, span, from: [y0, v0], to: [y1, v1] } = *self;
        let s = (time - begin) / span;
        if s >= 1.0 {
            return (y1 + (time - begin - span) * v1, v1);
        }
        // From the straight line at the first velocity, so that small differences of large displacements are not lost.
        let (way, gain) = (y1 - y0 - span * v0, span * (v1 - v0));
        let y = y0 + (time - begin) * v0 + s * s * ((3.0 - 2.0 * s) * way + (s - 1.0) * gain);
        let rate = v0 + s * (6.0 * (1.0 - s) * way + (3.0 * s - 2.0) * gain) / span;
        (y, rate)
    }
}

impl Host {
    /// Somebody outside moves the base from now on: from where it is at `begin` [s], by a cubic, to a displacement [m] and a velocity [m/s]
    /// at `end` [s], a later time; beyond it goes on at that velocity until told again. What the scene says of the base counts no more.
    ///
    /// Displacement and velocity go on without a jump; whoever steers says where the base is to be, not where it is.
    pub fn steer_base(&mut self, [begin, end]: [f64; 2], displacement: f64, velocity: f64) {
        let (y, rate) = self.base(begin);
        self.steered = Some(Piece { begin, span: end - begin, from: [y, rate], to: [displacement, velocity] });
    }

    /// Displacement [m] and velocity [m/s] of the base at `time` [s]; zeros where there is none.
    pub fn base_at(&self, time: f64) -> [f64; 2] {
        self.base(time).into()
    }

    /// Writes the piece that the base is on, where somebody steers it.
    pub(super) fn save_steered(&self, name: &str, state: &mut State) {
        if let Some(Piece { begin, span, from, to }) = self.steered {
            state.put_real(&format!("{name}.steered"), vec![begin, span, from[0], from[1], to[0], to[1]]);
        }
    }

    /// Takes it back.
    pub(super) fn load_steered(&mut self, name: &str, state: &State) {
        self.steered = match state.real(&format!("{name}.steered")) {
            Ok(&[begin, span, y0, v0, y1, v1]) => Some(Piece { begin, span, from: [y0, v0], to: [y1, v1] }),
            _ => None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::Piece;

    /// A piece between two moments of a motion at constant acceleration is that motion, and its rate the derivative of its value.
    /// Control: the straight line between both ends is not.
    #[test]
    fn a_piece_of_constant_acceleration_is_that_motion() {
        let motion = |t: f64| (0.3 - 0.7 * t + 0.5 * 4.0 * t * t, -0.7 + 4.0 * t);
        let (begin, end) = (1.5, 1.9);
        let ends = [motion(begin), motion(end)];
        let piece = Piece { begin, span: end - begin, from: ends[0].into(), to: ends[1].into() };
        for t in [1.5, 1.63, 1.7, 1.88, 1.9] {
            let (told, expected) = (piece.at(t), motion(t));
            assert!((told.0 - expected.0).abs() < 1e-14 && (told.1 - expected.1).abs() < 1e-13, "{t}: {told:?}");
        }
        let (middle, straight) = (motion(1.7).0, 0.5 * (ends[0].0 + ends[1].0));
        assert!((straight - middle).abs() > 1e-2);
    }

    /// Both ends are met whatever they are, the rate is the derivative, and after the end it goes on at the last velocity.
    #[test]
    fn a_piece_meets_both_ends() {
        let piece = Piece { begin: 2.0, span: 0.5, from: [1.0, -3.0], to: [-2.0, 8.0] };
        assert_eq!(piece.at(2.0), (1.0, -3.0));
        assert_eq!(piece.at(2.5), (-2.0, 8.0));
        assert_eq!(piece.at(2.75), (0.0, 8.0));
        for t in [2.1, 2.26, 2.4] {
            let slope = (piece.at(t + 1e-6).0 - piece.at(t - 1e-6).0) / 2e-6;
            assert!((slope - piece.at(t).1).abs() < 1e-7, "{t}");
        }
    }
}
