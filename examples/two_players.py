"""A game of two players in one room: each pushes a paddle, and both want the crates on the other's side.

Each player is a client of its own, in a thread here and on another machine just as well: it sees the room only
through its frames and acts only through its commands. The referee is a third client that builds the field, tells the
score and clears up.

    python examples/two_players.py [ENDPOINT] [--seconds 10] [--seed 1]
"""

from __future__ import annotations

import argparse
import random
import threading

import urto

FIELD = 12.0  # m, half the width
WALL_HEIGHT = 4.0  # m
CRATES = 12
PADDLE_SPEED_MAX = 9.0  # m/s
TURN_TICKS = 6  # a player thinks that often


def build_field(room: urto.Room, seed: int) -> dict[str, list[urto.BodyHandle]]:
    """Floor, walls, crates and a paddle for each player, all at one tick."""
    rng = random.Random(seed)
    with room.batch() as batch:
        field = batch.spawn(
            [
                urto.Box(width=2 * FIELD + 2, height=1, position=(0, -0.5), type="static"),
                urto.Box(width=1, height=WALL_HEIGHT, position=(-FIELD - 0.5, WALL_HEIGHT / 2), type="static"),
                urto.Box(width=1, height=WALL_HEIGHT, position=(FIELD + 0.5, WALL_HEIGHT / 2), type="static"),
            ]
        )
        crates = batch.spawn(
            urto.Box(
                width=rng.uniform(0.5, 0.9), height=rng.uniform(0.5, 0.9), friction=0.3, density=2,
                position=(rng.uniform(-2, 2), 1 + index), color=0xE9C46A,
            )
            for index in range(CRATES)
        )  # fmt: skip
        paddles = [
            batch.spawn(urto.Box(width=0.8, height=1.6, position=(x, 0.8), density=8, friction=0.1,
                                 fixed_rotation=True, color=color))
            for x, color in ((-FIELD + 2, 0x3A86FF), (FIELD - 2, 0xFF006E))
        ]  # fmt: skip
    return {"field": field, "crates": crates, "paddles": paddles}


def play(
    endpoint: str, name: str, room_name: str, paddle_id: int, crate_ids: list[int], side: int, end: threading.Event
) -> None:
    """Runs at the nearest crate on our own side and through it; `side` is −1 for the left player, 1 for the right."""
    with urto.connect(endpoint, room=room_name, user=name) as room:
        home = side * (FIELD - 1)
        next_turn = 0
        for frame in room.frames():
            if end.is_set():
                return
            if frame.tick < next_turn:
                continue
            next_turn = frame.tick + TURN_TICKS
            me = frame[paddle_id]
            ours = [frame[crate].position[0] for crate in crate_ids if side * frame[crate].position[0] > 0]
            behind = [x for x in ours if side * x < side * me.position[0]]
            target = min(behind, key=lambda x: abs(x - me.position[0])) - side if behind else home
            wanted = max(-PADDLE_SPEED_MAX, min(PADDLE_SPEED_MAX, 3 * (target - me.position[0])))
            with room.batch(answer=False) as batch:  # no need to wait: the next frame shows what came of it
                batch.apply_impulse(paddle_id, (8 * 0.8 * 1.6 * (wanted - me.velocity[0]), 0))


def score(frame: urto.Frame, crates: list[urto.BodyHandle]) -> tuple[int, int]:
    """Points of the left and the right player: crates on the other's side."""
    right = sum(frame[crate].position[0] > 0 for crate in crates)
    return right, len(crates) - right


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("endpoint", nargs="?", default=urto.DEFAULT_ENDPOINT)
    parser.add_argument("--seconds", type=float, default=10.0, help="of the game")
    parser.add_argument("--seed", type=int, default=1, help="of the crates")
    options = parser.parse_args()
    with urto.connect(options.endpoint, user="referee") as room:
        things = build_field(room, options.seed)
        crate_ids = [crate.id for crate in things["crates"]]
        end = threading.Event()
        players = [
            threading.Thread(
                target=play, args=(options.endpoint, name, room.name, paddle.id, crate_ids, side, end), name=name
            )
            for name, paddle, side in zip(("left", "right"), things["paddles"], (-1, 1), strict=True)
        ]
        try:
            for player in players:
                player.start()
            start = shown = room.frame().sim_time
            for frame in room.frames():
                if frame.sim_time >= shown + 1:
                    shown = frame.sim_time
                    left, right = score(frame, things["crates"])
                    print(f"{frame.sim_time - start:5.1f} s   left {left:2d} : {right:2d} right", flush=True)
                if frame.sim_time > start + options.seconds:
                    break
        finally:
            end.set()
            for player in players:
                player.join()
            with room.batch() as batch:
                for body in (body for group in things.values() for body in group):
                    batch.despawn(body)


if __name__ == "__main__":
    main()
