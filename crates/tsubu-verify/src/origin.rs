//! Where accepted ranges come from, in one word each.
//!
//! A range is of the origin of its centre: a closed form with a tolerance of ours is a closed form. A range whose ends are ours is
//! our own choice, whatever text suggested it.

use tsubu_frame::{Origin, Source};

/// It follows from the model.
pub(super) const fn closed_form(text: &str) -> Source<'_> {
    Source::new(Origin::ClosedForm, text)
}

/// A number or statement printed in a publication that was read.
pub(super) const fn printed(text: &str) -> Source<'_> {
    Source::new(Origin::Printed, text)
}

/// Read from a figure.
pub(super) const fn digitised(text: &str) -> Source<'_> {
    Source::new(Origin::Digitised, text)
}

/// Another program, or an independent calculation.
pub(super) const fn other_program(text: &str) -> Source<'_> {
    Source::new(Origin::OtherProgram, text)
}

/// From memory: the source was not read.
pub(super) const fn remembered(text: &str) -> Source<'_> {
    Source::new(Origin::Remembered, text)
}

/// Our own choice.
pub(super) const fn own(text: &str) -> Source<'_> {
    Source::new(Origin::Own, text)
}

/// Set around a value that came out.
pub(super) const fn regression(text: &str) -> Source<'_> {
    Source::new(Origin::Regression, text).after()
}
