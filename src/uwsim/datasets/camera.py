"""The camera of a data set: a pinhole, or the lens, noise and response of a camera of the scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.geometry import Intrinsics, Pose, rotation_x
from ..base.numerics.linear import product
from ..cameras.exposure import Exposure, PlainExposure
from ..cameras.lens import Lens
from ..cameras.noise_words import frame_key
from ..cameras.response import Pixels
from ..errors import BadSetting
from ..rendering.rendered_image import RenderedImage
from ..sensors.virtual_camera import VirtualCameraSpec
from ..simulation import Simulation
from .request import DatasetRequest

NEAR_PLANE = 0.05
"""The distance of the near plane of the pinhole [m]."""
OPTICAL_FROM_OPENGL = rotation_x(np.pi)
"""The rotation from OpenGL axes (y up) to optical axes (x right, y down, z forward), (3, 3)."""


@dataclass(frozen=True, eq=False)
class DatasetCamera:
    """A camera that takes images from any pose; it is at rest during an exposure."""

    spec: VirtualCameraSpec
    """The spec: size, noise, response, lens."""
    intrinsics: Intrinsics
    """The pinhole model and the lens."""

    def take(
        self, simulation: Simulation, pose: Pose, rng: np.random.Generator
    ) -> tuple[Pixels, RenderedImage]:
        """Take an image from a pose in W (OpenGL axes), with ranges and part numbers.

        Returns:
            The pixels, (h, w, 3), or (h, w) if they are grey, and the ranges and numbers.
        """
        spec, scenery = self.spec, simulation.world.scenery
        is_polished = spec.quality == "polished"
        if spec.response is None:
            exposure: Exposure | PlainExposure = PlainExposure(
                world_from_camera=pose,
                intrinsics=self.intrinsics,
                std=self._find_noise(simulation),
                rng=rng,
                is_grey=spec.grayscale,
                is_polished=is_polished,
            )
        else:
            exposure = Exposure(
                world_from_camera=pose,
                intrinsics=self.intrinsics,
                response=spec.response.camera_response,
                shutter=spec.response.camera_shutter,
                vignetting=spec.response.falloff_coefficients,
                velocity=np.zeros(3),
                angular_velocity=np.zeros(3),
                vehicle="",
                key=frame_key(rng),
                is_grey=spec.grayscale,
                is_polished=is_polished,
            )
        return scenery.render_labelled(exposure)

    def _find_noise(self, simulation: Simulation) -> float:
        """Return the standard deviation of the noise, which scene updaters may set [1]."""
        cameras = simulation.world.sensors
        is_of_scene = self.spec.name in cameras.cameras
        return cameras.camera(self.spec.name).state.std if is_of_scene else self.spec.std

    def describe(self, pose: Pose) -> dict[str, Any]:
        """Return the model and the pose of the camera for a record; axes as in ROS and OpenCV."""
        i = self.intrinsics
        optical_pose = world_from_optical(pose)
        lens: dict[str, Any] = {"model": "pinhole", "coefficients": []}
        if isinstance(i.lens, Lens):
            lens = {"model": "plumb_bob", "coefficients": list(i.lens.distortion)}
            if i.lens.port is not None:
                lens["port"] = type(i.lens.port).__name__
        return {
            "width": i.width,
            "height": i.height,
            "fx": i.fx,
            "fy": i.fy,
            "cx": i.cx,
            "cy": i.cy,
            "skew": i.skew,
            "distortion": lens,
            "position": optical_pose.position.tolist(),
            "quaternion_wxyz": optical_pose.quaternion.tolist(),
        }


def make_camera(simulation: Simulation, request: DatasetRequest) -> DatasetCamera:
    """Return the camera of a request.

    Raises:
        UnknownName: the scene has no such camera.
        BadSetting: the camera has numbers of 12 bit.
    """
    width, height = request.size
    if request.camera is None:
        spec = VirtualCameraSpec(
            name="", relative_to="", resw=width, resh=height, fovy=request.field_of_view
        )
        fovy = np.radians(request.field_of_view)
        return DatasetCamera(
            spec, Intrinsics.from_fovy(width, height, float(fovy), near=NEAR_PLANE)
        )
    simulation.world.sensors.camera(request.camera)  # raises UnknownName
    spec = next(
        part
        for vehicle in simulation.world.model.scene.vehicles
        for part in vehicle.parts_of(VirtualCameraSpec)
        if part.name == request.camera
    )
    if spec.response is not None and spec.response.output == "linear12":
        raise BadSetting(
            f"--camera {request.camera}: its images have 12 bit; data sets have images of 8 bit."
        )
    intrinsics = spec.intrinsics(simulation.world.model.compatibility)
    return DatasetCamera(spec, intrinsics.with_size(width, height))


def world_from_optical(world_from_camera: Pose) -> Pose:
    """Return the pose of a camera with optical axes (x right, y down, z forward) in W."""
    rotation = product(world_from_camera.rotation, OPTICAL_FROM_OPENGL)
    return Pose(world_from_camera.position, rotation)
