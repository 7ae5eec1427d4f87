//! The door to co-simulation: a scene with hosts as a Functional Mock-up Unit.
//!
//! A tool for structures (a finite-element or multibody program) moves the bases of the scene's hosts; the grains are moved here, and
//! what they do to the hosts goes back. The standard is the Functional Mock-up Interface, version 3.0 (Modelica Association 2022) or 2.0
//! (2014), for co-simulation.
//!
//! ```text
//! scene -> pack: modelDescription.xml, the scene, this library -> FILE.fmu -> a tool loads it
//! tool  -> door (C functions) -> Instance -> Moving (engine, hosts, books)
//! ```
//!
//! # What goes in, and when
//!
//! Each host with a `base` has three inputs, the motion of that base at the *begin* of a communication step: displacement u [m], velocity
//! v [m/s] and acceleration a [m/s^2]. A step of length h takes the base from where it is to where this motion leads,
//!
//! u + v h + a h^2 / 2 at the velocity v + a h,
//!
//! by the cubic through both ends. That is the predictor of velocity Verlet and of Newmark's method, so a structure that is moved
//! outside with the engine's own time step moves as `structure.oscillator` does inside. Displacement and velocity of the base never
//! jump; and since each step aims at the motion told, and not at the one before it, nothing drifts apart. Accelerations alone
//! would drift, displacements alone would have no acceleration at the begin of a step.
//!
//! # Steps
//!
//! The engine takes its own steps, and a communication step must be a whole number of them: anything else is an error that says what
//! would fit. [`pack`] makes the engine's step fit a communication step that is asked for.

pub mod description;
pub mod error;
pub mod instance;
pub mod moving;
pub mod pack;
pub mod variables;

mod door;
