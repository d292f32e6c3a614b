"""The joints of a room as lines between their anchors, which follow from where the bodies are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from urto._joints import JointInfo

Floats = npt.NDArray[np.float64]


class JointLines:
    """n joints: rows of their bodies in the poses (−1: the world), and their anchors (n, 2) in m."""

    def __init__(self, joints: Sequence[JointInfo], ids: npt.NDArray[np.uint64]) -> None:
        rows = {int(body): row for row, body in enumerate(ids)}
        self._row_a = np.array([rows.get(joint.body_a, -1) for joint in joints], dtype=np.int64)
        self._row_b = np.array([rows.get(joint.body_b, -1) for joint in joints], dtype=np.int64)
        self._anchor_a: Floats = np.array([joint.anchor_a for joint in joints], dtype=np.float64).reshape(-1, 2)
        self._anchor_b: Floats = np.array([joint.anchor_b for joint in joints], dtype=np.float64).reshape(-1, 2)

    def __len__(self) -> int:
        return len(self._row_a)

    def ends(self, position: Floats, angle: Floats) -> Floats:
        """(n, 2, 2) m, world frame: a's and b's anchor, for bodies at these places."""
        a = _placed(self._row_a, self._anchor_a, position, angle)
        b = _placed(self._row_b, self._anchor_b, position, angle)
        return np.stack([a, b], axis=1)


def _placed(rows: npt.NDArray[np.int64], anchors: Floats, position: Floats, angle: Floats) -> Floats:
    world = anchors.copy()
    held = rows >= 0
    at = rows[held]
    cosine, sine = np.cos(angle[at]), np.sin(angle[at])
    world[held, 0] = position[at, 0] + cosine * anchors[held, 0] - sine * anchors[held, 1]
    world[held, 1] = position[at, 1] + sine * anchors[held, 0] + cosine * anchors[held, 1]
    return world
