//! What the server gives and refuses, over plain TCP; and the page in a browser.

mod bodies;
mod browser;
mod chromium;
mod embedded;
mod large;
mod live;
mod looks;
mod server;
mod support;
