"""What has been measured is noted on disk, so that a report that was stopped goes on where it was."""

from __future__ import annotations

import copy
import hashlib
import json
import threading
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

Record = dict[str, Any]

# A report that goes on has its times from one machine in one state: what is older than this is measured anew.
KEPT_HOURS = 12


class Notes:
    """What programs printed, by what was run: a program's content (not its name or date) and its arguments."""

    def __init__(self, path: Path, programs: Mapping[str, Path]) -> None:
        self._path = path
        self._programs = {
            engine: hashlib.sha256(program.read_bytes()).hexdigest()[:16] for engine, program in programs.items()
        }
        self._lock = threading.Lock()
        self._known: dict[tuple[str, ...], Record] = {}
        self.used_since = time.time()  # when the oldest note that was asked for was taken
        oldest = time.time() - 3600 * KEPT_HOURS
        for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
            try:
                note = json.loads(line)
            except json.JSONDecodeError:
                continue  # it was being written when the report was stopped
            if note["at"] > oldest:
                self._known[tuple(note["key"])] = note

    def _key(self, engine: str, arguments: Sequence[str]) -> tuple[str, ...]:
        return engine, self._programs[engine], *arguments

    def get(self, engine: str, arguments: Sequence[str]) -> list[Record] | None:
        note = self._known.get(self._key(engine, arguments))
        if note is None:
            return None
        self.used_since = min(self.used_since, note["at"])
        return copy.deepcopy(note["lines"])

    def add(self, engine: str, arguments: Sequence[str], lines: Sequence[Record]) -> None:
        """May be called from several threads."""
        note = {"at": time.time(), "key": self._key(engine, arguments), "lines": copy.deepcopy(list(lines))}
        with self._lock:
            self._known[note["key"]] = note
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(note) + "\n")

    def forget(self) -> None:
        self._known.clear()
        self._path.unlink(missing_ok=True)
