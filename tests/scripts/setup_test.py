"""scripts/lib/setup.sh: only what is missing is installed, and only what has changed is made again.

apt-get, dpkg-query and the like are small stand-ins in a folder of their own that comes first on PATH.
"""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(name="machine")
def fixture_machine(tmp_path):
    return Machine(tmp_path)


class Machine:
    """A machine with the packages `installed` and an archive that offers what `offer` names."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.installed = folder / "installed"
        self.installed.write_text("")
        self.offered = folder / "offered"
        self.log = folder / "log"
        self.log.write_text("")
        self.command(
            "dpkg-query",
            'shift 2; status=0; for p in "$@"; do '
            f'if grep -qx "$p" {self.installed}; then echo "installed $p"; else status=1; fi; done; exit $status',
        )
        self.command(
            "apt-cache",
            f'v=$(sed -n "s/^$2 //p" {self.offered} 2>/dev/null); echo "$2:"; echo "  Candidate: ${{v:-(none)}}"',
        )
        self.command(
            "apt-get",
            f'echo "$*" >>{self.log}\n'
            f'if [ "$1" = update ]; then cp {self.folder}/archive {self.offered}; exit 0; fi\n'
            'for p in "$@"; do case $p in -*|install) ;; *)\n'
            f'  grep -q "^$p " {self.offered} || {{ echo "E: Unable to locate package $p"; exit 100; }}\n'
            f'  echo "$p" >>{self.installed}; echo "Setting up $p (1) ..." ;; esac; done',
        )
        self.command("sudo", '"$@"')

    def command(self, name: str, text: str) -> None:
        path = self.folder / name
        path.write_text(f"#!/bin/bash\n{text}\n")
        path.chmod(0o755)

    def archive(self, *packages: str, known: bool = True) -> None:
        text = "".join(f"{package}\n" for package in packages)
        (self.folder / "archive").write_text(text)
        if known:
            self.offered.write_text(text)

    def run(self, text: str, **environment: str) -> subprocess.CompletedProcess:
        script = f"set -euo pipefail; source {ROOT}/scripts/lib/setup.sh; {text}"
        path = {"PATH": f"{self.folder}:/usr/bin:/bin", "HOME": str(self.folder), **environment}
        return subprocess.run(
            ["bash", "-c", script], capture_output=True, text=True, check=False, env={**os.environ, **path}
        )


def test_nothing_is_installed_that_is_there(machine):
    machine.installed.write_text("g++\ncmake\n")
    result = machine.run("apt_install g++ cmake; echo went on")
    assert result.stdout == "went on\n"
    assert machine.log.read_text() == ""


def test_what_is_missing_is_installed_and_nothing_is_removed_for_it(machine):
    machine.installed.write_text("g++\n")
    machine.archive("g++ 1", "cmake 1")
    result = machine.run("apt_install g++ cmake; echo went on")
    assert "cmake" in result.stdout and result.stdout.endswith("went on\n"), result.stderr
    (line,) = machine.log.read_text().splitlines()
    assert line.split()[-1] == "cmake" and "g++" not in line.split() and "--no-remove" in line.split()


def test_the_package_lists_are_fetched_when_they_lack_a_package(machine):
    machine.archive("cmake 1", known=False)
    result = machine.run("apt_install cmake")
    assert result.returncode == 0, result.stderr
    assert [line.split()[0] for line in machine.log.read_text().splitlines()] == ["update", "install"]


def test_a_package_that_cannot_be_had_is_an_error_that_names_it(machine):
    machine.archive("cmake 1")
    result = machine.run("apt_install unheard-of; echo went on")
    assert result.returncode == 1
    assert "unheard-of" in result.stderr and "went on" not in result.stdout


CARGO = 'case $1 in --version) echo "cargo %s (0 2026-01-01)";; esac'


def test_a_cargo_that_is_new_enough_is_taken(machine):
    machine.command("cargo", CARGO % "1.85.0")
    assert machine.run("ensure_cargo").returncode == 0
    assert machine.log.read_text() == ""


@pytest.mark.parametrize(
    "offered, wanted",
    [
        (("cargo 0.66.0+ds1-1", "rustc 1.63", "cargo-web 1.85.0+dfsg3-1", "rustc-web 1.85.0"), "cargo-web rustc-web"),
        (("cargo 1.85.1+dfsg1-1", "rustc 1.85.0", "cargo-web 1.96.0", "rustc-web 1.96.0"), "cargo rustc"),
    ],
    ids=["Debian 12", "Debian 13"],
)
def test_an_old_cargo_is_replaced_by_what_the_distribution_has(machine, offered, wanted):
    machine.archive(*offered)
    machine.command("cargo", CARGO % "1.63.0")
    # The stand-in of apt-get brings the program too.
    (machine.folder / "new-cargo").write_text(f"#!/bin/bash\n{CARGO % '1.85.1'}\n")
    text = (machine.folder / "apt-get").read_text()
    machine.command(
        "apt-get", text.removeprefix("#!/bin/bash\n") + f"\ncat {machine.folder}/new-cargo >{machine.folder}/cargo"
    )
    result = machine.run("ensure_cargo")
    assert result.returncode == 0, result.stderr
    assert machine.log.read_text().splitlines()[-1].endswith(wanted)


@pytest.mark.parametrize(
    "have, least, enough",
    [("1.85", "1.85", 0), ("1.100", "1.85", 0), ("1.84", "1.85", 1), ("2.0", "1.85", 0), ("0.66", "1.85", 1)],
)
def test_versions_compare_by_number(machine, have, least, enough):
    assert machine.run(f"version_at_least {have} {least} || exit 1").returncode == enough
