"""How bytes reach a room. The core knows only the `Transport` protocol, so tests can swap Zenoh for something else."""

from __future__ import annotations

import atexit
import contextlib
import json
import threading
import weakref
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from typing import Any, Protocol

import zenoh

from urto._exceptions import ClosedError, ConnectionFailed, ProtocolError, RequestTimeout

CLOSE_TIMEOUT_S = 2.0
"""How long close waits for a thread that hands on messages; they end as soon as their subscription does."""


class Transport(Protocol):
    """Keys and bytes. Every call may come from any thread; callbacks come on threads of the transport."""

    def query(self, selector: str, payload: bytes | None, timeout: float) -> Future[list[bytes]]:
        """Asks whoever answers `selector`. No answer at all: an empty list; silence for `timeout` s: RequestTimeout."""

    def put(self, key: str, payload: bytes) -> None:
        """Publishes `payload`."""

    def subscribe(self, key: str, depth: int, on_payload: Callable[[bytes], None]) -> None:
        """Hands each publication to `on_payload`, in order, keeping the newest `depth` while it is busy."""

    def alive(self, pattern: str, timeout: float) -> Future[list[str]]:
        """Keys of the liveliness tokens that match `pattern`."""

    def watch_alive(self, key: str, on_change: Callable[[bool], None]) -> None:
        """Calls `on_change(True)` when the token `key` is or becomes there and `on_change(False)` when it goes."""

    def declare_alive(self, key: str) -> None:
        """Declares a liveliness token until `close`."""

    def close(self) -> None:
        """Ends everything. May be called twice."""


_open_transports: weakref.WeakSet[ZenohTransport] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    # A Zenoh session that has lost its server and is still open hangs the interpreter at its exit.
    for transport in list(_open_transports):
        transport.close()


def _finish(future: Future[Any], result: Any = None, error: BaseException | None = None) -> None:
    # The waiter may have cancelled it meanwhile.
    with contextlib.suppress(InvalidStateError):
        if error is not None:
            future.set_exception(error)
        else:
            future.set_result(result)


class _Replies:
    """Collects the replies of one query and settles its future when the query ends."""

    def __init__(self, what: str, timeout: float) -> None:
        self.future: Future[Any] = Future()
        self._what = what
        self._timeout = timeout
        self._values: list[Any] = []
        self._errors: list[str] = []

    def on_reply(self, reply: zenoh.Reply) -> None:
        if reply.ok is not None:
            self._values.append(self._value(reply.ok))
        elif reply.err is not None:
            self._errors.append(reply.err.payload.to_bytes().decode("utf-8", "replace"))

    def _value(self, sample: zenoh.Sample) -> Any:
        return sample.payload.to_bytes()

    def on_end(self) -> None:
        if self._values or not self._errors:
            _finish(self.future, self._values)
        elif self._errors == ["Timeout"]:
            _finish(self.future, error=RequestTimeout(f"no answer from {self._what} within {self._timeout:g} s"))
        else:
            _finish(self.future, error=ProtocolError(f"{self._what} answered with an error: {self._errors[0]}"))


class _AliveReplies(_Replies):
    def _value(self, sample: zenoh.Sample) -> Any:
        return str(sample.key_expr)


class ZenohTransport:
    """A Zenoh session in client mode, without scouting."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._lock = threading.Lock()
        self._closed = False
        self._declarations: list[Any] = []
        self._pumps: list[threading.Thread] = []
        _open_transports.add(self)

    @classmethod
    def open(cls, endpoint: str, user: str | None, password: str | None, timeout: float) -> ZenohTransport:
        """Connects to `endpoint`, a Zenoh locator. ConnectionFailed if that does not succeed within `timeout` s."""
        config = zenoh.Config()
        try:
            for key, value in _settings(endpoint, user, password, timeout).items():
                config.insert_json5(key, json.dumps(value))
            return cls(zenoh.open(config))
        except zenoh.ZError as error:
            hint = "; or the user or password is wrong (that looks the same)" if password is not None else ""
            raise ConnectionFailed(
                f"no Urto server answers at {endpoint} within {timeout:g} s{hint}. Does urtod run? ({_words(error)})"
            ) from None

    def query(self, selector: str, payload: bytes | None, timeout: float) -> Future[list[bytes]]:
        replies = _Replies(selector, timeout)
        with self._use():
            self._session.get(
                selector,
                zenoh.handlers.Callback(replies.on_reply, replies.on_end, indirect=False),
                payload=payload,
                timeout=timeout,
                consolidation=zenoh.ConsolidationMode.NONE,
            )
        return replies.future

    def put(self, key: str, payload: bytes) -> None:
        with self._use():
            self._session.put(key, payload, congestion_control=zenoh.CongestionControl.BLOCK)

    def subscribe(self, key: str, depth: int, on_payload: Callable[[bytes], None]) -> None:
        # Zenoh fills the ring without Python, so a busy interpreter never holds up the session; what does not fit
        # pushes out the oldest.
        with self._use():
            subscriber = self._session.declare_subscriber(key, zenoh.handlers.RingChannel(depth))
            self._declarations.append(subscriber)

        def pump() -> None:
            for sample in subscriber.handler:
                on_payload(sample.payload.to_bytes())

        thread = threading.Thread(target=pump, name=f"urto {key}", daemon=True)
        self._pumps.append(thread)
        thread.start()

    def alive(self, pattern: str, timeout: float) -> Future[list[str]]:
        replies = _AliveReplies(pattern, timeout)
        with self._use():
            self._session.liveliness().get(
                pattern, zenoh.handlers.Callback(replies.on_reply, replies.on_end, indirect=False), timeout=timeout
            )
        return replies.future

    def watch_alive(self, key: str, on_change: Callable[[bool], None]) -> None:
        def on_sample(sample: zenoh.Sample) -> None:
            on_change(sample.kind == zenoh.SampleKind.PUT)

        with self._use():
            self._declarations.append(
                self._session.liveliness().declare_subscriber(
                    key, zenoh.handlers.Callback(on_sample, indirect=False), history=True
                )
            )

    def declare_alive(self, key: str) -> None:
        with self._use():
            self._declarations.append(self._session.liveliness().declare_token(key))

    def close(self) -> None:
        with self._lock:
            if self._closed:
                return
            self._closed = True
        _open_transports.discard(self)
        for declaration in reversed(self._declarations):
            with contextlib.suppress(zenoh.ZError):
                declaration.undeclare()
        with contextlib.suppress(zenoh.ZError):
            self._session.close()  # type: ignore[no-untyped-call]
        for thread in self._pumps:
            if thread.is_alive() and thread is not threading.current_thread():
                thread.join(CLOSE_TIMEOUT_S)

    @contextlib.contextmanager
    def _use(self) -> Any:
        if self._closed:
            raise ClosedError("the room is closed")
        try:
            yield
        except zenoh.ZError as error:
            if self._closed:
                raise ClosedError("the room is closed") from None
            raise ConnectionFailed(f"Zenoh: {_words(error)}") from None


def _words(error: zenoh.ZError) -> str:
    """What Zenoh says, without the place in its source that follows."""
    return str(error).split(" at /")[0]


def _settings(endpoint: str, user: str | None, password: str | None, timeout: float) -> dict[str, object]:
    settings: dict[str, object] = {
        "mode": "client",
        "connect/endpoints": [endpoint],
        "connect/timeout_ms": max(1, int(timeout * 1000)),
        "connect/exit_on_failure": True,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    if password is not None:
        settings["transport/auth/usrpwd/user"] = user
        settings["transport/auth/usrpwd/password"] = password
    return settings
