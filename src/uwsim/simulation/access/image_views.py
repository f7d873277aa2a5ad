"""The images of a camera or a sonar for an observer who reads them at times of its own.

The observer has a second instance of the sensor, with a random stream of the same name: the n-th
image that it reads has the noise of the n-th image on the sensor's topic.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ...base.geometry import Intrinsics
from ...errors import BadSetting, UnknownName
from ...messages import Image, pixels_of
from ...sensors.sensor import BindsSensor
from ...sensors.sonar.imaging_sonar import ImagingSonarSpec
from ...sensors.sonar.scanning_sonar import ScanningSonarSpec
from ...sensors.sonar.side_scan_sonar import SideScanSonarSpec
from ...sensors.virtual_camera import VirtualCamera, VirtualCameraSpec
from ...sensors.virtual_range_image import VirtualRangeImageSpec
from ...world import ImageContent, ImageView
from ..physical_scene import PhysicalScene
from ..scene_sensors import SceneSensors
from ..world_views.sensor_view import SensorView

SONARS = (ImagingSonarSpec, ScanningSonarSpec, SideScanSonarSpec)
"""The specs of the sonars that make images."""
IMAGE_SENSORS = (VirtualCameraSpec, VirtualRangeImageSpec, *SONARS)
"""The specs of the sensors that make images."""
MAX_LINEAR = 4095.0
"""The greatest number of a camera of 12 bit."""


class DepthSensor(Protocol):
    """A sensor with depths: a camera or a depth camera."""

    @property
    def intrinsics(self) -> Intrinsics:
        """The pinhole model."""

    def depth(self, time: float) -> npt.NDArray[np.float64]:
        """Measure the distance along the optical axis, (h, w) [m]; +inf: no surface."""


class SonarSensor(Protocol):
    """A sonar that makes images."""

    def sample(self, time: float) -> object:
        """Ping at a time [s]."""

    def image(self, time: float) -> Image:
        """Return the image of the last pings."""


def bind_image_view(
    scene: PhysicalScene,
    sensors: SceneSensors,
    name: str,
    content: ImageContent,
    size: tuple[int, int] | None,
) -> ImageView:
    """Return the images of a camera or a sonar; see `uwsim.world.World.image_view`."""
    specs = {
        spec.name: (index, spec)
        for index, _, spec in scene.model.sensor_specs
        if isinstance(spec, IMAGE_SENSORS)
    }
    if name not in specs:
        raise UnknownName("camera or sonar", name, specs)
    index, spec = specs[name]
    world, vehicle = SensorView(scene, is_blind=False), scene.vehicles[index]
    if isinstance(spec, VirtualCameraSpec) and content != "depth":
        is_grey = spec.grayscale or content == "grey"
        camera = replace(spec, grayscale=is_grey).bind(world, vehicle)
        _resize(camera, size)
        return CameraImages(camera, sensors.camera(name))
    if isinstance(spec, VirtualCameraSpec):
        camera = spec.bind(world, vehicle)
        _resize(camera, size)
        return DepthImages(camera, world)
    if content == "grey" or (content == "depth") != isinstance(spec, VirtualRangeImageSpec):
        raise _content_error(spec, content)
    if size is not None:
        raise BadSetting(f"The images of {name!r} have a size of their own; expected none.")
    if isinstance(spec, VirtualRangeImageSpec):
        return DepthImages(spec.bind(world, vehicle), world)
    return SonarImages(spec.bind(world, vehicle), world)


def _resize(camera: VirtualCamera, size: tuple[int, int] | None) -> None:
    if size is not None:
        camera.resize(camera.intrinsics.with_size(*size))


def _content_error(spec: BindsSensor, content: ImageContent) -> BadSetting:
    own_content = "depth" if isinstance(spec, VirtualRangeImageSpec) else "image"
    return BadSetting(
        f"{spec.name!r} is no colour camera and has no {content!r}; expected {own_content!r}."
    )


class CameraImages:
    """The images of a colour camera, (h, w, 3), or of a grey one, (h, w, 1).

    Args:
        camera: the camera that takes the images.
        scene_camera: the camera of the scene, whose noise a scene updater may set.
    """

    def __init__(self, camera: VirtualCamera, scene_camera: VirtualCamera) -> None:
        self._camera, self._scene_camera = camera, scene_camera
        pinhole = camera.intrinsics
        self.shape = (pinhole.height, pinhole.width, 1 if camera.is_grey else 3)
        """The height, the width, and the number of channels."""
        self.number_type = camera.pixel_type
        """The type of the numbers."""
        self.maximum = 255.0 if camera.pixel_type is np.uint8 else MAX_LINEAR
        """The greatest number."""

    def read(self) -> npt.NDArray[Any]:
        """Take the present image."""
        self._camera.state.std = self._scene_camera.state.std
        return self._camera.capture().reshape(self.shape)


class DepthImages:
    """The depths of a camera, float32 (h, w, 1) [m]; no surface: the distance of the far plane.

    Args:
        camera: the camera.
        world: the scene, for its time.
    """

    number_type = np.float32

    def __init__(self, camera: DepthSensor, world: SensorView) -> None:
        self._camera, self._world = camera, world
        pinhole = camera.intrinsics
        self.shape = (pinhole.height, pinhole.width, 1)
        """The height, the width, and one channel."""
        self.maximum = float(np.float32(pinhole.far))
        """The distance of the far plane [m]."""

    def read(self) -> npt.NDArray[Any]:
        """Measure the present depths."""
        depth = self._camera.depth(self._world.time)
        return np.clip(depth, 0.0, self.maximum).astype(np.float32).reshape(self.shape)


class SonarImages:
    """The images of a sonar, which pings once for each, (h, w, 1).

    Args:
        sonar: the sonar.
        world: the scene, for its time.
    """

    number_type = np.uint8
    maximum = 255.0

    def __init__(self, sonar: SonarSensor, world: SensorView) -> None:
        self._sonar, self._world = sonar, world
        first_image = sonar.image(world.time)
        self.shape = (first_image.height, first_image.width, 1)
        """The height, the width, and one channel."""

    def read(self) -> npt.NDArray[Any]:
        """Ping, and return the image of the last pings."""
        self._sonar.sample(self._world.time)
        return pixels_of(self._sonar.image(self._world.time)).reshape(self.shape)
