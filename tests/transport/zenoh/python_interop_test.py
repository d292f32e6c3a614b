"""The official Python client against Urto's ZenohTransport (echo_server.cpp)."""

from __future__ import annotations

import json
import os
import queue
import socket
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import zenoh

PATIENCE_S = 60.0  # far more than anything here takes; reaching it is a failure
SOON_MS = 500  # a timeout that a test waits for in full


@contextmanager
def echo_server(*arguments: str) -> Iterator[str]:
    """Runs the server; gives its endpoint."""
    command = [os.environ["URTO_ZENOH_ECHO_SERVER"], *arguments]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None and process.stdout is not None
        try:
            endpoint = process.stdout.readline().strip()
            assert endpoint.startswith("tcp/127.0.0.1:"), "the server did not start"
            yield endpoint
        finally:
            process.stdin.close()
            assert process.wait(PATIENCE_S) == 0


def client(endpoint: str, user: str = "", password: str = "", timeout_ms: int = 5000) -> zenoh.Session:
    settings: dict[str, Any] = {
        "mode": "client",
        "connect": {"endpoints": [endpoint], "timeout_ms": timeout_ms},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
    }
    if user:
        settings["transport"] = {"auth": {"usrpwd": {"user": user, "password": password}}}
    return zenoh.open(zenoh.Config.from_json5(json.dumps(settings)))


def ask(session: zenoh.Session, selector: str, **arguments: Any) -> list[zenoh.Reply]:
    return list(session.get(selector, timeout=PATIENCE_S, **arguments))


@pytest.fixture
def session() -> Iterator[zenoh.Session]:
    with echo_server() as endpoint, client(endpoint) as opened:
        yield opened


def test_a_query_is_answered_with_key_bytes_and_encoding(session: zenoh.Session) -> None:
    replies = ask(session, "urto/v1/lab/cmd/alice?from=3;x=y", payload=b"\x00\xffgo")
    assert len(replies) == 1
    sample = replies[0].ok
    assert sample is not None
    assert str(sample.key_expr) == "urto/v1/lab/cmd/alice"
    assert sample.payload.to_bytes() == b"from=3;x=y|\x00\xffgo"
    assert str(sample.encoding) == "text/plain;schema=echo"


def test_an_error_arrives_as_an_error(session: zenoh.Session) -> None:
    replies = ask(session, "urto/v1/lab/info")
    assert [reply.err is not None and reply.err.payload.to_bytes() for reply in replies] == [b"refused"]


def test_a_dropped_query_ends_without_a_reply(session: zenoh.Session) -> None:
    assert ask(session, "urto/v1/lab/state") == []


def test_publications_go_both_ways(session: zenoh.Session) -> None:
    heard: queue.Queue[zenoh.Sample] = queue.Queue()
    with session.declare_subscriber("urto/v1/*/snapshot", heard.put):
        ask(session, "urto/v1/lab/cmd/alice")  # the server knows of the subscriber by then
        session.put("urto/v1/lab/cmd/alice", b"\x00one")
        sample = heard.get(timeout=PATIENCE_S)
    assert str(sample.key_expr) == "urto/v1/lab/snapshot"
    assert sample.payload.to_bytes() == b"\x00one"
    assert str(sample.encoding) == "text/plain;schema=echo"
    assert sample.congestion_control == zenoh.CongestionControl.DROP


def test_liveliness_goes_both_ways(session: zenoh.Session) -> None:
    assert [str(r.ok.key_expr) for r in session.liveliness().get("urto/v1/*/alive", timeout=PATIENCE_S) if r.ok] == [
        "urto/v1/lab/alive"
    ]
    heard: queue.Queue[zenoh.Sample] = queue.Queue()
    with session.declare_subscriber("urto/v1/lab/event", heard.put):
        ask(session, "urto/v1/lab/cmd/alice")
        token = session.liveliness().declare_token("urto/v1/lab/member/alice/1")
        assert heard.get(timeout=PATIENCE_S).payload.to_string() == "urto/v1/lab/member/alice/1 came"
        token.undeclare()
        assert heard.get(timeout=PATIENCE_S).payload.to_string() == "urto/v1/lab/member/alice/1 went"


def test_the_server_going_away_is_seen() -> None:
    changes: queue.Queue[zenoh.SampleKind] = queue.Queue()
    served = echo_server()
    with client(served.__enter__()) as session:
        watch: Callable[[zenoh.Sample], None] = lambda sample: changes.put(sample.kind)
        with session.liveliness().declare_subscriber("urto/v1/*/alive", watch, history=True):
            assert changes.get(timeout=PATIENCE_S) == zenoh.SampleKind.PUT
            served.__exit__(None, None, None)
            assert changes.get(timeout=PATIENCE_S) == zenoh.SampleKind.DELETE


def test_many_clients_ask_at_once() -> None:
    clients, questions = 8, 25
    failures: queue.Queue[str] = queue.Queue()

    def run(number: int, endpoint: str) -> None:
        try:
            with client(endpoint) as session:
                for question in range(questions):
                    payload = f"{number}.{question}"
                    replies = ask(session, f"urto/v1/lab/cmd/user{number}", payload=payload)
                    got = [reply.ok.payload.to_string() for reply in replies if reply.ok]
                    if got != ["|" + payload]:
                        failures.put(f"{payload}: {got}")
        except Exception as error:  # a thread has nobody else to tell
            failures.put(repr(error))

    with echo_server() as endpoint:
        threads = [threading.Thread(target=run, args=(number, endpoint)) for number in range(clients)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert list(failures.queue) == []


def test_access_control_holds_for_python_too(tmp_path: Path) -> None:
    dictionary = tmp_path / "users.txt"
    dictionary.write_text("alice:one\nbob:two\n")
    with echo_server("", str(dictionary)) as endpoint:
        for user, password in (("", ""), ("alice", "two"), ("carol", "one")):
            with pytest.raises(zenoh.ZError):
                client(endpoint, user, password, timeout_ms=SOON_MS)
        with client(endpoint, "alice", "one") as alice, client(endpoint, "bob", "two") as bob:
            heard: queue.Queue[bytes] = queue.Queue()
            with bob.declare_subscriber("urto/v1/lab/snapshot", lambda sample: heard.put(sample.payload.to_bytes())):
                assert len(ask(bob, "urto/v1/lab/cmd/bob")) == 1
                assert ask(alice, "urto/v1/lab/cmd/bob") == []
                alice.put("urto/v1/lab/snapshot", b"forged")
                alice.put("urto/v1/lab/cmd/bob", b"forged")
                alice.put("urto/v1/lab/cmd/alice", b"mine")  # the server repeats it as a snapshot
                assert heard.get(timeout=PATIENCE_S) == b"mine"
                assert heard.empty()


@contextmanager
def router() -> Iterator[str]:
    """A Zenoh router on a port that was free a moment ago; gives its endpoint."""
    with socket.create_server(("127.0.0.1", 0)) as probe:
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    settings = {
        "mode": "router",
        "listen": {"endpoints": [endpoint]},
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
    }
    with zenoh.open(zenoh.Config.from_json5(json.dumps(settings))):
        yield endpoint


def test_a_router_in_between() -> None:
    with router() as endpoint, client(endpoint) as session:
        seen: queue.Queue[zenoh.SampleKind] = queue.Queue()
        with session.liveliness().declare_subscriber(
            "urto/v1/*/alive", lambda sample: seen.put(sample.kind), history=True
        ):
            with echo_server(endpoint):
                assert seen.get(timeout=PATIENCE_S) == zenoh.SampleKind.PUT
                replies = ask(session, "urto/v1/lab/cmd/alice", payload=b"hi")
                assert [reply.ok.payload.to_bytes() for reply in replies if reply.ok] == [b"|hi"]
            assert seen.get(timeout=PATIENCE_S) == zenoh.SampleKind.DELETE
