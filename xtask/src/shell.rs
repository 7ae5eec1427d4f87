//! Other programs, started from the root of the project.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The root of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A program, started from the root.
pub fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root());
    command
}

/// Runs cargo, as the one that runs this.
pub fn cargo(arguments: &[&str]) -> Result<(), String> {
    run(command(&cargo_path(), arguments))
}

/// The cargo that runs this.
pub fn cargo_path() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

/// A program of the workspace as the tests run it. It is built together with them: built alone it would have other features of its
/// dependencies, and all that stands between would be compiled a second time.
pub fn program(name: &str) -> Result<String, String> {
    program_with(name, &[])
}

/// The same with features.
pub fn program_with(name: &str, features: &[&str]) -> Result<String, String> {
    cargo(&[&["build", "--workspace", "--bins", "--tests", "--locked", "--quiet"], features].concat())?;
    Ok(root().join("target/debug").join(name).to_string_lossy().into_owned())
}

/// The program as users have it.
pub fn released() -> Result<String, String> {
    cargo(&["build", "--release", "--locked", "--package", "tsubu-cli", "--quiet"])?;
    Ok(root().join("target/release/tsubu").to_string_lossy().into_owned())
}

/// Runs a command, says which, and fails when it does.
pub fn run(mut command: Command) -> Result<(), String> {
    let words: Vec<_> = command.get_args().map(|word| word.to_string_lossy().into_owned()).collect();
    let program = Path::new(command.get_program()).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let told = format!("{program} {}", words.join(" "));
    eprintln!("\n> {told}");
    let status = command.status().map_err(|error| format!("cannot start `{told}`: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{told}` failed ({status})")) }
}

/// What a program, given these arguments, prints to stdout.
pub fn output(program: &str, arguments: &[&str]) -> Result<String, String> {
    let told = format!("{program} {}", arguments.join(" "));
    let done = command(program, arguments).stderr(Stdio::inherit()).output();
    let done = done.map_err(|error| format!("cannot start `{told}`: {error}"))?;
    if !done.status.success() {
        return Err(format!("`{told}` failed ({})", done.status));
    }
    String::from_utf8(done.stdout).map_err(|_| format!("`{told}` printed what is no text"))
}

/// Whether a command can be run and succeeds, in silence.
pub fn succeeds(mut command: Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
}

/// A Python with a package, which it has if it can run `import`: the system's, or one in an environment of our own under `target/`.
pub fn python_with(package: &str, import: &str) -> Option<String> {
    let has = |python: &str| succeeds(command(python, &["-c", import]));
    if has("python3") {
        return Some("python3".to_owned());
    }
    let name = package.split('=').next().unwrap_or(package);
    let home = root().join("target").join(name);
    let python = home.join("bin/python3").to_str()?.to_owned();
    if !has(&python) {
        run(command("python3", &["-m", "venv", home.to_str()?])).ok()?;
        run(command(&python, &["-m", "pip", "install", "--quiet", "--disable-pip-version-check", package])).ok()?;
    }
    has(&python).then_some(python)
}

/// Whether a program is there.
pub fn on_path(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}
