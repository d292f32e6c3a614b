"""The viewer's colours."""

from __future__ import annotations

from typing import TypeAlias

from urto._bodies import BodyInfo

Color: TypeAlias = tuple[int, int, int]

BACKGROUND: Color = (17, 20, 28)
GRID: Color = (30, 35, 46)
TEXT: Color = (150, 160, 178)
STATIC: Color = (84, 93, 110)
KINEMATIC: Color = (142, 124, 172)
VELOCITY: Color = (235, 240, 250)
JOINT: Color = (250, 240, 170)
CONTACT: Color = (255, 84, 104)
HIT: Color = (255, 214, 92)
FEELER: Color = (120, 235, 200)

# Light enough for a dark background, neighbours far apart in hue so that bodies that touch can be told apart.
_BODIES: tuple[Color, ...] = (
    (91, 143, 249), (246, 189, 22), (97, 221, 170), (240, 110, 130), (120, 211, 248), (246, 144, 61), (142, 128, 250),
    (152, 208, 92), (240, 139, 200), (64, 178, 178), (225, 170, 120),
)  # fmt: skip


def body_color(info: BodyInfo) -> Color:
    """The colour that the body was given, else one by its type and id: the same in every viewer."""
    color = info.body.color
    if color is not None:
        return (color >> 16) & 255, (color >> 8) & 255, color & 255
    if info.body.type == "static":
        return STATIC
    if info.body.type == "kinematic":
        return KINEMATIC
    return _BODIES[(info.id & 0xFFFFFFFF) % len(_BODIES)]


def darker(color: Color, factor: float) -> Color:
    """`color` with its brightness times `factor`."""
    red, green, blue = (min(255, round(part * factor)) for part in color)
    return red, green, blue
