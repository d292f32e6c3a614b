"""Where a view goes: a viewer on this screen, one that already runs, a browser, a file.

Rerun's own servers listen on every interface unless told otherwise; the programs started here listen on loopback.
"""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from urllib.parse import urlsplit

from urto._exceptions import UrtoError

VIEWER_MEMORY = "2GB"
"""A viewer drops its oldest data beyond that."""

SERVER_MEMORY = "512MB"
"""What the server of the web viewer keeps for browsers that come late."""

START_TIMEOUT_S = 60.0
"""How long a viewer may take until it listens; software rendering is slow to start."""

STOP_TIMEOUT_S = 5.0
"""How long a viewer may take to end before it is killed."""


class ViewerError(UrtoError):
    """The view cannot be shown; the message says what to do."""


def rerun_program() -> str:
    """Path of the `rerun` program that came with the package."""
    beside = Path(sys.executable).with_name("rerun")
    found = str(beside) if beside.exists() else shutil.which("rerun")
    if found is None:
        raise ViewerError("the program `rerun` is not there: pip install 'urto[viewer]'")
    return found


def has_display() -> bool:
    """Whether a window can be opened here."""
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def free_ports(count: int) -> list[int]:
    """Ports of loopback that nobody uses at this moment."""
    probes = [socket.socket() for _ in range(count)]
    try:
        for probe in probes:
            probe.bind(("127.0.0.1", 0))
        return [int(probe.getsockname()[1]) for probe in probes]
    finally:
        for probe in probes:
            probe.close()


def proxy_url(port: int) -> str:
    return f"rerun+http://127.0.0.1:{port}/proxy"


def check_listening(url: str) -> None:
    """ViewerError unless somebody listens where `url` points."""
    parts = urlsplit(url)
    try:
        with socket.create_connection((parts.hostname or "127.0.0.1", parts.port or 9876), timeout=3.0):
            pass
    except OSError as error:
        raise ViewerError(f"no Rerun viewer listens at {url} ({error}); start one with: rerun") from None


class ViewerProcess:
    """A program of Rerun that this program started and ends."""

    def __init__(self, *arguments: str, port: int, web_port: int | None = None) -> None:
        command = [rerun_program(), "--bind", "127.0.0.1", "--port", str(port), *arguments]
        self.url = proxy_url(port)
        self._log = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=self._log, stderr=subprocess.STDOUT,
            # In a session of its own Ctrl-C reaches this program alone, which then ends the viewer in order.
            start_new_session=True, env={**os.environ, "RUST_LOG": os.environ.get("RUST_LOG", "warn")},
        )  # fmt: skip
        try:
            self._wait_listening(port)
            if web_port is not None:
                self._wait_listening(web_port)
        except BaseException:
            self.close()
            raise

    def _wait_listening(self, port: int) -> None:
        deadline = time.monotonic() + START_TIMEOUT_S
        while True:
            if not self.is_running():
                raise ViewerError(f"the Rerun viewer ended at once: {self._output()}")
            try:
                with socket.create_connection(("127.0.0.1", port), timeout=1.0):
                    return
            except OSError:
                if time.monotonic() > deadline:
                    raise ViewerError(f"the Rerun viewer does not listen after {START_TIMEOUT_S:g} s") from None
                time.sleep(0.05)

    def _output(self) -> str:
        self._log.seek(0)
        text = self._log.read().decode("utf-8", "replace")
        lines = [line for line in text.splitlines() if line.strip()]
        return lines[-1] if lines else f"exit code {self._process.returncode}"

    def is_running(self) -> bool:
        return self._process.poll() is None

    def check_end(self) -> None:
        """ViewerError if it has ended with an error."""
        if self._process.poll():
            raise ViewerError(f"the Rerun viewer ended with an error: {self._output()}")

    def close(self) -> None:
        # The program that pip installs starts the real one, so the whole group is ended, also if its leader is gone.
        self._signal(signal.SIGTERM)
        deadline = time.monotonic() + STOP_TIMEOUT_S
        while self._signal(0):
            if time.monotonic() > deadline:
                self._signal(signal.SIGKILL)
                break
            self._process.poll()  # takes note of its end, which keeps the group alive until then
            time.sleep(0.01)
        self._process.wait()
        self._log.close()

    def _signal(self, number: int) -> bool:
        """Sends a signal to the group (0: none); False if nobody is left in it."""
        try:
            os.killpg(self._process.pid, number)
        except ProcessLookupError:
            return False
        return True


def open_window() -> ViewerProcess:
    """A viewer on this screen."""
    if not has_display():
        raise ViewerError(
            "no display here (neither DISPLAY nor WAYLAND_DISPLAY is set): use --save DIR, --web, or --connect URL"
        )
    (port,) = free_ports(1)
    return ViewerProcess("--memory-limit", VIEWER_MEMORY, "--hide-welcome-screen", port=port)


def open_web(web_port: int | None = None) -> tuple[ViewerProcess, str]:
    """A server of the web viewer on loopback, and the address to open in a browser."""
    port, free_web_port = free_ports(2)
    chosen = web_port or free_web_port
    process = ViewerProcess(
        "--serve-web", "--web-viewer-port", str(chosen), "--server-memory-limit", SERVER_MEMORY, port=port,
        web_port=chosen,
    )  # fmt: skip
    return process, f"http://127.0.0.1:{chosen}?url={proxy_url(port).replace(':', '%3A').replace('/', '%2F')}"
