//! The look: runs in the browser, from a server on this machine alone.
//!
//! A [`Server`] listens on loopback and gives a page and the frames of the folders it was made for to whoever knows the token in its
//! address, and nothing else to anybody: what a browser asks for are numbers of runs and frames, never names of files.

mod answer;
mod error;
mod folder;
mod guard;
mod moment;
mod packet;
mod page;
mod paint;
mod server;
mod token;

pub use error::ViewError;
pub use server::Server;
