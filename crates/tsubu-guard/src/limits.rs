//! Other programs within limits.

use std::env;
use std::ffi::OsStr;
use std::io;
use std::path::PathBuf;
use std::process::Command;

/// Address space that tsubu has to do with [KiB]: 4 GB.
const ADDRESS_SPACE: u64 = 4 << 20;

/// A program that gets no more memory than tsubu has to do with. Where there is no shell that can say so, it gets all.
pub fn limited(program: impl AsRef<OsStr>) -> Command {
    if cfg!(target_os = "linux") {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("ulimit -v {ADDRESS_SPACE} && exec \"$0\" \"$@\"")]).arg(program);
        command
    } else {
        Command::new(program)
    }
}

/// Another program of the same build.
pub fn beside(name: &str) -> io::Result<PathBuf> {
    Ok(env::current_exe()?.with_file_name(format!("{name}{}", env::consts::EXE_SUFFIX)))
}
