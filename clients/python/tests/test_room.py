"""The sync face against a room in this process whose figures are computed by hand (see support/fake_room.py)."""

from __future__ import annotations

import itertools
import math
import subprocess
import sys
import threading
from typing import Any

import numpy as np
import pytest

import urto
from urto._proto.v1 import scene_pb2, snapshot_pb2
from support.fake_room import EVENTS_KEPT, GRAVITY_Y, TIME_STEP, FakeRoom, Publishing


def test_connect_finds_the_only_room_and_joins_it(fake: FakeRoom) -> None:
    with urto.connect(fake.endpoint, user="anna", timeout=10) as room:
        fake.wait_members(1)
        assert room.name == "demo"
        assert [member.user for member in room.info().members] == ["anna"]
        assert fake.member_keys == [f"urto/v1/demo/member/anna/{room.session}"]
    fake.wait_members(0)


def test_two_rooms_need_a_name(fake: FakeRoom) -> None:
    token = fake.session.liveliness().declare_token("urto/v1/other/alive")
    assert urto.rooms(fake.endpoint, timeout=10) == ("demo", "other")
    with pytest.raises(urto.RoomNotFound, match="demo, other") as caught:
        urto.connect(fake.endpoint, timeout=10)
    assert caught.value.rooms == ("demo", "other")
    token.undeclare()


def test_an_unknown_room_names_those_that_are_there(fake: FakeRoom) -> None:
    with pytest.raises(urto.RoomNotFound, match="no room 'nowhere' at .*; there are: demo"):
        urto.connect(fake.endpoint, room="nowhere", timeout=10)


def test_no_server_is_one_typed_error_that_names_the_endpoint() -> None:
    with pytest.raises(urto.ConnectionFailed, match="tcp/127.0.0.1:1 "):
        urto.connect("tcp/127.0.0.1:1", timeout=0.2)


def test_a_server_of_another_protocol_is_refused() -> None:
    with FakeRoom(protocol_version=2) as fake, pytest.raises(urto.ProtocolError, match="protocol 2, this client 1"):
        urto.connect(fake.endpoint, timeout=10)


@pytest.mark.parametrize("arguments", [{"room": "a/b"}, {"user": ""}, {"user": "a*"}, {"timeout": 0}])
def test_bad_arguments_of_connect_are_told_before_anything_is_sent(arguments: dict[str, object]) -> None:
    with pytest.raises(urto.InvalidArgument):
        urto.connect("tcp/127.0.0.1:1", **arguments)  # type: ignore[arg-type]


def test_a_body_flies_as_computed(room: urto.Room) -> None:
    body = room.spawn(urto.Box(width=1, height=2, position=(0, 5), mass=2))
    assert body.apply_impulse((6, 0)) == 0
    frame = room.step(3)
    # vx = 6 / 2; after n steps of semi-implicit Euler y = y0 + g dt² n(n+1)/2 and vy = g dt n.
    assert frame.tick == 3
    assert frame.sim_time == 3 * TIME_STEP
    state = frame[body]
    assert state.position == (3 * 3 * TIME_STEP, 5 + GRAVITY_Y * TIME_STEP**2 * 6)
    assert state.velocity == (3, GRAVITY_Y * TIME_STEP * 3)


def test_a_batch_of_bodies_is_one_message(room: urto.Room, fake: FakeRoom) -> None:
    bodies = room.spawn([urto.Box(width=1, height=1, position=(x, 0)) for x in range(5)])
    assert [body.id for body in bodies] == [1, 2, 3, 4, 5]
    assert [len(batch.commands) for batch in fake.batches] == [5]
    assert room.frame().position[:, 0].tolist() == [0, 1, 2, 3, 4]


def test_a_batch_can_push_what_it_spawns(room: urto.Room, fake: FakeRoom) -> None:
    with room.batch() as batch:
        named = batch.spawn(urto.Circle(radius=1, name="ball"))
        unnamed = batch.spawn(urto.Circle(radius=1))
        batch.apply_impulse(named, (1, 0))
        batch.apply_impulse(unnamed, (2, 0))
        with pytest.raises(urto.InvalidArgument, match="no id before"):
            _ = unnamed.id
    assert batch.tick == 0
    frame = room.frame()
    assert frame[named].velocity == (1, 0)
    assert frame[unnamed].velocity == (2, 0)
    assert len(fake.batches) == 1


def test_an_error_in_the_block_sends_nothing(room: urto.Room, fake: FakeRoom) -> None:
    with pytest.raises(ZeroDivisionError), room.batch() as batch:
        batch.spawn(urto.Circle(radius=1))
        _ = 1 / 0
    assert fake.batches == []


def test_a_rejection_says_what_was_wrong_and_nothing_is_done(room: urto.Room) -> None:
    with pytest.raises(urto.InvalidValue) as caught:
        room.spawn([urto.Box(width=1, height=1), urto.Box(width=-3, height=1)])
    error = caught.value
    assert (error.code, error.index, error.field, error.value) == (
        "INVALID_VALUE", 1, "spawn.body.shapes[0].box.width", "-3.0",
    )  # fmt: skip
    assert "spawn.body.shapes[0].box.width" in str(error)
    assert len(room.frame()) == 0


def test_rejections_are_typed(room: urto.Room) -> None:
    wall = room.spawn(urto.Box(width=1, height=1, type="static", name="wall"))
    with pytest.raises(urto.WrongBodyType):
        wall.apply_impulse((1, 0))
    with pytest.raises(urto.DuplicateName):
        room.spawn(urto.Circle(radius=1, name="wall"))
    wall.despawn()
    with pytest.raises(urto.UnknownBody):
        wall.info()
    room.resume()
    with pytest.raises(urto.NotPaused):
        room.step()


def test_a_post_without_an_answer_is_done_or_rejected_by_event(room: urto.Room, fake: FakeRoom) -> None:
    with room.batch(answer=False) as batch:
        batch.spawn(urto.Box(width=-1, height=1))
    for event in room.events(timeout=10):
        if isinstance(event, urto.BatchRejected):
            assert (event.user, event.batch, event.reason) == ("tester", 1, "refused")
            break
    else:
        pytest.fail("no BatchRejected")


def test_a_silent_room_is_a_timeout(room: urto.Room, fake: FakeRoom) -> None:
    fake.silent.add("state")
    core_timeout, room._core.timeout = room._core.timeout, 0.2
    with pytest.raises(urto.RequestTimeout, match="room 'demo' at tcp/"):
        room.frame()
    room._core.timeout = core_timeout
    assert room.info().room == "demo"


def test_a_room_that_ends_is_lost_for_everyone_who_waits(fake: FakeRoom) -> None:
    with urto.connect(fake.endpoint, timeout=10) as room:
        fake.wait_members(1)
        frames = room.frames(timeout=math.inf)
        caught: list[BaseException] = []

        def wait() -> None:
            try:
                next(frames)
            except urto.UrtoError as error:
                caught.append(error)

        waiter = threading.Thread(target=wait)
        waiter.start()
        fake.close()
        waiter.join(10)
        assert [type(error) for error in caught] == [urto.ConnectionLost]
        with pytest.raises(urto.ConnectionLost):
            room.info()


def test_a_closed_room_says_so(room: urto.Room) -> None:
    room.close()
    room.close()
    with pytest.raises(urto.ClosedError):
        room.info()
    with pytest.raises(urto.ClosedError):
        next(room.events())


def test_frames_are_the_newest_and_count_what_was_missed(room: urto.Room, fake: FakeRoom) -> None:
    body = room.spawn(urto.Circle(radius=1))
    frames = room.frames()
    fake.advance()
    with Publishing(fake):
        assert next(frames).tick == 1
    for _ in range(5):
        fake.advance()
        fake.publish()
    _wait_for_snapshot(room, tick=6)
    frame = next(frames)
    assert frame.tick == 6
    assert body in frame
    assert frames.missed == room.frames_missed == 4


def _wait_for_snapshot(room: urto.Room, tick: int) -> None:
    while True:
        version = room._core.signal.version
        if snapshot_pb2.Snapshot.FromString(room._core.snapshots.latest[1]).tick == tick:
            return
        room._core.signal.wait(version).result(10)


def test_no_frame_in_time_is_a_timeout(room: urto.Room) -> None:
    with pytest.raises(urto.RequestTimeout, match=r"no frame of room 'demo' within 0.05 s"):
        next(room.frames(timeout=0.05))


def test_arrays_are_read_only_and_rows_are_found_by_id(room: urto.Room) -> None:
    wall = room.spawn(urto.Box(width=9, height=1, type="static"))
    ball = room.spawn(urto.Circle(radius=1, position=(1, 2), angular_velocity=64))
    frame = room.step()
    assert frame.position.shape == (2, 2)
    assert frame.ids.dtype == np.uint64
    assert frame.position.dtype == np.float32
    for array in (frame.ids, frame.position, frame.angle, frame.velocity, frame.angular_velocity, frame.awake):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    assert frame.index(wall) == 0
    assert frame[ball].angle == 1
    with pytest.raises(KeyError, match="body 99 is not in the frame of tick 1"):
        frame[99]


def test_events_come_in_order_and_reading_goes_on_where_it_stopped(room: urto.Room, fake: FakeRoom) -> None:
    fake.emit(room_paused={"user": "anna"})
    first, second = itertools.islice(room.events(timeout=10), 2)
    assert isinstance(first, urto.MemberJoined)
    assert first.user == "tester"
    assert isinstance(second, urto.RoomPaused)
    assert second.sequence == first.sequence + 1
    fake.emit(room_resumed={"user": "anna"})
    third = next(room.events(timeout=10))
    assert isinstance(third, urto.RoomResumed)
    assert list(room.events(timeout=0)) == []


def test_lost_events_are_recovered(room: urto.Room, fake: FakeRoom) -> None:
    events = room.events(timeout=10)
    next(events)
    fake.lose_events = True
    fake.emit(room_paused={"user": "lost"})
    fake.emit(room_resumed={"user": "lost"})
    fake.lose_events = False
    fake.emit(room_paused={"user": "seen"})
    users = [event.user for event in itertools.islice(events, 3)]  # type: ignore[union-attr]
    assert users == ["lost", "lost", "seen"]


def test_a_lost_last_event_is_recovered_though_nothing_follows(room: urto.Room, fake: FakeRoom) -> None:
    events = room.events(timeout=10)
    next(events)
    fake.lose_events = True
    fake.emit(room_paused={"user": "lost"})
    event = next(events)
    assert isinstance(event, urto.RoomPaused)


def test_events_that_the_room_forgot_are_a_gap_that_is_told_once(room: urto.Room, fake: FakeRoom) -> None:
    events = room.events(timeout=10)
    joined = next(events)
    fake.lose_events = True
    for index in range(EVENTS_KEPT + 4):
        fake.emit(room_paused={"user": f"{index}"})
    fake.lose_events = False
    fake.emit(room_paused={"user": "last"})
    with pytest.raises(urto.EventGap) as caught:
        next(events)
    # 21 were emitted and 16 are kept: five are gone.
    assert (caught.value.first, caught.value.last) == (joined.sequence + 1, joined.sequence + 5)
    rest = list(itertools.islice(events, EVENTS_KEPT))
    assert [event.sequence for event in rest] == list(range(joined.sequence + 6, joined.sequence + 6 + EVENTS_KEPT))


def test_events_since_a_number(room: urto.Room, fake: FakeRoom) -> None:
    first = fake.emit(room_paused={"user": "a"})
    fake.emit(room_resumed={"user": "b"})
    again = [event.sequence for event in itertools.islice(room.events(since=first, timeout=10), 2)]
    assert again == [first, first + 1]


def test_questions(room: urto.Room) -> None:
    ball = room.spawn(urto.Circle(radius=1, position=(1, 2), name="ball", tags=("a", "b"), color=0x102030))
    for hits in (
        room.query_point((1, 2)),
        room.query_region((0, 0), (3, 3)),
        room.query_ray((0, 0), (3, 3)),
        room.query_nearest((0, 0), distance_max=9),
    ):
        assert [(hit.body, hit.point) for hit in hits] == [(ball, (1, 2))]
    contacts = room.contacts()
    assert (contacts.body_a.tolist(), contacts.body_b.tolist()) == ([1], [2])
    assert contacts.point.tolist() == [[0.5, 1.5]]
    assert contacts.normal.tolist() == [[0, 1]]
    assert contacts.separation.tolist() == [-0.25]
    assert room.energy() == 7
    assert room.state_hash() == 1
    assert room.body("ball") == ball
    info = ball.info()
    assert (info.id, info.name, info.position, info.body.tags, info.body.color) == (
        1, "ball", (1, 2), ("a", "b"), 0x102030,
    )  # fmt: skip
    assert room.state(saved_state=True).saved_state == b"saved"


def test_a_hit_is_an_event(room: urto.Room, fake: FakeRoom) -> None:
    vector = scene_pb2.Vector
    hit = snapshot_pb2.ContactHit(body_a=1, body_b=2, point=vector(x=3, y=4), normal=vector(y=-1), approach_speed=5)
    sequence = fake.emit(contact_hit=hit)
    event = next(event for event in room.events(timeout=10) if isinstance(event, urto.ContactHit))
    assert event == urto.ContactHit(
        sequence=sequence, tick=0, body_a=1, body_b=2, point=(3, 4), normal=(0, -1), approach_speed=5
    )


def test_queries_with_a_shape(room: urto.Room, fake: FakeRoom) -> None:
    first, second = room.spawn([urto.Circle(radius=1, position=(1, 2)), urto.Circle(radius=1, position=(4, 2))])
    box = urto.Box(width=2, height=1, position=(3, 4), angle=0.5)
    hits = room.query_cast(box, (0, -5), category=2, mask=0xFFFFFFFF)
    assert [(hit.body, hit.point, hit.fraction) for hit in hits] == [(first, (1, 2), 0.5), (second, (4, 2), 0.5)]
    assert not hits.truncated
    cast = fake.batches[-1].commands[0].query.cast
    assert (cast.shape.box.width, cast.shape.box.height, cast.shape.box.center.x, cast.shape.box.angle) == (2, 1, 0, 0)
    assert (cast.shape.position.x, cast.shape.position.y, cast.shape.angle) == (3, 4, 0.5)
    assert (cast.translation.x, cast.translation.y, cast.count_max) == (0, -5, 0)
    assert (cast.filter.category, cast.filter.mask) == (2, 0xFFFFFFFF)
    hits = room.query_overlap((7, 8), count_max=1)
    assert ([hit.body for hit in hits], hits.truncated) == ([first], True)
    overlap = fake.batches[-1].commands[0].query.overlap
    assert (overlap.shape.WhichOneof("geometry"), overlap.shape.position.y, overlap.count_max) == ("point", 8, 1)
    assert not overlap.HasField("filter")
    hits = room.query_closest(urto.Capsule(a=(0, 0), b=(1, 0), radius=0.5, position=(5, 6)), distance_max=3, mask=4)
    assert [(hit.distance, hit.query_point) for hit in hits] == [(-0.25, (5, 6))] * 2
    closest = fake.batches[-1].commands[0].query.closest
    assert (closest.shape.capsule.b.x, closest.shape.capsule.radius, closest.distance_max) == (1, 0.5, 3)
    assert (closest.filter.HasField("category"), closest.filter.mask) == (False, 4)
    triangle = urto.Polygon(vertices=[(0, 0), (1, 0), (0, 1)], radius=0.1)
    room.query_overlap(triangle)
    assert len(fake.batches[-1].commands[0].query.overlap.shape.polygon.vertices) == 3


@pytest.mark.parametrize(
    "ask",
    [
        lambda room: room.query_overlap(urto.Chain(vertices=[(0, 0), (1, 0)])),
        lambda room: room.query_overlap(urto.Body(shapes=[urto.Circle(radius=1)])),
        lambda room: room.query_overlap(urto.Circle(radius=1, mask=2)),
        lambda room: room.query_overlap("here"),
        lambda room: room.query_overlap((0, 0), mask=-1),
        lambda room: room.query_overlap((0, 0), count_max=0),
        lambda room: room.query_overlap((0, 0), count_max=1.5),
        lambda room: room.query_cast((0, 0), 3),
        lambda room: room.query_closest((0, 0), distance_max="far"),
    ],
)
def test_a_query_that_makes_no_sense_is_not_sent(room: urto.Room, fake: FakeRoom, ask: Any) -> None:
    with pytest.raises(urto.InvalidArgument):
        ask(room)
    assert not fake.batches


def test_a_query_that_the_room_refuses_is_raised(room: urto.Room) -> None:
    with pytest.raises(urto.InvalidValue) as refused:
        room.query_closest((0, 0), distance_max=-1)
    assert refused.value.field == "query.closest.distance_max"


def test_pause_resume_reset_and_time_scale(room: urto.Room, fake: FakeRoom) -> None:
    room.spawn(urto.Circle(radius=1))
    room.step(5)
    assert room.resume() == 5
    assert not fake.paused
    assert room.pause() == 5
    assert fake.paused
    room.set_time_scale(2)
    assert fake.time_scale == 2
    assert room.reset() == 2
    assert len(room.frame()) == 0
    assert room.frame().tick == 0


def test_a_program_that_forgets_to_close_ends(fake: FakeRoom) -> None:
    script = f"import urto; room = urto.connect({fake.endpoint!r}); room.frames(); print(room.name)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "demo\n", "")


def test_reading_many_waiting_events_leaves_no_waiters_behind(room: urto.Room) -> None:
    room._core.event_log.add(snapshot_pb2.EventBatch(first_sequence=1, events=[snapshot_pb2.Event()] * 5000))
    assert len(list(itertools.islice(room.events(since=1, timeout=0), 5000))) == 5000
    assert room._core.signal._waiters == []
