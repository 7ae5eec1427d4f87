//! The door: the C functions of the standard. Each finds its instance, does one thing with it, and tells what went wrong.
//!
//! Nothing unsafe is outside of this folder. What it relies on is what the standard demands of the tool: an instance is what
//! instantiation has returned and was not freed, is used by one thread at a time, and lists are as long as is said beside them.

#![allow(
    unsafe_code,
    reason = "the functions of the standard are called from C, with pointers to instances, texts and lists"
)]
#![allow(non_snake_case, reason = "the standard names them")]
#![allow(clippy::too_many_arguments, reason = "the standard counts them")]

mod fmi2;
mod fmi3;
mod log;
mod unsupported;

use crate::error::Error;
use crate::instance::{Instance, Snapshot};
use log::Log;
use std::any::Any;
use std::ffi::{CStr, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::ptr::null_mut;

/// What a function returns, in both versions: an enumeration of C.
type Status = i32;
/// All went well.
const OK: Status = 0;
/// It did, but something is to be said.
const WARNING: Status = 1;
/// It did not; a reset begins anew.
const ERROR: Status = 3;

/// An instance, as the tool holds it.
type Pointer = *mut c_void;

/// An instance with its way to talk to the tool.
struct Handle {
    instance: Instance,
    log: Log,
    /// Time of the tool at the start [s], which version 2.0 tells before the initialization begins.
    start: f64,
}

/// Makes an instance; nothing, and a message, where there is none to make.
fn instantiate(function: &str, log: Log, make: impl FnOnce() -> Result<Instance, Error>) -> Pointer {
    match caught(make) {
        Ok(instance) => Box::into_raw(Box::new(Handle { instance, log, start: 0.0 })).cast(),
        Err(error) => {
            log.say(ERROR, &format!("{function}: {error}"));
            null_mut()
        }
    }
}

/// Does something with an instance. What goes wrong goes to the log; a panic ends the instance, and stays here.
fn with(pointer: Pointer, function: &str, work: impl FnOnce(&mut Handle) -> Result<Status, Error>) -> Status {
    // SAFETY: the tool gives what `instantiate` has made and `free` has not yet taken, to one thread at a time.
    let Some(handle) = (unsafe { pointer.cast::<Handle>().as_mut() }) else { return ERROR };
    match catch_unwind(AssertUnwindSafe(|| work(&mut *handle))) {
        Ok(Ok(status)) => status,
        Ok(Err(error)) => {
            handle.log.say(ERROR, &format!("{function}: {error}"));
            ERROR
        }
        Err(panic) => {
            handle.instance.give_up();
            handle.log.say(ERROR, &format!("{function}: {}", mistake(&*panic)));
            ERROR
        }
    }
}

/// The same for what is done before there is an instance.
fn caught<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(mistake(&*panic)))
}

/// What to say of a panic.
fn mistake(panic: &(dyn Any + Send)) -> Error {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    Error::new(format!("a mistake in tsubu: {}", text.unwrap_or("a panic without words")))
        .hint("please report it with the scene")
}

/// Frees an instance.
fn free(pointer: Pointer) {
    if !pointer.is_null() {
        // SAFETY: made by `instantiate`, and the tool does not use it any more.
        let handle = unsafe { Box::from_raw(pointer.cast::<Handle>()) };
        let _ = catch_unwind(AssertUnwindSafe(|| drop(handle)));
    }
}

/// A text of the tool.
fn text<'a>(text: *const c_char, what: &str) -> Result<&'a str, Error> {
    if text.is_null() {
        return Err(Error::new(format!("the tool gives no {what}")));
    }
    // SAFETY: not null, ends with a zero, and lives as long as the call.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|_| Error::new(format!("the {what} is not UTF-8")))
}

/// A list of the tool.
fn list<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if first.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: not null, with `count` values behind it, and it lives as long as the call.
    unsafe { std::slice::from_raw_parts(first, count) }
}

/// A list of the tool to be filled.
fn list_mut<'a, T>(first: *mut T, count: usize) -> &'a mut [T] {
    if first.is_null() || count == 0 {
        return &mut [];
    }
    // SAFETY: as above, and nobody else looks at it during the call.
    unsafe { std::slice::from_raw_parts_mut(first, count) }
}

/// Puts a value where the tool wants it, if it does.
fn put<T>(place: *mut T, value: T) {
    if !place.is_null() {
        // SAFETY: not null, and the tool's place for one value.
        unsafe { place.write(value) };
    }
}

/// Values for value references, as many as there are references.
fn get<T>(references: &[u32], values: &mut [T], mut of: impl FnMut(u32) -> Result<T, Error>) -> Result<Status, Error> {
    same_length(references.len(), values.len())?;
    for (reference, value) in references.iter().zip(values) {
        *value = of(*reference)?;
    }
    Ok(OK)
}

/// Sets inputs.
fn set(instance: &mut Instance, references: &[u32], values: &[f64]) -> Result<Status, Error> {
    same_length(references.len(), values.len())?;
    for (reference, value) in references.iter().zip(values) {
        instance.set(*reference, *value)?;
    }
    Ok(OK)
}

fn same_length(references: usize, values: usize) -> Result<(), Error> {
    if references == values {
        return Ok(());
    }
    Err(Error::new(format!("{references} value references and {values} values: each variable has one")))
}

/// Reads the scene of a unit.
fn read(resources: &Path, token: &str) -> Result<Instance, Error> {
    Instance::new(resources, token)
}

/// Opens the scene, and says what its method has to say.
fn settle(handle: &mut Handle) -> Result<Status, Error> {
    for note in handle.instance.settle()? {
        handle.log.say(WARNING, &note);
    }
    Ok(OK)
}

/// Ends the simulation, with a word on books that do not close.
fn terminate(handle: &mut Handle) -> Result<Status, Error> {
    let said = handle.instance.terminate()?;
    if let Some(text) = &said {
        handle.log.say(WARNING, text);
    }
    Ok(if said.is_some() { WARNING } else { OK })
}

/// Makes the instance new.
fn reset(pointer: Pointer, function: &str) -> Status {
    with(pointer, function, |handle| {
        handle.instance.reset();
        handle.start = 0.0;
        Ok(OK)
    })
}

/// Keeps what the instance is: in a place that was kept before, or a new one.
fn keep(handle: &Handle, place: *mut Pointer) -> Result<Status, Error> {
    let snapshot = handle.instance.snapshot();
    // SAFETY: the tool's place for one pointer, which is null or was put there by this function.
    let Some(place) = (unsafe { place.as_mut() }) else { return Err(Error::new("there is no place for the state")) };
    // SAFETY: as above.
    match unsafe { place.cast::<Snapshot>().as_mut() } {
        Some(kept) => *kept = snapshot,
        None => *place = Box::into_raw(Box::new(snapshot)).cast(),
    }
    Ok(OK)
}

/// Makes the instance what it was.
fn restore(handle: &mut Handle, kept: Pointer) -> Result<Status, Error> {
    // SAFETY: null, or made by `keep` and not yet forgotten.
    let Some(kept) = (unsafe { kept.cast::<Snapshot>().as_ref() }) else { return Err(Error::new("there is no state")) };
    handle.instance.restore(kept)?;
    Ok(OK)
}

/// Forgets what was kept.
fn forget(place: *mut Pointer) {
    // SAFETY: as in `keep`.
    if let Some(place) = unsafe { place.as_mut() }
        && !place.is_null()
    {
        // SAFETY: made by `keep`; the place is emptied, so that it is not freed twice.
        drop(unsafe { Box::from_raw(place.cast::<Snapshot>()) });
        *place = null_mut();
    }
}

#[cfg(test)]
mod tests {
    use super::log::{Listener, Log};
    use super::{ERROR, Handle, OK, Pointer, Status, free, instantiate, with};
    use crate::error::Error;
    use crate::instance::{Instance, Mode};
    use std::ffi::{CStr, c_char, c_void};
    use std::path::Path;
    use std::ptr::null_mut;
    use std::sync::Mutex;
    use tsubu_scene::Scene;

    /// Keeps messages in the environment.
    unsafe extern "C" fn hear(environment: *mut c_void, status: Status, kind: *const c_char, text: *const c_char) {
        // SAFETY: the environment that `log` has given, and texts that live during the call.
        let (heard, kind, text) =
            unsafe { (&*environment.cast::<Mutex<Vec<String>>>(), CStr::from_ptr(kind), CStr::from_ptr(text)) };
        let line = format!("{status} {}: {}", kind.to_string_lossy(), text.to_string_lossy());
        heard.lock().expect("nobody else").push(line);
    }

    fn log(heard: &Mutex<Vec<String>>) -> Log {
        Log { environment: std::ptr::from_ref(heard).cast_mut().cast(), listener: Listener::Three(hear) }
    }

    fn scene() -> Scene {
        let text = include_str!("../../tests/scenes/ball.toml");
        Scene::parse("ball.toml", text, Path::new("."), &[]).expect("a scene")
    }

    /// A panic is an error with its words; the instance is given up, and nothing is unwound into C.
    #[test]
    fn a_panic_stays_here() {
        let heard = Mutex::default();
        let pointer = instantiate("make", log(&heard), || Ok(Instance::of(scene())));
        assert_eq!(with(pointer, "look", |_| Ok(OK)), OK);
        assert_eq!(with(pointer, "break", |_| panic!("oh {}", "dear")), ERROR);
        // SAFETY: made above, not yet freed.
        let mode = unsafe { &*pointer.cast::<Handle>() }.instance.mode();
        assert_eq!(mode, Mode::Failed);
        free(pointer);
        assert!(instantiate("make", log(&heard), || panic!("at once")).is_null());
        assert!(instantiate("make", log(&heard), || Err(Error::new("no").hint("yes"))).is_null());
        let hint = "hint: please report it with the scene";
        let expected = [
            format!("3 logStatusError: break: a mistake in tsubu: oh dear\n{hint}"),
            format!("3 logStatusError: make: a mistake in tsubu: at once\n{hint}"),
            "3 logStatusError: make: no\nhint: yes".to_owned(),
        ];
        assert_eq!(*heard.lock().expect("nobody else"), expected);
    }

    /// Without an instance nothing is done.
    #[test]
    fn no_instance_is_an_error() {
        let nobody: Pointer = null_mut();
        assert_eq!(with(nobody, "look", |_| Ok(OK)), ERROR);
        free(nobody);
    }
}
