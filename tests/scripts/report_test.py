"""How the report measures: what is noted is not measured again, and the time that is left can be told."""

import json
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

from reporting import equal_cost, measure, notes, pages, plan  # noqa: E402

CASE = {"row": 3, "case": "bounce", "curves": "solvers", "long": False, "levels": {"default": 0.1, "verlet": 0.2}}


def program(tmp_path, name="engine", error=0.5, then="exit 0"):
    """One that counts its runs in a file beside it."""
    path = tmp_path / name
    line = json.dumps({"engine": "urto", "error": error, "cpu_s_per_s": 0.25})
    path.write_text(f"#!/bin/sh\necho run >>{tmp_path}/runs\necho greetings\necho '{line}'\n{then}\n")
    path.chmod(0o755)
    return path


def runs(tmp_path):
    path = tmp_path / "runs"
    return len(path.read_text().splitlines()) if path.exists() else 0


def bench(tmp_path, path):
    return measure.Bench({"urto": path}, notes.Notes(tmp_path / "notes.jsonl", {"urto": path}))


POINT = plan.Point("urto", "bounce", "default", "default")
EFFORT = measure.QUICK


def test_a_stopped_report_goes_on_where_it_was(tmp_path):
    path = program(tmp_path)
    first = bench(tmp_path, path).point(POINT, EFFORT)
    assert first["error"] == 0.5 and first["cpu_s_per_s"] == 0.25
    path.touch()  # built anew with the same result
    assert bench(tmp_path, path).point(POINT, EFFORT) == first
    assert runs(tmp_path) == 1


def test_what_another_program_said_is_not_taken(tmp_path):
    bench(tmp_path, program(tmp_path)).point(POINT, EFFORT)
    assert bench(tmp_path, program(tmp_path, error=0.75)).point(POINT, EFFORT)["error"] == 0.75
    assert runs(tmp_path) == 2


def test_more_effort_measures_anew(tmp_path):
    path = program(tmp_path)
    bench(tmp_path, path).point(POINT, measure.QUICK)
    bench(tmp_path, path).point(POINT, measure.FULL)
    assert runs(tmp_path) == 2


def test_a_program_that_was_stopped_is_asked_again(tmp_path):
    path = program(tmp_path, then="exit 3")
    for _ in range(2):
        assert bench(tmp_path, path).point(POINT, EFFORT)["failed"] == "exit status 3"
    assert runs(tmp_path) == 2


def test_a_half_written_note_and_an_old_one_are_left_out(tmp_path, monkeypatch):
    path = program(tmp_path)
    bench(tmp_path, path).point(POINT, EFFORT)
    with (tmp_path / "notes.jsonl").open("a") as file:
        file.write('{"at": 17')
    bench(tmp_path, path).point(POINT, EFFORT)
    assert runs(tmp_path) == 1
    monkeypatch.setattr(notes, "KEPT_HOURS", 0)
    bench(tmp_path, path).point(POINT, EFFORT)
    assert runs(tmp_path) == 2


def test_a_report_that_went_on_tells_since_when_it_measured(tmp_path):
    path = program(tmp_path)
    bench(tmp_path, path).point(POINT, EFFORT)
    taken = json.loads((tmp_path / "notes.jsonl").read_text())["at"]
    later = bench(tmp_path, path)
    assert later.notes.used_since > taken, "it has asked for nothing yet"
    later.point(POINT, EFFORT)
    assert later.notes.used_since == taken


def test_a_point_that_simulated_nothing_has_no_time(tmp_path):
    path = program(tmp_path)
    path.write_text(path.read_text().replace("0.25", "null"))
    assert "cpu_s_per_s" not in bench(tmp_path, path).point(POINT, EFFORT)


def test_a_level_that_took_too_long_is_not_met():
    record = {"failed": "took more than 60 s"}
    assert pages._cell(record, 1e-6) == "too long ✗ 1e-06"
    assert pages._cell(record) == "too long"


def test_what_runs_beside_others_has_no_time(tmp_path):
    points = [POINT, plan.Point("urto", "bounce", "verlet", ""), plan.Point("box2d_v2", "bounce", "default", "")]
    timed, untimed, missing = measure.measure_all(bench(tmp_path, program(tmp_path)), points, EFFORT)
    assert "cpu_s_per_s" in timed and timed["method"] == "default"
    assert "cpu_s_per_s" not in untimed and untimed["method"] == "verlet" and untimed["error"] == 0.5
    assert missing["failed"] == "not built"


def test_long_cases_have_their_levels_alone_and_no_times():
    points = plan.points_of(CASE | {"long": True}, plan.FULL, True)
    assert {point.method for point in points} == {"default", "verlet"}
    assert not any(point.timed for point in points)


def test_the_levels_of_a_case_come_first_and_no_point_twice():
    points = plan.points_of(CASE, plan.FULL, True)
    assert [point.method for point in points[:3]] == ["default", "verlet", "precise"]
    assert len({(point.engine, point.method) for point in points}) == len(points)
    assert not points[1].timed and points[0].timed


@pytest.mark.parametrize("count", [0, 1, 2, 100, 2383])
def test_every_beginning_of_the_order_is_spread_over_the_whole(count):
    order = measure.spread(count)
    assert sorted(order) == list(range(count))
    for begun in (count // 10, count // 3):
        below = sum(i < count / 2 for i in order[:begun])
        assert abs(below - begun / 2) <= 2


def timed(engine, method, error, cost):
    return {"engine": engine, "case": "bounce", "method": method, "curve": "x", "error": error, "cpu_s_per_s": cost}


def test_a_peer_is_ahead_only_where_nothing_as_cheap_errs_as_little():
    own = [timed("urto", "default", 0.1, 1.0), timed("urto", "precise", 1e-14, 8.0), timed("urto", "wild", None, 0.1)]
    peer = [
        timed("box2d_v3", "dearer and worse", 0.2, 2.0),
        timed("box2d_v3", "better", 0.05, 1.0),
        timed("box2d_v3", "cheaper", 0.5, 0.5),
        timed("box2d_v3", "rounding", 1e-15, 8.0),
        timed("box2d_v3", "within the spread of times", 0.1, 0.9),
        timed("box2d_v3", "no number", None, 0.2),
    ]
    total, ahead = equal_cost.compare([CASE], {"bounce": own + peer})
    assert total == len(peer)
    assert [point["method"] for each in ahead for point in each.points] == ["better", "cheaper"]
    page = "\n".join(equal_cost.section([CASE], {"bounce": own + peer}))
    assert "For 4 of the 6 points" in page and "| better | 0.05 | 1 | 0.1 |" in page


def test_a_point_cheaper_than_all_of_ours_has_nothing_beside_it():
    records = [timed("urto", "default", 0.1, 1.0), timed("rapier", "default", 0.5, 0.25)]
    assert "nothing as cheap" in "\n".join(equal_cost.section([CASE], {"bounce": records}))
