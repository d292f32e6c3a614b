from __future__ import annotations

import pathlib
import sys
from collections.abc import Iterator

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import urto
from support.fake_room import FakeRoom


@pytest.fixture
def fake() -> Iterator[FakeRoom]:
    with FakeRoom() as room:
        yield room


@pytest.fixture
def room(fake: FakeRoom) -> Iterator[urto.Room]:
    with urto.connect(fake.endpoint, user="tester", timeout=10) as joined:
        fake.wait_members(1)
        yield joined
