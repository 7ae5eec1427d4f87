//! The question: a scene file becomes a [`plan::Plan`], or all complaints about it at once.
//!
//! ```text
//! text + --set  ->  node (typed, with places)  ->  resolve (along keys)  ->  derive  ->  check  ->  Plan
//! ```
//!
//! [`keys`] is the table of everything a scene may say: names, units, ranges, defaults and a sentence each. Reading, the JSON
//! Schema ([`schema()`]), the reference page ([`reference()`]) and what is explained by name ([`choices()`]) follow it. A key
//! has a field of the same name in [`plan`]; what values must be to one another stands in `check`, and what follows from
//! others in `resolve`.
//!
//! ```
//! use tsubu_scene::Scene;
//! # use std::path::Path;
//! let text = r#"
//!     duration = "1 s"
//!     [materials.acrylic]
//!     young-modulus = "0.5 GPa"
//!     [particles.ball]
//!     material = "acrylic"
//!     diameter = "6 mm"
//!     mass = "0.2 g"
//!     start.at = { position = [[0, "90 mm"]] }
//! "#;
//! let scene = Scene::parse("drop.toml", text, Path::new("."), &["duration=2 s".to_string()]).unwrap();
//! assert_eq!(scene.plan().duration, 2.0);
//! assert_eq!(scene.plan().particles["ball"].diameter, 0.006);
//!
//! let wrong = Scene::parse("drop.toml", &text.replace("mass", "mas"), Path::new("."), &[]).unwrap_err();
//! assert!(wrong.to_string().contains("did you mean `mass`?"));
//! ```

pub mod keys;
pub mod plan;
pub mod units;

mod attach;
mod cells;
mod change;
mod check;
mod choices;
mod clump;
mod complaint;
mod files;
mod going_on;
mod grain_file;
mod header;
mod key;
mod lines;
mod mesh_check;
mod mesh_file;
mod node;
mod packing;
pub mod philox;
mod polyhedron;
pub mod range;
mod reference;
mod resolve;
mod scene;
mod schema;
mod size;
mod stage;
mod study;
mod suggest;
mod symmetric;
mod templates;
mod write;

/// Meshes: where one ends; what is wrong with it, or at least worth knowing.
pub mod mesh {
    pub use crate::mesh_check::{Diagnosis, Found, diagnose, ends};
}

pub use cells::Cells;
pub use choices::{Choice, KeyText, choices};
pub use complaint::Complaints;
pub use going_on::Difference;
pub use plan::Plan;
pub use reference::reference;
pub use scene::Scene;
pub use schema::schema;
pub use suggest::nearest;
pub use templates::{TEMPLATES, Template};
