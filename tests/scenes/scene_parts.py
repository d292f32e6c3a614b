"""What scene files are made of: the text format, bodies, shapes, joints, colours. generate.py puts them together."""

from __future__ import annotations

from typing import Any

LINE_WIDTH = 110

# Colours: a dark slate for what never moves, and warm and cool tones that stand beside each other on dark and on light.
SLATE = 0x4B5563
STEEL = 0x6B7A8F
TEAL = 0x2A9D8F
SEA = 0x3A86A8
NAVY = 0x355070
SAND = 0xE9C46A
AMBER = 0xF4A261
CORAL = 0xE76F51
ROSE = 0xB56576
CREAM = 0xF1E3C8
OLIVE = 0x8AB17D
PALETTE = (TEAL, SAND, CORAL, SEA, AMBER, OLIVE, ROSE, CREAM)


class Enum(str):
    """A name that is written without quotes."""


class Color(int):
    """0xRRGGBB, written in hexadecimal."""


Message = dict[str, Any]


def number(value: float) -> str:
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def scalar(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Enum):
        return str(value)
    if isinstance(value, Color):
        return f"0x{value:06X}"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return number(value)
    escaped = str(value).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def fields(message: Message) -> list[tuple[str, Any]]:
    pairs: list[tuple[str, Any]] = []
    for key, value in message.items():
        pairs.extend((key, each) for each in (value if isinstance(value, list) else [value]))
    return pairs


def inline(message: Message) -> str:
    parts = [
        f"{key} {{ {inline(value)} }}" if isinstance(value, dict) else f"{key}: {scalar(value)}"
        for key, value in fields(message)
    ]
    return " ".join(parts)


def lines(message: Message, indent: str = "") -> list[str]:
    """The message in text format: a nested message on one line where it fits, else a line per field."""
    out: list[str] = []
    for key, value in fields(message):
        if not isinstance(value, dict):
            out.append(f"{indent}{key}: {scalar(value)}")
            continue
        line = f"{indent}{key} {{ {inline(value)} }}"
        if len(line) <= LINE_WIDTH and not (key == "bodies" and len(line) > LINE_WIDTH // 2):
            out.append(line)
        else:
            out.extend([f"{indent}{key} {{", *lines(value, indent + "  "), f"{indent}}}"])
    return out


def vector(x: float, y: float) -> Message:
    return {"x": float(x), "y": float(y)}


def box(
    width: float, height: float, center: tuple[float, float] | None = None, angle: float = 0.0, **material: Any
) -> Message:
    geometry: Message = {"width": float(width), "height": float(height)}
    if center is not None:
        geometry["center"] = vector(*center)
    if angle:
        geometry["angle"] = float(angle)
    return {"box": geometry, **material}


def circle(radius: float, center: tuple[float, float] | None = None, **material: Any) -> Message:
    geometry: Message = {"radius": float(radius)}
    if center is not None:
        geometry["center"] = vector(*center)
    return {"circle": geometry, **material}


def polygon(vertices: list[tuple[float, float]], **material: Any) -> Message:
    return {"polygon": {"vertices": [vector(x, y) for x, y in vertices]}, **material}


def capsule(a: tuple[float, float], b: tuple[float, float], radius: float, **material: Any) -> Message:
    return {"capsule": {"a": vector(*a), "b": vector(*b), "radius": float(radius)}, **material}


def chain(vertices: list[tuple[float, float]], loop: bool = False, **material: Any) -> Message:
    geometry: Message = {"vertices": [vector(x, y) for x, y in vertices]}
    if loop:
        geometry["loop"] = True
    return {"chain": geometry, **material}


def body(
    shapes: Message | list[Message],
    x: float,
    y: float,
    *,
    name: str = "",
    kind: str = "",
    color: int | None = None,
    angle: float = 0.0,
    velocity: tuple[float, float] | None = None,
    tags: tuple[str, ...] = (),
    **more: Any,
) -> Message:
    out: Message = {}
    if name:
        out["name"] = name
    if tags:
        out["tags"] = list(tags)
    if kind:
        out["type"] = Enum(f"BODY_TYPE_{kind}")
    out["position"] = vector(x, y)
    if angle:
        out["angle"] = float(angle)
    if velocity is not None:
        out["velocity"] = vector(*velocity)
    out.update(more)
    out["shapes"] = shapes if isinstance(shapes, list) else [shapes]
    if color is not None:
        out["color"] = Color(color)
    return out


def scene(
    name: str,
    description: str,
    view: tuple[float, float, float, float],
    bodies: list[Message],
    world: Message | None = None,
    force_fields: list[Message] | None = None,
    joints: list[Message] | None = None,
) -> Message:
    out: Message = {"name": name, "description": description}
    if world:
        out["world"] = world
    out["view"] = {"lower": vector(*view[:2]), "upper": vector(*view[2:])}
    if force_fields:
        out["fields"] = force_fields
    out["bodies"] = bodies
    if joints:
        out["joints"] = joints
    return out


def joint(
    kind: str,
    a: str,
    b: str,
    at_a: tuple[float, float] = (0, 0),
    at_b: tuple[float, float] = (0, 0),
    *,
    name: str = "",
    geometry: Message | None = None,
    **more: Any,
) -> Message:
    """A joint of two bodies by their names; the anchors are in the bodies' frames."""
    out: Message = {"name": name} if name else {}
    out.update({"body_a": {"name": a}, "body_b": {"name": b}, "anchor_a": vector(*at_a), "anchor_b": vector(*at_b)})
    out[kind] = geometry or {}
    out.update(more)
    return out


def ground(width: float, x: float = 0.0, **material: Any) -> Message:
    """A static floor of that width whose top is y = 0."""
    return body(box(width, 1, **material), x, -0.5, name="ground", kind="STATIC", color=SLATE)


def frame(width: float, height: float, thickness: float = 0.5, **material: Any) -> list[Message]:
    """Four static walls around the inside (-width/2, 0) to (width/2, height)."""
    side = (width + thickness) / 2
    flat, upright = box(width + 2 * thickness, thickness, **material), box(thickness, height, **material)
    return [
        body(flat, 0, -thickness / 2, name="floor", kind="STATIC", color=SLATE),
        body(flat, 0, height + thickness / 2, name="ceiling", kind="STATIC", color=SLATE),
        body(upright, -side, height / 2, name="wall_left", kind="STATIC", color=SLATE),
        body(upright, side, height / 2, name="wall_right", kind="STATIC", color=SLATE),
    ]


def blend(low: int, high: int, t: float) -> int:
    """The colour at t in [0, 1] between two."""
    channels = [round(((low >> s) & 255) * (1 - t) + ((high >> s) & 255) * t) for s in (16, 8, 0)]
    return channels[0] << 16 | channels[1] << 8 | channels[2]


def gradient(stops: tuple[int, ...], t: float) -> int:
    place = min(max(t, 0.0), 1.0) * (len(stops) - 1)
    index = min(int(place), len(stops) - 2)
    return blend(stops[index], stops[index + 1], place - index)
