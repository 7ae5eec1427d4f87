//! What `tsubu bench` has found out about this machine, in the user's cache folder.

use std::env;
use std::path::PathBuf;
use tsubu::bench::Bench;
use tsubu_frame::summary::{read_json, write_json};

/// `$XDG_CACHE_HOME/tsubu/bench.json`, else the same below `~/.cache`.
fn file() -> Option<PathBuf> {
    let told = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let cache = told("XDG_CACHE_HOME").or_else(|| Some(told("HOME")?.join(".cache")))?;
    Some(cache.join("tsubu/bench.json"))
}

/// Keeps it; gives the file, or why not.
pub fn remember(bench: &Bench) -> Result<PathBuf, String> {
    let file = file().ok_or("neither XDG_CACHE_HOME nor HOME names a folder")?;
    write_json(&file, bench).map_err(|error| error.to_string())?;
    Ok(file)
}

/// What was measured last on a machine with as many cores; a damaged file is as good as none.
pub fn known() -> Option<Bench> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    read_json(&file()?).ok().filter(|bench: &Bench| bench.cores == cores)
}
