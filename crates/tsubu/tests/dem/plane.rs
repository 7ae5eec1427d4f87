//! In the plane y is locked.

use super::open;
use tsubu_frame::{Kind, Values};

/// After a second of thrown balls every y is zero, bit by bit, and so are the spins about x and z.
#[test]
fn the_locked_axis_is_exactly_zero() {
    let (mut engine, mut hosts, mut ledger) = open("shaken-box", &[]);
    let steps = (1.0 / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let frame = engine.frame(&hosts);
    let vectors = |name: &str| match &frame.column(Kind::Grain, name).unwrap().values {
        Values::Vector(v) => v.clone(),
        _ => panic!("{name} is not a vector"),
    };
    for (position, velocity) in vectors("position").iter().zip(vectors("velocity")) {
        assert_eq!((position[1].abs().to_bits(), velocity[1].abs().to_bits()), (0, 0));
    }
    let spins = vectors("spin");
    assert!(spins.iter().all(|w| w[0].abs().to_bits() == 0 && w[2].abs().to_bits() == 0));
    // The control: the test would see a motion, there is one about y.
    assert!(spins.iter().any(|w| w[1] != 0.0));
}
