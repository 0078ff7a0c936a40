//! Lets the linker of macOS leave what Python provides to the moment when the module is loaded.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
