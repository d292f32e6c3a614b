"""The command urto: what it prints, its exit codes, its one-line errors."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

import urto
from support.fake_room import FakeRoom, Running
from urto import _cli


Call = Callable[..., tuple[int, str, str]]


@pytest.fixture
def call(fake: FakeRoom, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    monkeypatch.setattr("signal.signal", lambda *_: None)
    monkeypatch.setenv("URTO_ENDPOINT", fake.endpoint)

    def run(*arguments: str) -> tuple[int, str, str]:
        code = _cli.main(arguments)
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_rooms(call: Call) -> None:
    assert call("rooms") == (0, "demo\n", "")


def test_info(call: Call) -> None:
    code, out, _ = call("info", "--user", "anna")
    assert code == 0
    assert "room       demo (Urto 0.1.0" in out
    assert "paused" in out
    assert json.loads(call("info", "--json")[1])["time_step"] == 1 / 64


def test_spawn_and_push_by_name_and_id(call: Call, fake: FakeRoom) -> None:
    assert call("spawn", "box", "1", "2", "--at", "-3", "-4.5", "--name", "crate", "--mass", "2") == (0, "1\n", "")
    assert call("spawn", "circle", "0.5", "--color", "ff0000") == (0, "2\n", "")
    assert call("spawn", "polygon", "0", "0", "1", "0", "0", "1", "--type", "static") == (0, "3\n", "")
    assert (fake.bodies[1]["x"], fake.bodies[1]["y"]) == (-3, -4.5)
    assert fake.bodies[2]["message"].color == 0xFF0000
    assert call("impulse", "crate", "0", "-5") == (0, "tick 0\n", "")
    assert call("impulse", "1", "-2", "0")[0] == 0
    assert (fake.bodies[1]["vx"], fake.bodies[1]["vy"]) == (-1, -2.5)


def test_time(call: Call, fake: FakeRoom) -> None:
    assert call("step", "5") == (0, "tick 5\n", "")
    assert call("resume") == (0, "tick 5\n", "")
    assert call("step")[0] == _cli.EXIT_REJECTED
    assert call("pause") == (0, "tick 5\n", "")
    assert call("reset") == (0, "epoch 2\n", "")


def test_echo(call: Call, fake: FakeRoom) -> None:
    call("spawn", "circle", "1")
    with Running(fake):
        code, out, _ = call("echo", "--count", "2")
        assert code == 0
        assert [line.split()[0] for line in out.splitlines()] == ["tick", "tick"]
        frame = json.loads(call("echo", "frames", "--count", "1", "--json")[1])
        assert frame["ids"] == [1]
    code, out, _ = call("echo", "events", "--count", "1", "--user", "anna")
    assert (code, out.split(" tick ")[1].split(" ", 1)[1].split(",")[0]) == (0, "MemberJoined: user anna")


def test_errors_are_one_line_with_an_exit_code(call: Call) -> None:
    for arguments, expected, text in (
        (("info", "--endpoint", "tcp/127.0.0.1:1", "--timeout", "0.2"), _cli.EXIT_UNREACHABLE, "no Urto server"),
        (("info", "--room", "nowhere"), _cli.EXIT_UNREACHABLE, "no room 'nowhere'"),
        (("info", "--room", "a/b"), _cli.EXIT_USAGE, "room must be"),
        (("spawn", "box", "1"), _cli.EXIT_USAGE, "a box is WIDTH HEIGHT"),
        (("spawn", "box", "-1", "1"), _cli.EXIT_REJECTED, "spawn.body.shapes[0].box.width = -1.0"),
        (("impulse", "nobody", "1", "0"), _cli.EXIT_REJECTED, "nobody"),
    ):
        code, out, err = call(*arguments)
        assert (code, out, err.count("\n")) == (expected, "", 1), arguments
        assert err.startswith("urto: ")
        assert text in err
    with pytest.raises(SystemExit) as usage:
        call("dance")
    assert usage.value.code == _cli.EXIT_USAGE


def test_view_saves(call: Call, fake: FakeRoom, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    call("spawn", "circle", "1")
    picture = tmp_path / "p.png"
    code, out, _ = call("view", "--save", str(tmp_path / "a" / "b.rrd"), "--picture", str(picture), "--seconds", "0.1")
    assert code == 0
    assert (tmp_path / "a" / "b.rrd").stat().st_size > 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert str(picture) in out


def test_help_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        _cli.main(["--help"])
    text = capsys.readouterr().out
    for command in ("rooms", "info", "spawn", "impulse", "pause", "resume", "step", "reset", "echo", "view"):
        assert command in text
    assert urto.__version__ == "0.1.0"
