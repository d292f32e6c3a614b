"""A scripted experiment: how high does a ball bounce, for several restitutions? Plots height over time.

The room is paused and stepped, so the result does not depend on how fast this machine is, and two runs give the same
figures. It ends by checking the first rebound against theory: a ball dropped from h above the floor rises to e² h.

    python examples/experiment.py [ENDPOINT] [--plot bounce.png]
"""

from __future__ import annotations

import argparse

import matplotlib

matplotlib.use("Agg")  # no screen needed

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

import urto

RADIUS = 0.25  # m
DROP_HEIGHT = 4.0  # m, of the ball's lowest point above the floor
FLOOR_Y = 100.0  # m; above whatever else is in the room
RESTITUTIONS = (0.5, 0.7, 0.8, 0.9)
TICKS = 240


def run(room: urto.Room) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Times (TICKS + 1,) in s and heights (TICKS + 1, len(RESTITUTIONS)) in m above the floor."""
    floor = urto.Box(width=20, height=1, position=(0, FLOOR_Y - 0.5), type="static")
    balls = [
        urto.Circle(radius=RADIUS, position=(2.0 * index, FLOOR_Y + DROP_HEIGHT + RADIUS), restitution=restitution)
        for index, restitution in enumerate(RESTITUTIONS)
    ]
    bodies = room.spawn([floor, *balls])
    first = room.frame()
    times, heights = [0.0], [[DROP_HEIGHT] * len(balls)]
    for _ in range(TICKS):
        frame = room.step()
        times.append(frame.sim_time - first.sim_time)
        heights.append([frame[ball].position[1] - RADIUS - FLOOR_Y for ball in bodies[1:]])
    with room.batch() as batch:
        for body in bodies:
            batch.despawn(body)
    return np.array(times), np.array(heights)


def first_rebound(height: npt.NDArray[np.float64]) -> float:
    """m, the highest point between the first and the second touch of the floor."""
    rising = np.flatnonzero(np.diff(height) > 0)
    after = height[rising[0] :]
    falling_again = np.flatnonzero(np.diff(after) < 0)
    return float(after[falling_again[0]]) if len(falling_again) else float(after[-1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("endpoint", nargs="?", default=urto.DEFAULT_ENDPOINT)
    parser.add_argument("--plot", default="bounce.png", help="PNG or SVG file")
    options = parser.parse_args()
    with urto.connect(options.endpoint) as room:
        was_paused = room.info().paused
        room.pause()
        try:
            times, heights = run(room)
        finally:
            if not was_paused:
                room.resume()

    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for restitution, height in zip(RESTITUTIONS, heights.T, strict=True):
        rebound = first_rebound(height)
        print(f"e = {restitution:.2f}   rebound {rebound:.3f} m   theory {restitution**2 * DROP_HEIGHT:.3f} m")
        axes.plot(times, height, label=f"e = {restitution:g}")
        axes.axhline(restitution**2 * DROP_HEIGHT, color=axes.lines[-1].get_color(), linestyle=":", linewidth=1)
    axes.set(xlabel="time, s", ylabel="height above the floor, m", title="Bounce, and e²h dotted")
    axes.legend()
    figure.savefig(options.plot, dpi=120)
    print(f"plot {options.plot}")


if __name__ == "__main__":
    main()
