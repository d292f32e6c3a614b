"""Urto and its peers as programs that run a scene file: building them, and one run of one of them."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from building import BUILD, PEERS, ROOT, box2d_sources, build_step, cpu_facts, fail

Report = dict[str, Any]

EXIT_NOT_YET = 3  # of a driver whose engine lacks what the scene needs
RUN_SECONDS_MAX = 600

# What cargo is told for each build of Rapier: its features, and flags of the compiler. The second is its widest build.
RAPIER_WIDTHS = {"rapier": ([], ""), "rapier-avx2": (["simd8"], "-C target-feature=+avx2")}


@dataclass(frozen=True)
class Engine:
    name: str
    command: tuple[str, ...]
    command_of_many: tuple[str, ...] = ()  # on several threads, where that is another program
    threads_max: int | None = None  # None: any number

    def on(self, threads: int) -> tuple[str, ...]:
        return self.command_of_many if threads > 1 and self.command_of_many else self.command


def has_avx2() -> bool:
    return "avx2" in cpu_facts()["flags"]


def names() -> list[str]:
    """All engines that this machine can run, in the order of the table."""
    if platform.machine() not in ("x86_64", "AMD64"):
        return ["urto", "box2d-neon", "rapier"]
    widest = ["urto-avx2", "box2d-avx2", "rapier-avx2"] if has_avx2() else []
    return [name for pair in zip(["urto", "box2d-sse2", "rapier"], [*widest, "", "", ""]) for name in pair if name]


def widest(present: Collection[str]) -> list[str]:
    """Those of the names that have no wider build among them."""
    wider = {"urto-avx2": "urto", "box2d-sse2": "box2d-avx2", "rapier": "rapier-avx2"}
    return [name for name in present if wider.get(name) not in present]


def configure(targets: Sequence[str], jobs: int) -> None:
    """Builds targets of bench/CMakeLists.txt."""
    for tool in ("cmake", "cargo"):
        if shutil.which(tool) is None:
            fail(f"{tool} is missing; scripts/setup server installs what is needed")
    BUILD.mkdir(parents=True, exist_ok=True)
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    command = ["cmake", "-S", str(ROOT), "-B", str(BUILD), *generator, "-DCMAKE_BUILD_TYPE=Release"]
    options = ["BENCH=ON", "SERVER=OFF", "TESTS=OFF"]
    command += [f"-DURTO_BUILD_{option}" for option in options] + [f"-DURTO_BOX2D={box2d_sources()}"]
    build_step("configuring Urto and Box2D", command, BUILD / "configure.log")
    compile_all = ["cmake", "--build", str(BUILD), "--parallel", str(jobs), "--target", *targets]
    build_step("building Urto and Box2D (a minute or two the first time)", compile_all, BUILD / "build.log")


def _build_rapier(name: str, parallel: bool, jobs: int) -> str:
    features, flags = RAPIER_WIDTHS[name]
    features = [*features, *(["parallel"] if parallel else [])]
    target = ROOT / "build" / f"bench-{name.replace('rapier', 'peers')}{'-parallel' if parallel else ''}"
    cargo = ["cargo", "build", "--release", "--locked", "--bin", "peers", "--jobs", str(jobs)]
    cargo += ["--features", ",".join(features)] if features else []
    cargo += ["--manifest-path", str(PEERS / "Cargo.toml"), "--target-dir", str(target)]
    env = {**os.environ, "RUSTFLAGS": flags} if flags else None
    many = " for several threads" if parallel else ""
    build_step(f"building {name}{many} (some minutes the first time)", cargo, BUILD / "cargo.log", env)
    return str(target / "release" / "peers")


def build(jobs: int, threads: Collection[int], wanted: Collection[str], targets: Sequence[str] = ()) -> list[Engine]:
    """The engines that are wanted (none: all), and further targets of the C++ build."""
    known = names()
    chosen = [name for name in known if not wanted or name in wanted]
    if strange := [name for name in wanted if name not in known]:
        fail(f"no engine is called {', '.join(strange)}; here are {', '.join(known)}")
    drivers = BUILD / "bench"
    programs = {name: f"bench_{name.replace('-', '_')}" for name in chosen if name.startswith("box2d")}
    configure([*(["bench_urto"] if {"urto", "urto-avx2"} & set(chosen) else []), *programs.values(), *targets], jobs)
    engines = []
    for name in chosen:
        many: tuple[str, ...] = ()
        if name in programs:
            command: tuple[str, ...] = (str(drivers / programs[name]),)
        elif name in RAPIER_WIDTHS:
            command = (_build_rapier(name, False, jobs),)
            many = (_build_rapier(name, True, jobs),) if max(threads) > 1 and name in widest(chosen) else ()
        else:
            command = (str(drivers / "bench_urto"), *(["--simd", "AVX2"] if name == "urto-avx2" else []))
        engines.append(Engine(name, command, many))
    return engines


def run_once(
    engine: Engine, scene_file: Path, threads: int = 1, steps: int = 0, options: Sequence[str] = ()
) -> tuple[Report | None, str | None]:
    """What the driver reports, or why it reports nothing. Zero steps: as many as the scene says."""
    command = [*engine.on(threads), str(scene_file), "--threads", str(threads), *options]
    command += ["--steps", str(steps)] if steps else []
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=RUN_SECONDS_MAX)
    except subprocess.TimeoutExpired:
        return None, f"took more than {RUN_SECONDS_MAX} s"
    if done.returncode == EXIT_NOT_YET:
        return None, "not yet: " + done.stderr.strip()
    if done.returncode != 0:
        return None, f"failed ({done.returncode}): {done.stderr.strip()[-300:]}"
    return json.loads(done.stdout), None
