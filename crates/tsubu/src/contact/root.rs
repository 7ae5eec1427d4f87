//! Roots that vectorise: no table, no branch, no call.
//!
//! A guess from the bits of the number (its exponent divided by N, 3.4 % off at most), then Halley's steps on y^N = x,
//! which take the error e to (N^2 - 1)/12 e^3. The last step adds a small correction to a nearly right number, so the
//! result is right to a few units of the last place.

/// The smaller of two numbers, as one instruction; `f64::min` also asks which of them is a number at all.
#[inline(always)]
pub(super) fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers, as one instruction.
#[inline(always)]
pub(super) fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// x^(1/3), for x from 1e-300 to 1e300.
#[inline(always)]
pub(super) fn cube_root(x: f64) -> f64 {
    // A third of 2^32, and what a third of the exponent's bias lacks, less what centres the error of the guess.
    let y = guess(x, 0x5555_5555, 0x2A9F_7800);
    let halley = |y: f64| y + y * ((x - y * y * y) / (2.0 * (y * y * y) + x));
    halley(halley(halley(y)))
}

/// x^(1/5), for x from 1e-300 to 1e300.
#[inline(always)]
pub(super) fn fifth_root(x: f64) -> f64 {
    let y = guess(x, 0x3333_3333, 0x3325_CE66);
    let halley = |y: f64| {
        let power = (y * y) * (y * y) * y;
        y + y * ((x - power) / (3.0 * power + 2.0 * x))
    };
    halley(halley(halley(y)))
}

/// The upper half of the bits of x times `part` / 2^32, plus `bias`.
#[inline(always)]
fn guess(x: f64, part: u64, bias: u64) -> f64 {
    let upper = x.to_bits() >> 32;
    f64::from_bits((((upper * part) >> 32) + bias) << 32)
}

#[cfg(test)]
mod tests {
    use super::{cube_root, fifth_root};

    /// Against roots that are known exactly: numbers of few digits, whose powers f64 holds without rounding.
    #[test]
    fn roots_are_right_to_rounding() {
        let mut worst = [0.0_f64; 2];
        for exponent in -190..=190 {
            for digits in 512..1024 {
                let y = f64::from(digits) * 2f64.powi(exponent);
                worst[0] = worst[0].max((fifth_root(y * y * y * y * y) / y - 1.0).abs());
                let y = f64::from(97 * digits) * 2f64.powi(exponent * 3 / 2);
                worst[1] = worst[1].max((cube_root(y * y * y) / y - 1.0).abs());
            }
        }
        assert!(worst[0] < 1e-15 && worst[1] < 1e-15, "{worst:?}");
        assert!(fifth_root(0.0) < 1e-60 && cube_root(0.0) < 1e-90, "{} {}", fifth_root(0.0), cube_root(0.0));
    }
}
