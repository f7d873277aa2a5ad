"""A depth camera: metric distance along the optical axis, without effects of the water.

.. code-block:: xml

    <virtualRangeImage underwaterParticles="false">
      <name>rangeImage</name> <relativeTo>part0</relativeTo>
      <resw>320</resw> <resh>240</resh>
    </virtualRangeImage>
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..base.geometry import Array, Intrinsics, Pose
from ..base.record import NoState
from ..messages import CameraInfo, Image, depth_image
from ..schema import MAX_DISTANCE, element
from ..world import Body, SensorWorld
from .pinhole import camera_info
from .sensor import OPTICAL_AXES, Carrier, LookAt, SensorSpec
from .virtual_camera import CameraParametersSpec, written_principal_point


@dataclass(frozen=True, kw_only=True)
class VirtualRangeImageSpec(SensorSpec):
    """A ``<virtualRangeImage>``: a depth camera with the axes of a `VirtualCameraSpec`."""

    message_type: ClassVar[type] = Image
    is_pure: ClassVar[bool] = True
    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    resw: int = element(default=160, minimum=1, maximum=16384)
    """The number of columns of the image [px]."""
    resh: int = element(default=120, minimum=1, maximum=16384)
    """The number of rows of the image [px]."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """The viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. The camera stays fixed to its link."""
    frame_id: str = ""
    """The name of the frame in the headers of Image and CameraInfo."""
    fovy: float = element(default=50.0, exclusive_minimum=0, exclusive_maximum=180)
    """The vertical field of view [deg]; ignored if there are parameters."""
    parameters: CameraParametersSpec | None = None
    """The pinhole model from a calibration."""
    underwater_particles: bool = element(attribute=True, default=False)
    """An attribute that is read but not used: there are no particles in the water."""
    std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """The standard deviation of the noise of each pixel's depth [m]."""

    def intrinsics(self, compatibility: frozenset[str] = frozenset()) -> Intrinsics:
        """Return the pinhole model; for ``y0`` see `CameraParametersSpec.intrinsics`."""
        if self.parameters is not None:
            return self.parameters.intrinsics(self.resw, self.resh, compatibility)
        return Intrinsics.from_fovy(self.resw, self.resh, math.radians(self.fovy))

    def bind(self, world: SensorWorld, vehicle: Carrier) -> VirtualRangeImage:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link.

        With the compatibility quirk ``visual-frames`` it is fixed to the link's visual frame.
        """
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return VirtualRangeImage(self, mount, world, f"{vehicle.name}/{self.name}/noise")


class VirtualRangeImage:
    """A depth camera on a vehicle: its depth images, as in REP 118, and its CameraInfo.

    The noise of an image depends on the simulation time alone: two samples at one time are equal.
    Not modelled: occlusion between projector and camera, mixed pixels, intrinsics distortion,
    refraction, particles.
    """

    def __init__(
        self, spec: VirtualRangeImageSpec, mount: Body, world: SensorWorld, stream: str
    ) -> None:
        self._std, self._mount, self._world, self._stream = spec.std, mount, world, stream
        self.state = NoState()
        """The state, which is empty, as the noise depends on the time alone."""
        self.intrinsics = spec.intrinsics(world.compatibility)
        """The pinhole model."""
        self._principal_point = written_principal_point(spec.parameters, world.compatibility)
        self.name = spec.name
        """The name in the scene."""
        self.frame_id = spec.frame_id
        """The name of the frame in the headers of the messages."""

    @property
    def world_from_camera(self) -> Pose:
        """The present pose in W; OpenGL axes (x right, y up, looking along -z)."""
        return self._mount.world_from_body

    def depth(self, time: float) -> Array:
        """Measure at ``time`` [s]: distance along the optical axis, (h, w) [m].

        As in REP 117 and 118, the value is +inf where no surface is nearer than the far plane, and
        -inf where noise makes the depth less than that of the near plane.
        """
        intrinsics = self.intrinsics
        depth = self._world.depth(self.world_from_camera, intrinsics)
        if self._std > 0.0:
            rng = self._world.stream(f"{self._stream}/{round(time * 1e9)}")
            depth += self._std * rng.standard_normal(depth.shape)
            depth = np.where(
                depth < intrinsics.near, -np.inf, np.where(depth < intrinsics.far, depth, np.inf)
            )
        return depth

    def sample(self, time: float) -> Image:
        """Return the depth image at ``time`` [s] as a message."""
        return depth_image(self.depth(time), time=time, frame_id=self.frame_id)

    def info(self, time: float) -> CameraInfo:
        """Build the CameraInfo, stamped ``time`` [s]: no distortion."""
        return camera_info(
            self.intrinsics,
            time=time,
            frame_id=self.frame_id,
            principal_point=self._principal_point,
        )
