//! The common test that Sakaguchi et al. (2001) ask for: hopper, heap, shaken box and collapse, each described once and run by
//! every model that can, beside DEM of discs of the same areas that roll freely, roll with resistance, and do not turn.
//!
//! Nobody has published numbers for these scenes. The claims are trends that hold for all models that can show them, and
//! distances between models; what else is measured stands in the table that a run into a folder leaves.

mod collapse;
mod heap;
mod hopper;
mod seen;
mod shaken;
mod shapes;

pub(super) use shapes::shapes;

use super::Judged;
use tsubu_frame::RunFolder;

pub(super) fn hopper(perturbation: f64, folder: Option<&RunFolder>) -> Judged {
    seen::judged(&hopper::TEST, perturbation, folder)
}

pub(super) fn heap(perturbation: f64, folder: Option<&RunFolder>) -> Judged {
    seen::judged(&heap::TEST, perturbation, folder)
}

pub(super) fn shaken(perturbation: f64, folder: Option<&RunFolder>) -> Judged {
    seen::judged(&shaken::TEST, perturbation, folder)
}

pub(super) fn collapse(perturbation: f64, folder: Option<&RunFolder>) -> Judged {
    seen::judged(&collapse::TEST, perturbation, folder)
}
