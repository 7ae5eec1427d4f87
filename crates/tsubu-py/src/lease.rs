//! Leases: arrays that lie in the memory of an engine.
//!
//! An array of a column shows the moment it was taken at, and no copy is made for it. Before the engine writes into that memory, or
//! frees it, it [renews](tsubu::engine::Engine::renew) the column where an array of it is still held: the engine goes on with a copy,
//! and the memory goes to whoever holds the array. So an array is never wrong, whatever became of the grains, and
//! nothing that the engine writes can be read meanwhile, by other threads neither.

#![allow(
    unsafe_code,
    reason = "an array of numpy that shows memory of the engine is made from a pointer; why it is valid stands there"
)]

use glam::DVec3;
use numpy::ndarray::{ArrayView1, ArrayView2};
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Memory that an engine has given away.
type Memory = Box<dyn Any + Send + Sync>;

/// Keeps the memory of arrays of one column, once the engine has given it away.
#[derive(Default)]
struct Kept(Mutex<Option<Memory>>);

/// What an array has as its base: as long as it lives the memory does.
#[pyclass(frozen, name = "Lease", module = "tsubu._tsubu")]
pub struct Lease {
    _kept: Arc<Kept>,
}

/// All leases on the columns of an engine. Whoever lets the engine write must [end](Leases::end) them first.
#[derive(Default)]
pub struct Leases {
    lent: Vec<(&'static str, Weak<Kept>)>,
}

/// A column in the memory of an engine.
pub enum Column<'a> {
    /// Three numbers a row.
    Vectors(&'a [DVec3]),
    /// One number a row.
    Numbers(&'a [f64]),
    /// One whole number a row.
    Whole(&'a [u32]),
}

impl Leases {
    /// An array of a column, which lies in the engine's own memory under that name.
    pub fn array<'py>(
        &mut self,
        py: Python<'py>,
        name: &'static str,
        column: Column<'_>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let known = self.lent.iter().find(|(lent, _)| *lent == name).and_then(|(_, kept)| kept.upgrade());
        let kept = known.unwrap_or_else(|| {
            let kept = Arc::<Kept>::default();
            self.lent.retain(|(lent, _)| *lent != name);
            self.lent.push((name, Arc::downgrade(&kept)));
            kept
        });
        let base = Bound::new(py, Lease { _kept: kept })?.into_any();
        match column {
            Column::Vectors(rows) => {
                // SAFETY: a `DVec3` is three `f64` side by side (`repr(C)`), and a slice of them is as many numbers one behind the
                // other; the new slice lives as long as the old.
                let flat = unsafe { std::slice::from_raw_parts(rows.as_ptr().cast::<f64>(), 3 * rows.len()) };
                let view = ArrayView2::from_shape((rows.len(), 3), flat);
                let view = view.map_err(|error| crate::error::wrong(py, error, ""))?;
                // SAFETY: the memory is not freed and not written to while `base` lives, see the head of this module.
                let array = unsafe { PyArray2::borrow_from_array(&view, base) };
                Ok(array.readwrite().make_nonwriteable().as_any().clone())
            }
            Column::Numbers(numbers) => Ok(of_numbers(numbers, base)),
            Column::Whole(numbers) => Ok(of_numbers(numbers, base)),
        }
    }

    /// Ends all leases: `renew` gives away the memory of a column for those whose arrays are still held.
    pub fn end(&mut self, mut renew: impl FnMut(&str) -> Option<Memory>) {
        for (name, kept) in self.lent.drain(..) {
            if let Some(kept) = kept.upgrade() {
                *kept.0.lock().unwrap_or_else(PoisonError::into_inner) = renew(name);
            }
        }
    }
}

fn of_numbers<'py, T: Element>(numbers: &[T], base: Bound<'py, PyAny>) -> Bound<'py, PyAny> {
    // SAFETY: as above.
    let array = unsafe { PyArray1::borrow_from_array(&ArrayView1::from(numbers), base) };
    array.readwrite().make_nonwriteable().as_any().clone()
}
