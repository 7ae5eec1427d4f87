//! Says to the linker that the library stays in memory once it is loaded.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // A tool unloads the library when it is done with it, and the threads that have moved grains would wait in memory that is gone.
    let system = std::env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    if ["linux", "freebsd", "android"].contains(&system.as_str()) {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
