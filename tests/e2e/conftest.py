"""Starts urtod on an ephemeral port of loopback for the tests that ask for it."""

from __future__ import annotations

import os
import queue
import re
import signal
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
URTOD = Path(os.environ.get("URTO_URTOD", ROOT / "build/release/bin/urtod"))
START_TIMEOUT_S = 60
TIMEOUT_S = 30.0  # of whatever a test waits for; never reached but by a failure

TIME_STEP = 1 / 64  # s; a power of two, so that what is computed by hand is exact in binary
GRAVITY_Y = -8.0  # m/s²
EMPTY = f"""
name: "empty"
world {{ precision: PRECISION_DOUBLE gravity {{ y: {GRAVITY_Y} }} time_step: {TIME_STEP} sub_steps: 1 sleeping: false }}
"""
WEIGHTLESS = EMPTY.replace(f"y: {GRAVITY_Y}", "y: 0")


class Urtod:
    """A running server."""

    def __init__(self, scene: Path, *options: str, listen: str = "127.0.0.1:0") -> None:
        command = [str(URTOD), "--scene", str(scene), "--listen", listen, *options]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        self.lines: list[str] = []
        self._endpoints: queue.Queue[str | None] = queue.Queue()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        endpoint = self._endpoints.get(timeout=START_TIMEOUT_S)
        assert endpoint is not None, f"urtod did not start: {''.join(self.lines)}"
        self.endpoint = endpoint

    def _read(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.lines.append(line)
            if match := re.search(r"Room \S+ on ([^\s,]+)", line):
                self._endpoints.put(match.group(1))
        self._endpoints.put(None)

    def stop(self, by: signal.Signals = signal.SIGTERM) -> int:
        """Ends it and gives its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(by)
        try:
            code = self.process.wait(TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        finally:
            self._reader.join()
            if self.process.stderr is not None:
                self.process.stderr.close()
        return code


Start = Callable[..., Urtod]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts servers: `start(scene, *options, listen=…)` with a scene of tests/scenes by name, or the text of one."""
    servers: list[Urtod] = []

    def start_one(scene: str, *options: str, **others: str) -> Urtod:
        path = ROOT / "tests" / "scenes" / f"{scene}.txtpb"
        if "\n" in scene:
            path = tmp_path / f"scene{len(servers)}.txtpb"
            path.write_text(scene, encoding="utf-8")
        servers.append(Urtod(path, *options, **others))
        return servers[-1]

    yield start_one
    for server in servers:
        server.stop()
