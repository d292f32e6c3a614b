"""A picture of Rerun's own viewer, without a screen."""

from __future__ import annotations

import time
from pathlib import Path

from rerun.experimental import ViewerClient

from urto._viewer.outputs import ViewerError, ViewerProcess, free_ports

SETTLE_TIMEOUT_S = 30.0
"""How long the viewer may take to draw the same picture twice in a row."""

HINT = "without a graphics card it needs Debian's packages: apt-get install mesa-vulkan-drivers libvulkan1"


def take_screenshot(recording: Path, picture: Path) -> None:
    """Opens `recording` in a viewer without a window and writes what it shows at its end to `picture`, a PNG.

    Raises:
        ViewerError: the viewer does not start, which without a graphics driver it does not.
    """
    (port,) = free_ports(1)
    try:
        process = ViewerProcess("--headless", "--hide-welcome-screen", str(recording.resolve()), port=port)
    except ViewerError as error:
        raise ViewerError(f"no picture of the viewer: {error}; {HINT}") from None
    try:
        client = ViewerClient.connect(process.url)
        _wait_loaded(client)
        client.set_time("sim_time", play_state="following")
        picture.write_bytes(_settled(client))
    except (ConnectionError, RuntimeError, TimeoutError) as error:
        raise ViewerError(f"no picture of the viewer: {str(error).splitlines()[0]}; {HINT}") from None
    finally:
        process.close()


def _wait_loaded(client: ViewerClient) -> None:
    deadline = time.monotonic() + SETTLE_TIMEOUT_S
    while True:
        state = client.get_state()
        if state.recordings and not state.loading:
            return
        if time.monotonic() > deadline:
            raise TimeoutError(f"the recording is not loaded after {SETTLE_TIMEOUT_S:g} s")
        time.sleep(0.1)


def _settled(client: ViewerClient) -> bytes:
    """The screenshot once two in a row are equal, or the last one if they never are."""
    deadline = time.monotonic() + SETTLE_TIMEOUT_S
    before = b""
    while True:
        now = client.take_screenshot()
        if now == before:
            return now
        if time.monotonic() > deadline:
            return now
        before = now
        time.sleep(0.5)
