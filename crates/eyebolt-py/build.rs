//! What linkers want to hear of a module that finds Python's symbols where it is loaded.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
