"""Follows a room and shows it: the loop behind `urto view`."""

from __future__ import annotations

import dataclasses
import math
import secrets
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import rerun as rr

from urto._commands import BodyRef
from urto._core import RoomState
from urto._exceptions import EventGap, InvalidArgument, RequestTimeout, UnknownBody
from urto._frame import Contacts, Frame
from urto._room import Room
from urto._viewer.drawing import draw_picture
from urto._viewer.feelers import Feelers, Felt
from urto._viewer.hits import RecentHits
from urto._viewer.outputs import ViewerError, ViewerProcess, check_listening, open_web, open_window
from urto._viewer.rerun_log import RerunLog
from urto._viewer.screenshot import take_screenshot
from urto._viewer.shapes import ShapeSet, with_margin

LOG_RATE_HZ = 30.0
"""Frames logged per second unless told otherwise: smooth to the eye, and 10 000 bodies stay below 6 MB/s."""

SAVE_SECONDS = 10.0
"""How long a view that only goes to a file records unless told otherwise."""

POLL_S = 0.5
"""How often a quiet room lets the loop look at its bounds and at the viewer."""

FLUSH_TIMEOUT_S = 20.0

PICTURE_NAME = "room.png"
RECORDING_NAME = "room.rrd"
SCREENSHOT_NAME = "viewer.png"


@dataclass(frozen=True, kw_only=True)
class ViewOptions:
    """What to show, where, and for how long.

    Attributes:
        save: a directory, which gets room.rrd and room.png; or a file ending in .rrd, with a picture beside it.
        picture: where the picture goes instead, a PNG file.
        web: serve Rerun's web viewer on loopback.
        web_port: its port; None: a free one.
        connect: URL of a Rerun viewer that already runs.
        seconds: s of the clock after which the view ends; None: SAVE_SECONDS if it only saves, else never.
        ticks: ticks of the room after which the view ends; None: never.
        rate_hz: frames logged per second at most.
        velocities: an arrow on every moving body.
        contacts: contact points and normals, and contact events in the log.
        feel: name or id of a body: discs are cast all round from it, to see what it would meet.
        screenshot: with `save`, also a picture of Rerun's own viewer, viewer.png.
    """

    save: Path | None = None
    picture: Path | None = None
    web: bool = False
    web_port: int | None = None
    connect: str | None = None
    seconds: float | None = None
    ticks: int | None = None
    rate_hz: float = LOG_RATE_HZ
    velocities: bool = False
    contacts: bool = False
    feel: BodyRef | None = None
    screenshot: bool = False


@dataclass(frozen=True)
class _Files:
    recording: Path
    picture: Path
    screenshot: Path

    @classmethod
    def of(cls, options: ViewOptions) -> _Files | None:
        if options.save is None:
            return None
        files = cls.at(options.save)
        return files if options.picture is None else dataclasses.replace(files, picture=options.picture)

    @classmethod
    def at(cls, save: Path) -> _Files:
        if save.suffix == ".rrd":
            save.parent.mkdir(parents=True, exist_ok=True)
            return cls(save, save.with_suffix(".png"), save.with_name(f"{save.stem}-{SCREENSHOT_NAME}"))
        if save.exists() and not save.is_dir():
            raise InvalidArgument(f"--save takes a directory or a file ending in .rrd, not {save}")
        save.mkdir(parents=True, exist_ok=True)
        return cls(save / RECORDING_NAME, save / PICTURE_NAME, save / SCREENSHOT_NAME)

    def recording_of_epoch(self, index: int) -> Path:
        """Each reset begins a recording of its own: the first has the plain name."""
        if index == 0:
            return self.recording
        return self.recording.with_name(f"{self.recording.stem}-{index + 1}{self.recording.suffix}")


class _Outputs:
    """The viewers and files that a view feeds. Ends what it started."""

    def __init__(self, options: ViewOptions, say: Callable[[str], None]) -> None:
        self.files = _Files.of(options)
        self.process: ViewerProcess | None = None
        self.url: str | None = None
        self._streams = 0
        if options.connect is not None:
            check_listening(options.connect)
            self.url = options.connect
        elif options.web:
            self.process, address = open_web(options.web_port)
            self.url = self.process.url
            say(f"open in a browser: {address}")
        elif self.files is None:
            self.process = open_window()
            self.url = self.process.url

    def open_stream(self, room: str, epoch: int) -> tuple[rr.RecordingStream, list[rr.GrpcSink | rr.FileSink]]:
        live = self.url is not None
        stream = rr.RecordingStream(
            "urto",
            recording_id=f"{room}-{epoch}-{secrets.token_hex(4)}",
            batcher_config=rr.ChunkBatcherConfig.LOW_LATENCY() if live else rr.ChunkBatcherConfig.DEFAULT(),
        )
        sinks: list[rr.GrpcSink | rr.FileSink] = []
        if self.url is not None:
            sinks.append(rr.GrpcSink(self.url))
        if self.files is not None:
            sinks.append(rr.FileSink(self.files.recording_of_epoch(self._streams)))
        self._streams += 1
        return stream, sinks

    def check(self) -> bool:
        """False when the viewer that this view started was closed."""
        return self.process is None or self.process.is_running()

    def check_end(self) -> None:
        """ViewerError if the viewer that this view started did not end well."""
        if self.process is not None:
            self.process.check_end()

    def close(self) -> None:
        if self.process is not None:
            self.process.close()


class _View:
    def __init__(self, room: Room, options: ViewOptions, outputs: _Outputs) -> None:
        self._room = room
        self._options = options
        self._outputs = outputs
        self._stream: rr.RecordingStream | None = None
        self._epoch: int | None = None
        self._layout: int | None = None
        self._bounds: tuple[float, float, float, float] | None = None
        self._contacts: Contacts | None = None
        self._hits = RecentHits()
        self._feelers: Feelers | None = None
        self._felt: Felt | None = None
        self.frames_logged = 0
        self.frame: Frame | None = None
        self._log: RerunLog
        self.shapes: ShapeSet

    def begin(self) -> None:
        """Shows the room as it is now."""
        self._take_state(self._room.state())

    def show(self, frame: Frame) -> None:
        """Logs a live frame, after asking for the bodies if they are not the known ones any more."""
        if self.frame is not None and (frame.epoch, frame.tick) < (self.frame.epoch, self.frame.tick):
            return  # published before the state that was asked for
        same = frame.epoch == self._epoch and frame.layout == self._layout and self.shapes.poses.update(frame)
        if not same:
            self._take_state(self._room.state())
            return
        self._log_frame(frame)

    def show_events(self) -> None:
        """Logs what has happened since the last frame, in a room that stands still."""
        assert self.frame is not None
        self._log.set_time(self.frame)
        self._log_events(self.frame.tick)

    def _take_state(self, state: RoomState) -> None:
        self.shapes = ShapeSet(state.bodies, state.joints)
        if state.frame.epoch != self._epoch:
            self._begin_recording(state)
        self._layout = state.frame.layout
        self._log.set_time(state.frame)
        self._log.log_layout(self.shapes)
        self._log_frame(state.frame)

    def _begin_recording(self, state: RoomState) -> None:
        self.end_recording()
        if state.view is not None:
            (left, lower), (right, upper) = state.view
            self._bounds = left, lower, right, upper
        else:
            self._bounds = with_margin(self.shapes.bounds())
        self._epoch = state.frame.epoch
        self._hits.clear()
        self._begin_feelers()
        self._stream, sinks = self._outputs.open_stream(self._room.name, state.frame.epoch)
        self._log = RerunLog(self._stream, self._bounds, self._options.velocities, self._options.contacts)
        # The blueprint goes with the sinks, which what was logged before waits for.
        self._stream.set_sinks(*sinks, default_blueprint=self._log.blueprint(state.info))
        self._stream.send_recording_name(f"{self._room.name} · epoch {state.frame.epoch}")

    def _begin_feelers(self) -> None:
        self._feelers = self._felt = None
        if self._options.feel is None or self._bounds is None:
            return
        try:
            self._feelers = Feelers(self._room, self._options.feel, self._bounds[2] - self._bounds[0])
        except UnknownBody:
            if self.frames_logged == 0:
                raise
            # It was spawned, and a reset took it away.

    def _log_frame(self, frame: Frame) -> None:
        self._log.set_time(frame)
        self._log.log_poses(self.shapes)
        if self._options.contacts:
            self._contacts = self._room.contacts()
            self._log.log_contacts(self._contacts)
        if self._feelers is not None:
            self._felt = self._feelers.feel(frame)
            self._log.log_felt(self._felt)
        self._log.log_plots(frame)
        self._log_events(frame.tick)
        self.frame = frame
        self.frames_logged += 1

    def _log_events(self, tick: int) -> None:
        events = []
        try:
            for event in self._room.events(timeout=0):
                events.append(event)
        except EventGap as gap:
            self._log.log_text(str(gap), rr.TextLogLevel.WARN)
        self._log.log_events(events)
        self._hits.add(events, tick)
        self._log.log_hits(self._hits)

    def end_recording(self) -> None:
        if self._stream is not None:
            stream, self._stream = self._stream, None
            try:
                stream.flush(timeout_sec=FLUSH_TIMEOUT_S)
            except (RuntimeError, ValueError) as error:
                if self._outputs.check():  # else the viewer was closed, and nobody waits for the rest
                    raise ViewerError(f"the viewer no longer takes data: {error}") from None
            finally:
                stream.disconnect()

    def draw(self, path: Path) -> None:
        assert self.frame is not None
        draw_picture(
            self.shapes, path, bounds=self._bounds, velocities=self._options.velocities, contacts=self._contacts,
            hits=self._hits, felt=self._felt,
            caption=f"{self._room.name} · tick {self.frame.tick} · {self.frame.sim_time:.2f} s",
        )  # fmt: skip


def view(room: Room, options: ViewOptions, say: Callable[[str], None]) -> None:
    """Shows `room` until the options' bound, the end of the viewer, or KeyboardInterrupt, which ends it in order.

    Args:
        room: what is shown.
        options: how and where.
        say: takes one line for people at a time.

    Raises:
        ViewerError: the view cannot be shown here; the message says what to do.
        ConnectionLost: the room went away; what was recorded until then is saved.
    """
    if not (math.isfinite(options.rate_hz) and options.rate_hz > 0):
        raise InvalidArgument(f"--rate must be frames per second > 0, not {options.rate_hz}")
    outputs = _Outputs(options, say)
    try:
        shown = _View(room, options, outputs)
        try:
            shown.begin()
            if outputs.files is not None:
                say(f"recording to {outputs.files.recording}")
            _follow(room, options, outputs, shown)
            outputs.check_end()
        except KeyboardInterrupt:
            pass
        finally:
            shown.end_recording()
            if outputs.files is not None and shown.frame is not None:
                shown.draw(outputs.files.picture)
                say(f"{shown.frames_logged} frames in {outputs.files.recording}, picture {outputs.files.picture}")
        if outputs.files is not None and shown.frame is not None and options.screenshot:
            take_screenshot(outputs.files.recording, outputs.files.screenshot)
            say(f"picture of the viewer {outputs.files.screenshot}")
    finally:
        outputs.close()


def _follow(room: Room, options: ViewOptions, outputs: _Outputs, shown: _View) -> None:
    seconds = options.seconds
    if seconds is None and options.ticks is None and outputs.url is None:
        seconds = SAVE_SECONDS
    end = math.inf if seconds is None else time.monotonic() + seconds
    assert shown.frame is not None
    first_tick = shown.frame.tick
    due = 0.0
    frames = room.frames(timeout=POLL_S)
    while time.monotonic() < end and outputs.check():
        try:
            frame = next(frames)
        except RequestTimeout:
            shown.show_events()
            continue
        finished = options.ticks is not None and frame.tick >= first_tick + options.ticks
        now = time.monotonic()
        if now >= due or finished:
            due = max(due + 1.0 / options.rate_hz, now)
            shown.show(frame)
        if finished:
            return
