// Compiles the C++ half of the bridge; its header goes to $CARGO_TARGET_DIR/cxxbridge, where CMake looks for it.
fn main() {
    cxx_build::bridge("src/lib.rs").include("../..").std("c++20").compile("urto_zenoh_bridge");
    println!("cargo:rerun-if-changed=src/lib.rs");
    println!("cargo:rerun-if-changed=handlers.h");
}
