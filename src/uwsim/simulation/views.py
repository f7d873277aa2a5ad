"""Cameras that view a scene: of the scene file, from above, or around the vehicles."""

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
from .scenery.refracted_points import refract_points
from .simulation import Simulation

Size = tuple[int, int]
FIELD_OF_VIEW = math.radians(50.0)
"""The vertical field of view of the views that are computed here [rad]."""
MAX_FILLED_SHARE = 0.8
"""The largest fraction of an image, in width and in height, that the focus fills [1]."""
OBJECT_DISTANCE = 6.0
"""The minimum distance from the vehicles within which objects are part of the focus [m]."""
MAX_VEHICLE_DISTANCE = 30.0
"""The distance from the first vehicle beyond which others are left out of a view [m]."""
MAX_RADIUS = 10.0
"""The largest half diagonal of an object in the focus; larger objects are landscape [m]."""
MIN_VISIBLE_SHARE = 0.98
"""The visible fraction of the focus at which the search for a better view ends [1]."""
ORBIT_BEARINGS = (35.0, -35.0, 145.0, -145.0, 80.0, -80.0, 0.0, 180.0)
"""The tried bearings of the camera from the bow, positive to starboard; the best first [deg]."""
ORBIT_ELEVATIONS = (25.0, 50.0, 10.0)
"""The tried elevations of the camera above the horizon [deg]."""
CHASE_DISTANCE = 3.0
"""The distance of the chase camera behind the vehicle, as a multiple of the radius of the focus."""
CHASE_HEIGHT = 1.1
"""The height of the chase camera above the vehicle, as a multiple of the same radius."""
MAX_CHASE_RISE = 0.8
"""The greatest height of the chase camera above the vehicle, as a share of the depth [1]."""
MAX_CHASE_RADIUS = 2.0
"""The greatest radius of the focus for the chase camera [m]."""
VISIBILITY_IMAGE_SIZE: Size = (96, 72)
"""The width and height of the images that measure the visible share [px]."""
N_REFRACTIONS = 12
"""The number of times that a view of refracted corners is framed anew."""
NEAR_PLANE = 0.05
"""The distance of the near plane [m]."""
UP = np.array([0.0, 0.0, 1.0])
"""The upward direction in W, (3,)."""


@dataclass(frozen=True, eq=False)
class View:
    """A camera that views a scene."""

    world_from_camera: Pose
    """The pose of the camera in W; OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole model of the camera."""
    is_clear: bool = False
    """True if the water is rendered without fog."""


@dataclass(frozen=True, eq=False)
class Focus:
    """The part of a scene that a view should show."""

    ids: frozenset[int]
    """The segmentation IDs of the parts."""
    corners: Array
    """The corners of the bounding boxes of the parts in W, (n, 3) [m]."""
    bow_direction: Array
    """The horizontal unit vector to the bow of the first vehicle in W, (3,)."""

    @property
    def centre(self) -> Array:
        """The centre of the bounding box of the corners in W, (3,) [m]."""
        centre: Array = 0.5 * (self.corners.min(axis=0) + self.corners.max(axis=0))
        return centre

    @property
    def radius(self) -> float:
        """The radius: half the diagonal of the bounding box of the corners [m]."""
        return 0.5 * length(np.ptp(self.corners, axis=0))


def viewer_view(simulation: Simulation, spec: ViewerCameraSpec, size: Size) -> View:
    """Return the view of the ``<camera>`` of a scene file.

    Its position and target are in W, or relative to the object that it tracks.

    Raises:
        BadSetting: position and target are the same point.
    """
    tracked_point = np.zeros(3)
    if not spec.free_motion and spec.object_to_track:
        tracked_point = _find_centre(simulation, spec.object_to_track)
    intrinsics = _intrinsics_for(size, math.radians(spec.fov))
    if spec.near > 0.0 and spec.far > spec.near:
        intrinsics = replace(intrinsics, near=spec.near, far=spec.far)
    eye, target = tracked_point + spec.position, tracked_point + spec.look_at
    return View(_look_pose(eye, target - eye, "<camera>"), intrinsics)


def view_from(simulation: Simulation, eye: Array, target: Array, size: Size) -> View:
    """Return the view from ``eye`` to ``target`` in L, (3,) [m]; BadSetting if they are equal."""
    points = simulation.world.model.scene.world_from_localized.transform(np.stack([eye, target]))
    return View(
        _look_pose(points[0], points[1] - points[0], "--from"), _intrinsics_for(size, FIELD_OF_VIEW)
    )


def view_from_pose(world_from_camera: Pose, size: Size, field: float = FIELD_OF_VIEW) -> View:
    """Return the view of a camera at a pose in W, through water without fog.

    Args:
        world_from_camera: the pose of the camera; OpenGL axes.
        size: the width and height of the image [px].
        field: the vertical field of view [rad].
    """
    return View(world_from_camera, _intrinsics_for(size, field), is_clear=True)


def top_view(simulation: Simulation, size: Size) -> View:
    """Return the view of the focus from above, with L's x axis upwards unless it is vertical."""
    focus, intrinsics = find_focus(simulation), _intrinsics_for(size, FIELD_OF_VIEW)
    top = simulation.world.model.scene.world_from_localized.rotation[:, 0] * [1.0, 1.0, 0.0]
    if length(top) < 0.5:
        top = np.array([0.0, 1.0, 0.0])
    pose = _frame_focus(simulation, focus, camera_axes(-UP, top), intrinsics)
    return View(pose, intrinsics, is_clear=True)


def orbit_view(simulation: Simulation, size: Size) -> View:
    """Return a view in which as much of the focus as possible is visible.

    Camera positions around the focus are tried one after the other. For each, a small image of all
    parts is compared with an image of the focus alone.
    """
    focus, intrinsics = find_focus(simulation), _intrinsics_for(size, FIELD_OF_VIEW)
    best_pose, best_share = None, -1.0
    for elevation, bearing in itertools.product(ORBIT_ELEVATIONS, ORBIT_BEARINGS):
        axes = _camera_axes(focus.bow_direction, bearing, elevation)
        pose = _frame_focus(simulation, focus, axes, intrinsics)
        share = _visible_share(simulation, focus, pose)
        if share > best_share + 0.01:
            best_pose, best_share = pose, share
        if share >= MIN_VISIBLE_SHARE:
            break
    assert best_pose is not None
    return View(best_pose, intrinsics, is_clear=True)


def chase_pose(position: Array, bow_direction: Array, radius: float) -> Pose:
    """Return the pose in W of a camera behind and above a vehicle.

    Args:
        position: the position of the vehicle in W, (3,) [m].
        bow_direction: the horizontal unit vector towards its bow in W, (3,).
        radius: the radius of the view, of `chase_radius` [m].
    """
    eye = position - CHASE_DISTANCE * radius * bow_direction + CHASE_HEIGHT * radius * UP
    view = position + 0.5 * radius * bow_direction - eye
    return Pose(eye, camera_axes(view / length(view), UP))


def chase_radius(simulation: Simulation, focus: Focus) -> float:
    """Return the radius for `chase_pose`: that of the focus, 2 m at most [m].

    It is less if the camera of a vehicle in the water would be above the water, unless it were then
    less than the radius of the vehicle.
    """
    radius, world = min(focus.radius, MAX_CHASE_RADIUS), simulation.world
    vehicle_corners = [
        world.scenery.corners(part) for part in world.scenery.parts if part.vehicle == 0
    ]
    if not vehicle_corners:
        return radius
    position = world.bodies.find(world.vehicles.names[0]).world_from_body.position
    depth = world.model.scene.ocean_state.ocean_surface_height - float(position[2])
    limit = MAX_CHASE_RISE * depth / CHASE_HEIGHT
    return min(radius, limit) if limit >= _radius(np.concatenate(vehicle_corners)) else radius


def find_focus(simulation: Simulation) -> Focus:
    """Return the focus: vehicles and objects near them; else the objects; else all parts.

    Vehicles far from the first vehicle are left out.
    """
    world, scenery = simulation.world, simulation.world.scenery
    part_corners = [(part, scenery.corners(part)) for part in scenery.parts]
    vehicles = _group_vehicles([entry for entry in part_corners if entry[0].vehicle is not None])
    small_objects = [
        (part.id, corners)
        for part, corners in part_corners
        if part.object is not None and part.name != TERRAIN and _radius(corners) <= MAX_RADIUS
    ]
    if vehicles:
        points = np.concatenate([corners for _, corners in vehicles])
        centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
        reach = max(OBJECT_DISTANCE, 3.0 * _radius(points))
        nearby = [entry for entry in small_objects if _distance(entry[1], centre) <= reach]
        focus_parts = vehicles + nearby
    else:
        focus_parts = small_objects or [(part.id, corners) for part, corners in part_corners]
    if not focus_parts:  # an empty scene: the origin of the file's frame
        focus_parts = [(0, world.model.scene.world_from_localized.position + np.eye(3))]
    direction = world.model.scene.world_from_localized.rotation[:, 0]
    for vehicle in world.vehicles.names[:1]:
        direction = world.bodies.find(vehicle).world_from_body.rotation[:, 0]
    bow_direction = direction * [1.0, 1.0, 0.0]
    size = length(bow_direction)
    return Focus(
        frozenset(id for id, _ in focus_parts),
        np.concatenate([corners for _, corners in focus_parts]),
        bow_direction / size if size > 0.1 else np.array([1.0, 0.0, 0.0]),
    )


def _group_vehicles(part_corners: Sequence[tuple[Part, Array]]) -> list[tuple[int, Array]]:
    """Return number and corners of each part of the vehicles that are near the first vehicle."""
    if not part_corners:
        return []
    first_points = np.concatenate(
        [corners for part, corners in part_corners if part.vehicle == part_corners[0][0].vehicle]
    )
    centre = 0.5 * (first_points.min(axis=0) + first_points.max(axis=0))
    near_vehicles = {
        part.vehicle
        for part, corners in part_corners
        if _distance(corners, centre) <= MAX_VEHICLE_DISTANCE
    }
    return [(part.id, corners) for part, corners in part_corners if part.vehicle in near_vehicles]


def _visible_share(simulation: Simulation, focus: Focus, world_from_camera: Pose) -> float:
    """Return the fraction of the focus that no other part hides, the mean over its parts [0..1]."""
    intrinsics = _intrinsics_for(VISIBILITY_IMAGE_SIZE, FIELD_OF_VIEW)
    other_ids = frozenset(part.id for part in simulation.world.scenery.parts) - focus.ids
    shares = []
    focus_ids, scene_ids = (
        simulation.world.scenery.render_view(
            world_from_camera, intrinsics, targets={"ids"}, hidden_ids=hidden_ids
        ).ids
        for hidden_ids in (other_ids, frozenset[int]())
    )
    assert focus_ids is not None
    assert scene_ids is not None
    for id in focus.ids:
        if expected := np.count_nonzero(focus_ids == id):
            shares.append(np.count_nonzero(scene_ids == id) / expected)
    return float(np.mean(shares)) if shares else 0.0


def _frame_focus(simulation: Simulation, focus: Focus, axes: Array, intrinsics: Intrinsics) -> Pose:
    """Return the nearest camera pose with these axes in W at which all corners are in the image.

    A camera above physical water sees what is below enlarged, by refraction.
    """
    pose = _frame_corners(focus.corners, focus.centre, axes, intrinsics)
    ocean_state = simulation.world.model.scene.ocean_state
    if ocean_state.water is None:
        return pose
    surface_height = ocean_state.ocean_surface_height
    for _ in range(N_REFRACTIONS):
        if pose.position[2] <= surface_height:
            break
        corners = refract_points(pose.position, focus.corners, surface_height)
        pose = _frame_corners(corners, focus.centre, axes, intrinsics)
    return pose


def _frame_corners(corners: Array, centre: Array, axes: Array, intrinsics: Intrinsics) -> Pose:
    """Return the nearest camera pose with these axes in W at which all corners are in the image."""
    offsets = product(corners - centre, axes)  # (n, 3): right, up, towards the eye [m]
    halves = (
        np.array([intrinsics.width / intrinsics.fx, intrinsics.height / intrinsics.fy])
        * 0.5
        * MAX_FILLED_SHARE
    )  # (2,) [1]
    sides, depth = offsets[:, :2] / halves, offsets[:, 2:]
    # the eye's distance from the two planes through the corners, right and left, above and below
    upper, lower = (
        (sides + depth).max(axis=0),
        (depth - sides).max(axis=0),
    )  # (2,) [m]
    distance = float((0.5 * (upper + lower)).max())
    eye = np.array([*(0.5 * (upper - lower) * halves), max(distance, 0.5)])
    return Pose(centre + product(axes, eye), axes)


def _camera_axes(bow_direction: Array, bearing: float, elevation: float) -> Array:
    """Return the axes in W, (3, 3), of a camera at a bearing and an elevation [deg]."""
    bearing_angle, tilt = math.radians(bearing), math.radians(elevation)
    starboard = np.cross(bow_direction, UP)
    direction = math.cos(bearing_angle) * bow_direction + math.sin(bearing_angle) * starboard
    return camera_axes(-(math.cos(tilt) * direction + math.sin(tilt) * UP), UP)


def _look_pose(eye: Array, direction: Array, source: str) -> Pose:
    distance = length(direction)
    if not distance > 0.0:
        raise BadSetting(f"{source} has one point as position and target; expected two points.")
    return Pose(eye, camera_axes(direction / distance, UP))


def _intrinsics_for(size: Size, field: float) -> Intrinsics:
    return Intrinsics.from_fovy(*size, field, near=NEAR_PLANE)


def _find_centre(simulation: Simulation, route: str) -> Array:
    """Return the centre of the body with a route, in W, (3,) [m]; the origin of W without one."""
    for name in (f"{route}@visual", route):
        try:
            body = simulation.world.bodies.find(name)
        except UnknownName:
            continue
        if body.box is None:
            return body.world_from_body.position
        body_centre = 0.5 * (np.array(body.box.lower) + np.array(body.box.upper))
        centre: Array = body.world_from_body.transform(body_centre[None])[0]
        return centre
    return np.zeros(3)


def _radius(corners: Array) -> float:
    """Return half the diagonal of the bounding box of points (n, 3) [m]."""
    return 0.5 * length(corners.max(axis=0) - corners.min(axis=0))


def _distance(corners: Array, point: Array) -> float:
    """Return the distance from a point to the centre of the bounding box of corners [m]."""
    return length(0.5 * (corners.max(axis=0) + corners.min(axis=0)) - point)
