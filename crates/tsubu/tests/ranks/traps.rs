//! Where cuts go wrong.

use super::{DAMPER, FLOW, Job, job};

/// More ranks than blocks, all grains in one block, and none at all: some ranks have nothing to do.
#[test]
fn ranks_without_grains_do_no_harm() {
    let few = DAMPER.replace("count = 2500", "count = 300");
    job(&few).same(&[2, 4]);
    let none = FLOW
        .replace("count = 1800", "count = 1")
        .replace("count = 288", "count = 1")
        .replace("count = 8\n", "count = 1\n");
    job(&none).same(&[3]);
}

/// Grains in exact rows and columns, so that many stand on the same edges of cells, and on that of the cut.
#[test]
fn grains_exactly_on_the_cut_have_the_bits_of_one_rank() {
    let rows = DAMPER.replace("spacing = 1.02, jitter = 0.8, speed = 0.3", "spacing = 1, jitter = 0");
    assert_ne!(rows, DAMPER);
    job(&rows).same(&[2, 3]);
}

/// Small grains look for large ones, never the other way: the rank of the ball sees no grain of the others, and they all push it.
#[test]
fn what_one_side_alone_sees_has_the_bits_of_one_rank() {
    let ball = "[particles.e-ball]\nmaterial = \"glass\"\ncount = 1\ndiameter = \"7 mm\"\n\
                start.at = { position = [[\"24 mm\", \"5 mm\", \"45 mm\"]], velocity = [[0, 0, -1.5]] }\n";
    Job { resume: true, ..job(&format!("{FLOW}{ball}")) }.same(&[2, 4]);
}
