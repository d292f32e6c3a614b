"""What the benchmark makes of its figures: bars, exponents and marks are computed, and the scenes are what they say."""

import math
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

import bars  # noqa: E402
import crowds  # noqa: E402
import engines  # noqa: E402
import growth  # noqa: E402
import measuring  # noqa: E402
import table  # noqa: E402


def row(scene, engine, ms, threads=1, **more):
    return {"scene": scene, "engine": engine, "threads": threads, "ms": ms, "wall_ms": ms, **more}


def rows(urto=2.0, box2d=4.0, rapier=9.0, rapier_wide=5.0, scene="washer"):
    return [
        row(scene, "urto", urto),
        row(scene, "box2d-sse2", 2 * box2d),
        row(scene, "box2d-avx2", box2d),
        row(scene, "rapier", rapier),
        row(scene, "rapier-avx2", rapier_wide),
    ]


def test_peers_count_at_their_best():
    assert bars.peers_at_best(rows(), "washer") == {"Box2D": 4.0, "Rapier": 5.0}
    assert bars.peers_at_best(rows(rapier=3.0), "washer") == {"Box2D": 4.0, "Rapier": 3.0}


@pytest.mark.parametrize("urto, met", [(2.0, [True, True]), (2.4, [False, True]), (2.6, [False, False])])
def test_half_of_each_peers_time_is_the_bar(urto, met):
    assert [verdict.met for verdict in bars.verdicts(rows(urto))] == met


@pytest.mark.parametrize("urto, met", [(4.9, True), (5.0, False)])
def test_a_scene_where_rapier_is_fastest_asks_for_less_than_its_time(urto, met):
    (verdict,) = bars.verdicts(rows(urto, scene="joint_grid"))
    assert verdict.bar == "faster than Rapier" and verdict.met is met


@pytest.mark.parametrize("two, met", [(1.0, True), (1.3, False)])
def test_two_threads_are_judged_by_the_wall_clock(two, met):
    found = bars.verdicts([*rows(), row("washer", "urto", two, threads=2)])
    assert [verdict.met for verdict in found if "threads" in verdict.bar] == [met]


def test_two_threads_are_not_judged_where_there_is_little_to_share():
    found = bars.verdicts([row("washer", "urto", 0.9), row("washer", "urto", 0.9, threads=2)])
    assert found == []


def test_a_missed_bar_is_named_in_the_table():
    result = {"rows": rows(2.6), "differing hashes": ["urto in washer"]}
    lines = table.verdict_lines(result)
    assert any("met 0 of 1; not met: washer (urto) 0.65" in line for line in lines)
    assert any("NOT the same: urto in washer" in line for line in lines)


def test_urto_may_not_differ_between_widths_and_threads_but_peers_may():
    def outcome(engine, threads, state):
        return measuring.Outcome("smash", engine, threads, [{"hash": state}])

    same = [outcome("urto", 1, "a"), outcome("urto-avx2", 1, "a"), outcome("urto", 2, "a")]
    assert measuring.differing_hashes([*same, outcome("rapier", 1, "b"), outcome("rapier-avx2", 1, "c")]) == []
    assert measuring.differing_hashes([*same, outcome("urto", 4, "b")]) == ["urto in smash"]


def test_only_the_widest_builds_run_on_several_threads():
    present = ["urto", "urto-avx2", "box2d-sse2", "box2d-avx2", "rapier"]
    assert engines.widest(present) == ["urto", "box2d-avx2", "rapier"]


def scaled(time_of):
    return [
        {"engine": "urto", "kind": "gas", "count": count, "cpu_ms": time_of(count)} for count in (100, 1000, 10_000)
    ]


def test_the_fitted_exponent_is_that_of_a_power():
    assert growth.fitted_exponent(scaled(lambda n: 3 * n**1.25), "urto", "gas") == pytest.approx(1.25)


def test_n_log_n_is_fitted_over_the_same_sizes():
    records = scaled(lambda n: 1e-3 * n * math.log(n))
    own = growth.fitted_exponent(records, "urto", "gas")
    assert own == pytest.approx(growth.exponent_of_n_log_n(records))


@pytest.mark.parametrize("count", [10, 100, 1000])
def test_a_crowd_has_as_many_bodies_as_it_is_asked_for(count):
    for scene in (crowds.pile(count), crowds.gas(count), crowds.sleepers(count, 0)):
        assert scene.text().count("body dynamic") == count
    assert crowds.sleepers(10, count).text().count("body dynamic") == 10 + count


def test_sleepers_come_after_those_that_are_awake():
    alone, beside = crowds.sleepers(50, 0).text().splitlines(), crowds.sleepers(50, 100).text().splitlines()
    assert beside[1 : len(alone)] == alone[1:]
