//! The look: runs in the browser, from a server on this machine alone.
//!
//! A [`Server`] listens on loopback and gives a page and the frames of the folders it was made for to whoever knows the token in its
//! address, and nothing else to anybody: what a browser asks for are numbers of runs and frames, never names of files. A run that goes
//! on in this program is shown from memory, by what it tells [`Live`].

mod answer;
mod error;
mod folder;
mod guard;
mod live;
mod moment;
mod packet;
mod page;
mod paint;
mod ring;
mod server;
mod source;
mod token;

pub use error::ViewError;
pub use live::Live;
pub use server::Server;
