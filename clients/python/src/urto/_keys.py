"""The Zenoh keys of a room. docs/protocol.md describes each."""

from __future__ import annotations

import re

from urto._exceptions import InvalidArgument

PREFIX = "urto/v1"
PROTOCOL_VERSION = 1
DEFAULT_ENDPOINT = "tcp/127.0.0.1:7447"

_NAME = re.compile(r"[A-Za-z0-9_-]{1,64}")

ALL_ROOMS_ALIVE = f"{PREFIX}/*/alive"


def check_name(what: str, name: str) -> str:
    """`name` if it can be part of a key, else InvalidArgument."""
    if not _NAME.fullmatch(name):
        raise InvalidArgument(f"{what} must be 1 to 64 of letters, digits, _ and -, not {name!r}")
    return name


def alive(room: str) -> str:
    return f"{PREFIX}/{room}/alive"


def info(room: str) -> str:
    return f"{PREFIX}/{room}/info"


def state(room: str) -> str:
    return f"{PREFIX}/{room}/state"


def snapshot(room: str) -> str:
    return f"{PREFIX}/{room}/snapshot"


def event(room: str) -> str:
    return f"{PREFIX}/{room}/event"


def command(room: str, user: str) -> str:
    return f"{PREFIX}/{room}/cmd/{user}"


def member(room: str, user: str, session: str) -> str:
    return f"{PREFIX}/{room}/member/{user}/{session}"


def room_of_alive_key(key: str) -> str:
    """The room whose liveliness token `key` is."""
    return key.removeprefix(PREFIX + "/").removesuffix("/alive")
