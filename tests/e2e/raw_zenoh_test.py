"""The schema and the documented keys are enough: no package of this project is used by the clients here."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT, TIME_STEP, TIMEOUT_S, WEIGHTLESS, Start


@pytest.fixture
def generated(tmp_path: Path) -> Path:
    """A folder with what protoc makes of the schema."""
    if shutil.which("protoc") is None:
        pytest.skip("no protoc here")
    folder = tmp_path / "generated"
    (folder / "urto" / "v1").mkdir(parents=True)
    sources = sorted((ROOT / "proto" / "urto" / "v1").glob("*.proto"))
    command = ["protoc", f"--proto_path={ROOT / 'proto'}", f"--python_out={folder}", *map(str, sources)]
    subprocess.run(command, check=True)
    # Ordinary packages come before the installed one of the same name.
    (folder / "urto" / "__init__.py").touch()
    (folder / "urto" / "v1" / "__init__.py").touch()
    return folder


def _run(folder: Path, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, *arguments], env={"PYTHONPATH": str(folder)}, cwd=folder, capture_output=True, text=True,
        timeout=TIMEOUT_S * 4, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_one_session_pushes_and_another_sees_it_move_as_computed(start: Start, generated: Path) -> None:
    urtod = start(WEIGHTLESS, "--room", "lab")
    result = json.loads(_run(generated, str(Path(__file__).with_name("raw_session.py")), urtod.endpoint, "lab"))
    assert result["sequences"] == [1, 2]
    ticks = [tick for tick, *_ in result["seen"]]
    assert ticks == sorted(ticks)
    for tick, sim_time, x, y in result["seen"]:
        # No gravity: v = (6, −3) N·s / 2 kg from the tick of the answer on.
        elapsed = (tick - result["pushed"]) * TIME_STEP
        assert sim_time == tick * TIME_STEP
        assert x == pytest.approx(1 + 3 * elapsed, abs=1e-12)
        assert y == pytest.approx(5 - 1.5 * elapsed, abs=1e-12)


def test_the_example_of_the_protocol_page_runs(start: Start, generated: Path) -> None:
    page = (ROOT / "docs" / "protocol.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    urtod = start("pyramid", "--room", "lab")
    assert "tcp/127.0.0.1:7447" in example
    script = generated / "example.py"
    script.write_text(example.replace("tcp/127.0.0.1:7447", urtod.endpoint), encoding="utf-8")
    printed = _run(generated, str(script)).splitlines()
    assert printed[0].startswith("room lab, scene pyramid, tick ")
    assert re.match(r"spawned \d+ at tick \d+", printed[1])
    assert re.match(r"tick \d+: the ball is at x = -?\d+\.\d\d m", printed[2])
