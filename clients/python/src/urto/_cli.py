"""The command `urto`.

It is built on argparse: nothing to install, and negative numbers are arguments without ado (`urto impulse ball 0 -5`),
which libraries that take every dash for an option spoil.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import json
import math
import os
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from urto import __version__
from urto._bodies import Box, Circle, Polygon, Shape
from urto._commands import BodyRef
from urto._describe import describe
from urto._exceptions import (
    ConnectionFailed,
    ConnectionLost,
    EventGap,
    InvalidArgument,
    Rejected,
    RequestTimeout,
    RoomNotFound,
    UrtoError,
)
from urto._frame import Frame
from urto._info import RoomInfo
from urto._keys import DEFAULT_ENDPOINT
from urto._room import Room, connect, rooms

EXIT_FAILED = 1
EXIT_USAGE = 2
EXIT_UNREACHABLE = 3
EXIT_REJECTED = 4
EXIT_INTERRUPTED = 130

_EPILOG = """\
environment: URTO_ENDPOINT, URTO_ROOM, URTO_USER stand in for the options; a password comes from URTO_PASSWORD alone.
exit codes: 0 done, 1 failed, 2 wrong usage, 3 no such server or room or no answer in time, 4 the room refused it."""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="urto",
        description="Looks into and acts on the rooms of an Urto server.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"urto {__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    common = _common_options()

    def add(name: str, run: Callable[[argparse.Namespace], None], text: str) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=text, description=text, parents=[common])
        command.set_defaults(run=run)
        return command

    add("rooms", _rooms, "names of the server's rooms, one a line")
    add("info", _in_room(_info), "what the room says about itself").add_argument(
        "--json", action="store_true", help="as JSON"
    )
    _add_spawn(add)
    impulse = add("impulse", _in_room(_impulse), "change a body's momentum at once")
    impulse.add_argument("body", help="id or name")
    impulse.add_argument("x", type=float, help="N·s")
    impulse.add_argument("y", type=float, help="N·s")
    impulse.add_argument("--at", nargs=2, type=float, metavar=("X", "Y"), help="m; default: the centre of mass")
    impulse.add_argument("--frame", choices=("world", "body"), default="world", help="of the impulse and the point")
    impulse.add_argument("--angular", type=float, default=0.0, help="N·m·s")
    add("pause", _in_room(lambda room, _: print(f"tick {room.pause()}")), "let time stand still")
    add("resume", _in_room(lambda room, _: print(f"tick {room.resume()}")), "let time go on")
    step = add("step", _in_room(_step), "advance a paused room")
    step.add_argument("ticks", type=int, nargs="?", default=1, help="default: 1")
    add("reset", _in_room(lambda room, _: print(f"epoch {room.reset()}")), "back to tick 0 of the scene")
    echo = add("echo", _in_room(_echo), "print what the room publishes, a line each")
    echo.add_argument("what", choices=("frames", "events"), nargs="?", default="frames", help="default: frames")
    echo.add_argument("--count", type=int, help="end after that many; default: never")
    echo.add_argument("--json", action="store_true", help="JSON with all fields")
    _add_view(add)
    return parser


def _common_options() -> argparse.ArgumentParser:
    common = argparse.ArgumentParser(add_help=False)
    options = common.add_argument_group("connection")
    options.add_argument("--endpoint", default=os.environ.get("URTO_ENDPOINT", DEFAULT_ENDPOINT), help="Zenoh locator")
    options.add_argument("--room", default=os.environ.get("URTO_ROOM"), help="default: the only one")
    options.add_argument("--user", default=os.environ.get("URTO_USER"), help="default: the user of this system")
    options.add_argument("--timeout", type=float, default=5.0, metavar="S", help="of every request; default: 5")
    return common


_Add = Callable[[str, Callable[[argparse.Namespace], None], str], argparse.ArgumentParser]


def _add_spawn(add: _Add) -> None:
    spawn = add("spawn", _in_room(_spawn), "add a body; prints its id")
    spawn.add_argument("shape", choices=("box", "circle", "polygon"))
    spawn.add_argument(
        "size", nargs="+", type=float, help="m; box: WIDTH HEIGHT, circle: RADIUS, polygon: X Y of each vertex"
    )
    spawn.add_argument("--at", nargs=2, type=float, default=(0.0, 0.0), metavar=("X", "Y"), help="m")
    spawn.add_argument("--angle", type=float, default=0.0, help="rad")
    spawn.add_argument("--velocity", nargs=2, type=float, default=(0.0, 0.0), metavar=("X", "Y"), help="m/s")
    spawn.add_argument("--angular-velocity", type=float, default=0.0, help="rad/s")
    spawn.add_argument("--name", default="", help="unique in the room")
    spawn.add_argument("--type", choices=("dynamic", "static", "kinematic"), default="dynamic")
    spawn.add_argument("--mass", type=float, help="kg; default: area times density")
    spawn.add_argument("--density", type=float, help="kg/m²; default: 1")
    spawn.add_argument("--friction", type=float, help="default: 0.6")
    spawn.add_argument("--restitution", type=float, default=0.0, help="0 to 1; default: 0")
    spawn.add_argument("--color", type=lambda text: int(text, 16), metavar="RRGGBB", help="for viewers")


def _add_view(add: _Add) -> None:
    view = add("view", _in_room(_view), "show the room in Rerun: a window, a browser, a file")
    where = view.add_argument_group("where (default: a new viewer on this screen)")
    target = where.add_mutually_exclusive_group()
    target.add_argument("--web", action="store_true", help="serve Rerun's web viewer on loopback and print its address")
    target.add_argument("--connect", metavar="URL", help="a viewer that runs, e.g. rerun+http://127.0.0.1:9876/proxy")
    where.add_argument("--web-port", type=int, help="port of the web viewer; default: a free one")
    where.add_argument("--save", type=Path, metavar="PATH", help="directory for room.rrd and room.png, or a .rrd file")
    where.add_argument("--picture", type=Path, metavar="FILE.png", help="with --save, where the picture goes instead")
    where.add_argument("--screenshot", action="store_true", help="with --save, also a picture of Rerun's own viewer")
    what = view.add_argument_group("what")
    what.add_argument("--velocities", action="store_true", help="an arrow on every moving body")
    what.add_argument("--contacts", action="store_true", help="contact points and normals")
    what.add_argument("--feel", metavar="BODY", help="name or id: discs are cast all round from it")
    what.add_argument("--rate", type=float, default=30.0, metavar="HZ", help="frames per second at most; default: 30")
    bound = view.add_argument_group("how long (default: until Ctrl-C; 10 s if it only saves)")
    bound.add_argument("--seconds", type=float, help="of the clock")
    bound.add_argument("--ticks", type=int, help="of the room")


def _in_room(run: Callable[[Room, argparse.Namespace], None]) -> Callable[[argparse.Namespace], None]:
    def in_room(options: argparse.Namespace) -> None:
        password = os.environ.get("URTO_PASSWORD")
        with connect(options.endpoint, options.room, options.user, password, options.timeout) as room:
            run(room, options)

    return in_room


def _rooms(options: argparse.Namespace) -> None:
    password = os.environ.get("URTO_PASSWORD")
    for name in rooms(options.endpoint, options.user, password, options.timeout):
        print(name)


def _info(room: Room, options: argparse.Namespace) -> None:
    info = room.info()
    if options.json:
        print(json.dumps(dataclasses.asdict(info), indent=2))
        return
    for line in _info_lines(info):
        print(line)


def _info_lines(info: RoomInfo) -> list[str]:
    held = info.statistics
    yes = [feature for feature in info.model if feature.on]
    lines = [
        f"room       {info.room} (Urto {info.server_version}, up {info.uptime:.0f} s)",
        f"scene      {info.scene}{': ' + info.description if info.description else ''}",
        f"time       tick {info.tick}, {'paused' if info.paused else 'running'}, "
        f"step {info.time_step * 1000:.4g} ms, scale {info.time_scale:g}, epoch {info.epoch}",
        f"bodies     {held.body_count}, {held.awake_count} awake, {held.contact_count} contacts",
        f"cost       {held.step_ms:.3f} ms a step, {held.overrun_count} ticks given up",
        f"energy     {held.kinetic_energy:.6g} J kinetic, {held.potential_energy:.6g} J potential",
        f"hash       {info.state_hash:016x} ({info.precision})",
        f"control    {info.control}{'' if info.authenticated else '; users are not checked'}",
        f"members    {', '.join(member.user for member in info.members) or 'none'}",
    ]
    lines += [f"model      {feature.name}: {feature.choice} ({feature.reason})" for feature in yes]
    return lines


def _spawn(room: Room, options: argparse.Namespace) -> None:
    print(room.spawn(_shape(options)).id)


def _shape(options: argparse.Namespace) -> Shape:
    size: list[float] = options.size
    fields: dict[str, Any] = {
        "position": tuple(options.at), "angle": options.angle, "velocity": tuple(options.velocity),
        "angular_velocity": options.angular_velocity, "name": options.name, "type": options.type,
        "mass": options.mass, "density": options.density, "friction": options.friction,
        "restitution": options.restitution, "color": options.color,
    }  # fmt: skip
    if options.shape == "box" and len(size) == 2:
        return Box(width=size[0], height=size[1], **fields)
    if options.shape == "circle" and len(size) == 1:
        return Circle(radius=size[0], **fields)
    if options.shape == "polygon" and len(size) >= 6 and len(size) % 2 == 0:
        return Polygon(vertices=list(zip(size[::2], size[1::2], strict=True)), **fields)
    raise InvalidArgument("a box is WIDTH HEIGHT, a circle RADIUS, a polygon three or more X Y")


def _body_ref(text: str) -> BodyRef:
    return int(text) if text.isdigit() else text


def _impulse(room: Room, options: argparse.Namespace) -> None:
    with room.batch() as batch:
        batch.apply_impulse(
            _body_ref(options.body), (options.x, options.y), point=options.at, frame=options.frame,
            angular=options.angular,
        )  # fmt: skip
    print(f"tick {batch.tick}")


def _step(room: Room, options: argparse.Namespace) -> None:
    frame = room.step(options.ticks)
    print(f"tick {frame.tick}")


def _echo(room: Room, options: argparse.Namespace) -> None:
    items: Any = room.frames(timeout=math.inf) if options.what == "frames" else _events_and_gaps(room)
    for item in itertools.islice(items, options.count):
        if isinstance(item, Frame):
            print(json.dumps(_frame_fields(item)) if options.json else _frame_line(item), flush=True)
        elif options.json:
            print(json.dumps({"event": type(item).__name__, **dataclasses.asdict(item)}), flush=True)
        else:
            print(f"{item.sequence} tick {item.tick} {describe(item)}", flush=True)


def _events_and_gaps(room: Room) -> Any:
    events = room.events()
    while True:
        try:
            yield next(events)
        except EventGap as gap:
            print(f"urto: {gap}", file=sys.stderr)


def _frame_line(frame: Frame) -> str:
    held = frame.statistics
    return (
        f"tick {frame.tick} t {frame.sim_time:.3f} s bodies {len(frame)} awake {int(frame.awake.sum())} "
        f"contacts {held.contact_count} energy {held.kinetic_energy + held.potential_energy:.6g} J"
    )


def _frame_fields(frame: Frame) -> dict[str, Any]:
    columns = ("ids", "position", "angle", "velocity", "angular_velocity", "awake")
    fields = {name: getattr(frame, name) for name in Frame.__slots__ if name not in (*columns, "statistics")}
    fields |= {name: getattr(frame, name).tolist() for name in columns}
    return fields | {"statistics": dataclasses.asdict(frame.statistics)}


def _view(room: Room, options: argparse.Namespace) -> None:
    try:
        from urto._viewer.view import ViewOptions, view
    except ModuleNotFoundError as error:
        raise UrtoError(f"{error.name} is missing: pip install 'urto[viewer]'") from None
    view(
        room,
        ViewOptions(
            save=options.save, picture=options.picture,
            web=options.web, web_port=options.web_port, connect=options.connect,
            seconds=options.seconds, ticks=options.ticks, rate_hz=options.rate, velocities=options.velocities,
            contacts=options.contacts, screenshot=options.screenshot,
            feel=None if options.feel is None else _body_ref(options.feel),
        ),
        say=lambda line: print(line, flush=True),
    )  # fmt: skip


def _exit_code(error: UrtoError) -> int:
    if isinstance(error, Rejected):
        return EXIT_REJECTED
    if isinstance(error, ConnectionFailed | ConnectionLost | RoomNotFound | RequestTimeout):
        return EXIT_UNREACHABLE
    return EXIT_USAGE if isinstance(error, InvalidArgument) else EXIT_FAILED


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; gives the exit code."""
    options = _parser().parse_args(arguments)

    def interrupt(_signal: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt  # a request to end is like Ctrl-C: what was started is ended, files are finished

    signal.signal(signal.SIGTERM, interrupt)
    try:
        options.run(options)
        sys.stdout.flush()
    except UrtoError as error:
        print(f"urto: {error}", file=sys.stderr)
        return _exit_code(error)
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    except BrokenPipeError:  # the reader of our output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


if __name__ == "__main__":
    sys.exit(main())
