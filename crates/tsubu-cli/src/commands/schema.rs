//! `tsubu schema`: the scene file for editors.

use crate::failure::Failure;
use crate::output;

pub fn run() -> Result<(), Failure> {
    output::print(&format!("{:#}\n", tsubu_scene::schema()))
}
