"""The command urto, the viewer's files and the examples, against a real server."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import urto
from conftest import EMPTY, ROOT, TIMEOUT_S, Start

URTO = Path(sys.executable).with_name("urto")


def _urto(endpoint: str, *arguments: str, code: int = 0) -> str:
    done = subprocess.run(
        [URTO, arguments[0], "--endpoint", endpoint, *arguments[1:]], capture_output=True, text=True,
        timeout=TIMEOUT_S * 4, check=False,
    )  # fmt: skip
    assert done.returncode == code, done.stderr
    return done.stdout or done.stderr


def test_the_shell_is_enough_to_play(start: Start) -> None:
    urtod = start(EMPTY, "--paused", "--room", "lab")
    assert _urto(urtod.endpoint, "rooms") == "lab\n"
    assert _urto(urtod.endpoint, "spawn", "box", "1", "1", "--at", "0", "5", "--name", "crate") == "1\n"
    assert _urto(urtod.endpoint, "impulse", "crate", "2", "-1") == "tick 0\n"
    assert _urto(urtod.endpoint, "step", "64") == "tick 64\n"
    frame = json.loads(_urto(urtod.endpoint, "echo", "events", "--count", "1", "--json"))
    assert frame["event"] == "MemberJoined"
    info = json.loads(_urto(urtod.endpoint, "info", "--json"))
    assert (info["room"], info["tick"], info["paused"], info["statistics"]["body_count"]) == ("lab", 64, True, 1)
    assert "scene      empty" in _urto(urtod.endpoint, "info")
    assert _urto(urtod.endpoint, "resume") == "tick 64\n"
    assert _urto(urtod.endpoint, "echo", "--count", "2").count("tick") == 2
    assert _urto(urtod.endpoint, "pause").startswith("tick ")
    assert _urto(urtod.endpoint, "reset").startswith("epoch ")
    assert _urto(urtod.endpoint, "impulse", "crate", "1", "0", code=4).count("\n") == 1


def test_a_view_is_saved_as_a_recording_and_a_picture(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    from PIL import Image
    from rerun.chunk import RrdReader

    urtod = start("pyramid")
    _urto(urtod.endpoint, "view", "--save", str(tmp_path), "--ticks", "60", "--contacts", "--velocities")
    recording = tmp_path / "room.rrd"
    rerun = Path(sys.executable).with_name("rerun")
    subprocess.run([rerun, "rrd", "verify", recording], check=True, capture_output=True)
    ticks, boxes, plots = [], set(), set()
    for chunk in RrdReader(recording).store().stream().to_chunks():
        batch, entity = chunk.to_record_batch(), str(chunk.entity_path)
        if entity == "/room/bodies/boxes" and "Boxes3D:centers" in batch.schema.names:
            ticks += batch.column("tick").to_pylist()
            boxes |= {len(centers) for centers in batch.column("Boxes3D:centers").to_pylist() if centers}
        if entity.startswith("/plots/"):
            plots.add(entity)
    assert boxes == {210}  # 20 rows
    assert max(ticks) >= min(ticks) + 60
    assert {"/plots/energy/total", "/plots/contacts/count", "/plots/step/ms", "/plots/penetration/mm"} <= plots
    picture = Image.open(tmp_path / "room.png").convert("RGB")
    width, height = picture.size
    colors = picture.getcolors(maxcolors=width * height)
    assert colors is not None
    assert len(colors) > 50
    # A pyramid: more of it in the lower half than in the upper one, and nothing beside its tip.
    background = picture.getpixel((3, 3))
    lit = [sum(picture.getpixel((x, y))[0] > 60 for x in range(0, width, 8)) for y in range(0, height, 8)]
    assert sum(lit[len(lit) // 2 :]) > 2 * sum(lit[: len(lit) // 2]) > 0
    assert max(background) < 60


@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_ends_a_view_in_order(start: Start, tmp_path: Path, by: signal.Signals) -> None:
    pytest.importorskip("rerun")
    urtod = start("pyramid")
    view = subprocess.Popen(
        [URTO, "view", "--endpoint", urtod.endpoint, "--save", tmp_path, "--seconds", "3600"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    assert view.stdout is not None
    recording = tmp_path / "room.rrd"
    assert view.stdout.readline() == f"recording to {recording}\n"
    view.send_signal(by)
    output, _ = view.communicate(timeout=TIMEOUT_S)
    assert view.returncode == 0, output
    assert "picture" in output
    rerun = Path(sys.executable).with_name("rerun")
    subprocess.run([rerun, "rrd", "verify", recording], check=True, capture_output=True)


def test_a_view_of_a_room_that_ends_is_saved_all_the_same(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    urtod = start("pyramid")
    view = subprocess.Popen(
        [URTO, "view", "--endpoint", urtod.endpoint, "--save", tmp_path, "--seconds", "3600"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert view.stdout is not None
    assert view.stdout.readline().startswith("recording to ")
    urtod.stop()
    output, errors = view.communicate(timeout=TIMEOUT_S)
    assert (view.returncode, errors.count("\n")) == (3, 1), errors
    assert "is gone" in errors
    assert "picture" in output
    rerun = Path(sys.executable).with_name("rerun")
    subprocess.run([rerun, "rrd", "verify", tmp_path / "room.rrd"], check=True, capture_output=True)


def test_the_web_viewer_is_served_on_loopback_until_the_view_ends(start: Start) -> None:
    pytest.importorskip("rerun")
    import urllib.request

    urtod = start("pyramid")
    view = subprocess.Popen(
        [URTO, "view", "--endpoint", urtod.endpoint, "--web"],
        stdout=subprocess.PIPE,
        text=True,
        stderr=subprocess.STDOUT,
    )
    assert view.stdout is not None
    line = view.stdout.readline()
    assert line.startswith("open in a browser: http://127.0.0.1:"), line
    page = line.split(": ", 1)[1].split("?")[0].strip()
    try:
        with urllib.request.urlopen(page, timeout=TIMEOUT_S) as answer:
            assert b"<html" in answer.read().lower()
    finally:
        view.send_signal(signal.SIGINT)
        view.communicate(timeout=TIMEOUT_S)
    with pytest.raises(OSError):
        urllib.request.urlopen(page, timeout=TIMEOUT_S)


@pytest.mark.filterwarnings("ignore:RRD file has no footer")  # its writer is ended, not asked to finish
def test_a_view_goes_to_a_viewer_that_runs(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    from rerun.chunk import RrdReader
    from urto._viewer.outputs import ViewerProcess, free_ports

    urtod = start("pyramid")
    kept = tmp_path / "kept.rrd"
    (port,) = free_ports(1)
    viewer = ViewerProcess("--save", str(kept), port=port)  # a viewer without a window, which writes what it gets
    try:
        assert _urto(urtod.endpoint, "view", "--connect", viewer.url, "--ticks", "30") == ""
        assert viewer.is_running()
    finally:
        viewer.close()
    entities = {str(chunk.entity_path) for chunk in RrdReader(kept).stream().to_chunks()}
    assert "/room/bodies/boxes" in entities


def _example(name: str, *arguments: str, cwd: Path) -> str:
    environment = {**os.environ, "MPLCONFIGDIR": str(cwd / "matplotlib")}
    done = subprocess.run(
        [sys.executable, ROOT / "examples" / name, *arguments], capture_output=True, text=True, cwd=cwd,
        timeout=TIMEOUT_S * 4, env=environment, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_first_script(start: Start, tmp_path: Path) -> None:
    urtod = start("pyramid")
    with urto.connect(urtod.endpoint, user="watcher", timeout=TIMEOUT_S) as room:
        bodies = len(room.bodies())
        lines = _example("first_script.py", urtod.endpoint, cwd=tmp_path).splitlines()
        assert len(room.bodies()) == bodies
    # Frames may be missed, so not each of the seven lines need be there.
    assert 2 <= len(lines) <= 7
    rows = [line.split() for line in lines]
    for row in rows:
        # A free flight: v = 2 N·s / (π 0.5² kg), and half of g t² below where it began.
        seconds = int(row[1]) / 60
        assert float(row[4]) == pytest.approx(2 / 0.785398 * seconds, abs=0.02)
        assert float(row[7]) == pytest.approx(40 - 9.81 / 2 * seconds**2, abs=0.2)


def test_the_game_of_two_players(start: Start, tmp_path: Path) -> None:
    urtod = start(EMPTY.replace("sub_steps: 1", "sub_steps: 4"))
    lines = _example("two_players.py", urtod.endpoint, "--seconds", "3", cwd=tmp_path).splitlines()
    assert len(lines) == 3
    assert all("left" in line and "right" in line for line in lines)
    with urto.connect(urtod.endpoint, timeout=TIMEOUT_S) as room:
        assert room.bodies() == ()


def test_the_experiment(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    urtod = start(EMPTY.replace("sub_steps: 1", "sub_steps: 4"))
    output = _example("experiment.py", urtod.endpoint, "--plot", "bounce.png", cwd=tmp_path)
    rows = [line.split() for line in output.splitlines() if line.startswith("e =")]
    assert len(rows) == 4
    for row in rows:
        # The touch falls somewhere into a tick, so the speed at it is known to g dt, of about 8 m/s.
        assert float(row[4]) == pytest.approx(float(row[7]), rel=0.05)
    assert (tmp_path / "bounce.png").read_bytes().startswith(b"\x89PNG")
    with urto.connect(urtod.endpoint, timeout=TIMEOUT_S) as room:
        assert not room.info().paused
