"""Views of a scene for people: the viewer's, from above, and around its main bodies."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import length, product
from ..errors import BadSetting, UnknownName
from ..model.parts import Part
from ..scene.mounts import camera_axes
from ..scene.object import TERRAIN
from ..scene.sim_params import ViewerCameraSpec
from .simulation import Simulation

Size = tuple[int, int]
FIELD = math.radians(50.0)
"""Vertical field of view of the views that are made up here [rad]."""
FILLED = 0.8
"""What matters fills so much of an image, in width or height [1]."""
NEARBY = 6.0
"""Objects within so many metres of the vehicles' middle matter, too, or 3 times their size [m]."""
COMPANY = 30.0
"""A vehicle farther from the first one than this would make both of them dots [m]."""
MAX_RADIUS = 10.0
"""A larger object is a landscape, whatever it is called; half its diagonal [m]."""
WELL_SEEN = 0.98
"""Share of what matters that a good view is not hidden from [1]."""
BEARINGS = (35.0, -35.0, 145.0, -145.0, 80.0, -80.0, 0.0, 180.0)
"""Azimuths from which to view a vehicle, from its bow to starboard; the best first [deg]."""
ELEVATIONS = (25.0, 50.0, 10.0)
"""How high above the horizon [deg]."""
SKETCH: Size = (96, 72)
"""Of the images that say how much of it is seen [px]."""
NEAR_PLANE = 0.05
"""Near plane [m]."""
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class View:
    """A place to look from."""

    world_from_camera: Pose
    """OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole."""
    is_clear: bool = False
    """Whether it is a view through water without fog."""


@dataclass(frozen=True, eq=False)
class Focus:
    """The part of a scene that a view should show."""

    ids: frozenset[int]
    """Numbers of the parts."""
    corners: Array
    """Of their boxes in W, (n, 3) [m]."""
    ahead: Array
    """Where the first vehicle looks, level, in W, (3,)."""

    @property
    def middle(self) -> Array:
        """Of the box around it all, in W, (3,) [m]."""
        middle: Array = 0.5 * (self.corners.min(axis=0) + self.corners.max(axis=0))
        return middle


def viewer_view(simulation: Simulation, spec: ViewerCameraSpec, size: Size) -> View:
    """The viewer's camera of a scene file: in W, or about what it tracks.

    Raises:
        BadSetting: the two points are the same.
    """
    centre = np.zeros(3)
    if not spec.free_motion and spec.object_to_track:
        centre = _centre(simulation, spec.object_to_track)
    lens = _lens(size, math.radians(spec.fov))
    if spec.near > 0.0 and spec.far > spec.near:
        lens = replace(lens, near=spec.near, far=spec.far)
    eye, at = centre + spec.position, centre + spec.look_at
    return View(_looking(eye, at - eye, "<camera>"), lens)


def view_from(simulation: Simulation, eye: Array, at: Array, size: Size) -> View:
    """From a point to a point, both in L, (3,) [m]; raises BadSetting where they are the same."""
    points = simulation.world.model.scene.world_from_localized.transform(np.stack([eye, at]))
    return View(_looking(points[0], points[1] - points[0], "--from"), _lens(size, FIELD))


def view_from_pose(world_from_camera: Pose, size: Size, field: float = FIELD) -> View:
    """From a pose of a camera in W (OpenGL axes), through clear water.

    ``field`` is the vertical field of view [rad].
    """
    return View(world_from_camera, _lens(size, field), is_clear=True)


def top_view(simulation: Simulation, size: Size) -> View:
    """From above; L's x axis is up in the image, if it lies level."""
    focus, lens = focus_of(simulation), _lens(size, FIELD)
    top = simulation.world.model.scene.world_from_localized.rotation[:, 0] * [1.0, 1.0, 0.0]
    if length(top) < 0.5:
        top = np.array([0.0, 1.0, 0.0])
    return View(_framing(focus, camera_axes(-UP, top), lens), lens, is_clear=True)


def orbit_view(simulation: Simulation, size: Size) -> View:
    """A view around the focus that hides as little of it as possible.

    Places round it are tried one after the other, each with a small image of all there is and one
    of what matters alone.
    """
    focus, lens = focus_of(simulation), _lens(size, FIELD)
    best, best_share = None, -1.0
    for elevation, bearing in itertools.product(ELEVATIONS, BEARINGS):
        place = _framing(focus, _axes(focus.ahead, bearing, elevation), lens)
        share = _share_seen(simulation, focus, place)
        if share > best_share + 0.01:
            best, best_share = place, share
        if share >= WELL_SEEN:
            break
    assert best is not None
    return View(best, lens, is_clear=True)


def focus_of(simulation: Simulation) -> Focus:
    """Find the focus: the vehicles and what is near them; else the objects; else the ground.

    Of several vehicles those in the company of the first one.
    """
    world, scenery = simulation.world, simulation.world.scenery
    shown = [(part, scenery.corners(part)) for part in scenery.parts]
    vehicles = _in_company([each for each in shown if each[0].vehicle is not None])
    things = [
        (part.id, corners)
        for part, corners in shown
        if part.object is not None and part.name != TERRAIN and _radius(corners) <= MAX_RADIUS
    ]
    if vehicles:
        own = np.concatenate([corners for _, corners in vehicles])
        middle = 0.5 * (own.min(axis=0) + own.max(axis=0))
        reach = max(NEARBY, 3.0 * _radius(own))
        near = [each for each in things if _distance(each[1], middle) <= reach]
        chosen = vehicles + near
    else:
        chosen = things or [(part.id, corners) for part, corners in shown]
    if not chosen:  # nothing at all: the origin of the file's frame
        chosen = [(0, world.model.scene.world_from_localized.position + np.eye(3))]
    ahead = world.model.scene.world_from_localized.rotation[:, 0]
    for vehicle in world.vehicles.names[:1]:
        ahead = world.bodies.find(vehicle).world_from_body.rotation[:, 0]
    level = ahead * [1.0, 1.0, 0.0]
    size = length(level)
    return Focus(
        frozenset(id for id, _ in chosen),
        np.concatenate([corners for _, corners in chosen]),
        level / size if size > 0.1 else np.array([1.0, 0.0, 0.0]),
    )


def _in_company(shown: Sequence[tuple[Part, Array]]) -> list[tuple[int, Array]]:
    """Numbers and corners of the vehicles' parts, of those that are not far from the first one."""
    if not shown:
        return []
    first = np.concatenate(
        [corners for part, corners in shown if part.vehicle == shown[0][0].vehicle]
    )
    middle = 0.5 * (first.min(axis=0) + first.max(axis=0))
    near = {part.vehicle for part, corners in shown if _distance(corners, middle) <= COMPANY}
    return [(part.id, corners) for part, corners in shown if part.vehicle in near]


def _share_seen(simulation: Simulation, focus: Focus, world_from_camera: Pose) -> float:
    """Visible share of the focus, 0..1: 1 where nothing hides it."""
    lens = _lens(SKETCH, FIELD)
    rest = frozenset(part.id for part in simulation.world.scenery.parts) - focus.ids
    shares = []
    alone, all_there = (
        simulation.world.scenery.render_view(
            world_from_camera, lens, targets={"ids"}, hidden=hidden
        ).ids
        for hidden in (rest, frozenset[int]())
    )
    assert alone is not None
    assert all_there is not None
    for id in focus.ids:
        if expected := np.count_nonzero(alone == id):
            shares.append(np.count_nonzero(all_there == id) / expected)
    return float(np.mean(shares)) if shares else 0.0


def _framing(focus: Focus, axes: Array, lens: Intrinsics) -> Pose:
    """The nearest view with these axes in W that has all corners in the image."""
    beside = product(focus.corners - focus.middle, axes)  # (n, 3): right, up, towards the eye [m]
    halves = np.array([lens.width / lens.fx, lens.height / lens.fy]) * 0.5 * FILLED  # (2,) [1]
    across, depth = beside[:, :2] / halves, beside[:, 2:]
    # the eye's distance from the two planes through the corners, right and left, above and below
    upper, lower = (across + depth).max(axis=0), (depth - across).max(axis=0)  # (2,) [m]
    distance = float((0.5 * (upper + lower)).max())
    eye = np.array([*(0.5 * (upper - lower) * halves), max(distance, 0.5)])
    return Pose(focus.middle + product(axes, eye), axes)


def _axes(ahead: Array, bearing: float, elevation: float) -> Array:
    """Axes of a camera that looks back at what it goes round, in W, (3, 3)."""
    turn, tilt = math.radians(bearing), math.radians(elevation)
    starboard = np.cross(ahead, UP)
    outward = math.cos(turn) * ahead + math.sin(turn) * starboard
    return camera_axes(-(math.cos(tilt) * outward + math.sin(tilt) * UP), UP)


def _looking(eye: Array, ahead: Array, what: str) -> Pose:
    distance = length(ahead)
    if not distance > 0.0:
        raise BadSetting(f"{what} looks at its own position.")
    return Pose(eye, camera_axes(ahead / distance, UP))


def _lens(size: Size, field: float) -> Intrinsics:
    return Intrinsics.from_fovy(*size, field, near=NEAR_PLANE)


def _centre(simulation: Simulation, route: str) -> Array:
    """The middle of what a route names, in W, (3,) [m]; the origin where nothing is called so."""
    for name in (f"{route}@visual", route):
        try:
            body = simulation.world.bodies.find(name)
        except UnknownName:
            continue
        if body.box is None:
            return body.world_from_body.position
        middle = 0.5 * (np.array(body.box.lower) + np.array(body.box.upper))
        centre: Array = body.world_from_body.transform(middle[None])[0]
        return centre
    return np.zeros(3)


def _radius(corners: Array) -> float:
    """Half the diagonal of the box around points [m]."""
    return 0.5 * length(corners.max(axis=0) - corners.min(axis=0))


def _distance(corners: Array, point: Array) -> float:
    """From a point to the middle of the box around points [m]."""
    return length(0.5 * (corners.max(axis=0) + corners.min(axis=0)) - point)
