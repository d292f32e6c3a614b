# The Rust half of the Zenoh transport (server/transport/zenoh) as the imported target urto_zenoh, built by cargo into
# the build folder. The first build compiles some 200 crates and takes minutes; cargo shows how far it is.
set(URTO_RUST_VERSION_LEAST "1.85")  # the rust-version of Cargo.toml

find_program(URTO_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin")
set(URTO_CARGO_HELP "Debian 12: apt install cargo-web rustc-web. Debian 13: apt install cargo rustc. Elsewhere: https://rustup.rs")
if(NOT URTO_CARGO)
  message(FATAL_ERROR "The Zenoh transport needs cargo, which is not installed. ${URTO_CARGO_HELP}")
endif()
execute_process(
  COMMAND "${URTO_CARGO}" --version
  WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}/server/transport/zenoh"
  OUTPUT_VARIABLE URTO_CARGO_VERSION_TEXT
  OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REGEX MATCH "[0-9]+\\.[0-9]+(\\.[0-9]+)?" URTO_CARGO_VERSION "${URTO_CARGO_VERSION_TEXT}")
if("${URTO_CARGO_VERSION}" VERSION_LESS URTO_RUST_VERSION_LEAST)
  message(FATAL_ERROR "The Zenoh transport needs cargo ${URTO_RUST_VERSION_LEAST}; ${URTO_CARGO} says "
                      "\"${URTO_CARGO_VERSION_TEXT}\". ${URTO_CARGO_HELP}")
endif()

set(URTO_ZENOH_SOURCE "${CMAKE_SOURCE_DIR}/server/transport/zenoh")
set(URTO_ZENOH_TARGET "${CMAKE_BINARY_DIR}/cargo" CACHE PATH "Where cargo builds; build folders may share one")
set(URTO_ZENOH_LIBRARY "${URTO_ZENOH_TARGET}/release/liburto_zenoh.a")
set(URTO_ZENOH_INCLUDE "${URTO_ZENOH_TARGET}/cxxbridge")

# Always in release, whatever the C++ side is: nobody steps through Zenoh here. The C++ half of the bridge is compiled
# with CMake's own compiler.
add_custom_command(
  OUTPUT "${URTO_ZENOH_LIBRARY}"
  BYPRODUCTS "${URTO_ZENOH_INCLUDE}/urto_zenoh/src/lib.rs.h" "${URTO_ZENOH_INCLUDE}/rust/cxx.h"
  COMMAND
    "${CMAKE_COMMAND}" -E env "CARGO_TARGET_DIR=${URTO_ZENOH_TARGET}"
    "CXX=${CMAKE_CXX_COMPILER}" "${URTO_CARGO}" build --release --locked
  COMMAND "${CMAKE_COMMAND}" -E touch "${URTO_ZENOH_LIBRARY}"  # cargo leaves it alone when only a comment changed
  DEPENDS
    "${URTO_ZENOH_SOURCE}/src/lib.rs" "${URTO_ZENOH_SOURCE}/src/guard.rs" "${URTO_ZENOH_SOURCE}/build.rs" "${URTO_ZENOH_SOURCE}/handlers.h"
    "${URTO_ZENOH_SOURCE}/Cargo.toml" "${URTO_ZENOH_SOURCE}/Cargo.lock"
  WORKING_DIRECTORY "${URTO_ZENOH_SOURCE}"
  COMMENT "Building the Zenoh bridge with cargo (the first time takes minutes)"
  USES_TERMINAL VERBATIM)
add_custom_target(urto_zenoh_cargo DEPENDS "${URTO_ZENOH_LIBRARY}")

file(MAKE_DIRECTORY "${URTO_ZENOH_INCLUDE}")  # an imported target may not name a folder that is missing
add_library(urto_zenoh STATIC IMPORTED GLOBAL)
set_target_properties(urto_zenoh PROPERTIES IMPORTED_LOCATION "${URTO_ZENOH_LIBRARY}")
target_include_directories(urto_zenoh INTERFACE "${URTO_ZENOH_INCLUDE}")
target_link_libraries(urto_zenoh INTERFACE Threads::Threads ${CMAKE_DL_LIBS} m)
# psm, a dependency of Zenoh's configuration parser, has assembly without a stack note; its stack need not be executable.
target_link_options(urto_zenoh INTERFACE -Wl,--gc-sections -Wl,-z,noexecstack)
add_dependencies(urto_zenoh urto_zenoh_cargo)
