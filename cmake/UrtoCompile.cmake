# The compile flags of every target, through the interface target urto_compile.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(URTO_CCACHE ccache)
if(URTO_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${URTO_CCACHE}")
endif()

set(URTO_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

add_library(urto_compile INTERFACE)
target_include_directories(urto_compile INTERFACE "${CMAKE_SOURCE_DIR}/server")
# No contraction into fused multiply-adds, and no Eigen packets: the same bits on every compiler and processor
# (docs/architecture.md, Determinism).
target_compile_options(urto_compile INTERFACE -ffp-contract=off -fno-math-errno -Wall -Wextra -Wshadow)
target_compile_definitions(urto_compile INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)
if(URTO_SANITIZE)
  target_compile_options(urto_compile INTERFACE -fsanitize=${URTO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(urto_compile INTERFACE -fsanitize=${URTO_SANITIZE})
endif()
