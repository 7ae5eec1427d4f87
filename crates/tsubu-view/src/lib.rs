//! The look: runs in the browser, from a server on this machine alone.
//!
//! A [`Server`] listens on loopback and gives a page and the frames of the folders it was made for to whoever knows the token in its
//! address, and nothing else to anybody: what a browser asks for are numbers of runs and frames, never names of files. A run that goes
//! on in this program is shown from memory, by what it tells [`Live`]. [`embedded`] is the same page in one file, with some frames in it.

#[cfg(feature = "server")]
mod answer;
pub mod embedded;
mod error;
#[cfg(feature = "server")]
mod folder;
#[cfg(feature = "server")]
mod guard;
#[cfg(feature = "server")]
mod live;
mod moment;
#[cfg(feature = "server")]
mod packet;
mod page;
mod paint;
mod quantised;
#[cfg(feature = "server")]
mod ring;
#[cfg(feature = "server")]
mod server;
#[cfg(feature = "server")]
mod source;
#[cfg(feature = "server")]
mod token;

pub use error::ViewError;
#[cfg(feature = "server")]
pub use live::Live;
#[cfg(feature = "server")]
pub use server::Server;
