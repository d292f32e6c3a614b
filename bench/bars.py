"""What the speed of Urto is held to, and whether the figures meet it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

Row = dict[str, Any]  # of measuring.summary

SHARE_MAX = 0.5  # of a peer's time
SHARE_NEVER = 0.8  # of Box2D's: above it a scene counts as not done at all
GAIN_MIN = 1.7  # of two threads
SHARED_MS_MIN = 1.0  # of a step on one thread: below it there is too little to share
OUTRIGHT = {"joint_grid"}  # scenes where Urto need only be faster than Rapier, the fastest there
BOX2D = ("box2d-avx2", "box2d-neon")


@dataclass(frozen=True)
class Verdict:
    bar: str
    subject: str  # the scene, and the width of Urto
    figure: float
    level: float
    met: bool


def time_of(rows: Sequence[Row], scene: str, engine: str, threads: int = 1) -> float | None:
    for row in rows:
        if (row["scene"], row["engine"], row["threads"]) == (scene, engine, threads):
            return row.get("ms")
    return None


def peers_at_best(rows: Sequence[Row], scene: str) -> dict[str, float]:
    """Box2D at its widest, and Rapier in whichever of its builds is faster in this scene."""
    found: dict[str, float] = {}
    for row in rows:
        if row["scene"] == scene and row["threads"] == 1 and "ms" in row:
            if row["engine"] in BOX2D:
                found["Box2D"] = row["ms"]
            elif row["engine"].startswith("rapier"):
                found["Rapier"] = min(row["ms"], found.get("Rapier", row["ms"]))
    return found


def scenes_of(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(row["scene"] for row in rows))


def verdicts(rows: Sequence[Row]) -> list[Verdict]:
    found = []
    for scene in scenes_of(rows):
        for width in ("urto", "urto-avx2"):
            own = time_of(rows, scene, width)
            if own is None:
                continue
            for peer, ms in peers_at_best(rows, scene).items():
                if scene not in OUTRIGHT:
                    share = own / ms
                    bar = f"at most {SHARE_MAX:g} of {peer}'s time"
                    found.append(Verdict(bar, f"{scene} ({width})", share, SHARE_MAX, share <= SHARE_MAX))
                elif peer == "Rapier":
                    found.append(Verdict("faster than Rapier", f"{scene} ({width})", own / ms, 1, own < ms))
        if (gain := gain_of(rows, scene, "urto", 2)) and has_much_to_share(rows, scene):
            found.append(Verdict(f"two threads gain {GAIN_MIN:g}", scene, gain, GAIN_MIN, gain >= GAIN_MIN))
    return found


def gain_of(rows: Sequence[Row], scene: str, engine: str, threads: int) -> float | None:
    wall = {row["threads"]: row.get("wall_ms") for row in rows if (row["scene"], row["engine"]) == (scene, engine)}
    one, many = wall.get(1), wall.get(threads)
    return one / many if one and many else None


def has_much_to_share(rows: Sequence[Row], scene: str) -> bool:
    return (time_of(rows, scene, "urto") or 0) > SHARED_MS_MIN
