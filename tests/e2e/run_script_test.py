"""scripts/run as a person calls it, on a machine where everything is built."""

import os
import re
import signal
import socket
import struct
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
RUN = ROOT / "scripts/run"
PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
TIMEOUT_SECONDS = 180


def environment(**more):
    return {**{key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}, **more}


def processes_with(mark):
    """The command lines of the processes that carry `mark` in their environment."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (folder / "environ").read_bytes():
                found.append((folder / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        except OSError:
            continue
    return found


@pytest.fixture(name="mark")
def fixture_mark(tmp_path):
    return f"URTO_TEST_MARK={tmp_path}"


def test_save_writes_a_recording_and_a_picture_and_leaves_nothing_running(tmp_path, mark):
    key, value = mark.split("=")
    result = subprocess.run(
        [RUN, "--scene", "arch", "--save", tmp_path / "out", "--seconds", "2"],
        capture_output=True, text=True, check=False, timeout=TIMEOUT_SECONDS, env=environment(**{key: value}), cwd="/",
    )  # fmt: skip
    assert result.returncode == 0, result.stdout + result.stderr
    verified = subprocess.run([ROOT / ".venv/bin/rerun", "rrd", "verify", tmp_path / "out/arch.rrd"], check=False)
    assert verified.returncode == 0
    picture = (tmp_path / "out/arch.png").read_bytes()
    assert picture.startswith(PNG_SIGNATURE)
    width, height = struct.unpack(">II", picture[16:24])
    assert width >= 640 and height >= 300
    assert processes_with(mark) == []


def test_a_taken_port_is_said_and_another_one_used(tmp_path):
    with socket.socket() as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            taken.bind(("127.0.0.1", 7447))
            taken.listen()
        except OSError:
            pass  # somebody else has it: as good
        result = subprocess.run(
            [RUN, "--scene", "stack_10", "--save", tmp_path, "--seconds", "1"],
            capture_output=True, text=True, check=False, timeout=TIMEOUT_SECONDS, env=environment(),
        )  # fmt: skip
    assert result.returncode == 0, result.stdout + result.stderr
    assert re.search(r"7447 is taken.*using 74\d\d", result.stdout)


def test_ctrl_c_ends_the_web_viewer_and_the_server(mark):
    key, value = mark.split("=")
    # Without a display it serves the web viewer by itself, and says why.
    process = subprocess.Popen(
        [RUN, "--scene", "stack_10"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env=environment(**{key: value}), start_new_session=True,
    )  # fmt: skip
    said = ""
    for line in process.stdout:
        said += line
        if "http://127.0.0.1" in line:
            break
    assert "no display" in said and "http://127.0.0.1" in said
    assert any("urtod" in line for line in processes_with(mark))
    os.kill(process.pid, signal.SIGINT)
    assert process.wait(timeout=TIMEOUT_SECONDS) == 130
    process.stdout.close()
    assert processes_with(mark) == []


def test_what_urtod_refuses_ends_the_script_with_urtods_words(tmp_path):
    scene = tmp_path / "wrong.txtpb"
    scene.write_text('name: "wrong"\nbodies { shapes { box { width: -1 height: 1 } } }\n', encoding="utf-8")
    result = subprocess.run([RUN, "--scene", scene, "--save", tmp_path], capture_output=True, text=True, check=False,
                            timeout=TIMEOUT_SECONDS, env=environment())  # fmt: skip
    assert result.returncode == 1
    assert "width" in result.stderr and "urtod did not start" in result.stderr
