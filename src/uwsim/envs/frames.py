"""The images of ``render()``: of a camera of the scene, or of a view of its vehicles from outside.

========  ======================================================================================
view      camera
========  ======================================================================================
chase     behind and above the first vehicle, as in films; its heading follows slowly
orbit     at the start where ``uwsim render --view orbit`` looks from; then it moves along
top       above the vehicles and the objects near them
viewer    the ``<camera>`` of the scene file
========  ======================================================================================

A camera is rendered without noise. In views, water has no fog and physical water is the purest.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from numbers import Integral

import numpy as np
import numpy.typing as npt

from ..base.geometry import Intrinsics, Pose
from ..base.numerics.linear import length
from ..errors import BadSetting, UnknownName, short_repr
from ..scene.sizes import find_size_error
from ..scene.spec import SceneSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..simulation import Simulation
from ..simulation.views import (
    chase_pose,
    chase_radius,
    find_focus,
    orbit_view,
    top_view,
    view_from_pose,
    viewer_view,
)

Frame = npt.NDArray[np.uint8]
VIEWS = ("chase", "orbit", "top", "viewer")
"""The names of the views."""
TURNING_TIME = 1.0
"""The time constant with which the chase camera follows the heading [s of simulation time]."""


def _is_size(value: object) -> bool:
    """Return whether a value is a width and a height, whole numbers from 1 on."""
    return (
        isinstance(value, Sequence)
        and len(value) == 2
        and all(isinstance(number, Integral) and int(number) >= 1 for number in value)
    )


class FrameSource:
    """The images of an environment.

    Args:
        scene: the scene.
        camera: the name of a camera or of a view; None: the first camera, or else ``orbit``.
        size: the width and height [px]; None: those of the camera, or ``resw`` and ``resh``.

    Raises:
        UnknownName: there is no such camera or view.
        BadSetting: the scene cannot be rendered at this size, or has no ``<camera>``.
    """

    def __init__(self, scene: SceneSpec, camera: str | None, size: tuple[int, int] | None) -> None:
        cameras = [
            part.name
            for vehicle in scene.vehicles
            for part in vehicle.parts
            if isinstance(part, VirtualCameraSpec)
        ]
        if camera is not None and camera not in (*cameras, *VIEWS):
            raise UnknownName("camera or view", camera, (*cameras, *VIEWS))
        self._camera = camera or (cameras[0] if cameras else "orbit")
        if size is not None and not _is_size(size):
            raise BadSetting(
                f"frame_size is {short_repr(size)}; expected width and height [px], as (640, 480)."
            )
        if size is not None and (error := find_size_error(*size, scene.ocean_state.water)):
            raise BadSetting(f"frame_size: {error}.")
        if self._camera == "viewer" and scene.camera is None and "viewer" not in cameras:
            raise BadSetting("The scene has no <camera>; expected another view than 'viewer'.")
        self._scene, self._is_view, self._size = scene, self._camera not in cameras, size
        self._view_size = size or (scene.sim_params.resw, scene.sim_params.resh)
        self._simulation: Simulation | None = None
        self._radius = 0.0  # of the chase [m]
        # of the vehicle at the first image; without a vehicle, of the centre of the focus
        self._start = np.zeros(3)
        self._initial_pose = Pose.identity()  # of the camera at the first image
        self._bow_direction = np.array([1.0, 0.0, 0.0])
        self._last_time = 0.0

    def draw(self, simulation: Simulation) -> Frame:
        """Render the present image, (h, w, 3)."""
        if not self._is_view:
            return self._draw_camera(simulation)
        if self._camera == "viewer" and self._scene.camera is not None:
            view = viewer_view(simulation, self._scene.camera, self._view_size)
        elif self._camera == "top":
            view = top_view(simulation, self._view_size)
        else:
            view = view_from_pose(self._follow(simulation), self._view_size)
        image = simulation.world.scenery.render_view(
            view.world_from_camera,
            view.intrinsics,
            targets={"colour"},
            fog=0.0 if view.is_clear else None,
        )
        assert image.colour is not None
        return image.colour.view(np.uint8).copy()

    def _draw_camera(self, simulation: Simulation) -> Frame:
        camera = simulation.world.sensors.camera(self._camera)
        pinhole: Intrinsics = camera.intrinsics
        image = simulation.world.scenery.render_clean(
            camera.world_from_camera,
            pinhole if self._size is None else pinhole.with_size(*self._size),
            targets={"colour"},
            is_polished=camera.is_polished,
        )
        assert image.colour is not None
        return image.colour.view(np.uint8).copy()

    def _follow(self, simulation: Simulation) -> Pose:
        """Return the pose of the orbit or chase camera, which follows the first vehicle."""
        is_first = simulation is not self._simulation
        if is_first:
            focus = find_focus(simulation)
            self._simulation, self._radius = simulation, chase_radius(simulation, focus)
            self._start, self._bow_direction = focus.centre, focus.bow_direction
            if self._camera == "orbit":
                self._initial_pose = orbit_view(simulation, self._view_size).world_from_camera
        position, bow_direction = self._start, self._bow_direction
        for name in simulation.world.vehicles.names[:1]:
            pose = simulation.world.bodies.find(name).world_from_body
            position, bow_direction = pose.position, pose.rotation[:, 0] * [1.0, 1.0, 0.0]
        if is_first:
            self._start = position
        if self._camera == "orbit":
            initial_pose = self._initial_pose
            return Pose(initial_pose.position + position - self._start, initial_pose.rotation)
        time_step = 0.0 if is_first else simulation.time - self._last_time
        self._last_time = simulation.time
        share = 1.0 - math.exp(-time_step / TURNING_TIME)
        direction = self._bow_direction + share * (bow_direction - self._bow_direction)
        self._bow_direction = direction / max(length(direction), 1e-9)
        return chase_pose(position, self._bow_direction, self._radius)
