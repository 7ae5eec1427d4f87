//! Where cuts go wrong.

use super::{DAMPER, FLOW, Job, Thread, job};
use std::sync::Arc;
use tsubu::ranks::Communicator;

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

/// A ball that is shot into the box ends the run on all ranks, with the words of one, whoever has the ball.
#[test]
fn too_deep_an_overlap_is_told_as_by_one_rank() {
    let shot = "[particles.shot]\nmaterial = \"glass\"\ncount = 1\ndiameter = \"2 mm\"\nmass = \"1 g\"\n\
                start.at = { position = [[\"54 mm\", \"150 mm\"]], velocity = [[0, -60]] }\n";
    let text = format!("{DAMPER}{shot}");
    let job = job(&text);
    let told = |communicator: Option<&Arc<dyn Communicator>>| {
        let (mut engine, mut hosts, mut ledger) = job.opened(communicator);
        engine.advance(1000, &mut hosts, &mut ledger).expect_err("the shot goes too deep").to_string()
    };
    let alone = told(None);
    assert!(alone.contains("overlaps"), "{alone}");
    for ranks in [2, 3, 7] {
        let team = Thread::team(ranks).into_iter().map(|one| Arc::new(one) as Arc<dyn Communicator>);
        let all: Vec<String> = std::thread::scope(|scope| {
            let ranks: Vec<_> = team.map(|one| scope.spawn(move || told(Some(&one)))).collect();
            ranks.into_iter().map(|rank| rank.join().unwrap()).collect()
        });
        assert!(all.iter().all(|one| *one == alone), "{all:?} for {alone}");
    }
}
