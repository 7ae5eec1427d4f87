//! What the server gives and refuses, over plain TCP; and the page in a browser.

mod browser;
mod chromium;
mod live;
mod server;
mod support;
