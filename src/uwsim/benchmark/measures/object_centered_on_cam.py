r"""Object centred on a camera: how far from the middle of the image a body appears.

.. code-block:: xml

    <objectCenteredOnCam>
      <name>objectCentered</name> <target>blackbox</target> <camera>bowtech1</camera>
    </objectCenteredOnCam>
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ...base.geometry import image_centre, is_in_image
from ...schema import element
from ...world import World
from ..ground_truth import CentroidFromCamera
from ..metrics.signal import VALUES, Signal
from .measure import Measure, MeasureSpec


@dataclass(frozen=True, kw_only=True)
class ObjectCenteredOnCamSpec(MeasureSpec):
    """An ``<objectCenteredOnCam>`` element of a benchmark file."""

    values: ClassVar[tuple[str, ...]] = VALUES

    target: str = element(refers_to="body")
    """Route of the body whose origin is looked at."""
    camera: str = element(refers_to="camera")
    """Name of the virtual camera."""

    @property
    def start_value(self) -> float:
        """The original's start value."""
        return 0.0

    def bind(self, world: World) -> ObjectCenteredOnCam:
        """Find camera and target; raises UnknownName if one is not there."""
        camera = world.camera(self.camera)
        unseen = "unseen" in world.compatibility
        seen = CentroidFromCamera(camera, world.body(self.target), unseen=unseen)
        size = (camera.intrinsics.width, camera.intrinsics.height)
        return ObjectCenteredOnCam(seen, size, self.value, unseen=unseen)


class ObjectCenteredOnCam(Measure):
    r"""Distance :math:`\sqrt{d_x^2 + d_y^2}` of a body's projected origin from the image centre.

    With the image coordinates u, v of the origin and the centre of an image w wide and h high,
    :math:`d_x = (w - 1)/2 - u` and, as the original counts rows from the bottom,
    :math:`d_y = v - (h - 1)/2`. One sample for each step at which the origin
    projects into the image; no value when it does not at the last look. ``visible`` is the
    fraction of looks at which it did. Not modelled: something in between that hides it.

    Compatibility ``unseen``: a sample at each step, wherever the origin projects to; what is behind
    the camera is seen through its centre, upside down. ``visible`` is then 1.
    """

    unit = "px"

    def __init__(
        self,
        seen: CentroidFromCamera,
        size: tuple[int, int],
        value: str,
        *,
        unseen: bool = False,
    ) -> None:
        self._seen, self._size, self._which = seen, size, value
        self._unseen = unseen
        self._signal = Signal(("x", "y"))
        self._looks = 0
        self._is_visible = False

    def start(self) -> None:
        """Take the first sample."""
        self.update()

    def update(self) -> None:
        """Take a sample, if the body is in the image."""
        pixel = self._seen.pixel()
        self._looks += 1
        u, v = (math.nan, math.nan) if pixel is None else pixel
        self._is_visible = pixel is not None and (self._unseen or is_in_image(u, v, *self._size))
        if self._is_visible:
            centre_u, centre_v = image_centre(*self._size)
            off = (centre_u - u, v - centre_v)
            self._signal.add(math.hypot(*off), off)

    @property
    def value(self) -> float | None:
        """The last distance, or the statistic given by ``u:value`` [px]."""
        return self._signal.value(self._which) if self._is_visible else None

    @property
    def why(self) -> str | None:
        """Why there is no value."""
        if not self._looks:
            return "it was never on"
        return None if self._is_visible else "the target is not in the image"

    @property
    def details(self) -> dict[str, float | None]:
        """Statistics of distance and components, and how often the body was in the image."""
        visible = self._signal.n / self._looks if self._looks else None
        return {**self._signal.details, "visible": visible}

    @property
    def log_header(self) -> tuple[str, ...]:
        """The distance and its components."""
        return ("total", "x", "y")

    @property
    def log_values(self) -> tuple[float | None, ...]:
        """The newest sample; nothing while the body is not in the image."""
        return self._signal.last if self._is_visible else (None, None, None)
