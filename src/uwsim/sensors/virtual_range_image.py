"""A depth camera: metric distance along the optical axis, the water unseen.

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
    """A ``<virtualRangeImage>``; geometry as that of a `VirtualCameraSpec`."""

    message_type: ClassVar[type] = Image
    is_pure: ClassVar[bool] = True
    frame_rpy: ClassVar[tuple[float, float, float]] = OPTICAL_AXES

    resw: int = element(default=160, minimum=1, maximum=16384)
    """Columns of the image [px]."""
    resh: int = element(default=120, minimum=1, maximum=16384)
    """Rows of the image [px]."""
    position: tuple[float, float, float] = element(
        default=(0.0, 0.0, 0.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the sensor in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the sensor in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    look_at: LookAt = element(namespaced=True, default=None)
    """Viewing target at the start, instead of ``orientation``: a point in L [m], or a direction
    of the vehicle. It stays fixed to its link."""
    frame_id: str = ""
    """Name of the frame in the headers of image and info."""
    fovy: float = element(default=50.0, above=0, below=180)
    """Vertical field of view [deg]; ignored when there are parameters."""
    parameters: CameraParametersSpec | None = None
    """The pinhole from a calibration."""
    underwater_particles: bool = element(attribute=True, default=False)
    """Read and not used: there are no particles in the water."""
    std: float = element(namespaced=True, default=0.0, minimum=0, maximum=1000)
    """Noise of each pixel's depth, standard deviation [m]."""

    def intrinsics(self, compatibility: frozenset[str] = frozenset()) -> Intrinsics:
        """Its pinhole; the compatibility ``y0`` is that of `CameraParametersSpec.intrinsics`."""
        if self.parameters is not None:
            return self.parameters.intrinsics(self.resw, self.resh, compatibility)
        return Intrinsics.from_fovy(self.resw, self.resh, math.radians(self.fovy))

    def bind(self, world: SensorWorld, vehicle: Carrier) -> VirtualRangeImage:
        """Mount it on its link; raises UnknownName if the vehicle has no such link.

        With the compatibility ``visual-frames`` it hangs on the link's visual frame.
        """
        mount = vehicle.mount(self, visual="visual-frames" in world.compatibility)
        return VirtualRangeImage(self, mount, world, f"{vehicle.name}/{self.name}/noise")


class VirtualRangeImage:
    """A bound depth camera: its depth image, as in REP 118, and its CameraInfo.

    The noise of an image depends on its time alone: readers of the same time see the same image,
    whoever else reads. Not modelled: occlusion between projector and camera, mixed pixels, lens
    distortion, refraction, particles.
    """

    def __init__(
        self, spec: VirtualRangeImageSpec, mount: Body, world: SensorWorld, stream: str
    ) -> None:
        self._std, self._mount, self._world, self._stream = spec.std, mount, world, stream
        self.state = NoState()
        """Nothing: the noise of a time is drawn anew."""
        self.intrinsics = spec.intrinsics(world.compatibility)
        """Its pinhole."""
        self._principal_point = written_principal_point(spec.parameters, world.compatibility)
        self.name = spec.name
        """Its name in the scene."""
        self.frame_id = spec.frame_id
        """The frame in the headers of its messages."""

    @property
    def world_from_camera(self) -> Pose:
        """Where it is now; OpenGL axes."""
        return self._mount.world_from_body

    def depth(self, time: float) -> Array:
        """Measure at ``time`` [s]: distance along the optical axis, (h, w) [m].

        As in REP 117 and 118, +inf where nothing is nearer than the far plane, and -inf where noise
        makes it nearer than the near plane.
        """
        lens = self.intrinsics
        depth = self._world.depth(self.world_from_camera, lens)
        if self._std > 0.0:
            random = self._world.stream(f"{self._stream}/{round(time * 1e9)}")
            depth += self._std * random.standard_normal(depth.shape)
            depth = np.where(depth < lens.near, -np.inf, np.where(depth < lens.far, depth, np.inf))
        return depth

    def sample(self, time: float) -> Image:
        """Measure now, at ``time`` [s]."""
        return depth_image(self.depth(time), time=time, frame_id=self.frame_id)

    def info(self, time: float) -> CameraInfo:
        """Build its CameraInfo, stamped ``time`` [s]: no distortion."""
        return camera_info(
            self.intrinsics,
            time=time,
            frame_id=self.frame_id,
            principal_point=self._principal_point,
        )
