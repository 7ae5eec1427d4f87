//! Columns that belong together, listed once: sorting, saving and loading cannot forget one.

use crate::threads::piece;
use glam::DVec3;
use rayon::prelude::*;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Room for one column of each type.
#[derive(Debug, Default)]
pub struct Spares {
    real: Vec<f64>,
    integer: Vec<u32>,
    vector: Vec<DVec3>,
}

/// Puts value `order[i]` of a column at place i.
pub fn permute<T: Value>(column: &mut Vec<T>, order: &[u32], spares: &mut Spares) {
    let spare = T::spare(spares);
    let rows = order.par_iter().with_min_len(piece(order.len()));
    rows.map(|&i| column[i as usize]).collect_into_vec(spare);
    std::mem::swap(column, spare);
}

/// A number type that can be a column.
pub trait Value: Copy + Send + Sync {
    /// Room for another column of this type.
    fn spare(spares: &mut Spares) -> &mut Vec<Self>;
    /// Stores a column; floats where they lie.
    fn put<'a>(state: &mut State<'a>, name: &str, values: &'a [Self]);
    /// Takes a column back, out of the state.
    fn take(state: &mut State, name: &str) -> Result<Vec<Self>, MissingSection>;
}

impl Value for f64 {
    fn spare(spares: &mut Spares) -> &mut Vec<Self> {
        &mut spares.real
    }
    fn put<'a>(state: &mut State<'a>, name: &str, values: &'a [Self]) {
        state.put_real(name, values);
    }
    fn take(state: &mut State, name: &str) -> Result<Vec<Self>, MissingSection> {
        state.take_real(name)
    }
}

impl Value for u32 {
    fn spare(spares: &mut Spares) -> &mut Vec<Self> {
        &mut spares.integer
    }
    fn put<'a>(state: &mut State<'a>, name: &str, values: &'a [Self]) {
        state.put_index(name, values);
    }
    fn take(state: &mut State, name: &str) -> Result<Vec<Self>, MissingSection> {
        state.take_index(name)
    }
}

impl Value for DVec3 {
    fn spare(spares: &mut Spares) -> &mut Vec<Self> {
        &mut spares.vector
    }
    fn put<'a>(state: &mut State<'a>, name: &str, values: &'a [Self]) {
        state.put_real(name, bytemuck::cast_slice(values));
    }
    fn take(state: &mut State, name: &str) -> Result<Vec<Self>, MissingSection> {
        Ok(state.take_real(name)?.chunks_exact(3).map(Self::from_slice).collect())
    }
}

/// Declares a struct of equally long columns and what must be done to all of them.
macro_rules! columns {
    ($(#[$about:meta])* $name:ident of $row:ident { $($(#[$doc:meta])* $column:ident: $type:ty,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $name { $($(#[$doc])* pub $column: Vec<$type>,)+ }

        /// One row of the columns.
        #[derive(Clone, Copy, Debug)]
        pub struct $row { $($(#[$doc])* pub $column: $type,)+ }

        impl $name {
            /// With room for so many rows.
            pub fn with_room(rows: usize) -> Self {
                Self { $($column: Vec::with_capacity(rows),)+ }
            }

            /// Adds a row.
            pub fn push(&mut self, row: $row) { $(self.$column.push(row.$column);)+ }

            /// A row.
            pub fn row(&self, i: usize) -> $row { $row { $($column: self.$column[i],)+ } }

            /// Puts row `order[i]` at place i, but for the columns of these names; rows that are not in the order are dropped. On many
            /// threads.
            pub fn permute(&mut self, order: &[u32], but: &[&str]) {
                let mut spares = $crate::state::columns::Spares::default();
                $(if !but.contains(&stringify!($column)) {
                    $crate::state::columns::permute(&mut self.$column, order, &mut spares);
                })+
            }

            /// Puts a copy in the place of the column of that name, and gives away the memory that it had.
            pub fn renew(&mut self, column: &str) -> Option<Box<dyn std::any::Any + Send + Sync>> {
                match column {
                    $(stringify!($column) => {
                        let copy = self.$column.clone();
                        Some(Box::new(std::mem::replace(&mut self.$column, copy)))
                    })+
                    _ => None,
                }
            }

            /// Writes every column under `prefix`.
            pub fn save<'a>(&'a self, prefix: &str, state: &mut tsubu_frame::State<'a>) {
                $($crate::state::columns::Value::put(
                    state, &format!("{prefix}.{}", stringify!($column)), &self.$column);)+
            }

            /// Takes every column back, out of the state; all must have `rows` rows.
            pub fn load(prefix: &str, rows: usize, state: &mut tsubu_frame::State)
                -> Result<Self, tsubu_frame::state::MissingSection> {
                let loaded = Self { $($column: $crate::state::columns::Value::take(
                    state, &format!("{prefix}.{}", stringify!($column)))?,)+ };
                $(if loaded.$column.len() != rows {
                    return Err(tsubu_frame::state::MissingSection {
                        name: format!("{prefix}.{}", stringify!($column)), kind: "real" });
                })+
                Ok(loaded)
            }
        }
    };
}
pub(crate) use columns;
