//! The functions of FMI 3.0 for co-simulation.

use super::log::{Listener, Log, Three};
use super::{
    ERROR, OK, Pointer, Status, forget, free, get, instantiate, keep, list, list_mut, put, read, reset, restore, set,
    settle, terminate, text, with,
};
use crate::error::Error;
use std::ffi::{c_char, c_void};
use std::path::Path;
use std::ptr::null_mut;

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Errors and warnings are always said, and there is nothing else to say.
#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetDebugLogging(
    instance: Pointer,
    _logging_on: bool,
    count: usize,
    categories: *const *const c_char,
) -> Status {
    with(instance, "fmi3SetDebugLogging", |_| {
        for category in list(categories, count) {
            let category = text(*category, "category")?;
            if !["logStatusError", "logStatusWarning"].contains(&category) {
                return Err(Error::new(format!("there is no log category `{category}`"))
                    .hint("there are `logStatusError` and `logStatusWarning`"));
            }
        }
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _instance_name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    event_mode_used: bool,
    _early_return_allowed: bool,
    _intermediate_variables: *const u32,
    intermediate_count: usize,
    environment: *mut c_void,
    listener: Option<Three>,
    _intermediate_update: *const c_void,
) -> Pointer {
    let listener = listener.map_or(Listener::None, Listener::Three);
    instantiate("fmi3InstantiateCoSimulation", Log { environment, listener }, || {
        if event_mode_used {
            return Err(Error::new("this unit has no event mode"));
        }
        if intermediate_count > 0 {
            return Err(Error::new("this unit has no variables in the middle of a step"));
        }
        read(Path::new(text(resources, "path of resources")?), text(token, "instantiation token")?)
    })
}

/// Says why there is no such instance.
fn only_co_simulation(function: &str, environment: *mut c_void, listener: Option<Three>) -> Pointer {
    let log = Log { environment, listener: listener.map_or(Listener::None, Listener::Three) };
    log.say(ERROR, &format!("{function}: this unit is for co-simulation alone"));
    null_mut()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateModelExchange(
    _instance_name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    environment: *mut c_void,
    listener: Option<Three>,
) -> Pointer {
    only_co_simulation("fmi3InstantiateModelExchange", environment, listener)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _instance_name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    environment: *mut c_void,
    listener: Option<Three>,
    _clock_update: *const c_void,
    _lock_preemption: *const c_void,
    _unlock_preemption: *const c_void,
) -> Pointer {
    only_co_simulation("fmi3InstantiateScheduledExecution", environment, listener)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeInstance(instance: Pointer) {
    free(instance);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: Pointer,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> Status {
    with(instance, "fmi3EnterInitializationMode", |handle| {
        handle.instance.begin(start)?;
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3ExitInitializationMode(instance: Pointer) -> Status {
    with(instance, "fmi3ExitInitializationMode", settle)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3Terminate(instance: Pointer) -> Status {
    with(instance, "fmi3Terminate", terminate)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3Reset(instance: Pointer) -> Status {
    reset(instance, "fmi3Reset")
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetFloat64(
    instance: Pointer,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> Status {
    with(instance, "fmi3GetFloat64", |handle| {
        get(list(references, count), list_mut(values, value_count), |reference| handle.instance.number(reference))
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetBoolean(
    instance: Pointer,
    references: *const u32,
    count: usize,
    values: *mut bool,
    value_count: usize,
) -> Status {
    with(instance, "fmi3GetBoolean", |handle| {
        get(list(references, count), list_mut(values, value_count), |reference| handle.instance.truth(reference))
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetFloat64(
    instance: Pointer,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> Status {
    with(instance, "fmi3SetFloat64", |handle| {
        set(&mut handle.instance, list(references, count), list(values, value_count))
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetFMUState(instance: Pointer, place: *mut Pointer) -> Status {
    with(instance, "fmi3GetFMUState", |handle| keep(handle, place))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetFMUState(instance: Pointer, kept: Pointer) -> Status {
    with(instance, "fmi3SetFMUState", |handle| restore(handle, kept))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeFMUState(instance: Pointer, place: *mut Pointer) -> Status {
    with(instance, "fmi3FreeFMUState", |_| {
        forget(place);
        Ok(OK)
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3DoStep(
    instance: Pointer,
    point: f64,
    size: f64,
    _no_set_state_before: bool,
    event_needed: *mut bool,
    wants_end: *mut bool,
    early_return: *mut bool,
    last_time: *mut f64,
) -> Status {
    put(event_needed, false);
    put(wants_end, false);
    put(early_return, false);
    put(last_time, point);
    with(instance, "fmi3DoStep", |handle| {
        handle.instance.step(point, size)?;
        put(last_time, point + size);
        Ok(OK)
    })
}
