"""The hits of the last moments: discs that are larger the harder the blow."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from urto._events import ContactHit, Event

HIT_TICKS = 15
"""For so long a hit is shown."""

HIT_SIZE = 0.002
"""Radius over the view's width, for each m/s."""

HIT_SIZE_MAX = 0.03
"""Of the view's width."""

HITS_MAX = 2000
"""More are too many to see; the oldest go first."""


class RecentHits:
    """What `view` shows of the hits."""

    def __init__(self) -> None:
        self._hits: list[ContactHit] = []

    def add(self, events: Iterable[Event], tick: int) -> None:
        """Takes in new events and lets go of what is too old at `tick`."""
        self._hits += [event for event in events if isinstance(event, ContactHit)]
        self._hits = [hit for hit in self._hits if hit.tick > tick - HIT_TICKS][-HITS_MAX:]

    def clear(self) -> None:
        """The room was reset."""
        self._hits = []

    def __len__(self) -> int:
        return len(self._hits)

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """(N, 2) m, world frame."""
        return np.array([hit.point for hit in self._hits], dtype=np.float64).reshape(-1, 2)

    def radii(self, width: float) -> npt.NDArray[np.float64]:
        """(N,) m in a view that is `width` m wide."""
        speeds = np.array([hit.approach_speed for hit in self._hits], dtype=np.float64)
        radii: npt.NDArray[np.float64] = width * np.minimum(HIT_SIZE * speeds, HIT_SIZE_MAX)
        return radii
