"""Two official Zenoh sessions that know only the schema and the documented keys: one acts, the other watches.

usage: raw_session.py ENDPOINT ROOM, with the modules that protoc made of the schema on the path. Prints JSON.
"""

import json
import queue
import sys

import zenoh
from urto.v1 import command_pb2, snapshot_pb2

TIMEOUT_S = 30.0
SNAPSHOTS = 20


def open_session(endpoint: str) -> zenoh.Session:
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    return zenoh.open(config)


def ask(session: zenoh.Session, key: str, batch: command_pb2.CommandBatch) -> command_pb2.CommandReply:
    for reply in session.get(key, payload=batch.SerializeToString(), timeout=TIMEOUT_S):
        return command_pb2.CommandReply.FromString(reply.ok.payload.to_bytes())
    raise TimeoutError(key)


def main(endpoint: str, room: str) -> None:
    key = f"urto/v1/{room}"
    with open_session(endpoint) as actor, open_session(endpoint) as watcher:
        snapshots: queue.Queue[bytes] = queue.Queue()
        watcher.declare_subscriber(f"{key}/snapshot", lambda sample: snapshots.put(sample.payload.to_bytes()))

        spawn = command_pb2.CommandBatch(sequence=1)
        body = spawn.commands.add().spawn.body
        body.position.x, body.position.y, body.mass = 1.0, 5.0, 2.0
        box = body.shapes.add().box
        box.width, box.height = 1.0, 1.0
        spawned = ask(actor, f"{key}/cmd/actor", spawn)

        push = command_pb2.CommandBatch(sequence=2)
        impulse = push.commands.add().impulse
        impulse.body.id = spawned.results[0].id
        impulse.impulse.x, impulse.impulse.y = 6.0, -3.0
        pushed = ask(actor, f"{key}/cmd/actor", push)

        seen = []
        while len(seen) < SNAPSHOTS:
            snapshot = snapshot_pb2.Snapshot.FromString(snapshots.get(timeout=TIMEOUT_S))
            if snapshot.tick > pushed.tick:
                row = list(snapshot.id).index(spawned.results[0].id)
                seen.append([snapshot.tick, snapshot.sim_time, snapshot.x_double[row], snapshot.y_double[row]])
    print(json.dumps({"sequences": [spawned.sequence, pushed.sequence], "pushed": pushed.tick, "seen": seen}))


main(*sys.argv[1:])
