//! The functions of FMI 2.0 for co-simulation.

use super::log::{Listener, Log, Two};
use super::{
    ERROR, OK, Pointer, Status, forget, free, get, instantiate, keep, list, list_mut, read, reset, restore, set,
    settle, terminate, text, with,
};
use crate::error::Error;
use std::ffi::{CStr, c_char, c_void};
use std::path::PathBuf;
use std::ptr::null_mut;

/// What the tool does for the unit; memory is not asked for.
#[repr(C)]
struct Callbacks {
    listener: Option<Two>,
    allocate: *const c_void,
    release: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

/// The kind of unit that is for co-simulation.
const CO_SIMULATION: i32 = 1;

#[unsafe(no_mangle)]
extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Errors and warnings are always said, and there is nothing else to say.
#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetDebugLogging(
    instance: Pointer,
    _on: i32,
    _count: usize,
    _: *const *const c_char,
) -> Status {
    with(instance, "fmi2SetDebugLogging", |_| Ok(OK))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: i32,
    token: *const c_char,
    resources: *const c_char,
    callbacks: *const c_void,
    _visible: i32,
    _logging_on: i32,
) -> Pointer {
    // SAFETY: null, or the structure of the standard, which lives at least until the instance is freed.
    let callbacks = unsafe { callbacks.cast::<Callbacks>().as_ref() };
    let name = if name.is_null() {
        c"tsubu".to_owned()
    } else {
        // SAFETY: not null, ends with a zero, and lives as long as the call.
        unsafe { CStr::from_ptr(name) }.to_owned()
    };
    let listener =
        callbacks.and_then(|callbacks| callbacks.listener).map_or(Listener::None, |two| Listener::Two(two, name));
    let environment = callbacks.map_or(null_mut(), |callbacks| callbacks.environment);
    instantiate("fmi2Instantiate", Log { environment, listener }, || {
        if kind != CO_SIMULATION {
            return Err(Error::new("this unit is for co-simulation alone"));
        }
        read(&path(text(resources, "address of resources")?)?, text(token, "GUID")?)
    })
}

/// The path in an address `file:///...`, with its %-escapes undone.
fn path(address: &str) -> Result<PathBuf, Error> {
    let wrong = || Error::new(format!("the address of resources `{address}` is no path of this machine"));
    let rest = address.strip_prefix("file:").ok_or_else(wrong)?;
    let rest = rest.strip_prefix("//localhost").or_else(|| rest.strip_prefix("//")).unwrap_or(rest);
    // On Windows the drive stands behind a slash: /C:/...
    let rest = if cfg!(windows) { rest.trim_start_matches('/') } else { rest };
    let mut bytes = Vec::with_capacity(rest.len());
    let mut left = rest.as_bytes();
    while let [first, after @ ..] = left {
        left = after;
        match (first, after) {
            (b'%', [high, low, after @ ..]) => {
                let digit = |byte: &u8| char::from(*byte).to_digit(16);
                let (Some(high), Some(low)) = (digit(high), digit(low)) else { return Err(wrong()) };
                bytes.push((16 * high + low) as u8);
                left = after;
            }
            _ => bytes.push(*first),
        }
    }
    String::from_utf8(bytes).map(PathBuf::from).map_err(|_| wrong())
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2FreeInstance(instance: Pointer) {
    free(instance);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetupExperiment(
    instance: Pointer,
    _tolerance_defined: i32,
    _tolerance: f64,
    start: f64,
    _stop_defined: i32,
    _stop: f64,
) -> Status {
    with(instance, "fmi2SetupExperiment", |handle| {
        handle.start = start;
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2EnterInitializationMode(instance: Pointer) -> Status {
    with(instance, "fmi2EnterInitializationMode", |handle| {
        handle.instance.begin(handle.start)?;
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2ExitInitializationMode(instance: Pointer) -> Status {
    with(instance, "fmi2ExitInitializationMode", settle)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2Terminate(instance: Pointer) -> Status {
    with(instance, "fmi2Terminate", terminate)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2Reset(instance: Pointer) -> Status {
    reset(instance, "fmi2Reset")
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetReal(instance: Pointer, references: *const u32, count: usize, values: *mut f64) -> Status {
    with(instance, "fmi2GetReal", |handle| {
        get(list(references, count), list_mut(values, count), |reference| handle.instance.number(reference))
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetBoolean(
    instance: Pointer,
    references: *const u32,
    count: usize,
    values: *mut i32,
) -> Status {
    with(instance, "fmi2GetBoolean", |handle| {
        let truth = |reference| handle.instance.truth(reference).map(i32::from);
        get(list(references, count), list_mut(values, count), truth)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetReal(
    instance: Pointer,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> Status {
    with(instance, "fmi2SetReal", |handle| set(&mut handle.instance, list(references, count), list(values, count)))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2GetFMUstate(instance: Pointer, place: *mut Pointer) -> Status {
    with(instance, "fmi2GetFMUstate", |handle| keep(handle, place))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2SetFMUstate(instance: Pointer, kept: Pointer) -> Status {
    with(instance, "fmi2SetFMUstate", |handle| restore(handle, kept))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2FreeFMUstate(instance: Pointer, place: *mut Pointer) -> Status {
    with(instance, "fmi2FreeFMUstate", |_| {
        forget(place);
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi2DoStep(instance: Pointer, point: f64, size: f64, _no_set_state_before: i32) -> Status {
    if instance.is_null() {
        return ERROR;
    }
    with(instance, "fmi2DoStep", |handle| {
        handle.instance.step(point, size)?;
        Ok(OK)
    })
}

#[cfg(test)]
mod tests {
    use super::path;
    use std::path::Path;

    #[cfg(unix)]
    #[test]
    fn addresses_are_paths() {
        for address in
            ["file:///tmp/a%20b/resources", "file:/tmp/a%20b/resources", "file://localhost/tmp/a b/resources"]
        {
            assert_eq!(path(address).expect("a path"), Path::new("/tmp/a b/resources"), "{address}");
        }
        for wrong in ["http://host/resources", "file:///tmp/%zz"] {
            assert!(path(wrong).is_err(), "{wrong}");
        }
    }
}
