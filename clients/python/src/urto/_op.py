"""Operations that wait without knowing how.

Every operation of the core is a generator: it yields what it waits for and is sent the result. The sync face blocks
on that (`run`), the asyncio face awaits it (`run_async`); the logic is there once.
"""

from __future__ import annotations

import asyncio
from collections.abc import Generator
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Wait:
    """For a future, at most `timeout` s (None: it ends by itself); then TimeoutError is thrown in."""

    future: Future[Any]
    timeout: float | None = None


Op: TypeAlias = Generator[Wait, Any, T]


def run(op: Op[T]) -> T:
    """Runs `op` on this thread, blocking where it waits."""
    try:
        wait = next(op)
        while True:
            try:
                value = wait.future.result(wait.timeout)
            except BaseException as error:  # also KeyboardInterrupt: the operation may have to clean up
                wait.future.cancel()  # nobody waits for it any more
                wait = op.throw(error)
            else:
                wait = op.send(value)
    except StopIteration as end:
        result: T = end.value
        return result


async def run_async(op: Op[T]) -> T:
    """Runs `op` in this event loop, awaiting where it waits."""
    try:
        wait = next(op)
        while True:
            try:
                value = await asyncio.wait_for(asyncio.wrap_future(wait.future), wait.timeout)
            except BaseException as error:  # also cancellation
                wait = op.throw(error)
            else:
                wait = op.send(value)
    except StopIteration as end:
        result: T = end.value
        return result
