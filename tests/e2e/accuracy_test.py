"""Hard cases of tests/accuracy again through a served room and this client: the same bits come out."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import urto
from conftest import ROOT, TIMEOUT_S, Start

# Of the same build as urtod; scripts/test builds both.
ACCURACY = Path(os.environ.get("URTO_ACCURACY", ROOT / "build/release/tests/accuracy/accuracy_urto"))
STEPS = 200
CASES = [
    ("ballistic", "default"),
    ("spin_angle_100", "default"),
    ("orbit", "runge_kutta_4"),
    ("damped_apexes", "default"),
    ("heap_overlap", "default"),
    ("gas_energy", "precise"),
    ("slide_distance_5", "default"),
    ("stack_sinks_50", "default"),
    ("stack_forces_10", "precise"),
    ("mass_ratio_1e4", "precise"),
    ("arch_stands_115", "precise"),
    ("card_house", "default,solver=thesis"),
]


@pytest.mark.parametrize("case, method", CASES, ids=["-".join(each) for each in CASES])
def test_a_served_room_gives_the_bits_of_the_case(start: Start, case: str, method: str) -> None:
    command = [str(ACCURACY), case, method, "--replay", "--steps", str(STEPS)]
    replay = json.loads(subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout)
    urtod = start(replay["scene"], "--paused")
    with urto.connect(urtod.endpoint, user="tester", timeout=TIMEOUT_S) as room:
        frame = room.step(STEPS)
        found = np.column_stack([frame.position, frame.angle, frame.velocity, frame.angular_velocity])
        order = np.argsort(frame.ids)
        assert room.info().state_hash == int(replay["hash"], 16)
    # A frame leaves out what never moves; ids ascend in the order of the scene.
    expected = np.array(replay["states"])
    moving = [index for index, line in enumerate(body_lines(replay["scene"])) if "BODY_TYPE_STATIC" not in line]
    if len(found) == len(moving):
        expected = expected[moving]
    assert found[order].astype(float).tolist() == expected.tolist()


def body_lines(scene: str) -> list[str]:
    return [line for line in scene.splitlines() if line.startswith("bodies ")]
