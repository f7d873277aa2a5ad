"""A pinhole colour camera.

.. code-block:: xml

    <virtualCamera>
      <name>bowtech1</name> <relativeTo>part0</relativeTo>
      <resw>320</resw> <resh>240</resh>
      <position> <x>-0.2</x> <y>-0.1</y> <z>0</z> </position>
      <orientation> <r>0</r> <p>M_PI</p> <y>M_PI_2</y> </orientation>
    </virtualCamera>

With ``<u:response>`` images have the noise of electrons and motion blur; with ``<u:lens>`` they are
distorted.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.record import Record
from ..cameras.exposure import Exposure, PlainExposure
from ..cameras.lens_image import check_lens
from ..cameras.noise_words import frame_key
from ..errors import BadSetting
from ..messages import CameraInfo, Image, image
from ..schema import MAX_DISTANCE, Spec, element
from ..world import Body, MovingBody, SensorWorld
from .camera import LensSpec, ResponseSpec
from .pinhole import camera_info
from .sensor import OPTICAL_AXES, Carrier, LookAt, SensorSpec

Quality = Literal["plain", "polished"]


@dataclass(frozen=True, kw_only=True)
class CameraParametersSpec(Spec):
    """The pinhole model of a calibrated camera; it overrides ``fovy``."""

    fx: float = element(exclusive_minimum=0, maximum=MAX_DISTANCE)
    """The focal length along the columns [px]."""
    fy: float = element(exclusive_minimum=0, maximum=MAX_DISTANCE)
    """The focal length along the rows [px]."""
    x0: float
    """The column of the principal point, from the centre of the first column [px], as in ROS and
    OpenCV; the original UWSim measures it from the left edge."""
    y0: float
    """The row of the principal point, from the centre of the first row [px], as in ROS and OpenCV;
    the original UWSim measures it from the bottom edge."""
    f: float = element(exclusive_minimum=0, maximum=MAX_DISTANCE)
    """The far plane [m]."""
    n: float = element(exclusive_minimum=0, maximum=MAX_DISTANCE)
    """The near plane [m]."""
    k: float
    """The skew [px]."""

    def intrinsics(self, width: int, height: int, compatibility: frozenset[str]) -> Intrinsics:
        """Return the pinhole model for an image of ``width`` by ``height`` pixels.

        With the compatibility quirk ``y0``, x0 and y0 are measured from the left and the bottom
        edge, as in the original UWSim.
        """
        from_edges = "y0" in compatibility
        return Intrinsics(
            width=width,
            height=height,
            fx=self.fx,
            fy=self.fy,
            cx=self.x0 - 0.5 if from_edges else self.x0,
            cy=height - self.y0 - 0.5 if from_edges else self.y0,
            skew=self.k,
            near=self.n,
            far=self.f,
        )


def written_principal_point(
    parameters: CameraParametersSpec | None, compatibility: frozenset[str]
) -> tuple[float, float] | None:
    """Return x0 and y0 as written in the file, which CameraInfo has with the quirk ``y0``."""
    if parameters is None or "y0" not in compatibility:
        return None
    return parameters.x0, parameters.y0


@dataclass(frozen=True, kw_only=True)
class VirtualCameraSpec(SensorSpec):
    """A ``<virtualCamera>``: a colour camera; axes as in OpenGL (x right, y up), it looks along -z.

    Without ``parameters``: square pixels, a centred axis, near 0.18 m, far 2000 m.
    """

    message_type: ClassVar[type] = Image
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
    baseline: float = element(default=0.0, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The distance to the first camera of a stereo pair [m]; Tx = -fx * baseline in CameraInfo."""
    frame_id: str = ""
    """The name of the frame in the headers of Image and CameraInfo."""
    fovy: float = element(default=50.0, exclusive_minimum=0, exclusive_maximum=180)
    """The vertical field of view [deg]; ignored if there are parameters."""
    parameters: CameraParametersSpec | None = None
    """The pinhole model from a calibration."""
    showpath: float = 0.0
    """The period at which the viewer marks the outline of the camera's view [s]; 0 is off."""
    grayscale: bool = False
    """True if the images are mono8 instead of rgb8."""
    std: float = element(default=0.005, minimum=0, maximum=10)
    """The standard deviation of the noise of each channel of each pixel [1: full scale]."""
    quality: Quality = element(namespaced=True, default="plain")
    """The quality of the images; ``polished`` images have soft shadows in the hue of the water,
    highlights on wet surfaces and smooth edges, like views for people, and take three to four times
    the time."""
    response: ResponseSpec | None = element(namespaced=True, default=None)
    """The response of the camera, from light to numbers, instead of the noise ``std``."""
    lens: LensSpec | None = element(namespaced=True, default=None)
    """The distortion of the lens, and the port of its housing."""

    def intrinsics(self, compatibility: frozenset[str] = frozenset()) -> Intrinsics:
        """Return the pinhole model; for ``y0`` see `CameraParametersSpec.intrinsics`.

        Behind a port the focal lengths are those in the water.
        """
        if self.parameters is not None:
            pinhole = self.parameters.intrinsics(self.resw, self.resh, compatibility)
        else:
            pinhole = Intrinsics.from_fovy(self.resw, self.resh, math.radians(self.fovy))
        if self.lens is None:
            return pinhole
        lens = self.lens.lens
        scale = lens.magnification
        return replace(
            pinhole,
            fx=scale * pinhole.fx,
            fy=scale * pinhole.fy,
            skew=scale * pinhole.skew,
            lens=lens,
        )

    def find_errors(self) -> Iterator[tuple[Spec, str]]:
        """Yield the errors of the response and of the lens, each with its element."""
        if self.response is not None:
            for error in self.response.find_errors(self.resh):
                yield self.response, error
        if self.lens is None:
            return
        errors = list(self.lens.find_errors())
        yield from ((self.lens, error) for error in errors)
        if not errors:
            try:
                check_lens(self.intrinsics())
            except BadSetting as error:
                yield self.lens, str(error)

    def bind(self, world: SensorWorld, vehicle: Carrier) -> VirtualCamera:
        """Mount the sensor on its link; raise UnknownName if the vehicle has no such link.

        With the compatibility quirk ``visual-frames`` it is fixed to the link's visual frame.
        """
        is_visual = "visual-frames" in world.compatibility
        rng = world.stream(f"{vehicle.name}/{self.name}/noise")
        if self.response is None:
            return VirtualCamera(self, vehicle.mount(self, visual=is_visual), world, rng)
        body = vehicle.moving_mount(self, visual=is_visual)
        return VirtualCamera(self, body, world, rng, CameraMotion(body, vehicle.name))


@dataclass(slots=True)
class CameraState(Record):
    """The state of a camera."""

    std: float
    """The standard deviation of the noise of each channel [1: full scale], which scene updaters
    may set."""
    n_images: int | None
    """The number of images due on the camera's topics so far, with or without subscribers;
    None if it has no topic."""
    rng: np.random.Generator
    """The generator of the noise."""


@dataclass(frozen=True)
class CameraMotion:
    """The motion of a camera with a response."""

    body: MovingBody
    """The frame of the camera, whose motion blurs images."""
    vehicle: str
    """The name of the vehicle."""


class VirtualCamera:
    """A colour camera on a vehicle: its pose, its images, its CameraInfo.

    Without ``<u:response>`` the exposure takes no time, and noise is Gaussian. Not modelled: depth
    of field.
    """

    def __init__(
        self,
        spec: VirtualCameraSpec,
        mount: Body,
        world: SensorWorld,
        rng: np.random.Generator,
        motion: CameraMotion | None = None,
    ) -> None:
        self._mount, self._world = mount, world
        self._response, self._motion = spec.response, motion
        self.state = CameraState(spec.std, None, rng)
        """The state: the noise, and the number of images."""
        self.scene_std = spec.std
        """The standard deviation of the noise in the scene file [1: full scale]."""
        self._baseline = spec.baseline
        self._intrinsics = spec.intrinsics(world.compatibility)
        self._principal_point = written_principal_point(spec.parameters, world.compatibility)
        self.name = spec.name
        """The name in the scene."""
        self.frame_id = spec.frame_id
        """The name of the frame in the headers of the messages."""
        self.is_grey = spec.grayscale
        """True if the images are mono8 instead of rgb8."""
        self.is_polished = spec.quality == "polished"
        """True if the images have soft shadows, highlights and smooth edges."""

    @property
    def n_images(self) -> int | None:
        """The number of images due on the camera's topics so far; None if it has no topic."""
        return self.state.n_images

    @property
    def intrinsics(self) -> Intrinsics:
        """The pinhole model."""
        return self._intrinsics

    @property
    def world_from_camera(self) -> Pose:
        """The present pose in W; OpenGL axes (x right, y up, looking along -z)."""
        return self._mount.world_from_body

    def resize(self, intrinsics: Intrinsics) -> None:
        """Replace the pinhole model; interfaces that publish images keep the old size."""
        self._intrinsics = intrinsics

    @property
    def has_response(self) -> bool:
        """True if the noise is that of electrons, not Gaussian noise of stored values."""
        return self._response is not None

    @property
    def pixel_type(self) -> type[np.uint8 | np.uint16]:
        """The type of the numbers of its images."""
        is_linear = self._response is not None and self._response.output == "linear12"
        return np.uint16 if is_linear else np.uint8

    def capture(self) -> npt.NDArray[np.uint8] | npt.NDArray[np.uint16]:
        """Take an image, (h, w, 3), or (h, w) if it is grey; row 0 is the top."""
        if self._response is not None and self._motion is not None:
            return self._world.render(self._make_exposure(self._response, self._motion))
        return self._world.render(
            PlainExposure(
                world_from_camera=self.world_from_camera,
                intrinsics=self._intrinsics,
                std=self.state.std,
                rng=self.state.rng,
                is_grey=self.is_grey,
                is_polished=self.is_polished,
            )
        )

    def _make_exposure(self, response: ResponseSpec, motion: CameraMotion) -> Exposure:
        """Make the exposure that is due; it draws one number."""
        body_motion = motion.body.motion()
        return Exposure(
            world_from_camera=self.world_from_camera,
            intrinsics=self._intrinsics,
            response=response.camera_response,
            shutter=response.camera_shutter,
            vignetting=response.falloff_coefficients,
            velocity=body_motion.velocity,
            angular_velocity=body_motion.angular_velocity,
            vehicle=motion.vehicle,
            key=frame_key(self.state.rng),
            is_grey=self.is_grey,
            is_polished=self.is_polished,
        )

    def sample(self, time: float) -> Image:
        """Take an image as a message, stamped ``time`` [s]."""
        return image(self.capture(), time=time, frame_id=self.frame_id)

    def skip(self) -> None:
        """Draw the random numbers of an image without subscribers, without rendering it."""
        if self.state.std > 0.0 or self._response is not None:
            frame_key(self.state.rng)

    def depth(self, time: float) -> Array:
        """Return the distance along the optical axis of each pixel, (h, w) [m]; +inf: no hit."""
        return self._world.depth(self.world_from_camera, self._intrinsics)

    def info(self, time: float) -> CameraInfo:
        """Build the CameraInfo, stamped ``time`` [s]: the lens, and Tx = -fx * baseline."""
        return camera_info(
            self._intrinsics,
            time=time,
            frame_id=self.frame_id,
            principal_point=self._principal_point,
            baseline=self._baseline,
        )
