//! Bodies that are no spheres, and bonds.

use super::{FLOW, Job, job};
use crate::dem::bonded_bodies::block;
use crate::dem::shapes_at_walls::mixed;
use crate::water::bodies::splash;

/// Clumps and bonds across the cut: all grains go over in every step.
#[test]
fn clumps_and_bonds_have_the_bits_of_one_rank() {
    let clumps = FLOW.replace(
        "size.uniform = { smallest = \"1.8 mm\", largest = \"2.2 mm\" }",
        "diameter = \"2 mm\"\nshape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2.5, 2.5] }",
    );
    let clumps = clumps.replace("count = 1800", "count = 900");
    Job { steps: &[150, 1, 100], ..job(&clumps) }.same(&[3]);
    let bonds = format!(
        "{FLOW}[[bond]]\nparticles = [\"b-flow\"]\nyoung-modulus = \"2 MPa\"\nradius = 0.5\ntensile-strength = \"2 kPa\"\n"
    );
    Job { steps: &[150, 1, 100], ..job(&bonds) }.same(&[3]);
}

/// Balls, clumps, ellipsoids and cubes at a mesh that turns in a drum.
#[test]
fn all_shapes_have_the_bits_of_one_rank() {
    let folder = tempfile::tempdir().unwrap();
    let more = mixed(folder.path()).replace("count = 30", "count = 110").replace("\"120 mm\"", "\"450 mm\"");
    Job { text: &more, folder: folder.path(), steps: &[1500, 1, 1000], resume: true }.same(&[3]);
}

/// Bodies of all shapes in bonds that break.
#[test]
fn bonded_bodies_have_the_bits_of_one_rank() {
    Job { steps: &[1600, 1, 1400], resume: true, ..job(&block(8)) }.same(&[3]);
}

/// The same shapes but for the mesh, that fall into water.
#[test]
fn bodies_in_water_have_the_bits_of_one_rank() {
    Job { steps: &[1500, 1, 700], resume: true, ..job(&splash(60)) }.same(&[3]);
}
