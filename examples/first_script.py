"""A first script: spawn a ball, push it, watch it fly. Start a room first: scripts/run --scene platformer"""

import sys

import urto

with urto.connect(*sys.argv[1:]) as room:  # the room of the urtod on this machine, or of the endpoint given
    ball = room.spawn(urto.Circle(radius=0.5, position=(0, 20), restitution=0.6))
    ball.apply_impulse((2, 0))  # N·s
    start = room.info().tick
    for frame in room.frames():
        x, y = frame[ball].position
        print(f"tick {frame.tick}  x {x:6.2f} m  y {y:6.2f} m")
        if frame.tick > start + 60:
            break
    ball.despawn()
