"""Events as lines for people."""

from __future__ import annotations

from urto._events import Event


def describe(event: Event) -> str:
    """One line for people."""
    shown = {name: value for name, value in vars(event).items() if name not in ("sequence", "tick", "body", "layout")}
    pairs = ", ".join(f"{name} {_word(value)}" for name, value in shown.items())
    name = getattr(getattr(event, "body", None), "name", "")
    return f"{type(event).__name__}: {pairs}{f', name {name}' if name else ''}".removesuffix(": ")


def _word(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, tuple):
        return "(" + ", ".join(_word(part) for part in value) + ")"
    return str(value)
