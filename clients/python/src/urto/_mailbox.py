"""Where the transport's threads leave what arrives and operations wait for it."""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import Future

from urto._proto.v1 import snapshot_pb2

EVENTS_BUFFERED_MAX = 65_536
"""Events kept here for a reader that is behind; older ones are asked of the room again. About 20 MB at the most."""


class Signal:
    """Wakes every waiter when something changes.

    Look at `version`, then at what may change, and only if there is nothing `wait` for what comes after that version.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiters: list[Future[None]] = []
        self.version = 0

    def wait(self, version: int) -> Future[None]:
        """A future that is settled once there is a newer version."""
        future: Future[None] = Future()
        with self._lock:
            if self.version == version:
                self._waiters.append(future)
                return future
        future.set_result(None)
        return future

    def wake(self) -> None:
        with self._lock:
            self.version += 1
            waiters, self._waiters = self._waiters, []
        for waiter in waiters:
            if waiter.set_running_or_notify_cancel():
                waiter.set_result(None)


class LatestPayload:
    """The newest payload and how many came."""

    def __init__(self, signal: Signal) -> None:
        self._signal = signal
        self.latest: tuple[int, bytes] = (0, b"")

    def put(self, payload: bytes) -> None:
        self.latest = (self.latest[0] + 1, payload)
        self._signal.wake()


class EventLog:
    """Events by sequence number, as far as they arrived."""

    def __init__(self, signal: Signal) -> None:
        self._signal = signal
        self._lock = threading.Lock()
        self._events: OrderedDict[int, snapshot_pb2.Event] = OrderedDict()
        self.first: int | None = None
        self.latest = 0
        self.broken = 0

    def add_payload(self, payload: bytes) -> None:
        """A publication of the room. What cannot be read leaves a gap, which the reader then notices."""
        try:
            batch = snapshot_pb2.EventBatch.FromString(payload)
        except Exception:  # protobuf's DecodeError; its class has no stable place in the package
            self.broken += 1
            return
        self.add(batch)
        self._signal.wake()

    def add(self, batch: snapshot_pb2.EventBatch) -> None:
        with self._lock:
            for index, event in enumerate(batch.events):
                self._events[batch.first_sequence + index] = event
            if batch.events:
                if self.first is None:
                    self.first = batch.first_sequence
                self.latest = max(self.latest, batch.first_sequence + len(batch.events) - 1)
            while len(self._events) > EVENTS_BUFFERED_MAX:
                self._events.popitem(last=False)

    def take(self, sequence: int) -> snapshot_pb2.Event | None:
        with self._lock:
            return self._events.get(sequence)

    def clear(self) -> None:
        """Forgets everything: the room was restarted and counts anew."""
        with self._lock:
            self._events.clear()
            self.first = None
            self.latest = 0
