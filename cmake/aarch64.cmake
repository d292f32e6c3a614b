# Toolchain: the physics and its tests for AArch64, run on another processor by qemu's user mode.
# Debian: g++-aarch64-linux-gnu qemu-user. Programs are static, so that qemu needs no foreign root.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
# Packages of headers alone (Eigen, tl-expected) are the host's; programs are the host's too. Nothing is linked from there:
# GoogleTest is built from source (tests/CMakeLists.txt).
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
