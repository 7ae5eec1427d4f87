//! All kinds of scenes on all numbers of ranks and threads.

use super::{DAMPER, FLOW, Job, STREAM, job};
use crate::dem::everything::{EVERYTHING, paddle};
use crate::dem::polyhedron::CROWD;
use crate::dem::shapes_at_walls::mixed;

/// A chute between periodic ends, a stream of water over it, and balls on a host.
#[test]
#[ignore = "10 s: cargo xtask patient"]
fn chute_stream_and_damper_have_the_same_bits_on_any_ranks() {
    for text in [FLOW, &format!("{FLOW}{STREAM}"), DAMPER] {
        Job { steps: &[200, 1, 120], ..job(text) }.same_on_any();
    }
}

/// A mesh, a source and removal, and a drum that turns.
#[test]
#[ignore = "half a minute: cargo xtask patient"]
fn meshes_sources_and_drums_have_the_same_bits_on_any_ranks() {
    let folder = tempfile::tempdir().unwrap();
    paddle(folder.path());
    Job { text: EVERYTHING, folder: folder.path(), steps: &[200, 1, 100], resume: false }.same_on_any();
    let more = mixed(folder.path()).replace("count = 30", "count = 110").replace("\"120 mm\"", "\"450 mm\"");
    Job { text: &more, folder: folder.path(), steps: &[800, 1, 400], resume: false }.same_on_any();
}

#[test]
#[ignore = "half a minute: cargo xtask patient"]
fn everything_at_once_has_the_bits_of_one_rank() {
    let folder = tempfile::tempdir().unwrap();
    paddle(folder.path());
    Job { text: EVERYTHING, folder: folder.path(), steps: &[300, 200], resume: true }.same(&[3]);
}

/// Cubes and tetrahedra, each contact of features with a history of its own, which goes over when grains are sorted anew.
#[test]
#[ignore = "5 s: cargo xtask patient"]
fn polyhedra_have_the_bits_of_one_rank() {
    let crowd = CROWD.replace("count = 120", "count = 400").replace("110 mm", "300 mm");
    Job { steps: &[2500, 1, 1500], resume: true, ..job(&crowd) }.same(&[3]);
}

/// A block of 640 spheres, more than a block of the search has, falls into a flow.
#[test]
#[ignore = "10 s: cargo xtask patient"]
fn a_clump_wider_than_a_block_has_the_bits_of_one_rank() {
    let centres: Vec<String> = (0..640).map(|k| format!("[{}, {}, {}]", k % 10, k / 10 % 8, k / 80)).collect();
    let clump = format!(
        "[particles.e-block]\nmaterial = \"glass\"\ncount = 1\ndiameter = \"1 mm\"\nshape.clump = {{ centre = [{}], diameter = [{}] }}\n\
         start.at = {{ position = [[\"24 mm\", \"12 mm\", \"49 mm\"]], velocity = [[0, 0, -3]] }}\n",
        centres.join(", "),
        ["1.4"; 640].join(", "),
    );
    Job { steps: &[150, 1, 100], resume: true, ..job(&format!("{FLOW}{clump}")) }.same(&[2, 3]);
}
