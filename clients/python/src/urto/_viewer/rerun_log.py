"""Turns frames into Rerun archetypes.

A room is flat, and Rerun's plain 2D boxes cannot rotate; so the shapes are logged as thin 3D ones, one entity for all
of a kind, and looked at through a pinhole camera far away: focal length 1000 at 1000 m, so that one pixel is one metre.
Overlays are 2D, in pixels of that camera: x − left, top − y.

    room/camera            the pinhole; below it the overlays velocities, contacts, normals, hits,
                           feelers (the ways of cast discs), felt (the discs that were stopped), nearest
    room/<layer>/boxes     layer: static, bodies, sensors
    room/<layer>/edges     the outlines of the boxes
    room/<layer>/discs
    room/<layer>/spokes    a radius of every disc, which shows how it is turned
    room/<layer>/polygons  also capsules and what is rounded
    room/<layer>/lines     chains
    room/camera/joints     lines between the anchors of joints, points where these meet
    plots/…                what the tick cost and held
    events                 a text log
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import rerun as rr
import rerun.blueprint as rrb

from urto._describe import describe
from urto._events import ContactBegin, ContactEnd, ContactHit, Event, EventsDropped
from urto._frame import Contacts, Frame
from urto._info import RoomInfo
from urto._viewer.feelers import Felt
from urto._viewer.hits import RecentHits
from urto._viewer.palette import BACKGROUND, CONTACT, FEELER, HIT, JOINT, VELOCITY, darker
from urto._viewer.shapes import LAYERS, Layer, ShapeSet

CAMERA = "room/camera"
CAMERA_DISTANCE = 1000.0
"""m; so far that the depth of the shapes does not show."""

DEPTH = 0.01
"""m, thickness of a shape towards the camera."""

LINE_DEPTH = 0.2
"""m, how far before the shapes their edges and spokes are: enough for the depth buffer, and at CAMERA_DISTANCE a shift
of 0.02 %."""

SPOKE_WIDTH = 0.05
"""Of the radius."""

VELOCITY_SECONDS = 0.25
"""Arrows of velocity reach where the body would be after that long."""

NORMAL_LENGTH = 0.012
"""Of the view's width."""

JOINT_GAP = 0.02
"""m: anchors nearer to each other than this are one point."""

CONTACT_EVENTS_MAX = 20
"""Lines in the event log per frame that are about contacts; the rest is counted in one line."""

EDGES_MAX = 4000
"""Boxes of a layer up to which each gets an edge line; more are too small on a screen to need one."""

_SOLID = rr.components.FillMode.Solid
_WIRE = rr.components.FillMode.MajorWireframe
_PLOTS: dict[str, tuple[tuple[str, str, tuple[int, int, int]], ...]] = {
    "energy": (
        ("kinetic", "kinetic, J", (246, 144, 61)),
        ("potential", "potential, J", (91, 143, 249)),
        ("total", "total, J", (235, 240, 250)),
    ),
    "contacts": (("count", "touching pairs", (97, 221, 170)), ("awake", "awake bodies", (246, 189, 22))),
    "step": (("ms", "step, ms", (120, 211, 248)),),
    "penetration": (("mm", "deepest, mm", (240, 110, 130)),),
    "members": (("count", "members", (142, 128, 250)),),
}

Bounds = tuple[float, float, float, float]


class RerunLog:
    """Logs one room to a recording stream."""

    def __init__(self, stream: rr.RecordingStream, bounds: Bounds, velocities: bool, contacts: bool) -> None:
        self._stream = stream
        self._left, self._lower, self._right, self._upper = bounds
        self._velocities = velocities
        self._contacts = contacts
        self._had_joints = False  # what has been logged once has to be cleared
        self._had_hits = False
        self._log_camera()
        for plot, lines in _PLOTS.items():
            for name, label, color in lines:
                stream.log(f"plots/{plot}/{name}", rr.SeriesLines(names=label, colors=color, widths=1.5), static=True)

    def _log_camera(self) -> None:
        width, height = self._right - self._left, self._upper - self._lower
        self._stream.log(
            CAMERA,
            rr.Pinhole(
                focal_length=CAMERA_DISTANCE, width=width, height=height, camera_xyz=rr.ViewCoordinates.RUB,
                image_plane_distance=CAMERA_DISTANCE,
            ),
            rr.Transform3D(translation=[self._left + width / 2, self._lower + height / 2, CAMERA_DISTANCE]),
            static=True,
        )  # fmt: skip

    def blueprint(self, info: RoomInfo) -> rrb.Blueprint:
        """The room at the left, plots and events at the right."""
        plots = [
            rrb.TimeSeriesView(origin=f"plots/{plot}", name=plot, plot_legend=rrb.PlotLegend(visible=len(lines) > 1))
            for plot, lines in _PLOTS.items()
        ]
        room = rrb.Spatial2DView(
            origin=CAMERA,
            contents=["/room/**"],
            name=f"{info.room} · {info.scene}" if info.scene else info.room,
            visual_bounds=rrb.VisualBounds2D(
                x_range=[0, self._right - self._left], y_range=[0, self._upper - self._lower]
            ),
            background=list(BACKGROUND),
        )
        events = rrb.TextLogView(origin="events", name="events")
        return rrb.Blueprint(
            rrb.Horizontal(
                room,
                rrb.Vertical(rrb.Tabs(*plots[1:], active_tab=0), plots[0], events, row_shares=[1, 1, 1]),
                column_shares=[3, 1],
            ),
            rrb.TimePanel(state="collapsed", timeline="sim_time"),
            rrb.BlueprintPanel(state="hidden"),
            rrb.SelectionPanel(state="hidden"),
        )

    def set_time(self, frame: Frame) -> None:
        """What is logged next belongs to this frame's moment."""
        self._stream.set_time("tick", sequence=frame.tick)
        self._stream.set_time("sim_time", duration=frame.sim_time)

    def log_layout(self, shapes: ShapeSet) -> None:
        """Sizes, colours and ids: when the set of bodies has changed, so that scrubbing back shows the right set."""
        ids = shapes.poses.ids
        for name in LAYERS:
            layer = shapes.layers[name]
            self._log_layer_layout(f"room/{name}", layer, ids, _WIRE if name == "sensors" else _SOLID)
        self._log_poses(shapes, LAYERS)
        self._log_joints(shapes)

    def log_poses(self, shapes: ShapeSet) -> None:
        """Where the moving shapes are."""
        self._log_poses(shapes, ("bodies", "sensors"))
        self._log_joints(shapes)
        if self._velocities:
            moving = np.hypot(shapes.poses.velocity[:, 0], shapes.poses.velocity[:, 1]) > 1e-3
            velocity = shapes.poses.velocity[moving] * VELOCITY_SECONDS * [1.0, -1.0]
            self._stream.log(
                f"{CAMERA}/velocities",
                rr.Arrows2D(
                    origins=self._to_pixels(shapes.poses.position[moving]), vectors=velocity, colors=[VELOCITY],
                    radii=rr.Radius.ui_points(1.0), draw_order=40,
                ),
            )

    def _log_joints(self, shapes: ShapeSet) -> None:
        """A line between the anchors of each joint; where they meet, a point."""
        if not len(shapes.joints) and not self._had_joints:
            return
        self._had_joints = True
        lines = shapes.joint_ends()
        apart = np.hypot(*(lines[:, 1] - lines[:, 0]).T) > JOINT_GAP
        self._stream.log(
            f"{CAMERA}/joints/lines",
            rr.LineStrips2D(
                [self._to_pixels(line) for line in lines[apart]], colors=[JOINT], radii=rr.Radius.ui_points(1.0),
                draw_order=35,
            ),
        )  # fmt: skip
        self._stream.log(
            f"{CAMERA}/joints/points",
            rr.Points2D(
                self._to_pixels(lines[~apart, 1]), colors=[JOINT], radii=rr.Radius.ui_points(2.0), draw_order=36
            ),
        )

    def log_contacts(self, contacts: Contacts) -> None:
        points = self._to_pixels(contacts.point)
        length = NORMAL_LENGTH * (self._right - self._left)
        self._stream.log(
            f"{CAMERA}/contacts", rr.Points2D(points, colors=[CONTACT], radii=rr.Radius.ui_points(2.0), draw_order=50)
        )
        self._stream.log(
            f"{CAMERA}/normals",
            rr.Arrows2D(
                origins=points, vectors=np.asarray(contacts.normal) * [length, -length], colors=[CONTACT],
                radii=rr.Radius.ui_points(0.7), draw_order=50,
            ),
        )  # fmt: skip

    def log_felt(self, felt: Felt) -> None:
        """Where discs come to from a body, and its nearest neighbour."""
        ends = self._to_pixels(felt.ends)
        (origin,) = self._to_pixels(np.array([felt.origin]))
        nearest = [] if felt.nearest is None else [self._to_pixels(felt.nearest)]
        log, thin = self._stream.log, rr.Radius.ui_points(0.7)
        ways = [[origin, end] for end in ends]
        log(f"{CAMERA}/feelers", rr.LineStrips2D(ways, colors=[FEELER], radii=thin, draw_order=30))
        log(f"{CAMERA}/felt", rr.Points2D(ends[felt.met], colors=[FEELER], radii=felt.radius, draw_order=31))
        log(
            f"{CAMERA}/nearest",
            rr.LineStrips2D(nearest, colors=[HIT], radii=rr.Radius.ui_points(2.0), draw_order=32),
        )

    def log_hits(self, hits: RecentHits) -> None:
        """A disc for each, for a while."""
        if not len(hits) and not self._had_hits:
            return
        self._had_hits = len(hits) > 0
        self._stream.log(
            f"{CAMERA}/hits",
            rr.Points2D(
                self._to_pixels(hits.points), colors=[HIT], radii=hits.radii(self._right - self._left), draw_order=60
            ),
        )

    def log_plots(self, frame: Frame) -> None:
        held = frame.statistics
        total = held.kinetic_energy + held.potential_energy
        for path, value in (
            ("energy/kinetic", held.kinetic_energy),
            ("energy/potential", held.potential_energy),
            ("energy/total", total),
            ("contacts/count", float(held.contact_count)),
            ("contacts/awake", float(held.awake_count)),
            ("step/ms", held.step_ms),
            ("penetration/mm", held.penetration_max * 1000),
            ("members/count", float(held.member_count)),
        ):
            self._stream.log(f"plots/{path}", rr.Scalars(value))

    def log_events(self, events: list[Event]) -> None:
        lines = 0
        left_out = 0
        for event in events:
            if isinstance(event, ContactBegin | ContactEnd | ContactHit):
                if not self._contacts:
                    continue
                if lines == CONTACT_EVENTS_MAX:
                    left_out += 1
                    continue
                lines += 1
                self.log_text(describe(event), rr.TextLogLevel.DEBUG)
            else:
                level = rr.TextLogLevel.WARN if isinstance(event, EventsDropped) else rr.TextLogLevel.INFO
                self.log_text(describe(event), level)
        if left_out:
            self.log_text(f"and {left_out} more contacts", rr.TextLogLevel.DEBUG)

    def log_text(self, text: str, level: rr.components.TextLogLevel | str = "INFO") -> None:
        self._stream.log("events", rr.TextLog(text, level=level))

    def _log_layer_layout(
        self, path: str, layer: Layer, ids: npt.NDArray[np.uint64], fill: rr.components.FillMode
    ) -> None:
        log = self._stream.log

        def log_ids(entity: str, rows: npt.NDArray[np.int64]) -> None:
            if len(rows):
                log(entity, rr.AnyValues(body_id=ids[rows]))

        boxes, discs, polygons = layer.boxes, layer.discs, layer.polygons
        half = np.column_stack([boxes.half_size, np.full(len(boxes.rows), DEPTH / 2)])
        log(f"{path}/boxes", rr.Boxes3D.from_fields(half_sizes=half, colors=boxes.color, fill_mode=fill))
        log_ids(f"{path}/boxes", boxes.rows)
        if _has_edges(layer):
            edge_color = [darker((r, g, b), 0.5) for r, g, b in boxes.color.tolist()]
            edges = rr.Boxes3D.from_fields(
                half_sizes=half, colors=edge_color, fill_mode=_WIRE, radii=rr.Radius.ui_points(0.7)
            )
            log(f"{path}/edges", edges)
        else:
            log(f"{path}/edges", rr.Boxes3D.from_fields(half_sizes=[]))
        # A flat ellipsoid is rounder than Rerun's cylinder.
        flat = np.column_stack([discs.radius, discs.radius, np.full(len(discs.rows), DEPTH / 2)])
        log(f"{path}/discs", rr.Ellipsoids3D.from_fields(half_sizes=flat, colors=discs.color, fill_mode=fill))
        log_ids(f"{path}/discs", discs.rows)
        spoke = np.column_stack([discs.radius * 0.46, discs.radius * SPOKE_WIDTH / 2, np.full(len(discs.rows), DEPTH)])
        spoke_color = [darker((r, g, b), 0.35) for r, g, b in discs.color.tolist()]
        log(f"{path}/spokes", rr.Boxes3D.from_fields(half_sizes=spoke, colors=spoke_color, fill_mode=_SOLID))
        mesh = rr.Mesh3D.from_fields(triangle_indices=polygons.triangle, vertex_colors=polygons.color)
        if len(polygons.rows) == 0:  # without vertices nothing of an earlier layout is left
            mesh = rr.Mesh3D.from_fields(vertex_positions=[], triangle_indices=[], vertex_colors=[])
        log(f"{path}/polygons", mesh)
        log_ids(f"{path}/polygons", polygons.rows)
        firsts = layer.lines.start[:-1]
        log(
            f"{path}/lines",
            rr.LineStrips3D.from_fields(
                strips=[] if not firsts else None, colors=layer.lines.color[firsts], radii=rr.Radius.ui_points(1.5)
            ),
        )
        log_ids(f"{path}/lines", layer.lines.rows[firsts])

    def _log_poses(self, shapes: ShapeSet, layers: tuple[str, ...]) -> None:
        poses = shapes.poses
        log = self._stream.log
        for name in layers:
            layer = shapes.layers[name]
            boxes, discs, polygons = layer.boxes, layer.discs, layer.polygons
            if len(boxes.rows):
                centers = _lift(poses.to_world(boxes.rows, boxes.center), 0.0)
                turned = _quaternions(poses.angle[boxes.rows] + boxes.angle)
                log(f"room/{name}/boxes", rr.Boxes3D.from_fields(centers=centers, quaternions=turned))
                if _has_edges(layer):
                    centers[:, 2] = LINE_DEPTH
                    log(f"room/{name}/edges", rr.Boxes3D.from_fields(centers=centers, quaternions=turned))
            if len(discs.rows):
                middle = poses.to_world(discs.rows, discs.center)
                angle = poses.angle[discs.rows]
                log(f"room/{name}/discs", rr.Ellipsoids3D.from_fields(centers=_lift(middle, 0.0)))
                along = np.stack([np.cos(angle), np.sin(angle)], 1) * (discs.radius * 0.46)[:, None]
                log(
                    f"room/{name}/spokes",
                    rr.Boxes3D.from_fields(
                        centers=_lift(middle + along, LINE_DEPTH), quaternions=_quaternions(angle)
                    ),
                )
            if len(polygons.rows):
                vertices = _lift(poses.to_world(polygons.rows, polygons.vertex), 0.0)
                log(f"room/{name}/polygons", rr.Mesh3D.from_fields(vertex_positions=vertices))
            if len(layer.lines.rows):
                points = _lift(poses.to_world(layer.lines.rows, layer.lines.vertex), 0.0)
                strips = [points[a:b] for a, b in zip(layer.lines.start, layer.lines.start[1:], strict=False)]
                log(f"room/{name}/lines", rr.LineStrips3D.from_fields(strips=strips))

    def _to_pixels(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        points = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        return np.column_stack([points[:, 0] - self._left, self._upper - points[:, 1]])


def _has_edges(layer: Layer) -> bool:
    return 0 < len(layer.boxes.rows) <= EDGES_MAX


def _lift(points: npt.NDArray[np.float64], z: float) -> npt.NDArray[np.float32]:
    return np.column_stack([points, np.full(len(points), z)]).astype(np.float32)


def _quaternions(angle: npt.NDArray[np.float64]) -> npt.NDArray[np.float32]:
    """(n, 4) as x, y, z, w: turns about the z axis."""
    zero = np.zeros_like(angle)
    return np.stack([zero, zero, np.sin(angle / 2), np.cos(angle / 2)], 1).astype(np.float32)
