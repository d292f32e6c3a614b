"""A room in this process: the documented keys, bodies that fly without touching. Small enough to check by hand.

The integrator is semi-implicit Euler: v += g dt, then x += v dt; angle += omega dt.
"""

from __future__ import annotations

import socket
import threading
from typing import Any, Self

import zenoh

from urto._proto.v1 import command_pb2, room_pb2, scene_pb2, snapshot_pb2

TIME_STEP = 1.0 / 64.0  # s; a power of two, so that the expected figures are exact in binary
GRAVITY_Y = -8.0  # m/s²
EVENTS_KEPT = 16


class Refusal(Exception):
    def __init__(self, code: int, field: str, value: str) -> None:
        super().__init__(field)
        self.code, self.field, self.value = code, field, value


class FakeRoom:
    """One room on an ephemeral loopback port. `publish` and `advance` are called by the test, nothing runs alone."""

    def __init__(self, name: str = "demo", protocol_version: int = 1) -> None:
        self.name = name
        self.protocol_version = protocol_version
        self.tick, self.epoch, self.paused, self.time_scale = 0, 1, True, 1.0
        self.bodies: dict[int, dict[str, Any]] = {}
        self.next_id = 1
        self.layout = 1
        self.events: list[snapshot_pb2.Event] = []
        self.first_kept = 1
        self.silent: set[str] = set()  # the last parts of keys that get no answer
        self.lose_events = False
        self.batches: list[command_pb2.CommandBatch] = []
        self.member_keys: list[str] = []
        self.member_change = threading.Condition()
        self.lock = threading.RLock()
        self._held: list[zenoh.Query] = []
        self.session, self.endpoint = _listen()
        prefix = f"urto/v1/{name}"
        self._keep = [
            self.session.declare_queryable(f"{prefix}/info", self._answer(self._info)),
            self.session.declare_queryable(f"{prefix}/state", self._answer(self._state)),
            self.session.declare_queryable(f"{prefix}/event", self._answer(self._event_recovery)),
            self.session.declare_queryable(f"{prefix}/cmd/*", self._answer(self._command)),
            self.session.declare_subscriber(f"{prefix}/cmd/*", self._on_put),
            self.session.liveliness().declare_subscriber(f"{prefix}/member/*/*", self._on_member, history=True),
        ]
        self._publisher = self.session.declare_publisher(f"{prefix}/snapshot")
        self.alive = self.session.liveliness().declare_token(f"{prefix}/alive")

    def __enter__(self) -> FakeRoom:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        for query in self._held:
            query.drop()
        if not self.session.is_closed():
            self.session.close()

    # What a test does to it

    def advance(self, ticks: int = 1) -> None:
        with self.lock:
            for _ in range(ticks):
                self.tick += 1
                for body in self.bodies.values():
                    if body["type"] == scene_pb2.BODY_TYPE_STATIC:
                        continue
                    body["vy"] += GRAVITY_Y * TIME_STEP
                    body["x"] += body["vx"] * TIME_STEP
                    body["y"] += body["vy"] * TIME_STEP
                    body["angle"] += body["omega"] * TIME_STEP

    def publish(self) -> None:
        with self.lock:
            self._publisher.put(self.snapshot(full=False).SerializeToString())

    def emit(self, **event: Any) -> int:
        """Adds an event and publishes it, unless `lose_events`. Gives its sequence number."""
        with self.lock:
            self.events.append(snapshot_pb2.Event(tick=self.tick, **event))
            sequence = self.first_kept + len(self.events) - 1
            batch = snapshot_pb2.EventBatch(epoch=self.epoch, first_sequence=sequence, events=self.events[-1:])
            while len(self.events) > EVENTS_KEPT:
                self.events.pop(0)
                self.first_kept += 1
            if not self.lose_events:
                self.session.put(f"urto/v1/{self.name}/event", batch.SerializeToString())
            return sequence

    def snapshot(self, full: bool) -> snapshot_pb2.Snapshot:
        snapshot = snapshot_pb2.Snapshot(
            epoch=self.epoch, tick=self.tick, sim_time=self.tick * TIME_STEP, layout=self.layout, paused=self.paused,
            full=full, state_hash=self.tick * 1000 + len(self.bodies),
        )  # fmt: skip
        snapshot.statistics.body_count = len(self.bodies)
        awake = bytearray()
        for body_id, body in sorted(self.bodies.items()):
            if body["type"] == scene_pb2.BODY_TYPE_STATIC and not full:
                continue
            snapshot.id.append(body_id)
            snapshot.x.append(body["x"])
            snapshot.y.append(body["y"])
            snapshot.angle.append(body["angle"])
            snapshot.velocity_x.append(body["vx"])
            snapshot.velocity_y.append(body["vy"])
            snapshot.angular_velocity.append(body["omega"])
            awake.append(1)
        snapshot.awake = bytes(awake)
        return snapshot

    # Answers

    def _answer(self, make: Any) -> Any:
        def on_query(query: zenoh.Query) -> None:
            part = str(query.key_expr).split("/")[3]
            if part in self.silent:
                self._held.append(query)
                return
            with query, self.lock:
                query.reply(query.key_expr, make(query).SerializeToString())

        return on_query

    def _on_put(self, sample: zenoh.Sample) -> None:
        with self.lock:
            batch = command_pb2.CommandBatch.FromString(sample.payload.to_bytes())
            reply = self._run(batch)
            if reply.HasField("rejection"):
                user = str(sample.key_expr).rsplit("/", 1)[1]
                self.emit(
                    batch_rejected=snapshot_pb2.BatchRejected(
                        user=user, sequence=batch.sequence, reason=reply.rejection.message
                    )
                )

    def _on_member(self, sample: zenoh.Sample) -> None:
        key = str(sample.key_expr)
        user, session = key.split("/")[-2:]
        joined = sample.kind == zenoh.SampleKind.PUT
        with self.member_change:
            if joined:
                self.member_keys.append(key)
            else:
                self.member_keys.remove(key)
            self.member_change.notify_all()
        if joined:
            self.emit(member_joined=snapshot_pb2.MemberJoined(user=user, session=session))
        else:
            self.emit(member_left=snapshot_pb2.MemberLeft(user=user, session=session))

    def wait_members(self, count: int) -> None:
        with self.member_change:
            assert self.member_change.wait_for(lambda: len(self.member_keys) == count, timeout=10)

    def _info(self, _: object = None) -> room_pb2.RoomInfo:
        info = room_pb2.RoomInfo(
            room=self.name, server_version="0.1.0", protocol_version=self.protocol_version, scene="fake",
            epoch=self.epoch, tick=self.tick, time_step=TIME_STEP, time_scale=self.time_scale, snapshot_rate_hz=64,
            paused=self.paused, control=room_pb2.PERMISSION_EVERYONE,
        )  # fmt: skip
        for key in self.member_keys:
            user, session = key.split("/")[-2:]
            info.members.add(user=user, session=session)
        return info

    def _body_info(self, body_id: int) -> snapshot_pb2.BodyInfo:
        body = self.bodies[body_id]
        return snapshot_pb2.BodyInfo(
            id=body_id, body=body["message"], mass=body["mass"], position=scene_pb2.Vector(x=body["x"], y=body["y"]),
            angle=body["angle"], velocity=scene_pb2.Vector(x=body["vx"], y=body["vy"]),
            angular_velocity=body["omega"], awake=True,
        )  # fmt: skip

    def _state(self, query: zenoh.Query) -> room_pb2.RoomState:
        state = room_pb2.RoomState(info=self._info(), snapshot=self.snapshot(full=True))
        state.bodies.extend(self._body_info(body_id) for body_id in sorted(self.bodies))
        if query.parameters.get("saved_state") == "true":
            state.saved_state = b"saved"
        return state

    def _event_recovery(self, query: zenoh.Query) -> snapshot_pb2.EventBatch:
        first = max(int(query.parameters.get("from") or 0), self.first_kept)
        batch = snapshot_pb2.EventBatch(epoch=self.epoch, first_sequence=first, oldest_sequence=self.first_kept)
        batch.events.extend(self.events[first - self.first_kept :])
        return batch

    # Commands

    def _command(self, query: zenoh.Query) -> command_pb2.CommandReply:
        batch = command_pb2.CommandBatch.FromString(query.payload.to_bytes() if query.payload else b"")
        return self._run(batch)

    def _run(self, batch: command_pb2.CommandBatch) -> command_pb2.CommandReply:
        self.batches.append(batch)
        reply = command_pb2.CommandReply(sequence=batch.sequence)
        before = {body_id: dict(body) for body_id, body in self.bodies.items()}, self.next_id
        for index, command in enumerate(batch.commands):
            try:
                reply.results.append(self._apply(command))
            except Refusal as refusal:
                self.bodies, self.next_id = before
                del reply.results[:]
                reply.rejection.CopyFrom(
                    command_pb2.Rejection(
                        code=refusal.code, index=index, field=refusal.field, value=refusal.value, message="refused"
                    )
                )
                break
        reply.tick, reply.epoch = self.tick, self.epoch
        return reply

    def _find(self, ref: command_pb2.BodyRef, field: str) -> dict[str, Any]:
        for body_id, body in self.bodies.items():
            if ref.id == body_id or (ref.name and ref.name == body["message"].name):
                return body
        raise Refusal(command_pb2.REJECTION_CODE_UNKNOWN_BODY, f"{field}.body", ref.name or str(ref.id))

    def _apply(self, command: command_pb2.Command) -> command_pb2.CommandResult:
        kind = command.WhichOneof("command")
        result = command_pb2.CommandResult()
        if kind == "spawn":
            result.id = self._spawn(command.spawn.body)
        elif kind == "despawn":
            body = self._find(command.despawn.body, "despawn")
            self.bodies = {body_id: each for body_id, each in self.bodies.items() if each is not body}
            self.layout += 1
        elif kind == "impulse":
            body = self._find(command.impulse.body, "impulse")
            if body["type"] != scene_pb2.BODY_TYPE_DYNAMIC:
                raise Refusal(command_pb2.REJECTION_CODE_WRONG_BODY_TYPE, "impulse.body", "static")
            body["vx"] += command.impulse.impulse.x / body["mass"]
            body["vy"] += command.impulse.impulse.y / body["mass"]
        elif kind == "set_velocity":
            body = self._find(command.set_velocity.body, "set_velocity")
            if command.set_velocity.HasField("velocity"):
                body["vx"], body["vy"] = command.set_velocity.velocity.x, command.set_velocity.velocity.y
        elif kind == "set_transform":
            body = self._find(command.set_transform.body, "set_transform")
            if command.set_transform.HasField("position"):
                body["x"], body["y"] = command.set_transform.position.x, command.set_transform.position.y
        elif kind in ("pause", "resume"):
            self.paused = kind == "pause"
        elif kind == "step":
            if not self.paused:
                raise Refusal(command_pb2.REJECTION_CODE_NOT_PAUSED, "step", "")
            self.advance(command.step.ticks)
            result.snapshot.CopyFrom(self.snapshot(full=True))
        elif kind == "reset":
            self.bodies.clear()
            self.tick, self.next_id = 0, 1
            self.epoch += 1
        elif kind == "set_time_scale":
            self.time_scale = command.set_time_scale.scale
        elif kind == "query":
            self._query(command.query, result.query)
        return result

    def _spawn(self, message: scene_pb2.Body) -> int:
        for shape in message.shapes:
            if shape.WhichOneof("geometry") == "box" and not shape.box.width > 0:
                raise Refusal(
                    command_pb2.REJECTION_CODE_INVALID_VALUE, "spawn.body.shapes[0].box.width", str(shape.box.width)
                )
        if message.name and any(body["message"].name == message.name for body in self.bodies.values()):
            raise Refusal(command_pb2.REJECTION_CODE_DUPLICATE_NAME, "spawn.body.name", message.name)
        body_id = self.next_id
        self.next_id += 1
        self.layout += 1
        self.bodies[body_id] = {
            "message": message, "type": message.type, "x": message.position.x, "y": message.position.y,
            "angle": message.angle, "vx": message.velocity.x, "vy": message.velocity.y,
            "omega": message.angular_velocity, "mass": message.mass if message.HasField("mass") else 1.0,
        }  # fmt: skip
        return body_id

    def _query(self, query: command_pb2.Query, result: command_pb2.QueryResult) -> None:
        kind = query.WhichOneof("query")
        if kind == "body":
            body = self._find(query.body.body, "query.body")
            body_id = next(key for key, value in self.bodies.items() if value is body)
            result.body.CopyFrom(self._body_info(body_id))
        elif kind == "contacts":
            result.contacts.body_a.append(1)
            result.contacts.body_b.append(2)
            for column, value in (
                ("x", 0.5), ("y", 1.5), ("normal_x", 0.0), ("normal_y", 1.0), ("separation", -0.25),
                ("normal_impulse", 2.0), ("tangent_impulse", -1.0),
            ):  # fmt: skip
                getattr(result.contacts, column).append(value)
        elif kind == "diagnostics":
            result.diagnostics.tick = self.tick
            result.diagnostics.state_hash = self.tick * 1000 + len(self.bodies)
            result.diagnostics.kinetic_energy = 3.0
            result.diagnostics.potential_energy = 4.0
        elif kind == "closest" and query.closest.distance_max < 0:
            raise Refusal(
                command_pb2.REJECTION_CODE_INVALID_VALUE, "query.closest.distance_max", str(query.closest.distance_max)
            )
        elif kind in ("cast", "overlap", "closest"):  # every body is a point that is met halfway
            most = getattr(query, kind).count_max or len(self.bodies)
            result.truncated = len(self.bodies) > most
            for body_id, body in sorted(self.bodies.items())[:most]:
                result.hits.add(
                    id=body_id, point=scene_pb2.Vector(x=body["x"], y=body["y"]), fraction=0.5, distance=-0.25,
                    query_point=getattr(query, kind).shape.position,
                )  # fmt: skip
        else:  # where the queried point is near enough: every body is a point here
            for body_id, body in sorted(self.bodies.items()):
                result.hits.add(id=body_id, point=scene_pb2.Vector(x=body["x"], y=body["y"]), distance=0.5)


def _listen() -> tuple[zenoh.Session, str]:
    # Zenoh does not say which port it got for port 0, so a free one is asked of the system first; should somebody
    # take it in between, Zenoh's open fails and the next is tried.
    for _ in range(20):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
        config = zenoh.Config()
        config.insert_json5("mode", '"peer"')
        config.insert_json5("listen/endpoints", f'["{endpoint}"]')
        config.insert_json5("listen/exit_on_failure", "true")
        config.insert_json5("scouting/multicast/enabled", "false")
        config.insert_json5("scouting/gossip/enabled", "false")
        try:
            return zenoh.open(config), endpoint
        except zenoh.ZError:
            continue
    raise RuntimeError("no free port")


class Publishing:
    """Publishes a fake room as it is, again every millisecond, in a thread while its `with` block lasts.

    What Zenoh tells a publisher about its readers is no promise: of 150 snapshots that were put right after its first
    word of a subscriber one never came. So a reader that waits for a first snapshot is sent it until it has it.
    """

    def __init__(self, fake: FakeRoom) -> None:
        self._fake = fake
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._end.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._end.wait(0.001):
            self._turn()

    def _turn(self) -> None:
        self._fake.publish()


class Running(Publishing):
    """The same of a room that goes on, one tick each time."""

    def _turn(self) -> None:
        self._fake.advance()
        self._fake.publish()
