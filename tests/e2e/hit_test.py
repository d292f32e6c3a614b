"""Hit events through a served room, against speeds computed by hand."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest
import urto
from conftest import EMPTY, GRAVITY_Y, TIME_STEP, TIMEOUT_S, Start

URTO = Path(sys.executable).with_name("urto")


def _scene(hit_events: str) -> str:
    return EMPTY.replace("sub_steps: 1", f"sub_steps: 4 {hit_events}")


def _hits_of_a_fall(start: Start, hit_events: str, heights: tuple[float, ...]) -> list[tuple[int, urto.ContactHit]]:
    """(index of the fall, hit) after boxes fell from the heights, in m, onto a floor."""
    urtod = start(_scene(hit_events), "--paused")
    with urto.connect(urtod.endpoint, user="tester", timeout=TIMEOUT_S) as room:
        floor = room.spawn(urto.Box(width=100, height=1, position=(0, -0.5), type="static"))
        boxes = [
            room.spawn(urto.Box(width=1, height=1, position=(3 * index, height + 0.5)))
            for index, height in enumerate(heights)
        ]
        room.step(192)
        hits, begins = [], 0
        last = room.frame().event_sequence
        for event in room.events(since=1, timeout=TIMEOUT_S):
            begins += isinstance(event, urto.ContactBegin)
            if isinstance(event, urto.ContactHit):
                assert event.body_a == floor.id
                hits.append(([box.id for box in boxes].index(event.body_b), event))
            if event.sequence == last:
                break
        assert begins == len(boxes)
        return hits


def test_a_hit_has_the_speed_of_the_fall_and_its_point(start: Start) -> None:
    heights = (0.1, 0.25, 1.0, 4.0)
    hits = _hits_of_a_fall(start, "hit_events { speed_min: 1.5 }", heights)
    # 1.26 m/s is too slow; the others close in at 2, 4 and 8 m/s, at most a tick's gravity away from that.
    assert [index for index, _ in hits] == [1, 2, 3]
    for index, hit in hits:
        speed = math.sqrt(-2 * GRAVITY_Y * heights[index])
        assert hit.approach_speed == pytest.approx(speed, abs=-2 * GRAVITY_Y * TIME_STEP)
        assert hit.normal == pytest.approx((0, 1), abs=1e-6)
        assert abs(hit.point[0] - 3 * index) == pytest.approx(0.5, abs=0.01)
        assert hit.point[1] == pytest.approx(0, abs=1e-3)
        # It falls for √(2 h / g) seconds.
        assert hit.tick * TIME_STEP == pytest.approx(speed / -GRAVITY_Y, abs=3 * TIME_STEP)


def test_the_default_speed_is_one_metre_per_second(start: Start) -> None:
    hits = _hits_of_a_fall(start, "hit_events {}", (0.03, 0.1))  # 0.69 and 1.26 m/s
    assert [index for index, _ in hits] == [1]


def test_a_scene_that_does_not_ask_gets_none(start: Start) -> None:
    assert _hits_of_a_fall(start, "", (1.0, 4.0)) == []


def test_the_model_says_whether_hits_are_told(start: Start) -> None:
    for hit_events, on in (("", False), ("hit_events {}", True)):
        urtod = start(_scene(hit_events), "--paused")
        with urto.connect(urtod.endpoint, timeout=TIMEOUT_S) as room:
            (feature,) = [each for each in room.info().model if each.name == "hit events"]
            assert feature.on == on


def test_the_dominoes_strike_one_after_the_other(start: Start) -> None:
    urtod = start("dominoes", "--paused")
    with urto.connect(urtod.endpoint, user="tester", timeout=TIMEOUT_S) as room:
        names = {body.id: body.name for body in room.bodies()}
        room.step(300)
        last = room.frame().event_sequence
        first: dict[str, int] = {}
        for event in room.events(since=1, timeout=TIMEOUT_S):
            if isinstance(event, urto.ContactHit):
                assert event.approach_speed > 1
                pair = sorted([names[event.body_a], names[event.body_b]])
                if all(name.startswith("domino_") for name in pair):
                    struck = max(pair, key=lambda name: int(name.split("_")[1]))
                    first.setdefault(struck, event.tick)
            if event.sequence == last:
                break
    ticks = [first[f"domino_{index}"] for index in range(10, 31)]  # the wave runs evenly by then
    assert ticks == sorted(ticks)


def test_the_viewer_shows_hits(start: Start, tmp_path: Path) -> None:
    pytest.importorskip("rerun")
    from rerun.chunk import RrdReader

    urtod = start("dominoes")
    command = [URTO, "view", "--endpoint", urtod.endpoint, "--save", tmp_path, "--ticks", "240"]
    subprocess.run(command, check=True, capture_output=True, timeout=TIMEOUT_S * 4)
    radii = []
    for chunk in RrdReader(tmp_path / "room.rrd").store().stream().to_chunks():
        batch = chunk.to_record_batch()
        if str(chunk.entity_path) == "/room/camera/hits" and "Points2D:radii" in batch.schema.names:
            radii += [radius for row in batch.column("Points2D:radii").to_pylist() for radius in row or []]
    assert radii
    assert min(radii) > 0
