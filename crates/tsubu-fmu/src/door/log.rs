//! The way of messages to the tool.

use super::{ERROR, Status};
use std::ffi::{CString, c_char, c_void};

/// What version 3.0 is told messages by: environment, status, category, message.
pub(super) type Three = unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char);
/// The same of version 2.0, which takes a format and what belongs into it: environment, instance, status, category, format.
pub(super) type Two = unsafe extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char, ...);

/// Who hears messages.
pub(super) enum Listener {
    /// Nobody.
    None,
    /// A tool by version 3.0.
    Three(Three),
    /// A tool by version 2.0, which wants to know the name of the instance.
    Two(Two, CString),
}

/// The tool, as one talks to it.
pub(super) struct Log {
    /// What the tool wants to get back with each message.
    pub environment: *mut c_void,
    /// Who hears.
    pub listener: Listener,
}

impl Log {
    /// Says something; errors and warnings are said whether or not the tool wants to be told of what is normal.
    pub fn say(&self, status: Status, text: &str) {
        let category = if status == ERROR { c"logStatusError" } else { c"logStatusWarning" };
        let Ok(message) = CString::new(text.replace('\0', " ")) else { return };
        let (category, message) = (category.as_ptr(), message.as_ptr());
        match &self.listener {
            Listener::None => {}
            // SAFETY: the tool's function, with its own environment, and texts that live until it returns.
            Listener::Three(listener) => unsafe { listener(self.environment, status, category, message) },
            // SAFETY: as above; the format takes one text.
            Listener::Two(listener, name) => unsafe {
                listener(self.environment, name.as_ptr(), status, category, c"%s".as_ptr(), message);
            },
        }
    }
}
