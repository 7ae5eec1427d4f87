//! Lets the linker leave what Python brings to Python.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
