"""A first script: spawn a ball, push it, watch it fly. Start a room first: scripts/run"""

import sys

import urto

with urto.connect(sys.argv[1] if sys.argv[1:] else urto.DEFAULT_ENDPOINT) as room:
    ball = room.spawn(urto.Circle(radius=0.5, position=(0, 40)))
    pushed = ball.apply_impulse((2, 0))  # N·s; the tick at which it took effect
    for frame in room.frames():
        (x, y), ticks = frame[ball].position, frame.tick - pushed
        if ticks % 10 == 0:
            print(f"after {ticks:2d} ticks  x {x:5.2f} m  y {y:5.2f} m")
        if ticks >= 60:
            break
    ball.despawn()
