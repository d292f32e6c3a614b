# Sourced by the scripts beside this folder: says what happens, and installs and builds what is missing.
# Needs bash and what every Debian has; everything else it brings itself.
# shellcheck shell=bash

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly ROOT
readonly VENV="$ROOT/.venv"
readonly URTOD="$ROOT/build/release/bin/urtod"
readonly CARGO_VERSION_MIN=1.85
readonly PYTHON_VERSION_MIN=3.11

if [ -t 1 ]; then BOLD=$'\e[1m' PLAIN=$'\e[0m'; else BOLD='' PLAIN=''; fi

say() { printf '%s==>%s %s\n' "$BOLD" "$PLAIN" "$*"; }
note() { printf '    %s\n' "$*"; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# version_at_least HAVE LEAST: compares dotted versions.
version_at_least() { [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]; }

# Runs a command as root: as it is if we are, else by sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "this needs root or sudo: $*"
  fi
}

# Those of the named ones that are installed. (dpkg-query fails if it does not know one of them; that is no failure here.)
installed_packages() { { dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true; } | sed -n 's/^installed //p'; }
package_candidate() { LC_ALL=C apt-cache policy "$1" 2>/dev/null | sed -n 's/^  Candidate: //p' | sed '/(none)/d'; }

# apt_install PACKAGE…: installs the ones that are missing. It never removes a package.
apt_install() {
  local package missing=() installed
  command -v dpkg-query >/dev/null || { note "not a Debian: taking for granted what these packages hold: $*"; return; }
  installed=" $(installed_packages "$@" | tr '\n' ' ') "
  for package in "$@"; do [[ $installed == *" $package "* ]] || missing+=("$package"); done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "Installing from Debian: ${missing[*]}"
  for package in "${missing[@]}"; do
    if [ -z "$(package_candidate "$package")" ]; then apt_update; break; fi
  done
  apt_get_install "${missing[@]}" && return 0
  apt_update  # the package lists may be older than the archive
  apt_get_install "${missing[@]}" || die "apt-get could not install ${missing[*]}; its words are above"
}

apt_update() {
  note "apt-get update"
  as_root apt-get update -qq || die "apt-get update failed: is the network there?"
}

# Shows one line per package, and everything if it fails.
apt_get_install() {
  local log status=0
  log=$(mktemp)
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-remove --no-install-recommends "$@" 2>&1 |
    tee "$log" | sed -un 's/^Need to get \(.*\) of archives.*/    to download: \1/p; s/^Setting up \([^ ]*\).*/    \1/p' || status=$?
  [ "$status" -eq 0 ] || tail -n 20 "$log" >&2
  rm -f "$log"
  return "$status"
}

# ---- Rust ----

cargo_version() { cargo --version 2>/dev/null | sed -n 's/^cargo \([0-9]*\.[0-9]*\).*/\1/p'; }
have_cargo() { local version; version=$(cargo_version); [ -n "$version" ] && version_at_least "$version" "$CARGO_VERSION_MIN"; }

# A cargo that is new enough: the one on PATH, rustup's, or the distribution's.
ensure_cargo() {
  have_cargo && return 0
  if [ -x "$HOME/.cargo/bin/cargo" ]; then
    PATH="$HOME/.cargo/bin:$PATH"
    have_cargo && return 0
  fi
  command -v apt-cache >/dev/null || die "needs cargo ≥ $CARGO_VERSION_MIN: https://rustup.rs"
  [ -n "$(package_candidate cargo)" ] || apt_update
  # Debian 12 has an old cargo, and a new one under another name.
  if version_at_least "$(package_candidate cargo)" "$CARGO_VERSION_MIN"; then
    apt_install cargo rustc
  else
    apt_install cargo-web rustc-web
  fi
  hash -r
  have_cargo || die "cargo $(cargo_version) is older than $CARGO_VERSION_MIN; a newer one comes from https://rustup.rs"
}

# ---- Python ----

find_python() {
  local candidate
  for candidate in python3 /usr/bin/python3; do
    "$candidate" -c "import sys, venv, ensurepip; sys.exit(sys.version_info < (${PYTHON_VERSION_MIN/./, }))" 2>/dev/null || continue
    "$candidate" -c 'import sys; print(sys.executable)'
    return 0
  done
  return 1
}

made_from() { cat "$ROOT/clients/python/requirements.lock" "$ROOT/clients/python/pyproject.toml" "$@" | sha256sum; }

# ensure_venv [LOCK…]: the project's own environment with the client, its pinned packages and those of the further
# lock files. It is made or changed only when what it is made from has changed; what holds more than asked for serves.
ensure_venv() {
  local python identity lock arguments=() locks=("$ROOT/clients/python/requirements.lock" "$@")
  python=$(find_python) || { apt_install python3 python3-venv; python=$(find_python); } ||
    die "needs Python ≥ $PYTHON_VERSION_MIN with its modules venv and ensurepip"
  identity="$ROOT, $("$python" -VV)"
  if [ "$(cat "$VENV/.python" 2>/dev/null)" != "$identity" ]; then
    say "Making the Python environment .venv"
    rm -rf "$VENV"
    "$python" -m venv "$VENV"
    echo "$identity" >"$VENV/.python"
  fi
  grep -qsxF "$(made_from "$@")" "$VENV/.made-from" && return 0
  say "Installing the Python packages that the lock files name"
  for lock in "${locks[@]}"; do arguments+=(-r "$lock"); done
  "$VENV/bin/python" -m pip install --disable-pip-version-check --progress-bar off "${arguments[@]}" |
    sed -un 's/^ *Downloading \([^ /]*\) (\(.*\))/    \1 (\2)/p' || die "pip failed; its words are above"
  "$VENV/bin/python" -m pip install --disable-pip-version-check --quiet --no-deps --editable "$ROOT/clients/python" ||
    die "pip could not install clients/python; its words are above"
  { made_from; made_from "$@"; } >"$VENV/.made-from"
}

# ---- C++ ----

readonly BUILD_PACKAGES=(ca-certificates g++ cmake ninja-build protobuf-compiler libprotobuf-dev libeigen3-dev libexpected-dev
  libxxhash-dev libhwy-dev libspdlog-dev libcli11-dev)
readonly TEST_PACKAGES=(libgtest-dev libgmock-dev)
readonly PICTURE_PACKAGES=(mesa-vulkan-drivers libvulkan1)  # Rerun draws without a screen by software Vulkan
readonly WINDOW_PACKAGES=(mesa-vulkan-drivers libvulkan1 libxkbcommon-x11-0 libx11-xcb1 libxcursor1 libxi6 libxrandr2)  # what a window loads

# configure PRESET [OPTION…]: once; ninja itself configures again when a CMake file changes.
configure() {
  local preset=$1 folder="$ROOT/build/$1" log
  shift
  if [ -f "$folder/build.ninja" ] && [ "$(cat "$folder/.options" 2>/dev/null)" = "$ROOT $*" ]; then return 0; fi
  say "Configuring build/$preset"
  mkdir -p "$folder"
  log="$folder/configure.log"
  (cd "$ROOT" && cmake --preset "$preset" "$@") >"$log" 2>&1 || { tail -n 30 "$log" >&2; die "CMake failed; all of its words: $log"; }
  echo "$ROOT $*" >"$folder/.options"
}

# build PRESET TARGET…: shows how many steps are done and the time since the start.
build() {
  local folder="$ROOT/build/$1" jobs=${URTO_JOBS:-}
  shift
  NINJA_STATUS='    [%f/%t %es] ' cmake --build "$folder" ${jobs:+--parallel "$jobs"} --target "$@" ||
    die "the build failed; the compiler's words are above"
}

# ---- the two halves of the project ----

set_up_server() {
  apt_install "${BUILD_PACKAGES[@]}"
  ensure_cargo
  [ -f "$ROOT/build/release/build.ninja" ] || configure release -DURTO_BUILD_TESTS=OFF
  if [ ! -x "$URTOD" ]; then
    say "Building the server; the first time takes minutes, most of them for Zenoh"
  fi
  build release urtod
}

set_up_client() {
  apt_install ca-certificates
  ensure_venv
}
